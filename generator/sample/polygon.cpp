#include "generator/sample/polygon.h"

#include <algorithm>
#include <utility>

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
    const Vec2 *low = &polygon[k], *high = &polygon[(k + 1) % polygon.size()];
    if ((low->y() > p.y()) == (high->y() > p.y())) continue;
    // Always upwards, so that of two polygons with a common edge the same one has a point on it.
    if (low->y() > high->y()) std::swap(low, high);
    if (cross(*high - *low, p - *low) > 0) odd = !odd;  // the edge passes on the right of p
  }
  return odd;
}

}  // namespace lamella
