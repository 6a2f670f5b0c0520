// A state of a run as a sample for other scenes.
#pragma once
#include "simulator/trajectory/trajectory.h"

namespace lamella {

/// The trajectory's sample with the positions, and the box where it has been pulled, of a frame (negative: from the end, -1 the last). What cells and links are at rest
/// stays as it was, so that elastic forces are those of the frame; links that are broken there are left out. Velocities, plastic
/// lengths and angles and friction springs are not part of a sample: those of the frame are lost. Throws SceneError when there is no
/// such frame.
Sample extract_sample(const TrajectoryReader& reader, int frame);

}  // namespace lamella
