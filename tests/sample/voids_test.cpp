#include "generator/sample/voids.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/samples.h"

namespace lamella {
namespace {

/// A cell per outline of points, then a wall of one segment per pair.
Sample packed(const std::vector<std::vector<Vec2>>& cells, const std::vector<std::pair<Vec2, Vec2>>& walls, double r) {
  Sample sample;
  for (const auto& points : cells) add_cell(sample, points, true, r, "cells");
  for (const auto& [from, to] : walls) add_cell(sample, {from, to}, false, r, "walls");
  return sample;
}

std::vector<Vec2> circle(const Vec2& centre, double radius, int nodes) {
  std::vector<Vec2> points;
  for (int k = 0; k < nodes; ++k)
    points.push_back(centre + radius * Vec2(std::cos(2 * M_PI * k / nodes), std::sin(2 * M_PI * k / nodes)));
  return points;
}

constexpr double kTop = 6e-3;  // lines miss up to half their distance at a flat top

const std::vector<std::pair<Vec2, Vec2>> kWalls{{{-1, -0.1}, {11, -0.1}},  // floor
                                                {{-0.1, 0}, {-0.1, 20}},   // left
                                                {{10.1, 0}, {10.1, 20}},   // right
                                                {{0, 8.1}, {10, 8.1}},     // lid
                                                {{-1, 15}, {11, 15}}};     // a shelf beyond the lid

TEST(Voids, the_room_ends_at_the_inner_face_of_the_nearest_wall_on_each_side) {
  const Sample sample = packed({circle({3, 3}, 1, 12)}, kWalls, 0.1);
  const auto room = room_between_walls(sample, sample.x);
  ASSERT_TRUE(room);
  EXPECT_NEAR((room->lo - Vec2(0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((room->hi - Vec2(10, 8)).norm(), 0, 1e-12);
}

TEST(Voids, there_is_no_room_without_walls_on_all_sides_or_without_cells) {
  for (std::size_t missing = 0; missing < 3; ++missing) {
    auto walls = kWalls;
    walls.erase(walls.begin() + static_cast<std::ptrdiff_t>(missing));
    const Sample sample = packed({circle({3, 3}, 1, 12)}, walls, 0.1);
    EXPECT_FALSE(room_between_walls(sample, sample.x)) << missing;
  }
  const Sample empty = packed({}, kWalls, 0.1);
  EXPECT_FALSE(room_between_walls(empty, empty.x));
}

TEST(Voids, a_square_with_round_corners_covers_its_area_and_only_what_is_in_the_room) {
  const double r = 0.2;
  const Sample sample = packed({{{1, 1}, {3, 1}, {3, 3}, {1, 3}}}, {}, r);
  const double area = 4 + 8 * r + M_PI * r * r;
  EXPECT_NEAR(covered_area(sample, sample.x, {{0, 0}, {4, 4}}), area, kTop * area);
  EXPECT_NEAR(covered_area(sample, sample.x, {{0, 0}, {2, 4}}), area / 2, kTop * area / 2);
  EXPECT_NEAR(covered_area(sample, sample.x, {{2, 2}, {4, 4}}), area / 4, 2 * kTop * area / 4);
  EXPECT_NEAR(void_ratio(sample, sample.x, {{0, 0}, {4, 4}}), 16 / area - 1, 3 * kTop);
}

TEST(Voids, what_two_cells_share_counts_once) {
  // Two disks of radius 1.2, 2 apart: twice the disk less the lens.
  const double R = 1.2, d = 2;
  const double lens = 2 * R * R * std::acos(d / (2 * R)) - d / 2 * std::sqrt(4 * R * R - d * d);
  const Sample sample = packed({circle({3, 4}, R - 0.2, 400), circle({3 + d, 4}, R - 0.2, 400)}, {}, 0.2);
  EXPECT_NEAR(covered_area(sample, sample.x, {{0, 0}, {8, 8}}), 2 * M_PI * R * R - lens, 1e-3 * 2 * M_PI * R * R);
}

TEST(Voids, a_concave_cell_does_not_cover_its_bay) {
  // A U: 3 x 3 with a bay 1 wide and 2 deep from above.
  const double r = 0.1;
  const Sample sample = packed({{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}}, {}, r);
  // 7 inside, a band along each side, six convex corners; at the two concave ones the bands overlap in r^2.
  const double area = 7 + 16 * r + 6 * M_PI * r * r / 4 - 2 * r * r;
  EXPECT_NEAR(covered_area(sample, sample.x, {{-1, -1}, {4, 4}}), area, kTop * area);
}

}  // namespace
}  // namespace lamella
