#include "pipelines/ring_between_plates/elastica.h"

#include <cmath>
#include <numbers>

namespace lamella {
namespace {

/// A quarter of the ring, from under the plate (theta = 0, theta the angle of the tangent to the plate) to the side (pi / 2).
///
/// The section's force is F / 2 across the plates: axial force N = -F/2 sin(theta), stretch lambda = 1 + N / EA. Moments change
/// by dM/ds = lambda F/2 cos(theta), s along the unstretched wall, and M = EI (kappa - 1/R) with kappa = d(theta)/ds, so
///   kappa^2 = top^2 + F sin(theta) - F^2 sin(theta)^2 / (4 S),      dx = lambda cos(theta) ds,   dy = lambda sin(theta) ds.
/// While the plates touch a point, top > 0; beyond, top = 0, and the rest of the quarter lies flat, free of axial force.
struct Quarter {
  double length = 0;         // of the curved part, unstretched
  double x = 0, height = 0;  // of its end
  double area = 0;           // between it and the line across the plates, over the flat part not counted
  double bending = 0, stretching = 0;
  std::vector<Vec2> points;  // right of and below its beginning
};

Quarter quarter(double force, double top, double axial) {
  // theta = pi/2 t^2: 1 / kappa grows as theta^(-1/2) where top = 0. Midpoint rule, second order.
  constexpr int kPoints = 1000;
  Quarter q;
  for (int k = 0; k < kPoints; ++k) {
    const double t = (k + 0.5) / kPoints;
    const double theta = std::numbers::pi / 2 * t * t;
    const double sine = std::sin(theta);
    const double kappa = std::sqrt(top * top + force * sine - force * force * sine * sine / (4 * axial));
    const double ds = std::numbers::pi * t / kPoints / kappa;
    const double stretch = 1 - force * sine / (2 * axial);
    const double dx = stretch * std::cos(theta) * ds, dy = stretch * sine * ds;
    q.length += ds;
    q.area += (q.x + dx / 2) * dy;
    q.x += dx;
    q.height += dy;
    if (k % (kPoints / 50) == 0) q.points.emplace_back(q.x, -q.height);
    q.bending += (kappa - 1) * (kappa - 1) / 2 * ds;
    q.stretching += force * force * sine * sine / (8 * axial) * ds;
  }
  return q;
}

/// Zero of a growing function in [low, high], by false position; an end that stays has its value halved (Illinois).
template <typename Function>
double zero(double low, double high, const Function& f) {
  double at_low = f(low), at_high = f(high);
  double middle = low;
  for (int k = 0, stayed = 0; k < 60 && high - low > 1e-14 * std::abs(high); ++k) {
    middle = (low * at_high - high * at_low) / (at_high - at_low);
    const double value = f(middle);
    if (std::abs(value) < 1e-13) break;
    if (value < 0) {
      low = middle, at_low = value;
      if (stayed == 1) at_high /= 2;
      stayed = 1;
    } else {
      high = middle, at_high = value;
      if (stayed == 2) at_low /= 2;
      stayed = 2;
    }
  }
  return middle;
}

/// Force at which the whole quarter is curved, with that curvature at its top. At top = 1 it is 0.
double force_of(double top, double axial) {
  return zero(0, 3, [&](double force) { return 1 / quarter(force, top, axial).length - 2 / std::numbers::pi; });
}

}  // namespace

double contact_onset(double axial) { return 1 - quarter(force_of(0, axial), 0, axial).height; }

Elastica elastica(double strain, double axial) {
  const double first = force_of(0, axial);
  const bool flat = strain > 1 - quarter(first, 0, axial).height;
  const auto too_high = [&](const Quarter& q) { return q.height - (1 - strain); };
  double top = 0, force = 0;
  if (flat) {
    force = zero(first, 600, [&](double f) { return -too_high(quarter(f, 0, axial)); });
  } else {
    top = zero(0, 1, [&](double k) { return too_high(quarter(force_of(k, axial), k, axial)); });
    force = force_of(top, axial);
  }
  const Quarter q = quarter(force, top, axial);
  const double half = flat ? std::numbers::pi / 2 - q.length : 0;  // of the flat part
  Elastica e;
  e.strain = strain;
  e.force = force;
  e.contact_length = half;
  e.width = q.x + half;
  e.area = 4 * (q.area + half * q.height) / std::numbers::pi;
  e.bending = 4 * (q.bending + half / 2);
  e.stretching = 4 * q.stretching;
  e.top = top;
  e.side = std::sqrt(top * top + force - force * force / (4 * axial));
  e.outline.emplace_back(0, q.height);
  for (const Vec2& point : q.points) e.outline.push_back(point + Vec2(half, q.height));
  e.outline.emplace_back(q.x + half, 0);
  return e;
}

}  // namespace lamella
