// The largest stable step of velocity Verlet, from the stiffness as it is now: every eigenvalue of M^-1 K lies below the largest
// block row sum, lambda_max(K_ii) + sum_j |K_ij|, over the node's mass (block Gershgorin, spectral norms, so that the bound does
// not depend on how the sample is turned). Dashpots, evaluated half a step late, shorten it: k dt^2 + 2 c dt = 4.
#pragma once
#include <string>
#include <vector>

#include "simulator/model.h"

namespace lamella {

struct StableStep {
  double dt = 0;           // bound [s]; 0.75 to 0.95 of the true limit in tissues
  Index node = 0;          // that limits it
  std::string limited_by;  // "links 61 %, bars 30 %, hinges 9 %": shares of the node's row sum
};

/// Bound at x. `held[i]` marks nodes whose two components are both prescribed: they limit nothing.
StableStep stable_time_step(const Model& model, const Field& x, const std::vector<std::uint8_t>& held);

}  // namespace lamella
