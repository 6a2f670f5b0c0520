#include "generator/packing/random_sites.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "generator/packing/random.h"
#include "generator/sample/errors.h"

namespace lamella {

void scatter(Packing& packing, std::uint64_t seed) {
  Random random(seed);
  for (Disk& disk : packing.disks)
    for (const int axis : {0, 1}) disk.centre[axis] = packing.box.lo[axis] + random.unit() * packing.box.size()[axis];
  packing.notes.push_back(
      fmt::format("{} sites at random, disks only say how large cells shall be", packing.disks.size()));
}

Packing scattered(const PackingScene& scene, const std::vector<double>& radii, double width, double height,
                  std::uint64_t seed) {
  Packing packing;
  for (const double radius : radii) {
    if (!(radius > 0) || !std::isfinite(radius))
      throw SceneError(fmt::format("sample.sizes: a radius of {}: must be positive and finite", radius));
    packing.disks.push_back({Vec2::Zero(), radius});
  }
  if (packing.disks.empty()) throw SceneError("sample.packing.count = 0: must be at least 1");
  if (!(scene.fraction > 0)) throw SceneError("sample.packing.fraction: must be positive");
  double area = 0;
  for (const double radius : radii) area += std::numbers::pi * radius * radius / scene.fraction;
  packing.box.hi = {width, height};
  if (width == 0) packing.box.hi.x() = height > 0 ? area / height : std::sqrt(area);
  if (height == 0) packing.box.hi.y() = area / packing.box.hi.x();
  const double scale = std::sqrt(packing.box.area() / area);  // 1 unless the box is given
  for (Disk& disk : packing.disks) disk.radius *= scale;
  packing.fraction = area_fraction(packing.disks, packing.box);
  scatter(packing, seed);
  return packing;
}

}  // namespace lamella
