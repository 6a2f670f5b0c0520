// Boundaries of pixels as walls, and their simplification: areas, neighbours and soundness by brute force.
#include "generator/image/boundaries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "generator/image/lattice_lines.h"
#include "generator/sample/errors.h"
#include "generator/tissue/crossings.h"
#include "generator/tissue/mosaic.h"
#include "generator/tissue/picture_walls.h"
#include "tests/generator/image/pictures.h"

namespace lamella {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

LabelImage clean(const Picture& picture, int least_area = 1) {
  LabelImage labels = labels_of(picture);
  clean_labels(labels, least_area);
  return labels;
}

std::vector<Vec2> polygon_of(const SimplifiedWalls& walls, Index cell) {
  std::vector<Vec2> points;
  for (const Index v : walls.cells[cell].vertex) points.emplace_back(walls.vertices[v].x, -walls.vertices[v].y);
  return points;
}

double area_of(const SimplifiedWalls& walls, Index cell) {
  const auto points = polygon_of(walls, cell);
  return polygon_area(points.data(), static_cast<Index>(points.size()));
}

std::vector<double> pixels_of_cells(const LabelImage& labels) {
  std::vector<double> pixels(labels.number.size(), 0);
  for (const Index cell : labels.cell)
    if (cell >= 0) ++pixels[cell];
  return pixels;
}

/// The cells whose polygons hold the centre of a pixel.
std::vector<Index> holders(const SimplifiedWalls& walls, int x, int y) {
  std::vector<Index> found;
  for (std::size_t c = 0; c < walls.cells.size(); ++c)
    if (is_inside(polygon_of(walls, static_cast<Index>(c)), Vec2(x + 0.5, -y - 0.5)))
      found.push_back(static_cast<Index>(c));
  return found;
}

using Pairs = std::set<std::pair<Index, Index>>;

Pairs neighbours_of(const LabelImage& labels) {
  Pairs pairs;
  const auto meet = [&](std::size_t p, std::size_t q) {
    const Index a = labels.cell[p], b = labels.cell[q];
    if (a != b && a >= 0 && b >= 0) pairs.insert(std::minmax(a, b));
  };
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      if (x > 0) meet(labels.at(x, y), labels.at(x - 1, y));
      if (y > 0) meet(labels.at(x, y), labels.at(x, y - 1));
    }
  return pairs;
}

Pairs neighbours_of(const SimplifiedWalls& walls) {
  Pairs pairs;
  for (std::size_t c = 0; c < walls.cells.size(); ++c)
    for (const Index beyond : walls.cells[c].beyond)
      if (beyond >= 0) pairs.insert(std::minmax(static_cast<Index>(c), beyond));
  return pairs;
}

/// Polygons are simple, counter-clockwise, share edges with those that they name, and cross nowhere.
void expect_sound(const SimplifiedWalls& walls) {
  std::map<std::pair<Index, Index>, Index> left_of_edge;
  for (std::size_t c = 0; c < walls.cells.size(); ++c) {
    const auto& cell = walls.cells[c];
    ASSERT_GE(cell.vertex.size(), 3u);
    EXPECT_EQ(std::set<Index>(cell.vertex.begin(), cell.vertex.end()).size(), cell.vertex.size());
    EXPECT_GT(area_of(walls, static_cast<Index>(c)), 0);
    for (std::size_t k = 0; k < cell.vertex.size(); ++k) {
      const auto edge = std::pair(cell.vertex[k], cell.vertex[(k + 1) % cell.vertex.size()]);
      EXPECT_TRUE(left_of_edge.emplace(edge, static_cast<Index>(c)).second);
    }
  }
  std::vector<OwnedSegment> segments;
  for (std::size_t c = 0; c < walls.cells.size(); ++c) {
    const auto& cell = walls.cells[c];
    for (std::size_t k = 0; k < cell.vertex.size(); ++k) {
      const Index from = cell.vertex[k], to = cell.vertex[(k + 1) % cell.vertex.size()];
      const auto other = left_of_edge.find({to, from});
      EXPECT_EQ(other == left_of_edge.end() ? -1 : other->second, std::max<Index>(-1, cell.beyond[k]));
      if (other == left_of_edge.end() || from < to)
        segments.push_back(
            {Vec2(walls.vertices[from].x, walls.vertices[from].y), Vec2(walls.vertices[to].x, walls.vertices[to].y)});
    }
  }
  EXPECT_TRUE(find_crossings(segments).empty());
}

/// Farthest that a pixel which changed its cell lies from a pixel that is of that cell [pixels].
void expect_near(const SimplifiedWalls& walls, const LabelImage& labels, double tolerance) {
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      const Index own = labels.cell[labels.at(x, y)];
      const auto found = holders(walls, x, y);
      ASSERT_LE(found.size(), 1u) << "cells overlap";
      const Index now = found.empty() ? kBackground : found[0];
      if (now == own) continue;
      double nearest = 1e9;
      for (int v = 0; v < labels.height; ++v)
        for (int u = 0; u < labels.width; ++u)
          if (labels.cell[labels.at(u, v)] == now) nearest = std::min(nearest, std::hypot(u - x, v - y));
      EXPECT_LE(nearest, tolerance + 1.5) << x << " " << y;
    }
}

TEST(Boundaries, of_two_cells_are_three_walls_between_two_junctions) {
  const Boundaries b = trace_boundaries(clean(drawn({"....", ".12.", ".12.", "...."})));
  ASSERT_EQ(b.walls.size(), 3u);
  EXPECT_THAT(b.node, ElementsAre(Lattice{2, 1}, Lattice{2, 3}));
  int between = 0;
  for (const BoundaryWall& wall : b.walls) between += wall.left >= 0 && wall.right >= 0;
  EXPECT_EQ(between, 1);
  EXPECT_EQ(b.outline[0].size(), 2u);
}

TEST(Boundaries, of_a_cell_alone_are_one_closed_wall) {
  const Boundaries b = trace_boundaries(clean(drawn({"....", ".11.", ".1..", "...."})));
  ASSERT_EQ(b.walls.size(), 1u);
  EXPECT_EQ(b.walls[0].begin, b.walls[0].end);
  EXPECT_EQ(b.walls[0].corner.size(), 7u);  // six corners, the first again
  const SimplifiedWalls walls = simplify_walls(b, 0, 0);
  EXPECT_EQ(area_of(walls, 0), 3);
}

TEST(Boundaries, of_a_full_picture_end_at_the_corners_of_the_box) {
  const SimplifiedWalls walls = simplify_walls(trace_boundaries(clean(drawn({"11", "11", "11"}))), 0.5, 0);
  ASSERT_EQ(walls.cells[0].vertex.size(), 4u);
  EXPECT_THAT(walls.cells[0].beyond, UnorderedElementsAre(kBeyondLeft, kBeyondRight, kBeyondBottom, kBeyondTop));
  for (std::size_t k = 0; k < 4; ++k) {
    const Lattice a = walls.vertices[walls.cells[0].vertex[k]], b = walls.vertices[walls.cells[0].vertex[(k + 1) % 4]];
    switch (walls.cells[0].beyond[k]) {
      case kBeyondLeft:
        EXPECT_EQ(a.x + b.x, 0);
        break;
      case kBeyondRight:
        EXPECT_EQ(a.x + b.x, 4);
        break;
      case kBeyondTop:
        EXPECT_EQ(a.y + b.y, 0);
        break;
      default:
        EXPECT_EQ(a.y + b.y, 6);
    }
  }
}

TEST(Boundaries, of_four_cells_at_a_corner_are_four_walls_there) {
  const Boundaries b = trace_boundaries(clean(drawn({"12", "34"})));
  int there = 0;
  for (const BoundaryWall& wall : b.walls)
    there += (b.node[wall.begin] == Lattice{1, 1}) + (b.node[wall.end] == Lattice{1, 1});
  EXPECT_EQ(there, 4);
}

TEST(Walls, that_are_not_simplified_enclose_exactly_the_pixels_of_each_cell) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const LabelImage labels = clean(wavy(70, 60, random_disks(9, 70, 60, 8, seed), 1.5));
    const SimplifiedWalls walls = simplify_walls(trace_boundaries(labels), 0, 0);
    const auto pixels = pixels_of_cells(labels);
    for (std::size_t c = 0; c < pixels.size(); ++c) EXPECT_EQ(area_of(walls, static_cast<Index>(c)), pixels[c]);
    expect_near(walls, labels, -1.5);  // none changes
    EXPECT_EQ(neighbours_of(walls), neighbours_of(labels));
    expect_sound(walls);
  }
}

TEST(Walls, keep_neighbours_and_soundness_at_every_tolerance) {
  for (unsigned seed = 1; seed <= 4; ++seed)
    for (const double tolerance : {0.5, 1.0, 2.0, 5.0, 100.0}) {
      const LabelImage labels = clean(wavy(70, 60, random_disks(12, 70, 60, 8, seed), 2.5), 6);
      const SimplifiedWalls walls = simplify_walls(trace_boundaries(labels), tolerance, 0);
      expect_sound(walls);
      EXPECT_EQ(neighbours_of(walls), neighbours_of(labels));
      expect_near(walls, labels, tolerance);
    }
}

TEST(Walls, of_noise_are_sound_at_every_tolerance_and_weld) {
  std::mt19937 random(2);
  int cells = 0, refined = 0, welded = 0;
  for (int repeat = 0; repeat < 1500; ++repeat) {
    std::uniform_int_distribution<unsigned> number(repeat % 2, 2 + repeat % 7);
    LabelImage labels = labels_of(picture_of(16, 13, [&](int, int) { return number(random); }));
    try {
      clean_labels(labels, 1 + repeat % 6);
    } catch (const SceneError&) {
      continue;  // a cell around many
    }
    if (labels.number.empty()) continue;
    const double tolerance = 0.7 * (repeat % 9), weld = 0.1 * (repeat % 6);
    const SimplifiedWalls walls = simplify_walls(trace_boundaries(labels), tolerance, weld);
    expect_sound(walls);
    if (weld == 0) {
      EXPECT_EQ(neighbours_of(walls), neighbours_of(labels));
    }
    double area = 0, pixels = 0;
    bool full = true;
    for (const Index cell : labels.cell) full = full && cell >= 0;
    for (std::size_t c = 0; c < walls.cells.size(); ++c) area += area_of(walls, static_cast<Index>(c));
    for (const double p : pixels_of_cells(labels)) pixels += p;
    if (full) {
      EXPECT_EQ(area, pixels);  // no gap, no overlap
    }
    for (int y = 0; y < labels.height; ++y)
      for (int x = 0; x < labels.width; ++x) ASSERT_LE(holders(walls, x, y).size(), 1u) << "cells overlap";
    cells += static_cast<int>(labels.number.size());
    refined += walls.refined;
    welded += walls.welded;
  }
  EXPECT_GT(cells, 1000);
  EXPECT_GT(refined, 100);
  EXPECT_GT(welded, 100);
}

TEST(Walls, keep_their_order_around_a_junction_even_where_none_would_cross) {
  // Found by trying 200000 pictures: both sides of the gap would end up on the wrong side of each other.
  const LabelImage labels = clean(
      drawn({"66666666666", "66666666666", "46666666666", "44466666666", "44446666666", "44444..6666", "44444...366",
             "44444..3333", "44444..3333", "44444.33333", "44444333333", "44444333333", "44443333333", "44443333333",
             "44433333333", "44433333333", "44333333333", "44333333333", "43333333333"}));
  for (double tolerance = 0.5; tolerance < 7; tolerance += 0.25)
    for (double weld = 0; weld < 0.65; weld += 0.1) {
      const SimplifiedWalls walls = simplify_walls(trace_boundaries(labels), tolerance, weld);
      for (double y = 0.3119; y < labels.height; y += 0.5)
        for (double x = 0.2371; x < labels.width; x += 0.5) {
          int cells = 0;
          for (Index c = 0; c < 3; ++c) cells += is_inside(polygon_of(walls, c), Vec2(x, -y));
          ASSERT_LE(cells, 1) << tolerance << " " << weld;
        }
    }
}

TEST(Walls, that_are_welded_part_only_cells_whose_wall_is_shorter_than_the_weld) {
  const double tolerance = 1, weld = 0.4;
  int parted = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const LabelImage labels = clean(wavy(90, 80, random_disks(20, 90, 80, 8, seed), 1.5), 6);
    const Boundaries boundaries = trace_boundaries(labels);
    double sum = 0;
    int count = 0;
    std::map<std::pair<Index, Index>, double> longest;
    for (const BoundaryWall& wall : boundaries.walls) {
      if (wall.left < 0 || wall.right < 0) continue;
      const double length = length_of(simplified(wall.corner, tolerance));
      double& known = longest[std::minmax(wall.left, wall.right)];
      known = std::max(known, length);
      sum += length;
      ++count;
    }
    const SimplifiedWalls walls = simplify_walls(boundaries, tolerance, weld);
    expect_sound(walls);
    const Pairs now = neighbours_of(walls);
    for (const auto& pair : now) EXPECT_TRUE(longest.contains(pair));
    for (const auto& [pair, length] : longest) {
      if (now.contains(pair)) continue;
      ++parted;
      EXPECT_LT(length, weld * sum / count);
    }
  }
  EXPECT_GT(parted, 10);
}

TEST(Walls, shorter_than_the_weld_become_points_that_four_cells_share) {
  // 1 and 4 meet over two pixels, the other walls are about ten times as long.
  const LabelImage labels = clean(picture_of(40, 40, [](int x, int y) {
    if (y < 20) return x < 21 ? 1u : 2u;
    return x < 19 ? 3u : 4u;
  }));
  const SimplifiedWalls walls = simplify_walls(trace_boundaries(labels), 0.5, 0.15);
  EXPECT_EQ(walls.welded, 1);
  expect_sound(walls);
  const Pairs expected{{0, 1}, {0, 2}, {1, 3}, {2, 3}};
  EXPECT_EQ(neighbours_of(walls), expected);
  double area = 0;
  for (Index c = 0; c < 4; ++c) area += area_of(walls, c);
  EXPECT_EQ(area, 1600);
  for (const auto& cell : walls.cells) EXPECT_EQ(cell.vertex.size(), 4u);
  EXPECT_EQ(simplify_walls(trace_boundaries(labels), 0.5, 0.05).welded, 0);
}

TEST(Walls, that_are_welded_at_a_side_of_the_picture_stay_on_it) {
  // The wall of 2 with the top side is 2 pixels long.
  const LabelImage labels = clean(picture_of(40, 30, [](int x, int y) {
    return std::abs(x - 20 + 0.5) < 1 + y / 2.0 ? 2u : x < 20 ? 1u : 3u;
  }));
  const SimplifiedWalls walls = simplify_walls(trace_boundaries(labels), 1, 0.1);
  EXPECT_EQ(walls.welded, 1);
  expect_sound(walls);
  double area = 0;
  for (Index c = 0; c < 3; ++c) area += area_of(walls, c);
  EXPECT_EQ(area, 1200);
}

}  // namespace
}  // namespace lamella
