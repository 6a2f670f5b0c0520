#include "generator/packing/variation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>
#include "generator/packing/stretch.h"

#include "generator/sample/errors.h"

namespace lamella {
namespace {

using ::testing::HasSubstr;

const Box kBox{Vec2::Zero(), Vec2(10, 4)};

SampleScene graded(const std::string& along, std::vector<Vec2> size) {
  SampleScene scene;
  scene.gradient.emplace();
  scene.gradient->along = along;
  scene.gradient->size = std::move(size);
  return scene;
}

TEST(Variation, is_linear_between_its_pairs_and_constant_beyond) {
  const auto factor = size_factor(graded("x", {{2, 1}, {4, 3}, {5, 0.5}}), kBox);
  EXPECT_DOUBLE_EQ(factor({0, 1}), 1);
  EXPECT_DOUBLE_EQ(factor({2, 3}), 1);
  EXPECT_DOUBLE_EQ(factor({3, 0}), 2);
  EXPECT_DOUBLE_EQ(factor({4.5, 0}), 1.75);
  EXPECT_DOUBLE_EQ(factor({9, 0}), 0.5);
  const auto radial = size_factor(graded("radius", {{0, 1}, {5, 6}}), kBox);
  EXPECT_DOUBLE_EQ(radial({5, 2}), 1) << "the middle of the box";
  EXPECT_DOUBLE_EQ(radial({8, 6}), 6);
  EXPECT_FALSE(size_factor(SampleScene(), kBox)) << "nothing varies";
}

TEST(Variation, of_layers_is_that_of_the_last_one_that_holds_the_place) {
  SampleScene scene = graded("y", {{0, 2}});
  LayerScene lower{.from = 0, .to = 2, .polygon = {}, .size = 3, .group = "lower"};
  LayerScene corner{.polygon = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, .size = 0.5, .group = "corner"};
  scene.layers = {lower, corner};
  EXPECT_EQ(layer_at(scene.layers, kBox, {5, 1}), 0);
  EXPECT_EQ(layer_at(scene.layers, kBox, {0.5, 0.5}), 1);
  EXPECT_EQ(layer_at(scene.layers, kBox, {5, 2}), -1) << "where a layer ends the next begins";
  const auto factor = size_factor(scene, kBox);
  EXPECT_DOUBLE_EQ(factor({5, 1}), 6);
  EXPECT_DOUBLE_EQ(factor({0.5, 0.5}), 1);
  EXPECT_DOUBLE_EQ(factor({5, 3}), 2);
}

TEST(Variation, refuses_positions_that_do_not_increase_and_factors_that_are_not_positive) {
  for (const auto& pairs : std::vector<std::vector<Vec2>>{
           {{1, 1}, {1, 2}}, {{2, 1}, {1, 2}}, {{0, 0}}, {{0, -1}}, {{0, NAN}}, {{INFINITY, 1}}, {{NAN, 1}, {2, 1}}}) {
    try {
      size_factor(graded("x", pairs), kBox);
      ADD_FAILURE() << "no error for " << pairs[0].transpose();
    } catch (const SceneError& error) {
      EXPECT_THAT(error.what(), HasSubstr("sample.gradient.size: entry"));
    }
  }
}

TEST(Stretch, keeps_areas_and_makes_circles_ellipses_of_the_asked_axes) {
  const double angle = 0.4, ratio = 3;
  const Eigen::Matrix2d map = stretch_map({.ratio = ratio, .angle = angle});
  EXPECT_NEAR(map.determinant(), 1, 1e-15);
  const Vec2 along(std::cos(angle), std::sin(angle));
  EXPECT_NEAR((map * along - std::sqrt(ratio) * along).norm(), 0, 1e-15);
  EXPECT_NEAR((map * left_of(along) - left_of(along) / std::sqrt(ratio)).norm(), 0, 1e-15);
}

TEST(Stretch, squeezes_a_domain_to_what_it_is_drawn_out_from) {
  DomainScene scene = as_domain({Vec2(-1, 0), Vec2(2, 1)});
  scene.holes.push_back({{}, Vec2(0.5, 0.5), 0.2});
  const Domain domain = make_domain(scene);
  const Eigen::Matrix2d map = stretch_map({.ratio = 2, .angle = 0.5});
  const Domain small = make_domain(squeezed(domain, map));
  EXPECT_NEAR(small.area, domain.area, 1e-14);
  ASSERT_EQ(small.loops.size(), domain.loops.size());
  for (std::size_t l = 0; l < small.loops.size(); ++l)
    for (std::size_t k = 0; k < small.loops[l].size(); ++k)
      EXPECT_NEAR((map * small.loops[l][k] - domain.loops[l][k]).norm(), 0, 1e-14);
}

TEST(Stretch, refuses_numbers_that_make_no_map) {
  for (const double ratio : {0.0, -1.0, double(NAN), double(INFINITY)})
    EXPECT_THROW(stretch_map({.ratio = ratio, .angle = 0}), SceneError);
  EXPECT_THROW(stretch_map({.ratio = 2, .angle = NAN}), SceneError);
}

}  // namespace
}  // namespace lamella
