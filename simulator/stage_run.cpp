#include "simulator/stage_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "generator/sample/errors.h"
#include "generator/sample/voids.h"
#include "simulator/initial.h"

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

Field field_from(const std::vector<double>& rows) {
  Field f(rows.size() / 2);
  for (std::size_t i = 0; i < f.size(); ++i) f.x[i] = rows[2 * i], f.y[i] = rows[2 * i + 1];
  return f;
}

std::vector<Vec2> points_from(const Field& f) {
  std::vector<Vec2> points(f.size());
  for (std::size_t i = 0; i < f.size(); ++i) points[i] = f.at(i);
  return points;
}

std::vector<double> rows_from(const Field& f) {
  std::vector<double> rows(2 * f.size());
  for (std::size_t i = 0; i < f.size(); ++i) rows[2 * i] = f.x[i], rows[2 * i + 1] = f.y[i];
  return rows;
}

double interpolated(const std::vector<Vec2>& points, double t) {
  if (t <= points.front().x()) return points.front().y();
  for (std::size_t k = 1; k < points.size(); ++k)
    if (t <= points[k].x()) {
      const double u = (t - points[k - 1].x()) / (points[k].x() - points[k - 1].x());
      return (1 - u) * points[k - 1].y() + u * points[k].y();
    }
  return points.back().y();
}

}  // namespace

StageRun::StageRun(const Sample& sample, const Scene& scene, int stage, const ArraySet& start, Start how)
    : sample_(sample), scene_(scene), stage_(scene.stages[stage]), index_(stage), resumed_(how == Start::kResumed) {
  const std::size_t nodes = sample.nodes();
  state_.x = Field(nodes), state_.v = Field(nodes);
  if (start.find("x")) {
    state_.x = field_from(start.doubles("x"));
    state_.v = field_from(start.doubles("v"));
    const auto& clock = start.doubles("clock");
    state_.time = clock.at(0);
    state_.step = static_cast<std::int64_t>(clock.at(1));
  } else {
    for (std::size_t i = 0; i < nodes; ++i) state_.x.set(i, sample.x[i]);
  }
  model_ = build_model(sample, stage_, state_.x);
  loads_ = build_loads(sample, stage_);
  load_columns_ = load_columns(loads_);
  gauge_ = measure_gauge(sample, stage_, loads_);
  if (stage_.loading) course_.emplace(*stage_.loading, gauge_);
  if (start.find("bar_broken")) {
    if (!model_->rupture) model_->add_rupture({});
    model_->rupture->restore(start);
    if (model_->links && model_->rupture->broken().count() > 0) model_->links->follow(model_->rupture->broken());
  }
  for (Term* term : model_->terms()) term->restore(start);
  stepper_ = std::make_unique<VelocityVerlet>(*model_, loads_, state_, stage_.run.threads);

  if (stage_.stop.compaction || stage_.stop.void_ratio) {
    const auto room = room_between_walls(sample, sample.x), now = room_between_walls(sample, points_from(state_.x));
    if (!room || !now)
      throw SceneError(fmt::format(
          "stop.{}: needs closed cells between walls on all four sides: open chains along x and y, such as plates",
          stage_.stop.compaction ? "compaction" : "void_ratio"));
    sample_room_ = room->area();
    loosens_ = stage_.stop.compaction && compaction(*now) > *stage_.stop.compaction;
  }
  start_time_ = state_.time;
  if (course_) duration_ = course_->duration();
  if (stage_.stop.time)
    duration_ = course_ && !stage_.loading->step ? std::min(duration_, *stage_.stop.time) : *stage_.stop.time;
  if (!(duration_ > 0) || !std::isfinite(duration_))
    throw SceneError(fmt::format(
        "stop.time: stage '{}' has no [loading] and no stop.time, and would run for ever; give a time", stage_.name));
  const int frames = std::max(1, stage_.output.frames);
  rows_per_frame_ = std::max(1, stage_.output.response / frames);
  row_interval_ = duration_ / (static_cast<double>(frames) * static_cast<double>(rows_per_frame_));

  if (how == Start::kResumed) {
    stepper_->restore(start);
    if (course_) course_->restore(start.doubles("course"));
    const auto& d = start.doubles("driver");
    start_time_ = d.at(0), row_ = static_cast<std::int64_t>(d.at(1)),
    steps_per_row_ = static_cast<std::int64_t>(d.at(2));
    dt_ = d.at(3), last_dt_ = d.at(4), peak_stress_ = d.at(5), largest_work_ = d.at(6);
    pressure_work_ = d.at(7);
    base_ = start.doubles("ledger_base");
    pressure_lever_ = start.doubles("pressure_lever");
    if (stage_.stop.compaction) loosens_ = start.doubles("loosens").at(0) != 0;
  }
  if (model_->links) broken_ = model_->links->broken();
  if (model_->rupture) broken_bars_ = model_->rupture->broken().count();
  for (const auto& history : model_->pressure_histories)
    model_->core->set_pressure(history.cell, interpolated(*history.points, state_.time - start_time_));
  plan_step();
  if (how != Start::kResumed) set_initial_velocities(*model_, stage_, loads_, dt_, state_);
}

// The step is a whole fraction of the time between rows, and changes only when the bound asks for a smaller one: a constant
// step keeps the scheme symplectic.
void StageRun::plan_step() {
  // The bound counts the listed pairs: a list made here, and not some steps ago, is the same in a resumed run.
  if (model_->contacts) model_->contacts->rebuild(state_.x);
  stable_ = stable_time_step(*model_, state_.x, stepper_->fully_held());
  double allowed = stage_.run.step_fraction * stable_.dt;
  if (stage_.run.time_step) {
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

void StageRun::columns(std::vector<std::string>& names, std::vector<std::string>& units) const {
  const auto add = [&](const std::string& name, const char* unit) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name), units.emplace_back(unit);
  };
  add("time", "s"), add("stage", "1");
  if (course_) add("strain", "1"), add("stress", "Pa"), add("force_a", "N"), add("force_b", "N");
  for (const LoadColumn& column : load_columns_) add(column.name, column.unit.c_str());
  for (const Term* term : model_->terms()) add("energy_" + term->name(), "J");
  add("kinetic", "J"), add("work", "J");
  if (model_->drag_rate > 0 || model_->dashpots || model_->contact_damping > 0) add("damping", "J");
  if (model_->friction > 0) add("friction", "J");
  bool plastic = false;
  for (const ShellTerm* term : model_->shell_terms()) plastic = plastic || term->plastic();
  if (plastic) add("plastic", "J");
  const bool links_break = model_->links && (model_->links->breakable() || model_->rupture);
  if (links_break || model_->rupture) add("fracture", "J");
  if (links_break) add("broken_links", "1");
  if (model_->rupture) add("broken_bars", "1");
  add("residual", "1"), add("unbalanced", "1");
}

std::vector<std::string> StageRun::summary() const {
  std::vector<std::string> lines;
  std::string terms;
  for (const Term* term : model_->terms()) terms += (terms.empty() ? "" : ", ") + term->name();
  if (model_->dashpots) terms += ", dashpots";
  if (model_->drag_rate > 0) terms += ", drag";
  lines.push_back(fmt::format("stage '{}': {}", stage_.name, terms));
  lines.push_back(fmt::format("  {} cells, {} nodes, {} links; {:.1f} MB of terms", sample_.cells(), sample_.nodes(),
                              model_->links ? sample_.links.size() : 0, static_cast<double>(model_->bytes()) / 1e6));
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
    lines.push_back(fmt::format(
        "  grips part at {:.3g} m/s, {:.2g} of the wall's wave speed {:.3g} m/s; gauge length {:.4g} m, width {:.4g} m",
        gauge_.speed, std::abs(gauge_.speed) / wave, wave, gauge_.length, gauge_.width));
  }
  return lines;
}

void StageRun::describe(Provenance& p) const {
  const std::string prefix = index_ == 0 ? "" : fmt::format("stage_{}_", index_);
  if (course_) {
    p[prefix + "axis"] = gauge_.axis == 0 ? "x" : "y";
    p[prefix + "kind"] = stage_.loading->kind;
    p[prefix + "gauge_length"] = fmt::format("{:.17g}", gauge_.length);
    p[prefix + "width"] = fmt::format("{:.17g}", gauge_.width);
    p[prefix + "depth"] = fmt::format("{:.17g}", gauge_.depth);
    p[prefix + "grip_speed"] = fmt::format("{:.17g}", gauge_.speed);
  }
  p[prefix + "time_step"] = fmt::format("{:.17g}", dt_);
  p[prefix + "stable_time_step"] = fmt::format("{:.17g}", stable_.dt);
  p[prefix + "step_limited_by"] = fmt::format("node {}: {}", stable_.node, stable_.limited_by);
  std::string text;
  for (const auto& line : summary()) text += line + "\n";
  p[prefix + "summary"] = text;
}

void StageRun::set_loads(double dt) {
  const double since = state_.time - start_time_;
  const double factor = course_ ? course_->advance(since, dt) : 0.0;
  for (Load& load : loads_) {
    if (load.grip)
      load.factor = factor;
    else  // velocities hold between steps, forces at them
      load.factor = load.ramp > 0 ? smooth_ramp((since + (load.pushes ? 0.0 : 0.5 * dt)) / load.ramp) : 1.0;
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
    const double before = model_->core->pressure(history.cell), now = interpolated(*history.points, since);
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
    row.force_a = -m.load_force[0][gauge_.component];
    row.force_b = m.load_force[1][gauge_.component];
    row.stress = row.force_b / (gauge_.width * gauge_.depth);
  }
  const Works& w = row.works;
  const double in = w.loads + w.pressure, out = energy + m.kinetic + w.damping + w.friction + w.plastic + w.fracture;
  row.residual = base_.empty() ? 0.0 : (in - base_[0]) - (out - base_[1]);
  return row;
}

std::optional<std::string> StageRun::stop_reason(const Row& row) {
  const double since = row.time - start_time_;
  const double magnitude = std::abs(row.stress);
  peak_stress_ = std::max(peak_stress_, magnitude);
  if (course_ && course_->finished()) return fmt::format("strain {:.4g} reached", row.strain);
  const StopScene& stop = stage_.stop;
  if (stop.time && since >= *stop.time * (1 - 1e-9)) return fmt::format("time {:.4g} s reached", *stop.time);
  const bool damaged = broken_ + broken_bars_ > 0;
  if (stop.stress_drop && damaged && magnitude < *stop.stress_drop * peak_stress_)
    return fmt::format("stress fell below {:.0f} % of its peak {:.4g} Pa", 100 * *stop.stress_drop, peak_stress_);
  if (stop.separated && damaged && separated()) return "separated: no path of shells and intact links joins the grips";
  if (stop.at_rest && row_ > 0 && row.unbalanced < *stop.at_rest)
    return fmt::format("at rest: relative unbalanced force {:.2g}", row.unbalanced);
  for (std::size_t l = 0; l < loads_.size(); ++l)
    if (loads_[l].stop_force && row.load_force[l].norm() > *loads_[l].stop_force)
      return fmt::format("load '{}' exerts {:.4g} N", loads_[l].name, row.load_force[l].norm());
  return row.packed;
}

/// The stop condition of the room between the walls that holds in the present configuration.
std::optional<std::string> StageRun::packed() const {
  if (!(sample_room_ > 0)) return std::nullopt;
  const std::vector<Vec2> x = points_from(state_.x);
  const auto room = room_between_walls(sample_, x);
  if (!room) throw SolverError(fmt::format("t = {:.6g} s: there is no room left between the walls", state_.time));
  if (const auto& asked = stage_.stop.compaction)
    if (const double reached = compaction(*room); loosens_ ? reached <= *asked : reached >= *asked)
      return fmt::format("compaction {:.4g} reached", reached);
  if (const auto& asked = stage_.stop.void_ratio)
    if (const double reached = void_ratio(sample_, x, *room); reached < *asked)
      return fmt::format("void ratio {:.4g} reached", reached);
  return std::nullopt;
}

bool StageRun::separated() const {
  const Pieces pieces = pieces_of(sample_, model_->rupture ? &model_->rupture->broken() : nullptr);
  std::vector<Index> parent(pieces.count);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index node) {
    Index c = pieces.of_node[node];
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  if (model_->links)
    for (std::size_t l = 0; l < sample_.links.size(); ++l)
      if (model_->links->intact(static_cast<Index>(l))) parent[root(sample_.links[l].a)] = root(sample_.links[l].b);
  std::vector<std::uint8_t> low(pieces.count, 0);
  for (Index i : loads_[0].nodes) low[root(i)] = 1;
  return std::none_of(loads_[1].nodes.begin(), loads_[1].nodes.end(), [&](Index i) { return low[root(i)] != 0; });
}

// What the model cannot mean anything beyond: stop with time and object.
void StageRun::check_health() const {
  const Field& x = state_.x;
  const BrokenBars* const broken = model_->rupture ? &model_->rupture->broken() : nullptr;
  for (Index c = 0; c < sample_.cells(); ++c) {
    for (Index i = sample_.cell_begin[c]; i < sample_.cell_begin[c + 1]; ++i) {
      if (!std::isfinite(x.x[i]) || !std::isfinite(x.y[i]))
        throw SolverError(
            fmt::format("t = {:.6g} s: the position of node {} of cell {} is no longer a number", state_.time, i, c));
      if (!sample_.starts_segment(c, i) || (broken && broken->gone(i))) continue;
      const double l = (x.at(sample_.next(c, i)) - x.at(i)).norm();
      if (l < 0.1 * sample_.rest_length[i])
        throw SolverError(fmt::format(
            "t = {:.6g} s: segment {} of cell {} has collapsed to {:.3g} of its rest length; load more slowly, or "
            "make the wall stiffer",
            state_.time, i, c, l / sample_.rest_length[i]));
    }
    if (!sample_.closed[c] || !(sample_.rest_area[c] > 0) || (broken && broken->opened(c))) continue;
    double twice = 0;
    const Vec2 origin = x.at(sample_.cell_begin[c]);
    for (Index i = sample_.cell_begin[c]; i < sample_.cell_begin[c + 1]; ++i)
      twice += cross(x.at(i) - origin, x.at(sample_.next(c, i)) - origin);
    if (0.5 * twice < 0.02 * sample_.rest_area[c])
      throw SolverError(fmt::format("t = {:.6g} s: cell {} has {:.3g} of its rest area left, and would turn inside out",
                                    state_.time, c, 0.5 * twice / sample_.rest_area[c]));
  }
  if (model_->links)
    if (const auto crushed = model_->links->crushed(x))
      throw SolverError(fmt::format(
          "t = {:.6g} s: link {} (nodes {} and {}) has been pressed past zero distance; make links or walls stiffer",
          state_.time, *crushed, sample_.links[*crushed].a, sample_.links[*crushed].b));
  if (model_->contacts)
    if (const auto fault = model_->contacts->fault(x))
      throw SolverError(fmt::format("t = {:.6g} s: {}", state_.time, *fault));
}

ArraySet StageRun::restart_arrays() const {
  ArraySet out;
  out.add({"x", "m", "node", 2, rows_from(state_.x)});
  out.add({"v", "m/s", "node", 2, rows_from(state_.v)});
  out.add({"clock", "1", "model", 1,
           std::vector<double>{state_.time, static_cast<double>(state_.step), static_cast<double>(index_)}});
  out.add({"driver", "1", "model", 1,
           std::vector<double>{start_time_, static_cast<double>(row_), static_cast<double>(steps_per_row_), dt_,
                               last_dt_, peak_stress_, largest_work_, pressure_work_}});
  out.add({"ledger_base", "J", "model", 1, base_});
  out.add({"pressure_lever", "J/Pa", "model", 1, pressure_lever_});
  if (course_) out.add({"course", "1", "model", 1, course_->save()});
  if (stage_.stop.compaction) out.add({"loosens", "1", "model", 1, std::vector<double>{loosens_ ? 1.0 : 0.0}});
  for (const Term* term : model_->terms()) term->save(out);
  if (model_->rupture) model_->rupture->save(out);
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

void StageRun::write_events(TrajectoryWriter& writer) {
  std::vector<Event> events;
  const auto add = [&](Event event) {
    event.step = state_.step;
    event.strain = course_ ? course_->strain() : 0.0;
    event.stage = index_;
    events.push_back(event);
  };
  for (const Break& b : stepper_->take_breaks()) {
    add({.time = model_->links->break_time(b.link),
         .link = b.link,
         .position = b.position,
         .f_n = b.f_n,
         .f_t = b.f_t,
         .mode_mix = model_->links->mode_mix_of(b),
         .energy = b.energy});
    ++broken_;
  }
  for (const WallBreak& b : stepper_->take_wall_breaks()) {
    add({.time = model_->rupture->break_time(b.bar),
         .link = -1,
         .bar = b.bar,
         .position = b.position,
         .f_n = b.tension,
         .energy = b.energy});
    ++broken_bars_;
  }
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.time < b.time; });
  for (const Event& event : events) writer.add_event(event);
}

std::string StageRun::run(TrajectoryWriter& writer, const SimulateOptions& options,
                          const std::vector<std::string>& columns, RunFacts& facts) {
  std::optional<std::string> ended;
  const auto index_of = [&](const std::string& name) -> std::ptrdiff_t {
    const auto at = std::find(columns.begin(), columns.end(), name);
    return at == columns.end() ? -1 : at - columns.begin();
  };
  if (last_dt_ == 0) last_dt_ = dt_;
  while (true) {
    // A row: weigh the configuration, in the first step of the interval that it starts. Every so many rows it is a frame too.
    const auto row_start = Clock::now();
    const bool frame = ended || row_ % rows_per_frame_ == 0;
    check_health();
    if (frame && row_ > 0) plan_step();
    const double time = state_.time, strain = course_ ? course_->strain() : 0.0;
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
      arrays.add({"x", "m", "node", 2, rows_from(state_.x)});
      arrays.add({"v", "m/s", "node", 2, rows_from(state_.v)});
      for (const Term* term : model_->terms()) term->add_output(state_.x, arrays);
      if (model_->rupture) model_->rupture->add_output(arrays);
      restart = restart_arrays();
    }
    const auto reason = packed();
    set_loads(dt_);
    const Measurement m = stepper_->measured_step(dt_, 0.5 * (dt_ + last_dt_), exerted.size() > 0 ? &exerted : nullptr);
    last_dt_ = dt_;
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
      std::vector<double> values(columns.size(), 0.0);
      const auto put = [&](const std::string& name, double value) {
        if (const auto at = index_of(name); at >= 0) values[at] = value;
      };
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
      put("broken_links", broken_), put("broken_bars", broken_bars_), put("residual", row.residual),
          put("unbalanced", row.unbalanced);
      writer.add_response(values);
      facts.residual = std::max(facts.residual, row.residual);
    }
    if (frame && !resumed_) {
      if (exerted.size() > 0) arrays.add({"load_force", "N", "node", 2, rows_from(exerted)});
      write(writer, std::move(arrays), std::move(restart), time, step);
    }
    if (resumed_) last_ = std::move(restart);
    resumed_ = false;
    if (options.progress) {
      RunProgress p;
      p.stage = index_, p.stages = static_cast<int>(scene_.stages.size());
      p.stage_name = stage_.name;
      p.done = (index_ + std::min(1.0, (time - start_time_) / duration_)) / p.stages;
      p.time = time, p.strain = strain, p.stress = row.stress, p.broken = broken_ + broken_bars_;
      options.progress(p);
    }
    facts.frame_seconds += seconds_since(row_start);
    if (ended) return *ended;
    ended = stop_reason(row);
    if (course_) course_->report_unbalanced(row.unbalanced, time - start_time_);

    // the rest of the interval; after a stop condition the very next configuration is the last
    const auto start = Clock::now();
    std::int64_t steps = 1;
    if (!ended)
      for (; steps < steps_per_row_; ++steps) {
        set_pressures();
        set_loads(dt_);
        stepper_->step(dt_, dt_);
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
