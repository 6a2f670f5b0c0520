// The unbounded power diagram of weighted sites, as combinatorics and vertex positions. Knows no box. Its source is the only
// file that includes CGAL.
#pragma once
#include <vector>

#include "generator/sample/sample.h"
#include "generator/sample/vec.h"

namespace lamella {

struct PowerSite {
  Vec2 centre = Vec2::Zero();  // [m]
  double weight = 0;           // squared radius of a disk [m2]; may be negative
};

/// Cells of the first `wanted` sites. Vertices are those of the diagram itself: where more than three cells meet in a point,
/// which exact arithmetic decides, there is one vertex and no edge without length.
///
/// The k-th edge of a cell is the part of the radical axis with site ring_site[k] where both are nearest. It starts at
/// vertex ring_vertex[k] and ends where the next one, cyclically, starts; -1 is infinity. Edges run counter-clockwise.
struct PowerDiagram {
  std::vector<Vec2> vertices;
  std::vector<Index> order;                 // the wanted sites that have a cell, neighbours near each other in memory
  std::vector<Index> ring_begin, ring_end;  // per wanted site: its edges; none for a hidden site, or for one alone
  std::vector<Index> ring_site, ring_vertex;

  /// Sites around a vertex, for those vertices that are corners of cells that are not wanted, too.
  std::vector<Index> member_begin;  // vertices + 1
  std::vector<Index> member;

  Index next(Index site, Index k) const { return k + 1 < ring_end[site] ? k + 1 : ring_begin[site]; }
};

PowerDiagram power_diagram(const std::vector<PowerSite>& sites, Index wanted);

}  // namespace lamella
