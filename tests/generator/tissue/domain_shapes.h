// Domains for the tests of clipped tissues, and disks in them.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "generator/tissue/mosaic.h"
#include "generator/tissue/overlay.h"
#include "tests/generator/packing/random_disks.h"

namespace lamella {

inline std::vector<Vec2> circle(const Vec2& centre, double radius, int sides, double turn = 0) {
  std::vector<Vec2> points;
  for (int k = 0; k < sides; ++k) {
    const double angle = turn + 2 * std::numbers::pi * k / sides;
    points.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

/// Counter-clockwise outlines become holes.
inline std::vector<Vec2> hole(std::vector<Vec2> points) {
  std::reverse(points.begin(), points.end());
  return points;
}

/// All within the unit square or near it.
inline Loops domain_of(const std::string& shape) {
  if (shape == "disk") return {circle({0.5, 0.5}, 0.5, 96)};
  if (shape == "ring") return {circle({0.5, 0.5}, 0.5, 96), hole(circle({0.5, 0.5}, 0.2, 60, 0.01))};
  if (shape == "L") return {{{0, 0}, {1, 0}, {1, 0.35}, {0.4, 0.35}, {0.4, 1}, {0, 1}}};
  if (shape == "star") {
    std::vector<Vec2> points;
    for (int k = 0; k < 10; ++k) points.push_back(circle({0.5, 0.5}, k % 2 == 0 ? 0.5 : 0.2, 10)[k]);
    return {points};
  }
  if (shape == "two holes")
    return {{{0, 0}, {1.1, 0.1}, {1, 0.9}, {0.5, 0.7}, {0.1, 1}},
            hole({{0.2, 0.2}, {0.5, 0.25}, {0.3, 0.5}}),
            hole(circle({0.75, 0.45}, 0.15, 24))};
  return {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
}

inline bool is_inside(const Loops& loops, const Vec2& p) {
  bool inside = false;
  for (const auto& loop : loops) inside = inside != lamella::is_inside(loop, p);
  return inside;
}

inline double area_of(const Loops& loops) {
  double sum = 0;
  for (const auto& loop : loops) sum += polygon_area(loop.data(), static_cast<Index>(loop.size()));
  return sum;
}

/// Centres in the domain, radii up to `radius`.
inline std::vector<Disk> disks_in(const Loops& loops, int count, double radius, unsigned seed) {
  Numbers numbers(seed);
  std::vector<Disk> disks;
  while (static_cast<int>(disks.size()) < count) {
    const double x = numbers.between(-0.1, 1.2), y = numbers.between(-0.1, 1.2);
    if (is_inside(loops, {x, y})) disks.push_back({{x, y}, numbers.between(0, radius)});
  }
  return disks;
}

inline double power(const Disk& disk, const Vec2& p) {
  return (p - disk.centre).squaredNorm() - disk.radius * disk.radius;
}

/// Site of least power, and how much more the next one has.
inline std::pair<Index, double> nearest_site(const std::vector<Disk>& disks, const Vec2& p) {
  Index best = -1;
  double least = 1e300, second = 1e300;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const double here = power(disks[i], p);
    if (here < least) {
      second = least;
      least = here;
      best = static_cast<Index>(i);
    } else {
      second = std::min(second, here);
    }
  }
  return {best, second - least};
}

}  // namespace lamella
