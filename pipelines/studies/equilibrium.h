// Where a model is at rest, found without stepping in time: a second way to what slow runs approach, through the terms' own energies, forces
// and stiffnesses but through nothing of the stepper. No history moves: walls that yield and links that break are out of its reach.
#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "simulator/loads.h"
#include "simulator/model.h"

namespace lamella {

struct Equilibrium {
  Field x;                // [m]
  double unbalanced = 0;  // largest component of the force that is left on what is free [N]
  int iterations = 0;
};

/// Minimises the energy of the terms less the work of `factor` times the loads' forces, by Newton's method with a line search. Components that
/// loads hold stay as they are in `x`, where the search begins. Converged: to rounding of the positions. Throws SolverError otherwise.
Equilibrium find_equilibrium(const Model& model, const std::vector<Load>& loads, double factor, Field x);

/// Normal and tangential force of a link [N].
struct LinkForce {
  double normal = 0, tangential = 0;
};
/// Of all links at x; 0 for broken ones.
std::vector<LinkForce> link_forces(const Model& model, const Field& x);

/// Where the first link breaks.
struct StaticBreak {
  double factor = 0;  // of the loads
  Index link = -1;
  LinkForce force;  // of that link
  Field x;          // [m]
};

/// Loads grow in proportion: forces are `factor` times the full ones, held components are moved by `factor` times 1 s of their velocity. Finds
/// the factor at which the first link meets its criterion, from the guess on. Throws SolverError where none does.
StaticBreak find_first_break(const Model& model, const std::vector<Load>& loads, const Field& rest, double guess);

}  // namespace lamella
