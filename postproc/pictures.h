// The pictures of a run: cells coloured by their energy, the crack path, the stress-strain curve, the energy ledger.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "postproc/frame_view.h"
#include "postproc/quantities/crack_path.h"
#include "postproc/quantities/energy_budget.h"
#include "postproc/quantities/material_constants.h"

namespace lamella {

using Paths = std::vector<std::filesystem::path>;

struct Snapshot {
  const FrameView* view = nullptr;
  std::string title, subtitle;
  std::vector<Crack> cracks;
};

/// Snapshots side by side (stacked for wide samples), on one colour scale: cell energy over W_0, or in joules where links
/// do not break. Opened cells have no colour. Outlines are true to the walls' thickness. Grips are drawn for a test.
Paths draw_snapshots(const std::filesystem::path& stem, const std::vector<Snapshot>& snapshots,
                     const std::optional<TestSetup>& setup);

/// Broken links, and across their walls broken bars, on the undeformed tissue (opened cells tinted), coloured by the strain (in a test) or time at which they broke.
Paths draw_crack_path(const std::filesystem::path& stem, const FrameView& last, const std::vector<Crack>& cracks,
                      const std::optional<TestSetup>& setup, const LoadCurve& curve);

/// Stress over strain with the number of broken links; marks at the snapshots' times.
Paths draw_stress_strain(const std::filesystem::path& stem, const LoadCurve& curve, const TestSetup& setup,
                         const std::vector<Event>& events, const std::vector<double>& mark_times);

/// Where the work went, over strain in a test and over time otherwise.
Paths draw_energy_ledger(const std::filesystem::path& stem, const EnergyBudget& budget,
                         const std::vector<double>& strain);

}  // namespace lamella
