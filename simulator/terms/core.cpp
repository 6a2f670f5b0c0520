#include "simulator/terms/core.h"

namespace lamella {

Core::Core(const ShellLayout& layout, CoreParameters parameters) : ShellTerm(layout), p_(std::move(parameters)) {}

bool Core::present(Index c) const { return layout_.sample().closed[c] && p_.depth[c] > 0; }

double Core::area(Index c, const Field& x) const {
  const Sample& s = layout_.sample();
  const Index begin = s.cell_begin[c], end = s.cell_begin[c + 1];
  const Vec2 origin = x.at(begin);  // relative coordinates keep the digits of a small cell far from the origin
  double twice = 0;
  for (Index i = begin + 1; i + 1 < end; ++i) twice += cross(x.at(i) - origin, x.at(i + 1) - origin);
  return 0.5 * twice;
}

double Core::area(Index c, const ShellScratch& w) const {
  const Sample& s = layout_.sample();
  const Index at = ShellLayout::slot(c, s.cell_begin[c]) - w.block.slot_begin, end = at + s.cell_size(c);
  double twice = 0;
  for (Index k = at; k < end; ++k)
    twice += (w.px[k] - w.px[at]) * (w.py[k + 1] - w.py[at]) - (w.py[k] - w.py[at]) * (w.px[k + 1] - w.px[at]);
  return 0.5 * twice;
}

Core::Released Core::released(Index c, const ShellScratch& w) const {
  const double rest = layout_.sample().rest_area[c], a = area(c, w), p = pressure_at(c, a);
  if (p_.modulus[c] > 0) return {.energy = 0.5 * p * p * p_.depth[c] * rest / p_.modulus[c], .work = 0};
  return {.energy = 0, .work = p * p_.depth[c] * (a - rest)};
}

void Core::end(Index c) {
  if (!present(c)) return;
  left_.resize(layout_.sample().cells(), 0.0);
  const double p0 = p_.pressure[c], k = p_.modulus[c];
  if (k > 0) left_[c] = -0.5 * p0 * p0 * p_.depth[c] * layout_.sample().rest_area[c] / k;
  p_.depth[c] = 0;
}

double Core::pressure_at(Index c, double a) const {
  return p_.pressure[c] - p_.modulus[c] * (a / layout_.sample().rest_area[c] - 1);
}

void Core::add_to_block(ShellScratch& w, Field& f) const {
  const Sample& sample = layout_.sample();
  for (Index c = w.block.cell_begin; c < w.block.cell_end; ++c) {
    if (!present(c)) continue;
    const Index begin = sample.cell_begin[c], n = sample.cell_size(c);
    const Index at = ShellLayout::slot(c, begin) - w.block.slot_begin;
    const double *X = w.px.data() + at, *Y = w.py.data() + at, x0 = X[0], y0 = Y[0];
    double twice = 0;
#pragma omp simd reduction(+ : twice)
    for (Index k = 0; k < n; ++k) twice += (X[k] - x0) * (Y[k + 1] - y0) - (Y[k] - y0) * (X[k + 1] - x0);
    const double half = 0.5 * p_.depth[c] * pressure_at(c, 0.5 * twice);
    double *FX = f.x.data() + begin, *FY = f.y.data() + begin;
#pragma omp simd
    for (Index k = 0; k < n; ++k) {
      FX[k] += half * (Y[k + 1] - Y[k - 1]);
      FY[k] += half * (X[k - 1] - X[k + 1]);
    }
  }
}

std::vector<double> Core::stored(const Field& x) const {
  std::vector<double> energy = left_;
  energy.resize(layout_.sample().cells(), 0.0);
  for (Index c = 0; c < layout_.sample().cells(); ++c) {
    if (!present(c)) continue;
    const double rest = layout_.sample().rest_area[c], da = area(c, x) - rest;
    energy[c] = p_.depth[c] * (0.5 * p_.modulus[c] * da * da / rest - p_.pressure[c] * da);
  }
  return energy;
}

double Core::energy(const Field& x) const {
  double sum = 0;
  for (double e : stored(x)) sum += e;
  return sum;
}

double Core::energy_per_pressure(Index c, const Field& x) const {
  return present(c) ? -p_.depth[c] * (area(c, x) - layout_.sample().rest_area[c]) : 0.0;
}

// d2W = (K s / A0) grad A grad A^T - p s d2A, and d2A / dx_k dx_(k+1) is half of a rotation.
void Core::add_stiffness(const Field& x, StiffnessSink& sink) const {
  const Sample& s = layout_.sample();
  std::vector<Vec2> gradient;
  for (Index c = 0; c < s.cells(); ++c) {
    if (!present(c) || !sink.begin_elements(c)) continue;
    const Index begin = s.cell_begin[c], n = s.cell_size(c);
    gradient.resize(n);
    for (Index k = 0; k < n; ++k) {
      const Vec2 d = x.at(s.next(c, begin + k)) - x.at(s.prev(c, begin + k));
      gradient[k] = 0.5 * right_of(d);
    }
    const double k = p_.modulus[c] * p_.depth[c] / s.rest_area[c];
    if (k > 0)
      for (Index a = 0; a < n; ++a)
        for (Index b = 0; b < n; ++b) sink.add(begin + a, begin + b, k * gradient[a] * gradient[b].transpose());
    const double half = -0.5 * p_.depth[c] * pressure_at(c, area(c, x));
    Eigen::Matrix2d block;  // d2A / dx_k dx_(k+1): dA = 1/2 (dx_k dy_(k+1) - dy_k dx_(k+1))
    block << 0, half, -half, 0;
    for (Index a = begin; a < begin + n; ++a) {
      const Index b = s.next(c, a);
      sink.add(a, b, block);
      sink.add(b, a, block.transpose());
    }
  }
}

void Core::add_output(const Field& x, ArraySet& frame) const {
  std::vector<double> pressure(layout_.sample().cells(), 0.0);
  for (Index c = 0; c < layout_.sample().cells(); ++c)
    if (present(c)) pressure[c] = pressure_at(c, area(c, x));
  frame.add({"pressure", "Pa", "cell", 1, std::move(pressure)});
  frame.add({"core_energy", "J", "cell", 1, stored(x)});
}

std::size_t Core::bytes() const { return sizeof(double) * (3 * p_.modulus.size() + left_.size()); }

}  // namespace lamella
