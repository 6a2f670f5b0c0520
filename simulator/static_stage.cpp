#include "simulator/static_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "generator/sample/errors.h"
#include "simulator/health.h"
#include "simulator/moving_box.h"

namespace lamella {

StaticStage::StaticStage(const Sample& sample, const Scene& scene, int stage, const ArraySet& start, StageStart how)
    : StageDriver(sample, scene, stage, start, how), first_step_(start_step_), step_(start_step_) {
  refuse_what_moves();
  path_.emplace(stage_, gauge_);
  require_end(path_->duration());
  if (resumed_) {
    const auto& d = start.doubles("static_stage");
    start_time_ = d.at(0), frame_ = static_cast<std::int64_t>(d.at(1)), largest_work_ = d.at(2);
    first_step_ = static_cast<std::int64_t>(d.at(3));
    stops_->set_history({.peak_stress = d.at(4), .loosens = d.at(5) != 0});
    base_ = start.doubles("ledger_base");
  }
  const RunScene& run = stage_.run;
  stepper_ = std::make_unique<QuasiStatic>(*model_, loads_, *path_, start_x_, start_time_,
                                           QuasiStaticSettings{.residual = run.residual,
                                                               .load_tolerance = run.load_tolerance,
                                                               .all_at_once = run.breaking == "all_at_once",
                                                               .follow = run.unstable == "follow",
                                                               .longest = path_->duration() / run.load_steps});
  if (resumed_) stepper_->restore(start);
}

void StaticStage::refuse_what_moves() const {
  std::vector<std::string> faults;
  const auto refuse = [&](bool present, const std::string& what) {
    if (present)
      faults.push_back(
          fmt::format("run.stepper: 'quasi_static' has no {}; take it out, or use 'velocity_verlet'", what));
  };
  refuse(!stage_.initial.empty(), "velocities, and [[initial]] asks for some");
  if (!faults.empty()) throw SceneError(std::move(faults));
}

std::vector<std::string> StaticStage::summary() const {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("stage '{}' at rest: {}", stage_.name, term_names()));
  lines.push_back(fmt::format("  {} cells, {} nodes, {} links, {} unknowns", sample_.cells(), sample_.nodes(),
                              model_->links ? sample_.links.size() : 0, stepper_->solver().free().size()));
  say_why(lines);
  if (gauge_.box) lines.push_back(box_line());
  const RunScene& run = stage_.run;
  lines.push_back(fmt::format(
      "  {} load steps at least; a force of {:.1g} of the largest may be left; links break {} within "
      "{:.1g} of their criterion, {}",
      run.load_steps, run.residual, run.breaking == "all_at_once" ? "all at once" : "one at a time", run.load_tolerance,
      run.unstable == "follow" ? "the load follows them back" : "the load stays where it is"));
  std::string idle;
  if (model_->drag_rate > 0) idle += "drag";
  if (model_->dashpots) idle += (idle.empty() ? "" : ", ") + std::string("dashpots");
  if (model_->contact_damping > 0) idle += (idle.empty() ? "" : ", ") + std::string("contact damping");
  if (!idle.empty()) lines.push_back(fmt::format("  nothing moves, so that these do nothing: {}", idle));
  return lines;
}

void StaticStage::add_events(TrajectoryWriter& writer) {
  for (const BreakAtRest& b : stepper_->take_breaks()) {
    Event event{.time = start_time_ + b.time, .step = step_};
    if (b.link.link >= 0) {
      event.link = b.link.link, event.position = b.link.position, event.energy = b.link.energy;
      event.f_n = b.link.f_n, event.f_t = b.link.f_t, event.mode_mix = model_->links->mode_mix_of(b.link);
    } else {
      event.link = -1, event.bar = b.wall.bar, event.position = b.wall.position;
      event.f_n = b.wall.tension, event.energy = b.wall.energy;
    }
    event.strain = path_->strain(b.time), event.stage = index_;
    event.avalanche = b.avalanche, event.place = b.place, event.released = b.released;
    writer.add_event(event);
  }
}

/// Weighs the present configuration. Returns why the stage ends here, if it does.
std::optional<std::string> StaticStage::add_row(TrajectoryWriter& writer, const std::vector<std::string>& columns,
                                                RunFacts& facts) {
  const Field& x = stepper_->x();
  const double since = stepper_->time(), time = start_time_ + since, strain = path_->strain(since);
  check_health(*model_, x, time);
  ResponseRow row(columns);
  const auto put = [&](const std::string& name, double value) { row.put(name, value); };
  double energy = 0;
  for (const Term* term : model_->terms()) {
    const double e = term->energy(x);
    put("energy_" + term->name(), e);
    energy += e;
  }
  if (!std::isfinite(energy))
    throw SolverError(fmt::format("t = {:.6g} s: the elastic energy is no longer a number", time));
  const StaticWorks works = stepper_->works();
  const double friction = model_->friction > 0 ? model_->contacts->friction_dissipated() : 0.0,
               flow = model_->plastic_dissipated();
  const double in = works.loads + works.pressure, out = energy + friction + flow + works.fracture + works.released;
  if (base_.empty()) base_ = {in, out};
  largest_work_ = std::max({largest_work_, std::abs(in - base_[0]), std::abs(energy - base_[1])});
  const double residual = largest_work_ > 0 ? std::abs((in - base_[0]) - (out - base_[1])) / largest_work_ : 0.0;
  const std::vector<Vec2> force = stepper_->load_forces();
  if (stage_.loading) {
    const auto [fixed, moving] = grip_forces(gauge_, force);
    stress_ = moving / (gauge_.width * gauge_.depth);
    put("strain", strain), put("stress", stress_);
    put("force_a", fixed), put("force_b", moving);
  }
  for (const LoadColumn& c : load_columns_)
    put(c.name,
        c.displacement ? mean_displacement(sample_, x, loads_[c.load], c.component) : force[c.load][c.component]);
  put("time", time), put("stage", index_), put("work", in - base_[0]);
  put("friction", friction), put("plastic", flow), put("fracture", works.fracture), put("released", works.released);
  put("broken_links", broken_links()), put("broken_bars", broken_bars()), put("residual", residual),
      put("unbalanced", stepper_->solver().residual());
  writer.add_response(row.values());
  facts.residual = std::max(facts.residual, residual);
  ++rows_;
  return stops_->reason({.since = since,
                         .stress = stress_,
                         .broken = broken(),
                         .unbalanced = stepper_->solver().residual(),
                         .first = rows_ == 1,
                         .load_force = force,
                         .packed = stops_->packed(x, time)});
}

void StaticStage::write_frame(TrajectoryWriter& writer) {
  // What follows a frame depends on the frame alone, so that a resumed run goes the same way.
  stepper_->forget();
  const Field& x = stepper_->x();
  const double time = start_time_ + stepper_->time();
  Frame frame;
  frame.time = time, frame.step = step_, frame.stage = index_;
  add_motion(x, Field(x.size()), frame.arrays);
  add_output(x, frame.arrays);
  if (!loads_.empty())
    frame.arrays.add({"load_force", "N", "node", 2, rows_of_nodes(sample_, stepper_->load_force_on_nodes())});

  ++frame_;
  ArraySet out;
  save_motion(x, Field(x.size()), out);
  out.add(
      {"clock", "1", "model", 1, std::vector<double>{time, static_cast<double>(step_), static_cast<double>(index_)}});
  out.add(
      {"static_stage", "1", "model", 1,
       std::vector<double>{start_time_, static_cast<double>(frame_), largest_work_, static_cast<double>(first_step_),
                           stops_->history().peak_stress, stops_->history().loosens ? 1.0 : 0.0}});
  out.add({"ledger_base", "J", "model", 1, base_});
  save_terms(out);
  stepper_->save(out);
  last_ = std::move(out);
  writer.write_frame(frame, last_);
  last_frame_time_ = time;
}

std::string StaticStage::run(TrajectoryWriter& writer, const SimulateOptions& options,
                             const std::vector<std::string>& columns, RunFacts& facts) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto interrupted = [&] { return options.interrupted && options.interrupted->load(); };
  const auto finish = [&](const std::string& why) {
    facts.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    facts.steps += step_ - first_step_;
    facts.timed_steps += step_ - first_step_;
    const SolverCost& c = facts.static_cost = stepper_->solver().cost();
    const std::string line = fmt::format(
        "{} equilibria by {} iterations: {} force evaluations, {} solutions, {} factorisations and {} in part, {} "
        "links taken out of a factor",
        c.searches, c.iterations, c.forces, c.solves, c.factorizations, c.partial_factorizations, c.updates);
    writer.set_provenance(prefix() + "solver_cost", line);
    if (stepper_->falls() > 0)
      writer.set_provenance(prefix() + "falls",
                            fmt::format("fell {} times from one branch of equilibria to another without a break; all "
                                        "falls released {:.4g} J",
                                        stepper_->falls(), stepper_->works().released));
    return why;
  };
  const auto count = [&] { step_ = first_step_ + stepper_->solver().cost().searches; };
  const double end = path_->duration();
  const auto report_now = [&] {
    report(options, stepper_->time() / end, start_time_ + stepper_->time(), path_->strain(stepper_->time()), stress_);
  };
  const std::int64_t frames = std::max(1, stage_.output.frames);
  std::optional<std::string> ended;
  try {
    if (resumed_) {
      last_frame_time_ = start_time_ + stepper_->time();
    } else {
      last_frame_time_ = -1;
      stepper_->settle();
      ended = add_row(writer, columns, facts);
      write_frame(writer);
    }
    while (true) {
      if (stepper_->critical() && !ended) {
        stepper_->fall([&] { return !interrupted(); });
        count();
        add_events(writer);
        if (interrupted()) break;
        ended = add_row(writer, columns, facts);
        report_now();
      }
      if (!stepper_->over().empty()) ended = stepper_->over();
      const bool at_end = stepper_->time() >= end * (1 - 1e-12);
      if (!ended && at_end) ended = stage_.loading ? fmt::format("strain {:.4g} reached", path_->strain(end)) : "end";
      const double next = end * static_cast<double>(frame_) / static_cast<double>(frames);
      if (ended || stepper_->time() >= next * (1 - 1e-12)) {
        if (start_time_ + stepper_->time() > last_frame_time_)
          write_frame(writer);
        else
          ++frame_;
      }
      if (ended || interrupted()) break;
      stepper_->load_towards(std::min(end, end * static_cast<double>(frame_) / static_cast<double>(frames)),
                             [&] { return !interrupted(); });
      count();
      add_events(writer);
      if (!stepper_->over().empty()) continue;
      ended = add_row(writer, columns, facts);
      report_now();
    }
  } catch (const SolverError&) {
    // The last good state goes to disk, so that a run with other settings can go on from it.
    add_events(writer);
    if (!base_.empty() && start_time_ + stepper_->time() > last_frame_time_) write_frame(writer);
    throw;
  }
  if (ended) return finish(*ended);
  facts.interrupted = true;
  return finish("interrupted");
}

}  // namespace lamella
