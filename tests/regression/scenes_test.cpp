// Small scenes through the whole program: closed forms at rest, equal bits whatever the threads and interruptions, and the
// arrays that a scene needs and no others.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "postproc/quantities/cell_shape.h"
#include "postproc/quantities/cell_stress.h"
#include "tests/regression/runs.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class scenes : public testing::Test {
 protected:
  TemporaryFolder folder;
  fs::path out = folder / "out";
};

Frame last_frame(const TrajectoryReader& reader) { return reader.frame(reader.frames() - 1); }

TEST_F(scenes, a_cantilever_at_rest_bends_as_n_hinges_do) {
  run_scene(scene_path("cantilever.toml"), out);
  const TrajectoryReader reader(out / "trajectory.h5");
  const Frame frame = last_frame(reader);
  const double deflection = -frame.arrays.doubles("x").back();  // y of the last node
  // F L^3 / 3 EI (1 + 1 / 2 n^2) with F = 3e-4, L = EI = 1, n = 8. Slopes of 1.5e-4 leave 1e-8 to large deflections.
  EXPECT_NEAR(deflection / 1e-4, 1 + 1.0 / 128, 1e-6);
}

TEST_F(scenes, a_load_shows_the_force_that_it_exerts_and_how_far_it_has_moved) {
  // The clamp moves along the beam against drag, 7 / s of its mass, and holds the weight of 3e-4 N.
  run_scene(scene_path("cantilever.toml"), out,
            "--set loads.clamp.velocity_x=1e-3 --set stop.time=20 --set 'loads.weight.name=the weight' --set "
            "output.frames=2");
  const TrajectoryReader reader(out / "trajectory.h5");
  const auto last = [&](const std::string& column) { return response_values(reader, column).back(); };
  EXPECT_NEAR(last("moved_x_clamp"), 1e-3 * last("time"), 1e-12);
  EXPECT_NEAR(last("moved_y_clamp"), 0, 1e-12);
  EXPECT_NEAR(last("force_y_the_weight") / -3e-4, 1, 1e-12);
  EXPECT_NEAR(last("force_y_clamp") / 3e-4, 1, 1e-6);
  EXPECT_NEAR(last("force_x_clamp") / (7 * 1e-3 * (1 - 1.0 / 16)), 1, 1e-6);  // of the free nodes: n = 8
  const auto& columns = reader.response().columns;
  for (const char* absent : {"force_x_the_weight", "moved_y_the_weight", "force_a"})
    EXPECT_EQ(std::count(columns.begin(), columns.end(), absent), 0) << absent;
}

TEST_F(scenes, an_inflated_ring_stays_a_regular_polygon_of_the_right_size) {
  run_scene(scene_path("inflated_ring.toml"), out);
  const TrajectoryReader reader(out / "trajectory.h5");
  const Frame frame = last_frame(reader);
  const FrameView view(reader.sample(), frame);
  const double rest = 2 * std::sin(M_PI / 40), stiffness = 1000 / rest;  // l0, EA / l0
  const double side = rest / (1 - 20 / (2 * stiffness * std::tan(M_PI / 40)));
  for (int k = 0; k < 40; ++k) EXPECT_NEAR((view.x[(k + 1) % 40] - view.x[k]).norm() / side, 1, 1e-6) << k;
}

TEST_F(scenes, at_rest_cells_carry_the_stress_of_the_grips_and_the_ledger_closes) {
  run_scene(scene_path("stretched_tissue.toml"), out);
  const TrajectoryReader reader(out / "trajectory.h5");
  const Sample sample = reader.sample();
  const Frame frame = last_frame(reader);
  const FrameView view(sample, frame);
  const auto shapes = cell_shapes(sample, view.x);
  const double depth = 1;  // [m], the default
  const Stress mean = mean_stress(sample, shapes, cell_stress(view, shapes, depth));
  const double grips = response_values(reader, "stress").back();
  EXPECT_GT(grips, 0);
  EXPECT_NEAR(mean.yy / grips, 1, 0.01);
  EXPECT_NEAR(response_values(reader, "force_a").back() / response_values(reader, "force_b").back(), 1, 1e-3);
  EXPECT_LT(response_values(reader, "residual").back(), 1e-6);
}

TEST_F(scenes, a_node_inside_another_cell_stops_the_run_with_its_id) {
  const Outcome outcome = lamella_program("run " + scene_path("overrun_ring.toml") + " -o " + out.string());
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.said, testing::ContainsRegex("node [0-9]+ of cell [0-9]+ is inside cell [0-9]+"));
}

TEST_F(scenes, two_threads_compute_the_same_bits_as_one) {
  run_scene(scene_path("torn_honeycomb.toml"), folder / "one", "--threads 1");
  ::setenv("OMP_WAIT_POLICY", "passive", 1);  // on a busy machine, threads that wait by spinning take turns
  run_scene(scene_path("torn_honeycomb.toml"), folder / "two", "--threads 2");
  const TrajectoryReader reader(folder / "one/trajectory.h5");
  EXPECT_FALSE(reader.events().empty()) << "the scene no longer breaks links";
  expect_same_bits(folder / "one/trajectory.h5", folder / "two/trajectory.h5");
}

/// Ends the run by `signal` once some of its frames are on the disk, then resumes it.
void interrupt_and_resume(const std::string& signal, int status, const fs::path& folder) {
  // Slow enough that the signal arrives before the end: the shell sees the parts within 10 ms of a run of a second.
  const std::string options = " --set loading.strain_rate=500";
  const std::string scene = scene_path("torn_honeycomb.toml"), cut = (folder / "cut").string();
  run_scene(scene, folder / "whole", options);
  const Outcome outcome =
      shell("set +m; " + kProgram + " run " + scene + options + " -q -o " + cut + " & run=$!; until [ $(ls " + cut +
            "/trajectory.h5.parts 2>/dev/null | wc -l) -ge 7 ] || ! kill -0 $run 2>/dev/null; do "
            "sleep 0.01; done; kill -" +
            signal + " $run; wait $run");
  ASSERT_EQ(outcome.status, status) << outcome.said;
  ASSERT_FALSE(fs::exists(folder / "cut/summary.json")) << "the run was over before the signal";
  run_scene(scene, folder / "cut", "--resume" + options);
  expect_same_bits(folder / "whole/trajectory.h5", folder / "cut/trajectory.h5");
  EXPECT_TRUE(read_file(folder / "whole/response.csv") == read_file(folder / "cut/response.csv"));
}

TEST_F(scenes, a_run_interrupted_and_resumed_has_the_bits_of_a_whole_one) {
  interrupt_and_resume("INT", 130, folder.path());
}

TEST_F(scenes, a_run_killed_and_resumed_has_the_bits_of_a_whole_one) {
  interrupt_and_resume("KILL", 137, folder.path());
}

const Names kCells = {"cell_id", "group",        "energy", "energy_stretch", "energy_bend",
                      "area",    "outline_area", "aspect", "stress"};
const Names kWalls = {"cell_id", "axial_force", "moment", "velocity", "load_force", "displacement"};

Names operator+(Names names, const Names& more) {
  names.insert(more.begin(), more.end());
  return names;
}
Names operator-(Names names, const Names& less) {
  for (const auto& name : less) names.erase(name);
  return names;
}

TEST_F(scenes, a_beam_shows_walls_and_nothing_else) {
  run_scene(scene_path("cantilever.toml"), out);
  EXPECT_EQ(vtk_arrays(out, "walls"), kWalls);
  for (const char* series : {"links", "contacts", "cracks"}) EXPECT_FALSE(fs::exists(out / series += ".pvd")) << series;
}

TEST_F(scenes, a_ring_with_a_core_shows_pressure_but_no_links) {
  run_scene(scene_path("inflated_ring.toml"), out);
  EXPECT_EQ(vtk_arrays(out, "cells"), kCells + Names({"energy_core", "pressure"}));
  EXPECT_EQ(vtk_arrays(out, "walls"), kWalls - Names({"load_force"}));
  for (const char* series : {"links", "contacts", "cracks"}) EXPECT_FALSE(fs::exists(out / series += ".pvd")) << series;
}

TEST_F(scenes, links_that_cannot_break_have_no_yield_function_and_no_cracks) {
  run_scene(scene_path("stretched_tissue.toml"), out);
  EXPECT_EQ(vtk_arrays(out, "cells"), kCells + Names({"link_share", "fragment_id"}));
  EXPECT_EQ(vtk_arrays(out, "links"), Names({"link_id", "wall_id", "intact", "opening", "f_n", "f_t", "energy"}));
  for (const char* series : {"contacts", "cracks"}) EXPECT_FALSE(fs::exists(out / series += ".pvd")) << series;
}

}  // namespace
}  // namespace lamella
