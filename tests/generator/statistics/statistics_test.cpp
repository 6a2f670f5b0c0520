// Statistics of tissues whose answer is known: lattices, graphs on a torus, and Voronoi cells of random points.
#include "generator/statistics/mosaic_statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <sstream>

#include "generator/packing/laguerre.h"
#include "generator/statistics/tables.h"
#include "generator/tissue/lattice.h"
#include "tests/generator/tissue/mosaics.h"

namespace lamella {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Mosaic honeycomb(const std::string& orientation) {
  SampleScene scene;
  scene.columns = 12;
  scene.rows = 10;
  scene.side = 0.7;
  scene.orientation = orientation;
  return make_honeycomb(scene);
}

/// Bricks of 2 x 1, every second row shifted by half a brick: vertices at every corner of every brick.
Mosaic bricks(int columns, int rows) {
  Mosaic mosaic;
  std::map<std::pair<int, int>, Index> known;
  const auto id = [&](int x, int y) {
    const auto [at, fresh] = known.try_emplace({x, y}, static_cast<Index>(mosaic.vertices.size()));
    if (fresh) mosaic.vertices.emplace_back(x, y);
    return at->second;
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int x = 2 * i + j % 2;
      MosaicCell cell;
      cell.vertex = {id(x, j), id(x + 1, j), id(x + 2, j), id(x + 2, j + 1), id(x + 1, j + 1), id(x, j + 1)};
      cell.side.assign(6, 0);
      mosaic.cells.push_back(cell);
    }
  mosaic.box = {{0, 0}, Vec2(2 * columns + 1, rows)};
  return mosaic;
}

/// A triangular lattice on a torus whose edges have been flipped at random: cells with 3 and more neighbours.
MosaicMeasures flipped_torus(int size, int flips) {
  std::vector<std::set<Index>> around(size * size);
  const auto at = [&](int i, int j) { return static_cast<Index>((j + size) % size * size + (i + size) % size); };
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i)
      for (const auto& [di, dj] : {std::pair{1, 0}, {0, 1}, {1, -1}}) {
        around[at(i, j)].insert(at(i + di, j + dj));
        around[at(i + di, j + dj)].insert(at(i, j));
      }
  std::mt19937 random(5);
  for (int done = 0; done < flips;) {
    const auto a = static_cast<Index>(random() % around.size());
    auto b = around[a].begin();
    std::advance(b, random() % around[a].size());
    std::vector<Index> common;
    for (const Index c : around[a])
      if (around[*b].contains(c)) common.push_back(c);
    if (common.size() != 2 || around[common[0]].contains(common[1]) || around[a].size() < 4 || around[*b].size() < 4)
      continue;
    around[common[0]].insert(common[1]);
    around[common[1]].insert(common[0]);
    around[*b].erase(a);
    around[a].erase(*b);
    ++done;
  }
  MosaicMeasures measures;
  for (const auto& others : around) {
    CellMeasures cell;
    cell.area = 1 + 0.01 * static_cast<double>(random() % 100);
    cell.neighbours = static_cast<Index>(others.size());
    cell.layer = -1;
    measures.cells.push_back(cell);
    measures.neighbours.emplace_back(others.begin(), others.end());
  }
  return measures;
}

TEST(Statistics, of_a_honeycomb_are_those_of_the_regular_hexagon) {
  for (const char* orientation : {"pointy", "flat"}) {
    const Mosaic mosaic = honeycomb(orientation);
    const MosaicStatistics s = statistics(measure(mosaic));
    EXPECT_EQ(s.cells, 120);
    EXPECT_EQ(s.counted, 10 * 8);
    ASSERT_EQ(s.by_neighbours.size(), 1u);
    EXPECT_EQ(s.by_neighbours.begin()->first, 6);
    EXPECT_EQ(s.by_neighbours.at(6).share, 1);
    EXPECT_EQ(s.by_neighbours.at(6).neighbours, 6);
    EXPECT_EQ(s.by_neighbours.at(6).surrounded, 8 * 6);
    EXPECT_EQ(s.mu2, 0);
    // Equal areas are one bar, though rounding puts them on both sides of their mean.
    const auto& bars = s.area_histogram.density;
    EXPECT_EQ(std::count_if(bars.begin(), bars.end(), [](double density) { return density > 0; }), 1);
    EXPECT_NEAR(s.circularities.mean, std::numbers::pi / (2 * std::sqrt(3.0)), 1e-12);
    EXPECT_NEAR(s.areas.mean, 1.5 * std::sqrt(3.0) * 0.49, 1e-12);
    EXPECT_NEAR(s.perimeters.mean, 6 * 0.7, 1e-12);
    EXPECT_NEAR(s.elongations.largest, 1, 1e-9);
    EXPECT_NEAR(s.walls.mean, 0.7, 1e-12);
    EXPECT_LT(s.areas.cv(), 1e-12);
  }
}

TEST(Statistics, of_a_square_lattice_and_of_a_brick_wall) {
  const MosaicStatistics square = statistics(measure(squares(8, 6)));
  EXPECT_EQ(square.counted, 6 * 4);
  EXPECT_EQ(square.neighbours.mean, 4);
  EXPECT_EQ(square.neighbours.largest, 4);
  EXPECT_NEAR(square.circularities.mean, std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(square.elongations.mean, 1, 1e-12);

  const MosaicMeasures measures = measure(bricks(8, 6));
  const MosaicStatistics brick = statistics(measures);
  EXPECT_EQ(brick.neighbours.least, 6);
  EXPECT_EQ(brick.neighbours.largest, 6);
  EXPECT_NEAR(brick.elongations.mean, 2, 1e-12);
  EXPECT_NEAR(brick.circularities.mean, 4 * std::numbers::pi * 2 / 36, 1e-12);
  EXPECT_NEAR(measures.cells[20].direction, 0, 1e-12);
}

TEST(Statistics, of_one_rectangle_turned) {
  Mosaic mosaic;
  const double angle = 0.6;
  const Vec2 along(std::cos(angle), std::sin(angle)), across(-std::sin(angle), std::cos(angle));
  const Vec2 far(1e4, -3e4);  // where a careless sum would lose the cell
  mosaic.vertices = {far, far + 3 * along, far + 3 * along + across, far + across};
  mosaic.cells.push_back({{0, 1, 2, 3}, {0, 0, 0, 0}, "one", {}});
  const CellMeasures cell = measure(mosaic).cells[0];
  EXPECT_NEAR(cell.area, 3, 1e-9);
  EXPECT_NEAR(cell.elongation, 3, 1e-6);
  EXPECT_NEAR(cell.direction, angle, 1e-6);
  EXPECT_NEAR((cell.centre - far - 1.5 * along - 0.5 * across).norm(), 0, 1e-9);
  EXPECT_EQ(cell.neighbours, 0);
  EXPECT_EQ(cell.layer, 0);
}

TEST(Statistics, count_layers_from_the_boundary_inwards) {
  const MosaicMeasures measures = measure(squares(5, 5));
  EXPECT_EQ(measures.cells[0].layer, 0);
  EXPECT_EQ(measures.cells[6].layer, 1);
  EXPECT_EQ(measures.cells[12].layer, 2);
  EXPECT_EQ(statistics(measures, 2).counted, 1);
  EXPECT_EQ(statistics(measures, 0).counted, 25);
  const MosaicStatistics none = statistics(measures, 3);
  EXPECT_EQ(none.counted, 0);
  EXPECT_EQ(none.all_areas.count, 25);
  EXPECT_TRUE(none.by_neighbours.empty());
}

TEST(Statistics, on_a_torus_obey_the_sum_rule_of_weaire_exactly) {
  const MosaicMeasures measures = flipped_torus(40, 3000);
  const MosaicStatistics s = statistics(measures);
  EXPECT_EQ(s.counted, 1600) << "no boundary, all count";
  EXPECT_NEAR(s.neighbours.mean, 6, 1e-12);
  EXPECT_GT(s.mu2, 1) << "not a lattice";
  EXPECT_NEAR(s.weaire_sum, s.square_mean, 1e-10);
  double sum = 0, cells = 0;
  for (const auto& [n, of] : s.by_neighbours) {
    EXPECT_EQ(of.count, of.surrounded);
    sum += n * of.neighbours * of.share;
    cells += of.share;
  }
  EXPECT_NEAR(cells, 1, 1e-12);
  EXPECT_NEAR(sum, 36 + s.mu2, 1e-10);
}

TEST(Statistics, fit_lines_weighing_every_cell_the_same) {
  // Of group means weighted by their counts: the same slope.
  const MosaicStatistics s = statistics(flipped_torus(40, 3000));
  double weight = 0, mean_x = 0, mean_y = 0, mean_z = 0;
  for (const auto& [n, of] : s.by_neighbours) {
    weight += of.count;
    mean_x += of.count * static_cast<double>(n);
    mean_y += of.count * of.area;
    mean_z += of.count * n * of.neighbours;
  }
  mean_x /= weight, mean_y /= weight, mean_z /= weight;
  double xx = 0, xy = 0, xz = 0;
  for (const auto& [n, of] : s.by_neighbours) {
    xx += of.count * (n - mean_x) * (n - mean_x);
    xy += of.count * (n - mean_x) * (of.area - mean_y);
    xz += of.count * (n - mean_x) * (n * of.neighbours - mean_z);
  }
  EXPECT_NEAR(s.lewis.slope, xy / xx, 1e-12);
  EXPECT_NEAR(s.aboav_a, 6 - xz / xx, 1e-12);
}

TEST(Statistics, of_three_points_are_those_of_the_textbook) {
  // Residuals 1/2, -1, 1/2: variance 3/2, sum of squares of x about its mean 2.
  const Line line = fit_line({0, 1, 2}, {0, 0, 3});
  EXPECT_NEAR(line.slope, 1.5, 1e-14);
  EXPECT_NEAR(line.intercept, -0.5, 1e-14);
  EXPECT_NEAR(line.slope_error, std::sqrt(1.5 / 2), 1e-14);
  EXPECT_NEAR(line.intercept_error, std::sqrt(1.5 * (1.0 / 3 + 1.0 / 2)), 1e-14);
  EXPECT_NEAR(line.correlation, std::sqrt(0.75), 1e-14);
  EXPECT_EQ(fit_line({1, 1}, {2, 4}).slope, 0);
  EXPECT_EQ(fit_line({1, 1}, {2, 4}).intercept, 3);
  const Moments m = moments({1, 1, 4});
  EXPECT_NEAR(m.variance, 2, 1e-14);
  EXPECT_NEAR(m.skew, 2 / std::pow(2, 1.5), 1e-14);
  EXPECT_NEAR(m.cv(), std::sqrt(2.0) / 2, 1e-14);
  EXPECT_EQ(moments({}).count, 0);
}

TEST(Statistics, histograms_are_densities) {
  const Histogram h = histogram({0.1, 0.2, 0.9, 5}, 0, 1, 4);
  EXPECT_EQ(h.width, 0.25);
  EXPECT_NEAR(h.density[0], 2 / (4 * 0.25), 1e-14);
  EXPECT_NEAR(h.density[3], 1 / (4 * 0.25), 1e-14);
  EXPECT_EQ(h.density[1], 0);
}

/// Moments of the Poisson-Voronoi tessellation of unit intensity, and the standard deviation of each over one sample of N
/// cells times sqrt(N): from 5 samples of 1e6 cells on a torus.
TEST(Statistics, of_voronoi_cells_of_random_points_are_those_of_the_poisson_voronoi_tessellation) {
  constexpr int kSites = 20000;
  const double side = std::sqrt(static_cast<double>(kSites));
  std::mt19937_64 random(11);
  const auto uniform = [&] { return side * static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<Disk> sites;
  for (int k = 0; k < kSites; ++k) {
    const double x = uniform();
    sites.push_back({{x, uniform()}, 0.1});
  }
  const MosaicMeasures measures = measure(mosaic_of(tessellate(sites, {{0, 0}, {side, side}})));
  const MosaicStatistics s = statistics(measures, 3);
  ASSERT_GT(s.counted, 18000);
  const double root = std::sqrt(static_cast<double>(s.counted));
  const auto near = [&](double value, double exact, double c, const char* what) {
    EXPECT_NEAR(value, exact, 4 * c / root) << what;
  };
  near(s.mu2, 1.7808, 2.0, "var n");
  near(s.areas.variance, 0.2802, 0.75, "var A");
  near(s.areas.skew, 1.031, 5, "skew A");
  near(s.perimeters.mean, 4, 0.47, "mean P");
  near(s.perimeters.variance, 0.9452, 2.1, "var P");
  near(s.walls.mean, 2.0 / 3, 0.08, "mean L");
  near(s.walls.variance + s.walls.mean * s.walls.mean, 0.63022, 0.28, "mean L2");
  const double p[] = {.01123, .10684, .25964, .29464, .19858, .09011, .02974};
  const double c[] = {.10, .27, .40, .45, .35, .25, .17};
  for (Index n = 3; n <= 9; ++n) near(s.by_neighbours.at(n).share, p[n - 3], c[n - 3], "p_n");
  near(s.lewis.slope, 0.2251, 0.35, "Lewis");
  near(s.by_neighbours.at(5).area, 0.7742, 0.7, "A5");
  near(s.by_neighbours.at(6).area, 0.9955, 0.7, "A6");
  near(s.by_neighbours.at(7).area, 1.2230, 1.1, "A7");
  near(s.aboav_a, 0.647, 2.6, "a");
  near(s.lewis.correlation, 0.5677, 0.6, "corr(n, A)");
  // What is asked of the errors: the deviation over one sample, c / sqrt(N), to a factor of two.
  EXPECT_GT(s.lewis.slope_error * root, 0.35 / 2);
  EXPECT_LT(s.lewis.slope_error * root, 0.35 * 2);
  EXPECT_GT(s.aboav.slope_error * root, 2.6 / 2);
  EXPECT_LT(s.aboav.slope_error * root, 2.6 * 2);
}

TEST(Tables, have_one_row_for_each_cell_wall_and_vertex) {
  const Mosaic mosaic = squares(2, 1);
  const MosaicTables tables = tables_of(mosaic, measure(mosaic));
  EXPECT_THAT(tables.cells, StartsWith("cell,group,x [m],y [m],area [m2],perimeter [m],neighbours,layer,"));
  EXPECT_THAT(tables.cells, HasSubstr("\n0,cells,0.5,0.5,1,4,1,0,"));
  EXPECT_THAT(tables.walls, HasSubstr("\n0,1,1,4,1,0\n")) << "the shared wall, once";
  EXPECT_THAT(tables.walls, HasSubstr("\n0,-1,0,1,1,4\n")) << "a free edge, and the side of the box it lies on";
  EXPECT_THAT(tables.vertices, HasSubstr("\n1,1,0,2\n"));
  EXPECT_EQ(std::count(tables.cells.begin(), tables.cells.end(), '\n'), 1 + 2);
  EXPECT_EQ(std::count(tables.walls.begin(), tables.walls.end(), '\n'), 1 + 7);
  EXPECT_EQ(std::count(tables.vertices.begin(), tables.vertices.end(), '\n'), 1 + 6);
}

}  // namespace
}  // namespace lamella
