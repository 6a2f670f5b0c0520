#include "simulator/load_path.h"

#include <algorithm>
#include <cmath>

namespace lamella {

LoadPath::LoadPath(const Stage& stage, const Gauge& gauge) : gauge_(gauge) {
  if (stage.loading) {
    loading_ = &*stage.loading;
    turn_ = loading_->strain * gauge.length / std::abs(gauge.speed);
    duration_ = loading_->unload ? 2 * turn_ : turn_;
  }
  if (stage.stop.time) duration_ = loading_ ? std::min(duration_, *stage.stop.time) : *stage.stop.time;
}

double LoadPath::strain(double time) const {
  if (!loading_) return 0;
  const double up = std::min(time, turn_), down = loading_->unload ? std::clamp(time - turn_, 0.0, turn_) : 0.0;
  return (up - down) * gauge_.speed / gauge_.length;
}

// The velocity of a load with a ramp r grows as smooth_ramp(t / r) = u^2 (3 - 2 u), whose integral is r (u^3 - u^4 / 2).
Vec2 LoadPath::way(const Load& load, double time) const {
  if (load.grip) return load.velocity * (strain(time) * gauge_.length / gauge_.speed);
  if (!(load.ramp > 0)) return load.velocity * time;
  const double u = std::min(1.0, time / load.ramp);
  return load.velocity * (load.ramp * (u * u * u - 0.5 * u * u * u * u) + std::max(0.0, time - load.ramp));
}

double LoadPath::force_factor(const Load& load, double time) const {
  return load.ramp > 0 ? smooth_ramp(time / load.ramp) : 1.0;
}

}  // namespace lamella
