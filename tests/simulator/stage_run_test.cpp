// A stage as a whole: what its rows say, and that it goes on where it was interrupted.
#include <algorithm>
#include <atomic>

#include "generator/sample/scene.h"
#include "simulator/simulate.h"
#include "tests/support/samples.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

/// A ring that is inflated and swings.
Scene inflated(double step_fraction) {
  return parse_scene(R"(
[sample]
kind = "shapes"
[[sample.shapes]]
kind = "ring"
size = 1
segments = 20
[cells]
axial_rigidity = 100
bending_rigidity = 1
mass_per_length = 1
radius = 0.01
[cells.core]
drained = true
pressure_history = [[0, 0], [0.7, 5], [1.5, -1]]
[stop]
time = 2
[output]
frames = 10
response = 40
)",
                     "inflated", {"run.step_fraction=" + std::to_string(step_fraction)});
}

std::vector<double> column(const TrajectoryReader& reader, const std::string& name) {
  const Response& r = reader.response();
  const auto at = std::find(r.columns.begin(), r.columns.end(), name) - r.columns.begin();
  std::vector<double> out;
  for (const auto& row : r.rows) out.push_back(row.at(static_cast<std::size_t>(at)));
  return out;
}

TEST(StageRun, a_prescribed_pressure_keeps_the_ledger_to_second_order) {
  const TemporaryFolder folder;
  const Sample ring = ring_sample(20);
  std::vector<double> residual;
  for (const double fraction : {0.4, 0.1}) {
    const auto path = folder / std::to_string(fraction);
    TrajectoryWriter writer(path, ring, {});
    const RunFacts facts = simulate(ring, inflated(fraction), writer, {});
    residual.push_back(facts.residual);
    EXPECT_GT(column(TrajectoryReader(path), "work").back(), 0);
  }
  EXPECT_LT(residual[0], 1e-3);
  EXPECT_LT(residual[1], residual[0] / 12);
}

TEST(StageRun, a_run_under_a_prescribed_pressure_resumes_to_the_same_bits) {
  const TemporaryFolder folder;
  const Sample ring = ring_sample(20);
  const Scene scene = inflated(0.4);
  {
    TrajectoryWriter writer(folder / "whole", ring, {});
    simulate(ring, scene, writer, {});
  }
  {
    TrajectoryWriter writer(folder / "cut", ring, {});
    std::atomic<bool> stop = false;
    SimulateOptions options;
    options.interrupted = &stop;
    options.progress = [&](const RunProgress& now) { stop = now.time > 1.1; };
    EXPECT_TRUE(simulate(ring, scene, writer, options).interrupted);
  }
  resume(folder / "cut", {});
  const TrajectoryReader whole(folder / "whole"), resumed(folder / "cut");
  EXPECT_EQ(whole.response().rows, resumed.response().rows);
  EXPECT_EQ(whole.frame(whole.frames() - 1).arrays.doubles("x"),
            resumed.frame(resumed.frames() - 1).arrays.doubles("x"));
}

}  // namespace
}  // namespace lamella
