// Steps in time that are not bound by the stable limit: the positions at the end of a step solve the equations of motion there, or part of the
// way there. What schemes share is here; backward_euler.h and generalised_alpha.h say what they solve and what follows.
//
// A step looks for the rest of a system with springs to anchors (equilibrium.h): with the unknown y, M (y - y0) / h^2 + ... = f(y) is the
// minimum of W(y) - F . y + 1/2 d (y - a)^2. Links are judged where the step ends, all on that one configuration, and break there. Where a
// box moves, y and all that the schemes see are relative coordinates (moving_box.h).
#pragma once
#include "simulator/steppers/equilibrium.h"
#include "simulator/steppers/stepper.h"

namespace lamella {

class ImplicitStepper : public Stepper {
 public:
  /// `residual`: force that may be left in a step, over the largest internal or inertia force. Throws SceneError for what these schemes
  /// do not have: dashpots, contact damping, walls that break.
  ImplicitStepper(Model& model, std::vector<Load>& loads, State& state, double residual);

  void step(double dt, double kick) final;
  Measurement measured_step(double dt, double kick, Field* force_on_node) final;
  std::vector<Break> take_breaks() final { return std::exchange(breaks_, {}); }
  std::vector<WallBreak> take_wall_breaks() final { return {}; }
  const std::vector<std::uint8_t>& fully_held() const final { return fully_held_; }
  bool implicit() const final { return true; }
  void forget() final { solver_.forget(); }
  void save(ArraySet& restart) const override;
  void restore(const ArraySet& restart) override;
  const EquilibriumSolver& solver() const { return solver_; }

 protected:
  /// What a step solves: y = x0 + share (x1 - x0) with springs of stiffness `per_mass` times the mass to `anchor`.
  struct Step {
    double share = 1;     // 1: the unknown is where the step ends
    double per_mass = 0;  // d / m [1/s2]
    Field anchor;         // [m]
  };
  virtual Step plan(double dt) const = 0;
  /// x1 is known; x0 is where the step began. Sets the velocities; books what the scheme itself
  /// has dissipated.
  virtual void finish(double dt, const Field& x0, const Field& x1, double energy0) = 0;

  /// Where the present step begins, or the next one.
  const Field& start() const { return start_; }
  const State& state() const { return state_; }
  Field& velocity() { return state_.v; }
  const Model& model() const { return model_; }
  /// Forces of the terms where the step was solved [N].
  const Field& terms_force() const { return force_; }
  /// Velocity that loads prescribe in this step, in components that they hold [m/s].
  double prescribed(Index node, int component) const {
    return prescribed_[2 * static_cast<std::size_t>(node) + component];
  }
  void book_damping(double energy) { works_.damping += energy; }
  bool held(Index node, int component) const { return solver_.free().row(node, component) < 0; }

 private:
  Field pushes() const;
  void commit_and_break();

  Model& model_;
  std::vector<Load>& loads_;
  State& state_;
  EquilibriumSolver solver_;
  double residual_;
  Field force_, start_;
  Eigen::VectorXd work_;
  std::vector<std::uint8_t> fully_held_;
  std::vector<double> prescribed_;
  std::vector<Break> breaks_;
  Works works_;
  double planned_ = 0;  // per_mass of the last step
};

}  // namespace lamella
