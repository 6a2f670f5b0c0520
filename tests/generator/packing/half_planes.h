// Oracle for diagrams: the tile of a site as what the half-planes of all other sites, and of all their images, leave.
#pragma once
#include <cmath>
#include <vector>

#include "generator/packing/packing.h"

namespace lamella {

/// The part of a convex polygon where d . p <= limit.
inline std::vector<Vec2> cut_off(const std::vector<Vec2>& polygon, const Vec2& d, double limit) {
  std::vector<Vec2> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 p = polygon[k], q = polygon[(k + 1) % polygon.size()];
    const double sp = d.dot(p) - limit, sq = d.dot(q) - limit;
    if (sp <= 0) kept.push_back(p);
    if ((sp < 0 && sq > 0) || (sp > 0 && sq < 0)) kept.push_back(p + (q - p) * (sp / (sp - sq)));
  }
  return kept;
}

/// In coordinates about the site. Along periodic axes images displaced by up to two lengths take part, the site's own too.
inline std::vector<Vec2> half_plane_tile(const std::vector<Disk>& disks, const Box& box, const Periodic& periodic,
                                         std::size_t i) {
  const Vec2 o = disks[i].centre, size = box.size();
  Vec2 lo = box.lo - o, hi = box.hi - o;
  for (const int axis : {0, 1})
    if (periodic[axis]) lo[axis] = -size[axis], hi[axis] = size[axis];
  std::vector<Vec2> polygon = {lo, Vec2(hi.x(), lo.y()), hi, Vec2(lo.x(), hi.y())};
  const double own = disks[i].radius * disks[i].radius;
  const int columns = periodic[0] ? 2 : 0, rows = periodic[1] ? 2 : 0;
  double extent = 2 * (size.x() + size.y());  // of the polygon: no corner is further from the site
  for (int row = -rows; row <= rows; ++row) {
    for (int column = -columns; column <= columns; ++column) {
      for (std::size_t j = 0; j < disks.size() && !polygon.empty(); ++j) {
        if (j == i && row == 0 && column == 0) continue;
        const Vec2 d = disks[j].centre - o + Vec2(column * size.x(), row * size.y());
        const double weight = disks[j].radius * disks[j].radius - own;
        const double distance = d.norm();
        // Where |p| <= R the other power is the smaller one nowhere.
        if (distance > extent && (distance - extent) * (distance - extent) > extent * extent + weight) continue;
        polygon = cut_off(polygon, d, (distance * distance - weight) / 2);
        extent = 0;
        for (const Vec2& p : polygon) extent = std::max(extent, p.norm());
      }
    }
  }
  return polygon;
}

inline double polygon_area(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    twice += cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  return twice / 2;
}

}  // namespace lamella
