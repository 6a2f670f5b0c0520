// Areas, centroids and walls of a domain's cells: beside brute force and finite differences.
#include "generator/tissue/domain_measure.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/generator/tissue/domain_shapes.h"

namespace lamella {
namespace {

struct Sites {
  std::vector<Vec2> centres;
  std::vector<double> weights;
};

Sites sites_in(const Loops& loops, int count, unsigned seed) {
  Sites sites;
  for (const Disk& disk : disks_in(loops, count, 0.5 / std::sqrt(count), seed)) {
    sites.centres.push_back(disk.centre);
    sites.weights.push_back(disk.radius * disk.radius - 0.01);  // negative ones too: only differences matter
  }
  return sites;
}

struct Moments {
  double area = 0;
  Vec2 first = Vec2::Zero();
};

/// Every loop cut by the bisectors with all other sites: exact for concave loops too, whose parts stay joined by edges
/// that are run through twice.
Moments moments_of_cell(const Sites& sites, std::size_t i, const Loops& loops) {
  Moments moments;
  for (std::vector<Vec2> polygon : loops) {
    for (std::size_t j = 0; j < sites.centres.size(); ++j) {
      if (j == i) continue;
      const Vec2 normal = sites.centres[j] - sites.centres[i];
      const double level =
          (sites.centres[j].squaredNorm() - sites.weights[j] - sites.centres[i].squaredNorm() + sites.weights[i]) / 2;
      std::vector<Vec2> left;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double da = normal.dot(a) - level, db = normal.dot(b) - level;
        if (da <= 0) left.push_back(a);
        if (da * db < 0) left.push_back(a + (b - a) * da / (da - db));
      }
      polygon = left;
    }
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      moments.area += cross(a, b) / 2;
      moments.first += cross(a, b) * (a + b) / 6;
    }
  }
  return moments;
}

const std::vector<std::string> kShapes{"disk", "ring", "L", "star", "two holes"};

TEST(DomainMeasure, of_areas_and_centroids_is_that_of_brute_force) {
  for (const std::string& shape : kShapes)
    for (const int count : {3, 20, 120}) {
      const Loops loops = domain_of(shape);
      const Sites sites = sites_in(loops, count, 3);
      const TileMeasures measured = measure_domain_tiles(sites.centres, sites.weights, loops);
      for (std::size_t i = 0; i < sites.centres.size(); ++i) {
        const Moments right = moments_of_cell(sites, i, loops);
        EXPECT_NEAR(measured.area[i], right.area, 1e-14) << shape << " " << count << " site " << i;
        if (right.area < 1e-6) continue;
        EXPECT_NEAR((measured.centroid[i] - right.first / right.area).norm(), 0, 1e-13 / right.area) << shape;
      }
      EXPECT_NEAR(std::accumulate(measured.area.begin(), measured.area.end(), 0.0), area_of(loops), 1e-14);
    }
}

TEST(DomainMeasure, of_walls_is_the_derivative_of_areas_by_weights) {
  for (const std::string& shape : kShapes) {
    const Loops loops = domain_of(shape);
    const Sites sites = sites_in(loops, 40, 5);
    const TileMeasures at = measure_domain_tiles(sites.centres, sites.weights, loops);
    const double step = 1e-7;
    std::size_t seen = 0;
    for (std::size_t j = 0; j < sites.centres.size(); j += 7) {
      Sites more = sites, less = sites;
      more.weights[j] += step, less.weights[j] -= step;
      const auto up = measure_domain_tiles(more.centres, more.weights, loops).area,
                 down = measure_domain_tiles(less.centres, less.weights, loops).area;
      std::vector<double> expected(sites.centres.size(), 0);
      for (const TileWall& wall : at.walls) {
        const auto a = static_cast<std::size_t>(wall.a), b = static_cast<std::size_t>(wall.b);
        if (a != j && b != j) continue;
        const double slope = wall.length / (2 * (sites.centres[a] - sites.centres[b]).norm());
        expected[a == j ? b : a] -= slope;
        expected[j] += slope;
        ++seen;
      }
      for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR((up[i] - down[i]) / (2 * step), expected[i], 1e-6 * (1 + std::abs(expected[i])))
            << shape << ": cell " << i << " by weight " << j;
    }
    EXPECT_GT(seen, 15u);
  }
}

TEST(DomainMeasure, counts_a_hole_within_one_cell_and_sites_without_a_cell) {
  const Loops loops{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, hole(circle({0.25, 0.5}, 0.02, 8))};
  const Sites sites{{{0.2, 0.5}, {0.8, 0.5}, {0.8, 0.52}}, {0, 0, -0.5}};
  const TileMeasures measured = measure_domain_tiles(sites.centres, sites.weights, loops);
  const Moments right = moments_of_cell({{{0.2, 0.5}, {0.8, 0.5}}, {0, 0}}, 0, loops);
  EXPECT_NEAR(measured.area[0], right.area, 1e-15);
  EXPECT_NEAR((measured.centroid[0] - right.first / right.area).norm(), 0, 1e-14);
  EXPECT_NEAR(measured.area[1], 0.5, 1e-15);
  EXPECT_EQ(measured.area[2], 0);
  EXPECT_EQ(measured.centroid[2], sites.centres[2]);
  ASSERT_EQ(measured.walls.size(), 1u);
  EXPECT_NEAR(measured.walls[0].length, 1, 1e-15);
}

}  // namespace
}  // namespace lamella
