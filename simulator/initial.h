// Velocities with which a stage starts, as the [[initial]] sections of its scene state them.
#pragma once
#include "simulator/loads.h"
#include "simulator/model.h"
#include "simulator/steppers/velocity_verlet.h"

namespace lamella {

/// Gives nodes the velocities stated for the time of `state`. What is stored lies half a step of `dt` [s] before it, so that the mean of
/// the velocities before and after is the stated one; forces of dashpots, linear in velocities, are left out of that half kick. Components
/// that no entry states keep theirs. Throws SceneError for selections that the sample does not have.
void set_initial_velocities(const Model& model, const Stage& stage, const std::vector<Load>& loads, double dt,
                            State& state);

}  // namespace lamella
