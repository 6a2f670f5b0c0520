// That tiles are those of their sites: what every wall of a power diagram has in common.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/packing/laguerre.h"

namespace lamella {
namespace {

constexpr std::size_t kMost = 20;  // faults that are listed

/// Calls `wall(tile, k, d)` for the k-th edge of every tile that borders another; d: from its site to the other one [m].
template <class Visit>
void for_walls(const Tessellation& t, const std::vector<Vec2>& centres, const Visit& wall) {
  for (const Tile& tile : t.tiles)
    for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
      if (tile.neighbour[k] < 0) continue;
      Vec2 d = centres[tile.neighbour[k]] - centres[tile.site];
      if (!tile.across.empty()) d += displacement(tile.across[k], t.box);
      wall(tile, k, d);
    }
}

}  // namespace

std::vector<std::string> check_powers(const Tessellation& t, const std::vector<Vec2>& centres,
                                      const std::vector<double>& weights) {
  std::vector<std::string> faults;
  const double size = t.box.size().maxCoeff(), cell = t.box.area() / static_cast<double>(t.tiles.size());
  for_walls(t, centres, [&](const Tile& tile, std::size_t k, const Vec2& d) {
    const Index i = tile.site, j = tile.neighbour[k];
    // Rounding: of the power itself, and of coordinates as large as the box.
    const double tolerance = 1e-12 * (cell + std::abs(weights[i]) + std::abs(weights[j])) + 1e-14 * size * d.norm();
    for (const std::size_t end : {k, (k + 1) % tile.vertex.size()}) {
      const Vec2 a = corner(t, tile, end) - centres[i];
      const double difference = 2 * a.dot(d) - d.squaredNorm() - weights[i] + weights[j];
      if (!(std::abs(difference) <= tolerance) && faults.size() < kMost)
        faults.push_back(
            fmt::format("tiles {} and {}: their powers differ by {:g} m2 on their wall", i, j, difference));
    }
  });
  return faults;
}

std::vector<std::string> check_disks(const Tessellation& t, const std::vector<Disk>& disks) {
  std::vector<Vec2> centres;
  std::vector<double> weights;
  for (const Disk& disk : disks) {
    centres.push_back(disk.centre);
    weights.push_back(disk.radius * disk.radius);
  }
  std::vector<std::string> faults = check_powers(t, centres, weights);
  const double size = t.box.size().maxCoeff();
  for_walls(t, centres, [&](const Tile& tile, std::size_t k, const Vec2& d) {
    const double radius = disks[tile.site].radius, distance = d.norm();
    if (radius + disks[tile.neighbour[k]].radius > distance) return;  // they overlap
    for (const std::size_t end : {k, (k + 1) % tile.vertex.size()}) {
      const double room = (corner(t, tile, end) - centres[tile.site]).dot(d) / distance;
      if (!(room >= radius * (1 - 1e-9) - 1e-14 * size) && faults.size() < kMost)
        faults.push_back(fmt::format("disk {}: reaches {:g} m beyond its tile's wall to {}", tile.site, radius - room,
                                     tile.neighbour[k]));
    }
  });
  return faults;
}

}  // namespace lamella
