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

 private:
  bool present(Index cell) const;
  double area(Index cell, const Field& x) const;
  double pressure_at(Index cell, double area) const;

  CoreParameters p_;
};

}  // namespace lamella
