// What takes a sample through one stage of a scene, in time or at rest: from a starting state to the stop condition that ends it.
#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulator/loads.h"
#include "simulator/model.h"
#include "simulator/simulate.h"
#include "simulator/stop_conditions.h"

namespace lamella {

/// From the sample at rest; from the last frame of the stage that this one continues; from a frame of this very stage, already on disk.
enum class StageStart { kFresh, kContinued, kResumed };

class StageDriver {
 public:
  virtual ~StageDriver() = default;

  /// Columns of the response, and their units, of this stage; adds those that are not there.
  void columns(std::vector<std::string>& names, std::vector<std::string>& units) const;
  virtual std::vector<std::string> summary() const = 0;
  virtual void describe(Provenance& provenance) const;
  /// Goes on until a stop condition holds; writes frames, rows and events. Returns why it ended.
  virtual std::string run(TrajectoryWriter& writer, const SimulateOptions& options,
                          const std::vector<std::string>& columns, RunFacts& facts) = 0;
  /// State at the last frame, for the stage that continues this one.
  const ArraySet& last() const { return last_; }

 protected:
  StageDriver(const Sample& sample, const Scene& scene, int stage, const ArraySet& start, StageStart how);

  /// Whether anything moves but with the loads: what columns there are depends on it.
  virtual bool moves() const = 0;
  /// Throws SceneError unless the stage has an end.
  void require_end(double duration) const;
  /// Names of the terms, and why this driver, where the scene leaves it to the program: lines of the summary.
  std::string term_names() const;
  std::string box_line() const;
  void say_why(std::vector<std::string>& summary) const;
  std::string prefix() const { return index_ == 0 ? "" : fmt::format("stage_{}_", index_); }
  void report(const SimulateOptions& options, double done, double time, double strain, double stress) const;
  /// Links and bars.
  int broken() const { return broken_links() + broken_bars(); }
  int broken_links() const { return model_->links ? static_cast<int>(model_->links->broken()) : 0; }
  int broken_bars() const { return model_->rupture ? static_cast<int>(model_->rupture->broken().count()) : 0; }
  /// Velocities where the stage starts; relative ones, where a box moves (moving_box.h).
  Field start_velocities(const ArraySet& start) const;
  /// Positions and velocities, for a restart and for a frame.
  void save_motion(const Field& x, const Field& v, ArraySet& restart) const;
  void add_motion(const Field& x, const Field& v, ArraySet& frame) const;
  /// What terms say of x in a frame, and what they need to go on.
  void add_output(const Field& x, ArraySet& frame) const;
  void save_terms(ArraySet& restart) const;

  const Sample& sample_;
  const Scene& scene_;
  const Stage& stage_;
  int index_;
  bool resumed_;
  Field start_x_;          // where the stage, or its resumed part, starts [m]
  double start_time_ = 0;  // [s]
  std::int64_t start_step_ = 0;
  std::unique_ptr<Model> model_;
  std::vector<Load> loads_;
  std::vector<LoadColumn> load_columns_;
  Gauge gauge_;
  std::optional<StopConditions> stops_;
  double largest_work_ = 0;   // [J]
  std::vector<double> base_;  // of the ledger, at the first row [J]
  ArraySet last_;

 private:
  friend std::unique_ptr<StageDriver> make_stage(const Sample&, const Scene&, int, const ArraySet&, StageStart);
  std::string chosen_;
};

/// A row of the response, to be filled by the names of its columns; what the stage does not have stays 0.
class ResponseRow {
 public:
  explicit ResponseRow(const std::vector<std::string>& columns) : columns_(columns), values_(columns.size(), 0.0) {}
  void put(const std::string& name, double value);
  const std::vector<double>& values() const { return values_; }

 private:
  const std::vector<std::string>& columns_;
  std::vector<double> values_;
};

/// The driver that run.stepper asks for. `start`: arrays of a restart, or of the last frame of the stage that this one continues; empty:
/// the sample at rest. Throws SceneError where scene and sample do not fit.
std::unique_ptr<StageDriver> make_stage(const Sample& sample, const Scene& scene, int stage, const ArraySet& start,
                                        StageStart how);

}  // namespace lamella
