#include "simulator/steppers/box_step.h"

#include <algorithm>
#include <cmath>

namespace lamella {

BoxStep::BoxStep(const Model& model, const std::vector<Load>& loads, State& state)
    : model_(model), loads_(loads), state_(state), node_(box_moves(model.sample, state.x) ? model.sample.nodes() : -1) {
  for (std::size_t i = 0; moves() && i < model.sample.x.size(); ++i) {
    const Vec2 share = carried_share(model.sample, i);
    share_x_.push_back(share.x()), share_y_.push_back(share.y());
  }
  for (std::size_t l = 0; l < loads.size(); ++l) {
    if (!loads[l].box) continue;
    load = static_cast<Index>(l);
    held = {loads[l].holds[0], loads[l].holds[1]};
  }
}

Vec2 BoxStep::share_of(const Field& f, Index begin, Index end) const {
  const double *SX = share_x_.data(), *SY = share_y_.data(), *FX = f.x.data(), *FY = f.y.data();
  double x = 0, y = 0;
#pragma omp simd reduction(+ : x, y)
  for (Index i = begin; i < end; ++i) x += SX[i] * FX[i], y += SY[i] * FY[i];
  return {x, y};
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

  state_.v.set(node_, next);
  state_.x.add(node_, dt * next);
  const double *SX = share_x_.data(), *SY = share_y_.data(), *VX = state_.v.x.data(), *VY = state_.v.y.data();
  double *X = state_.x.x.data(), *Y = state_.x.y.data(), most = 0;
  const double nx = next.x(), ny = next.y();
#pragma omp simd reduction(max : most)
  for (Index i = 0; i < node_; ++i) {
    const double cx = SX[i] * nx, cy = SY[i] * ny;
    most = std::max(most, (VX[i] + cx) * (VX[i] + cx) + (VY[i] + cy) * (VY[i] + cy));
    X[i] += dt * cx, Y[i] += dt * cy;
  }
  // Against an image a node moves with the image's box too.
  fastest = std::sqrt(most) + (model_.contacts ? 0.5 * model_.contacts->farthest_image() * next.norm() : 0.0);
}

}  // namespace lamella
