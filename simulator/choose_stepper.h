// run.stepper = "auto": in time or at rest?
#pragma once
#include <string>

#include "generator/sample/sample.h"
#include "generator/sample/scene.h"

namespace lamella {

struct StepperChoice {
  std::string stepper;  // a value of run.stepper other than auto
  std::string why;      // a sentence; empty where the scene has said it itself
};

/// Where the scene leaves it open: at rest where the load is so slow, beside the slowest swing of the sample, that inertia adds less than
/// 5 % before the first break, or where run.accuracy leaves the pace open; in time where neither is so, and where the scene has what needs motion.
StepperChoice choose_stepper(const Sample& sample, const Stage& stage);

}  // namespace lamella
