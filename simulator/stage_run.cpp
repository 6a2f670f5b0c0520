#include "simulator/stage_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

#include "generator/sample/errors.h"
#include "simulator/health.h"
#include "simulator/initial.h"
#include "simulator/moving_box.h"
#include "simulator/steppers/backward_euler.h"
#include "simulator/steppers/generalised_alpha.h"
#include "simulator/steppers/velocity_verlet.h"

namespace lamella {

/// One weighed configuration.
struct StageRun::Row {
  double time = 0, strain = 0, stress = 0, force_a = 0, force_b = 0;
  Works works;
  double residual = 0, unbalanced = 0;
  std::optional<std::string> packed;  // says which stop condition of the room between the walls holds
  std::vector<Vec2> load_force;       // [N]
};

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

StageRun::StageRun(const Sample& sample, const Scene& scene, int stage, const ArraySet& start, StageStart how)
    : StageDriver(sample, scene, stage, start, how),
      state_{.x = start_x_, .v = start_velocities(start), .time = start_time_, .step = start_step_} {
  if (stage_.loading) course_.emplace(*stage_.loading, gauge_);
  const RunScene& asked = stage_.run;
  if (asked.stepper == "backward_euler")
    stepper_ = std::make_unique<BackwardEuler>(*model_, loads_, state_, asked.residual);
  else if (asked.stepper == "generalised_alpha")
    stepper_ = std::make_unique<GeneralisedAlpha>(*model_, loads_, state_, asked.residual, asked.spectral_radius);
  else
    stepper_ = std::make_unique<VelocityVerlet>(*model_, loads_, state_, asked.threads);

  if (course_) duration_ = course_->duration();
  if (stage_.stop.time)
    duration_ = course_ && !stage_.loading->step ? std::min(duration_, *stage_.stop.time) : *stage_.stop.time;
  require_end(duration_);
  const int frames = std::max(1, stage_.output.frames);
  rows_per_frame_ = std::max(1, stage_.output.response / frames);
  row_interval_ = duration_ / (static_cast<double>(frames) * static_cast<double>(rows_per_frame_));

  if (how == StageStart::kResumed) {
    stepper_->restore(start);
    if (course_) course_->restore(start.doubles("course"));
    const auto& d = start.doubles("driver");
    start_time_ = d.at(0), row_ = static_cast<std::int64_t>(d.at(1)),
    steps_per_row_ = static_cast<std::int64_t>(d.at(2));
    dt_ = d.at(3), last_dt_ = d.at(4), largest_work_ = d.at(6);
    pressure_work_ = d.at(7);
    base_ = start.doubles("ledger_base");
    pressure_lever_ = start.doubles("pressure_lever");
    stops_->set_history(
        {.peak_stress = d.at(5), .loosens = start.find("loosens") && start.doubles("loosens").at(0) != 0});
  }
  for (const auto& history : model_->pressure_histories)
    model_->core->set_pressure(history.cell, history.at(state_.time - start_time_));
  plan_step();
  if (how != StageStart::kResumed)
    set_initial_velocities(*model_, stage_, loads_, stepper_->implicit() ? 0.0 : dt_, state_);
}

// The step is a whole fraction of the time between rows, and changes only when the bound asks for a smaller one: a constant
// step keeps the scheme symplectic.
void StageRun::plan_step() {
  // The bound counts the listed pairs: a list made here, and not some steps ago, is the same in a resumed run.
  if (model_->contacts) model_->contacts->rebuild(state_.x);
  stable_ = stable_time_step(*model_, state_.x, stepper_->fully_held());
  double allowed = stage_.run.step_fraction * stable_.dt;
  if (stepper_->implicit()) {
    allowed = stage_.run.time_step.value_or(row_interval_);
  } else if (stage_.run.time_step) {
    if (*stage_.run.time_step > stable_.dt)
      throw SolverError(
          fmt::format("t = {:.6g} s: run.time_step = {:.4g} s exceeds the stable limit {:.4g} s (node {}: {}); "
                      "leave it out, or give less",
                      state_.time, *stage_.run.time_step, stable_.dt, stable_.node, stable_.limited_by));
    allowed = *stage_.run.time_step;
  }
  if (!(allowed > 0))
    throw SolverError(
        fmt::format("t = {:.6g} s: no stable time step (node {}: {})", state_.time, stable_.node, stable_.limited_by));
  const double steps = std::isfinite(allowed) ? std::ceil(row_interval_ / allowed * (1 - 1e-12)) : 1;
  if (steps > 1e9)
    throw SolverError(fmt::format(
        "t = {:.6g} s: the time between rows is {:.2g} steps of {:.3g} s (node {}: {}); load faster, or remove "
        "the stiff or light part",
        state_.time, steps, allowed, stable_.node, stable_.limited_by));
  steps_per_row_ = std::max(steps_per_row_, static_cast<std::int64_t>(std::max(1.0, steps)));
  dt_ = row_interval_ / static_cast<double>(steps_per_row_);
}

std::vector<std::string> StageRun::summary() const {
  std::vector<std::string> lines;
  std::string terms = term_names();
  if (model_->dashpots) terms += ", dashpots";
  if (model_->drag_rate > 0) terms += ", drag";
  lines.push_back(fmt::format("stage '{}': {}", stage_.name, terms));
  lines.push_back(fmt::format("  {} cells, {} nodes, {} links; {:.1f} MB of terms", sample_.cells(), sample_.nodes(),
                              model_->links ? sample_.links.size() : 0, static_cast<double>(model_->bytes()) / 1e6));
  say_why(lines);
  lines.push_back(fmt::format("  time step {:.4g} s, {:.0f} % of the stable limit {:.4g} s, set by node {} ({})", dt_,
                              100 * dt_ / stable_.dt, stable_.dt, stable_.node, stable_.limited_by));
  lines.push_back(fmt::format("  {:.4g} s in about {:.4g} steps", duration_, duration_ / dt_));

  // dimensionless groups, of the first closed cell
  for (Index c = 0; c < sample_.cells(); ++c) {
    if (!sample_.closed[c]) continue;
    const CellScene& cell = stage_.cell(sample_.group_names[sample_.group[c]]);
    const Index i = sample_.cell_begin[c];
    const double l = sample_.rest_length[i], radius = std::sqrt(sample_.rest_area[c] / M_PI);
    if (cell.bending() > 0) {
      lines.push_back(
          fmt::format("  bending against stretching: EI / (EA R^2) = {:.3g}, l / R = {:.3g}, r / R = {:.3g}",
                      cell.bending() / (cell.axial() * radius * radius), l / radius, sample_.radius[c] / radius));
      const double k_b = cell.bending() / l;
      if (model_->contacts) {
        const double k = model_->contacts->node_stiffness(i);
        lines.push_back(fmt::format("  contact against walls: k_n l^2 / k_b = {:.3g}, k_n l / EA = {:.3g}",
                                    k * l * l / k_b, k * l / cell.axial()));
      }
      if (model_->links) {
        const double k = model_->links->normal_stiffness(0);
        lines.push_back(
            fmt::format("  links against walls: k_n l^2 / k_b = {:.3g}, k_n l / EA = {:.3g}, gap / thickness = {:.3g}",
                        k * l * l / k_b, k * l / cell.axial(),
                        sample_.links.empty() ? 0.0 : sample_.links[0].offset_n / (2 * sample_.radius[c])));
        if (const double zone = model_->links->zone_length(0, cell.bending()) / sample_.links[0].spacing; zone > 0)
          lines.push_back(fmt::format(
              "  links soften over about (EI G / f^2)^(1/4) = {:.3g} spacings ahead of a crack{}", zone,
              zone < 2 ? ": fewer than 2, so that results depend on the spacing (docs/model.md, section 5)" : ""));
      }
    }
    break;
  }
  if (course_) {
    const double wave = std::sqrt(stage_.cell("cells").axial() / stage_.cell("cells").line_density());
    if (gauge_.box) lines.push_back(box_line());
    lines.push_back(fmt::format(
        "  {} at {:.3g} m/s, {:.2g} of the wall's wave speed {:.3g} m/s; gauge length {:.4g} m, width {:.4g} m",
        gauge_.box ? "the box grows" : "grips part", gauge_.speed, std::abs(gauge_.speed) / wave, wave, gauge_.length,
        gauge_.width));
  }
  return lines;
}

void StageRun::describe(Provenance& p) const {
  StageDriver::describe(p);
  p[prefix() + "time_step"] = fmt::format("{:.17g}", dt_);
  p[prefix() + "stable_time_step"] = fmt::format("{:.17g}", stable_.dt);
  p[prefix() + "step_limited_by"] = fmt::format("node {}: {}", stable_.node, stable_.limited_by);
}

void StageRun::set_loads(double dt) {
  const double since = state_.time - start_time_;
  const double factor = course_ ? course_->advance(since, dt) : 0.0;
  for (Load& load : loads_) {
    if (load.grip)
      load.factor = factor;
    else  // velocities hold between steps, forces at them
      load.factor =
          load.ramp > 0 ? smooth_ramp((since + (load.pushes ? stepper_->push_time() : 0.5) * dt) / load.ramp) : 1.0;
  }
}

// Before a configuration is weighed: the energy of its cores is that under the pressure of its own time.
void StageRun::set_pressures() {
  if (model_->pressure_histories.empty()) return;
  const double since = state_.time - start_time_;
  std::vector<double> lever;
  for (std::size_t k = 0; k < model_->pressure_histories.size(); ++k) {
    const auto& history = model_->pressure_histories[k];
    if (!model_->core->present(history.cell)) {  // it has opened
      lever.push_back(0);
      continue;
    }
    const double before = model_->core->pressure(history.cell), now = history.at(since);
    lever.push_back(model_->core->energy_per_pressure(history.cell, state_.x));
    pressure_work_ +=
        (now - before) * 0.5 * (lever.back() + (pressure_lever_.empty() ? lever.back() : pressure_lever_[k]));
    model_->core->set_pressure(history.cell, now);
  }
  pressure_lever_ = std::move(lever);
}

// The ledger of docs/model.md: work = elastic + kinetic + damping + friction + plastic + fracture, each since the first row.
StageRun::Row StageRun::weigh(double energy, const Measurement& m) const {
  Row row;
  row.works = m.works;
  row.works.pressure += pressure_work_;
  row.unbalanced = m.unbalanced;
  if (course_) {
    const auto [fixed, moving] = grip_forces(gauge_, m.load_force);
    row.force_a = fixed, row.force_b = moving;
    row.stress = row.force_b / (gauge_.width * gauge_.depth);
  }
  const Works& w = row.works;
  const double in = w.loads + w.pressure, out = energy + m.kinetic + w.damping + w.friction + w.plastic + w.fracture;
  row.residual = base_.empty() ? 0.0 : (in - base_[0]) - (out - base_[1]);
  return row;
}

ArraySet StageRun::restart_arrays() const {
  ArraySet out;
  save_motion(state_.x, state_.v, out);
  out.add({"clock", "1", "model", 1,
           std::vector<double>{state_.time, static_cast<double>(state_.step), static_cast<double>(index_)}});
  out.add({"driver", "1", "model", 1,
           std::vector<double>{start_time_, static_cast<double>(row_), static_cast<double>(steps_per_row_), dt_,
                               last_dt_, stops_->history().peak_stress, largest_work_, pressure_work_}});
  out.add({"ledger_base", "J", "model", 1, base_});
  out.add({"pressure_lever", "J/Pa", "model", 1, pressure_lever_});
  if (course_) out.add({"course", "1", "model", 1, course_->save()});
  if (stage_.stop.compaction)
    out.add({"loosens", "1", "model", 1, std::vector<double>{stops_->history().loosens ? 1.0 : 0.0}});
  save_terms(out);
  stepper_->save(out);
  return out;
}

void StageRun::write(TrajectoryWriter& writer, ArraySet arrays, ArraySet restart, double time, std::int64_t step) {
  Frame frame;
  frame.time = time;
  frame.step = step;
  frame.stage = index_;
  frame.arrays = std::move(arrays);
  last_ = std::move(restart);
  writer.write_frame(frame, last_);
}

/// Breaks of the step that has just been taken: an explicit one finds them where it begins, at `step` and `strain`, an implicit one where
/// it ends.
void StageRun::note_breaks(std::int64_t step, double strain) {
  const auto links = stepper_->take_breaks();
  const auto bars = stepper_->take_wall_breaks();
  if (links.empty() && bars.empty()) return;
  if (stepper_->implicit()) step = state_.step, strain = this->strain();
  const auto note = [&](Event event) {
    event.step = step, event.strain = strain, event.stage = index_;
    events_.push_back(event);
  };
  for (const Break& b : links) {
    note({.time = model_->links->break_time(b.link),
          .link = b.link,
          .position = b.position,
          .f_n = b.f_n,
          .f_t = b.f_t,
          .mode_mix = model_->links->mode_mix_of(b),
          .energy = b.energy});
  }
  for (const WallBreak& b : bars) {
    note({.time = model_->rupture->break_time(b.bar),
          .link = -1,
          .bar = b.bar,
          .position = b.position,
          .f_n = b.tension,
          .energy = b.energy});
  }
}

void StageRun::write_events(TrajectoryWriter& writer) {
  for (const Event& event : std::exchange(events_, {})) writer.add_event(event);
}

std::string StageRun::run(TrajectoryWriter& writer, const SimulateOptions& options,
                          const std::vector<std::string>& columns, RunFacts& facts) {
  std::optional<std::string> ended;
  if (last_dt_ == 0) last_dt_ = dt_;
  while (true) {
    // A row: weigh the configuration, in the first step of the interval that it starts. Every so many rows it is a frame too.
    const auto row_start = Clock::now();
    const bool frame = ended || row_ % rows_per_frame_ == 0;
    check_health(*model_, state_.x, state_.time);
    if (frame && row_ > 0) plan_step();
    const double time = state_.time, strain = this->strain();
    const std::int64_t step = state_.step;
    set_pressures();
    std::vector<double> energies;
    for (const Term* term : model_->terms()) energies.push_back(term->energy(state_.x));
    const double energy = std::accumulate(energies.begin(), energies.end(), 0.0);
    if (!std::isfinite(energy))
      throw SolverError(fmt::format("t = {:.6g} s: the elastic energy is no longer a number", time));
    std::vector<double> moved;
    for (const LoadColumn& c : load_columns_)
      moved.push_back(c.displacement ? mean_displacement(sample_, state_.x, loads_[c.load], c.component) : 0.0);
    ArraySet arrays, restart;
    Field exerted(frame && !loads_.empty() ? state_.x.size() : 0);
    if (frame) {
      add_motion(state_.x, state_.v, arrays);
      add_output(state_.x, arrays);
      restart = restart_arrays();
      stepper_->forget();
    }
    // Breaks of the step that weighs this row come after it.
    const int broken_at_row = broken_links(), bars_at_row = broken_bars();
    const auto reason = stops_->packed(state_.x, state_.time);
    set_loads(dt_);
    const Measurement m = stepper_->measured_step(dt_, 0.5 * (dt_ + last_dt_), exerted.size() > 0 ? &exerted : nullptr);
    last_dt_ = dt_;
    note_breaks(step, strain);
    if (base_.empty()) {
      const Works& w = m.works;
      base_ = {w.loads + pressure_work_, energy + m.kinetic + w.damping + w.friction + w.plastic + w.fracture};
      if (frame) {  // a restart from the very first frame needs it too
        ArraySet with_base;
        for (const NamedArray& a : restart.all())
          with_base.add(a.name == "ledger_base" ? NamedArray{"ledger_base", "J", "model", 1, base_} : a);
        restart = std::move(with_base);
      }
    }
    Row row = weigh(energy, m);
    row.time = time, row.strain = strain;
    row.packed = reason, row.load_force = m.load_force;
    // relative to the largest work so far; where nothing works (free vibration), to the largest energy
    largest_work_ = std::max({largest_work_, std::abs(row.works.loads + row.works.pressure - base_[0]), m.kinetic,
                              std::abs(energy + m.kinetic - base_[1])});
    row.residual = largest_work_ > 0 ? std::abs(row.residual) / largest_work_ : 0.0;

    if (!resumed_) {
      ResponseRow response(columns);
      const auto put = [&](const std::string& name, double value) { response.put(name, value); };
      put("time", time), put("stage", index_), put("strain", strain), put("stress", row.stress);
      put("force_a", row.force_a), put("force_b", row.force_b);
      for (std::size_t k = 0; k < load_columns_.size(); ++k) {
        const LoadColumn& c = load_columns_[k];
        put(c.name, c.displacement ? moved[k] : m.load_force[c.load][c.component]);
      }
      const auto terms = model_->terms();
      for (std::size_t k = 0; k < terms.size(); ++k) put("energy_" + terms[k]->name(), energies[k]);
      put("kinetic", m.kinetic), put("work", row.works.loads + row.works.pressure - base_[0]),
          put("damping", row.works.damping);
      put("friction", row.works.friction), put("plastic", row.works.plastic), put("fracture", row.works.fracture);
      put("broken_links", broken_at_row), put("broken_bars", bars_at_row), put("residual", row.residual),
          put("unbalanced", row.unbalanced);
      writer.add_response(response.values());
      facts.residual = std::max(facts.residual, row.residual);
    }
    if (frame && !resumed_) {
      if (exerted.size() > 0) arrays.add({"load_force", "N", "node", 2, rows_of_nodes(sample_, exerted)});
      write(writer, std::move(arrays), std::move(restart), time, step);
    }
    if (resumed_) last_ = std::move(restart);
    resumed_ = false;
    report(options, (time - start_time_) / duration_, time, strain, row.stress);
    facts.frame_seconds += seconds_since(row_start);
    if (ended) return *ended;
    ended = course_ && course_->finished() ? std::optional(fmt::format("strain {:.4g} reached", strain))
                                           : stops_->reason({.since = time - start_time_,
                                                             .stress = row.stress,
                                                             .broken = broken_at_row + bars_at_row,
                                                             .unbalanced = row.unbalanced,
                                                             .first = row_ == 0,
                                                             .load_force = row.load_force,
                                                             .packed = row.packed});
    if (course_) course_->report_unbalanced(row.unbalanced, time - start_time_);

    // the rest of the interval; after a stop condition the very next configuration is the last
    const auto start = Clock::now();
    std::int64_t steps = 1;
    if (!ended)
      for (; steps < steps_per_row_; ++steps) {
        const std::int64_t before = state_.step;
        const double reached = this->strain();
        set_pressures();
        set_loads(dt_);
        stepper_->step(dt_, dt_);
        note_breaks(before, reached);
      }
    facts.seconds += seconds_since(start);
    facts.steps += steps;
    facts.timed_steps += steps - 1;
    ++row_;
    if (!ended) state_.time = start_time_ + static_cast<double>(row_) * row_interval_;  // no drift of the clock
    write_events(writer);
    if (options.interrupted && options.interrupted->load()) {
      facts.interrupted = true;
      return "interrupted";
    }
  }
}

}  // namespace lamella
