// The Laguerre-Voronoi tessellation of disks, clipped to a box: tile i holds the points p for which |p - x_i|^2 - r_i^2 is
// smallest. Its topology comes from the triangulation (one vertex for each circle orthogonal to three disks or more, for each
// edge cut by a side, for each corner of the box), never from comparing coordinates, so every wall has exactly two sides whatever
// the rounding. Where the box is periodic, in x, in y or in both, tiles are those of the infinite plane: whole, and out
// over the sides of the box.
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
  Periodic periodic{false, false};
};

/// Tessellates the box. Centres lie inside or on it. Periodic: a tile lies where its site is; a vertex and all its images
/// are one vertex, whose position may lie outside the box; a site may border its own images.
/// Throws SceneError naming the disks: outside the box, not finite, duplicates, hidden.
Tessellation tessellate(const std::vector<Disk>& disks, const Box& box, const LaguerreOptions& options = {});

/// The same for weights [m2] in the place of squared radii: they may be negative, and only their differences matter.
Tessellation tessellate(const std::vector<Vec2>& centres, const std::vector<double>& weights, const Box& box,
                        const LaguerreOptions& options = {});

/// A wall between the tiles of sites a and b.
struct TileWall {
  Index a = 0, b = 0;  // a < b, or, between a tile and its own image, a == b and image > {0, 0}
  Image image{0, 0};   // tile a borders tile b as displaced by this
  double length = 0;   // [m]
};

/// What optimal transport needs of a diagram.
struct TileMeasures {
  std::vector<double> area;  // per site [m2]; 0 for one without a tile
  std::vector<Vec2>
      centroid;  // per site [m]; without a tile: the site itself. Periodic: near its site, maybe outside the box
  std::vector<TileWall> walls;
};

/// The measures of tessellate(centres, weights, ...) without its tiles, at less than its cost. Duplicates and hidden sites
/// have no tile, which is no error here. Centres outside a periodic box stand for their images inside.
/// Throws SceneError for numbers that are not finite, and for centres outside a side that is not periodic.
/// `reach`: of a series of nearly the same diagrams, what a periodic one tells the next, to begin with 0; see plane_diagram.
TileMeasures measure_tiles(const std::vector<Vec2>& centres, const std::vector<double>& weights, const Box& box,
                           Periodic periodic = {false, false}, double* reach = nullptr);

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
/// vertices, tiles are convex and counter-clockwise, V - E + F = 1 (periodic: 0), boundary vertices lie on their side.
std::vector<std::string> check_tessellation(const Tessellation& tessellation);

/// The same for what makes tiles those of their sites (before anything is welded): at both ends of every wall the powers
/// |p - x_i|^2 - w_i of its two sites are equal, to 1e-12 of a mean tile's area and to the rounding of coordinates; hence
/// walls are at right angles to the line through the sites. `weights` [m2]: squared radii of disks.
std::vector<std::string> check_powers(const Tessellation& tessellation, const std::vector<Vec2>& centres,
                                      const std::vector<double>& weights);
/// The same of disks, and that a disk which does not overlap its neighbours lies in its tile, to 1e-9 of its radius.
std::vector<std::string> check_disks(const Tessellation& tessellation, const std::vector<Disk>& disks);

}  // namespace lamella
