// A sample: cells as shells of mass points, what they are at rest, and which points are glued to which. The only thing
// that the generator hands on; it knows no stiffness, no load and no time.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "generator/sample/vec.h"

namespace lamella {

/// 32-bit: half the memory traffic of the inner loops, and 2e9 nodes are out of reach of one machine.
using Index = std::int32_t;

/// Sides of the box, as bits of Sample::side.
enum Side : std::uint8_t { kLeft = 1, kRight = 2, kBottom = 4, kTop = 8 };

/// One cohesive link between facing nodes of two cells. Its frame is the current interface: the unit tangent t is along
/// tau = (x[a_next] - x[a_prev]) - (x[b_next] - x[b_prev]) and the normal n = right_of(t) points from a to b,
/// because closed cells run counter-clockwise. At the end of a wall the tangent is one-sided, so that only segments of the
/// linked wall enter it: then a_prev == a or a_next == a. (Open chains may face each other too; the generator
/// orders a and b so that n points from a to b.)
struct Link {
  Index a = 0, b = 0;                 // nodes, a in the cell of lower index
  Index a_prev = 0, a_next = 0;       // tangent stencil, nodes of a's cell in cell order
  Index b_prev = 0, b_next = 0;       // tangent stencil, nodes of b's cell in cell order
  Index wall = 0;                     // wall that the link belongs to
  std::uint8_t wall_end = 0;          // 1 at the two ends of its wall
  double length = 0;                  // tributary length along the wall [m]; half a spacing at a wall's end
  double spacing = 0;                 // length of a full spacing of this wall [m]; W_0 refers to it
  double offset_n = 0, offset_t = 0;  // (x_b - x_a) . n and . t when the link is free of force [m]
};

/// The contact line of two cells: what the tessellation calls an edge.
struct Wall {
  Index cell_a = 0, cell_b = 0;  // cell_a < cell_b, or a cell and its own image
  double length = 0;             // of the shared edge in the tessellation, or of the linked part [m]
};

/// Nodes are stored cell by cell: those of cell c are [cell_begin[c], cell_begin[c + 1]). Segment k joins node k to the
/// next node of the same cell and has the index of its first node; the last node of an open chain starts no segment,
/// and its per-segment entries are 0. Closed cells run counter-clockwise.
struct Sample {
  Box box;  // the domain [m]

  // per node
  std::vector<Vec2> x;               // positions of the centre line [m]
  std::vector<std::uint8_t> side;    // Side bits: the node belongs to a wall that is cut by that side of the box
  std::vector<double> rest_length;   // of the segment that starts here [m]
  std::vector<double> rest_angle;    // turning angle at rest [rad]; 0 where there is no hinge
  std::vector<double> hinge_length;  // tributary length of the hinge [m], half a segment at a clamp; 0: no hinge here

  // per cell
  std::vector<Index> cell_begin;         // cells + 1
  std::vector<std::uint8_t> closed;      // 1 shell, 0 open chain
  std::vector<Index> group;              // into group_names
  std::vector<double> radius;            // Minkowski radius r of the wall's outline [m]
  std::vector<double> rest_area;         // enclosed by the centre line at rest [m2]; 0 for a chain
  std::vector<double> tile_area;         // area of the tessellation's tile, gaps shared out [m2]; 0 for a chain
  std::vector<std::string> group_names;  // "cells" unless the scene names groups

  // What a sample may have beside; empty where it has not.
  Periodic periodic{false, false};  // the box repeats; cells that cross its sides are whole, and lie where they begin
  std::vector<Image>
      link_image;  // per link: b is at x[b] + displacement(image, box); one image for all links of a wall
  std::vector<double> link_strength;   // per link: factor on its strengths [1]
  std::vector<double> cell_thickness;  // per cell: factor on its wall's thickness [1]

  std::vector<Wall> walls;
  std::vector<Link> links;  // sorted by wall, and along it in the order of a's cell

  // provenance
  std::string scene_text;  // the scene that made it, as read
  std::uint64_t seed = 0;

  Index nodes() const { return static_cast<Index>(x.size()); }
  Index cells() const { return static_cast<Index>(cell_begin.size()) - 1; }
  Index cell_size(Index c) const { return cell_begin[c + 1] - cell_begin[c]; }
  Index segments(Index c) const { return cell_size(c) - (closed[c] ? 0 : 1); }
  bool starts_segment(Index c, Index node) const { return closed[c] || node + 1 < cell_begin[c + 1]; }
  /// Next node of the same closed cell, or node + 1 in a chain.
  Index next(Index c, Index node) const { return node + 1 < cell_begin[c + 1] ? node + 1 : cell_begin[c]; }
  Index prev(Index c, Index node) const { return node > cell_begin[c] ? node - 1 : cell_begin[c + 1] - 1; }
};

inline bool is_periodic(const Sample& sample) { return sample.periodic[0] || sample.periodic[1]; }

/// By which b of a link is displaced where it faces a [m].
inline Vec2 link_displacement(const Sample& sample, std::size_t link) {
  return sample.link_image.empty() ? Vec2(0, 0) : displacement(sample.link_image[link], sample.box);
}

/// Images are at most so many box lengths away, in each direction: sums and differences of two still fit.
inline constexpr int kFarthestImage = 60;

/// Adds a cell of `points` at rest where they are: rest lengths, angles, area and hinge lengths are set from them.
/// A closed cell is turned counter-clockwise if it is not. Returns the cell's index.
Index add_cell(Sample& sample, const std::vector<Vec2>& points, bool closed, double radius, const std::string& group);

/// Cell of every node. Shape (nodes).
std::vector<Index> cell_of_node(const Sample& sample);

/// Turning angle at b on the way a -> b -> c, in (-pi, pi].
double turning_angle(const Vec2& a, const Vec2& b, const Vec2& c);

/// Signed area of a closed polygon, positive when counter-clockwise [m2].
double polygon_area(const Vec2* points, Index count);

}  // namespace lamella
