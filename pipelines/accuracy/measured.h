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
  double error = 0;       // relative, against the exact answer
  double node_steps = 0;  // nodes x steps
  double seconds = 0;     // of the stepping loop
  double ledger = 0;      // largest residual of the energy ledger
};

/// Fills the costs from a run.
Measured measured(const StudyRun& run, const std::string& setting, const std::string& group, double knob, double error);

/// A table of a sweep: setting, error, node-steps, seconds, ledger.
void sweep_table(StudyReport& report, const std::vector<Measured>& sweep);

/// Work-precision charts, error over node-steps and over seconds: NAME_steps and NAME_seconds.
void work_precision(StudyReport& report, const std::string& name, const std::string& title,
                    const std::vector<Measured>& all);

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

}  // namespace lamella
