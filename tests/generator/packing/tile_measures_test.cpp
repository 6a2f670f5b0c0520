#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "generator/packing/laguerre.h"
#include "generator/sample/errors.h"
#include "random_disks.h"

namespace lamella {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const Box kBox{{-1, 2}, {1, 3}};
const std::vector<Periodic> kAll{{false, false}, {true, false}, {false, true}, {true, true}};

struct Sites {
  std::vector<Vec2> centres;
  std::vector<double> weights;

  Sites(int count, double spread, unsigned seed) {
    Numbers numbers(seed);
    for (int i = 0; i < count; ++i) {
      const double x = numbers.between(-1, 1), y = numbers.between(2, 3);
      centres.emplace_back(x, y);
      weights.push_back(numbers.between(-spread, spread));
    }
  }
};

TEST(tile_measures, are_those_of_the_tiles_to_the_bit) {
  for (const Periodic& periodic : kAll) {
    for (const int count : {1, 2, 3, 10, 1000}) {
      const Sites s(count, 0.1 / count, 3);
      const TileMeasures m = measure_tiles(s.centres, s.weights, kBox, periodic);
      const Tessellation t = tessellate(s.centres, s.weights, kBox, {.hidden = Hidden::kReport, .periodic = periodic});
      EXPECT_THAT(check_tessellation(t), IsEmpty());
      std::map<std::tuple<Index, Index, Image>, double> walls;
      for (const TileWall& wall : m.walls) walls[{wall.a, wall.b, wall.image}] = wall.length;
      EXPECT_EQ(walls.size(), m.walls.size());
      std::size_t sides = 0;
      for (const Tile& tile : t.tiles) {
        EXPECT_EQ(m.area[tile.site], tile_area(t, tile));
        EXPECT_EQ(m.centroid[tile.site], tile_centroid(t, tile));
        for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
          if (tile.neighbour[k] < 0) continue;
          ++sides;
          Image image = periodic[0] || periodic[1] ? tile.across[k] : Image{0, 0};
          Index a = tile.site, b = tile.neighbour[k];
          if (std::pair(b, image) < std::pair(a, Image{0, 0})) {
            std::swap(a, b);
            image = {static_cast<std::int8_t>(-image[0]), static_cast<std::int8_t>(-image[1])};
          }
          ASSERT_TRUE(walls.count({a, b, image}));
          EXPECT_NEAR((walls[{a, b, image}]), edge_length(t, tile, k), 1e-15);
        }
      }
      EXPECT_EQ(sides, 2 * walls.size());
      for (const Index i : t.hidden) EXPECT_EQ(m.area[i], 0);
    }
  }
}

TEST(tile_measures, only_differences_of_weights_matter) {
  const Sites s(300, 0.001, 1);
  auto shifted = s.weights;
  for (double& w : shifted) w -= 0.25;
  for (const Periodic& periodic : kAll) {
    const TileMeasures m = measure_tiles(s.centres, s.weights, kBox, periodic),
                       n = measure_tiles(s.centres, shifted, kBox, periodic);
    ASSERT_EQ(m.walls.size(), n.walls.size());
    for (std::size_t i = 0; i < m.area.size(); ++i) EXPECT_NEAR(m.area[i], n.area[i], 1e-12);
  }
}

TEST(tile_measures, weights_of_any_spread_leave_areas_that_sum_to_the_box) {
  for (const Periodic& periodic : kAll) {
    for (const double spread : {1e-6, 1e-3, 0.1, 10.0}) {
      const Sites s(400, spread, 8);
      const TileMeasures m = measure_tiles(s.centres, s.weights, kBox, periodic);
      double sum = 0;
      for (const double a : m.area) sum += a;
      EXPECT_NEAR(sum, kBox.area(), 1e-12 * kBox.area());
    }
  }
}

// d A_i / d w_j = -L_ij / (2 d_ij), and the sum of these for the site itself.
TEST(tile_measures, change_with_the_weights_as_the_laplacian_says) {
  for (const Periodic& periodic : kAll) {
    for (const int count : {2, 3, 5, 100}) {
      const Sites s(count, 0.1 / count, 5);
      const TileMeasures m = measure_tiles(s.centres, s.weights, kBox, periodic);
      for (int j = 0; j < std::min(count, 10); ++j) {
        std::vector<double> slope(s.weights.size(), 0);
        for (const TileWall& wall : m.walls) {
          if (wall.a == wall.b || (wall.a != j && wall.b != j)) continue;
          const Vec2 way = s.centres[wall.b] + displacement(wall.image, kBox) - s.centres[wall.a];
          const double share = wall.length / (2 * way.norm());
          slope[wall.a == j ? wall.b : wall.a] -= share;
          slope[j] += share;
        }
        const double step = 1e-6 / count;
        auto more = s.weights, less = s.weights;
        more[j] += step, less[j] -= step;
        const auto up = measure_tiles(s.centres, more, kBox, periodic).area,
                   down = measure_tiles(s.centres, less, kBox, periodic).area;
        for (std::size_t i = 0; i < slope.size(); ++i)
          EXPECT_NEAR((up[i] - down[i]) / (2 * step), slope[i], 1e-6) << "site " << i << " of " << count;
      }
    }
  }
}

TEST(tile_measures, walls_of_a_tile_with_no_side_of_the_box_close) {
  const Sites s(500, 1e-4, 2);
  const Periodic torus{true, true};
  const TileMeasures m = measure_tiles(s.centres, s.weights, kBox, torus);
  std::vector<Vec2> sum(s.centres.size(), Vec2::Zero());
  for (const TileWall& wall : m.walls) {
    const Vec2 normal = (s.centres[wall.b] + displacement(wall.image, kBox) - s.centres[wall.a]).normalized();
    sum[wall.a] += wall.length * normal;
    sum[wall.b] -= wall.length * normal;
  }
  for (const Vec2& v : sum) EXPECT_LE(v.norm(), 1e-12);
}

TEST(tile_measures, sites_outside_a_periodic_box_stand_for_their_images_inside) {
  const Periodic torus{true, true};
  const Sites s(200, 1e-4, 2);
  auto moved = s.centres;
  Numbers numbers(1);
  std::vector<Vec2> by;
  for (Vec2& centre : moved) {
    by.emplace_back(2 * std::floor(numbers.between(-5, 6)), std::floor(numbers.between(-5, 6)));
    centre += by.back();
  }
  const TileMeasures m = measure_tiles(s.centres, s.weights, kBox, torus),
                     n = measure_tiles(moved, s.weights, kBox, torus);
  ASSERT_EQ(m.walls.size(), n.walls.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_NEAR(n.area[i], m.area[i], 1e-13);
    EXPECT_NEAR((n.centroid[i] - m.centroid[i] - by[i]).norm(), 0, 1e-12);
  }
  for (const TileWall& wall : n.walls) {
    const double distance = (moved[wall.b] + displacement(wall.image, kBox) - moved[wall.a]).norm();
    EXPECT_LT(distance, 0.7) << "no neighbour of a tile of this size";
  }
}

TEST(tile_measures, refuse_what_is_no_site) {
  const auto message_of = [](const std::vector<Vec2>& centres, const std::vector<double>& weights,
                             Periodic periodic = {false, false}) -> std::string {
    try {
      measure_tiles(centres, weights, kBox, periodic);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message_of({{0, 2.5}}, {}), HasSubstr("1 centres and 0 weights"));
  EXPECT_THAT(message_of({{0, 2.5}}, {NAN}), HasSubstr("must be finite"));
  EXPECT_THAT(message_of({{NAN, 2.5}}, {0}), HasSubstr("must be finite"));
  EXPECT_THAT(message_of({{5, 2.5}}, {0}), HasSubstr("outside the box"));
  EXPECT_THAT(message_of({{5, 2.5}}, {0}, {true, false}), HasSubstr("no error"));
  EXPECT_THAT(message_of({{1e9, 2.5}}, {0}, {true, false}), HasSubstr("outside the box"));
}

}  // namespace
}  // namespace lamella
