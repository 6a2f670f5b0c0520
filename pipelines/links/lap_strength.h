// What a lap joint of two chains of bars holds.
#pragma once
#include <cmath>

namespace lamella {

/// T_c / f_t0 of n tangential links, ratio = k_t / k_s: 2 cosh(mu) = 2 + 2 ratio.
inline double lap_strength(int n, double ratio) {
  const double mu = std::acosh(1 + ratio);
  return std::sinh(n * mu / 2) / (std::sinh(mu / 2) * std::cosh(mu * (n - 1) / 2));
}

}  // namespace lamella
