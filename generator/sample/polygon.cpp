#include "generator/sample/polygon.h"

#include <algorithm>

namespace lamella {

double polygon_area(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    twice += cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  return twice / 2;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

bool is_inside(const std::vector<Vec2>& polygon, const Vec2& p) {
  bool odd = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    // Right of p: p is left of the edge taken upwards.
    const bool up = b.y() > a.y();
    if ((cross(b - a, p - a) > 0) == up) odd = !odd;
  }
  return odd;
}

}  // namespace lamella
