// Soft disks that push each other apart: minimisation of the energy of overlap, sum over pairs of overlap^2 / 2, by FIRE
// (Bitzek et al. 2006: damped dynamics that is steered along the force and stopped when it runs uphill).
#pragma once
#include <functional>
#include <vector>

#include "generator/packing/neighbours.h"
#include "generator/sample/vec.h"

namespace lamella {

/// Disks in the box [0, size], between walls or, in some directions, periodic.
struct SoftDisks {
  Vec2 size = Vec2::Zero();
  double area = 0;  // that they fill: of the box, or of what the walls leave of it
  Periodic periodic{false, false};
  std::vector<StraightWall> walls;  // more of them, inside the box; no centre crosses one
  std::vector<Vec2> x;
  std::vector<double> radius;
};

struct RelaxationGoal {
  double clearance = 0;   // disks are larger by this part while they are pushed; separated: those of true size are
  double balance = 1e-4;  // balanced: largest net force below this part of the mean force of a contact
  int steps = 100000;     // give up after so many
};

enum class RelaxationEnd { kSeparated, kBalanced, kOutOfSteps };

struct Relaxation {
  RelaxationEnd end = RelaxationEnd::kOutOfSteps;
  int steps = 0;
  double pressure = 0;  // virial per area, in units of the stiffness of a contact
  double overlap = 0;   // largest, over the sum of the radii (to a wall: over the radius), clearance included
};

/// Moves the disks downhill until they are separated, balanced, or out of steps. Same input, same result.
Relaxation relax(SoftDisks& disks, const RelaxationGoal& goal,
                 const std::function<void(const Relaxation&)>& progress = {});

/// Of each disk: its largest overlap over its radius; 0 when it touches nothing.
std::vector<double> overlaps(SoftDisks disks);

}  // namespace lamella
