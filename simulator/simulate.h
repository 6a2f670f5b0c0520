// The simulator's front door: a sample and a scene in, a trajectory out.
#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "generator/sample/sample.h"
#include "generator/sample/scene.h"
#include "simulator/solver_cost.h"
#include "simulator/trajectory/trajectory.h"

namespace lamella {

struct RunProgress {
  int stage = 0, stages = 1;
  std::string stage_name;
  double done = 0;    // of the whole run, in [0, 1]; an upper bound where an event may end it earlier
  double time = 0;    // [s]
  double strain = 0;  // of the loading; 0 without
  double stress = 0;  // [Pa]
  int broken = 0;     // links
};

struct SimulateOptions {
  std::function<void(const RunProgress&)> progress;  // called at every row of the response
  std::function<void(const std::string&)> say;       // start-up summary, a line at a time
  const std::atomic<bool>* interrupted = nullptr;    // polled; when true the run ends at its last frame
};

struct RunFacts {
  std::string ended;  // "strain 0.3 reached", "stress fell below 20 % of its peak", "interrupted", ...
  bool interrupted = false;
  std::int64_t steps = 0;
  std::int64_t timed_steps = 0;  // of the stepping loop, without the weighed ones
  double seconds = 0;            // wall time of the stepping loop, frames apart
  double frame_seconds = 0;      // of frames and rows
  double node_steps = 0;         // nodes x steps / seconds [1/s]
  double residual = 0;           // of the energy ledger: largest over frames
  SolverCost static_cost;        // of searches for equilibrium
};

/// Runs all stages of the scene. Throws SceneError before anything is computed where scene and sample do not fit;
/// SolverError where the numerics give up, with the last good frame on disk.
RunFacts simulate(const Sample& sample, const Scene& scene, TrajectoryWriter& writer, const SimulateOptions& options);

/// Goes on from the last frame of `path`, to bitwise the result of a run that was never interrupted. The scene is the
/// one that the trajectory holds.
RunFacts resume(const std::filesystem::path& path, const SimulateOptions& options);

/// What would be simulated: terms, sizes, time step and what limits it, dimensionless groups. A line each.
std::vector<std::string> start_up_summary(const Sample& sample, const Scene& scene);

}  // namespace lamella
