#include "generator/packing/laguerre.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "generator/sample/errors.h"
#include "half_planes.h"
#include "random_disks.h"

namespace lamella {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Box kUnit{{0, 0}, {1, 1}};

/// All invariants, the hidden sites and every area, against brute force.
void expect_right(const std::vector<Disk>& disks, const Box& box) {
  const Tessellation t = tessellate(disks, box, {.hidden = Hidden::kReport});
  EXPECT_THAT(check_tessellation(t), IsEmpty());
  std::vector<Index> hidden;
  std::size_t next = 0;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const double area = polygon_area(half_plane_tile(disks, box, {false, false}, i));
    if (area <= 1e-15 * box.area()) {
      hidden.push_back(static_cast<Index>(i));
      continue;
    }
    ASSERT_LT(next, t.tiles.size());
    ASSERT_EQ(t.tiles[next].site, static_cast<Index>(i));
    EXPECT_NEAR(tile_area(t, t.tiles[next++]), area, 1e-13 * box.area()) << "tile " << i;
  }
  EXPECT_EQ(t.hidden, hidden);
}

std::vector<Disk> grid(int columns, int rows, double shift) {
  std::vector<Disk> disks;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      disks.push_back({{(column + 0.5 + (row % 2) * shift) / columns, (row + 0.5) / rows}, 0.3 / columns});
  return disks;
}

TEST(laguerre, one_disk_takes_the_whole_box) {
  const Tessellation t = tessellate({{{0.2, 0.9}, 0.1}}, kUnit);
  ASSERT_EQ(t.tiles.size(), 1u);
  EXPECT_THAT(t.tiles[0].neighbour, ElementsAre(kRightSide, kTopSide, kLeftSide, kBottomSide));
  EXPECT_THAT(check_tessellation(t), IsEmpty());
}

TEST(laguerre, two_disks_share_the_box_at_their_radical_axis) {
  const Tessellation t = tessellate({{{0.25, 0.5}, 0.2}, {{0.75, 0.5}, 0.1}}, kUnit);
  // x = 1/2 + (r0^2 - r1^2) / (2 d)
  EXPECT_NEAR(tile_area(t, t.tiles[0]), 0.53, 1e-15);
  EXPECT_THAT(check_tessellation(t), IsEmpty());
}

TEST(laguerre, agrees_with_cutting_the_box_by_every_half_plane) {
  for (const int count : {2, 3, 4, 5, 10, 100, 400}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE(testing::Message() << count << " disks, seed " << seed);
      expect_right(random_disks(count, 0.2 / std::sqrt(count), seed), kUnit);
      if (count > 100 && seed > 2) break;
    }
  }
}

TEST(laguerre, finds_the_disks_that_overlapping_ones_hide) {
  for (unsigned seed = 0; seed < 5; ++seed) expect_right(random_disks(500, 0.1, seed), kUnit);
  expect_right(random_disks(1000, 0.05, 9), kUnit);
}

TEST(laguerre, few_large_disks_may_own_several_corners_or_push_tiles_out_of_the_box) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    expect_right(random_disks(2 + static_cast<int>(seed % 4), 1, seed), kUnit);
  }
}

TEST(laguerre, one_large_disk_among_two_thousand_times_smaller_ones) {
  std::vector<Disk> disks = random_disks(600, 1e-4, 3);
  disks.push_back({{0.5, 0.5}, 0.2});
  expect_right(disks, kUnit);
}

TEST(laguerre, one_to_four_disks_on_one_line) {
  for (int count = 1; count <= 4; ++count) {
    for (const Vec2& way : {Vec2(1, 0), Vec2(0, 1), Vec2(1, 1), Vec2(-0.3, 0.9)}) {
      std::vector<Disk> disks;
      for (int i = 0; i < count; ++i) disks.push_back({Vec2(0.5, 0.5) + (i - 0.8) / 8 * way, 0.01 * i});
      expect_right(disks, kUnit);
    }
  }
}

TEST(laguerre, disks_on_one_line_make_strips) {
  for (const double slope : {0.0, 0.3, 1.0}) {
    std::vector<Disk> disks;
    for (int i = 0; i < 50; ++i)
      disks.push_back({{0.01 + i / 51.0, 0.2 + slope * 0.7 * (0.01 + i / 51.0)}, 0.001 * (i % 7)});
    SCOPED_TRACE(slope);
    expect_right(disks, kUnit);
  }
  std::vector<Disk> column;
  for (int i = 0; i < 50; ++i) column.push_back({{0.4, (i + 0.5) / 50}, 0.01});
  expect_right(column, kUnit);
}

TEST(laguerre, centres_may_lie_on_the_sides_and_corners_of_the_box) {
  Numbers numbers(5);
  std::vector<Disk> disks = {{{0, 0}, 0.01}, {{1, 0}, 0.01}, {{1, 1}, 0.02}, {{0, 1}, 0}};
  for (int i = 0; i < 400; ++i) {
    const double s = numbers.between(0, 1);
    const Vec2 p = i % 4 == 0 ? Vec2(s, 0) : i % 4 == 1 ? Vec2(1, s) : i % 4 == 2 ? Vec2(s, 1) : Vec2(0, s);
    disks.push_back({p, 0.001});
  }
  expect_right(disks, kUnit);
}

TEST(laguerre, a_wall_along_a_side_of_the_box_belongs_to_the_side) {
  // The radical axis of the two is x = 0: the first has no part in the box.
  const std::vector<Disk> disks = {{{0.25, 0.5}, 0}, {{0.5, 0.5}, std::sqrt(0.1875)}};
  const Tessellation t = tessellate(disks, kUnit, {.hidden = Hidden::kReport});
  EXPECT_THAT(t.hidden, ElementsAre(0));
  EXPECT_THAT(check_tessellation(t), IsEmpty());
}

TEST(laguerre, a_square_lattice_keeps_its_invariants_though_four_disks_are_cocircular_everywhere) {
  for (const int n : {2, 3, 30, 32}) {
    const Tessellation t = tessellate(grid(n, n, 0), kUnit);
    EXPECT_THAT(check_tessellation(t), IsEmpty());
    EXPECT_EQ(t.vertices.size(), static_cast<std::size_t>((n + 1) * (n + 1)));  // four tiles at each inner one
    for (const Tile& tile : t.tiles) {
      EXPECT_EQ(tile.vertex.size(), 4u);
      EXPECT_NEAR(tile_area(t, tile), 1.0 / (n * n), 1e-14);
    }
  }
}

TEST(laguerre, tiles_of_a_hexagonal_lattice_have_six_sides_and_equal_areas) {
  const int columns = 16, rows = 16;
  const Box box{{0, 0}, {1, rows * std::sqrt(0.75) / columns}};
  std::vector<Disk> disks;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      disks.push_back(
          {{(column + 0.25 + 0.5 * (row % 2)) / columns, (row + 0.5) * std::sqrt(0.75) / columns}, 0.4 / columns});
  const Tessellation t = tessellate(disks, box);
  EXPECT_THAT(check_tessellation(t), IsEmpty());
  for (const Tile& tile : t.tiles) {
    if (std::any_of(tile.neighbour.begin(), tile.neighbour.end(), [](Index n) { return n < 0; })) continue;
    EXPECT_EQ(tile.vertex.size(), 6u);
    EXPECT_NEAR(tile_area(t, tile) * columns * columns, std::sqrt(0.75), 1e-12);
  }
}

TEST(laguerre, walls_are_perpendicular_to_the_line_of_centres_and_of_equal_power) {
  const auto disks = random_disks(1000, 0.005, 11);
  const Tessellation t = tessellate(disks, kUnit, {.hidden = Hidden::kReport});
  const double h2 = 1e-3;  // area of a tile
  for (const Tile& tile : t.tiles) {
    for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
      if (tile.neighbour[k] < 0) continue;
      const Disk &a = disks[tile.site], &b = disks[tile.neighbour[k]];
      const Vec2 p = t.vertices[tile.vertex[k]], q = t.vertices[tile.vertex[(k + 1) % tile.vertex.size()]];
      EXPECT_NEAR((p - a.centre).squaredNorm() - a.radius * a.radius,
                  (p - b.centre).squaredNorm() - b.radius * b.radius, 1e-10 * h2);
      const Vec2 d = b.centre - a.centre;
      if ((q - p).norm() < 1e-6 * std::sqrt(h2)) continue;
      EXPECT_LE(std::abs((q - p).dot(d)), 1e-9 * (q - p).norm() * d.norm());
    }
  }
}

TEST(laguerre, a_common_shift_of_all_weights_changes_nothing) {
  auto disks = random_disks(300, 0.01, 2);
  const Tessellation t = tessellate(disks, kUnit, {.hidden = Hidden::kReport});
  for (Disk& disk : disks) disk.radius = std::sqrt(disk.radius * disk.radius + 0.01);
  const Tessellation shifted = tessellate(disks, kUnit, {.hidden = Hidden::kReport});
  ASSERT_EQ(t.tiles.size(), shifted.tiles.size());
  for (std::size_t i = 0; i < t.tiles.size(); ++i)
    EXPECT_NEAR(tile_area(t, t.tiles[i]), tile_area(shifted, shifted.tiles[i]), 1e-12);
}

TEST(laguerre, topology_does_not_depend_on_the_unit_of_length) {
  const auto disks = random_disks(500, 0.01, 4);
  const Tessellation t = tessellate(disks, kUnit, {.hidden = Hidden::kReport});
  for (const double unit : {1e-8, 1e6}) {
    auto scaled = disks;
    for (Disk& disk : scaled) disk.centre *= unit, disk.radius *= unit;
    const Tessellation other = tessellate(scaled, {{0, 0}, {unit, unit}}, {.hidden = Hidden::kReport});
    EXPECT_THAT(check_tessellation(other), IsEmpty());
    for (std::size_t i = 0; i < t.tiles.size(); ++i) {
      const std::multiset<Index> a(t.tiles[i].neighbour.begin(), t.tiles[i].neighbour.end()),
          b(other.tiles[i].neighbour.begin(), other.tiles[i].neighbour.end());
      EXPECT_EQ(a, b);
    }
  }
}

TEST(laguerre, the_same_disks_in_another_order_give_the_same_tiles) {
  auto disks = random_disks(300, 0.02, 8);
  const Tessellation t = tessellate(disks, kUnit);
  std::reverse(disks.begin(), disks.end());
  const Tessellation reversed = tessellate(disks, kUnit);
  for (std::size_t i = 0; i < t.tiles.size(); ++i) {
    const Tile &a = t.tiles[i], &b = reversed.tiles[t.tiles.size() - 1 - i];
    EXPECT_EQ(a.vertex.size(), b.vertex.size());
    EXPECT_NEAR(tile_area(t, a), tile_area(reversed, b), 1e-15);
  }
}

TEST(laguerre, a_quarter_turn_turns_the_tiles) {
  const auto disks = random_disks(400, 0.02, 8);
  for (const Periodic periodic : {Periodic{false, false}, Periodic{true, false}, Periodic{true, true}}) {
    auto turned = disks;
    for (Disk& disk : turned) disk.centre = left_of(disk.centre);
    const Tessellation t = tessellate(disks, kUnit, {.hidden = Hidden::kReport, .periodic = periodic}),
                       u = tessellate(turned, {{-1, 0}, {0, 1}},
                                      {.hidden = Hidden::kReport, .periodic = {periodic[1], periodic[0]}});
    EXPECT_EQ(t.hidden, u.hidden);
    ASSERT_EQ(t.tiles.size(), u.tiles.size());
    for (std::size_t i = 0; i < t.tiles.size(); ++i) {
      std::multiset<Index> a, b;
      for (const Index n : t.tiles[i].neighbour)
        a.insert(n == kLeftSide     ? kBottomSide
                 : n == kBottomSide ? kRightSide
                 : n == kRightSide  ? kTopSide
                 : n == kTopSide    ? kLeftSide
                                    : n);
      b.insert(u.tiles[i].neighbour.begin(), u.tiles[i].neighbour.end());
      EXPECT_EQ(a, b);
      EXPECT_NEAR(tile_area(t, t.tiles[i]), tile_area(u, u.tiles[i]), 1e-13);
    }
  }
}

std::string message_of(const std::vector<Disk>& disks, const Box& box, const LaguerreOptions& options = {}) {
  try {
    tessellate(disks, box, options);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(laguerre, refuses_by_name_what_has_no_tile) {
  EXPECT_THAT(message_of({{{0.5, 0.5}, 0.3}, {{0.52, 0.5}, 0.01}, {{0.1, 0.1}, 0.01}}, kUnit),
              HasSubstr("disk 1 (x = 0.52"));
  EXPECT_THAT(message_of({{{0.5, 0.5}, 0.3}, {{1.5, 0.5}, 0.1}}, kUnit),
              HasSubstr("disk 1 (x = 1.5, y = 0.5, r = 0.1) has its centre outside the box"));
  EXPECT_THAT(message_of({{{0.5, NAN}, 0.3}}, kUnit), HasSubstr("disk 0"));
  EXPECT_THAT(message_of({{{0.5, 0.5}, -0.3}}, kUnit), HasSubstr("not negative"));
  EXPECT_THAT(message_of({}, kUnit), HasSubstr("no disks"));
  EXPECT_THAT(message_of({{{0, 0}, 1}}, {{0, 0}, {0, 1}}), HasSubstr("must be positive"));
}

TEST(laguerre, duplicates_are_named_or_the_first_is_kept) {
  auto disks = random_disks(1013, 0.001, 9);
  std::vector<Index> later;
  for (int k = 0; k < 11; ++k) {
    later.push_back(static_cast<Index>(disks.size()));
    disks.push_back(disks[17 + 90 * k]);
  }
  EXPECT_THAT(message_of(disks, kUnit), HasSubstr("is the same as disk 17"));
  for (const Periodic periodic : {Periodic{false, false}, Periodic{true, false}, Periodic{true, true}}) {
    const Tessellation t = tessellate(disks, kUnit, {.duplicates = Duplicates::kKeepFirst, .periodic = periodic});
    EXPECT_EQ(t.hidden, later);
    EXPECT_THAT(check_tessellation(t), IsEmpty());
  }
}

TEST(laguerre, all_but_one_of_many_copies_are_left_out) {
  const std::vector<Disk> disks(20, {{0.25, 0.5}, 0.1});
  for (const Periodic periodic : {Periodic{false, false}, Periodic{false, true}, Periodic{true, true}}) {
    const Tessellation t = tessellate(disks, kUnit, {.duplicates = Duplicates::kKeepFirst, .periodic = periodic});
    EXPECT_THAT(t.hidden, testing::SizeIs(19));
    ASSERT_THAT(t.tiles, testing::SizeIs(1));
    EXPECT_EQ(t.tiles[0].site, 0);
    EXPECT_THAT(check_tessellation(t), IsEmpty());
  }
}

TEST(laguerre, the_smaller_of_two_disks_with_one_centre_is_hidden) {
  auto disks = random_disks(500, 0.001, 9);
  std::vector<Index> smaller;
  for (Index k = 0; k < 100; ++k) {
    smaller.push_back(5 * k);
    disks.push_back({disks[5 * k].centre, 0.002});
  }
  for (const Periodic periodic : {Periodic{false, false}, Periodic{true, true}})
    EXPECT_EQ(tessellate(disks, kUnit, {.hidden = Hidden::kReport, .periodic = periodic}).hidden, smaller);
}

TEST(laguerre, refuses_boxes_whose_areas_are_beyond_the_numbers) {
  EXPECT_THAT(message_of({{{0, 0}, 1}}, {{0, 0}, {1e-80, 1e-80}}), HasSubstr("from 1e-60 to 1e60 m"));
  EXPECT_THAT(message_of({{{0, 0}, 1}}, {{0, 0}, {1e80, 1}}), HasSubstr("from 1e-60 to 1e60 m"));
  EXPECT_THAT(message_of({{{0.5, 0.5}, 1e200}}, kUnit), HasSubstr("disk 0"));
}

}  // namespace
}  // namespace lamella
