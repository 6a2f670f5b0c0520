#include "generator/packing/stretch.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "generator/sample/errors.h"

namespace lamella {

Eigen::Matrix2d stretch_map(const StretchScene& stretch) {
  if (!(stretch.ratio > 0) || !std::isfinite(stretch.ratio) || !std::isfinite(stretch.angle))
    throw SceneError(fmt::format("sample.stretch: ratio = {:g}, angle = {:g}: the ratio must be positive, both finite",
                                 stretch.ratio, stretch.angle));
  const double c = std::cos(stretch.angle), s = std::sin(stretch.angle), longer = std::sqrt(stretch.ratio);
  Eigen::Matrix2d turn;
  turn << c, -s, s, c;
  return turn * Eigen::Vector2d(longer, 1 / longer).asDiagonal() * turn.transpose();
}

Vec2 stretch_of_axes(const StretchScene& stretch) {
  const Eigen::Matrix2d map = stretch_map(stretch);
  if (!(std::abs(map(0, 1)) <= 1e-8 * std::min(map(0, 0), map(1, 1))))
    throw SceneError(
        fmt::format("sample.stretch.angle = {:g}: a sample that repeats is stretched along x or y", stretch.angle));
  return {map(0, 0), 1 / map(0, 0)};
}

DomainScene squeezed(const Domain& domain, const Eigen::Matrix2d& map) {
  const Eigen::Matrix2d back = map.inverse();
  DomainScene scene;
  scene.kind = "polygon";
  for (std::size_t l = 0; l < domain.loops.size(); ++l) {
    std::vector<Vec2> points;
    for (const Vec2& p : domain.loops[l]) points.push_back(back * p);
    if (l == 0)
      scene.points = points;
    else
      scene.holes.push_back({points, Vec2::Zero(), {}});
  }
  return scene;
}

DomainScene as_domain(const Box& box) {
  DomainScene scene;
  scene.kind = "polygon";
  scene.points = {box.lo, {box.hi.x(), box.lo.y()}, box.hi, {box.lo.x(), box.hi.y()}};
  return scene;
}

}  // namespace lamella
