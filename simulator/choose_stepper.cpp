#include "simulator/choose_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "simulator/load_path.h"
#include "simulator/lowest_frequency.h"
#include "simulator/moving_box.h"

namespace lamella {
namespace {

// Measured on the ring (docs/accuracy.md): in 40 periods of the slowest swing the error of the pace falls to 1 %, with the pace.
constexpr double kPeriodsFor1Percent = 40;
constexpr double kAccepted = 0.05;

/// What of the stage needs motion; empty: nothing.
std::string needs_motion(const Stage& stage) {
  if (!stage.initial.empty()) return "[[initial]] states velocities";
  if (!stage.loading && std::none_of(stage.loads.begin(), stage.loads.end(),
                                     [](const LoadScene& load) { return load.velocity_x || load.velocity_y; }))
    return "nothing is held";
  return {};
}

}  // namespace

StepperChoice choose_stepper(const Sample& sample, const Stage& stage) {
  if (stage.run.stepper != "auto") return {stage.run.stepper, ""};
  if (const std::string what = needs_motion(stage); !what.empty())
    return {"velocity_verlet", fmt::format("in time (velocity_verlet), because {}", what)};
  Field x = field_of(sample.x);
  if (pulls_box(sample, stage)) append_box(x, Vec2(0, 0));
  const auto model = build_model(sample, stage, x);
  const std::vector<Load> loads = build_loads(sample, stage);
  const double duration = LoadPath(stage, measure_gauge(sample, stage, loads)).duration();
  const auto frequency = lowest_frequency(*model, loads, x);
  if (!frequency) return {"velocity_verlet", "in time (velocity_verlet), because parts of the sample are loose"};
  const double periods = duration * *frequency / (2 * std::numbers::pi);
  if (stage.run.accuracy) return {"quasi_static", "at rest (quasi_static), because run.accuracy leaves the pace open"};
  const double needed = kPeriodsFor1Percent * 0.01 / kAccepted;
  const std::string beside = fmt::format(
      "because the stage takes {:.3g} periods of the slowest swing, and {:.3g} make inertia less than the accepted "
      "{:.2g} %",
      periods, needed, 100 * kAccepted);
  if (periods >= needed) return {"quasi_static", "at rest (quasi_static), " + beside};
  return {"velocity_verlet", "in time (velocity_verlet), " + beside};
}

}  // namespace lamella
