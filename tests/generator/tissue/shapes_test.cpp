#include "generator/tissue/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "generator/generate.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

Sample sample_of(const ShapeScene& shape) {
  Sample sample;
  sample.cell_begin.push_back(0);
  add_shape(
      shape, [](const std::string&) { return 0.01; }, sample);
  sample.box = {Vec2::Constant(-10), Vec2::Constant(10)};
  EXPECT_THAT(check_sample(sample), ::testing::IsEmpty());
  return sample;
}

ShapeScene chain(int segments, const std::string& clamp, const std::string& hinge) {
  ShapeScene shape;
  shape.from = Vec2(0, 0);
  shape.to = Vec2(3, 4);
  shape.segments = segments;
  shape.clamp = clamp;
  shape.clamp_hinge = hinge;
  return shape;
}

TEST(Chain, is_straight_with_equal_segments) {
  const Sample sample = sample_of(chain(10, "none", "half"));
  EXPECT_EQ(sample.nodes(), 11);
  EXPECT_EQ(sample.closed[0], 0);
  for (Index k = 0; k < 10; ++k) EXPECT_NEAR(sample.rest_length[k], 0.5, 1e-15);
  for (const double angle : sample.rest_angle) EXPECT_EQ(angle, 0);
}

TEST(Chain, has_a_ghost_segment_and_half_a_hinge_at_a_clamp) {
  const Sample start = sample_of(chain(10, "start", "half"));
  EXPECT_EQ(start.nodes(), 12);
  EXPECT_NEAR((start.x[1] - Vec2(0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((start.x[0] - Vec2(-0.3, -0.4)).norm(), 0, 1e-15);
  EXPECT_NEAR(start.hinge_length[1], 0.25, 1e-15);
  EXPECT_NEAR(start.hinge_length[2], 0.5, 1e-15);
  const Sample naive = sample_of(chain(10, "start", "full"));
  EXPECT_NEAR(naive.hinge_length[1], 0.5, 1e-15);
  const Sample both = sample_of(chain(10, "both", "half"));
  EXPECT_EQ(both.nodes(), 13);
  EXPECT_NEAR(both.hinge_length[11], 0.25, 1e-15);
  EXPECT_NEAR((both.x[11] - Vec2(3, 4)).norm(), 0, 1e-15);
}

/// Small deflection of a cantilever by adding up the rotations of its hinges under a tip load, k_b = EI / hinge length.
TEST(Chain, clamped_at_half_a_hinge_bends_by_the_closed_form) {
  for (const int n : {8, 16, 64}) {
    for (const auto& [hinge, expected] : {std::pair<std::string, double>{"half", 1 + 1 / (2.0 * n * n)},
                                          {"full", 1 + 3 / (2.0 * n) + 1 / (2.0 * n * n)}}) {
      const Sample sample = sample_of(chain(n, "start", hinge));
      double deflection = 0;
      for (Index k = 1; k + 1 < sample.nodes(); ++k) {
        const double arm = (sample.x.back() - sample.x[k]).norm();
        deflection += arm * arm * sample.hinge_length[k];
      }
      EXPECT_NEAR(deflection / (125.0 / 3), expected, 1e-12);
    }
  }
}

TEST(Box, is_an_open_chain_down_along_and_up) {
  ShapeScene shape;
  shape.kind = "box";
  shape.from = Vec2(1, 5);
  shape.to = Vec2(3, 2);
  shape.segments = 4;
  const Sample sample = sample_of(shape);
  EXPECT_EQ(sample.nodes(), 13);
  EXPECT_EQ(sample.closed[0], 0);
  EXPECT_EQ(sample.x[0], Vec2(1, 5));
  EXPECT_EQ(sample.x[4], Vec2(1, 2));
  EXPECT_EQ(sample.x[8], Vec2(3, 2));
  EXPECT_EQ(sample.x[12], Vec2(3, 5));
  EXPECT_NEAR(sample.rest_angle[4], std::numbers::pi / 2, 1e-15);
}

TEST(Ring, has_its_vertices_on_the_circle_from_its_rotation_on) {
  ShapeScene shape;
  shape.kind = "ring";
  shape.centre = Vec2(1, 2);
  shape.size = 0.5;
  shape.segments = 40;
  shape.rotation = 0.1;
  const Sample sample = sample_of(shape);
  EXPECT_EQ(sample.nodes(), 40);
  for (const Vec2& x : sample.x) EXPECT_NEAR((x - shape.centre).norm(), 0.5, 1e-15);
  EXPECT_NEAR((sample.x[0] - shape.centre - 0.5 * Vec2(std::cos(0.1), std::sin(0.1))).norm(), 0, 1e-15);
  EXPECT_NEAR(sample.rest_area[0], 0.5 * 40 * 0.25 * std::sin(2 * std::numbers::pi / 40), 1e-14);
}

TEST(Polygon, is_closed_or_open_with_its_sides_divided) {
  ShapeScene shape;
  shape.kind = "polygon";
  shape.points = {{0, 0}, {0, 2}, {2, 2}};
  shape.segments = 4;
  const Sample closed = sample_of(shape);
  EXPECT_EQ(closed.nodes(), 12);
  EXPECT_NEAR(closed.rest_area[0], 2, 1e-14);
  shape.open = true;
  EXPECT_EQ(sample_of(shape).nodes(), 9);
}

TEST(Shapes, that_cannot_be_made_are_refused) {
  const auto refused = [](auto change) {
    ShapeScene shape = chain(4, "none", "half");
    change(shape);
    EXPECT_THROW(sample_of(shape), SceneError);
  };
  refused([](ShapeScene& s) { s.segments = 0; });
  refused([](ShapeScene& s) { s.to = s.from; });
  refused([](ShapeScene& s) { s.kind = "ring"; });
  refused([](ShapeScene& s) { s.kind = "polygon"; });
  refused([](ShapeScene& s) { s.kind = "star"; });
  refused([](ShapeScene& s) {
    s.kind = "box";
    s.to = Vec2(0, 1);
  });
  refused([](ShapeScene& s) {
    s.kind = "polygon";
    s.points = {{0, 0}, {1, 0}, {1, 1}, {0, 0}};
  });
  refused([](ShapeScene& s) {
    s.kind = "polygon";
    s.points = {{0, 0}, {1, 0}, {2, 0}};
  });
}

TEST(Rings, keep_their_outlines_inside_the_disks) {
  Packing packing;
  packing.box = {Vec2::Zero(), Vec2(4, 2)};
  packing.disks = {{Vec2(1, 1), 1}, {Vec2(3, 1), 0.8}};
  const Sample sample = make_rings(packing, 24, 0.1, "cells", {4.2, 3.8});
  EXPECT_THAT(check_sample(sample), ::testing::IsEmpty());
  EXPECT_EQ(sample.nodes(), 48);
  for (Index k = 0; k < 24; ++k) EXPECT_NEAR((sample.x[k] - Vec2(1, 1)).norm() + sample.radius[0], 1, 1e-14);
  for (Index k = 24; k < 48; ++k) EXPECT_NEAR((sample.x[k] - Vec2(3, 1)).norm() + sample.radius[1], 0.8, 1e-14);
  EXPECT_EQ(sample.tile_area[1], 3.8);
  EXPECT_THROW(make_rings(packing, 24, 0.9, "cells", {}), SceneError);
}

}  // namespace
}  // namespace lamella
