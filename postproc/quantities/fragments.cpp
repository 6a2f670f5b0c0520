#include "postproc/quantities/fragments.h"

#include <algorithm>

#include "postproc/quantities/union_find.h"

namespace lamella {
namespace {

UnionFind joined_cells(const FrameView& view, Index more) {
  const Sample& sample = view.sample;
  UnionFind cells(sample.cells() + more);
  for (std::size_t l = 0; l < sample.links.size(); ++l)
    if (view.intact(static_cast<Index>(l))) {
      const Wall& wall = sample.walls[sample.links[l].wall];
      cells.join(wall.cell_a, wall.cell_b);
    }
  return cells;
}

}  // namespace

Fragments fragments(const FrameView& view) {
  const Index n = view.sample.cells();
  UnionFind cells = joined_cells(view, 0);
  std::vector<Index> size(n, 0), roots;  // roots in the order of their lowest cell
  for (Index c = 0; c < n; ++c)
    if (size[cells.root(c)]++ == 0) roots.push_back(cells.root(c));
  std::stable_sort(roots.begin(), roots.end(), [&](Index a, Index b) { return size[a] > size[b]; });
  std::vector<std::int32_t> rank(n, 0);
  for (std::size_t k = 0; k < roots.size(); ++k) rank[roots[k]] = static_cast<std::int32_t>(k);
  Fragments result;
  result.count = static_cast<int>(roots.size());
  result.id.resize(n);
  for (Index c = 0; c < n; ++c) result.id[c] = rank[cells.root(c)];
  return result;
}

std::vector<std::uint8_t> cell_sides(const Sample& sample) {
  std::vector<std::uint8_t> sides(sample.cells(), 0);
  for (Index c = 0; c < sample.cells(); ++c)
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) sides[c] |= sample.side[i];
  return sides;
}

bool separated(const FrameView& view, int axis) {
  const Index n = view.sample.cells();
  const SidePair grip = sides_across(axis);
  const std::vector<std::uint8_t> sides = cell_sides(view.sample);
  UnionFind cells = joined_cells(view, 2);
  bool low = false, high = false;
  for (Index c = 0; c < n; ++c) {
    if (sides[c] & grip.low) cells.join(c, n), low = true;
    if (sides[c] & grip.high) cells.join(c, n + 1), high = true;
  }
  return low && high && cells.root(n) != cells.root(n + 1);
}

int through_cracks(const FrameView& view, const Fragments& pieces, int axis) {
  if (!separated(view, axis)) return 0;
  const SidePair grip = sides_across(axis), free = sides_across(1 - axis);
  const std::vector<std::uint8_t> sides = cell_sides(view.sample);
  std::vector<std::uint8_t> of_piece(pieces.count, 0);
  for (Index c = 0; c < view.sample.cells(); ++c) of_piece[pieces.id[c]] |= sides[c];
  const auto between = [&](std::uint8_t s) {
    return !(s & (grip.low | grip.high)) && (s & free.low) && (s & free.high);
  };
  return 1 + static_cast<int>(std::count_if(of_piece.begin(), of_piece.end(), between));
}

}  // namespace lamella
