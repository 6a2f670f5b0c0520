#include "simulator/stage.h"

#include <fmt/format.h>

#include "simulator/choose_stepper.h"
#include "simulator/stage_run.h"
#include "simulator/static_stage.h"

namespace lamella {

std::unique_ptr<StageDriver> make_stage(const Sample& sample, const Scene& scene, int stage, const ArraySet& start,
                                        StageStart how) {
  const StepperChoice choice = choose_stepper(sample, scene.stages[stage]);
  std::unique_ptr<StageDriver> driver;
  if (choice.stepper == "quasi_static")
    driver = std::make_unique<StaticStage>(sample, scene, stage, start, how);
  else
    driver = std::make_unique<StageRun>(sample, scene, stage, start, how);
  driver->chosen_ = choice.why;
  return driver;
}

void describe_gauge(const Gauge& gauge, const Stage& stage, const std::string& prefix, Provenance& p) {
  if (!stage.loading) return;
  p[prefix + "axis"] = gauge.axis == 0 ? "x" : "y";
  p[prefix + "kind"] = stage.loading->kind;
  p[prefix + "gauge_length"] = fmt::format("{:.17g}", gauge.length);
  p[prefix + "width"] = fmt::format("{:.17g}", gauge.width);
  p[prefix + "depth"] = fmt::format("{:.17g}", gauge.depth);
  p[prefix + "grip_speed"] = fmt::format("{:.17g}", gauge.speed);
}

std::unique_ptr<Model> restored_model(const Sample& sample, const Stage& stage, const Field& x, const ArraySet& start) {
  auto model = build_model(sample, stage, x);
  if (start.find("bar_broken")) {
    if (!model->rupture) model->add_rupture({});
    model->rupture->restore(start);
    if (model->links && model->rupture->broken().count() > 0) model->links->follow(model->rupture->broken());
  }
  for (Term* term : model->terms()) term->restore(start);
  return model;
}

}  // namespace lamella
