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
#include "simulator/stop_conditions.h"

namespace lamella {

class StaticStage final : public StageDriver {
 public:
  StaticStage(const Sample& sample, const Scene& scene, int stage, const ArraySet& start, StageStart how);

  void columns(std::vector<std::string>& names, std::vector<std::string>& units) const override;
  std::vector<std::string> summary() const override;
  void describe(Provenance& provenance) const override;
  std::string run(TrajectoryWriter& writer, const SimulateOptions& options, const std::vector<std::string>& columns,
                  RunFacts& facts) override;
  const ArraySet& last() const override { return last_; }

 private:
  void refuse_what_moves() const;
  std::optional<std::string> add_row(TrajectoryWriter& writer, const std::vector<std::string>& columns,
                                     RunFacts& facts);
  void add_events(TrajectoryWriter& writer);
  void write_frame(TrajectoryWriter& writer);
  void report(const SimulateOptions& options) const;
  double plastic() const;

  const Sample& sample_;
  const Scene& scene_;
  const Stage& stage_;
  int index_;
  bool resumed_;
  std::unique_ptr<Model> model_;
  std::vector<Load> loads_;
  std::vector<LoadColumn> load_columns_;
  Gauge gauge_;
  std::optional<LoadPath> path_;
  std::optional<StopConditions> stops_;
  std::unique_ptr<QuasiStatic> stepper_;

  double start_time_ = 0;   // [s]
  std::int64_t frame_ = 0;  // next one to be written
  std::int64_t first_step_ = 0, step_ = 0;
  double last_frame_time_ = 0;  // [s]; -1: none
  int rows_ = 0;
  double stress_ = 0;         // of the last row [Pa]
  double largest_work_ = 0;   // [J]
  std::vector<double> base_;  // energy and dissipation at the first row [J]
  ArraySet last_;
};

}  // namespace lamella
