#include "generator/packing/random_sites.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "generator/packing/domain.h"
#include "generator/packing/random.h"
#include "generator/sample/errors.h"

namespace lamella {

void scatter(Packing& packing, std::uint64_t seed, const Domain* domain) {
  Random random(seed);
  const auto place = [&] {
    const Vec2 at(random.unit(), random.unit());
    return Vec2(packing.box.lo + at.cwiseProduct(packing.box.size()));
  };
  for (Disk& disk : packing.disks) {
    disk.centre = place();
    // A domain that fills next to nothing of its box is refused by its tiles; here it only must not take for ever.
    for (int trial = 0; domain && !domain->contains(disk.centre); ++trial) {
      if (trial == 1000000)
        throw SceneError("sample.domain: fills less than a millionth of the box around it; make it wider");
      disk.centre = place();
    }
  }
  packing.notes.push_back(
      fmt::format("{} sites at random, disks only say how large cells shall be", packing.disks.size()));
}

Packing scattered(const PackingScene& scene, const std::vector<double>& radii, const PackingSpace& space,
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
  double room = 0;
  if (space.domain) {
    packing.box = space.domain->box;
    room = space.domain->area;
  } else {
    packing.box.hi = {space.width, space.height};
    if (space.width == 0) packing.box.hi.x() = space.height > 0 ? area / space.height : std::sqrt(area);
    if (space.height == 0) packing.box.hi.y() = area / packing.box.hi.x();
    room = packing.box.area();
  }
  const double scale = std::sqrt(room / area);  // 1 unless the box is given
  for (Disk& disk : packing.disks) disk.radius *= scale;
  packing.fraction = area_fraction(packing.disks, packing.box) * packing.box.area() / room;
  scatter(packing, seed, space.domain);
  return packing;
}

}  // namespace lamella
