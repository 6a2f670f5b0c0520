// The static oracle of the studies of rings: equilibrium of a ring of bars and hinges, with or without a core, between rigid frictionless
// plates, by Newton's method with an active set. It has formulas of its own and shares no code with the simulator.
#pragma once
#include <vector>

#include "generator/sample/vec.h"

namespace lamella {

/// A regular polygon of `nodes` (a multiple of 4) on a circle of radius 1, with EI = s = 1, vertices towards the plates.
struct StaticRingModel {
  int nodes = 80;
  double axial = 4800;  // EA R^2 / EI
  double core = 0;      // K R^3 / EI; 0: none
};

struct StaticRing {
  double strain = 0;
  double force = 0;   // of one plate
  double moment = 0;  // <|x|> of that force
  double pressure = 0;
  double area = 1;              // over that at rest
  double shrinkage = 0;         // 1 - area; p / K with a core
  double width = 0;             // a / b0
  double bars = 0, hinges = 0;  // stored
  std::vector<Vec2> x;          // nodes
  std::vector<double> push;     // of the plates on each node
};

/// Equilibria at these strains, which increase. Throws SolverError where Newton's method fails.
std::vector<StaticRing> static_ring(const StaticRingModel& model, const std::vector<double>& strains);

}  // namespace lamella
