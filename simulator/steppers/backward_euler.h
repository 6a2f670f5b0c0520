// Backward Euler: m (v1 - v0) / dt = f(x1) - gamma m v1, x1 = x0 + dt v1. First order; whatever swings faster than the step is
// damped away, which suits the way to rest. What it dissipates is booked as damping: 1/2 m (v1 - v0)^2 and W(x0) - W(x1) - f(x1) . (x1 - x0).
#pragma once
#include "simulator/steppers/implicit.h"

namespace lamella {

class BackwardEuler final : public ImplicitStepper {
 public:
  using ImplicitStepper::ImplicitStepper;
  double push_time() const override { return 1; }

 private:
  Step plan(double dt) const override;
  void finish(double dt, const Field& x0, const Field& x1, double energy0) override;
};

}  // namespace lamella
