// What searches for equilibrium cost.
#pragma once
#include <cstdint>

namespace lamella {

/// Of all searches so far.
struct SolverCost {
  std::int64_t searches = 0, iterations = 0;
  std::int64_t forces = 0;                  // evaluations of all forces
  std::int64_t solves = 0;                  // with the factor
  std::int64_t factorizations = 0;          // tries with another shift included
  std::int64_t partial_factorizations = 0;  // of what had turned
  std::int64_t updates = 0;                 // of the factor, one for each link that broke
};

}  // namespace lamella
