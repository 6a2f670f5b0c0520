// The course of a test in time: how fast the grips move at each step. Loads to a strain, back if asked, in one go or step by step with
// rest between.
#pragma once
#include <cstdint>
#include <vector>

#include "generator/sample/scene.h"
#include "simulator/loads.h"

namespace lamella {

class LoadingCourse {
 public:
  LoadingCourse(const LoadingScene& scene, const Gauge& gauge);

  /// Factor of the grips' full velocity during the step from `time` (of the stage) to `time + dt`; moves on by that step.
  double advance(double time, double dt);
  /// Tells the course how far from rest the sample is (a step-then-relax test waits for that).
  void report_unbalanced(double unbalanced, double time);
  bool finished() const { return phase_ == Phase::kDone; }
  /// Engineering strain, tension and opening positive.
  double strain() const { return opening_ / gauge_.length; }
  /// Time that loading (and unloading) takes, without the waits [s].
  double duration() const;

  std::vector<double> save() const;
  void restore(const std::vector<double>& state);

 private:
  enum class Phase : int { kLoad, kHold, kUnload, kDone };
  double ramp_time() const;

  LoadingScene scene_;
  Gauge gauge_;
  Phase phase_ = Phase::kLoad, after_hold_ = Phase::kLoad;
  double phase_start_ = 0;  // [s]
  double opening_ = 0;      // [m], signed as the strain
  double target_ = 0;       // of the present move, in [0, strain] [1]
};

}  // namespace lamella
