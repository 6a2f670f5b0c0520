// What is said and drawn of samples that repeat: at the image where it is, whichever is at home.
#include <gtest/gtest.h>

#include <cmath>

#include "postproc/quantities/cell_stress.h"
#include "postproc/quantities/crack_path.h"
#include "postproc/quantities/fragments.h"
#include "postproc/quantities/loop_around.h"
#include "postproc/vtk_meshes.h"
#include "tests/postproc/hexagons.h"
#include "tests/simulator/tissues.h"

namespace lamella {
namespace {

constexpr int kColumns = 5, kRows = 4;
constexpr double kGap = 0.04;

Sample strip() { return hexagons(kRows, kColumns, 4, kGap, {true, false}); }

/// The same with other images of its cells at home.
Sample rehomed(Sample s) {
  const auto shift = [](Index c) { return Image{static_cast<std::int8_t>(c * 7 % 5 - 2), 0}; };
  for (Index c = 0; c < s.cells(); ++c)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) s.x[i] += displacement(shift(c), s.box);
  for (std::size_t l = 0; l < s.links.size(); ++l) {
    const Wall& wall = s.walls[s.links[l].wall];
    s.link_image[l] = s.link_image[l] + shift(wall.cell_a) - shift(wall.cell_b);
  }
  return s;
}

std::vector<Index> between_rows(const Sample& s, int row) {
  std::vector<Index> links;
  for (std::size_t l = 0; l < s.links.size(); ++l) {
    const Wall& wall = s.walls[s.links[l].wall];
    if (wall.cell_a / kColumns == row && wall.cell_b / kColumns == row + 1) links.push_back(static_cast<Index>(l));
  }
  return links;
}

/// The rows from `row` on moved up by this, and the links below them broken.
Frame torn(const Sample& s, int row, double by) {
  std::vector<Vec2> x = s.x;
  for (Index i = s.cell_begin[row * kColumns]; i < s.nodes(); ++i) x[i].y() += by;
  Frame frame = plain_frame(s, x, 2);
  break_links(frame, between_rows(s, row - 1), 1.5);
  return frame;
}

TEST(PeriodicCrack, goes_once_around_and_is_drawn_without_a_jump_wherever_cells_are_at_home) {
  for (const Sample& s : {strip(), rehomed(strip())}) {
    const Frame frame = torn(s, 2, 0.3);
    const std::vector<Crack> cracks = CrackFinder(s, 0).find(FrameView(s, frame));
    ASSERT_EQ(cracks.size(), 1u);
    ASSERT_EQ(cracks[0].lines.size(), 1u);
    const CrackLine& line = cracks[0].lines[0];
    EXPECT_TRUE(cracks[0].from_side_to_side);
    EXPECT_EQ(line.links.size(), between_rows(s, 1).size());
    EXPECT_NEAR(line.opening, 0.3 * std::cos(std::numbers::pi / 6), 1e-9);
    for (std::size_t k = 0; k + 1 < line.points.size(); ++k)
      EXPECT_LT((line.points[k + 1] - line.points[k]).norm(), 0.35) << "the line jumps after point " << k;
    const Vec2 chord = line.reference.back() - line.reference.front();
    EXPECT_NEAR(std::abs(chord.x()), s.box.size().x(), 0.3);
    EXPECT_NEAR(tortuosity(line), 2 / std::sqrt(3.0), 0.05);
  }
}

TEST(PeriodicCrack, that_is_broken_half_way_goes_from_nowhere_to_nowhere) {
  const Sample s = strip();
  Frame frame = plain_frame(s, s.x, 2);
  std::vector<Index> some = between_rows(s, 1);
  some.resize(some.size() / 2);
  break_links(frame, some, 1);
  for (const Crack& crack : CrackFinder(s, 0).find(FrameView(s, frame))) EXPECT_FALSE(crack.from_side_to_side);
}

TEST(PeriodicCrack, around_the_box_leaves_two_fragments) {
  const Sample s = strip();
  const Frame whole = plain_frame(s, s.x, 0), frame = torn(s, 2, 0.3);
  EXPECT_EQ(fragments(FrameView(s, whole)).count, 1);
  EXPECT_EQ(fragments(FrameView(s, frame)).count, 2);
}

TEST(PeriodicMeshes, have_no_link_longer_than_its_gap) {
  for (const Sample& s : {strip(), rehomed(strip())}) {
    const Frame frame = plain_frame(s, s.x, 0);
    const Mesh mesh = links_mesh(FrameView(s, frame));
    ASSERT_EQ(mesh.points.size(), 2 * s.links.size());
    for (std::size_t l = 0; l < s.links.size(); ++l)
      EXPECT_NEAR((mesh.points[2 * l + 1] - mesh.points[2 * l]).norm(), kGap, 1e-12);
  }
}

/// A torus torn below this row, which its box has grown by; or not torn.
Frame torn_box(const Sample& s, const std::vector<int>& rows, double by) {
  std::vector<Vec2> x = s.x;
  std::vector<Index> broken;
  for (const int row : rows) {
    for (Index i = s.cell_begin[row * kColumns]; i < s.nodes(); ++i) x[i].y() += by;
    for (const Index l : between_rows(s, row - 1)) broken.push_back(l);
  }
  Frame frame = plain_frame(s, x, 2);
  const Vec2 size = s.box.size() + Vec2(0, by * static_cast<double>(rows.size()));
  frame.arrays.add({"box_size", "m", "model", 1, std::vector<double>{size.x(), size.y()}});
  if (!broken.empty()) break_links(frame, broken, 1.5);
  return frame;
}

TEST(PulledBox, is_drawn_and_judged_by_its_lengths_in_the_frame) {
  const Sample s = hexagons(kRows, kColumns, 4, kGap, {true, true});
  const Frame whole = torn_box(s, {}, 0), one = torn_box(s, {2}, 0.3), two = torn_box(s, {1, 3}, 0.3);
  const FrameView before(s, whole), view(s, one), twice(s, two);
  EXPECT_FALSE(separated(before, 1));
  EXPECT_EQ(through_cracks(before, fragments(before), 1), 0);
  // One crack leaves one piece, which goes round across the pull, and not along it.
  EXPECT_EQ(fragments(view).count, 1);
  EXPECT_TRUE(separated(view, 1));
  EXPECT_FALSE(separated(view, 0));
  EXPECT_EQ(through_cracks(view, fragments(view), 1), 1);
  EXPECT_EQ(fragments(twice).count, 2);
  EXPECT_EQ(through_cracks(twice, fragments(twice), 1), 2);
  // Links that hold are as long as they were, through the sides too.
  const Mesh mesh = links_mesh(view);
  for (std::size_t l = 0; l < s.links.size(); ++l) {
    if (!view.intact(static_cast<Index>(l))) continue;
    EXPECT_NEAR((mesh.points[2 * l + 1] - mesh.points[2 * l]).norm(), kGap, 1e-12);
  }
  const std::vector<Crack> cracks = CrackFinder(s, 0).find(view);
  ASSERT_EQ(cracks.size(), 1u);
  EXPECT_TRUE(cracks[0].from_side_to_side);
  EXPECT_NEAR(cracks[0].lines[0].opening, 0.3 * std::cos(std::numbers::pi / 6), 1e-9);
}

TEST(PeriodicStress, of_cells_does_not_depend_on_which_image_is_at_home) {
  const Sample s = strip(), t = rehomed(s);
  const auto stresses = [](const Sample& of) {
    Frame frame = plain_frame(of, of.x, 0);
    std::vector<double> force;
    for (std::size_t l = 0; l < of.links.size(); ++l)
      force.push_back(std::sin(3.0 * static_cast<double>(l))), force.push_back(std::cos(static_cast<double>(l)));
    ArraySet arrays;
    arrays.add({"x", "m", "node", 2, rows_from(field_of(of.x))});
    arrays.add({"link_force", "N", "link", 2, force});
    frame.arrays = arrays;
    const FrameView view(of, frame);
    return cell_stress(view, cell_shapes(view), 1);
  };
  const auto a = stresses(s), b = stresses(t);
  double largest = 0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    EXPECT_NEAR(a[c].xx, b[c].xx, 1e-12);
    EXPECT_NEAR(a[c].yy, b[c].yy, 1e-12);
    EXPECT_NEAR(a[c].xy, b[c].xy, 1e-12);
    largest = std::max(largest, std::abs(a[c].xx));
  }
  EXPECT_GT(largest, 0.1);
}

TEST(LoopAround, is_the_shortest_closed_way_that_goes_around_once) {
  // A ring 0-1-2-3 around, with a bridge 1-3 that is shorter than over 2, and a loop that closes without going around.
  std::vector<WoundEdge> edges{{0, 1, 1, 0}, {1, 2, 1, 0}, {2, 3, 1, 0}, {3, 0, 1, 1}, {1, 3, 1.5, 0}, {2, 0, 9, 0}};
  EXPECT_EQ(shortest_loop_around(edges), (std::vector<Index>{3, 0, 4}));
  edges[4].length = 2.5;
  EXPECT_EQ(shortest_loop_around(edges), (std::vector<Index>{3, 0, 1, 2}));
  edges[3].around = 0;
  EXPECT_TRUE(shortest_loop_around(edges).empty());
  EXPECT_EQ(shortest_loop_around({{7, 7, 1, -1}}), (std::vector<Index>{0}));  // a wall that ends where it begins
  EXPECT_TRUE(shortest_loop_around({}).empty());
}

}  // namespace
}  // namespace lamella
