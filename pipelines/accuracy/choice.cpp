#include "pipelines/accuracy/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "generator/sample/errors.h"
#include "simulator/choose_stepper.h"
#include "simulator/loading.h"
#include "simulator/lowest_frequency.h"
#include "simulator/moving_box.h"

namespace lamella {
namespace {

// Measured on the ring (docs/accuracy.md): with this share of critical damping the error falls with the pace, without swings that
// hide it; and this is the number of periods in which it has fallen to 1 %.
constexpr double kDamping = 0.37;
constexpr double kPeriodsFor1Percent = 40;
constexpr double kMostPeriods = 400;  // to begin with
constexpr double kMostSlower = 4;     // from run to run
constexpr double kStepFraction = 0.8;
// At rest: tolerances and load steps to begin with. Halving the tolerances and doubling the steps halves what walls that flow and links that
// soften leave; elastic walls with brittle links gain more.
constexpr double kCoarsest = 1e-3;
constexpr int kFewestSteps = 25;
constexpr double kMargin = 1.25;  // on the slowdown that a first-order error asks for

bool is_damped(const Stage& stage) {
  if (stage.drag && stage.drag->rate > 0) return true;
  return std::any_of(stage.cells.begin(), stage.cells.end(),
                     [](const auto& c) { return c.second.bar_dashpot > 0 || c.second.hinge_dashpot > 0; });
}

/// Time that a stage takes with what it prescribes; 0 where it prescribes nothing [s].
double prescribed_time(const Sample& sample, const Stage& stage) {
  if (stage.loading) {
    const std::vector<Load> loads = build_loads(sample, stage);
    const double time = LoadingCourse(*stage.loading, measure_gauge(sample, stage, loads)).duration();
    return stage.stop.time ? std::min(time, *stage.stop.time) : time;
  }
  bool prescribed = false;
  for (const LoadScene& load : stage.loads)
    prescribed = prescribed || load.velocity_x.value_or(0) != 0 || load.velocity_y.value_or(0) != 0 || load.ramp > 0;
  for (const auto& [group, section] : stage.cells)
    prescribed = prescribed || (section.core && !section.core->pressure_history.empty());
  return prescribed ? stage.stop.time.value_or(0) : 0;
}

}  // namespace

Choice Choice::times(double factor) const {
  Choice more = *this;
  (more.fineness ? *more.fineness : more.slowdown) *= factor;
  return more;
}

std::vector<std::string> Choice::settings() const {
  if (fineness)
    return {fmt::format("run.residual={:.6g}", kCoarsest / *fineness),
            fmt::format("run.load_tolerance={:.6g}", kCoarsest / *fineness),
            fmt::format("run.load_steps={}", static_cast<int>(std::ceil(kFewestSteps * *fineness)))};
  std::vector<std::string> list{fmt::format("run.slowdown={:.6g}", slowdown)};
  if (step_fraction) list.push_back(fmt::format("run.step_fraction={:.6g}", *step_fraction));
  if (drag) list.push_back(fmt::format("drag.rate={:.6g}", *drag));
  return list;
}

std::string Choice::sentence() const {
  if (fineness)
    return fmt::format("tolerances {:.2g}, at least {:.0f} load steps", kCoarsest / *fineness,
                       std::ceil(kFewestSteps * *fineness));
  std::string text = fmt::format("slowdown {:.3g}, ", slowdown);
  text += step_fraction ? fmt::format("step {:.2g} of the stable one", *step_fraction) : "step of the scene";
  text += drag ? fmt::format(", drag {:.3g} 1/s", *drag) : ", damping of the scene";
  if (frequency) text += fmt::format(" (slowest swing {:.3g} s)", 2 * std::numbers::pi / *frequency);
  return text;
}

Choice first_choice(const Sample& sample, const Scene& scene, double accepted) {
  double time = 0;
  for (const Stage& stage : scene.stages) time += prescribed_time(sample, stage);
  if (!(time > 0))
    throw SceneError(
        fmt::format("{}: run.accuracy: nothing in the scene is prescribed in time, so no pace can be chosen; give "
                    "[loading], or [[loads]] with a "
                    "velocity or a ramp, or leave accuracy out",
                    scene.path.string()));
  Choice choice;
  const Stage& first = scene.stages.front();
  const auto at_rest = [&](const Stage& stage) { return choose_stepper(sample, stage).stepper == "quasi_static"; };
  if (std::all_of(scene.stages.begin(), scene.stages.end(), at_rest)) {
    choice.fineness = 2;
    return choice;
  }
  if (!first.run.time_step) choice.step_fraction = kStepFraction;
  {
    Field x = field_of(sample.x);
    if (pulls_box(sample, first)) append_box(x, Vec2(0, 0));
    const std::unique_ptr<Model> model = build_model(sample, first, x);
    choice.frequency = lowest_frequency(*model, build_loads(sample, first), x);
  }
  if (!choice.frequency) return choice;
  const bool damped = std::any_of(scene.stages.begin(), scene.stages.end(), is_damped);
  if (!damped) choice.drag = 2 * kDamping * *choice.frequency;
  const double period = 2 * std::numbers::pi / *choice.frequency;
  choice.slowdown =
      std::clamp(kPeriodsFor1Percent * 0.01 / accepted, 4.0, kMostPeriods) * period / (time / first.run.slowdown);
  return choice;
}

bool within_reach(double estimated, double accepted, int runs) {
  return estimated <= accepted * std::pow(kMostSlower, runs);
}

Choice slower(const Choice& choice, double estimated, double accepted) {
  return choice.times(std::clamp(kMargin * estimated / accepted, 2.0, kMostSlower));
}

}  // namespace lamella
