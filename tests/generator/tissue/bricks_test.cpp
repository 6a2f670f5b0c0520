#include "generator/tissue/bricks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "generator/sample/errors.h"
#include "generator/tissue/walls.h"

namespace lamella {
namespace {

using ::testing::IsEmpty;

SampleScene bricks(int columns, int rows, double shift) {
  SampleScene scene;
  scene.kind = "bricks";
  scene.columns = columns;
  scene.rows = rows;
  scene.brick = Vec2(3, 1);
  scene.shift = shift;
  scene.walls.spacing = 0.2;
  return scene;
}

double area_of(const Mosaic& mosaic, const MosaicCell& cell) {
  const auto points = polygon_of(mosaic, cell);
  return polygon_area(points.data(), static_cast<Index>(points.size()));
}

TEST(Bricks, fill_their_box_with_whole_ones_and_parts_at_the_ends_of_shifted_rows) {
  for (const double shift : {0.0, 0.25, 0.5, 0.8}) {
    const Mosaic mosaic = make_bricks(bricks(5, 4, shift));
    EXPECT_EQ(mosaic.cells.size(), shift > 0 ? 22u : 20u) << "two shifted rows have a part more";
    double sum = 0;
    int whole = 0, first = 0, last = 0;
    for (const MosaicCell& cell : mosaic.cells) {
      const double area = area_of(mosaic, cell);
      sum += area;
      whole += std::abs(area - 3) < 1e-12;
      first += std::abs(area - 3 * shift) < 1e-12;
      last += std::abs(area - 3 * (1 - shift)) < 1e-12;
    }
    EXPECT_NEAR(sum, mosaic.box.area(), 1e-12);
    EXPECT_EQ(whole, shift > 0 ? 18 : 20);
    if (shift == 0) continue;
    EXPECT_EQ(first, shift == 0.5 ? 4 : 2);
    EXPECT_EQ(last, shift == 0.5 ? 4 : 2);
  }
}

TEST(Bricks, obey_euler_and_meet_three_at_a_vertex_where_rows_are_shifted) {
  for (const double shift : {0.0, 0.3, 0.5}) {
    const Mosaic mosaic = make_bricks(bricks(6, 5, shift));
    std::map<std::pair<Index, Index>, int> edges;
    std::map<Index, std::set<Index>> around;  // vertex -> neighbours
    for (const MosaicCell& cell : mosaic.cells)
      for (std::size_t k = 0; k < cell.vertex.size(); ++k) {
        const Index u = cell.vertex[k], v = cell.vertex[(k + 1) % cell.vertex.size()];
        ++edges[{std::min(u, v), std::max(u, v)}];
        around[u].insert(v), around[v].insert(u);
      }
    const auto vertices = static_cast<int>(around.size());
    EXPECT_EQ(around.size(), mosaic.vertices.size()) << "no vertex is unused";
    EXPECT_EQ(vertices - static_cast<int>(edges.size()) + static_cast<int>(mosaic.cells.size()), 1);
    int four = 0;
    for (const auto& [v, others] : around) {
      EXPECT_GE(others.size(), 2u);
      EXPECT_LE(others.size(), 4u);
      four += others.size() == 4;
    }
    EXPECT_EQ(four, shift > 0 ? 0 : 5 * 4);
    for (const auto& [edge, count] : edges) EXPECT_LE(count, 2);
  }
}

TEST(Bricks, are_linked_to_two_below_and_two_above) {
  Notes notes;
  const SampleScene scene = bricks(4, 3, 0.5);
  const Mosaic mosaic = make_bricks(scene);
  const Sample sample = make_tissue(mosaic, scene.walls, 0.05, "cells", notes);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  std::map<Index, int> neighbours;
  for (const Wall& wall : sample.walls) ++neighbours[wall.cell_a], ++neighbours[wall.cell_b];
  // Row 0 has cells 0 - 3, row 1 has 4 - 8 with halves at its ends.
  EXPECT_EQ(sample.walls.size(), 3u + 4u + 3u + 2u * 8u);
  EXPECT_EQ(neighbours[6], 6) << "two beside, two below, two above";
  EXPECT_EQ(neighbours[4], 3) << "a half: one beside, one below, one above";
  EXPECT_EQ(neighbours[1], 4);
  for (const Link& link : sample.links) EXPECT_NEAR(link.offset_n, 0.1, 1e-12);
}

TEST(Bricks, carry_the_bits_of_the_sides_of_their_box) {
  const Mosaic mosaic = make_bricks(bricks(4, 3, 0.5));
  std::map<int, double> length;
  for (const MosaicCell& cell : mosaic.cells)
    for (std::size_t k = 0; k < cell.vertex.size(); ++k)
      length[cell.side[k]] +=
          (mosaic.vertices[cell.vertex[(k + 1) % cell.vertex.size()]] - mosaic.vertices[cell.vertex[k]]).norm();
  EXPECT_NEAR(length[kLeft], 3, 1e-12);
  EXPECT_NEAR(length[kRight], 3, 1e-12);
  EXPECT_NEAR(length[kBottom], 12, 1e-12);
  EXPECT_NEAR(length[kTop], 12, 1e-12);
}

TEST(Bricks, without_a_size_or_with_too_many_are_refused) {
  for (const auto& [columns, rows, width, shift] : {std::tuple{0, 3, 1.0, 0.5},
                                                    {3, 0, 1.0, 0.5},
                                                    {3, 3, 0.0, 0.5},
                                                    {3, 3, -1.0, 0.5},
                                                    {3, 3, NAN, 0.5},
                                                    {3, 3, 1.0, 1.0},
                                                    {3, 3, 1.0, -0.1},
                                                    {10000, 10000, 1.0, 0.5}}) {
    SampleScene scene = bricks(columns, rows, shift);
    scene.brick.x() = width;
    EXPECT_THROW(make_bricks(scene), SceneError) << columns << " " << rows << " " << width << " " << shift;
  }
}

}  // namespace
}  // namespace lamella
