// The Laguerre-Voronoi tessellation of disks, clipped to a box: tile i holds the points p for which |p - x_i|^2 - r_i^2 is
// smallest. Its topology comes from the triangulation (one vertex per triangle, per edge cut by a side, per corner of
// the box), never from comparing coordinates, so every wall has exactly two sides whatever the rounding.
#pragma once
#include <vector>

#include "generator/packing/packing.h"
#include "generator/sample/sample.h"
#include "generator/sample/vec.h"

namespace lamella {

/// What lies across an edge on the boundary of the box, instead of a site: Tile::neighbour is one of these.
enum BoxSide : Index { kLeftSide = -1, kRightSide = -2, kBottomSide = -3, kTopSide = -4 };

/// A convex polygon.
struct Tile {
  Index site = 0;                // index of its disk
  std::vector<Index> vertex;     // ids into Tessellation::vertices, counter-clockwise
  std::vector<Index> neighbour;  // across the edge vertex[k] -> vertex[k + 1]: a site, or a BoxSide (negative)
  std::vector<Image>
      image;  // per vertex, periodic only: the corner lies at vertices[vertex[k]] + displacement(image[k])
  std::vector<Image> across;  // per edge, periodic only: the neighbour's tile borders as displaced by this
};

struct Tessellation {
  Box box;
  Periodic periodic{false, false};
  std::vector<Vec2> vertices;  // [m]
  std::vector<Tile> tiles;     // in the order of their sites; one per disk that is not in `hidden`
  std::vector<Index>
      hidden;  // sites without a tile: hidden by larger disks, left out as duplicates, or with their tile outside the box
};

enum class Duplicates { kRefuse, kKeepFirst };  // same centre and same radius
enum class Hidden { kRefuse, kReport };

struct LaguerreOptions {
  Duplicates duplicates = Duplicates::kRefuse;
  Hidden hidden = Hidden::kRefuse;
};

/// Tessellates the box. Centres lie inside or on it. A periodic packing is tessellated as the disks it lists, without images.
/// Throws SceneError naming the disks: outside the box, not finite, duplicates, hidden.
Tessellation tessellate(const std::vector<Disk>& disks, const Box& box, const LaguerreOptions& options = {});

/// Where the k-th corner of a tile is [m].
Vec2 corner(const Tessellation& tessellation, const Tile& tile, std::size_t k);

/// Area of a tile [m2], summed about its first vertex so that small tiles far from the origin keep their digits.
double tile_area(const Tessellation& tessellation, const Tile& tile);
/// Centre of area of a tile [m].
Vec2 tile_centroid(const Tessellation& tessellation, const Tile& tile);
/// Length of the edge vertex[k] -> vertex[k + 1] [m].
double edge_length(const Tessellation& tessellation, const Tile& tile, std::size_t k);
/// Mean length of the edges between two tiles [m]; 0 when there are none.
double mean_edge_length(const Tessellation& tessellation);

/// Every violated invariant in words (empty: all hold): areas sum to the box, each wall has two sides with the same two
/// vertices, tiles are convex and counter-clockwise, V - E + F = 1, boundary vertices lie on their side.
std::vector<std::string> check_tessellation(const Tessellation& tessellation);

}  // namespace lamella
