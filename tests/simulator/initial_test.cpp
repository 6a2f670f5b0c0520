// Velocities at the start of a stage: what is stated is what the scheme has at that time, to second order.
#include "simulator/initial.h"
#include "generator/sample/errors.h"
#include "tests/simulator/tissues.h"
#include "tests/support/samples.h"

namespace lamella {
namespace {

InitialScene of_group(const std::string& group) {
  InitialScene initial;
  initial.nodes.group = group;
  return initial;
}

Stage ring_stage() {
  Stage stage;
  stage.cells["cells"] = cell_scene(40.0, 0.05, 1.0);
  return stage;
}

TEST(InitialVelocities, are_the_mean_of_those_before_and_after_whatever_pushes) {
  const Sample ring = ring_sample(12);
  Stage stage = ring_stage();
  stage.gravity = GravityScene{{0.3, -2.0}};
  stage.drag = DragScene{5.0};
  stage.cells["cells"].core.emplace();
  stage.cells["cells"].core->drained = true;
  stage.cells["cells"].core->pressure = 7.0;
  LoadScene push;
  push.name = "push", push.nodes.nodes = {3, 5}, push.force_x = 4.0;
  stage.loads = {push};
  InitialScene moving = of_group("cells");
  moving.velocity_x = 1.5, moving.velocity_y = -0.5;
  stage.initial = {moving};
  Rig rig(ring, stage, build_loads(ring, stage));
  rig.state.x = shaken(ring, 0.02);
  const double dt = 0.01;
  set_initial_velocities(*rig.model, stage, rig.loads, dt, rig.state);
  const Field before = rig.state.v;
  rig.stepper.step(dt, dt);
  for (Index i = 0; i < ring.nodes(); ++i) {
    EXPECT_GT((rig.state.v.at(i) - before.at(i)).norm(), 1e-4) << "nothing pushes";
    EXPECT_LT((0.5 * (rig.state.v.at(i) + before.at(i)) - Vec2(1.5, -0.5)).norm(), 1e-14) << i;
  }
}

TEST(InitialVelocities, put_an_oscillation_on_its_exact_course_with_second_order) {
  // A bar between two nodes: relative motion x = u / w sin(w t), w^2 = k_s / (m / 2), with k_s = 40 and m = 1/2.
  const Sample bar = chain_sample(1);
  Stage stage;
  stage.cells["cells"] = cell_scene(40.0, 0.0, 1.0);
  InitialScene left, right;
  left.nodes.nodes = {0}, left.velocity_x = 0.0;  // stated too: at rest at the start, and not half a step before it
  right.nodes.nodes = {1}, right.velocity_x = 1e-3;
  stage.initial = {left, right};
  const double w = std::sqrt(160.0), end = 0.4;
  double error[2];
  for (int fine : {0, 1}) {
    const int steps = fine ? 80 : 40;
    Rig rig(bar, stage);
    rig.state.x.x[1] += 5e-5;  // pulled already: the first half kick counts
    set_initial_velocities(*rig.model, stage, {}, end / steps, rig.state);
    for (int n = 0; n < steps; ++n) rig.stepper.step(end / steps, end / steps);
    const double stretch = rig.state.x.x[1] - rig.state.x.x[0] - 1;
    error[fine] = stretch - (5e-5 * std::cos(w * end) + 1e-3 / w * std::sin(w * end));
  }
  EXPECT_GT(std::abs(error[0]), 1e-9);
  EXPECT_NEAR(error[0] / error[1], 4, 0.3);
}

TEST(InitialVelocities, spin_about_the_centre_of_mass_and_add_up) {
  const Sample ring = ring_sample(8);
  Stage stage = ring_stage();
  InitialScene spin = of_group("cells"), shift = of_group("cells");
  spin.spin = 2.0, shift.velocity_x = 0.25;
  stage.initial = {spin, shift};
  Rig rig(ring, stage);
  set_initial_velocities(*rig.model, stage, {}, 1e-3, rig.state);
  for (Index i = 0; i < ring.nodes(); ++i)  // a ring at rest: no forces, no half kick
    EXPECT_LT((rig.state.v.at(i) - Vec2(0.25 - 2 * ring.x[i].y(), 2 * ring.x[i].x())).norm(), 1e-13) << i;
  stage.initial = {spin};
  stage.initial[0].centre = Vec2(1, 1);
  set_initial_velocities(*rig.model, stage, {}, 1e-3, rig.state);
  EXPECT_LT((rig.state.v.at(0) - Vec2(2, 0)).norm(), 1e-13);  // node (1, 0)
}

TEST(InitialVelocities, leave_what_they_do_not_state) {
  const Sample ring = ring_sample(8);
  Stage stage = ring_stage();
  InitialScene up;
  up.nodes.nodes = {2}, up.velocity_y = 1.0;
  stage.initial = {up};
  Rig rig(ring, stage);
  for (Index i = 0; i < ring.nodes(); ++i) rig.state.v.set(i, {3, 4});
  set_initial_velocities(*rig.model, stage, {}, 1e-3, rig.state);
  for (Index i = 0; i < ring.nodes(); ++i) EXPECT_NEAR((rig.state.v.at(i) - Vec2(3, i == 2 ? 1 : 4)).norm(), 0, 1e-13);
}

TEST(InitialVelocities, of_nodes_that_are_not_there_are_refused) {
  const Sample ring = ring_sample(8);
  Stage stage = ring_stage();
  InitialScene nowhere;
  nowhere.nodes.nodes = {8}, nowhere.velocity_y = 1.0;
  stage.initial = {nowhere};
  Rig rig(ring, stage);
  EXPECT_THROW(set_initial_velocities(*rig.model, stage, {}, 1e-3, rig.state), SceneError);
}

}  // namespace
}  // namespace lamella
