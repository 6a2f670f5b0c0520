#include "simulator/steppers/implicit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/sample/errors.h"
#include "simulator/moving_box.h"

namespace lamella {

ImplicitStepper::ImplicitStepper(Model& model, std::vector<Load>& loads, State& state, double residual)
    : model_(model),
      loads_(loads),
      state_(state),
      solver_(model, loads),
      residual_(residual),
      force_(state.x.size()),
      prescribed_(2 * state.x.size(), 0.0) {
  std::vector<std::string> faults;
  const auto refuse = [&](bool present, const char* what) {
    if (present)
      faults.push_back(
          fmt::format("run.stepper: implicit steps have no {}; take it out, or use 'velocity_verlet'", what));
  };
  refuse(model.dashpots != nullptr, "dashpots");
  refuse(model.contact_damping > 0, "contact damping");
  refuse(model.rupture != nullptr, "walls that break");
  refuse(!model.pressure_histories.empty(), "pressures that follow a history");
  if (!faults.empty()) throw SceneError(std::move(faults));
  fully_held_.assign(state.x.size(), 0);
  for (Index i = 0; i < static_cast<Index>(fully_held_.size()); ++i) fully_held_[i] = held(i, 0) && held(i, 1);
  if (model.links && model.links->softens()) works_.fracture = -model.links->dissipated();
}

Field ImplicitStepper::pushes() const {
  Field dead(state_.x.size());
  add_pushes(
      loads_, [](const Load& load) { return load.factor; }, dead);
  return dead;
}

void ImplicitStepper::step(double dt, double /*kick*/) {
  const Sample& sample = model_.sample;
  const Field x0 = state_.x;
  const double energy0 = model_.energy(x0);
  start_ = relative(sample, x0);
  const Field dead = pushes();
  Step plan = this->plan(dt);
  if (plan.per_mass != planned_) solver_.drop_factor();  // made for another step
  planned_ = plan.per_mass;
  std::vector<double> spring(model_.mass);
  for (double& d : spring) d *= plan.per_mass;
  solver_.set_anchors(spring, plan.anchor);
  solver_.set_dead_forces(dead);

  // What is held goes its way; the rest is first guessed to go on as it was.
  Field y(x0.size());
  for (std::size_t i = 0; i < y.size(); ++i) y.set(i, start_.at(i) + plan.share * dt * state_.v.at(i));
  for (const Load& load : loads_)
    for (Index i : load.nodes)
      for (int c = 0; c < 2; ++c)
        if (load.holds[c]) {
          prescribed_[2 * static_cast<std::size_t>(i) + c] = load.factor * load.velocity[c];
          (c == 0 ? y.x : y.y)[i] = start_.at(i)[c] + plan.share * dt * load.factor * load.velocity[c];
        }
  y = absolute(sample, std::move(y));
  if (model_.contacts) {
    Field way(y.size());
    for (std::size_t i = 0; i < y.size(); ++i)
      for (int c = 0; c < 2; ++c)
        if (!held(static_cast<Index>(i), c)) (c == 0 ? way.x : way.y)[i] = y.at(i)[c] - x0.at(i)[c];
    const double share = model_.contacts->safe_share(x0, way);
    for (std::size_t i = 0; i < y.size(); ++i)
      for (int c = 0; c < 2; ++c)
        if (!held(static_cast<Index>(i), c)) (c == 0 ? y.x : y.y)[i] -= (1 - share) * way.at(i)[c];
  }
  if (!solver_.relax(y, residual_)) {
    const Index node = solver_.worst_node();
    throw SolverError(fmt::format(
        "t = {:.6g} s: an implicit step of {:.4g} s finds no solution: {}; {:.3g} of the largest force {:.3g} N is "
        "left, most on node {} at ({:.4g}, {:.4g}) m; give a smaller run.time_step",
        state_.time, dt, solver_.failure(), solver_.residual(), solver_.internal_force(), node, x0.x[node],
        x0.y[node]));
  }
  y = relative(sample, std::move(y));
  force_ = solver_.force();
  make_relative(sample, force_);
  Field x1(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) {
    // Without the springs, which are inertia and drag, and without the loads.
    force_.add(i, spring[i] * (y.at(i) - plan.anchor.at(i)) - dead.at(i));
    x1.set(i, start_.at(i) + (y.at(i) - start_.at(i)) / plan.share);
  }
  state_.x = absolute(sample, x1);
  const Field v0 = state_.v;
  finish(dt, start_, x1, energy0);
  for (const Load& load : loads_)
    for (std::size_t k = 0; k < load.nodes.size(); ++k) {
      const Index i = load.nodes[k];
      const Vec2 way = x1.at(i) - start_.at(i);
      if (load.pushes) works_.loads += load.factor * load.force[k].dot(way);
      for (int c = 0; c < 2; ++c)
        if (load.holds[c]) {  // against all other forces, and against the inertia and the drag of what is held
          const double v1 = state_.v.at(i)[c], m = model_.mass[i];
          works_.loads += 0.5 * m * (v1 * v1 - v0.at(i)[c] * v0.at(i)[c]) + model_.drag_rate * m * v1 * way[c] -
                          (force_.at(i)[c] + dead.at(i)[c]) * way[c];
        }
    }
  state_.time += dt;
  ++state_.step;
  commit_and_break();
}

void ImplicitStepper::commit_and_break() {
  for (Term* term : model_.terms()) term->commit(state_.x);
  if (!model_.links) return;
  for (Break event : model_.links->breaks()) {
    solver_.drop_factor();
    model_.hand_over(event, state_.x, state_.time);
    works_.fracture += event.energy;
    breaks_.push_back(event);
  }
}

Measurement ImplicitStepper::measured_step(double dt, double kick, Field* force_on_node) {
  // Everything of the start of the step, where the last one has ended.
  Measurement m;
  m.works = works_;
  m.works.plastic = model_.plastic_dissipated();
  if (model_.contacts && model_.friction > 0) m.works.friction = model_.contacts->friction_dissipated();
  if (model_.links && model_.links->softens()) m.works.fracture += model_.links->dissipated();
  for (std::size_t i = 0; i < model_.mass.size(); ++i) m.kinetic += 0.5 * model_.mass[i] * state_.v.at(i).squaredNorm();
  const Field dead = pushes();
  solver_.set_dead_forces(dead);
  solver_.evaluate(state_.x, work_);
  Field f = solver_.force();
  make_relative(model_.sample, f);
  m.load_force.assign(loads_.size(), Vec2::Zero());
  if (force_on_node) *force_on_node = dead;
  for (std::size_t l = 0; l < loads_.size(); ++l)
    for (std::size_t k = 0; k < loads_[l].nodes.size(); ++k) {
      const Index i = loads_[l].nodes[k];
      if (loads_[l].pushes) m.load_force[l] += loads_[l].factor * loads_[l].force[k];
      for (int c = 0; c < 2; ++c)
        if (loads_[l].holds[c]) {
          m.load_force[l][c] -= f.at(i)[c];
          if (force_on_node) (c == 0 ? force_on_node->x : force_on_node->y)[i] -= f.at(i)[c];
        }
    }
  const double largest = work_.size() > 0 ? work_.cwiseAbs().maxCoeff() : 0.0;
  m.unbalanced = largest > 0 ? largest / (largest + solver_.internal_force()) : 0.0;
  step(dt, kick);
  return m;
}

void ImplicitStepper::save(ArraySet& restart) const {
  restart.add({"implicit_works", "J", "model", 1, std::vector<double>{works_.loads, works_.damping, works_.fracture}});
}

void ImplicitStepper::restore(const ArraySet& restart) {
  const auto& works = restart.doubles("implicit_works");
  works_.loads = works.at(0), works_.damping = works.at(1), works_.fracture = works.at(2);
}

}  // namespace lamella
