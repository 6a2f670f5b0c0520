#include "simulator/terms/dashpots.h"

namespace lamella {

Dashpots::Dashpots(const ShellLayout& layout, const std::vector<double>& bar, const std::vector<double>& hinge)
    : layout_(layout) {
  const Sample& s = layout.sample();
  std::vector<double> b(s.nodes(), 0.0), h(s.nodes(), 0.0);
  for (Index c = 0; c < s.cells(); ++c)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) {
      if (s.starts_segment(c, i)) b[i] = bar[c] / s.rest_length[i];
      if (s.hinge_length[i] > 0) h[i] = hinge[c] / s.hinge_length[i];
    }
  bar_ = layout.padded(b, 0.0);
  hinge_ = layout.padded(h, 0.0);
}

void Dashpots::add_to_block(ShellScratch& w) const {
  const Sample& sample = layout_.sample();
  const Index n = w.block.slots, at = w.block.slot_begin;
  const double *VX = w.vx.data(), *VY = w.vy.data(), *EX = w.ex.data(), *EY = w.ey.data(),
               *IL = w.inverse_length.data();
  double *SX = w.sx.data(), *SY = w.sy.data(), *RATE = w.angle.data(), *M = w.moment.data();
  // RATE: d(phi)/dt of the segment
  for (Index s = 0; s < n - 1; ++s) {
    const double dvx = VX[s + 1] - VX[s], dvy = VY[s + 1] - VY[s], il2 = IL[s] * IL[s];
    const double q = bar_[at + s] * (dvx * EX[s] + dvy * EY[s]) * il2;
    SX[s] += q * EX[s], SY[s] += q * EY[s];
    RATE[s] = (dvy * EX[s] - dvx * EY[s]) * il2;
  }
  M[0] = M[n - 1] = 0;
  for (Index s = 1; s < n - 1; ++s) M[s] = hinge_[at + s] * (RATE[s] - RATE[s - 1]);
  for (Index c = w.block.cell_begin; c < w.block.cell_end; ++c) {
    const Index first = ShellLayout::slot(c, sample.cell_begin[c]) - at, size = sample.cell_size(c);
    M[first - 1] = sample.closed[c] ? M[first + size - 1] : 0.0;
    M[first + size] = sample.closed[c] ? M[first] : 0.0;
  }
  for (Index s = 0; s < n - 1; ++s) {
    const double q = (M[s] - M[s + 1]) * IL[s] * IL[s];
    SX[s] -= q * EY[s], SY[s] += q * EX[s];
  }
}

void Dashpots::end(Index cell, Index node) {
  layout_.set_padded(bar_, cell, node, 0.0);
  for (const Index hinge : {node, layout_.sample().next(cell, node)}) layout_.set_padded(hinge_, cell, hinge, 0.0);
}

void Dashpots::add_force(const Field& x, const Field& v, Field& f) const {
  ShellScratch scratch(layout_);
  for (const auto& block : layout_.blocks()) {
    scratch.load(layout_.sample(), block, x);
    scratch.load_velocity(layout_.sample(), v);
    add_to_block(scratch);
    scratch.add_section_forces(layout_.sample(), f);
  }
}

void Dashpots::add_damping(const Field& x, StiffnessSink& sink) const {
  const Sample& s = layout_.sample();
  for (Index c = 0; c < s.cells(); ++c)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) {
      const Index slot = ShellLayout::slot(c, i), j = s.next(c, i), h = s.prev(c, i);
      if (bar_[slot] > 0) {
        const Vec2 t = (x.at(j) - x.at(i)).normalized();
        const Eigen::Matrix2d block = bar_[slot] * t * t.transpose();
        sink.add(i, i, block), sink.add(j, j, block), sink.add(i, j, -block), sink.add(j, i, -block);
      }
      if (hinge_[slot] > 0) {
        const Vec2 e1 = x.at(i) - x.at(h), e2 = x.at(j) - x.at(i);
        const Vec2 g1 = left_of(e1) / e1.squaredNorm(), g2 = left_of(e2) / e2.squaredNorm();
        const Index node[3] = {h, i, j};
        const Vec2 gradient[3] = {g1, -g1 - g2, g2};
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) sink.add(node[a], node[b], hinge_[slot] * gradient[a] * gradient[b].transpose());
      }
    }
}

}  // namespace lamella
