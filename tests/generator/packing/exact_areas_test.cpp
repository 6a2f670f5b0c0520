#include "generator/packing/exact_areas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "generator/packing/domain.h"
#include "generator/packing/random_sites.h"
#include "generator/sample/errors.h"
#include "half_planes.h"
#include "random_disks.h"

namespace lamella {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

const Box kUnit{{0, 0}, {1, 1}};
const std::vector<Periodic> kBoundaries{{false, false}, {true, false}, {false, true}, {true, true}};

std::vector<Vec2> random_sites(int count, unsigned seed) {
  std::vector<Vec2> sites;
  for (const Disk& disk : random_disks(count, 1, seed)) sites.push_back(disk.centre);
  return sites;
}

/// Lognormal about 1.
std::vector<double> random_shares(int count, double cv, unsigned seed) {
  Numbers numbers(seed);
  std::vector<double> shares;
  for (int i = 0; i < count; ++i) {
    const double radius = std::sqrt(-2 * std::log(1 - numbers.between(0, 1)));
    const double normal = radius * std::cos(2 * std::numbers::pi * numbers.between(0, 1));
    shares.push_back(std::exp(std::sqrt(std::log(1 + cv * cv)) * normal));
  }
  return shares;
}

std::vector<double> zeros(std::size_t count) { return std::vector<double>(count, 0.0); }

/// About its site. Half-planes know disks only, and a common shift of all weights changes nothing.
std::vector<Vec2> brute_force_cell(const AreaProblem& problem, const std::vector<double>& w, std::size_t i) {
  const double least = *std::min_element(w.begin(), w.end());
  std::vector<Disk> disks;
  for (std::size_t k = 0; k < w.size(); ++k) disks.push_back({problem.centres[k], std::sqrt(w[k] - least)});
  return half_plane_tile(disks, problem.box, problem.periodic, i);
}

/// Integral of |p|^2 over a polygon that is star-shaped about the origin.
double second_moment(const std::vector<Vec2>& polygon) {
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    sum += cross(a, b) / 12 * (a.squaredNorm() + b.squaredNorm() + a.dot(b));
  }
  return sum;
}

std::string message_of(const AreaProblem& problem, const std::vector<double>& start,
                       const WeightOptions& options = {}) {
  try {
    solve_weights(problem, start, options);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ExactAreas, two_cells_meet_where_their_areas_say) {
  const Box box{{0, 0}, {2, 0.5}};
  const double d = 0.9;
  const Weights found = solve_weights(tile_problem(box, {}, {{0.2, 0.1}, {1.1, 0.1}}, {1, 3}), {0.3, 0});
  // The wall stands at x = 0.5, a quarter of the width: 0.5 = (0.2 + 1.1) / 2 + (w0 - w1) / (2 d).
  EXPECT_NEAR(found.weight[0] - found.weight[1], 2 * d * (0.5 - 0.65), 1e-14);
  EXPECT_NEAR(found.cells.area[0], 0.25, 1e-15);
}

TEST(ExactAreas, of_cells_in_a_row_follow_from_the_sum_of_those_before) {
  const std::vector<double> x = {0.05, 0.1, 0.4, 0.45, 0.9, 0.95}, shares = {3, 1, 2, 5, 0.01, 4};
  std::vector<Vec2> sites;
  for (const double at : x) sites.emplace_back(at, 0.3);
  const Weights found = solve_weights(tile_problem(kUnit, {}, sites, shares), zeros(6));
  double wall = 0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    wall += shares[i] / 15.01;
    EXPECT_NEAR(found.weight[i] - found.weight[i + 1], 2 * (x[i + 1] - x[i]) * (wall - (x[i] + x[i + 1]) / 2), 1e-12);
  }
}

TEST(ExactAreas, one_cell_has_everything) {
  for (const Periodic& periodic : kBoundaries)
    EXPECT_EQ(solve_weights(tile_problem(kUnit, periodic, {{0.2, 0.7}}, {5}), {1}).iterations, 0);
}

TEST(ExactAreas, are_met_by_the_cells_that_brute_force_finds) {
  for (const Periodic& periodic : kBoundaries)
    for (const double cv : {0.0, 0.6, 1.0})
      for (const int count : {2, 3, 7, 40}) {
        SCOPED_TRACE(testing::Message() << count << " sites, CV " << cv << ", periodic " << periodic[0] << periodic[1]);
        const AreaProblem problem = tile_problem(kUnit, periodic, random_sites(count, 5), random_shares(count, cv, 6));
        const Weights found = solve_weights(problem, zeros(problem.centres.size()));
        std::vector<double> areas;
        for (std::size_t i = 0; i < problem.centres.size(); ++i)
          areas.push_back(polygon_area(brute_force_cell(problem, found.weight, i)));
        EXPECT_LE(largest_error(areas, problem.shares), 2e-9);
        EXPECT_LE(found.error, 1e-9);
      }
}

TEST(ExactAreas, come_from_hard_starts_too) {
  for (const Periodic& periodic : kBoundaries) {
    const AreaProblem problem = tile_problem(kUnit, periodic, random_sites(3000, 1), random_shares(3000, 1, 2));
    const Weights found = solve_weights(problem, zeros(3000));
    const Tessellation tiles =
        tessellate(problem.centres, found.weight, kUnit, {Duplicates::kRefuse, Hidden::kRefuse, periodic});
    EXPECT_THAT(check_tessellation(tiles), IsEmpty());
    std::vector<double> areas;
    for (const Tile& tile : tiles.tiles) areas.push_back(tile_area(tiles, tile));
    EXPECT_LE(largest_error(areas, problem.shares), 1e-9);
  }
}

TEST(ExactAreas, are_the_gradient_of_the_transport_cost) {
  // F(w) = sum_i of the integral of |p - x_i|^2 - w_i over cell i: dF/dw_i = -A_i.
  for (const Periodic& periodic : {kBoundaries[0], kBoundaries[3]}) {
    const AreaProblem problem = tile_problem(kUnit, periodic, random_sites(12, 3), std::vector<double>(12, 1.0));
    std::vector<double> w;
    for (int i = 0; i < 12; ++i) w.push_back(0.002 * (i % 5));
    const auto cost = [&](const std::vector<double>& weights) {
      double sum = 0;
      for (std::size_t i = 0; i < 12; ++i) {
        const auto cell = brute_force_cell(problem, weights, i);
        sum += second_moment(cell) - weights[i] * polygon_area(cell);
      }
      return sum;
    };
    const TileMeasures cells = problem.measure(problem.centres, w);
    for (std::size_t i = 0; i < 12; ++i) {
      ASSERT_GT(cells.area[i], 0);
      std::vector<double> up = w, down = w;
      up[i] += 1e-5, down[i] -= 1e-5;
      EXPECT_NEAR((cost(up) - cost(down)) / 2e-5, -cells.area[i], 1e-8);
    }
  }
}

TEST(ExactAreas, change_with_weights_as_walls_are_long_and_sites_far_apart) {
  for (const Periodic& periodic : kBoundaries) {
    const AreaProblem problem = tile_problem(kUnit, periodic, random_sites(30, 8), std::vector<double>(30, 1.0));
    const std::vector<double> w(30, 0.1);
    const TileMeasures cells = problem.measure(problem.centres, w);
    std::vector<std::vector<double>> slope(30, std::vector<double>(30, 0));
    for (const TileWall& wall : cells.walls) {
      const Vec2 away = problem.centres[wall.b] + displacement(wall.image, kUnit) - problem.centres[wall.a];
      const double conductance = wall.length / (2 * away.norm());
      slope[wall.a][wall.b] -= conductance, slope[wall.b][wall.a] -= conductance;
      slope[wall.a][wall.a] += conductance, slope[wall.b][wall.b] += conductance;
    }
    for (std::size_t j = 0; j < 30; ++j) {
      std::vector<double> up = w, down = w;
      up[j] += 1e-7, down[j] -= 1e-7;
      const TileMeasures more = problem.measure(problem.centres, up), less = problem.measure(problem.centres, down);
      for (std::size_t i = 0; i < 30; ++i)
        EXPECT_NEAR((more.area[i] - less.area[i]) / 2e-7, slope[i][j], 1e-5) << i << " " << j;
    }
  }
}

TEST(ExactAreas, do_not_depend_on_a_shift_of_all_weights_nor_on_the_unit_of_shares) {
  const std::vector<Vec2> sites = random_sites(200, 3);
  std::vector<double> shares = random_shares(200, 0.5, 4);
  const Weights plain = solve_weights(tile_problem(kUnit, {}, sites, shares), zeros(200));
  for (double& share : shares) share *= 1e-9;
  const Weights shifted = solve_weights(tile_problem(kUnit, {}, sites, shares), std::vector<double>(200, -0.25));
  EXPECT_EQ(plain.iterations, shifted.iterations);
  for (std::size_t i = 0; i < 200; ++i) EXPECT_NEAR(shifted.weight[i] + 0.25, plain.weight[i], 1e-10);
}

TEST(ExactAreas, on_a_torus_do_not_depend_on_where_it_is_cut) {
  const std::vector<double> shares = random_shares(200, 0.6, 4);
  std::vector<Vec2> sites = random_sites(200, 3);
  const Weights here = solve_weights(tile_problem(kUnit, {true, true}, sites, shares), zeros(200), {1e-12});
  for (Vec2& site : sites) {
    site += Vec2(0.37, 0.81);
    for (const int axis : {0, 1}) site[axis] -= std::floor(site[axis]);
  }
  const Weights there = solve_weights(tile_problem(kUnit, {true, true}, sites, shares), zeros(200), {1e-12});
  for (std::size_t i = 0; i < 200; ++i)
    EXPECT_NEAR(there.weight[i] - there.weight[0], here.weight[i] - here.weight[0], 1e-12);
}

TEST(ExactAreas, do_not_depend_on_the_unit_of_length) {
  const std::vector<double> shares = random_shares(300, 1, 4);
  for (const double unit : {1e-8, 1e6}) {
    std::vector<Vec2> sites = random_sites(300, 3);
    for (Vec2& site : sites) site *= unit;
    const Weights found = solve_weights(tile_problem({{0, 0}, {unit, unit}}, {}, sites, shares), zeros(300));
    EXPECT_LE(found.error, 1e-9);
  }
}

TEST(ExactAreas, are_the_same_to_the_last_bit_each_time) {
  const AreaProblem problem = tile_problem(kUnit, {true, true}, random_sites(500, 3), random_shares(500, 0.6, 4));
  EXPECT_EQ(solve_weights(problem, zeros(500)).weight, solve_weights(problem, zeros(500)).weight);
}

TEST(ExactAreas, are_found_from_weights_that_hide_cells) {
  const std::vector<Disk> disks = random_disks(100, 0.3, 9);
  std::vector<Vec2> sites;
  std::vector<double> weights;
  for (const Disk& disk : disks) sites.push_back(disk.centre), weights.push_back(disk.radius * disk.radius);
  const AreaProblem problem = tile_problem(kUnit, {}, sites, random_shares(100, 0.3, 1));
  const auto areas = problem.measure(sites, weights).area;
  ASSERT_GT(std::count(areas.begin(), areas.end(), 0.0), 10);
  EXPECT_LE(solve_weights(problem, weights).error, 1e-9);
}

TEST(ExactAreas, need_nothing_but_a_function_that_measures) {
  // Cells on a line whose density of area is 1 + x: walls at sqrt(1 + 3 c) - 1 for the cumulated share c.
  AreaProblem problem{kUnit, {}, {}, {{0.1, 0}, {0.5, 0}, {0.6, 0}}, {1, 1, 2}};
  problem.measure = [](const std::vector<Vec2>& x, const std::vector<double>& w) {
    TileMeasures cells{{}, x, {}};
    double before = 0;
    for (Index i = 0; i < 3; ++i) {
      const auto wall = [&](Index k) {
        return (x[k].x() + x[k + 1].x()) / 2 + (w[k] - w[k + 1]) / (2 * (x[k + 1].x() - x[k].x()));
      };
      const double after = i == 2 ? 1 : wall(i);
      cells.area.push_back(after + after * after / 2 - before - before * before / 2);
      if (i < 2) cells.walls.push_back({i, i + 1, {0, 0}, 1 + after});
      before = after;
    }
    return cells;
  };
  const Weights found = solve_weights(problem, zeros(3), {1e-14});
  EXPECT_NEAR((0.1 + 0.5) / 2 + (found.weight[0] - found.weight[1]) / 0.8, std::sqrt(1.75) - 1, 1e-13);
  EXPECT_NEAR((0.5 + 0.6) / 2 + (found.weight[1] - found.weight[2]) / 0.2, std::sqrt(2.5) - 1, 1e-13);
}

TEST(ExactAreas, that_cannot_be_are_refused_by_name) {
  const std::vector<Vec2> sites = {{0.2, 0.2}, {0.7, 0.3}, {0.5, 0.8}};
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, nan, inf})
    EXPECT_THAT(message_of(tile_problem(kUnit, {}, sites, {1, bad, 1}), zeros(3)),
                AllOf(HasSubstr("site 1 shall have the area"), HasSubstr("positive and finite")));
  EXPECT_THAT(message_of(tile_problem(kUnit, {}, {{0.2, 0.2}, {0.7, 0.3}, {0.2, 0.2}}, {1, 1, 1}), zeros(3)),
              HasSubstr("sites 0 and 2 lie at one place"));
  EXPECT_THAT(message_of(tile_problem(kUnit, {}, {{0.2, nan}, {0.7, 0.3}, {0.2, 0.2}}, {1, 1, 1}), zeros(3)),
              HasSubstr("coordinates must be finite"));
  EXPECT_THAT(message_of(tile_problem(kUnit, {}, {}, {}), {}), HasSubstr("no sites"));
  EXPECT_THAT(message_of(tile_problem(kUnit, {}, {{0.2, 0.2}, {1.7, 0.3}}, {1, 1}), zeros(2)),
              HasSubstr("outside the box"));
}

TEST(ExactAreas, of_a_site_without_a_cell_are_refused_by_name) {
  AreaProblem problem = tile_problem(kUnit, {}, {{0.2, 0.2}, {0.7, 0.3}}, {1, 1});
  problem.measure = [tiles = problem.measure](const std::vector<Vec2>& x, const std::vector<double>& w) {
    TileMeasures cells = tiles(x, w);
    cells.area[1] = 0;
    return cells;
  };
  EXPECT_THAT(message_of(problem, {0.1, 0}), HasSubstr("site 1 has no cell"));
}

TEST(ExactAreas, that_are_not_reached_say_how_near_they_came) {
  const AreaProblem problem = tile_problem(kUnit, {}, random_sites(500, 3), random_shares(500, 1, 4));
  EXPECT_THAT(message_of(problem, zeros(500), {.tolerance = 1e-9, .iterations = 2}),
              AllOf(HasSubstr("come to within"), HasSubstr("in 2 iterations"), HasSubstr("the worst is site")));
  EXPECT_THAT(message_of(problem, zeros(500), {.tolerance = 0}), HasSubstr("come to within"));
  // A cell of 1e-30 of the box is less than coordinates can resolve.
  EXPECT_THAT(message_of(tile_problem(kUnit, {}, random_sites(3, 1), {1, 1e-30, 1}), zeros(3)),
              HasSubstr("come to within"));
}

struct Shape {
  double circularity = 0, short_walls = 0, off_centre = 0;
};

Shape shape_of(const AreaProblem& problem, const Weights& found) {
  const Tessellation t =
      tessellate(problem.centres, found.weight, kUnit, {Duplicates::kRefuse, Hidden::kRefuse, problem.periodic});
  const double h = 1 / std::sqrt(static_cast<double>(t.tiles.size()));
  Shape shape;
  double walls = 0;
  for (const Tile& tile : t.tiles) {
    double perimeter = 0;
    for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
      const double length = edge_length(t, tile, k);
      perimeter += length, walls += 1, shape.short_walls += length < 0.05 * h;
    }
    shape.circularity += 4 * std::numbers::pi * tile_area(t, tile) / (perimeter * perimeter);
    shape.off_centre += (tile_centroid(t, tile) - problem.centres[tile.site]).norm() / h;
  }
  const double cells = static_cast<double>(t.tiles.size());
  return {shape.circularity / cells, shape.short_walls / walls, shape.off_centre / cells};
}

TEST(LloydSweeps, make_cells_round_and_short_walls_rare_while_areas_stay) {
  for (const double cv : {0.0, 0.6, 1.0}) {
    Shape before;
    for (const int sweeps : {0, 1, 5, 20}) {
      SCOPED_TRACE(testing::Message() << sweeps << " sweeps, CV " << cv);
      AreaProblem problem = tile_problem(kUnit, {true, true}, random_sites(900, 3), random_shares(900, cv, 4));
      const Weights found = lloyd_sweeps(problem, zeros(900), sweeps);
      EXPECT_LE(found.error, 1e-9);
      const Shape shape = shape_of(problem, found);
      EXPECT_GT(shape.circularity, before.circularity);
      if (sweeps > 0) {
        EXPECT_LT(shape.off_centre, before.off_centre);
        EXPECT_LT(shape.short_walls, before.short_walls * 1.05);  // the trend; of 5400 sides a few hundred are short
      }
      before = shape;
    }
    EXPECT_LT(before.short_walls, 0.025);
    EXPECT_GT(before.circularity, 0.82);
  }
}

TEST(LloydSweeps, keep_a_honeycomb) {
  // 4 columns of width 1, rows of height sqrt 3 / 2, on a torus: all sites are centroids already.
  const Box box{{0, 0}, {4, 2 * std::sqrt(3)}};
  std::vector<Vec2> sites;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      sites.emplace_back(column + 0.25 + 0.5 * (row % 2), (row + 0.5) * std::sqrt(3) / 2);
  AreaProblem problem = tile_problem(box, {true, true}, sites, std::vector<double>(16, 1.0));
  const Weights found = lloyd_sweeps(problem, zeros(16), 10);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_LT((problem.centres[i] - sites[i]).norm(), 1e-12);
  EXPECT_LE(found.error, 1e-12);
}

TEST(RandomSites, fill_the_box_and_differ_by_seed) {
  const std::vector<double> radii = {1, 2, 3, 4};
  PackingScene scene;
  scene.fraction = 0.5;
  const Packing one = scattered(scene, radii, {}, 1), other = scattered(scene, radii, {}, 2);
  EXPECT_NEAR(one.fraction, 0.5, 1e-14);
  EXPECT_NEAR(one.box.area(), 30 * std::numbers::pi / 0.5, 1e-10);
  EXPECT_NE(one.disks[0].centre, other.disks[0].centre);
  const Packing given = scattered(scene, radii, {.width = 2, .height = 1, .domain = nullptr, .factor = {}}, 1);
  EXPECT_NEAR(given.fraction, 0.5, 1e-14);
  EXPECT_EQ(given.box.hi, Vec2(2, 1));
  for (const Disk& disk : given.disks) EXPECT_TRUE(given.box.contains(disk.centre));
  EXPECT_NEAR(given.disks[3].radius / given.disks[0].radius, 4, 1e-14);
  for (const double bad : {0.0, -1.0, std::nan("")}) EXPECT_THROW(scattered(scene, {1, bad}, {}, 1), SceneError);
  EXPECT_THROW(scattered(scene, {}, {}, 1), SceneError);
}

TEST(RandomSites, fill_a_domain_and_lie_in_it) {
  DomainScene ring;
  ring.kind = "ring";
  ring.radius = 2;
  ring.inner_radius = 1;
  const Domain domain = make_domain(ring);
  PackingScene scene;
  scene.fraction = 0.5;
  const std::vector<double> radii(200, 1.0);
  const Packing found = scattered(scene, radii, {.width = 0, .height = 0, .domain = &domain, .factor = {}}, 1);
  EXPECT_NEAR(found.fraction, 0.5, 1e-14);
  EXPECT_NEAR(area_fraction(found.disks, found.box) * found.box.area(), 0.5 * domain.area, 1e-12);
  for (const Disk& disk : found.disks) EXPECT_TRUE(domain.contains(disk.centre));
}

}  // namespace
}  // namespace lamella
