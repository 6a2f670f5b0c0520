#include "generator/sample/broken_bars.h"

namespace lamella {

Index BrokenBars::opened_cells(const Sample& sample) const {
  Index opened = 0;
  for (Index c = 0; c < sample.cells(); ++c) opened += sample.closed[c] && of_cell_[c] > 0 ? 1 : 0;
  return opened;
}

Pieces pieces_of(const Sample& sample, const BrokenBars* broken) {
  Pieces pieces;
  pieces.of_node.resize(sample.nodes());
  for (Index c = 0; c < sample.cells(); ++c) {
    const Index begin = sample.cell_begin[c], end = sample.cell_begin[c + 1];
    const Index first = pieces.count++;
    for (Index i = begin; i < end; ++i) {
      if (broken && i > begin && broken->gone(i - 1)) ++pieces.count;
      pieces.of_node[i] = pieces.count - 1;
    }
    // The last nodes of a closed cell go on in its first.
    const Index last = pieces.count - 1;
    if (!broken || !sample.closed[c] || last == first || broken->gone(end - 1)) continue;
    for (Index i = end - 1; pieces.of_node[i] == last; --i) pieces.of_node[i] = first;
    --pieces.count;
  }
  return pieces;
}

Link with_standing_tangent(const Link& link, const BrokenBars& broken) {
  Link out = link;
  if (link.a_prev != link.a && broken.gone(link.a_prev)) out.a_prev = link.a;
  if (link.a_next != link.a && broken.gone(link.a)) out.a_next = link.a;
  if (link.b_prev != link.b && broken.gone(link.b_prev)) out.b_prev = link.b;
  if (link.b_next != link.b && broken.gone(link.b)) out.b_next = link.b;
  return out;
}

}  // namespace lamella
