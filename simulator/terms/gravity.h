// Gravity: W = -sum m g . x. A constant force, without stiffness.
#pragma once
#include "simulator/terms/term.h"

namespace lamella {

class Gravity final : public Term {
 public:
  Gravity(const std::vector<double>& mass, const Vec2& acceleration) : mass_(mass), g_(acceleration) {}

  std::string name() const override { return "gravity"; }
  double energy(const Field& x) const override {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum -= mass_[i] * g_.dot(x.at(i));
    return sum;
  }
  void add_force(const Field&, Field& f) const override { add_force_to(0, static_cast<Index>(mass_.size()), f); }
  void add_force_to(Index begin, Index end, Field& f) const {
    for (Index i = begin; i < end; ++i) f.x[i] += mass_[i] * g_.x(), f.y[i] += mass_[i] * g_.y();
  }
  void add_stiffness(const Field&, StiffnessSink&) const override {}

 private:
  const std::vector<double>& mass_;  // of the nodes [kg], the model's
  Vec2 g_;                           // [m/s2]
};

}  // namespace lamella
