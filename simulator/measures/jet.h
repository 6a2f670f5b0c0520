// A number with its first and second derivatives with respect to two variables x and y: a formula written once, as a template, gives
// energy, force and stiffness. For the rare link; loops over all links use closed forms.
#pragma once
#include <cmath>

namespace lamella {

struct Jet {
  double value = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  Jet() = default;
  Jet(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): a number is a jet
  static Jet variable_x(double at) { return with_slopes(at, 1, 0); }
  static Jet variable_y(double at) { return with_slopes(at, 0, 1); }

  /// g(this), where g and its two derivatives have these values: the chain rule.
  Jet through(double g, double slope, double curvature) const {
    Jet out(g);
    out.x = slope * x, out.y = slope * y;
    out.xx = slope * xx + curvature * x * x;
    out.xy = slope * xy + curvature * x * y;
    out.yy = slope * yy + curvature * y * y;
    return out;
  }

 private:
  static Jet with_slopes(double at, double x, double y) {
    Jet out(at);
    out.x = x, out.y = y;
    return out;
  }
};

inline double value_of(double a) { return a; }
inline double value_of(const Jet& a) { return a.value; }

inline Jet operator+(const Jet& a, const Jet& b) {
  Jet out(a.value + b.value);
  out.x = a.x + b.x, out.y = a.y + b.y;
  out.xx = a.xx + b.xx, out.xy = a.xy + b.xy, out.yy = a.yy + b.yy;
  return out;
}
inline Jet operator*(const Jet& a, const Jet& b) {
  Jet out(a.value * b.value);
  out.x = a.x * b.value + a.value * b.x;
  out.y = a.y * b.value + a.value * b.y;
  out.xx = a.xx * b.value + 2 * a.x * b.x + a.value * b.xx;
  out.xy = a.xy * b.value + a.x * b.y + a.y * b.x + a.value * b.xy;
  out.yy = a.yy * b.value + 2 * a.y * b.y + a.value * b.yy;
  return out;
}
inline Jet operator-(const Jet& a, const Jet& b) { return a + Jet(-1.0) * b; }
inline Jet operator/(const Jet& a, const Jet& b) {
  const double i = 1 / b.value;
  return a * b.through(i, -i * i, 2 * i * i * i);
}
inline Jet sqrt(const Jet& a) {
  const double root = std::sqrt(a.value);
  return a.through(root, 0.5 / root, -0.25 / (root * a.value));
}
/// a^p for a >= 0. At a = 0, where a derivative may be infinite, that derivative counts as 0: what is raised here touches 0 from above.
inline Jet pow(const Jet& a, double p) {
  if (a.value > 0)
    return a.through(std::pow(a.value, p), p * std::pow(a.value, p - 1), p * (p - 1) * std::pow(a.value, p - 2));
  return a.through(p == 0 ? 1 : 0, p == 1 ? 1 : 0, p == 2 ? 2 : 0);
}

}  // namespace lamella
