// `lamella run` for a stated error: chooses pace, drag and step, runs at two paces, and slows down until their difference says that the
// error of the slower one is accepted.
#pragma once
#include <filesystem>
#include <functional>
#include <vector>

#include "generator/sample/sample.h"
#include "generator/sample/scene.h"
#include "pipelines/program/progress.h"
#include "postproc/summary.h"
#include "simulator/simulate.h"

namespace lamella {

struct AccurateRun {
  double accepted = 0, estimated = 0;
  std::vector<Quantity> quantities;  // for the summary
};

/// Leaves the slowest run in FOLDER/trajectory.h5, the others in FOLDER/accuracy/, and a table of all in FOLDER/accuracy.json. `scene_at` reads
/// the scene with settings over it. Throws SolverError, the runs in place, where the error cannot be reached in kMostRuns runs.
AccurateRun run_to_accuracy(const std::function<Scene(const std::vector<std::string>&)>& scene_at, const Sample& sample,
                            double accepted, const std::filesystem::path& folder, Progress& progress,
                            const std::function<SimulateOptions()>& options);

constexpr int kMostRuns = 6;

}  // namespace lamella
