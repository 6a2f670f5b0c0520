// A stage as a whole: what its rows say, and that it goes on where it was interrupted.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "generator/sample/errors.h"
#include "generator/sample/scene.h"
#include "generator/sample/voids.h"
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

TEST(StageRun, says_how_stiff_contact_is_beside_the_walls) {
  Scene scene = inflated(0.5);
  scene.stages[0].contact.emplace();
  scene.stages[0].contact->normal_stiffness = 1000;
  const double l = 2 * std::sin(M_PI / 20);  // EI = 1, k_n = 1000 l, k_b = EI / l
  const std::string expected = fmt::format("contact against walls: k_n l^2 / k_b = {:.3g}", 1000 * std::pow(l, 4));
  const auto lines = start_up_summary(ring_sample(20), scene);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
    return line.find(expected) != std::string::npos;
  })) << expected;
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

TEST(StageRun, says_over_how_many_spacings_links_soften_and_when_those_are_too_few) {
  // EI = 1, f = 1 N/m, spacing 1/4: G = 1 J/m makes (EI G / f^2)^(1/4) = 1 m, G = 0.04 about 0.45 m.
  Scene scene = inflated(0.5);
  scene.stages[0].cells["cells"].core.reset();
  LinkScene& links = scene.stages[0].links["links"];
  links.law = "cohesive_zone";
  links.normal_stiffness = links.tangential_stiffness = 100;
  links.normal_strength = links.tangential_strength = 1;
  for (const auto& [toughness, spacings, enough] :
       {std::tuple{1.0, "4 spacings", true}, {0.04, "1.79 spacings", false}}) {
    links.toughness = toughness;
    const auto lines = start_up_summary(two_bonded_squares(4), scene);
    const auto line =
        std::find_if(lines.begin(), lines.end(), [](const std::string& l) { return l.find("soften") != l.npos; });
    ASSERT_NE(line, lines.end());
    EXPECT_NE(line->find(spacings), std::string::npos) << *line;
    EXPECT_EQ(line->find("fewer than 2") == std::string::npos, enough) << *line;
  }
  links.law = "brittle";
  for (const std::string& line : start_up_summary(two_bonded_squares(4), scene))
    EXPECT_EQ(line.find("soften"), std::string::npos) << line;
}

/// Two squares whose links soften, pulled apart in two stages: the first leaves them damaged.
Scene torn() {
  return parse_scene(R"(
[sample]
kind = "honeycomb"
columns = 1
rows = 2
side = 1
walls.segments = 1
[cells]
axial_rigidity = 400
bending_rigidity = 5
mass_per_length = 1
radius = 0.05
[links]
law = "cohesive_zone"
normal_stiffness = 400
tangential_stiffness = 150
normal_strength = 6
tangential_strength = 6
toughness = 0.3
[drag]
rate = 1
[loading]
axis = "y"
strain_rate = 0.01
[output]
frames = 5
response = 20
[[stages]]
name = "damage"
loading.strain = 0.035
[[stages]]
name = "part"
loading.strain = 0.05
)",
                     "torn");
}

TEST(StageRun, links_that_soften_resume_to_the_same_bits_and_keep_their_damage_from_stage_to_stage) {
  const TemporaryFolder folder;
  const Sample squares = two_bonded_squares(4);
  const Scene scene = torn();
  {
    TrajectoryWriter writer(folder / "whole", squares, {});
    EXPECT_LT(simulate(squares, scene, writer, {}).residual, 1e-4);
  }
  const TrajectoryReader whole(folder / "whole");
  for (const double cut_at : {2.8, 4.5}) {
    {
      TrajectoryWriter writer(folder / "cut", squares, {});
      std::atomic<bool> stop = false;
      SimulateOptions options;
      options.interrupted = &stop;
      options.progress = [&](const RunProgress& now) { stop = now.time > cut_at; };
      EXPECT_TRUE(simulate(squares, scene, writer, options).interrupted);
    }
    resume(folder / "cut", {});
    const TrajectoryReader resumed(folder / "cut");
    EXPECT_EQ(whole.response().rows, resumed.response().rows);
    const ArraySet last = whole.frame(whole.frames() - 1).arrays;
    for (const char* name : {"x", "link_damage", "link_zeta", "link_energy"})
      EXPECT_EQ(last.doubles(name), resumed.frame(resumed.frames() - 1).arrays.doubles(name)) << name;
    ASSERT_EQ(whole.events().size(), resumed.events().size());
    for (std::size_t e = 0; e < whole.events().size(); ++e) {
      EXPECT_EQ(whole.events()[e].energy, resumed.events()[e].energy);
      EXPECT_EQ(whole.events()[e].mode_mix, resumed.events()[e].mode_mix);
    }
  }

  const auto stage = column(whole, "stage"), fracture = column(whole, "fracture");
  double of_stage[2] = {0, 0};
  for (std::size_t k = 0; k < stage.size(); ++k) {
    double& largest = of_stage[static_cast<int>(stage[k])];
    EXPECT_GE(fracture[k], largest) << k;
    largest = fracture[k];
  }
  const auto second = std::find(stage.begin(), stage.end(), 1) - stage.begin();
  EXPECT_EQ(fracture.at(second), 0) << "a stage books what it dissipates itself";
  EXPECT_EQ(column(whole, "broken_links").at(second), 0);
  ASSERT_EQ(whole.events().size(), 5u);
  EXPECT_GT(of_stage[0], 0.05);
  EXPECT_NEAR(of_stage[0] + of_stage[1], 0.3, 1e-9);  // J/m, of a wall of 1 m: opening alone
  double booked = 0;
  for (const Event& event : whole.events()) booked += event.energy;
  EXPECT_NEAR(booked, 0.3, 1e-9);
  int softening = 0;
  for (int f = 0; f < whole.frames(); ++f) {
    const ArraySet arrays = whole.frame(f).arrays;
    for (const double d : arrays.doubles("link_damage")) {
      EXPECT_TRUE(d >= 0 && d <= 1) << d;
      softening += d > 0;
    }
  }
  EXPECT_GT(softening, 5);
}

TEST(StageRun, a_break_between_two_rows_has_the_step_and_the_strain_of_its_own_time) {
  const TemporaryFolder folder;
  const Sample squares = two_bonded_squares(4);
  for (const std::string stepper : {"velocity_verlet", "backward_euler", "generalised_alpha"}) {
    Scene scene = torn();
    scene.stages[0].loading->strain = 0.05;
    for (Stage& stage : scene.stages) {
      stage.run.stepper = stepper, stage.output.response = 5;  // few rows: a break is far from the next
      stage.run.time_step = stepper == "velocity_verlet" ? 1e-3 : 0.02;
    }
    TrajectoryWriter writer(folder / stepper, squares, {});
    simulate(squares, scene, writer, {});
    const TrajectoryReader reader(folder / stepper);
    ASSERT_EQ(reader.events().size(), 5u) << stepper;
    const double dt = 5.0 / std::round(5.0 / *scene.stages[0].run.time_step);  // the stage takes 5 s
    for (const Event& event : reader.events()) {
      EXPECT_NEAR(static_cast<double>(event.step) * dt, event.time, 1e-9) << stepper;
      EXPECT_NEAR(event.strain, 0.01 * event.time, 1e-9) << stepper;
      EXPECT_GT(std::abs(event.time - std::round(event.time)), dt) << stepper << ": on a row, the test says nothing";
    }
  }
}

/// A ring in a box whose lid comes down, and goes up again.
Scene pressed(const std::vector<std::string>& settings) {
  return parse_scene(R"(
[sample]
kind = "shapes"
[[sample.shapes]]
kind = "ring"
size = 1
segments = 20
[[sample.shapes]]
kind = "plate"
group = "held"
from = [-2, -1.3]
to = [2, -1.3]
segments = 1
[[sample.shapes]]
kind = "plate"
group = "held"
from = [-1.6, -1.2]
to = [-1.6, 1.5]
segments = 1
[[sample.shapes]]
kind = "plate"
group = "held"
from = [1.6, -1.2]
to = [1.6, 1.5]
segments = 1
[[sample.shapes]]
kind = "plate"
group = "lid"
from = [-1.4, 1.3]
to = [1.4, 1.3]
segments = 1
[cells]
axial_rigidity = 100
bending_rigidity = 1
mass_per_length = 1
radius = 0.1
[contact]
normal_stiffness = 1000
[drag]
rate = 1
[[loads]]
name = "held"
nodes = { group = "held" }
velocity_x = 0
velocity_y = 0
[[loads]]
name = "lid"
nodes = { group = "lid" }
velocity_x = 0
velocity_y = -0.2
[stop]
time = 6
void_ratio = 1e-6
[output]
frames = 10
response = 300
[[stages]]
name = "down"
[[stages]]
name = "up"
remove = ["stop.void_ratio"]
stop.compaction = 0
[[stages.loads]]
name = "lid"
velocity_y = 0.2
)",
                     "pressed", settings);
}

Sample pressed_ring() {
  Sample sample;
  std::vector<Vec2> circle;
  for (int k = 0; k < 20; ++k) circle.emplace_back(std::cos(M_PI * k / 10), std::sin(M_PI * k / 10));
  add_cell(sample, circle, true, 0.1, "cells");
  for (const auto& [from, to] : std::vector<std::pair<Vec2, Vec2>>{
           {{-2, -1.3}, {2, -1.3}}, {{-1.6, -1.2}, {-1.6, 1.5}}, {{1.6, -1.2}, {1.6, 1.5}}})
    add_cell(sample, {from, to}, false, 0.1, "held");
  add_cell(sample, {{-1.4, 1.3}, {1.4, 1.3}}, false, 0.1, "lid");
  sample.tile_area = sample.rest_area;
  sample.box = {{-2, -2}, {2, 2}};
  return sample;
}

RunFacts run_to(const std::filesystem::path& path, const Scene& scene) {
  const Sample sample = pressed_ring();
  TrajectoryWriter writer(path, sample, {});
  return simulate(sample, scene, writer, {});
}

TEST(StageRun, ends_where_a_load_exerts_more_than_asked) {
  const TemporaryFolder folder;
  run_to(folder / "t", pressed({"loads.lid.stop_force=0.5", "stages.up.stop.time=0.1"}));
  const TrajectoryReader reader(folder / "t");
  const auto stage = column(reader, "stage"), force = column(reader, "force_y_lid"),
             moved = column(reader, "moved_y_lid");
  const auto last = static_cast<std::size_t>(std::find(stage.begin(), stage.end(), 1) - stage.begin()) - 1;
  for (std::size_t k = 0; k + 1 < last; ++k) EXPECT_LE(-force[k], 0.5) << k;
  EXPECT_GT(-force[last], 0.5);
  // The gap is 0.1 above and below; touch shows soon after.
  EXPECT_LT(moved[last], -0.1);
  EXPECT_GT(moved[last], -0.35);
}

TEST(StageRun, ends_at_a_compaction_and_where_it_is_taken_back) {
  const TemporaryFolder folder;
  const RunFacts facts = run_to(folder / "t", pressed({"stages.down.stop.compaction=0.25"}));
  EXPECT_EQ(facts.ended.find("compaction"), 0u) << facts.ended;
  const TrajectoryReader reader(folder / "t");
  const auto stage = column(reader, "stage"), moved = column(reader, "moved_y_lid");
  const auto turn = static_cast<std::size_t>(std::find(stage.begin(), stage.end(), 1) - stage.begin()) - 1;
  EXPECT_NEAR(moved[turn], -0.25 * 2.4, 0.2 * 2 * 6 / 300);  // one row at most
  EXPECT_NEAR(moved.back(), 0, 0.2 * 2 * 6 / 300);
}

TEST(StageRun, ends_below_a_void_ratio) {
  const TemporaryFolder folder;
  run_to(folder / "t", pressed({"stages.down.stop.void_ratio=0.7", "stages.up.stop.time=0.1"}));
  const TrajectoryReader reader(folder / "t");
  const auto at = [&](int frame) {
    std::vector<Vec2> x;
    const auto rows = reader.frame(frame).arrays.doubles("x");
    for (std::size_t i = 0; i < rows.size(); i += 2) x.emplace_back(rows[i], rows[i + 1]);
    return void_ratio(reader.sample(), x, *room_between_walls(reader.sample(), x));
  };
  int last = 0;  // of the first stage
  while (reader.frame(last + 1).stage == 0) ++last;
  EXPECT_GT(at(last - 1), 0.7);
  EXPECT_LT(at(last), 0.7);
  EXPECT_GT(at(last), 0.68);
}

TEST(StageRun, a_run_that_loosens_again_resumes_to_the_same_bits) {
  const TemporaryFolder folder;
  const Scene scene = pressed({"stages.down.stop.compaction=0.1"});
  run_to(folder / "whole", scene);
  {
    const Sample sample = pressed_ring();
    TrajectoryWriter writer(folder / "cut", sample, {});
    std::atomic<bool> stop = false;
    SimulateOptions options;
    options.interrupted = &stop;
    options.progress = [&](const RunProgress& now) { stop = now.stage == 1 && now.time > 1.9; };
    EXPECT_TRUE(simulate(sample, scene, writer, options).interrupted);
  }
  resume(folder / "cut", {});
  EXPECT_EQ(TrajectoryReader(folder / "whole").response().rows, TrajectoryReader(folder / "cut").response().rows);
}

TEST(StageRun, room_between_walls_needs_walls) {
  const TemporaryFolder folder;
  const Sample ring = ring_sample(20);
  for (const char* key : {"compaction", "void_ratio"}) {
    Scene scene = inflated(0.4);
    (std::string(key) == "compaction" ? scene.stages[0].stop.compaction : scene.stages[0].stop.void_ratio) = 0.1;
    TrajectoryWriter writer(folder / key, ring, {});
    EXPECT_THROW(simulate(ring, scene, writer, {}), SceneError);
  }
}

}  // namespace
}  // namespace lamella
