#include "simulator/stage.h"

#include <algorithm>
#include <cmath>

#include "generator/sample/errors.h"
#include "simulator/choose_stepper.h"
#include "simulator/moving_box.h"
#include "simulator/stage_run.h"
#include "simulator/static_stage.h"

namespace lamella {
namespace {

/// The stage's model at x, with the history of `start` (empty: none).
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

/// Where the stage starts: those of `start`, or of the sample, with the entry of a box that moves.
Field start_positions(const Sample& sample, const Stage& stage, const ArraySet& start) {
  Field x = start.find("x") ? field_from(start.doubles("x")) : field_of(sample.x);
  if (start.find("box_growth"))
    append_box(x, vec_from(start.doubles("box_growth")));
  else if (pulls_box(sample, stage))
    append_box(x, Vec2(0, 0));
  return x;
}

}  // namespace

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

StageDriver::StageDriver(const Sample& sample, const Scene& scene, int stage, const ArraySet& start, StageStart how)
    : sample_(sample),
      scene_(scene),
      stage_(scene.stages[stage]),
      index_(stage),
      resumed_(how == StageStart::kResumed),
      start_x_(start_positions(sample, stage_, start)) {
  if (start.find("clock")) {
    start_time_ = start.doubles("clock").at(0);
    start_step_ = static_cast<std::int64_t>(start.doubles("clock").at(1));
  }
  model_ = restored_model(sample, stage_, start_x_, start);
  loads_ = build_loads(sample, stage_);
  if (!stage_.loading && box_moves(sample, start_x_)) {  // an earlier stage has pulled it
    if (!loads_.empty() || model_->gravity)
      throw SceneError(
          fmt::format("stage '{}': goes on with a box that an earlier stage has pulled, and has [[loads]] or [gravity] "
                      "beside it; remove them",
                      stage_.name));
    loads_.push_back(held_box(sample));
  }
  load_columns_ = load_columns(loads_);
  gauge_ = measure_gauge(sample, stage_, loads_);
  stops_.emplace(stage_, *model_, loads_, start_x_);
}

void StageDriver::require_end(double duration) const {
  if (!(duration > 0) || !std::isfinite(duration))
    throw SceneError(fmt::format(
        "stop.time: stage '{}' has no [loading] and no stop.time, and would run for ever; give a time", stage_.name));
}

void StageDriver::columns(std::vector<std::string>& names, std::vector<std::string>& units) const {
  const auto add = [&](const std::string& name, const char* unit) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name), units.emplace_back(unit);
  };
  add("time", "s"), add("stage", "1");
  if (stage_.loading) add("strain", "1"), add("stress", "Pa"), add("force_a", "N"), add("force_b", "N");
  for (const LoadColumn& column : load_columns_) add(column.name, column.unit.c_str());
  for (const Term* term : model_->terms()) add("energy_" + term->name(), "J");
  if (moves()) add("kinetic", "J");
  add("work", "J");
  if (moves() && (model_->drag_rate > 0 || model_->dashpots || model_->contact_damping > 0)) add("damping", "J");
  if (model_->friction > 0) add("friction", "J");
  if (model_->yields()) add("plastic", "J");
  const bool links_break = model_->links && (model_->links->breakable() || model_->rupture);
  if (links_break || model_->rupture) add("fracture", "J");
  if (!moves()) add("released", "J");
  if (links_break) add("broken_links", "1");
  if (model_->rupture) add("broken_bars", "1");
  add("residual", "1"), add("unbalanced", "1");
}

void StageDriver::describe(Provenance& p) const {
  if (stage_.loading) {
    p[prefix() + "axis"] = gauge_.axis == 0 ? "x" : "y";
    p[prefix() + "kind"] = stage_.loading->kind;
    p[prefix() + "gauge_length"] = fmt::format("{:.17g}", gauge_.length);
    p[prefix() + "width"] = fmt::format("{:.17g}", gauge_.width);
    p[prefix() + "depth"] = fmt::format("{:.17g}", gauge_.depth);
    p[prefix() + "grip_speed"] = fmt::format("{:.17g}", gauge_.speed);
  }
  std::string text;
  for (const auto& line : summary()) text += line + "\n";
  p[prefix() + "summary"] = text;
}

std::string StageDriver::term_names() const {
  std::string names;
  for (const Term* term : model_->terms()) names += (names.empty() ? "" : ", ") + term->name();
  return names;
}

std::string StageDriver::box_line() const {
  const int across = 1 - gauge_.axis;
  return fmt::format("  the box is pulled along {}; along {} its length is {}", gauge_.axis == 0 ? "x" : "y",
                     across == 0 ? "x" : "y",
                     loads_[0].holds[across] ? "held (loading.normal_only = true frees it)" : "free");
}

void StageDriver::say_why(std::vector<std::string>& lines) const {
  if (!chosen_.empty()) lines.push_back("  " + chosen_);
}

void StageDriver::report(const SimulateOptions& options, double done, double time, double strain, double stress) const {
  if (!options.progress) return;
  RunProgress p;
  p.stage = index_, p.stages = static_cast<int>(scene_.stages.size());
  p.stage_name = stage_.name;
  p.done = (index_ + std::min(1.0, done)) / p.stages;
  p.time = time, p.strain = strain, p.stress = stress, p.broken = broken();
  options.progress(p);
}

Field StageDriver::start_velocities(const ArraySet& start) const {
  if (!start.find("v")) return Field(start_x_.size());
  Field v = field_from(start.doubles("v"));
  if (box_moves(sample_, start_x_))
    append_box(v, start.find("box_rate") ? vec_from(start.doubles("box_rate")) : Vec2(0, 0));
  return v;
}

void StageDriver::save_motion(const Field& x, const Field& v, ArraySet& restart) const {
  restart.add({"x", "m", "node", 2, rows_of_nodes(sample_, x)});
  restart.add({"v", "m/s", "node", 2, rows_of_nodes(sample_, v)});
  if (!box_moves(sample_, x)) return;
  const Vec2 growth = box_growth(sample_, x), rate = box_growth(sample_, v);
  restart.add({"box_growth", "m", "model", 1, std::vector<double>{growth.x(), growth.y()}});
  restart.add({"box_rate", "m/s", "model", 1, std::vector<double>{rate.x(), rate.y()}});
}

// A frame has the velocities of nodes themselves, and the box's lengths.
void StageDriver::add_motion(const Field& x, const Field& v, ArraySet& frame) const {
  frame.add({"x", "m", "node", 2, rows_of_nodes(sample_, x)});
  frame.add({"v", "m/s", "node", 2, rows_of_nodes(sample_, absolute(sample_, v))});
  if (!box_moves(sample_, x)) return;
  const Vec2 size = box_size(sample_, x);
  frame.add({"box_size", "m", "model", 1, std::vector<double>{size.x(), size.y()}});
}

void StageDriver::add_output(const Field& x, ArraySet& frame) const {
  for (const Term* term : model_->terms()) term->add_output(x, frame);
  if (model_->rupture) model_->rupture->add_output(frame);
}

void StageDriver::save_terms(ArraySet& restart) const {
  for (const Term* term : model_->terms()) term->save(restart);
  if (model_->rupture) model_->rupture->save(restart);
}

void ResponseRow::put(const std::string& name, double value) {
  const auto at = std::find(columns_.begin(), columns_.end(), name);
  if (at != columns_.end()) values_[at - columns_.begin()] = value;
}

}  // namespace lamella
