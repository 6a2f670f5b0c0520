// Which bars of a sample are gone, and what that does to its shells: an opened cell is a chain, and then several. Geometry
// only; when a bar breaks is the simulator's business (terms/wall_rupture.h).
#pragma once
#include <cstdint>
#include <vector>

#include "generator/sample/sample.h"

namespace lamella {

class BrokenBars {
 public:
  /// None is broken.
  explicit BrokenBars(const Sample& sample) : gone_(sample.nodes(), 0), of_cell_(sample.cells(), 0) {}

  void add(Index cell, Index segment) { gone_[segment] = 1, ++of_cell_[cell], ++count_; }
  bool gone(Index segment) const { return gone_[segment] != 0; }
  /// True where the shell is one no longer: at least one of its bars is gone.
  bool opened(Index cell) const { return of_cell_[cell] > 0; }
  Index count() const { return count_; }
  /// Number of closed cells that are opened.
  Index opened_cells(const Sample& sample) const;
  /// Per segment, 1 where it is gone.
  const std::vector<std::uint8_t>& flags() const { return gone_; }

 private:
  std::vector<std::uint8_t> gone_;  // per segment
  std::vector<Index> of_cell_;      // per cell
  Index count_ = 0;
};

/// The parts into which broken bars have cut the shells: one for a whole cell, two for a cell with two broken bars.
struct Pieces {
  std::vector<Index> of_node;
  Index count = 0;
};
/// Numbered in the order of their first nodes; without broken bars, or with nullptr, a piece is a cell.
Pieces pieces_of(const Sample& sample, const BrokenBars* broken);

/// The link with a tangent of those bars only that still stand: where one is gone, that side of that wall drops out, as it does at
/// a wall's end.
Link with_standing_tangent(const Link& link, const BrokenBars& broken);
/// False where no bar beside the link is left: its frame has no direction.
inline bool has_tangent(const Link& link) { return link.a_prev != link.a_next || link.b_prev != link.b_next; }

}  // namespace lamella
