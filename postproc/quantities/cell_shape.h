// Size and shape of each cell: of its centre line, and of its outline (the sphero-polygon, centre line dilated by r).
#pragma once
#include <vector>

#include "postproc/frame_view.h"

namespace lamella {

struct CellShape {
  Vec2 centroid = Vec2::Zero();  // of the enclosed area; of the line for an open chain [m]
  double area = 0;               // enclosed by the centre line [m2]; 0 for a chain
  double perimeter = 0;          // length of the centre line [m]
  double outline_area = 0;       // of the sphero-polygon, wall and inside [m2]
  double outline_perimeter = 0;  // [m]
  double aspect = 1;             // sqrt of the ratio of the principal second moments of area, >= 1; 1 for a chain
  bool opened = false;     // a closed cell with broken bars: area 0 and aspect 1, the centroid is that of its bars
  double orientation = 0;  // of the long axis against x, in (-pi/2, pi/2] [rad]

  /// 4 pi area / perimeter^2 of the outline: 1 for a disk, less for all else; 0 without an outline.
  double circularity() const;
};

CellShape cell_shape(const Sample& sample, const std::vector<Vec2>& x, Index cell);
std::vector<CellShape> cell_shapes(const Sample& sample, const std::vector<Vec2>& x);
/// As they are in the frame: cells may be opened.
std::vector<CellShape> cell_shapes(const FrameView& view);

/// Current area of the cell's tile: the rest tile scaled as the cell, so that gaps stay shared out (that at rest of an
/// opened one); the outline's area where the sample has no tiles [m2].
double tile_area(const Sample& sample, const CellShape& shape, Index cell);

}  // namespace lamella
