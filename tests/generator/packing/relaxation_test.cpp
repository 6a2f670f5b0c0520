// Soft disks: the list of neighbours against all pairs, and what a state is said to be against formulas.
#include "generator/packing/relaxation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "generator/packing/domain.h"
#include "generator/sample/parallel.h"
#include "random_disks.h"

namespace lamella {
namespace {

using testing::SizeIs;

struct Arrays {
  Eigen::ArrayXd x, y, radius;
  DiskArrays view() const { return {x, y, radius, x.size()}; }
};

/// In the order that the grid wants.
Arrays sorted(const std::vector<Disk>& disks, NeighbourGrid& grid) {
  Arrays given, out;
  for (auto* arrays : {&given, &out})
    for (Eigen::ArrayXd* a : {&arrays->x, &arrays->y, &arrays->radius})
      a->resize(static_cast<Eigen::Index>(disks.size()));
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    given.x[at] = disks[i].centre.x(), given.y[at] = disks[i].centre.y(), given.radius[at] = disks[i].radius;
  }
  const auto place = grid.order(given.view());
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    out.x[place[i]] = given.x[at], out.y[place[i]] = given.y[at], out.radius[place[i]] = given.radius[at];
  }
  return out;
}

/// A pair in one order, with the image of the second relative to the first.
using Pair = std::tuple<int, int, int, int>;
Pair pair_of(int i, int j, int image_x, int image_y) {
  return i < j ? Pair{i, j, image_x, image_y} : Pair{j, i, -image_x, -image_y};
}

TEST(neighbours, are_all_pairs_closer_than_the_skin_each_once) {
  const Vec2 size(1, 0.7);
  const double skin = 0.02;
  for (unsigned seed = 0; seed < 8; ++seed) {
    auto disks = random_disks(80, 0.04, seed, size.x(), size.y());
    disks[0].radius = 0.3;  // reaches over many cells, and its images
    for (const Periodic periodic : {Periodic{false, false}, {true, false}, {false, true}, {true, true}}) {
      NeighbourGrid grid(size, periodic, 0.06);
      const Arrays a = sorted(disks, grid);
      const Neighbours list = grid.list(a.view(), {}, skin);
      std::set<Pair> expected, found;
      for (int i = 0; i < 80; ++i)
        for (int j = 0; j < i; ++j)
          for (int ix = -periodic[0]; ix <= periodic[0]; ++ix)
            for (int iy = -periodic[1]; iy <= periodic[1]; ++iy) {
              const Vec2 d = Vec2(a.x[j], a.y[j]) + size.cwiseProduct(Vec2(ix, iy)) - Vec2(a.x[i], a.y[i]);
              if (d.norm() < a.radius[i] + a.radius[j] + skin) expected.insert(pair_of(i, j, ix, iy));
            }
      for (std::size_t k = 0; k < list.first.size(); ++k) {
        int j = list.second[k];
        Vec2 image(0, 0);
        if (j >= 80) {
          const Ghost& ghost = list.ghosts[j - 80];
          j = ghost.owner, image = ghost.shift.cwiseQuotient(size);
        }
        const bool is_new = found
                                .insert(pair_of(list.first[k], j, static_cast<int>(std::lround(image.x())),
                                                static_cast<int>(std::lround(image.y()))))
                                .second;
        EXPECT_TRUE(is_new);
      }
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(neighbours, of_walls_are_all_disks_closer_than_the_skin) {
  const std::vector<StraightWall> walls{{{0.1, 0.1}, {0.9, 0.2}}, {{0.5, 0.65}, {0.52, 0.6}}, {{0, 0.3}, {0, 0.4}}};
  const auto disks = random_disks(200, 0.05, 3, 1, 0.7);
  NeighbourGrid grid({1, 0.7}, {false, false}, 0.06);
  const Arrays a = sorted(disks, grid);
  const Neighbours list = grid.list(a.view(), walls, 0.02);
  std::set<std::pair<int, int>> expected, found;
  for (int i = 0; i < 200; ++i)
    for (int w = 0; w < 3; ++w)
      if (distance_to_segment({a.x[i], a.y[i]}, walls[w].a, walls[w].b) < a.radius[i] + 0.02) expected.insert({i, w});
  for (const auto& [i, w] : list.at_wall) found.insert({i, w});
  EXPECT_EQ(found, expected);
  EXPECT_THAT(list.at_wall, SizeIs(expected.size()));
}

SoftDisks in_box(const Vec2& size, Periodic periodic) {
  return {.size = size, .area = size.x() * size.y(), .periodic = periodic, .walls = {}, .x = {}, .radius = {}};
}

TEST(relaxation, pressure_and_overlap_of_one_contact_are_those_of_the_formulas) {
  // Two disks across a corner of the torus: distance 1, radii 0.6 and 0.8.
  SoftDisks disks = in_box({10, 8}, {true, true});
  disks.x = {{0.3, 0.4}, {9.7, 7.6}}, disks.radius = {0.6, 0.8};
  EXPECT_THAT(overlaps(disks),
              testing::ElementsAre(testing::DoubleNear(0.4 / 0.6, 1e-12), testing::DoubleNear(0.4 / 0.8, 1e-12)));
  const Relaxation state = relax(disks, {.clearance = 0, .balance = 0, .steps = 1});
  EXPECT_NEAR(state.overlap, 0.4 / 1.4, 1e-12);
  EXPECT_NEAR(state.pressure, 0.4 * 1 / (2 * 80), 1e-12);

  // A side of the box, and the same side as a wall.
  SoftDisks by_side = in_box({10, 8}, {false, false}), by_wall = in_box({10, 8}, {true, true});
  by_side.x = by_wall.x = {{0.5, 4}}, by_side.radius = by_wall.radius = {0.7};
  by_wall.walls = {{{0, 0}, {0, 8}}};
  const Relaxation side = relax(by_side, {.clearance = 0, .balance = 0, .steps = 1});
  const Relaxation wall = relax(by_wall, {.clearance = 0, .balance = 0, .steps = 1});
  EXPECT_NEAR(side.overlap, 0.2 / 0.7, 1e-12);
  EXPECT_NEAR(side.pressure, 0.2 * 0.7 / 160, 1e-12);
  EXPECT_NEAR(wall.overlap, side.overlap, 1e-12);
  EXPECT_NEAR(wall.pressure, side.pressure, 1e-12);
  EXPECT_EQ(by_side.x[0], by_wall.x[0]);  // pushed the same way
  EXPECT_GT(by_side.x[0].x(), 0.5);
}

TEST(relaxation, disks_that_are_balanced_push_each_other_equally) {
  // A column of three, too long for the box: ends 2 x (overlap o) each, by symmetry all overlaps are equal.
  SoftDisks disks = in_box({4, 5}, {false, false});
  disks.x = {{2, 1.1}, {2, 2.2}, {2, 4.2}}, disks.radius = {1, 1, 1};
  const Relaxation state = relax(disks, {.clearance = 0, .balance = 1e-9, .steps = 10000});
  EXPECT_EQ(state.end, RelaxationEnd::kBalanced);
  // Two walls and two contacts share 6 - 5 = 1.
  EXPECT_NEAR(disks.x[0].y(), 0.75, 1e-7);
  EXPECT_NEAR(disks.x[1].y(), 2.5, 1e-7);
  EXPECT_NEAR(disks.x[2].y(), 4.25, 1e-7);
  EXPECT_NEAR(state.overlap, 0.25, 1e-7);
  EXPECT_NEAR(state.pressure, (2 * 0.25 * 1 + 2 * 0.25 * 1.75) / (2 * 20), 1e-7);
}

TEST(relaxation, gives_the_same_bits_on_one_two_and_three_threads) {
  // One disk is twenty times as large as the others: its pairs are of all threads.
  for (const Periodic periodic : {Periodic{true, true}, Periodic{false, true}, Periodic{false, false}}) {
    const double size = std::sqrt(24000 * 3.14 / 0.8);
    SoftDisks first = in_box({size, size}, periodic);
    if (!periodic[0]) first.walls = {{{0.2 * size, 0.1 * size}, {0.7 * size, 0.9 * size}}};
    for (const Disk& disk : random_disks(24000, 1.8, 7, size, size))
      first.x.push_back(disk.centre), first.radius.push_back(disk.radius);
    first.radius[17] = 20;
    std::vector<SoftDisks> found;
    std::vector<Relaxation> states;
    for (const int threads : {1, 2, 3}) {
      use_threads(threads);
      found.push_back(first);
      states.push_back(relax(found.back(), {.clearance = 1e-3, .balance = 1e-3, .steps = 40}));
    }
    use_threads(1);
    for (const std::size_t k : {1u, 2u}) {
      EXPECT_EQ(found[k].x, found[0].x);
      EXPECT_EQ(states[k].pressure, states[0].pressure);
      EXPECT_EQ(states[k].overlap, states[0].overlap);
      EXPECT_EQ(states[k].steps, states[0].steps);
    }
  }
}

TEST(relaxation, disks_in_one_place_do_no_harm) {
  SoftDisks disks = in_box({40, 40}, {true, true});
  disks.x = {{1, 1}, {1, 1}, {1.5, 1}}, disks.radius = {10, 10, 10};
  relax(disks, {.clearance = 0, .balance = 0, .steps = 100});
  for (const Vec2& x : disks.x) EXPECT_TRUE(x.allFinite());
}

TEST(relaxation, no_disk_crosses_a_wall) {
  // Thin walls cut a box into chambers; disks far too large for them are pushed about.
  SoftDisks disks = in_box({3, 1}, {false, false});
  for (const double x : {0.0, 1.0, 2.0, 3.0}) disks.walls.push_back({{x, 0}, {x, 1}});
  for (const double y : {0.0, 1.0}) disks.walls.push_back({{0, y}, {3, y}});
  Numbers numbers(1);
  std::vector<int> chamber;
  for (int i = 0; i < 300; ++i) {
    disks.x.emplace_back(numbers.between(0.01, 2.99), numbers.between(0.01, 0.99));
    disks.radius.push_back(numbers.between(0.01, 0.15));
    chamber.push_back(static_cast<int>(std::floor(disks.x.back().x())));
  }
  for (int round = 0; round < 20; ++round) relax(disks, {.clearance = 0, .balance = 0, .steps = 50});
  for (std::size_t i = 0; i < 300; ++i) {
    EXPECT_EQ(static_cast<int>(std::floor(disks.x[i].x())), chamber[i]);
    EXPECT_EQ(std::floor(disks.x[i].y()), 0);
  }
}

}  // namespace
}  // namespace lamella
