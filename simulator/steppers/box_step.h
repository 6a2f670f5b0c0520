// The kick and drift of a box that moves (moving_box.h), in the explicit step: its growth is one unknown more in each direction, with a mass, a
// force and a velocity, held by the load that pulls it or free. It carries all nodes along, once all forces of the step are known.
#pragma once
#include <array>

#include "simulator/moving_box.h"
#include "simulator/steppers/stepper.h"

namespace lamella {

/// What a step finds, and what has been booked so far.
struct BoxStep {
  BoxStep(const Model& model, const std::vector<Load>& loads, State& state);

  bool moves() const { return node_ >= 0; }
  /// Rate of the box's growth half a step before [m/s].
  Vec2 rate() const { return moves() ? state_.v.at(node_) : Vec2(0, 0); }
  /// The same without what a load holds.
  Vec2 free_rate() const { return {held[0] ? 0.0 : rate().x(), held[1] ? 0.0 : rate().y()}; }
  /// Velocity of a node, carried along [m/s].
  Vec2 velocity(std::size_t node) const {
    return state_.v.at(node) + carried_share(model_.sample, node).cwiseProduct(rate());
  }
  /// Velocities of all nodes, and the rate of the growth.
  Field velocities() const { return absolute(model_.sample, state_.v); }
  /// Of a field of forces on nodes [begin, end), what acts on the growth.
  Vec2 share_of(const Field& f, Index begin, Index end) const;
  /// Kick and drift under `force` on the relative growth, of which `damped` is that of dashpots [N].
  void advance(const Vec2& force, const Vec2& damped, double dt, double kick);

  Index load = -1;                // that holds a component; -1: none
  Vec2 reaction = Vec2::Zero();   // of that load, its inertia apart, in this step [N]
  double work = 0, work_out = 0;  // of that load so far; second half of this step's [J]
  double damping = 0, damping_out = 0;
  double kinetic = 0;        // in this step, as a measurement has it [J]
  double largest_force = 0;  // on a free component [N]
  double fastest = 0;        // bound on the velocity of any node against any that it may touch [m/s]
  std::array<bool, 2> held{false, false};

 private:
  std::vector<double> share_x_, share_y_;  // of each node (carried_share); empty unless the box moves
  const Model& model_;
  const std::vector<Load>& loads_;
  State& state_;
  Index node_ = -1;
};

}  // namespace lamella
