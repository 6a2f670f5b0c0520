// Oracle for diagrams: the tile of a site as what the half-planes of all other sites, and of all their images, leave.
#pragma once
#include <algorithm>
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

/// In coordinates about the site. Along periodic axes images displaced by up to two lengths take part, the site's own too,
/// the nearest first: what they leave is soon so small that far ones need not be cut by.
inline std::vector<Vec2> half_plane_tile(const std::vector<Disk>& disks, const Box& box, const Periodic& periodic,
                                         std::size_t i) {
  const Vec2 o = disks[i].centre, size = box.size();
  Vec2 lo = box.lo - o, hi = box.hi - o;
  for (const int axis : {0, 1})
    if (periodic[axis]) lo[axis] = -size[axis], hi[axis] = size[axis];
  std::vector<Vec2> polygon = {lo, Vec2(hi.x(), lo.y()), hi, Vec2(lo.x(), hi.y())};
  const double own = disks[i].radius * disks[i].radius;
  double largest = 0;
  Box all{o, o};
  for (const Disk& disk : disks) {
    largest = std::max(largest, disk.radius * disk.radius);
    all = {all.lo.cwiseMin(disk.centre), all.hi.cwiseMax(disk.centre)};
  }
  // Beyond this distance the power of no disk is the smaller one anywhere in the polygon, where |p| <= extent.
  const auto reach_of = [&](double extent) {
    return (1 + 1e-9) * (extent + std::sqrt(std::max(0.0, extent * extent + largest - own)));
  };
  double reach = reach_of(2 * (size.x() + size.y()));
  std::vector<Vec2> images;
  for (int row = periodic[1] ? -2 : 0; row <= (periodic[1] ? 2 : 0); ++row)
    for (int column = periodic[0] ? -2 : 0; column <= (periodic[0] ? 2 : 0); ++column)
      images.emplace_back(column * size.x(), row * size.y());
  std::stable_sort(images.begin(), images.end(), [](const Vec2& a, const Vec2& b) { return a.norm() < b.norm(); });
  for (const Vec2& image : images) {
    const Vec2 beside = (all.lo + image - o).cwiseMax(o - all.hi - image).cwiseMax(0.0);
    if (beside.norm() > reach) continue;  // the image of all disks
    for (std::size_t j = 0; j < disks.size() && !polygon.empty(); ++j) {
      if (j == i && image.isZero()) continue;
      const Vec2 d = disks[j].centre - o + image;
      if (d.squaredNorm() > reach * reach) continue;
      polygon = cut_off(polygon, d, (d.squaredNorm() + own - disks[j].radius * disks[j].radius) / 2);
      double extent = 0;
      for (const Vec2& p : polygon) extent = std::max(extent, p.norm());
      reach = reach_of(extent);
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
