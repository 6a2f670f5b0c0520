// Disks for tests: placed at random, overlapping or not, and the numbers they are made of.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "generator/packing/packing.h"

namespace lamella {

class Numbers {
 public:
  explicit Numbers(unsigned seed) : generator_(seed) {}
  double between(double lo, double hi) { return lo + (hi - lo) * static_cast<double>(generator_()) / 4294967296.0; }

 private:
  std::mt19937 generator_;
};

/// Centres anywhere in [0, width] x [0, height], radii up to `radius`: they overlap and hide each other when it is large.
inline std::vector<Disk> random_disks(int count, double radius, unsigned seed, double width = 1, double height = 1) {
  Numbers numbers(seed);
  std::vector<Disk> disks;
  for (int i = 0; i < count; ++i) {
    const double x = numbers.between(0, width), y = numbers.between(0, height);
    disks.push_back({{x, y}, numbers.between(0, radius)});
  }
  return disks;
}

/// Disks that do not overlap, in the unit square or, periodic, on the torus of its size: lognormal radii of this coefficient of
/// variation that cover `fraction` of it (half of it is easy), largest first, each where the first free place is drawn.
inline std::vector<Disk> apart_disks(int count, double variation, double fraction, bool periodic, unsigned seed) {
  Numbers numbers(seed);
  const double sigma = std::sqrt(std::log(1 + variation * variation));
  std::vector<double> radii(count);
  double area = 0;
  for (double& r : radii) {
    const double u = numbers.between(1e-12, 1), v = numbers.between(0, 1);
    r = std::exp(sigma * std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v));
    area += std::numbers::pi * r * r;
  }
  for (double& r : radii) r *= std::sqrt(fraction / area);
  std::sort(radii.begin(), radii.end(), std::greater<>());

  // One grid for each factor 2 of radii; cells are as wide as its largest disks.
  struct Grid {
    int cells;
    std::vector<int> head;
  };
  std::vector<Grid> grids;
  std::vector<int> next(count, -1);
  std::vector<Disk> disks;
  const auto grid_of = [&](double r) {
    const auto level = static_cast<std::size_t>(std::max(0.0, std::floor(std::log2(radii.front() / r))));
    for (std::size_t k = grids.size(); k <= level; ++k) {
      const double width = std::max(2 * radii.front() * std::exp2(-static_cast<double>(k)), 0.7 / std::sqrt(count));
      const int cells = std::max(1, static_cast<int>(1 / width));
      grids.push_back({cells, std::vector<int>(static_cast<std::size_t>(cells) * cells, -1)});
    }
    return level;
  };
  const auto free = [&](const Disk& disk, std::size_t level) {
    for (std::size_t k = 0; k <= level; ++k) {
      const Grid& grid = grids[k];
      const int cx = std::min(grid.cells - 1, static_cast<int>(disk.centre.x() * grid.cells)),
                cy = std::min(grid.cells - 1, static_cast<int>(disk.centre.y() * grid.cells));
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = (cx + dx + grid.cells) % grid.cells, y = (cy + dy + grid.cells) % grid.cells;
          for (int j = grid.head[static_cast<std::size_t>(y) * grid.cells + x]; j >= 0; j = next[j]) {
            Vec2 way = disks[j].centre - disk.centre;
            if (periodic) way -= Vec2(std::round(way.x()), std::round(way.y()));
            const double reach = disk.radius + disks[j].radius;
            if (way.squaredNorm() < reach * reach) return false;
          }
        }
    }
    return true;
  };
  for (const double r : radii) {
    const std::size_t level = grid_of(r);
    const double margin = periodic ? 0 : r;
    Disk disk{{0, 0}, r};
    do {
      const double x = numbers.between(margin, 1 - margin), y = numbers.between(margin, 1 - margin);
      disk.centre = {x, y};
    } while (!free(disk, level));
    Grid& grid = grids[level];
    const int cx = std::min(grid.cells - 1, static_cast<int>(disk.centre.x() * grid.cells)),
              cy = std::min(grid.cells - 1, static_cast<int>(disk.centre.y() * grid.cells));
    int& head = grid.head[static_cast<std::size_t>(cy) * grid.cells + cx];
    next[disks.size()] = head;
    head = static_cast<int>(disks.size());
    disks.push_back(disk);
  }
  std::shuffle(disks.begin(), disks.end(), std::mt19937(seed));
  return disks;
}

}  // namespace lamella
