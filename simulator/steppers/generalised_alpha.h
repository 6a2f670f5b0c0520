// Generalised alpha (Chung and Hulbert, J. Appl. Mech. 60 (1993) 371): second order, with as much dissipation of what the step cannot follow as
// the spectral radius rho at infinite frequency says: 1 none, 0 all of it in one step. With s = 1 - alpha_f the unknown is y = x0 + s (x1 - x0):
//   M ((1 - alpha_m) a1 + alpha_m a0) + gamma M (s v1 + (1 - s) v0) = f(y),
//   x1 = x0 + dt v0 + dt^2 ((1/2 - beta) a0 + beta a1),   v1 = v0 + dt ((1 - g) a0 + g a1),
//   alpha_m = (2 rho - 1) / (rho + 1), alpha_f = rho / (rho + 1), g = 1/2 - alpha_m + alpha_f, beta = (1 - alpha_m + alpha_f)^2 / 4.
// What it dissipates by itself has no closed form: the ledger's residual shows it.
#pragma once
#include "simulator/steppers/implicit.h"

namespace lamella {

class GeneralisedAlpha final : public ImplicitStepper {
 public:
  GeneralisedAlpha(Model& model, std::vector<Load>& loads, State& state, double residual, double spectral_radius);
  double push_time() const override { return 1 - alpha_f_; }
  void save(ArraySet& restart) const override;
  void restore(const ArraySet& restart) override;

 private:
  Step plan(double dt) const override;
  void finish(double dt, const Field& x0, const Field& x1, double energy0) override;
  Field acceleration_at_start() const;
  /// a1 = (x1 - x0) / (beta dt^2) + c.
  Vec2 from_start(std::size_t node, double dt) const;

  double alpha_m_, alpha_f_, gamma_, beta_;
  Field a_;  // at the end of the last step [m/s2]; 0 where held
};

}  // namespace lamella
