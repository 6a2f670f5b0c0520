// Elastic, perfectly plastic: the return mapping of bars and hinges (physics: M <- clamp(M_trial, -M_Y, M_Y)).
#pragma once
#include <algorithm>
#include <cmath>

namespace lamella {

/// Force or moment for the elastic trial value.
inline double returned(double trial, double yield) { return std::min(std::max(trial, -yield), yield); }

/// Incremental potential of an element of stiffness k whose trial force is `trial`: stored plus what flowing there from the last
/// commit dissipates. Its derivative with respect to the elongation is `returned(trial, yield)`.
inline double incremental_potential(double trial, double yield, double k) {
  if (k == 0) return 0;
  const double t = std::abs(trial);
  return t <= yield ? 0.5 * t * t / k : 0.5 * yield * yield / k + yield * (t - yield) / k;
}

}  // namespace lamella
