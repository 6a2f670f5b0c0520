#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <thread>

#include "generator/packing/laguerre.h"
#include "generator/sample/errors.h"
#include "half_planes.h"
#include "pipelines/poisson_voronoi/moments.h"
#include "random_disks.h"

namespace lamella {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

const Box kUnit{{0, 0}, {1, 1}};
const Periodic kX{true, false}, kY{false, true}, kBoth{true, true};

Tessellation torus(const std::vector<Disk>& disks, const Box& box = kUnit, const Periodic& periodic = kBoth) {
  return tessellate(disks, box, {.hidden = Hidden::kReport, .periodic = periodic});
}

/// All invariants, the hidden sites and every area, against half-planes.
void expect_right(const std::vector<Disk>& disks, const Box& box, const Periodic& periodic, double tolerance = 1e-13) {
  SCOPED_TRACE(testing::Message() << "periodic " << periodic[0] << periodic[1]);
  const Tessellation t = torus(disks, box, periodic);
  EXPECT_THAT(check_tessellation(t), IsEmpty());
  std::vector<Index> hidden;
  std::size_t next = 0;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const double area = polygon_area(half_plane_tile(disks, box, periodic, i));
    if (area <= 1e-15 * box.area()) {
      hidden.push_back(static_cast<Index>(i));
      continue;
    }
    ASSERT_LT(next, t.tiles.size());
    ASSERT_EQ(t.tiles[next].site, static_cast<Index>(i));
    EXPECT_NEAR(tile_area(t, t.tiles[next++]), area, tolerance * box.area()) << "tile " << i;
  }
  EXPECT_EQ(t.hidden, hidden);
}

void expect_right(const std::vector<Disk>& disks, const Box& box = kUnit) {
  for (const Periodic& periodic : {kX, kY, kBoth}) expect_right(disks, box, periodic);
}

/// Number of edges of a tile that are walls, and not sides of the box.
int walls(const Tile& tile) {
  return static_cast<int>(std::count_if(tile.neighbour.begin(), tile.neighbour.end(), [](Index n) { return n >= 0; }));
}

TEST(torus, a_single_site_borders_its_own_images) {
  const Tessellation t = torus({{{0.2, 0.9}, 0.1}});
  ASSERT_THAT(t.tiles, SizeIs(1));
  EXPECT_THAT(t.tiles[0].neighbour, ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(t.tiles[0].across, UnorderedElementsAre(Image{1, 0}, Image{-1, 0}, Image{0, 1}, Image{0, -1}));
  EXPECT_THAT(t.vertices, SizeIs(1));
  EXPECT_THAT(check_tessellation(t), IsEmpty());
  EXPECT_NEAR((tile_centroid(t, t.tiles[0]) - Vec2(0.2, 0.9)).norm(), 0, 1e-15);

  const Tessellation annulus = torus({{{0.2, 0.9}, 0.1}}, kUnit, kX);
  ASSERT_THAT(annulus.tiles, SizeIs(1));
  EXPECT_THAT(annulus.tiles[0].neighbour, UnorderedElementsAre(0, 0, kTopSide, kBottomSide));
  EXPECT_THAT(annulus.vertices, SizeIs(2));
  EXPECT_NEAR((tile_centroid(annulus, annulus.tiles[0]) - Vec2(0.2, 0.5)).norm(), 0, 1e-15);
  for (const Periodic& periodic : {kX, kY, kBoth})
    for (const Vec2& at : {Vec2(0, 0), Vec2(1, 1), Vec2(1, 0), Vec2(0.5, 0.5)})
      expect_right({{at, 0.1}}, kUnit, periodic);
}

TEST(torus, agrees_with_cutting_by_the_half_planes_of_all_images) {
  for (const int count : {2, 3, 4, 5, 6, 7, 10, 30, 100, 300}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE(testing::Message() << count << " disks, seed " << seed);
      expect_right(random_disks(count, 0.2 / std::sqrt(count), seed));
      if (count > 30 && seed > 2) break;
    }
  }
}

TEST(torus, agrees_with_half_planes_to_eight_digits_of_the_smallest_tile) {
  for (const double variation : {0.3, 1.0}) {
    const auto disks = apart_disks(3000, variation, 0.5, true, 4);
    for (const Periodic& periodic : {Periodic{false, false}, kX, kBoth}) {
      const Tessellation t = torus(disks, kUnit, periodic);
      double worst = 0;
      for (const Tile& tile : t.tiles) {
        const double area = polygon_area(half_plane_tile(disks, kUnit, periodic, static_cast<std::size_t>(tile.site)));
        worst = std::max(worst, std::abs(tile_area(t, tile) / area - 1));
      }
      EXPECT_LE(worst, 1e-8);
    }
  }
}

TEST(torus, boxes_may_be_long_and_lie_anywhere) {
  for (const Vec2& size : {Vec2(100, 1), Vec2(0.01, 1), Vec2(3, 2)}) {
    const Box box{{-7, 12}, Vec2(-7, 12) + size};
    for (const int count : {1, 2, 3, 20, 150}) {
      auto disks = random_disks(count, 0.1 * std::sqrt(box.area() / count), 5, size.x(), size.y());
      for (Disk& disk : disks) disk.centre = (disk.centre + box.lo).cwiseMax(box.lo).cwiseMin(box.hi);
      SCOPED_TRACE(testing::Message() << size.transpose() << ", " << count << " disks");
      expect_right(disks, box);
    }
  }
}

TEST(torus, finds_the_disks_that_overlapping_ones_hide) {
  for (unsigned seed = 0; seed < 3; ++seed) expect_right(random_disks(300, 0.15, seed));
  for (unsigned seed = 0; seed < 50; ++seed) expect_right(random_disks(2 + static_cast<int>(seed % 4), 1, seed));
}

TEST(torus, one_large_disk_among_two_thousand_times_smaller_ones) {
  for (const Vec2& at : {Vec2(0.5, 0.5), Vec2(0, 0), Vec2(1, 0.3)}) {
    std::vector<Disk> disks = random_disks(300, 1e-4, 3);
    disks.push_back({at, 0.2});
    expect_right(disks);
  }
}

TEST(torus, sites_in_one_corner_leave_a_void_that_more_images_must_surround) {
  for (unsigned seed = 0; seed < 3; ++seed) expect_right(random_disks(200, 0.001, seed, 0.05, 0.05));
  auto disks = random_disks(200, 0.001, 5, 0.05, 1);
  expect_right(disks);
}

TEST(torus, sites_on_one_line) {
  for (const int count : {2, 3, 4, 50}) {
    for (const Vec2& way : {Vec2(1, 0), Vec2(0, 1), Vec2(1, 1), Vec2(0.3, 0.9)}) {
      std::vector<Disk> disks;
      for (int i = 0; i < count; ++i) disks.push_back({(i + 0.25) / count * way, 0.1 / count * ((i % 7) / 7.0)});
      SCOPED_TRACE(testing::Message() << count << " along " << way.transpose());
      expect_right(disks);
    }
  }
}

TEST(torus, sites_on_the_sides_of_the_box_are_on_no_side_at_all) {
  Numbers numbers(5);
  std::vector<Disk> disks = {{{0, 0}, 0.01}, {{1, 0}, 0.011}, {{1, 1}, 0.02}, {{0, 1}, 0}};  // one point of the torus
  for (int i = 0; i < 400; ++i) {
    const double s = numbers.between(0, 1);
    const Vec2 p = i % 4 == 0 ? Vec2(s, 0) : i % 4 == 1 ? Vec2(1, s) : i % 4 == 2 ? Vec2(s, 1) : Vec2(0, s);
    disks.push_back({p, 0.001});
  }
  // Some are 1e-5 apart, and the positions of walls between them rounded accordingly.
  for (const Periodic& periodic : {kX, kY, kBoth}) expect_right(disks, kUnit, periodic, 1e-12);
  EXPECT_THAT(torus(disks).hidden, testing::IsSupersetOf({0, 1, 3}));
  try {
    tessellate({{{0, 0.5}, 0.01}, {{1, 0.5}, 0.01}}, kUnit, {.periodic = kX});
    ADD_FAILURE() << "the same point twice";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("is the same as disk 0"));
  }
}

TEST(torus, a_tile_lies_where_its_site_is) {
  auto disks = random_disks(100, 0, 2);
  disks[0].centre.x() = 1, disks[1].centre.y() = 1;
  const Tessellation t = torus(disks);
  for (const Tile& tile : t.tiles) {
    const Vec2 site = disks[tile.site].centre;
    for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
      const Vec2 p = corner(t, tile, k), q = corner(t, tile, (k + 1) % tile.vertex.size());
      EXPECT_GT(cross(q - p, site - p), 0);
      // ... and the neighbour's lies across: equal power to it as displaced.
      const Disk& other = disks[tile.neighbour[k]];
      const Vec2 there = other.centre + displacement(tile.across[k], t.box);
      EXPECT_NEAR((p - site).squaredNorm() - disks[tile.site].radius * disks[tile.site].radius,
                  (p - there).squaredNorm() - other.radius * other.radius, 1e-12);
    }
  }
}

TEST(torus, four_tiles_of_a_square_lattice_meet_at_each_vertex) {
  for (const int n : {1, 2, 3, 7, 30, 32}) {
    std::vector<Disk> disks;
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column) disks.push_back({{(column + 0.5) / n, (row + 0.5) / n}, 0.3 / n});
    const Tessellation t = torus(disks);
    EXPECT_THAT(check_tessellation(t), IsEmpty());
    // Where the sites are rounded, those on both sides of the seam are so differently: there, tiny walls may be left.
    const bool exact = (n & (n - 1)) == 0;
    for (const Tile& tile : t.tiles) {
      EXPECT_NEAR(tile_area(t, tile) * n * n, 1, 1e-12);
      EXPECT_TRUE(!exact || tile.vertex.size() == 4);
    }
    EXPECT_TRUE(!exact || t.vertices.size() == t.tiles.size());
  }
}

/// Cocircular sites, tiles without area, duplicates, hidden sites, sites on the sides: all at once, and exactly.
TEST(torus, sites_and_weights_on_coarse_grids_agree_with_half_planes) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Numbers numbers(seed);
    const int grid = 1 << static_cast<int>(numbers.between(1, 5)), count = static_cast<int>(numbers.between(1, 60));
    const double weights = std::floor(numbers.between(1, 4));
    std::vector<Disk> disks;
    for (int i = 0; i < count; ++i) {
      const double x = std::floor(numbers.between(0, grid + 0.999)), y = std::floor(numbers.between(0, grid + 0.999));
      disks.push_back({Vec2(x, y) / grid, (1 + std::floor(numbers.between(0, weights))) / grid});
    }
    for (const Periodic& periodic : {Periodic{false, false}, kX, kY, kBoth}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", periodic " << periodic[0] << periodic[1]);
      const Tessellation t = tessellate(disks, kUnit, {Duplicates::kKeepFirst, Hidden::kReport, periodic});
      EXPECT_THAT(check_tessellation(t), IsEmpty());
      std::vector<Disk> kept;
      for (const Tile& tile : t.tiles) kept.push_back(disks[tile.site]);
      for (std::size_t k = 0; k < kept.size(); ++k)
        EXPECT_NEAR(tile_area(t, t.tiles[k]), polygon_area(half_plane_tile(kept, kUnit, periodic, k)), 1e-14);
      for (const Index hidden : t.hidden) {
        kept.push_back(disks[hidden]);
        kept.back().radius -= 1e-7;  // duplicates would share
        EXPECT_NEAR(polygon_area(half_plane_tile(kept, kUnit, periodic, kept.size() - 1)), 0, 1e-12);
        kept.pop_back();
      }
    }
  }
}

TEST(torus, tiles_of_a_hexagonal_lattice_have_six_sides_and_equal_areas) {
  const int columns = 16, rows = 16;
  const Box box{{0, 0}, {1, rows * std::sqrt(0.75) / columns}};
  std::vector<Disk> disks;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      disks.push_back(
          {{(column + 0.25 + 0.5 * (row % 2)) / columns, (row + 0.5) * std::sqrt(0.75) / columns}, 0.4 / columns});
  const Tessellation t = torus(disks, box);
  EXPECT_THAT(check_tessellation(t), IsEmpty());
  EXPECT_THAT(t.vertices, SizeIs(2 * columns * rows));
  for (const Tile& tile : t.tiles) {
    EXPECT_THAT(tile.vertex, SizeIs(6));
    EXPECT_NEAR(tile_area(t, tile) * columns * columns, std::sqrt(0.75), 1e-12);
  }
}

TEST(torus, six_walls_a_tile_and_two_vertices_and_the_sum_rule_of_weaire_all_exact) {
  for (const int count : {1, 2, 3, 4, 5, 50, 2000}) {
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Tessellation t = torus(random_disks(count, 0.1 / std::sqrt(count), seed));
      if (count == 1) continue;  // one vertex of four walls
      std::map<Index, long> sides;
      long sum = 0, neighbours = 0, squares = 0;
      for (const Tile& tile : t.tiles) sum += sides[tile.site] = walls(tile);
      for (const Tile& tile : t.tiles) {
        squares += sides[tile.site] * sides[tile.site];
        for (const Index other : tile.neighbour) neighbours += sides[other];
      }
      const auto tiles = static_cast<long>(t.tiles.size());
      EXPECT_EQ(sum, 6 * tiles) << count << " sites, seed " << seed;
      EXPECT_EQ(static_cast<long>(t.vertices.size()), 2 * tiles);
      EXPECT_EQ(neighbours, squares);
      if (seed > 1 && count > 50) break;
    }
  }
}

std::vector<double> sorted_areas(const Tessellation& t) {
  std::vector<double> areas;
  for (const Tile& tile : t.tiles) areas.push_back(tile_area(t, tile));
  std::sort(areas.begin(), areas.end());
  return areas;
}

TEST(torus, moving_all_sites_changes_no_tile) {
  const auto disks = random_disks(500, 0.02, 6);
  const auto areas = sorted_areas(torus(disks));
  for (const Vec2& way : {Vec2(0.1, 0.7), Vec2(0.5, 0), Vec2(1e-9, 1 / 3.0)}) {
    auto moved = disks;
    for (Disk& disk : moved) {
      disk.centre += way;
      disk.centre -= Vec2(std::floor(disk.centre.x()), std::floor(disk.centre.y()));
    }
    const Tessellation t = torus(moved);
    EXPECT_THAT(check_tessellation(t), IsEmpty());
    const auto other = sorted_areas(t);
    ASSERT_EQ(areas.size(), other.size());
    for (std::size_t k = 0; k < areas.size(); ++k) EXPECT_NEAR(areas[k], other[k], 1e-12);
  }
}

TEST(torus, twice_two_boxes_hold_four_of_each_tile) {
  for (const int count : {1, 2, 5, 100}) {
    const auto disks = random_disks(count, 0.1 / std::sqrt(count), 6);
    std::vector<Disk> four;
    for (const Vec2& way : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(1, 1)})
      for (const Disk& disk : disks) four.push_back({disk.centre + way, disk.radius});
    const Tessellation t = torus(disks), big = torus(four, {{0, 0}, {2, 2}});
    EXPECT_THAT(check_tessellation(big), IsEmpty());
    ASSERT_EQ(big.tiles.size(), 4 * t.tiles.size());
    for (std::size_t k = 0; k < big.tiles.size(); ++k) {
      const Tile &tile = t.tiles[k % t.tiles.size()], &copy = big.tiles[k];
      EXPECT_EQ(copy.vertex.size(), tile.vertex.size());
      EXPECT_NEAR(tile_area(big, copy), tile_area(t, tile), 1e-13);
    }
  }
}

/// For each tile, its neighbours and where they are, by the names that `name` gives to sites.
template <class Name>
std::map<Index, std::multiset<std::pair<Index, Image>>> topology(const Tessellation& t, Name name) {
  std::map<Index, std::multiset<std::pair<Index, Image>>> result;
  for (const Tile& tile : t.tiles)
    for (std::size_t k = 0; k < tile.vertex.size(); ++k)
      result[name(tile.site)].emplace(tile.neighbour[k] < 0 ? tile.neighbour[k] : name(tile.neighbour[k]),
                                      tile.across[k]);
  return result;
}

TEST(torus, topology_depends_neither_on_the_order_of_sites_nor_on_the_unit_nor_on_a_common_weight) {
  auto disks = random_disks(400, 0.01, 4);
  for (int k = 0; k < 100; ++k) disks.push_back({{(k % 10 + 0.5) / 64, (k / 10 + 0.5) / 64}, 0.001});  // cocircular
  const auto same = [](Index i) { return i; };
  for (const Periodic& periodic : {kX, kBoth}) {
    const auto expected = topology(torus(disks, kUnit, periodic), same);
    const auto last = static_cast<Index>(disks.size()) - 1;
    auto reversed = disks;
    std::reverse(reversed.begin(), reversed.end());
    EXPECT_EQ(topology(torus(reversed, kUnit, periodic), [&](Index i) { return last - i; }), expected);
    for (const double unit : {0x1p-27, 1e-8, 1e6}) {
      auto scaled = random_disks(400, 0.01, 4);
      const auto plain = topology(torus(scaled, kUnit, periodic), same);
      for (Disk& disk : scaled) disk.centre *= unit, disk.radius *= unit;
      const Tessellation t = torus(scaled, {{0, 0}, {unit, unit}}, periodic);
      EXPECT_THAT(check_tessellation(t), IsEmpty());
      EXPECT_EQ(topology(t, same), plain);
    }
    std::vector<Vec2> centres;
    std::vector<double> weights;
    for (const Disk& disk : disks) centres.push_back(disk.centre), weights.push_back(disk.radius * disk.radius - 0.25);
    EXPECT_EQ(topology(tessellate(centres, weights, kUnit, {.hidden = Hidden::kReport, .periodic = periodic}), same),
              topology(torus(disks, kUnit, periodic), same));
  }
}

TEST(torus, threads_that_tessellate_at_once_get_the_same_to_the_bit) {
  const auto disks = random_disks(2000, 0.005, 3);
  const Tessellation alone = torus(disks);
  std::vector<Tessellation> found(4);
  std::vector<std::thread> threads;
  for (Tessellation& t : found) threads.emplace_back([&] { t = torus(disks); });
  for (std::thread& thread : threads) thread.join();
  for (const Tessellation& t : found) {
    EXPECT_EQ(t.vertices, alone.vertices);
    ASSERT_EQ(t.tiles.size(), alone.tiles.size());
    for (std::size_t k = 0; k < t.tiles.size(); ++k) EXPECT_EQ(t.tiles[k].vertex, alone.tiles[k].vertex);
  }
}

TEST(torus, disks_that_do_not_overlap_lie_in_their_tiles_and_none_is_hidden) {
  for (const double variation : {0.3, 1.0}) {
    const auto disks = apart_disks(20000, variation, 0.5, true, 7);
    const Tessellation t = tessellate(disks, kUnit, {.periodic = kBoth});  // throws if one is hidden
    EXPECT_THAT(check_tessellation(t), IsEmpty());
    double worst = 0;
    for (const Tile& tile : t.tiles) {
      const Disk& disk = disks[tile.site];
      for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
        const Vec2 there = disks[tile.neighbour[k]].centre + displacement(tile.across[k], t.box);
        const Vec2 out = (there - disk.centre).normalized();
        worst = std::max(worst, 1 - (corner(t, tile, k) - disk.centre).dot(out) / disk.radius);
      }
    }
    EXPECT_LE(worst, 1e-9);
  }
}

TEST(torus, tiles_of_random_points_have_the_moments_of_poisson_voronoi_tilings) {
  const int count = 100000;
  const auto disks = random_disks(count, 0, 2026);
  const Tessellation t = torus(disks);
  EXPECT_THAT(check_tessellation(t), IsEmpty());
  for (const Moment& m : poisson_voronoi_moments(t))
    EXPECT_NEAR(m.found, m.expected, 4 * m.spread / std::sqrt(count)) << m.name;
}

}  // namespace
}  // namespace lamella
