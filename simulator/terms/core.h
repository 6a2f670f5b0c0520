// Core: the fluid in a closed cell. Undrained p = p0 - K (A / A0 - 1), drained p = p0 (given in time). The force on node k is
// p s / 2 (y_(k+1) - y_(k-1), x_(k-1) - x_(k+1)), the gradient of the energy 1/2 K s (A - A0)^2 / A0 - p0 s (A - A0).
#pragma once
#include "simulator/terms/shell_term.h"

namespace lamella {

struct CoreParameters {
  std::vector<double> modulus;   // K of each cell [Pa]; 0: drained
  std::vector<double> pressure;  // p0 of each cell [Pa]
  std::vector<double> depth;     // s of each cell [m]
};

class Core final : public ShellTerm {
 public:
  Core(const ShellLayout& layout, CoreParameters parameters);

  std::string name() const override { return "core"; }
  double energy(const Field& x) const override;
  void add_to_block(ShellScratch& scratch, Field& f) const override;
  void add_stiffness(const Field& x, StiffnessSink& sink) const override;
  std::vector<double> stored(const Field& x) const override;
  void add_output(const Field& x, ArraySet& frame) const override;
  std::size_t bytes() const override;

  /// Over-pressure p0 of the drained cells from now on [Pa].
  void set_pressure(Index cell, double pressure) { p_.pressure[cell] = pressure; }
  double pressure(Index cell) const { return p_.pressure[cell]; }
  /// -s (A - A0), what a rise of p0 by one pascal adds to the energy [J/Pa]: the work of a prescribed pressure.
  double energy_per_pressure(Index cell, const Field& x) const;

  bool present(Index cell) const;
  /// What ends with the pressure of a cell that opens. With a modulus the fluid is the cell's own, and the energy that it would give
  /// by expanding to the pressure outside, p^2 s A0 / 2 K, is lost. A pressure that was held is a load: it has done the work
  /// p0 s (A - A0), so far counted as energy of the core.
  struct Released {
    double energy = 0, work = 0;  // [J]
  };
  Released released(Index cell, const ShellScratch& scratch) const;
  /// visit(node, force) for every node of the cell, at the positions in `scratch`.
  template <class Visit>
  void for_each_force(Index cell, const ShellScratch& scratch, Visit&& visit) const;
  /// The cell is open: no pressure from now on. Its energy stays at what its fluid holds at that outside.
  void end(Index cell);

 private:
  double area(Index cell, const Field& x) const;
  double pressure_at(Index cell, double area) const;

  double area(Index cell, const ShellScratch& scratch) const;

  CoreParameters p_;          // depth 0: no core
  std::vector<double> left_;  // energy of opened cells [J]; empty: none is
};

template <class Visit>
void Core::for_each_force(Index c, const ShellScratch& w, Visit&& visit) const {
  const Sample& sample = layout_.sample();
  const Index begin = sample.cell_begin[c], at = ShellLayout::slot(c, begin) - w.block.slot_begin;
  const double half = 0.5 * p_.depth[c] * pressure_at(c, area(c, w));
  for (Index k = 0; k < sample.cell_size(c); ++k)
    visit(begin + k, half * Vec2(w.py[at + k + 1] - w.py[at + k - 1], w.px[at + k - 1] - w.px[at + k + 1]));
}

}  // namespace lamella
