// The boundaries between the cells of a picture: lines along the sides of pixels, each traced once for the two cells
// that it parts.
#pragma once
#include <vector>

#include "generator/image/labels.h"

namespace lamella {

/// What is beyond the sides of a picture, instead of a cell. kBackground is -1.
enum Beyond : Index { kBeyondLeft = -2, kBeyondRight = -3, kBeyondBottom = -4, kBeyondTop = -5 };

/// A corner of pixels: pixel (x, y) lies between (x, y) and (x + 1, y + 1), y counts downwards.
struct Lattice {
  int x = 0, y = 0;
  bool operator==(const Lattice&) const = default;
};

/// From node to node. At least one of left and right is a cell; the other may be kBackground or Beyond.
struct BoundaryWall {
  Index left = 0, right = 0;    // as seen on the way
  Index begin = 0, end = 0;     // nodes; the same when the wall is closed
  std::vector<Lattice> corner;  // where it turns, both ends included
};

/// A wall as a cell has it, the cell on its left.
struct WallUse {
  Index wall = 0;
  bool forward = true;
};

struct Boundaries {
  int width = 0, height = 0;
  std::vector<Lattice> node;                  // where three or four regions meet; of a closed wall any corner
  std::vector<BoundaryWall> walls;            // in the order of their first corners, row by row
  std::vector<std::vector<WallUse>> outline;  // of every cell, counter-clockwise to the eye
};

/// Of clean labels (clean_labels): every cell is one closed outline that visits no corner twice.
Boundaries trace_boundaries(const LabelImage& labels);

}  // namespace lamella
