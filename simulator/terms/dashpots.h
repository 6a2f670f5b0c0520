// Dashpots of bars and hinges: axial force c_b / l0 dl/dt and moment c_h / lt d(theta)/dt. No energy; linear in the velocities, with the
// geometry at x. The explicit step evaluates them with the velocity half a step behind, which the stable step accounts for.
#pragma once
#include "simulator/shells.h"
#include "simulator/terms/term.h"

namespace lamella {

class Dashpots {
 public:
  /// `bar`: c of each cell [N s]; `hinge`: c of each cell [N m2 s].
  Dashpots(const ShellLayout& layout, const std::vector<double>& bar, const std::vector<double>& hinge);

  /// Adds the section forces of the block; `scratch` must hold the geometry and the velocities.
  void add_to_block(ShellScratch& scratch) const;
  /// Whole system: f += damping force.
  void add_force(const Field& x, const Field& v, Field& f) const;
  /// d(-force)/dv, for the stable step.
  void add_damping(const Field& x, StiffnessSink& sink) const;
  /// The bar is gone, and so are the hinges at its ends.
  void end(Index cell, Index node);
  std::size_t bytes() const { return sizeof(double) * (bar_.size() + hinge_.size()); }

 private:
  const ShellLayout& layout_;
  std::vector<double> bar_, hinge_;  // padded: c / l0 [N s/m], c / lt [N m s]
};

}  // namespace lamella
