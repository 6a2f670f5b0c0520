#include "postproc/quantities/fragments.h"

#include <gtest/gtest.h>

#include "tests/postproc/hexagons.h"

namespace lamella {
namespace {

TEST(Fragments, an_intact_tissue_is_one_piece) {
  const Sample sample = hexagon_tissue(4, 3, 1, 3, 0.05);
  const Frame frame = plain_frame(sample, sample.x, 0);
  const FrameView view(sample, frame);
  EXPECT_EQ(fragments(view).count, 1);
  EXPECT_FALSE(separated(view, 0));
  EXPECT_FALSE(separated(view, 1));
}

TEST(Fragments, the_largest_fragment_is_number_zero) {
  const Sample sample = hexagon_tissue(3, 1, 1, 3, 0.05);
  Frame frame = plain_frame(sample, sample.x, 0);
  break_links(frame, links_between(sample, 0, 1), 0);
  const Fragments pieces = fragments(FrameView(sample, frame));
  EXPECT_EQ(pieces.count, 2);
  EXPECT_EQ(pieces.id, (std::vector<std::int32_t>{1, 0, 0}));
}

TEST(Fragments, one_intact_link_still_joins) {
  const Sample sample = hexagon_tissue(2, 1, 1, 3, 0.05);
  Frame frame = plain_frame(sample, sample.x, 0);
  std::vector<Index> links = links_between(sample, 0, 1);
  links.pop_back();
  break_links(frame, links, 0);
  EXPECT_FALSE(separated(FrameView(sample, frame), 0));
}

TEST(Fragments, each_cut_across_a_strip_is_a_through_crack) {
  const Sample sample = hexagon_tissue(4, 1, 1, 3, 0.05);
  Frame frame = plain_frame(sample, sample.x, 0);
  const auto count = [&] {
    const FrameView view(sample, frame);
    return through_cracks(view, fragments(view), 0);
  };
  EXPECT_EQ(count(), 0);
  break_links(frame, links_between(sample, 0, 1), 0);
  EXPECT_EQ(count(), 1);
  break_links(frame, links_between(sample, 2, 3), 0);
  EXPECT_EQ(count(), 2);
}

TEST(Fragments, grips_whose_own_cells_part_are_still_one_grip) {
  const Sample sample = hexagon_tissue(2, 2, 1, 3, 0.05);
  Frame frame = plain_frame(sample, sample.x, 0);
  // only the path 0 - 2 is left between bottom (0, 1) and top (2, 3)
  for (const auto& [a, b] : {std::pair{0, 1}, {2, 3}, {1, 2}, {1, 3}})
    break_links(frame, links_between(sample, a, b), 0);
  EXPECT_FALSE(separated(FrameView(sample, frame), 1));
}

/// Bars of the frame's cells are broken.
void break_bars(Frame& frame, const Sample& sample, const std::vector<Index>& bars) {
  std::vector<std::int32_t> broken(sample.nodes(), 0);
  for (Index bar : bars) broken[bar] = 1;
  frame.arrays.add({"bar_broken", "1", "segment", 1, broken});
}

TEST(Fragments, a_cell_with_two_broken_bars_is_in_two_pieces) {
  // Three hexagons in a row; the second is cut between its left and its right wall.
  const Sample sample = hexagon_tissue(3, 1, 1, 3, 0.05);
  const auto middle = [&](Index bar) { return Vec2(0.5 * (sample.x[bar] + sample.x[sample.next(1, bar)])); };
  Vec2 centre = Vec2::Zero();
  for (Index i = sample.cell_begin[1]; i < sample.cell_begin[2]; ++i) centre += sample.x[i] / sample.cell_size(1);
  Index low = sample.cell_begin[1], high = low;  // bars nearest to straight below and above
  const auto off = [&](Index bar, double side) { return (middle(bar) - centre - Vec2(0.1, side)).norm(); };
  for (Index i = sample.cell_begin[1]; i < sample.cell_begin[2]; ++i) {
    if (off(i, -1) < off(low, -1)) low = i;
    if (off(i, 1) < off(high, 1)) high = i;
  }
  Frame once = plain_frame(sample, sample.x, 0), twice = once;
  break_bars(once, sample, {low}), break_bars(twice, sample, {low, high});
  EXPECT_EQ(fragments(FrameView(sample, once)).count, 1);
  EXPECT_FALSE(separated(FrameView(sample, once), 0));
  const FrameView view(sample, twice);
  const Fragments pieces = fragments(view);
  EXPECT_EQ(pieces.count, 2);
  EXPECT_NE(pieces.id[0], pieces.id[2]);
  EXPECT_TRUE(separated(view, 0));
  EXPECT_EQ(through_cracks(view, pieces, 0), 1);
}

}  // namespace
}  // namespace lamella
