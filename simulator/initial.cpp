#include "simulator/initial.h"

#include "generator/sample/selection.h"

namespace lamella {
namespace {

Vec2 centre_of_mass(const Model& model, const std::vector<Index>& nodes, const Field& x) {
  Vec2 sum = Vec2::Zero();
  double mass = 0;
  for (Index i : nodes) sum += model.mass[i] * x.at(i), mass += model.mass[i];
  return sum / mass;
}

/// Of all terms and of loads as they push when the stage begins [N].
Field forces_at_start(const Model& model, const std::vector<Load>& loads, const Field& x) {
  Field f(x.size());
  for (const Term* term : model.terms()) term->add_force(x, f);
  add_pushes(
      loads, [](const Load& load) { return load.ramp == 0 ? 1.0 : 0.0; }, f);
  return f;
}

}  // namespace

void set_initial_velocities(const Model& model, const Stage& stage, const std::vector<Load>& loads, double dt,
                            State& state) {
  if (stage.initial.empty()) return;
  const std::size_t nodes = state.x.size();
  Field stated(nodes);
  std::vector<bool> states[2] = {std::vector<bool>(nodes, false), std::vector<bool>(nodes, false)};
  for (const InitialScene& scene : stage.initial) {
    const std::vector<Index> selected = select_nodes(model.sample, scene.nodes);
    const Vec2 centre = scene.centre.value_or(centre_of_mass(model, selected, state.x));
    const Vec2 shift(scene.velocity_x.value_or(0), scene.velocity_y.value_or(0));
    for (Index i : selected) {
      stated.add(i, shift + scene.spin.value_or(0) * left_of(state.x.at(i) - centre));
      if (scene.velocity_x || scene.spin) states[0][i] = true;
      if (scene.velocity_y || scene.spin) states[1][i] = true;
    }
  }
  // The first kick: v(1/2) = (1 - g) / (1 + g) v(-1/2) + dt / (1 + g) f / m with g = drag dt / 2, so that the mean of both
  // is v0 where v(-1/2) = (1 + g) v0 - dt f / 2 m.
  const Field f = forces_at_start(model, loads, state.x);
  const double g = 0.5 * model.drag_rate * dt;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double half_kick = 0.5 * dt * model.inverse_mass[i];
    if (states[0][i]) state.v.x[i] = (1 + g) * stated.x[i] - half_kick * f.x[i];
    if (states[1][i]) state.v.y[i] = (1 + g) * stated.y[i] - half_kick * f.y[i];
  }
}

}  // namespace lamella
