// Error against cost: one computed setting beside its error and its price, and what follows from many of them.
#pragma once
#include <string>
#include <vector>

#include "pipelines/studies/study.h"

namespace lamella {

struct Measured {
  std::string setting;    // "N = 80, rate 0.01, drag 2"
  std::string group;      // curve of the chart that it belongs to
  double knob = 0;        // the one that a sweep turns
  double error = 0;       // relative, against the exact answer; NaN where the run has no answer
  double node_steps = 0;  // nodes x steps
  double seconds = 0;     // of the stepping loop
  double ledger = 0;      // largest residual of the energy ledger
  bool joined = true;     // with its neighbours in the chart: they differ in one knob that is turned in steps
};

/// Fills the costs from a run.
Measured measured(const StudyRun& run, const std::string& setting, const std::string& group, double knob, double error);

/// A table of a sweep: setting, error, node-steps, seconds, ledger.
void sweep_table(StudyReport& report, const std::vector<Measured>& sweep);

/// "3.2 %", or "no answer".
std::string error_text(double error);

/// Work-precision charts, error over node-steps and over seconds: NAME_steps and NAME_seconds.
void work_precision(StudyReport& report, const std::string& name, const std::string& title,
                    const std::vector<Measured>& all);

/// The one over seconds alone, called NAME, where costs are not all counted in node-steps; with curves besides.
void precision_over_seconds(StudyReport& report, const std::string& name, const std::string& title,
                            const std::vector<Measured>& all, const std::vector<Curve>& besides);

/// The cheapest setting (in node-steps) for 5 %, 1 % and 0.1 %, or the best that was reached.
void recommend(StudyReport& report, const std::string& what, const std::vector<Measured>& all);

/// "order 1.98 +- 0.05" of the error over the sweep's knob, as error ~ knob^order.
std::string order_text(const std::vector<Measured>& sweep);

/// An estimate of an error beside the true one.
struct EstimatedError {
  std::string setting;
  double estimated = 0, truth = 0;
};

// The cases. Each adds sections to the report, and to the list of estimates.
void accuracy_of_ring(StudyBench& bench, std::vector<EstimatedError>& estimates);
void accuracy_of_plastic_ring(StudyBench& bench);
void accuracy_of_double_cantilever(StudyBench& bench, std::vector<EstimatedError>& estimates);
void accuracy_of_tissue(StudyBench& bench);
void accuracy_of_slow_fracture(StudyBench& bench);

}  // namespace lamella
