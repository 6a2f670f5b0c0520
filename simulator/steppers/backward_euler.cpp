#include "simulator/steppers/backward_euler.h"

namespace lamella {

// m (x1 - x0 - dt v0) / dt^2 + gamma m (x1 - x0) / dt = m (1 + gamma dt) / dt^2 (x1 - a) with a = x0 + dt v0 / (1 + gamma dt).
ImplicitStepper::Step BackwardEuler::plan(double dt) const {
  const double slowed = 1 + model().drag_rate * dt;
  Step step{.share = 1, .per_mass = slowed / (dt * dt), .anchor = start()};
  for (std::size_t i = 0; i < step.anchor.size(); ++i) step.anchor.add(i, dt / slowed * state().v.at(i));
  return step;
}

void BackwardEuler::finish(double dt, const Field& x0, const Field& x1, double energy0) {
  Field& v = velocity();
  double drag = 0, jolt = 0, force_work = 0;
  for (std::size_t i = 0; i < x1.size(); ++i) {
    const Vec2 way = x1.at(i) - x0.at(i), v1 = way / dt;
    const double m = model().mass[i];
    const Index node = static_cast<Index>(i);
    drag += model().drag_rate * m * v1.dot(way);
    for (int c = 0; c < 2; ++c)
      if (!held(node, c)) jolt += 0.5 * m * (v1[c] - v.at(i)[c]) * (v1[c] - v.at(i)[c]);
    v.set(i, v1);  // of held nodes too: they go straight
    force_work += terms_force().at(i).dot(way);
  }
  book_damping(drag + jolt + energy0 - model().energy(state().x) - force_work);
}

}  // namespace lamella
