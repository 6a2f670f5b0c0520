// Disks for tests: placed at random, overlapping or not, and the numbers they are made of.
#pragma once
#include <cmath>
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

}  // namespace lamella
