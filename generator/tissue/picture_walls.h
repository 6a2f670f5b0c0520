// The walls of a picture as few straight edges: short walls are welded to a point, others simplified, so that cells stay
// simple polygons that do not overlap. In whole pixels, so that all tests are exact.
#pragma once
#include <vector>

#include "generator/image/boundaries.h"

namespace lamella {

struct SimplifiedWalls {
  std::vector<Lattice> vertices;
  struct Cell {
    std::vector<Index> vertex;  // counter-clockwise to the eye, y downwards
    std::vector<Index> beyond;  // across the edge that starts there: a cell, kBackground or Beyond
  };
  std::vector<Cell> cells;
  int welded = 0;   // walls that are points now
  int refined = 0;  // walls that are simplified by less than the tolerance, to keep cells apart
};

/// Douglas-Peucker on every wall, once for its two cells: no corner of the boundary is farther than `tolerance` [pixels]
/// from its edge. Walls between two cells that are shorter than `weld` times their mean are welded. Where edges would
/// then cross or touch, or a cell would fold, the walls that do are simplified less, in the end not at all, and welds
/// there are undone.
SimplifiedWalls simplify_walls(const Boundaries& boundaries, double tolerance, double weld);

}  // namespace lamella
