#include "simulator/terms/hinges.h"

#include <limits>

#include "simulator/laws/plastic.h"
#include "simulator/measures/angle.h"

namespace lamella {

Hinges::Hinges(const ShellLayout& layout, const std::vector<double>& bending_rigidity, const std::vector<double>& yield)
    : ShellTerm(layout) {
  const Sample& s = layout.sample();
  std::vector<double> k(s.nodes(), 0.0), limit(s.nodes(), std::numeric_limits<double>::infinity());
  for (Index c = 0; c < s.cells(); ++c)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) {
      if (s.hinge_length[i] > 0) k[i] = bending_rigidity[c] / s.hinge_length[i];
      if (!yield.empty()) limit[i] = yield[c];
    }
  stiffness_ = layout.padded(k, 0.0);
  rest_angle_ = layout.padded(s.rest_angle, 0.0);
  last_angle_.assign(rest_angle_.begin(), rest_angle_.end());
  if (!yield.empty()) yield_ = layout.padded(limit, std::numeric_limits<double>::infinity());
}

// F_(k-1) = -M n_1 / l_1, F_k = M (n_1 / l_1 + n_2 / l_2), F_(k+1) = -M n_2 / l_2 (physics.md 1), so the segment from hinge k
// to hinge k + 1 carries the shear force (M_k - M_(k+1)) / l along its left normal.
void Hinges::add_to_block(ShellScratch& w, Field&) const {
  const Sample& sample = layout_.sample();
  const Index n = w.block.slots, at = w.block.slot_begin;
  const double *K = stiffness_.data() + at, *A0 = rest_angle_.data() + at;
  const float* LAST = last_angle_.data() + at;
  const double *EX = w.ex.data(), *EY = w.ey.data(), *IL = w.inverse_length.data();
  double *A = w.angle.data(), *M = w.moment.data();
  A[0] = LAST[0], M[0] = 0;
#pragma omp simd
  for (Index s = 1; s < n; ++s) {
    const double c = EX[s - 1] * EY[s] - EY[s - 1] * EX[s];
    const double d = EX[s - 1] * EX[s] + EY[s - 1] * EY[s];
    A[s] = unwrapped(angle_of(c, d), static_cast<double>(LAST[s]));
    M[s] = K[s] * (A[s] - A0[s]);
  }
  if (!yield_.empty()) {
    const double* Y = yield_.data() + at;
#pragma omp simd
    for (Index s = 1; s < n; ++s) M[s] = returned(M[s], Y[s]);
  }
  for (Index c = w.block.cell_begin; c < w.block.cell_end; ++c) {
    const Index first = ShellLayout::slot(c, sample.cell_begin[c]) - at, size = sample.cell_size(c);
    M[first - 1] = sample.closed[c] ? M[first + size - 1] : 0.0;
    M[first + size] = sample.closed[c] ? M[first] : 0.0;
  }
  double *SX = w.sx.data(), *SY = w.sy.data();
#pragma omp simd
  for (Index s = 0; s < n - 1; ++s) {
    const double q = (M[s] - M[s + 1]) * IL[s] * IL[s];
    SX[s] -= q * EY[s], SY[s] += q * EX[s];
  }
}

void Hinges::prefetch_block(const CellBlock& block) const {
  prefetch(stiffness_, block.slot_begin, block.slot_begin + block.slots);
  prefetch(rest_angle_, block.slot_begin, block.slot_begin + block.slots);
  prefetch(last_angle_, block.slot_begin, block.slot_begin + block.slots);
}

void Hinges::commit_block(Index b, const ShellScratch& w) {
  const Index n = w.block.slots, at = w.block.slot_begin;
  float* LAST = last_angle_.data() + at;
  const double* A = w.angle.data();
#pragma omp simd
  for (Index s = 1; s < n; ++s) LAST[s] = static_cast<float>(A[s]);
  if (yield_.empty()) return;
  const Sample& sample = layout_.sample();
  double dissipated = 0;
  for (Index c = w.block.cell_begin; c < w.block.cell_end; ++c) {
    const Index first = ShellLayout::slot(c, sample.cell_begin[c]), size = sample.cell_size(c);
    for (Index s = first; s < first + size; ++s) {
      const Index local = s - at;
      if (stiffness_[s] == 0 || std::abs(w.moment[local]) < yield_[s]) continue;  // elastic: theta_p stays
      const double rest = w.angle[local] - w.moment[local] / stiffness_[s];
      dissipated += w.moment[local] * (rest - rest_angle_[s]);
      rest_angle_[s] = rest;
    }
    if (sample.closed[c])
      rest_angle_[first - 1] = rest_angle_[first + size - 1], rest_angle_[first + size] = rest_angle_[first];
  }
  dissipated_[b] += dissipated;
}

template <class F>
void Hinges::for_each_hinge(const Field& x, F&& visit, StiffnessSink* sink) const {
  const Sample& s = layout_.sample();
  for (Index c = 0; c < s.cells(); ++c) {
    if (sink && !sink->begin_elements(c)) continue;
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) {
      const Index slot = ShellLayout::slot(c, i);
      if (stiffness_[slot] == 0) continue;
      const Index h = s.prev(c, i), j = s.next(c, i);
      const Vec2 e1 = x.at(i) - x.at(h), e2 = x.at(j) - x.at(i);
      const double angle = unwrapped(angle_of(cross(e1, e2), e1.dot(e2)), static_cast<double>(last_angle_[slot]));
      visit(c, h, i, j, slot, stiffness_[slot] * (angle - rest_angle_[slot]));
    }
  }
}

double Hinges::energy(const Field& x) const {
  double sum = 0;
  for_each_hinge(x, [&](Index, Index, Index, Index, Index slot, double trial) {
    sum += yield_.empty() ? 0.5 * trial * trial / stiffness_[slot]
                          : incremental_potential(trial, yield_[slot], stiffness_[slot]);
  });
  return sum;
}

std::vector<double> Hinges::stored(const Field& x) const {
  std::vector<double> energy(layout_.sample().cells(), 0.0);
  for_each_hinge(x, [&](Index c, Index, Index, Index, Index slot, double trial) {
    const double moment = yield_.empty() ? trial : returned(trial, yield_[slot]);
    energy[c] += 0.5 * moment * moment / stiffness_[slot];
  });
  return energy;
}

// theta = phi_2 - phi_1 with d(phi)/de = n / l and d2(phi)/de2 = -(t n^T + n t^T) / l^2.
void Hinges::add_stiffness(const Field& x, StiffnessSink& sink) const {
  const auto add = [&](Index, Index h, Index i, Index j, Index slot, double trial) {
    double k = stiffness_[slot], moment = trial;
    if (!yield_.empty() && std::abs(trial) > yield_[slot]) k = 0, moment = returned(trial, yield_[slot]);
    const Index node[3] = {h, i, j};
    Vec2 gradient[3] = {Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
    Eigen::Matrix2d hessian[2];
    for (int e = 0; e < 2; ++e) {
      const Vec2 edge = x.at(node[e + 1]) - x.at(node[e]);
      const double l = edge.norm(), sign = e == 0 ? -1 : 1;  // theta = phi_2 - phi_1
      const Vec2 t = edge / l, n = left_of(t);
      gradient[e] -= sign * n / l, gradient[e + 1] += sign * n / l;
      hessian[e] = -sign * moment / (l * l) * (t * n.transpose() + n * t.transpose());
    }
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        Eigen::Matrix2d block = k * gradient[a] * gradient[b].transpose();
        for (int e = 0; e < 2; ++e) {
          const int sa = a == e ? -1 : a == e + 1 ? 1 : 0, sb = b == e ? -1 : b == e + 1 ? 1 : 0;
          block += (sa * sb) * hessian[e];
        }
        sink.add(node[a], node[b], block);
      }
  };
  for_each_hinge(x, add, &sink);
}

void Hinges::save(ArraySet& restart) const {
  restart.add(
      {"hinge_last_angle_padded", "rad", "slot", 1, std::vector<double>(last_angle_.begin(), last_angle_.end())});
  if (yield_.empty()) return;
  restart.add({"hinge_rest_angle_padded", "rad", "slot", 1, rest_angle_});
  restart.add({"hinge_dissipated", "J", "block", 1, dissipated_});
}

void Hinges::restore(const ArraySet& restart) {
  if (!restart.find("hinge_last_angle_padded")) return;
  const auto& last = restart.doubles("hinge_last_angle_padded");
  last_angle_.assign(last.begin(), last.end());
  if (yield_.empty() || !restart.find("hinge_rest_angle_padded")) return;
  rest_angle_ = restart.doubles("hinge_rest_angle_padded");
  dissipated_ = restart.doubles("hinge_dissipated");
}

void Hinges::add_output(const Field& x, ArraySet& frame) const {
  std::vector<double> moment(layout_.sample().x.size(), 0.0), plastic;
  for_each_hinge(x, [&](Index, Index, Index i, Index, Index slot, double trial) {
    moment[i] = yield_.empty() ? trial : returned(trial, yield_[slot]);
  });
  frame.add({"moment", "N m", "node", 1, std::move(moment)});
  if (!yield_.empty()) {
    plastic = layout_.unpadded(rest_angle_);
    for (std::size_t i = 0; i < plastic.size(); ++i) plastic[i] -= layout_.sample().rest_angle[i];
    frame.add({"hinge_plastic_angle", "rad", "node", 1, std::move(plastic)});
  }
  frame.add({"hinge_energy", "J", "cell", 1, stored(x)});
}

std::size_t Hinges::bytes() const {
  return sizeof(double) * (stiffness_.size() + rest_angle_.size() + yield_.size()) + sizeof(float) * last_angle_.size();
}

}  // namespace lamella
