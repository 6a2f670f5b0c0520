#include "simulator/terms/bars.h"

#include <limits>

#include "simulator/laws/plastic.h"

namespace lamella {

Bars::Bars(const ShellLayout& layout, const std::vector<double>& axial_rigidity, const std::vector<double>& yield)
    : ShellTerm(layout) {
  const Sample& s = layout.sample();
  std::vector<double> k(s.nodes(), 0.0), limit(s.nodes(), std::numeric_limits<double>::infinity());
  for (Index c = 0; c < s.cells(); ++c)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) {
      if (s.starts_segment(c, i)) k[i] = axial_rigidity[c] / s.rest_length[i];
      if (!yield.empty()) limit[i] = yield[c];
    }
  stiffness_ = layout.padded(k, 0.0);
  rest_length_ = layout.padded(s.rest_length, 0.0);
  if (!yield.empty()) {
    yield_ = layout.padded(limit, std::numeric_limits<double>::infinity());
    plastic_.assign(layout.slots(), 0.0);
  }
}

void Bars::add_to_block(ShellScratch& w, Field&) const {
  const Index n = w.block.slots, at = w.block.slot_begin;
  const double *K = stiffness_.data() + at, *L0 = rest_length_.data() + at;
  const double *L = w.length.data(), *IL = w.inverse_length.data(), *EX = w.ex.data(), *EY = w.ey.data();
  double *SX = w.sx.data(), *SY = w.sy.data(), *T = w.tension.data();
  if (yield_.empty()) {
#pragma omp simd
    for (Index s = 0; s < n; ++s) {
      T[s] = K[s] * (L[s] - L0[s]);
      const double q = T[s] * IL[s];
      SX[s] += q * EX[s], SY[s] += q * EY[s];
    }
    return;
  }
  const double *Y = yield_.data() + at, *P = plastic_.data() + at;
#pragma omp simd
  for (Index s = 0; s < n; ++s) {
    T[s] = returned(K[s] * (L[s] - L0[s] - P[s]), Y[s]);
    const double q = T[s] * IL[s];
    SX[s] += q * EX[s], SY[s] += q * EY[s];
  }
}

void Bars::prefetch_block(const CellBlock& block) const {
  prefetch(stiffness_, block.slot_begin, block.slot_begin + block.slots);
  prefetch(rest_length_, block.slot_begin, block.slot_begin + block.slots);
}

void Bars::commit_block(Index b, const ShellScratch& w) {
  const Sample& sample = layout_.sample();
  double dissipated = 0;
  for (Index c = w.block.cell_begin; c < w.block.cell_end; ++c) {
    const Index at = ShellLayout::slot(c, sample.cell_begin[c]), n = sample.cell_size(c);
    for (Index s = at; s < at + n; ++s) {
      const Index local = s - w.block.slot_begin;
      if (stiffness_[s] == 0 || std::abs(w.tension[local]) < yield_[s]) continue;  // elastic: l_p stays
      const double plastic = w.length[local] - rest_length_[s] - w.tension[local] / stiffness_[s];
      dissipated += w.tension[local] * (plastic - plastic_[s]);
      plastic_[s] = plastic;
    }
    if (sample.closed[c]) plastic_[at - 1] = plastic_[at + n - 1], plastic_[at + n] = plastic_[at];
  }
  dissipated_[b] += dissipated;
}

template <class F>
void Bars::for_each_bar(const Field& x, F&& visit, StiffnessSink* sink) const {
  const Sample& s = layout_.sample();
  for (Index c = 0; c < s.cells(); ++c) {
    if (sink && !sink->begin_elements(c)) continue;
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) {
      const Index slot = ShellLayout::slot(c, i);
      if (stiffness_[slot] == 0) continue;
      const Index j = s.next(c, i);
      visit(c, i, j, slot, (x.at(j) - x.at(i)).norm());
    }
  }
}

double Bars::energy(const Field& x) const {
  double sum = 0;
  for_each_bar(x, [&](Index, Index, Index, Index slot, double length) {
    const double elongation = length - rest_length_[slot];
    const double k = stiffness_[slot];
    sum += yield_.empty() ? 0.5 * k * elongation * elongation
                          : incremental_potential(k * (elongation - plastic_[slot]), yield_[slot], k);
  });
  return sum;
}

std::vector<double> Bars::stored(const Field& x) const {
  std::vector<double> energy(layout_.sample().cells(), 0.0);
  for_each_bar(x, [&](Index c, Index, Index, Index slot, double length) {
    double tension = stiffness_[slot] * (length - rest_length_[slot]);
    if (!yield_.empty()) tension = returned(tension - stiffness_[slot] * plastic_[slot], yield_[slot]);
    energy[c] += stored_at(slot, tension);
  });
  return energy;
}

// d2W/de2 = k t t^T + (T / l) n n^T, k = 0 while the bar flows.
void Bars::add_stiffness(const Field& x, StiffnessSink& sink) const {
  const auto add = [&](Index, Index i, Index j, Index slot, double length) {
    double k = stiffness_[slot], tension = k * (length - rest_length_[slot]);
    if (!yield_.empty()) {
      const double trial = tension - k * plastic_[slot];
      tension = returned(trial, yield_[slot]);
      if (std::abs(trial) > yield_[slot]) k = 0;
    }
    const Vec2 t = (x.at(j) - x.at(i)) / length, n = left_of(t);
    const Eigen::Matrix2d block = k * t * t.transpose() + (tension / length) * n * n.transpose();
    sink.add(i, i, block), sink.add(j, j, block);
    sink.add(i, j, -block), sink.add(j, i, -block);
  };
  for_each_bar(x, add, &sink);
}

void Bars::save(ArraySet& restart) const {
  if (yield_.empty()) return;
  restart.add({"bar_plastic_length_padded", "m", "slot", 1, plastic_});
  restart.add({"bar_dissipated", "J", "block", 1, dissipated_});
}

void Bars::restore(const ArraySet& restart) {
  if (yield_.empty() || !restart.find("bar_plastic_length_padded")) return;
  plastic_ = restart.doubles("bar_plastic_length_padded");
  dissipated_ = restart.doubles("bar_dissipated");
}

void Bars::add_output(const Field& x, ArraySet& frame) const {
  std::vector<double> tension(layout_.sample().x.size(), 0.0);
  for_each_bar(x, [&](Index, Index i, Index, Index slot, double length) {
    tension[i] = stiffness_[slot] * (length - rest_length_[slot]);
    if (!yield_.empty()) tension[i] = returned(tension[i] - stiffness_[slot] * plastic_[slot], yield_[slot]);
  });
  frame.add({"axial_force", "N", "segment", 1, std::move(tension)});
  if (!yield_.empty()) frame.add({"bar_plastic_length", "m", "segment", 1, layout_.unpadded(plastic_)});
  frame.add({"bar_energy", "J", "cell", 1, stored(x)});
}

std::size_t Bars::bytes() const {
  return sizeof(double) * (stiffness_.size() + rest_length_.size() + yield_.size() + plastic_.size());
}

}  // namespace lamella
