#include "generator/tissue/inset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "generator/tissue/crossings.h"
#include "tests/generator/tissue/mosaics.h"

namespace lamella {
namespace {

std::vector<Vec2> inset_corners(const std::vector<Vec2>& polygon, const Inset& inset, double distance) {
  std::vector<Vec2> corners;
  for (const InsetEdge& e : inset.edges) {
    const Vec2 along = (polygon[(e.edge + 1) % polygon.size()] - polygon[e.edge]).normalized();
    corners.push_back(polygon[e.edge] + e.from * along + distance * left_of(along));
  }
  return corners;
}

double area(const std::vector<Vec2>& p) { return polygon_area(p.data(), static_cast<Index>(p.size())); }

/// Oracle: cuts the polygon with the inward half-plane of each of its edges.
std::vector<Vec2> eroded(const std::vector<Vec2>& polygon, double distance) {
  std::vector<Vec2> left = polygon;
  for (std::size_t e = 0; e < polygon.size(); ++e) {
    const Vec2 normal = left_of((polygon[(e + 1) % polygon.size()] - polygon[e]).normalized());
    const double level = normal.dot(polygon[e]) + distance;
    std::vector<Vec2> kept;
    for (std::size_t k = 0; k < left.size(); ++k) {
      const Vec2& a = left[k];
      const Vec2& b = left[(k + 1) % left.size()];
      const double da = normal.dot(a) - level;
      const double db = normal.dot(b) - level;
      if (da >= 0) kept.push_back(a);
      if (da * db < 0) kept.push_back(a + (b - a) * da / (da - db));
    }
    left = kept;
  }
  return left;
}

TEST(Inset, has_the_area_of_the_half_plane_erosion_with_edge_events_and_vanishes_with_it) {
  int events = 0;
  int gone = 0;
  const Mosaic mosaic = voronoi(80, 3, 0.03);
  for (const auto& cell : mosaic.cells) {
    const auto polygon = polygon_of(mosaic, cell);
    for (const double distance : {0.001, 0.01, 0.02, 0.03, 0.05, 0.08}) {
      const Inset inset = inset_polygon(polygon, distance);
      const auto expected = eroded(polygon, distance);
      const double expected_area = expected.size() < 3 ? 0 : area(expected);
      if (inset.outcome == Inset::Outcome::vanished) {
        EXPECT_LT(expected_area, 1e-14);
        EXPECT_LE(vanishing_distance(polygon), distance * (1 + 1e-9));
        ++gone;
        continue;
      }
      ASSERT_EQ(inset.outcome, Inset::Outcome::whole);
      const auto corners = inset_corners(polygon, inset, distance);
      EXPECT_NEAR(area(corners), expected_area, 1e-13);
      EXPECT_GT(vanishing_distance(polygon), distance);
      events += static_cast<int>(polygon.size() - corners.size());
      for (const InsetEdge& edge : inset.edges) EXPECT_LE(edge.from, edge.to);
    }
  }
  EXPECT_GT(events, 20);
  EXPECT_GT(gone, 20);
}

TEST(Inset, loses_s_times_perimeter_less_s_squared_times_the_cotangents_while_no_edge_vanishes) {
  const Mosaic mosaic = voronoi(60, 5, 0.05);
  int checked = 0;
  for (const auto& cell : mosaic.cells) {
    const auto polygon = polygon_of(mosaic, cell);
    const double s = 1e-3;
    const Inset inset = inset_polygon(polygon, s);
    if (inset.edges.size() < polygon.size()) continue;
    ++checked;
    double perimeter = 0;
    double cotangents = 0;
    const std::size_t n = polygon.size();
    for (std::size_t k = 0; k < n; ++k) {
      perimeter += (polygon[(k + 1) % n] - polygon[k]).norm();
      const double interior = std::numbers::pi - turning_angle(polygon[k], polygon[(k + 1) % n], polygon[(k + 2) % n]);
      cotangents += 1 / std::tan(interior / 2);
    }
    EXPECT_NEAR(area(inset_corners(polygon, inset, s)), area(polygon) - s * perimeter + s * s * cotangents, 1e-15);
  }
  EXPECT_GT(checked, 40);
}

TEST(Inset, keeps_straight_corners_and_mitres_concave_ones) {
  const std::vector<Vec2> corner{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const Inset inset = inset_polygon(corner, 0.2);
  ASSERT_EQ(inset.outcome, Inset::Outcome::whole);
  const auto corners = inset_corners(corner, inset, 0.2);
  ASSERT_EQ(corners.size(), 7u);
  EXPECT_NEAR((corners[1] - Vec2(1, 0.2)).norm(), 0, 1e-15);
  EXPECT_NEAR((corners[4] - Vec2(0.8, 0.8)).norm(), 0, 1e-15);
  EXPECT_NEAR(area(corners), 1.6 * 0.6 + 0.6 * 1.0, 1e-14);
}

TEST(Inset, says_when_a_concave_polygon_falls_apart) {
  const std::vector<Vec2> waist{{0, 0}, {1, 0.45}, {2, 0}, {2, 1}, {1, 0.55}, {0, 1}};
  EXPECT_EQ(inset_polygon(waist, 0.1).outcome, Inset::Outcome::split);
  EXPECT_EQ(inset_polygon(waist, 0.01).outcome, Inset::Outcome::whole);
}

TEST(Inset, of_a_dumb_bell_whose_sides_fall_on_one_line_is_split) {
  // Its neck is 5 wide: at 4 all edges of the shrunk polygon lie along each other, and none cross.
  const std::vector<Vec2> bell{{0, 0},   {28, 0},  {28, 12}, {52, 12}, {52, 0},  {80, 0},
                               {80, 29}, {52, 29}, {52, 17}, {28, 17}, {28, 29}, {0, 29}};
  EXPECT_EQ(inset_polygon(bell, 4).outcome, Inset::Outcome::split);
  EXPECT_EQ(inset_polygon(bell, 2).outcome, Inset::Outcome::whole);
}

TEST(Inset, of_a_rectangle_vanishes_at_half_its_width) {
  const std::vector<Vec2> rectangle{{0, 0}, {3, 0}, {3, 1}, {0, 1}};
  EXPECT_NEAR(vanishing_distance(rectangle), 0.5, 1e-15);
  EXPECT_EQ(inset_polygon(rectangle, 0.5).outcome, Inset::Outcome::vanished);
}

TEST(Crossings, are_those_of_brute_force) {
  std::mt19937_64 random(7);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<OwnedSegment> segments;
  for (int k = 0; k < 400; ++k) {
    const Vec2 from(uniform(), uniform());
    const double length = k % 20 == 0 ? 0.5 : 0.05;  // of very unequal lengths
    segments.push_back({from, from + length * Vec2(uniform() - 0.5, uniform() - 0.5), k, -1, -1});
  }
  std::vector<std::pair<int, int>> expected;
  for (int j = 0; j < 400; ++j)
    for (int i = 0; i < j; ++i) {
      const auto& s = segments[i];
      const auto& t = segments[j];
      if (cross(s.to - s.from, t.from - s.from) * cross(s.to - s.from, t.to - s.from) < 0 &&
          cross(t.to - t.from, s.from - t.from) * cross(t.to - t.from, s.to - t.from) < 0)
        expected.emplace_back(i, j);
    }
  std::vector<std::pair<int, int>> found;
  for (const Crossing& c : find_crossings(segments)) found.emplace_back(c.first, c.second);
  EXPECT_GT(expected.size(), 20u);
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace lamella
