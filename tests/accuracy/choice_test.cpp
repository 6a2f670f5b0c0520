// What is chosen for an accepted error follows from the sample's slowest swing, and is what --set would take.
#include "pipelines/accuracy/choice.h"

#include <gmock/gmock.h>

#include <cmath>

#include "generator/generate.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

const std::string kSpring = R"([sample]
kind = "shapes"
[[sample.shapes]]
kind = "chain"
from = [0, 0]
to = [2, 0]
segments = 2
[cells]
axial_rigidity = 100
bending_rigidity = 0
mass_per_length = 1
radius = 0.01
[[loads]]
name = "hold"
nodes = { end = "start" }
velocity_x = 0
velocity_y = 0
[[loads]]
name = "pull"
nodes = { end = "end" }
velocity_x = 0.1
velocity_y = 0
[stop]
time = 3
)";

Choice choose(const std::string& text, double accepted) {
  const Scene scene = parse_scene(text);
  Notes notes;
  return first_choice(generate(scene, notes), scene, accepted);
}

TEST(Choice, follows_the_slowest_swing) {
  // One node of mass 1 between two springs of 100; across, without tension, it has no stiffness.
  const Choice one = choose(kSpring, 0.01);
  ASSERT_TRUE(one.frequency);
  EXPECT_NEAR(*one.frequency, std::sqrt(200), 1e-3);
  ASSERT_TRUE(one.drag);
  EXPECT_LT(*one.drag, 2 * *one.frequency) << "critical damping";
  EXPECT_NEAR(choose(kSpring, 0.005).slowdown / one.slowdown, 2, 1e-3) << "first order";
}

TEST(Choice, keeps_the_damping_and_the_step_of_the_scene) {
  EXPECT_FALSE(choose(kSpring + "[drag]\nrate = 3\n", 0.01).drag);
  EXPECT_FALSE(choose(kSpring + "[run]\ntime_step = 1e-3\n", 0.01).step_fraction);
}

TEST(Choice, does_not_depend_on_the_pace_that_the_scene_says) {
  EXPECT_NEAR(choose(kSpring + "[run]\nslowdown = 8\n", 0.01).slowdown, choose(kSpring, 0.01).slowdown, 1e-3);
}

TEST(Choice, its_settings_make_the_same_scene) {
  const Choice choice = choose(kSpring, 0.01);
  const Stage stage = parse_scene(kSpring, "scene", choice.settings()).stages.at(0);
  EXPECT_NEAR(stage.run.slowdown / choice.slowdown, 1, 1e-5);
  EXPECT_NEAR(*stage.stop.time / (3 * choice.slowdown), 1, 1e-5);
  EXPECT_NEAR(stage.drag->rate / *choice.drag, 1, 1e-5);
}

TEST(Choice, of_a_scene_at_rest_is_how_fine_it_is) {
  const Choice choice = choose(kSpring + "[run]\nstepper = \"quasi_static\"\n", 0.01);
  ASSERT_TRUE(choice.fineness);
  EXPECT_EQ(choice.slowdown, 1);
  const RunScene once = parse_scene(kSpring, "scene", choice.settings()).stages.at(0).run;
  const RunScene twice = parse_scene(kSpring, "scene", choice.times(2).settings()).stages.at(0).run;
  EXPECT_NEAR(twice.residual / once.residual, 0.5, 1e-5);
  EXPECT_NEAR(twice.load_tolerance / once.load_tolerance, 0.5, 1e-5);
  EXPECT_EQ(twice.load_steps, 2 * once.load_steps);
  EXPECT_EQ(slower(choice, 1, 0.01).effort() / choice.effort(), 4);
}

TEST(Choice, is_refused_where_nothing_is_prescribed_in_time) {
  std::string still = kSpring;
  still.replace(still.find("velocity_x = 0.1"), 16, "force_x = 1");
  EXPECT_THROW(choose(still, 0.01), SceneError);
}

TEST(Choice, slows_down_as_the_error_asks_within_bounds) {
  const Choice choice = choose(kSpring, 0.01);
  EXPECT_DOUBLE_EQ(slower(choice, 0.011, 0.01).slowdown / choice.slowdown, 2);
  EXPECT_DOUBLE_EQ(slower(choice, 1, 0.01).slowdown / choice.slowdown, 4);
  EXPECT_TRUE(within_reach(0.1, 0.01, 2));
  EXPECT_FALSE(within_reach(0.2, 0.01, 2));
}

}  // namespace
}  // namespace lamella
