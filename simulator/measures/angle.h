// Angles, branch-free so that loops over hinges vectorise (the C library's atan2 does not).
#pragma once
#include <cmath>
#include <numbers>

namespace lamella {

/// arctan of u for |u| <= tan(pi/8). The polynomial is the Chebyshev fit of arctan(sqrt s) / sqrt s on [0, tan(pi/8)^2] with
/// 12 coefficients, whose error, 1.3e-18, is below rounding.
inline double arctan_small(double u) {
  const double s = u * u;
  double p = -0.017805382196606493;
  p = p * s + 0.03796524391097195;
  p = p * s - 0.05035101930016078;
  p = p * s + 0.05846878181892052;
  p = p * s - 0.06662951797955637;
  p = p * s + 0.07692045329539092;
  p = p * s - 0.09090896808988135;
  p = p * s + 0.11111110744917034;
  p = p * s - 0.14285714279250192;
  p = p * s + 0.1999999999994089;
  p = p * s - 0.3333333333333312;
  p = p * s + 1.0;
  return u * p;
}

/// Angle of (x, y) in (-pi, pi]; 0 for the null vector. Within 4e-16 of std::atan2 for |angle| <= pi/4, 9e-16 elsewhere.
inline double angle_of(double y, double x) {
  constexpr double pi = std::numbers::pi;
  const double ax = std::abs(x), ay = std::abs(y);
  const double large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
  // first octant, then halved once more: arctan(a) = pi/4 + arctan((a - 1) / (a + 1))
  const bool upper = small > 0.41421356237309503 * large;
  const double top = upper ? small - large : small;
  const double bottom = (upper ? small + large : large) + 1e-300;
  double angle = arctan_small(top / bottom) + (upper ? pi / 4 : 0.0);
  angle = ay > ax ? pi / 2 - angle : angle;
  angle = x < 0 ? pi - angle : angle;
  return y < 0 ? -angle : angle;
}

/// The angle equal to `angle` up to full turns that is nearest to `last`: turning angles followed in time have no jump.
inline double unwrapped(double angle, double last) {
  constexpr double turn = 2 * std::numbers::pi;
  // Adding and subtracting 1.5 * 2^52 rounds to the nearest integer in two additions, and vectorises everywhere.
  constexpr double magic = 6755399441055744.0;
  const double turns = ((last - angle) * (1 / turn) + magic) - magic;
  return angle + turn * turns;
}

}  // namespace lamella
