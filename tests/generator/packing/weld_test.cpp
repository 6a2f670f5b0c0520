#include "generator/packing/weld.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "random_disks.h"

namespace lamella {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

const Box kUnit{{0, 0}, {1, 1}};

double shortest_edge(const Tessellation& t) {
  double shortest = 1e300;
  for (const Tile& tile : t.tiles)
    for (std::size_t k = 0; k < tile.vertex.size(); ++k) shortest = std::min(shortest, edge_length(t, tile, k));
  return shortest;
}

Packing packed(const std::string& boundary, int count, std::uint64_t seed) {
  PackingScene scene;
  scene.boundary = boundary;
  scene.fraction = 0.8;
  Numbers numbers(static_cast<unsigned>(seed));
  std::vector<double> radii;
  for (int k = 0; k < count; ++k) radii.push_back(numbers.between(0.5, 1.5));
  return pack(scene, radii, 1, 1, seed);
}

TEST(weld, nothing_is_shorter_than_the_threshold_afterwards_and_all_invariants_hold) {
  for (const char* boundary : {"walls", "periodic"}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const Packing packing = packed(boundary, 300, seed);
      Tessellation t = tessellate(packing.disks, packing.box);
      const double threshold = 0.1 * mean_edge_length(t);
      std::vector<std::string> notes;
      const int welded = weld_short_edges(t, threshold, &notes);
      EXPECT_GT(welded, 0);
      EXPECT_THAT(check_tessellation(t), IsEmpty());  // convex tiles, areas, Euler, boundary vertices on their side
      EXPECT_THAT(notes, SizeIs(1));                  // nothing was left over
      EXPECT_GT(shortest_edge(t), threshold);
    }
  }
}

TEST(weld, each_welded_edge_removes_one_vertex) {
  const Packing packing = packed("walls", 300, 7);
  Tessellation t = tessellate(packing.disks, packing.box);
  const std::size_t before = t.vertices.size();
  const int welded = weld_short_edges(t, 0.1 * mean_edge_length(t));
  EXPECT_EQ(t.vertices.size(), before - static_cast<std::size_t>(welded));
}

TEST(weld, four_tiles_of_a_square_lattice_meet_at_each_vertex_though_its_sites_are_a_little_off) {
  const int n = 30;
  for (const double off : {0.0, 1e-16, 1e-13}) {
    for (const Periodic periodic :
         {Periodic{false, false}, Periodic{true, false}, Periodic{false, true}, Periodic{true, true}}) {
      SCOPED_TRACE(testing::Message() << off << " " << periodic[0] << periodic[1]);
      Numbers numbers(3);
      std::vector<Disk> disks;
      for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) {
          const double x = numbers.between(-off, off), y = numbers.between(-off, off);
          disks.push_back({{(column + 0.5) / n + x, (row + 0.5) / n + y}, 0.3 / n});
        }
      Tessellation t = tessellate(disks, kUnit, {.periodic = periodic});
      EXPECT_THAT(check_tessellation(t), IsEmpty());
      weld_short_edges(t, 1e-9 / n);
      EXPECT_THAT(check_tessellation(t), IsEmpty());
      std::map<Index, int> tiles_at;
      for (const Tile& tile : t.tiles) {
        EXPECT_THAT(tile.vertex, SizeIs(4));
        EXPECT_NEAR(tile_area(t, tile) * n * n, 1, 1e-9);
        for (const Index v : tile.vertex) ++tiles_at[v];
      }
      const int columns = periodic[0] ? n : n - 1, rows = periodic[1] ? n : n - 1;
      EXPECT_EQ(std::count_if(tiles_at.begin(), tiles_at.end(), [](const auto& entry) { return entry.second == 4; }),
                columns * rows);
    }
  }
}

TEST(weld, on_the_torus_nothing_is_shorter_than_the_threshold_afterwards_and_all_invariants_hold) {
  for (const Periodic periodic : {Periodic{true, false}, Periodic{false, true}, Periodic{true, true}}) {
    for (unsigned seed = 0; seed < 5; ++seed) {
      Tessellation t = tessellate(apart_disks(300, 0.3, 0.5, true, seed), kUnit, {.periodic = periodic});
      const double threshold = 0.1 * mean_edge_length(t);
      const std::size_t before = t.vertices.size();
      std::vector<std::string> notes;
      const int welded = weld_short_edges(t, threshold, &notes);
      EXPECT_GT(welded, 0);
      EXPECT_EQ(t.vertices.size(), before - static_cast<std::size_t>(welded));
      EXPECT_THAT(check_tessellation(t), IsEmpty());
      EXPECT_THAT(notes, SizeIs(1));
      EXPECT_GT(shortest_edge(t), threshold);
    }
  }
}

TEST(weld, a_torus_of_few_tiles_stays_one_whatever_the_threshold) {
  for (int count = 1; count <= 6; ++count)
    for (unsigned seed = 0; seed < 50; ++seed)
      for (const Periodic periodic : {Periodic{true, false}, Periodic{true, true}}) {
        Tessellation t =
            tessellate(random_disks(count, 0.1, seed), kUnit, {.hidden = Hidden::kReport, .periodic = periodic});
        const std::size_t tiles = t.tiles.size();
        weld_short_edges(t, 0.5);
        EXPECT_EQ(t.tiles.size(), tiles);
        EXPECT_THAT(check_tessellation(t), IsEmpty()) << count << " disks, seed " << seed;
      }
}

TEST(weld, a_threshold_of_zero_welds_only_edges_of_no_length) {
  const Packing packing = packed("walls", 100, 1);
  Tessellation t = tessellate(packing.disks, packing.box);
  EXPECT_EQ(weld_short_edges(t, 0), 0);
}

TEST(weld, corners_of_the_box_stay_and_keep_their_tiles) {
  // The second disk's tile is a small triangle at the corner: its edges are short, but it must not vanish.
  Tessellation t =
      tessellate({{{0.5, 0.5}, 0.3}, {{0.005, 0.005}, 0}, {{0.9, 0.1}, 0.1}}, kUnit, {.hidden = Hidden::kReport});
  ASSERT_THAT(t.tiles, SizeIs(3));
  const Tessellation before = t;
  std::vector<std::string> notes;
  weld_short_edges(t, 0.9, &notes);
  EXPECT_THAT(t.tiles, SizeIs(3));
  EXPECT_THAT(check_tessellation(t), IsEmpty());
  for (const Vec2& corner : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(1, 1)})
    EXPECT_TRUE(std::find(t.vertices.begin(), t.vertices.end(), corner) != t.vertices.end());
  EXPECT_FALSE(notes.empty());
}

TEST(weld, one_note_counts_every_edge_that_stays_short_once) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Tessellation t = tessellate(random_disks(200, 0.03, seed), kUnit, {.hidden = Hidden::kReport});
    std::vector<std::string> notes;
    const double threshold = mean_edge_length(t);
    weld_short_edges(t, threshold, &notes);
    std::set<std::pair<Index, Index>> left;
    for (const Tile& tile : t.tiles)
      for (std::size_t k = 0; k < tile.vertex.size(); ++k)
        if (edge_length(t, tile, k) <= threshold)
          left.insert(std::minmax(tile.vertex[k], tile.vertex[(k + 1) % tile.vertex.size()]));
    ASSERT_GT(left.size(), 5u) << "seed " << seed;
    ASSERT_THAT(notes, SizeIs(2));  // what was welded, and what was not
    EXPECT_EQ(std::stoul(notes[1]), left.size()) << notes[1];
  }
}

TEST(weld, even_a_threshold_of_the_size_of_a_tile_leaves_a_tessellation) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Tessellation t = tessellate(random_disks(200, 0.03, seed), kUnit, {.hidden = Hidden::kReport});
    const std::size_t tiles = t.tiles.size();
    weld_short_edges(t, mean_edge_length(t));
    EXPECT_EQ(t.tiles.size(), tiles);
    EXPECT_THAT(check_tessellation(t), IsEmpty());
  }
}

}  // namespace
}  // namespace lamella
