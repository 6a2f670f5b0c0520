// run.stepper = "auto": at rest or in time, and why.
#include "simulator/choose_stepper.h"

#include <numbers>

#include "simulator/lowest_frequency.h"
#include "tests/simulator/tissues.h"
#include "tests/support/samples.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

/// A cantilever whose end is moved during so many periods of its slowest swing.
StepperChoice of_periods(double periods, const std::function<void(Stage&)>& change = {}) {
  const Sample chain = chain_sample(4);
  Stage stage;
  stage.cells["cells"] = cell_scene(100.0, 1.0, 1.0);
  stage.run.stepper = "auto";
  LoadScene hold, move;
  hold.name = "hold", move.name = "move";
  hold.nodes.nodes = {0, 1}, move.nodes.nodes = {4};
  hold.velocity_x = hold.velocity_y = move.velocity_x = 0;
  move.velocity_y = 1e-3;
  stage.loads = {hold, move};
  const Field x = field_of(chain.x);
  const auto model = build_model(chain, stage, x);
  const double slowest = *lowest_frequency(*model, build_loads(chain, stage), x);
  stage.stop.time = periods * 2 * std::numbers::pi / slowest;
  if (change) change(stage);
  return choose_stepper(chain, stage);
}

TEST(ChooseStepper, slow_loads_are_solved_at_rest_and_fast_ones_in_time) {
  EXPECT_EQ(of_periods(20).stepper, "quasi_static");
  EXPECT_NE(of_periods(20).why.find("20 periods"), std::string::npos) << of_periods(20).why;
  EXPECT_EQ(of_periods(2).stepper, "velocity_verlet");
}

TEST(ChooseStepper, what_needs_motion_is_stepped_in_time) {
  EXPECT_EQ(of_periods(100, [](Stage& s) { s.initial.emplace_back(); }).stepper, "velocity_verlet");
  EXPECT_EQ(of_periods(100, [](Stage& s) { s.loads.clear(); }).stepper, "velocity_verlet");
}

TEST(ChooseStepper, an_accepted_error_leaves_the_pace_open) {
  EXPECT_EQ(of_periods(0.1, [](Stage& s) { s.run.accuracy = 0.01; }).stepper, "quasi_static");
}

TEST(ChooseStepper, what_the_scene_says_is_kept_without_a_reason) {
  const StepperChoice kept = of_periods(100, [](Stage& s) { s.run.stepper = "backward_euler"; });
  EXPECT_EQ(kept.stepper, "backward_euler");
  EXPECT_TRUE(kept.why.empty());
}

}  // namespace
}  // namespace lamella
