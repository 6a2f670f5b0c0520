// A mosaic: polygons that share walls, before anything is made of them. Tessellations, honeycombs and imported tissues
// all become one, and walls.h turns it into shells.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "generator/sample/polygon.h"
#include "generator/sample/sample.h"

namespace lamella {

struct MosaicCell {
  std::vector<Index> vertex;       // counter-clockwise, into Mosaic::vertices
  std::vector<std::uint8_t> side;  // Side bits of the edge that starts at the vertex of the same place
  std::string name;                // what the user calls it: "site 12"
  std::vector<Image>
      image;  // per vertex, periodic mosaics only: the corner lies at its vertex + displacement(image[k])
  std::string group = "cells";
  double thickness = 1;      // factor on the wall's thickness, and on its radius [1]
  std::int64_t number = -1;  // of the disk, label or polygon that it is made of, as its file counts; -1: of none
};

/// Two cells share the edge (u, v) when one has it from u to v and the other from v to u: shared walls are known by
/// their vertices' ids and never by comparing coordinates. An edge that nobody shares is free.
struct Mosaic {
  Box box;
  Periodic periodic{false, false};
  std::vector<Vec2> vertices;
  std::vector<MosaicCell> cells;
};

/// Where an edge is: the k-th of a cell. cell == -1: nowhere. In a periodic mosaic it is the cell displaced by `image` that has the edge,
/// which may be an image of the very same cell.
struct EdgePlace {
  Index cell = -1;
  Index edge = -1;
  Image image{0, 0};
};

/// For every cell and edge, the same edge seen from the other cell, or cell == -1 for a free edge. Throws
/// SceneError naming both cells when two cells have the same edge in the same direction: they overlap. Edges of a periodic mosaic are the
/// same when they join the same vertices through the same images.
std::vector<std::vector<EdgePlace>> opposite_edges(const Mosaic& mosaic);

/// Of the two cells of a shared edge, the one that comes first: that of lower index, and of a cell beside its own image the edge whose
/// neighbour is displaced forwards. Of `there`, seen from `cell`.
inline bool comes_first(Index cell, const EdgePlace& there) {
  return there.cell > cell || (there.cell == cell && there.image > Image{0, 0});
}

/// Where the k-th corner of a cell is [m].
inline Vec2 corner_of(const Mosaic& mosaic, const MosaicCell& cell, std::size_t k) {
  const Vec2& at = mosaic.vertices[cell.vertex[k]];
  return cell.image.empty() ? at : at + displacement(cell.image[k], mosaic.box);
}

std::vector<Vec2> polygon_of(const Mosaic& mosaic, const MosaicCell& cell);

/// Area-weighted centre of a polygon.
Vec2 polygon_centre(const std::vector<Vec2>& points);

/// Orders the cells by rows of their centres, each from left to right, so that neighbours are near in memory.
void order_by_rows(Mosaic& mosaic);

/// Gives free edges the bits of the box sides that they look at from within 0.6 mean cell diameters: the rough sides of
/// a tissue that does not fill its box. A side beyond which the mosaic repeats is none.
void mark_rough_sides(Mosaic& mosaic);

/// Removes the cells whose centre, or an image of it, lies inside the polygon; their neighbours' walls there become free. Returns how many.
Index remove_cells_inside(Mosaic& mosaic, const std::vector<Vec2>& polygon);

/// What brings a point into a periodic box, and to its images around it: 3 or 9 displacements [m]; (0, 0) alone where nothing repeats.
std::vector<Vec2> ways_home(const Vec2& point, const Box& box, const Periodic& periodic);

}  // namespace lamella
