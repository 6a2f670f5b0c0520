// Shape and neighbours of every tile of a mosaic.
#pragma once
#include <vector>

#include "generator/tissue/mosaic.h"

namespace lamella {

struct CellMeasures {
  Vec2 centre = Vec2::Zero();  // of area [m]
  double area = 0;             // [m2]
  double perimeter = 0;        // [m]
  double circularity = 0;      // 4 pi area / perimeter^2: 1 for a disk [1]
  double elongation = 1;       // length over width of the ellipse with the same second moments of area [1]
  double direction = 0;        // of its long axis, in (-pi/2, pi/2] [rad]
  Index neighbours = 0;        // walls to other cells, n; consecutive edges with the same cell are one wall
  Index layer = 0;             // 0: has a free edge; k: k steps from such a cell; -1: there is none
};

/// Consecutive edges that two cells share, as seen from the cell of lower index; of a periodic cell that meets itself, once.
struct SharedWall {
  Index cell_a = 0, cell_b = 0;
  double length = 0;  // sum over its edges [m]
};

struct MosaicMeasures {
  std::vector<CellMeasures> cells;
  std::vector<SharedWall> walls;
  std::vector<std::vector<Index>> neighbours;  // of every cell, in order around it; one for each wall
};

/// Throws SceneError as opposite_edges does.
MosaicMeasures measure(const Mosaic& mosaic);

}  // namespace lamella
