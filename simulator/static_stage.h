// A stage at rest: run.stepper = "quasi_static". Equilibria under a growing load, a row of the response for each, both ends of every
// avalanche among them; frames equally spaced in time.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulator/load_path.h"
#include "simulator/stage.h"
#include "simulator/steppers/quasi_static.h"

namespace lamella {

class StaticStage final : public StageDriver {
 public:
  StaticStage(const Sample& sample, const Scene& scene, int stage, const ArraySet& start, StageStart how);

  std::vector<std::string> summary() const override;
  std::string run(TrajectoryWriter& writer, const SimulateOptions& options, const std::vector<std::string>& columns,
                  RunFacts& facts) override;

 private:
  bool moves() const override { return false; }
  void refuse_what_moves() const;
  std::optional<std::string> add_row(TrajectoryWriter& writer, const std::vector<std::string>& columns,
                                     RunFacts& facts);
  void add_events(TrajectoryWriter& writer);
  void write_frame(TrajectoryWriter& writer);

  std::optional<LoadPath> path_;
  std::unique_ptr<QuasiStatic> stepper_;

  std::int64_t frame_ = 0;  // next one to be written
  std::int64_t first_step_ = 0, step_ = 0;
  double last_frame_time_ = 0;  // [s]; -1: none
  int rows_ = 0;
  double stress_ = 0;  // of the last row [Pa]
};

}  // namespace lamella
