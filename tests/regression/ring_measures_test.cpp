// What the studies of rings measure with, and the static oracle they compare with.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/studies/squeezed_ring.h"
#include "pipelines/studies/static_ring.h"

namespace lamella {
namespace {

TEST(StaticRing, meets_the_tabled_forces_of_a_ring_without_core) {
  // N = 40, a vertex under the plate, EA R^2 / EI = 4800: equilibria by another program, six digits
  const double forces[] = {1.15684, 2.08688, 2.90862, 3.96586, 5.61588, 8.85644};
  const auto rings = static_ring({40, 4800, 0}, {.1, .2, .3, .4, .5, .6});
  for (std::size_t k = 0; k < rings.size(); ++k) EXPECT_NEAR(rings[k].force, forces[k], 6e-6) << rings[k].strain;
}

TEST(StaticRing, balances_the_half_ring) {
  // across the middle: F = p a - 2 T, T the tension of the sides, here from the virtual work of the plates: dW = -2 R F d(strain)
  const double step = 1e-4;
  const auto rings = static_ring({40, 4800, 2400}, {.25 - step, .25, .25 + step});
  const auto energy = [](const StaticRing& r) {
    const double area = 20 * std::sin(2 * 3.14159265358979324 / 40);
    return r.bars + r.hinges + 2400 * area * r.shrinkage * r.shrinkage / 2;
  };
  EXPECT_NEAR((energy(rings[2]) - energy(rings[0])) / (2 * 2 * step), rings[1].force, 1e-4 * rings[1].force);
  double push = 0;
  for (double p : rings[1].push) push += p / 2;
  EXPECT_NEAR(push, rings[1].force, 1e-9 * push);
}

TEST(ContactLength, is_that_of_a_pressed_line_with_edges) {
  const double line = 30, length = .8, edge = 7;
  const double force = line * length + edge, moment = (line * length * length / 4 + edge * length / 2) / force;
  EXPECT_NEAR(contact_length(force, moment, line), length, 1e-12);
  EXPECT_NEAR(edge_force(force, moment, line), edge, 1e-12);
  EXPECT_NEAR(contact_length(force, moment, 0), 2 * moment, 1e-12);
  EXPECT_EQ(contact_length(0, 0, 0), 0);
}

/// Force 100 strain^2 on the way in, 1 on the way out, which is another stage.
RingCourse parabola() {
  RingCourse course;
  for (int k = 0; k <= 20; ++k) {
    SqueezedRing ring;
    ring.strain = .01 * k, ring.force = 100 * ring.strain * ring.strain,
    ring.work = 2 * 100 * std::pow(ring.strain, 3) / 3;
    course.frames.push_back(ring);
  }
  for (int k = 20; k >= 0; --k) {
    SqueezedRing ring;
    ring.stage = 1, ring.strain = .01 * k, ring.force = 1;
    course.frames.push_back(ring);
  }
  return course;
}

TEST(RingCourse, is_asked_on_the_way_in) {
  const RingCourse course = parabola();
  EXPECT_EQ(course.turn(), 20u);
  EXPECT_NEAR(course.at(.105, .03).force, 100 * .105 * .105, 1e-12);
  EXPECT_NEAR(course.nearest(.104).force, 1, 1e-12);
  EXPECT_NEAR(course.mean_force(.05, .15), 100 * (.15 * .15 + .15 * .05 + .05 * .05) / 3, 1e-12);
  EXPECT_EQ(course.inward(&SqueezedRing::force).size(), 21u);
}

}  // namespace
}  // namespace lamella
