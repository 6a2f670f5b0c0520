// The cohesive link's law: linear until the yield function reaches zero, then nothing (seeds: Eq. 39, opening positive).
#pragma once
#include <algorithm>
#include <cmath>

namespace lamella {

/// zeta = f_n / f_n0 + |f_t / f_t0|^alpha - 1. Below 0 the link holds; at 0 it breaks. Strengths in [N]; alpha >= 1.
inline double yield_function(double f_n, double f_t, double strength_n, double strength_t, double alpha) {
  const double shear = std::abs(f_t / strength_t);
  return f_n / strength_n + (alpha == 2 ? shear * shear : std::pow(shear, alpha)) - 1;
}

/// Mode mix of a break [rad]: 0 pure opening, pi/2 pure shear, beyond it shear under compression.
inline double mode_mix(double f_n, double f_t, double strength_n, double strength_t) {
  return std::atan2(std::abs(f_t) / strength_t, f_n / strength_n);
}

}  // namespace lamella
