#include "generator/packing/domain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "generator/sample/errors.h"
#include "random_disks.h"

namespace lamella {
namespace {

using testing::AllOf;
using testing::HasSubstr;

DomainScene polygon(std::vector<Vec2> points) {
  DomainScene scene;
  scene.kind = "polygon";
  scene.points = std::move(points);
  return scene;
}

DomainScene square() { return polygon({{0, 0}, {2, 0}, {2, 2}, {0, 2}}); }

HoleScene round_hole(const Vec2& centre, double radius) {
  HoleScene hole;
  hole.centre = centre, hole.radius = radius;
  return hole;
}

HoleScene hole_of(std::vector<Vec2> points) {
  HoleScene hole;
  hole.points = std::move(points);
  return hole;
}

std::string message_of(const DomainScene& scene) {
  try {
    make_domain(scene);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(domain, a_circle_becomes_a_polygon_of_its_area) {
  for (const int sides : {8, 96, 1001}) {
    DomainScene scene;
    scene.radius = 3e-4, scene.sides = sides;
    EXPECT_NEAR(make_domain(scene).area / (std::numbers::pi * 9e-8), 1, 1e-12);
    scene.kind = "ring", scene.inner_radius = 1e-4;
    scene.holes = {round_hole({2e-4, 0}, 2e-5)};
    const Domain ring = make_domain(scene);
    EXPECT_NEAR(ring.area / (std::numbers::pi * (9e-8 - 1e-8 - 4e-10)), 1, 1e-12);
    EXPECT_EQ(ring.loops.size(), 3U);
  }
}

TEST(domain, the_inside_lies_to_the_left_of_every_side_whichever_way_the_points_run) {
  for (const bool reversed : {false, true}) {
    DomainScene scene = polygon({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}});
    scene.holes = {hole_of({{0.5, 0.3}, {1, 0.3}, {1, 0.6}}), round_hole({3, 0.7}, 0.2)};
    if (reversed) {
      std::reverse(scene.points.begin(), scene.points.end());
      std::reverse(scene.holes[0].points.begin(), scene.holes[0].points.end());
    }
    const Domain domain = make_domain(scene);
    for (const auto& loop : domain.loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec2 a = loop[k], b = loop[(k + 1) % loop.size()], middle = (a + b) / 2;
        EXPECT_TRUE(domain.contains(middle + 1e-6 * left_of(b - a)));
        EXPECT_FALSE(domain.contains(middle - 1e-6 * left_of(b - a)));
      }
    }
  }
}

TEST(domain, random_points_fall_inside_in_proportion_to_the_area) {
  DomainScene scene = polygon({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}});
  scene.holes = {round_hole({3, 0.7}, 0.5)};
  const Domain domain = make_domain(scene);
  Numbers numbers(1);
  const int count = 100000;
  int hits = 0;
  for (int k = 0; k < count; ++k) hits += domain.contains({numbers.between(0, 4), numbers.between(0, 4)});
  const double share = domain.area / domain.box.area();
  EXPECT_NEAR(static_cast<double>(hits) / count, share, 4 * std::sqrt(share * (1 - share) / count));
}

TEST(domain, the_distance_to_the_boundary_is_that_of_the_nearest_of_many_points_on_it) {
  DomainScene scene = square();
  scene.holes = {hole_of({{0.5, 0.5}, {1.4, 0.6}, {0.7, 1.2}})};
  const Domain domain = make_domain(scene);
  Numbers numbers(2);
  for (int k = 0; k < 200; ++k) {
    const Vec2 p(numbers.between(-0.5, 2.5), numbers.between(-0.5, 2.5));
    double nearest = 1e300;
    for (const auto& loop : domain.loops)
      for (std::size_t i = 0; i < loop.size(); ++i)
        for (int s = 0; s <= 1000; ++s)
          nearest = std::min(nearest, (loop[i] + s / 1000.0 * (loop[(i + 1) % loop.size()] - loop[i]) - p).norm());
    EXPECT_LE(domain.distance_to_boundary(p), nearest * (1 + 1e-12));
    EXPECT_GE(domain.distance_to_boundary(p), nearest - 1e-3 * 2);
  }
}

TEST(domain, what_is_no_domain_is_refused) {
  EXPECT_EQ(message_of(square()), "no error");
  EXPECT_THAT(message_of(polygon({{0, 0}, {2, 0}})), HasSubstr("has 2 points"));
  EXPECT_THAT(message_of(polygon({{0, 0}, {2, 0}, {2, 2}, {0, 0}})), HasSubstr("closed anyway"));
  EXPECT_THAT(message_of(polygon({{0, 0}, {2, 0}, {NAN, 2}})), HasSubstr("must be finite"));
  EXPECT_THAT(message_of(polygon({{0, 0}, {1e200, 0}, {0, 1}})), HasSubstr("must be finite"));
  EXPECT_THAT(message_of(polygon({{0, 0}, {1, 1}, {2, 2}})), HasSubstr("encloses no area"));
  EXPECT_THAT(message_of(polygon({{0, 0}, {2, 2}, {2, 0}, {0, 3}})), HasSubstr("touches or crosses"));
  EXPECT_THAT(message_of(polygon({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}})), HasSubstr("touches or crosses"));
  EXPECT_THAT(message_of(polygon({{0, 0}, {2, 0}, {2, 2}, {2, 1e-12}, {0, 2}})), HasSubstr("touches or crosses"));
  DomainScene disk;
  EXPECT_THAT(message_of(disk), HasSubstr("radius = 0"));
  disk.radius = 1, disk.kind = "ring";
  EXPECT_THAT(message_of(disk), HasSubstr("inner_radius = 0"));
  disk.inner_radius = 1;
  EXPECT_THAT(message_of(disk), HasSubstr("less than the radius, 1"));
  disk.inner_radius = 0.5, disk.sides = 7;
  EXPECT_THAT(message_of(disk), HasSubstr("sides = 7"));
  disk.kind = "square";
  EXPECT_THAT(message_of(disk), HasSubstr("kind = \"square\""));
}

TEST(domain, holes_lie_inside_and_apart) {
  const auto with = [](std::vector<HoleScene> holes) {
    DomainScene scene = square();
    scene.holes = std::move(holes);
    return message_of(scene);
  };
  EXPECT_EQ(with({round_hole({0.5, 0.5}, 0.3), round_hole({1.5, 1.5}, 0.3)}), "no error");
  EXPECT_THAT(with({round_hole({3, 3}, 0.3)}), AllOf(HasSubstr("holes[0]"), HasSubstr("outside the domain")));
  EXPECT_THAT(with({round_hole({1, 1}, 5)}), HasSubstr("outside the domain"));
  EXPECT_THAT(with({round_hole({0, 1}, 0.3)}), HasSubstr("touches or crosses"));
  EXPECT_THAT(with({hole_of({{0, 1}, {1, 0.5}, {1, 1.5}})}), HasSubstr("touches or crosses"));
  EXPECT_THAT(with({round_hole({1, 1}, 0.3), round_hole({1.5, 1}, 0.3)}),
              AllOf(HasSubstr("sample.domain.holes[0]"), HasSubstr("sample.domain.holes[1]")));
  EXPECT_THAT(with({round_hole({1, 1}, 0.5), round_hole({1, 1}, 0.3)}),
              AllOf(HasSubstr("holes[1]"), HasSubstr("lies inside sample.domain.holes[0]")));
  EXPECT_THAT(with({round_hole({1, 1}, -1)}), HasSubstr("radius = -1"));
  EXPECT_THAT(with({hole_of({})}), HasSubstr("has 0 points"));
}

}  // namespace
}  // namespace lamella
