// An end-loaded split: a crack between two beams that slide past each other, grown at rest through links that soften.
#pragma once
#include "pipelines/studies/study.h"

namespace lamella {

/// Beams of EI = 1 and thickness h = 2, one bonded to the other from x = a0 on and held at x = L (split.toml).
struct SplitBeam {
  static constexpr double kLength = 100, kCrack = 70, kThickness = 2, kArm = 1;  // L, a0, h [m]; EI of an arm [N m2]
  static constexpr double kAxial = 12 * kArm / (kThickness * kThickness);        // EA of an arm [N]
  static constexpr double kBonded = 2 * kArm + kAxial * kThickness * kThickness / 2;  // EI of both as one [N m2]

  /// Linear fracture mechanics of slender beams under a force P, shared equally by both ends: J s [N] with the crack at a, and the way of the ends.
  static double release(double force, double crack) {
    return force * force * crack * crack * (1 / (4 * kArm) - 1 / (2 * kBonded));
  }
  static double way(double force, double crack);
  /// The force at which the crack stands when the ends have gone that way [N].
  static double force_at(double way, double toughness);
};

struct SplitCrack {
  std::vector<double> way, force;            // of the ends, at frames [m, N]
  std::vector<double> ratio;                 // J / G
  double mean = 0, lowest = 0, highest = 0;  // of J / G, where two links or more are gone
  double force_error = 0;  // of P against P(way) of linear fracture mechanics, mean of magnitudes there
  double mode_mix = 0;     // of the broken links, mean [rad]
  int broken = 0;
  double seconds = 0;
};

/// `segments` of each beam; `zone`: length over which links soften, roughly [m].
SplitCrack slide_crack(StudyBench& bench, int segments, double zone, double toughness);

}  // namespace lamella
