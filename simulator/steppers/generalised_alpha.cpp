#include "simulator/steppers/generalised_alpha.h"

#include "simulator/moving_box.h"

namespace lamella {

GeneralisedAlpha::GeneralisedAlpha(Model& model, std::vector<Load>& loads, State& state, double residual,
                                   double spectral_radius)
    : ImplicitStepper(model, loads, state, residual),
      alpha_m_((2 * spectral_radius - 1) / (spectral_radius + 1)),
      alpha_f_(spectral_radius / (spectral_radius + 1)),
      gamma_(0.5 - alpha_m_ + alpha_f_),
      beta_(0.25 * (1 - alpha_m_ + alpha_f_) * (1 - alpha_m_ + alpha_f_)),
      a_(acceleration_at_start()) {}

// Loads that push from the beginning on are in the first step.
Field GeneralisedAlpha::acceleration_at_start() const {
  Field a(state().x.size());
  for (const Term* term : model().terms()) term->add_force(state().x, a);
  make_relative(model().sample, a);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 2; ++c) {
      double& value = (c == 0 ? a.x : a.y)[i];
      value = held(static_cast<Index>(i), c) ? 0.0
                                             : value * model().inverse_mass[i] - model().drag_rate * state().v.at(i)[c];
    }
  return a;
}

Vec2 GeneralisedAlpha::from_start(std::size_t i, double dt) const {
  return -state().v.at(i) / (beta_ * dt) - (0.5 / beta_ - 1) * a_.at(i);
}

// (1 - alpha_m) a1 + alpha_m a0 + drag (v0 + s dt ((1 - g) a0 + g a1)) = A a1 + B, a1 = (y - x0) / (s beta dt^2) + c.
ImplicitStepper::Step GeneralisedAlpha::plan(double dt) const {
  const double s = 1 - alpha_f_, drag = model().drag_rate;
  const double a = 1 - alpha_m_ + drag * s * dt * gamma_;
  Step step{.share = s, .per_mass = a / (s * beta_ * dt * dt), .anchor = start()};
  for (std::size_t i = 0; i < step.anchor.size(); ++i) {
    const Vec2 b = alpha_m_ * a_.at(i) + drag * (state().v.at(i) + s * dt * (1 - gamma_) * a_.at(i));
    step.anchor.add(i, -(a * from_start(i, dt) + b) / step.per_mass);
  }
  return step;
}

void GeneralisedAlpha::finish(double dt, const Field& x0, const Field& x1, double /*energy0*/) {
  Field& v = velocity();
  double drag = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec2 way = x1.at(i) - x0.at(i), v0 = v.at(i);
    Vec2 a1 = way / (beta_ * dt * dt) + from_start(i, dt);
    Vec2 v1 = v0 + dt * ((1 - gamma_) * a_.at(i) + gamma_ * a1);
    for (int c = 0; c < 2; ++c)
      if (held(static_cast<Index>(i), c)) v1[c] = prescribed(static_cast<Index>(i), c), a1[c] = 0;
    drag += model().drag_rate * model().mass[i] * ((1 - alpha_f_) * v1 + alpha_f_ * v0).dot(way);
    a_.set(i, a1), v.set(i, v1);
  }
  book_damping(drag);
}

void GeneralisedAlpha::save(ArraySet& restart) const {
  ImplicitStepper::save(restart);
  const Sample& sample = model().sample;
  restart.add({"acceleration", "m/s2", "node", 2, rows_of_nodes(sample, a_)});
  if (!box_moves(sample, a_)) return;
  const Vec2 of_box = a_.at(sample.x.size());
  restart.add({"box_acceleration", "m/s2", "model", 1, std::vector<double>{of_box.x(), of_box.y()}});
}

void GeneralisedAlpha::restore(const ArraySet& restart) {
  ImplicitStepper::restore(restart);
  a_ = field_from(restart.doubles("acceleration"));
  if (restart.find("box_acceleration")) append_box(a_, vec_from(restart.doubles("box_acceleration")));
}

}  // namespace lamella
