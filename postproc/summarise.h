// From a run's curve, frames and cracks to the numbers of its summary.
#pragma once
#include <optional>

#include "postproc/frame_view.h"
#include "postproc/quantities/cell_stress.h"
#include "postproc/quantities/crack_path.h"
#include "postproc/quantities/energy_budget.h"
#include "postproc/quantities/material_constants.h"
#include "postproc/summary.h"

namespace lamella {

/// All that a summary is made of.
struct SummaryInputs {
  const TrajectoryReader* reader = nullptr;
  std::optional<TestSetup> setup;
  LoadCurve curve;
  MaterialConstants constants;
  EnergyBudget budget;
  std::vector<std::pair<double, double>> aspects;      // time, mean aspect of the cells, per frame
  std::vector<std::pair<double, Stress>> cell_stress;  // time, mean over the cells, per frame of the test
  std::vector<Crack> cracks;                           // of the last frame
  const FrameView* last = nullptr;
};

Summary summarise(const SummaryInputs& facts);

}  // namespace lamella
