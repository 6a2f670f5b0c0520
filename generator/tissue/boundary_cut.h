// Where the boundary of a domain crosses the walls of a tessellation, and in which order: decided exactly.
#pragma once
#include <utility>
#include <vector>

#include "generator/packing/laguerre.h"
#include "generator/tissue/overlay.h"

namespace lamella {

/// Thrown where the boundary and a wall have more in common than a point that is no end of either.
struct Coincidence {};

/// One edge of the tessellation, from the lower vertex to the higher.
struct CutWall {
  Index low = 0, high = 0;
  Index left = -1, left_edge = 0;    // tile that has it from low to high, and which of its edges it is
  Index right = -1, right_edge = 0;  // tile that has it from high to low; -1: outside the box
  std::vector<Index> crossings;      // from low to high
};

/// The boundary crosses a wall.
struct BoundaryCrossing {
  Index wall = 0;
  Index boundary = 0;                // edge of the domain
  Index from_tile = 0, to_tile = 0;  // along the boundary
  double share = 0;                  // of the way along the domain's edge
  Index rank = 0;                    // among the wall's crossings
  Index ahead = -1, behind = -1;     // pieces of the boundary that start and end here
};

/// A piece of the boundary between two points, in one tile.
struct BoundaryPiece {
  Index tile = 0;
  Index boundary = 0;                          // edge of the domain that it lies on
  Index crossing_from = -1, crossing_to = -1;  // -1: the corner at which that edge begins or ends
  Index before = -1, after = -1;               // pieces of the same loop
};

/// The boundary cut at the walls, and the walls at the boundary.
struct BoundaryCut {
  std::vector<CutWall> walls;
  std::vector<BoundaryCrossing> crossings;
  std::vector<BoundaryPiece> pieces;          // loop by loop
  std::vector<std::pair<Index, Index>> lone;  // a piece of each loop that crosses no wall, and the loop
};

/// Edges of the loops are counted through all of them. Throws Coincidence.
BoundaryCut cut_boundary(const Tessellation& tessellation, const Loops& loops);

}  // namespace lamella
