#include "simulator/steppers/box_step.h"

#include <algorithm>
#include <cmath>

namespace lamella {

BoxStep::BoxStep(const Model& model, const std::vector<Load>& loads, State& state)
    : model_(model), loads_(loads), state_(state), node_(box_moves(model.sample, state.x) ? model.sample.nodes() : -1) {
  for (std::size_t l = 0; l < loads.size(); ++l) {
    if (!loads[l].box) continue;
    load = static_cast<Index>(l);
    held = {loads[l].holds[0], loads[l].holds[1]};
  }
}

void BoxStep::advance(const Vec2& force, const Vec2& damped, double dt, double kick) {
  const double mass = model_.mass[node_], g = 0.5 * model_.drag_rate * kick;
  Vec2 v = state_.v.at(node_), next;
  reaction.setZero();
  double work_in = 0, damping_in = 0;
  work_out = damping_out = kinetic = largest_force = 0;
  for (int c = 0; c < 2; ++c) {
    if (held[c]) {
      const Load& by = loads_[load];
      next[c] = by.factor * by.velocity[c];
      const double push = mass * (next[c] - v[c]) / kick - force[c];
      reaction[c] = -force[c];
      work_in += 0.5 * kick * push * v[c];
      work_out += 0.5 * kick * push * next[c];
    } else {
      next[c] = ((1 - g) * v[c] + kick / mass * force[c]) / (1 + g);
      const double mean = 0.5 * (v[c] + next[c]), drag = 0.5 * model_.drag_rate * kick * mass * mean;
      damping_in += drag * v[c], damping_out += drag * next[c];
      largest_force = std::max(largest_force, std::abs(force[c]));
    }
    damping_in -= 0.5 * kick * damped[c] * v[c], damping_out -= 0.5 * kick * damped[c] * next[c];
    kinetic += 0.5 * mass * v[c] * next[c];
  }
  work += work_in + work_out;
  damping += damping_in + damping_out;

  const Sample& sample = model_.sample;
  state_.v.set(node_, next);
  state_.x.add(node_, dt * next);
  double most = 0;
  for (std::size_t i = 0; i < sample.x.size(); ++i) {
    const Vec2 carried = carried_share(sample, i).cwiseProduct(next);
    most = std::max(most, (state_.v.at(i) + carried).squaredNorm());
    state_.x.add(i, dt * carried);
  }
  // Against an image a node moves with the image's box too.
  fastest = std::sqrt(most) + (model_.contacts ? 0.5 * model_.contacts->farthest_image() * next.norm() : 0.0);
}

}  // namespace lamella
