// Lines between corners of pixels.
#pragma once
#include <cmath>
#include <vector>

#include "generator/image/boundaries.h"

namespace lamella {

/// Twice the area of (a, b, c), exact; y counts downwards, so it is negative when they turn left to the eye.
inline std::int64_t turn(const Lattice& a, const Lattice& b, const Lattice& c) {
  return static_cast<std::int64_t>(b.x - a.x) * (c.y - a.y) - static_cast<std::int64_t>(b.y - a.y) * (c.x - a.x);
}

/// (b - a) . (c - a), exact.
inline std::int64_t dot(const Lattice& a, const Lattice& b, const Lattice& c) {
  return static_cast<std::int64_t>(b.x - a.x) * (c.x - a.x) + static_cast<std::int64_t>(b.y - a.y) * (c.y - a.y);
}

inline double distance(const Lattice& a, const Lattice& b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// The corners that stay when a line is simplified so that none of the others is farther than `tolerance` from it (Douglas
/// and Peucker 1973). Both ends stay; of a line that returns to its begin the corner farthest from there does, too.
std::vector<Lattice> simplified(const std::vector<Lattice>& corner, double tolerance);

double length_of(const std::vector<Lattice>& points);

}  // namespace lamella
