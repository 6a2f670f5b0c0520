// What the two halves of the study share: velocities at the start of a run, and sums over its nodes.
#pragma once
#include <functional>

#include "pipelines/studies/study.h"
#include "simulator/model.h"

namespace lamella {

/// Gives every node a velocity at the start of the stage, in place of what its scene states.
void state_velocities(Stage& stage, const std::vector<Vec2>& velocities);
void state_velocities(Stage& stage, const Sample& sample, const std::function<Vec2(const Vec2& x)>& velocity);

/// Sums over all nodes with the velocities half a step before the frame. As x(n) and x(n-1/2) differ by a multiple of the velocity, the angular
/// momentum is that at n-1/2.
struct Motion {
  double mass = 0;                      // [kg]
  Vec2 momentum = Vec2::Zero();         // [N s]
  double largest_momentum = 0;          // sum of |m v| [N s]
  double angular_momentum = 0;          // about the origin [N m s]
  double moment_of_inertia = 0;         // [kg m2]
  double largest_angular_momentum = 0;  // sum of |x| |m v| [N m s]
};
Motion motion_of(const Scene& scene, const StudyRun& run, int frame);

}  // namespace lamella
