#include "postproc/quantities/crack_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/postproc/hexagons.h"

namespace lamella {
namespace {

/// All links between two rows of a tissue.
std::vector<Index> between_rows(const Sample& sample, int columns, int row) {
  std::vector<Index> links;
  for (std::size_t l = 0; l < sample.links.size(); ++l) {
    const Wall& wall = sample.walls[sample.links[l].wall];
    if (wall.cell_a / columns == row && wall.cell_b / columns == row + 1) links.push_back(static_cast<Index>(l));
  }
  return links;
}

double length_of(const Sample& sample, const std::vector<Index>& links) {
  double sum = 0;
  for (Index l : links) sum += sample.links[l].length;
  return sum;
}

TEST(CrackPath, an_intact_tissue_has_none) {
  const Sample sample = hexagon_tissue(3, 3, 1, 3, 0.05);
  const Frame frame = plain_frame(sample, sample.x, 0);
  EXPECT_TRUE(CrackFinder(sample, 0).find(FrameView(sample, frame)).empty());
}

TEST(CrackPath, a_cut_between_two_rows_is_one_line_from_side_to_side) {
  constexpr int kColumns = 5;
  const Sample sample = hexagon_tissue(kColumns, 3, 1, 4, 0.02);
  std::vector<Vec2> x = sample.x;
  const std::vector<Index> cell_of = cell_of_node(sample);
  const double gap = 0.3;
  for (Index i = 0; i < sample.nodes(); ++i)
    if (cell_of[i] >= kColumns) x[i].y() += gap;
  Frame frame = plain_frame(sample, x, 2);
  const std::vector<Index> torn = between_rows(sample, kColumns, 0);
  break_links(frame, torn, 1.5);
  const std::vector<Crack> cracks = CrackFinder(sample, 0).find(FrameView(sample, frame));
  ASSERT_EQ(cracks.size(), 1u);
  const Crack& crack = cracks[0];
  ASSERT_EQ(crack.lines.size(), 1u);
  EXPECT_TRUE(crack.from_side_to_side);
  EXPECT_EQ(crack.links, static_cast<int>(torn.size()));
  EXPECT_NEAR(crack.length, length_of(sample, torn), 1e-12);
  EXPECT_DOUBLE_EQ(crack.first_time, 1.5);
  // the walls of the zigzag stand at 60 degrees to the pull
  EXPECT_NEAR(crack.opening, gap * std::cos(M_PI / 6), 1e-9);
  // a zigzag of height L / 2, uniformly: its rms is L / 2 / sqrt 12, but for its ends
  EXPECT_NEAR(roughness(crack.lines[0]), 0.5 / std::sqrt(12.0), 0.1 * 0.5 / std::sqrt(12.0));
  EXPECT_NEAR(tortuosity(crack.lines[0]), 2 / std::sqrt(3.0), 0.05);
  for (std::size_t k = 0; k + 1 < crack.lines[0].points.size(); ++k)
    EXPECT_LT((crack.lines[0].points[k + 1] - crack.lines[0].points[k]).norm(), 0.3)
        << "the line jumps after point " << k;
}

TEST(CrackPath, a_crack_that_stops_within_a_wall_ends_there) {
  const Sample sample = hexagon_tissue(2, 1, 1, 4, 0.02);
  Frame frame = plain_frame(sample, sample.x, 1);
  const std::vector<Index> wall = links_between(sample, 0, 1);
  ASSERT_EQ(wall.size(), 5u);
  break_links(frame, {wall[1], wall[2]}, 1);
  const std::vector<Crack> cracks = CrackFinder(sample, 1).find(FrameView(sample, frame));
  ASSERT_EQ(cracks.size(), 1u);
  EXPECT_EQ(cracks[0].lines[0].points.size(), 2u);
  EXPECT_FALSE(cracks[0].from_side_to_side);
}

TEST(CrackPath, separate_runs_in_one_wall_are_separate_cracks) {
  const Sample sample = hexagon_tissue(2, 1, 1, 4, 0.02);
  Frame frame = plain_frame(sample, sample.x, 1);
  const std::vector<Index> wall = links_between(sample, 0, 1);
  break_links(frame, {wall[0], wall[3], wall[4]}, 1);
  EXPECT_EQ(CrackFinder(sample, 1).find(FrameView(sample, frame)).size(), 2u);
}

TEST(CrackPath, three_walls_at_a_junction_are_one_crack_with_a_branch) {
  const Sample sample = hexagon_tissue(2, 2, 1, 4, 0.02);
  Frame frame = plain_frame(sample, sample.x, 1);
  // cells 0, 1 below and 2 above meet in a point
  std::vector<Index> torn;
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}})
    for (Index l : links_between(sample, a, b)) torn.push_back(l);
  break_links(frame, torn, 1);
  const std::vector<Crack> cracks = CrackFinder(sample, 0).find(FrameView(sample, frame));
  ASSERT_EQ(cracks.size(), 1u);
  EXPECT_EQ(cracks[0].lines.size(), 2u);
  EXPECT_EQ(cracks[0].links, static_cast<int>(torn.size()));
}

TEST(CrackPath, a_cell_torn_out_on_all_sides_is_a_loop_with_every_link_once) {
  const Sample sample = hexagon_tissue(3, 3, 1, 3, 0.02);
  Frame frame = plain_frame(sample, sample.x, 1);
  std::vector<Index> torn;
  for (Index other = 0; other < sample.cells(); ++other)
    if (other != 4)
      for (Index l : links_between(sample, 4, other)) torn.push_back(l);
  break_links(frame, torn, 1);
  const std::vector<Crack> cracks = CrackFinder(sample, 0).find(FrameView(sample, frame));
  ASSERT_EQ(cracks.size(), 1u);
  std::vector<Index> found;
  for (const CrackLine& line : cracks[0].lines) found.insert(found.end(), line.links.begin(), line.links.end());
  std::sort(found.begin(), found.end()), std::sort(torn.begin(), torn.end());
  EXPECT_EQ(found, torn);
}

TEST(CrackPath, a_straight_crack_is_smooth) {
  const Sample sample = two_squares(0.1);
  Frame frame = plain_frame(sample, sample.x, 1);
  break_links(frame, {0, 1}, 1);
  const std::vector<Crack> cracks = CrackFinder(sample, 1).find(FrameView(sample, frame));
  ASSERT_EQ(cracks.size(), 1u);
  EXPECT_NEAR(roughness(cracks[0].lines[0]), 0, 1e-12);
  EXPECT_NEAR(tortuosity(cracks[0].lines[0]), 1, 1e-12);
}

}  // namespace
}  // namespace lamella
