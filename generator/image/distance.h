// The nearest marked pixel of every pixel.
#pragma once
#include <cstdint>
#include <vector>

#include "generator/sample/sample.h"

namespace lamella {

/// Index of the marked pixel with the nearest centre (Euclidean), or -1 when none is marked. In linear time, by the
/// lower envelope of parabolas (Meijster, Roerdink and Hesselink 2000). Shape of all: height x width.
std::vector<Index> nearest_marked(const std::vector<char>& marked, int width, int height);

/// Square of the distance of two pixels [pixels^2].
inline std::int64_t square_distance(Index a, Index b, int width) {
  const std::int64_t dx = a % width - b % width;
  const std::int64_t dy = a / width - b / width;
  return dx * dx + dy * dy;
}

}  // namespace lamella
