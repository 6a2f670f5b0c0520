// A stage at rest as a whole: its rows, frames and events, and that it goes on where it was interrupted or gave up.
#include "simulator/static_stage.h"

#include <algorithm>
#include <atomic>

#include "generator/sample/errors.h"
#include "tests/simulator/tissues.h"
#include "tests/support/samples.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

/// A honeycomb of unit sides, pulled until it is in two.
Scene pulled(const std::vector<std::string>& settings = {}) {
  return parse_scene(R"(
[sample]
kind = "honeycomb"
columns = 4
rows = 4
side = 1
walls = { segments = 2 }
[cells]
axial_rigidity = 400
bending_rigidity = 0.5
mass_per_length = 1
radius = 0.025
[links]
normal_stiffness = 800
tangential_stiffness = 300
normal_strength = 6
tangential_strength = 6
[loading]
strain_rate = 1
strain = 0.4
[stop]
separated = true
[run]
stepper = "quasi_static"
[output]
frames = 20
)",
                     "pulled", settings);
}

/// Four by four hexagons, the lowest and the highest row gripped.
Sample gripped() {
  Sample s = hexagons(4, 4, 2, 0.05);
  s.side.assign(s.nodes(), 0);
  for (Index c = 0; c < 16; ++c)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) {
      if (c < 4) s.side[i] = kBottom;
      if (c >= 12) s.side[i] = kTop;
    }
  return s;
}

std::vector<double> column(const TrajectoryReader& reader, const std::string& name) {
  const Response& r = reader.response();
  const auto at = std::find(r.columns.begin(), r.columns.end(), name) - r.columns.begin();
  std::vector<double> out;
  for (const auto& row : r.rows) out.push_back(row.at(static_cast<std::size_t>(at)));
  return out;
}

RunFacts run(const std::filesystem::path& path, const Sample& sample, const Scene& scene,
             const SimulateOptions& options = {}) {
  TrajectoryWriter writer(path, sample, {});
  return simulate(sample, scene, writer, options);
}

TEST(StaticStage, tells_both_ends_of_every_avalanche_and_each_break_in_its_place) {
  const TemporaryFolder folder;
  const Sample tissue = gripped();
  const RunFacts facts = run(folder / "run", tissue, pulled());
  EXPECT_EQ(facts.ended.substr(0, 9), "separated");
  EXPECT_LT(facts.residual, 3e-2);  // 100 load steps: see quasi_static_test for its order
  const TrajectoryReader reader(folder / "run");
  EXPECT_EQ(reader.frame(0).time, 0);
  EXPECT_NEAR(column(reader, "stress").front(), 0, 1e-9);

  const auto strain = column(reader, "strain"), broken = column(reader, "broken_links"), work = column(reader, "work");
  const auto& events = reader.events();
  EXPECT_EQ(static_cast<double>(events.size()), broken.back());
  std::int64_t avalanches = 0;
  for (std::size_t k = 1; k < strain.size(); ++k) {
    if (broken[k] == broken[k - 1]) continue;
    ++avalanches;
    EXPECT_EQ(strain[k], strain[k - 1]);  // the curve drops at one strain, ...
    EXPECT_EQ(work[k], work[k - 1]);      // without work
  }
  EXPECT_EQ(events.back().avalanche, avalanches - 1);
  for (std::size_t k = 1; k < events.size(); ++k) {
    const bool same = events[k].avalanche == events[k - 1].avalanche;
    EXPECT_EQ(events[k].avalanche, events[k - 1].avalanche + (same ? 0 : 1));
    EXPECT_EQ(events[k].place, same ? events[k - 1].place + 1 : 0);
  }
}

/// Runs the scene whole, and interrupted once `broken` links are and resumed.
void expect_the_same_bits(const Scene& scene, int broken) {
  const TemporaryFolder folder;
  const Sample tissue = gripped();
  run(folder / "whole", tissue, scene);
  std::atomic<bool> stop = false;
  SimulateOptions options;
  options.interrupted = &stop;
  options.progress = [&](const RunProgress& now) { stop = now.broken > broken; };
  EXPECT_TRUE(run(folder / "cut", tissue, scene, options).interrupted);
  resume(folder / "cut", {});
  const TrajectoryReader whole(folder / "whole"), resumed(folder / "cut");
  EXPECT_EQ(whole.response().rows, resumed.response().rows);
  ASSERT_EQ(whole.events().size(), resumed.events().size());
  EXPECT_GT(static_cast<int>(whole.events().size()), broken + 1);
  for (std::size_t k = 0; k < whole.events().size(); ++k) {
    EXPECT_EQ(whole.events()[k].link, resumed.events()[k].link);
    EXPECT_EQ(whole.events()[k].released, resumed.events()[k].released);
  }
  EXPECT_EQ(whole.frame(whole.frames() - 1).arrays.doubles("x"),
            resumed.frame(resumed.frames() - 1).arrays.doubles("x"));
}

TEST(StaticStage, an_interrupted_run_resumes_to_the_same_bits) {
  expect_the_same_bits(pulled(), 6);
  const Scene rubbing = pulled({"contact.friction=0.3"});  // broken walls touch, and pieces come loose
  expect_the_same_bits(rubbing, 6);
  expect_the_same_bits(rubbing, 25);
  // Its load follows links that soften back and forth.
  expect_the_same_bits(pulled({"links.law=cohesive_zone", "links.toughness=0.3", "run.unstable=follow"}), 6);
}

TEST(StaticStage, implicit_runs_resume_to_the_same_bits_too) {
  for (const std::string scheme : {"backward_euler", "generalised_alpha"})
    expect_the_same_bits(pulled({"run.stepper=" + scheme, "output.response=100", "output.frames=20",
                                 "loading.strain=0.25", "drag.rate=20", "stop.separated=false"}),
                         3);
}

TEST(StaticStage, unloads_to_where_it_began) {
  const TemporaryFolder folder;
  const Sample tissue = gripped();
  run(folder / "run", tissue,
      pulled({"links.normal_strength=1e9", "links.tangential_strength=1e9", "loading.strain=0.1", "loading.unload=true",
              "run.residual=1e-9"}));
  const TrajectoryReader reader(folder / "run");
  const auto stress = column(reader, "stress"), strain = column(reader, "strain");
  EXPECT_NEAR(*std::max_element(strain.begin(), strain.end()), 0.1, 1e-12);
  EXPECT_NEAR(strain.back(), 0, 1e-12);
  EXPECT_LT(std::abs(stress.back()), 1e-6 * *std::max_element(stress.begin(), stress.end()));
  const auto x = reader.frame(reader.frames() - 1).arrays.doubles("x");
  for (Index i = 0; i < tissue.nodes(); ++i) EXPECT_NEAR(x[2 * i], tissue.x[i].x(), 1e-6);
}

TEST(StaticStage, goes_on_from_a_stage_in_time_and_back) {
  const TemporaryFolder folder;
  const Sample tissue = gripped();
  Scene scene = pulled({"loading.strain=0.02", "links.normal_strength=1e9", "links.tangential_strength=1e9"});
  Stage in_time = scene.stages[0];
  in_time.name = "in time", in_time.run.stepper = "velocity_verlet";
  in_time.loading.reset(), in_time.stop = {};
  in_time.stop.time = 0.1;
  in_time.drag = DragScene{.rate = 5};
  Stage at_rest = scene.stages[0];
  at_rest.name = "at rest", at_rest.loading.reset(), at_rest.stop = {};
  at_rest.stop.time = 0.1;
  scene.stages.push_back(in_time), scene.stages.push_back(at_rest);
  for (Stage* s : {&scene.stages[1], &scene.stages[2]}) {
    LoadScene hold;
    hold.velocity_x = hold.velocity_y = 0;
    hold.name = "low", hold.nodes.side = "bottom";
    s->loads.push_back(hold);
    hold.name = "high", hold.nodes.side = "top";
    s->loads.push_back(hold);
  }
  run(folder / "run", tissue, scene);
  const TrajectoryReader reader(folder / "run");
  // Rest stays rest, whoever looks after it.
  const auto stage = column(reader, "stage"), energy = column(reader, "energy_bars");
  double at_end = 0;
  for (std::size_t k = 0; k < stage.size(); ++k) {
    if (stage[k] == 0) at_end = energy[k];
    EXPECT_NEAR(energy[k], at_end, 1e-3 * at_end);
  }
  EXPECT_EQ(stage.back(), 2);
}

TEST(StaticStage, refuses_what_needs_motion) {
  const Sample tissue = gripped();
  Scene scene = pulled();
  scene.stages[0].initial.emplace_back();
  EXPECT_THROW(start_up_summary(tissue, scene), SceneError);
  EXPECT_THROW(pulled({"run.residual=0"}), SceneError);
  EXPECT_THROW(pulled({"run.load_tolerance=2"}), SceneError);
  EXPECT_THROW(pulled({"run.breaking=some"}), SceneError);
}

TEST(StaticStage, where_it_gives_up_the_last_good_state_is_on_disk) {
  // A ring whose walls flow holds no more than F_Y / R of pressure.
  const TemporaryFolder folder;
  const Scene scene = parse_scene(R"(
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
yield_force = 1
yield_moment = 1e9
[cells.core]
drained = true
pressure_history = [[0, 0], [1, 2]]
[[loads]]
name = "hold"
nodes = { nodes = [0] }
velocity_x = 0
velocity_y = 0
[[loads]]
name = "level"
nodes = { nodes = [10] }
velocity_y = 0
[run]
stepper = "quasi_static"
[stop]
time = 1
[output]
frames = 4
)",
                                  "flowing");
  EXPECT_THROW(run(folder / "run", ring_sample(20), scene), SolverError);
  const auto writer = TrajectoryWriter::resume(folder / "run");
  EXPECT_GT(writer.last_frame().time, 0.45);
  EXPECT_LT(writer.last_frame().time, 0.52);
}

}  // namespace
}  // namespace lamella
