// Packings in domains, and with radii that depend on the place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "generator/packing/domain.h"
#include "generator/packing/packing.h"
#include "generator/packing/sizes.h"
#include "generator/sample/errors.h"
#include "random_disks.h"

namespace lamella {
namespace {

using testing::AllOf;
using testing::HasSubstr;

PackingScene asked(double fraction) {
  PackingScene scene;
  scene.fraction = fraction;
  return scene;
}

std::vector<double> lognormal_radii(int count, double cv, std::uint64_t seed) {
  SizesScene sizes;
  sizes.cv = cv;
  return draw_radii(sizes, count, seed, {});
}

HoleScene round_hole(const Vec2& centre, double radius) {
  HoleScene hole;
  hole.centre = centre, hole.radius = radius;
  return hole;
}

DomainScene disk(double radius) {
  DomainScene scene;
  scene.radius = radius;
  return scene;
}

DomainScene ring() {
  DomainScene scene = disk(3);
  scene.kind = "ring", scene.inner_radius = 1.5;
  return scene;
}

/// Concave, far from the origin, with a thin slit and a round hole.
DomainScene bracket() {
  DomainScene scene;
  scene.kind = "polygon";
  for (const Vec2& p : {Vec2(0, 0), Vec2(5, 0), Vec2(5, 2), Vec2(2, 2), Vec2(2, 5), Vec2(0, 4)})
    scene.points.push_back(p + Vec2(-700, 400));
  HoleScene slit;
  for (const Vec2& p : {Vec2(1, 2.5), Vec2(1.001, 2.5), Vec2(1.001, 4), Vec2(1, 4)})
    slit.points.push_back(p + Vec2(-700, 400));
  scene.holes = {slit, round_hole({-696.5, 401}, 0.5)};
  return scene;
}

/// Oracle: every pair of disks, and every disk with points close to each other on every side of the domain.
void expect_no_overlap(const Packing& packing, const Domain& domain) {
  double closest = 1e300;
  for (std::size_t i = 0; i < packing.disks.size(); ++i) {
    const Disk& a = packing.disks[i];
    for (std::size_t j = 0; j < i; ++j)
      closest = std::min(closest, (packing.disks[j].centre - a.centre).norm() - a.radius - packing.disks[j].radius);
    EXPECT_TRUE(domain.contains(a.centre));
    for (const auto& loop : domain.loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec2 from = loop[k], along = loop[(k + 1) % loop.size()] - from;
        // The projection onto the side, or an end.
        const double t = (a.centre - from).dot(along) / along.squaredNorm();
        if (t > 0 && t < 1)
          closest = std::min(closest, std::abs(cross(along, a.centre - from)) / along.norm() - a.radius);
        closest = std::min(closest, (a.centre - from).norm() - a.radius);
      }
    }
  }
  EXPECT_GE(closest, -1e-15 * domain.box.hi.cwiseAbs().maxCoeff());
}

TEST(packing_space, disks_fill_a_domain_and_stay_inside_it) {
  for (const DomainScene& scene : {disk(2), ring(), bracket()}) {
    const Domain domain = make_domain(scene);
    for (const double cv : {0.0, 0.3, 0.8}) {
      const auto radii = lognormal_radii(400, cv, 5);
      const Packing packing = pack(asked(0.78), radii, {.width = 0, .height = 0, .domain = &domain, .factor = {}}, 5);
      expect_no_overlap(packing, domain);
      double area = 0;
      for (const Disk& d : packing.disks) area += std::numbers::pi * d.radius * d.radius;
      EXPECT_NEAR(area / domain.area, 0.78, 1e-9) << scene.kind << " CV " << cv;
      EXPECT_NEAR(packing.fraction, 0.78, 1e-9);
      for (std::size_t k = 1; k < radii.size(); ++k)
        EXPECT_NEAR(packing.disks[k].radius / packing.disks[0].radius, radii[k] / radii[0], 1e-9 * radii[k] / radii[0]);
      EXPECT_EQ(packing.box.lo, domain.box.lo);
      EXPECT_EQ(packing.box.hi, domain.box.hi);
    }
  }
}

TEST(packing_space, the_search_for_overlaps_sees_the_boundary_from_both_sides) {
  const Domain domain = make_domain(ring());
  Packing packing;
  packing.box = domain.box;
  const double at_side =
      3 * std::cos(std::numbers::pi / 96) * std::sqrt(2 * std::numbers::pi / 96 / std::sin(2 * std::numbers::pi / 96));
  const double angle = std::numbers::pi / 96;
  const auto overlap = [&](double distance, double radius) {
    packing.disks = {{distance * Vec2(std::cos(angle), std::sin(angle)), radius}};
    return largest_overlap(packing, domain);
  };
  EXPECT_NEAR(overlap(2.5, 0.3), 2.5 + 0.3 - at_side, 1e-12);
  EXPECT_NEAR(overlap(2.5, 0.6), 2.5 + 0.6 - at_side, 1e-12);
  EXPECT_NEAR(overlap(at_side + 0.2, 0.3), 0.5, 1e-12);  // outside by 0.2
  EXPECT_GT(overlap(0, 0.1), 1);                         // in the middle of the ring, where there is none
}

TEST(packing_space, two_chambers_fill_evenly_although_disks_hardly_pass_between_them) {
  DomainScene dumb_bell;
  dumb_bell.kind = "polygon";
  dumb_bell.points = {{0, 0}, {2, 0}, {2, 0.95}, {4, 0.95}, {4, 0}, {6, 0},
                      {6, 2}, {4, 2}, {4, 1.05}, {2, 1.05}, {2, 2}, {0, 2}};
  const Domain domain = make_domain(dumb_bell);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Packing packing = pack(asked(0.78), lognormal_radii(1000, 0.3, seed),
                                 {.width = 0, .height = 0, .domain = &domain, .factor = {}}, seed);
    expect_no_overlap(packing, domain);
    double left = 0;
    for (const Disk& d : packing.disks)
      if (d.centre.x() < 2) left += std::numbers::pi * d.radius * d.radius;
    EXPECT_NEAR(left / 4, 0.78, 0.03);
  }
}

TEST(packing_space, a_domain_can_be_jammed) {
  const Domain domain = make_domain(disk(1));
  PackingScene scene = asked(0.7);
  scene.jammed = true;
  const Packing packing =
      pack(scene, lognormal_radii(300, 0.3, 1), {.width = 0, .height = 0, .domain = &domain, .factor = {}}, 1);
  expect_no_overlap(packing, domain);
  EXPECT_GT(packing.fraction, 0.80);
  EXPECT_LT(packing.fraction, 0.86);
}

TEST(packing_space, a_scene_s_domain_is_filled_and_what_does_not_fit_is_refused) {
  Scene scene;
  scene.sample.domain = ring();
  scene.sample.packing.count = 200;
  scene.sample.packing.fraction = 0.75;
  expect_no_overlap(make_packing(scene), make_domain(ring()));
  scene.sample.packing.fraction = 0.9;
  try {
    make_packing(scene);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("jam at about 0."), HasSubstr("in this domain")));
  }
  scene.sample.packing.fraction = 0.5;
  scene.sample.packing.boundary = "periodic";
  EXPECT_THROW(make_packing(scene), SceneError);
  scene.sample.packing.boundary = "walls";
  scene.sample.packing.count = 1;  // wider than the ring
  EXPECT_THROW(make_packing(scene), SceneError);
}

double gradient(const Vec2& x) { return 1 + 2 * x.x(); }

TEST(packing_space, radii_follow_a_gradient) {
  for (const char* boundary : {"walls", "periodic_y"}) {
    PackingScene scene = asked(0.8);
    scene.boundary = boundary;
    const auto radii = lognormal_radii(2000, 0.3, 7);
    const Packing packing = pack(scene, radii, {.width = 1, .height = 1, .domain = nullptr, .factor = gradient}, 7);
    EXPECT_NEAR(packing.fraction, 0.8, 1e-9);
    EXPECT_LE(largest_overlap(packing), 0);
    double least = 1e300, most = 0;
    for (std::size_t k = 0; k < radii.size(); ++k) {
      const double scale = packing.disks[k].radius / (radii[k] * gradient(packing.disks[k].centre));
      least = std::min(least, scale), most = std::max(most, scale);
    }
    EXPECT_LT(most / least - 1, 2 * 0.01);
    EXPECT_LE(packing.size_deviation, 0.01);
    EXPECT_GE(2.1 * packing.size_deviation, most / least - 1);  // reported honestly

    // Everywhere the same fraction: with radii three times as large at one end as at the other.
    for (const double from : {0.0, 0.25, 0.5, 0.75}) {
      double area = 0;
      for (const Disk& d : packing.disks)
        if (d.centre.x() >= from && d.centre.x() < from + 0.25) area += std::numbers::pi * d.radius * d.radius;
      EXPECT_NEAR(area / 0.25, 0.8, 0.04) << from;
    }
  }
}

TEST(packing_space, a_factor_of_one_changes_only_what_is_drawn_at_random) {
  const auto radii = lognormal_radii(200, 0.3, 7);
  const auto one = [](const Vec2&) { return 1.0; };
  const Packing packing = pack(asked(0.8), radii, {.width = 1, .height = 1, .domain = nullptr, .factor = one}, 7);
  EXPECT_LE(packing.size_deviation, 1e-12);
  EXPECT_NEAR(packing.fraction, 0.8, 1e-9);
}

TEST(packing_space, layers_have_sizes_of_their_own) {
  const auto layers = [](const Vec2& x) { return x.y() < 0.5 ? 1.0 : 2.5; };
  const auto radii = lognormal_radii(1000, 0.1, 3);
  const Packing packing = pack(asked(0.79), radii, {.width = 1, .height = 1, .domain = nullptr, .factor = layers}, 3);
  EXPECT_LE(largest_overlap(packing), 0);
  const double small = [&] {
    std::vector<double> scale;
    for (std::size_t k = 0; k < radii.size(); ++k) scale.push_back(packing.disks[k].radius / radii[k]);
    return *std::min_element(scale.begin(), scale.end());
  }();
  int right = 0;
  for (std::size_t k = 0; k < radii.size(); ++k)
    right += std::abs(packing.disks[k].radius / (radii[k] * small * layers(packing.disks[k].centre)) - 1) < 0.01;
  EXPECT_GE(right, 998);
}

TEST(packing_space, a_factor_that_is_none_is_refused) {
  const auto radii = lognormal_radii(20, 0.1, 3);
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    const auto factor = [bad](const Vec2& x) { return x.x() < 0.5 ? 1 : bad; };
    EXPECT_THROW(pack(asked(0.7), radii, {.width = 1, .height = 1, .domain = nullptr, .factor = factor}, 3),
                 SceneError);
  }
}

TEST(packing_space, a_gradient_in_a_domain_and_the_same_seed_twice) {
  const Domain domain = make_domain(ring());
  const auto outward = [](const Vec2& x) { return 0.5 + x.norm() / 3; };
  const auto radii = lognormal_radii(600, 0.3, 3);
  const PackingSpace space{.width = 0, .height = 0, .domain = &domain, .factor = outward};
  const Packing packing = pack(asked(0.77), radii, space, 3), again = pack(asked(0.77), radii, space, 3);
  expect_no_overlap(packing, domain);
  EXPECT_LE(packing.size_deviation, 0.02);
  for (std::size_t k = 0; k < radii.size(); ++k) {
    EXPECT_EQ(packing.disks[k].centre, again.disks[k].centre);
    EXPECT_EQ(packing.disks[k].radius, again.disks[k].radius);
  }
}

}  // namespace
}  // namespace lamella
