#include "simulator/loading.h"

#include <algorithm>
#include <cmath>

namespace lamella {

LoadingCourse::LoadingCourse(const LoadingScene& scene, const Gauge& gauge) : scene_(scene), gauge_(gauge) {
  target_ = scene_.step > 0 ? std::min(scene_.step, scene_.strain) : scene_.strain;
}

// The rate grows as smooth_ramp, whose mean is 1/2: full after twice the time that the ramp's strain takes at full rate.
double LoadingCourse::ramp_time() const { return 2 * scene_.ramp_strain * gauge_.length / std::abs(gauge_.speed); }

double LoadingCourse::duration() const {
  const double once = (scene_.strain + scene_.ramp_strain) * gauge_.length / std::abs(gauge_.speed);
  return scene_.unload ? 2 * once : once;
}

double LoadingCourse::advance(double time, double dt) {
  if (phase_ == Phase::kDone || phase_ == Phase::kHold) return 0;
  const double ramp = ramp_time(), direction = phase_ == Phase::kUnload ? -1 : 1;
  double factor = ramp > 0 ? smooth_ramp((time + 0.5 * dt - phase_start_) / ramp) : 1.0;
  const double reach = std::abs(opening_) / gauge_.length;
  const double left =
      (phase_ == Phase::kUnload ? reach : target_ - reach) * gauge_.length / (std::abs(gauge_.speed) * dt);
  const bool arrives = factor >= left;
  factor = direction * std::min(factor, std::max(0.0, left));
  opening_ += factor * gauge_.speed * dt;
  if (arrives) {
    phase_start_ = time + dt;
    if (phase_ == Phase::kUnload) {
      phase_ = Phase::kDone;
    } else {
      const bool last = target_ >= scene_.strain * (1 - 1e-12);
      const Phase next = !last ? Phase::kLoad : scene_.unload ? Phase::kUnload : Phase::kDone;
      target_ = last ? target_ : std::min(scene_.strain, target_ + scene_.step);
      after_hold_ = next;
      phase_ = scene_.step > 0 ? Phase::kHold : next;
    }
  }
  return factor;
}

void LoadingCourse::report_unbalanced(double unbalanced, double time) {
  if (phase_ != Phase::kHold || unbalanced > scene_.rest_tolerance) return;
  phase_ = after_hold_;
  phase_start_ = time;
}

std::vector<double> LoadingCourse::save() const {
  return {static_cast<double>(phase_), static_cast<double>(after_hold_), phase_start_, opening_, target_};
}

void LoadingCourse::restore(const std::vector<double>& s) {
  phase_ = static_cast<Phase>(static_cast<int>(s.at(0)));
  after_hold_ = static_cast<Phase>(static_cast<int>(s.at(1)));
  phase_start_ = s.at(2), opening_ = s.at(3), target_ = s.at(4);
}

}  // namespace lamella
