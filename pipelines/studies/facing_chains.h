// Two straight open chains that face each other, linked node to node: the sample of lap joints and double cantilevers, which the generator
// does not make.
#pragma once
#include "generator/sample/sample.h"

namespace lamella {

struct FacingChains {
  int segments = 1;      // of each chain
  int first_link = 0;    // nodes first_link, first_link + 1, ... (from the left) are linked
  double spacing = 1;    // of nodes [m]
  double radius = 1e-3;  // of each chain [m]; outlines touch, so centre lines are twice that apart
};

/// Cell 0, of group "upper", runs from left to right, cell 1, of group "lower", from right to left: `upper_node` and `lower_node` count from the
/// left. The left end is at x = 0, and the middle between the chains at y = 0.
Sample make_facing_chains(const FacingChains& chains);

inline Index upper_node(const FacingChains&, int from_left) { return from_left; }
inline Index lower_node(const FacingChains& c, int from_left) { return 2 * c.segments + 1 - from_left; }

}  // namespace lamella
