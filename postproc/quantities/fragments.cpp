#include "postproc/quantities/fragments.h"

#include <algorithm>

#include "generator/sample/union_find.h"
#include "generator/sample/way_round.h"

namespace lamella {
namespace {

UnionFind joined_pieces(const FrameView& view, const Pieces& pieces, Index more) {
  const Sample& sample = view.sample;
  UnionFind joined(pieces.count + more);
  for (std::size_t l = 0; l < sample.links.size(); ++l)
    if (view.intact(static_cast<Index>(l)))
      joined.join(pieces.of_node[sample.links[l].a], pieces.of_node[sample.links[l].b]);
  return joined;
}

}  // namespace

Fragments fragments(const FrameView& view) {
  const Sample& sample = view.sample;
  const Pieces pieces = pieces_of(sample, view.broken_bars());
  UnionFind joined = joined_pieces(view, pieces, 0);
  std::vector<Index> size(pieces.count, 0), roots;  // roots in the order of their lowest piece
  for (Index p = 0; p < pieces.count; ++p)
    if (size[joined.root(p)]++ == 0) roots.push_back(joined.root(p));
  std::stable_sort(roots.begin(), roots.end(), [&](Index a, Index b) { return size[a] > size[b]; });
  std::vector<std::int32_t> rank(pieces.count, 0);
  for (std::size_t k = 0; k < roots.size(); ++k) rank[roots[k]] = static_cast<std::int32_t>(k);

  Fragments result;
  result.count = static_cast<int>(roots.size());
  for (Index i = 0; i < sample.nodes(); ++i) result.of_node.push_back(rank[joined.root(pieces.of_node[i])]);
  for (Index c = 0; c < sample.cells(); ++c) {
    std::vector<std::int32_t> own(result.of_node.begin() + sample.cell_begin[c],
                                  result.of_node.begin() + sample.cell_begin[c + 1]);
    std::sort(own.begin(), own.end());
    std::int32_t best = own.front();
    std::ptrdiff_t most = 0;
    for (auto at = own.begin(); at != own.end();) {
      const auto end = std::upper_bound(at, own.end(), *at);
      if (end - at > most) most = end - at, best = *at;
      at = end;
    }
    result.id.push_back(best);
  }
  return result;
}

namespace {

std::vector<Joint> joints_of(const FrameView& view, const Pieces& pieces) {
  const Sample& sample = view.sample;
  std::vector<Joint> joints;
  for (std::size_t l = 0; l < sample.links.size(); ++l)
    if (view.intact(static_cast<Index>(l)))
      joints.push_back({pieces.of_node[sample.links[l].a], pieces.of_node[sample.links[l].b],
                        sample.link_image.empty() ? Image{0, 0} : sample.link_image[l]});
  return joints;
}

/// Fragments that go round a box which is pulled, across the pull: as many cracks lie between them and their images.
int bands(const FrameView& view, const Fragments& fragments, int axis) {
  const Pieces pieces = pieces_of(view.sample, view.broken_bars());
  std::vector<Index> fragment_of(pieces.count, 0);
  for (Index i = 0; i < view.sample.nodes(); ++i) fragment_of[pieces.of_node[i]] = fragments.of_node[i];
  std::vector<std::vector<Joint>> joints(fragments.count);
  for (const Joint& joint : joints_of(view, pieces)) joints[fragment_of[joint.a]].push_back(joint);
  return static_cast<int>(std::count_if(joints.begin(), joints.end(), [&](const std::vector<Joint>& own) {
    return goes_round(pieces.count, own, 1 - axis);
  }));
}

}  // namespace

bool separated(const FrameView& view, int axis) {
  const Sample& sample = view.sample;
  if (view.box_moves()) {
    const Pieces parts = pieces_of(sample, view.broken_bars());
    return !goes_round(parts.count, joints_of(view, parts), axis);
  }
  const SidePair grip = sides_across(axis);
  const Pieces pieces = pieces_of(sample, view.broken_bars());
  const Index n = pieces.count;
  UnionFind joined = joined_pieces(view, pieces, 2);
  bool low = false, high = false;
  for (Index i = 0; i < sample.nodes(); ++i) {
    if (sample.side[i] & grip.low) joined.join(pieces.of_node[i], n), low = true;
    if (sample.side[i] & grip.high) joined.join(pieces.of_node[i], n + 1), high = true;
  }
  return low && high && joined.root(n) != joined.root(n + 1);
}

int through_cracks(const FrameView& view, const Fragments& pieces, int axis) {
  if (!separated(view, axis)) return 0;
  if (view.box_moves()) return std::max(1, bands(view, pieces, axis));
  const SidePair grip = sides_across(axis), free = sides_across(1 - axis);
  std::vector<std::uint8_t> of_piece(pieces.count, 0);
  for (Index i = 0; i < view.sample.nodes(); ++i) of_piece[pieces.of_node[i]] |= view.sample.side[i];
  const auto between = [&](std::uint8_t s) {
    return !(s & (grip.low | grip.high)) && (s & free.low) && (s & free.high);
  };
  return 1 + static_cast<int>(std::count_if(of_piece.begin(), of_piece.end(), between));
}

}  // namespace lamella
