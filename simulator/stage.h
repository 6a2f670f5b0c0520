// What takes a sample through one stage of a scene, in time or at rest: from a starting state to the stop condition that ends it.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "simulator/loads.h"
#include "simulator/model.h"
#include "simulator/simulate.h"

namespace lamella {

/// From the sample at rest; from the last frame of the stage that this one continues; from a frame of this very stage, already on disk.
enum class StageStart { kFresh, kContinued, kResumed };

class StageDriver {
 public:
  virtual ~StageDriver() = default;

  /// Columns of the response, and their units, of this stage; adds those that are not there.
  virtual void columns(std::vector<std::string>& names, std::vector<std::string>& units) const = 0;
  virtual std::vector<std::string> summary() const = 0;
  virtual void describe(Provenance& provenance) const = 0;
  /// Goes on until a stop condition holds; writes frames, rows and events. Returns why it ended.
  virtual std::string run(TrajectoryWriter& writer, const SimulateOptions& options,
                          const std::vector<std::string>& columns, RunFacts& facts) = 0;
  /// State at the last frame, for the stage that continues this one.
  virtual const ArraySet& last() const = 0;

 protected:
  /// Why this driver, where the scene leaves it to the program; a line of the summary.
  void say_why(std::vector<std::string>& summary) const {
    if (!chosen_.empty()) summary.push_back("  " + chosen_);
  }

 private:
  friend std::unique_ptr<StageDriver> make_stage(const Sample&, const Scene&, int, const ArraySet&, StageStart);
  std::string chosen_;
};

/// The driver that run.stepper asks for. `start`: arrays of a restart, or of the last frame of the stage that this one continues; empty:
/// the sample at rest. Throws SceneError where scene and sample do not fit.
std::unique_ptr<StageDriver> make_stage(const Sample& sample, const Scene& scene, int stage, const ArraySet& start,
                                        StageStart how);

/// What the loading refers to, for whoever reads the trajectory.
void describe_gauge(const Gauge& gauge, const Stage& stage, const std::string& prefix, Provenance& provenance);

/// The stage's model at x, with the history of `start` (empty: none).
std::unique_ptr<Model> restored_model(const Sample& sample, const Stage& stage, const Field& x, const ArraySet& start);

}  // namespace lamella
