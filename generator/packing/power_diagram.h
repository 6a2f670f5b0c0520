// The unbounded power diagram of disks, as combinatorics and vertex positions. Knows no box. Its source is the only file
// that includes CGAL.
#pragma once
#include <vector>

#include "generator/packing/packing.h"
#include "generator/sample/sample.h"

namespace lamella {

/// The part of the radical axis of disks a and b where both are nearest. Runs from vertex `begin` to vertex `end` with a on its left,
/// that is along left_of(x_b - x_a); a vertex of -1 is at infinity.
struct PowerEdge {
  Index a = 0, b = 0;
  Index begin = -1, end = -1;
};

struct PowerDiagram {
  std::vector<Vec2> vertices;  // one per triangle of the regular triangulation; may lie far away
  std::vector<PowerEdge> edges;
  std::vector<Index> ring_begin;  // disks + 1
  std::vector<Index> ring;        // edges around each disk, counter-clockwise
  std::vector<char> visible;      // per disk: has a cell of its own
};

/// Of the disks listed in `sites` only; all indices are those of `disks`.
PowerDiagram power_diagram(const std::vector<Disk>& disks, const std::vector<Index>& sites);

}  // namespace lamella
