#include <gtest/gtest.h>

#include <cmath>

#include "postproc/quantities/cell_energy.h"
#include "postproc/quantities/cell_shape.h"
#include "postproc/quantities/cell_stress.h"
#include "tests/postproc/hexagons.h"

namespace lamella {
namespace {

Sample one_cell(const std::vector<Vec2>& points, double radius) {
  Sample sample;
  sample.cell_begin = {0};
  add_cell(sample, points, true, radius, "cells");
  sample.tile_area.resize(1);
  sample.side.assign(sample.nodes(), 0);
  return sample;
}

TEST(CellShape, a_sphero_square_has_the_area_of_its_parts) {
  const double r = 0.1;
  const Sample sample = one_cell({{3, 5}, {4, 5}, {4, 6}, {3, 6}}, r);
  const CellShape shape = cell_shape(sample, sample.x, 0);
  EXPECT_NEAR(shape.area, 1, 1e-14);
  EXPECT_NEAR(shape.perimeter, 4, 1e-14);
  EXPECT_NEAR(shape.outline_area, 1 + 4 * r + M_PI * r * r, 1e-14);
  EXPECT_NEAR(shape.outline_perimeter, 4 + 2 * M_PI * r, 1e-14);
  EXPECT_NEAR(shape.aspect, 1, 1e-7);
  EXPECT_LT((shape.centroid - Vec2(3.5, 5.5)).norm(), 1e-14);
}

TEST(CellShape, bands_overlap_once_at_a_concave_corner) {
  const double r = 0.1;
  const Sample sample = one_cell({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, r);
  const CellShape shape = cell_shape(sample, sample.x, 0);
  EXPECT_NEAR(shape.outline_area, 3 + 8 * r + 5 * M_PI * r * r / 4 - r * r, 1e-14);
  EXPECT_NEAR(shape.outline_perimeter, 8 + 5 * M_PI * r / 2 - 2 * r, 1e-14);
}

TEST(CellShape, a_turned_rectangle_keeps_its_aspect_and_shows_its_direction) {
  const double angle = 0.4;
  std::vector<Vec2> points;
  for (const Vec2& p : {Vec2(0, 0), Vec2(3, 0), Vec2(3, 1), Vec2(0, 1)})
    points.push_back(std::cos(angle) * p + std::sin(angle) * left_of(p) + Vec2(10, -7));
  const Sample sample = one_cell(points, 0.01);
  const CellShape shape = cell_shape(sample, sample.x, 0);
  EXPECT_NEAR(shape.aspect, 3, 1e-10);
  EXPECT_NEAR(shape.orientation, angle, 1e-10);
}

/// Two squares pulled apart by F along x.
Frame pulled_pair(const Sample& sample, double force) {
  Frame frame = plain_frame(sample, sample.x, 0);
  Frame loaded;
  for (NamedArray array : frame.arrays.all()) {
    if (array.name == "link_force") array.data = std::vector<double>{force / 2, 0, force / 2, 0};
    loaded.arrays.add(std::move(array));
  }
  std::vector<double> load(2 * sample.nodes(), 0.0);
  for (Index i : {0, 3}) load[2 * i] = -force / 2;
  for (Index i : {5, 6}) load[2 * i] = force / 2;
  loaded.arrays.add({"load_force", "N", "node", 2, load});
  return loaded;
}

TEST(CellStress, a_pulled_pair_carries_its_force_times_its_length) {
  const double r = 0.1, force = 7, depth = 0.5;
  const Sample sample = two_squares(r);
  ASSERT_EQ(sample.links.size(), 2u);
  const Frame frame = pulled_pair(sample, force);
  const FrameView view(sample, frame);
  const std::vector<CellShape> shapes = cell_shapes(sample, view.x);
  const std::vector<Stress> stress = cell_stress(view, shapes, depth);
  for (const Stress& s : stress) {
    EXPECT_NEAR(s.xx, force * (1 + r) / (1.5 * depth), 1e-12);
    EXPECT_NEAR(s.yy, 0, 1e-12);
    EXPECT_NEAR(s.xy, 0, 1e-12);
  }
  // the mean is the grips' force over the width that belongs to the tiles, 3 / (2 + 2 r)
  EXPECT_NEAR(mean_stress(sample, shapes, stress).xx, force * (2 + 2 * r) / (3 * depth), 1e-12);
}

TEST(CellStress, gaps_are_shared_out_as_the_cell_grows) {
  const Sample sample = two_squares(0.1);
  std::vector<Vec2> x = sample.x;
  for (Vec2& p : x) p *= 2;
  EXPECT_NEAR(tile_area(sample, cell_shape(sample, x, 0), 0), 4 * 1.5, 1e-12);
}

TEST(CellStress, a_contact_that_pushes_compresses_both_cells) {
  const double r = 0.1, force = 3;
  const Sample sample = two_squares(r);
  Frame frame;
  std::vector<double> flat;
  for (const Vec2& p : sample.x) flat.push_back(p.x()), flat.push_back(p.y());
  frame.arrays.add({"x", "m", "node", 2, flat});
  // node 1 of the left cell touches the right one, and is pushed to the left
  frame.arrays.add({"contact_position", "m", "contact", 2, std::vector<double>{1 + r, 0}});
  frame.arrays.add({"contact_normal", "1", "contact", 2, std::vector<double>{-1, 0}});
  frame.arrays.add({"contact_force", "N", "contact", 2, std::vector<double>{force, 0}});
  frame.arrays.add({"contact_node", "1", "contact", 1, std::vector<std::int32_t>{1}});
  frame.arrays.add({"contact_cell", "1", "contact", 1, std::vector<std::int32_t>{1}});
  std::vector<double> load(2 * sample.nodes(), 0.0);
  load[0] = force, load[2 * 5] = -force;
  frame.arrays.add({"load_force", "N", "node", 2, load});
  const FrameView view(sample, frame);
  const std::vector<Stress> stress = cell_stress(view, cell_shapes(sample, view.x), 1);
  for (const Stress& s : stress) EXPECT_NEAR(s.xx, -force * (1 + r) / 1.5, 1e-12);
}

TEST(CellEnergy, links_are_shared_half_and_half_and_kept_apart) {
  const Sample sample = two_squares(0.1);
  Frame frame;
  std::vector<double> flat(2 * sample.nodes(), 0.0);
  frame.arrays.add({"x", "m", "node", 2, flat});
  frame.arrays.add({"bar_energy", "J", "cell", 1, std::vector<double>{1, 2}});
  frame.arrays.add({"core_energy", "J", "cell", 1, std::vector<double>{10, 20}});
  frame.arrays.add({"link_energy", "J", "link", 1, std::vector<double>{0.5, 0.7}});
  const CellEnergy energy = cell_energy(FrameView(sample, frame));
  EXPECT_EQ(energy.total, (std::vector<double>{11, 22}));
  EXPECT_TRUE(energy.bend.empty());
  EXPECT_NEAR(energy.link_share[0], 0.6, 1e-15);
  EXPECT_NEAR(energy.link_share[1], 0.6, 1e-15);
}

}  // namespace
}  // namespace lamella
