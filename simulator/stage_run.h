// One stage of a run: model, loads, stepper and clock, from a starting state to the stop condition that ends it.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulator/loading.h"
#include "simulator/model.h"
#include "simulator/simulate.h"
#include "simulator/stage.h"
#include "simulator/steppers/stable_time_step.h"
#include "simulator/steppers/stepper.h"
#include "simulator/stop_conditions.h"

namespace lamella {

class StageRun final : public StageDriver {
 public:
  StageRun(const Sample& sample, const Scene& scene, int stage, const ArraySet& start, StageStart how);

  std::vector<std::string> summary() const override;
  void describe(Provenance& provenance) const override;
  std::string run(TrajectoryWriter& writer, const SimulateOptions& options, const std::vector<std::string>& columns,
                  RunFacts& facts) override;

 private:
  bool moves() const override { return true; }
  struct Row;
  void plan_step();
  void set_loads(double dt);
  void set_pressures();
  Row weigh(double energy, const Measurement& m) const;
  void write(TrajectoryWriter& writer, ArraySet arrays, ArraySet restart, double time, std::int64_t step);
  ArraySet restart_arrays() const;
  void note_breaks(std::int64_t step, double strain);
  void write_events(TrajectoryWriter& writer);
  double strain() const { return course_ ? course_->strain() : 0.0; }

  State state_;
  std::optional<LoadingCourse> course_;
  std::unique_ptr<Stepper> stepper_;
  StableStep stable_;

  // clock of the stage: rows are equally spaced, frames fall on rows, steps divide the time between rows
  double row_interval_ = 0;  // [s]
  std::int64_t row_ = 0;     // rows done
  std::int64_t rows_per_frame_ = 1;
  std::int64_t steps_per_row_ = 0;
  double dt_ = 0, last_dt_ = 0;  // [s]
  double duration_ = 0;          // expected, or the limit [s]
  std::vector<Event> events_;    // since the last row
  // history of the stage
  std::vector<double> pressure_lever_;  // of prescribed pressures at the last step [J/Pa]
  double pressure_work_ = 0;            // [J]
};

}  // namespace lamella
