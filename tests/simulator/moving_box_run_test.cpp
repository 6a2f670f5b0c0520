// Whole runs of samples that repeat both ways, their box pulled: ledger, schemes beside each other, restarts, ends.
#include "simulator/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "simulator/trajectory/extract.h"
#include "tests/simulator/torus.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

struct Ran {
  RunFacts facts;
  Response response;
  std::vector<Event> events;
  ArraySet last;
  std::vector<double> column(const std::string& name) const {
    const auto at = std::find(response.columns.begin(), response.columns.end(), name) - response.columns.begin();
    std::vector<double> out;
    for (const auto& row : response.rows) out.push_back(row.at(static_cast<std::size_t>(at)));
    return out;
  }
};

Ran read(const std::filesystem::path& path, const RunFacts& facts) {
  const TrajectoryReader reader(path);
  return {facts, reader.response(), reader.events(), reader.frame(reader.frames() - 1).arrays};
}

Ran ran(const Sample& sample, const Scene& scene) {
  const TemporaryFolder folder;
  TrajectoryWriter writer(folder / "run", sample, {});
  const RunFacts facts = simulate(sample, scene, writer, {});
  return read(folder / "run", facts);
}

TEST(MovingBoxRun, at_rest_ends_separated_and_keeps_its_ledger) {
  const Sample s = varied(torus(4, 4));
  for (const std::string axis : {"x", "y"}) {
    const Ran run = ran(s, scene_of({"loading.axis=\"" + axis + "\"", "run.load_steps=400"}));
    EXPECT_EQ(run.facts.ended, "separated: no path of shells and intact links goes round the box along " + axis);
    EXPECT_LT(run.facts.residual, 5e-3);
    const auto stress = run.column("stress");
    const double peak = *std::max_element(stress.begin(), stress.end());
    EXPECT_GT(peak, 1);
    EXPECT_LT(std::abs(stress.back()), 0.02 * peak);
    EXPECT_EQ(run.column("force_a"), run.column("force_b"));
    // The frame says how large the box is.
    const int c = axis == "x" ? 0 : 1;
    EXPECT_NEAR(run.last.doubles("box_size").at(c), s.box.size()[c] * (1 + run.column("strain").back()), 1e-12);
  }
}

TEST(MovingBoxRun, in_time_keeps_its_ledger_to_second_order) {
  const Sample s = torus(2, 2);
  const auto open = [&](double step, const std::string& more) {
    return ran(s, scene_of({"run.stepper=\"velocity_verlet\"", "loading.strain=0.05", "loading.ramp_strain=0.01",
                            "loading.strain_rate=0.1", "links.normal_strength=1e6", "links.tangential_strength=1e6",
                            fmt::format("run.time_step={}", step), more}))
        .facts.residual;
  };
  for (const std::string more : {"drag.rate=0.5", "cells.bar_dashpot=0.2"}) {
    const double coarse = open(2e-3, more), fine = open(1e-3, more);
    EXPECT_LT(coarse, 2e-3) << more;
    EXPECT_LT(fine, 0.35 * coarse) << more;
  }
}

TEST(MovingBoxRun, in_time_is_torn_with_its_ledger_closed) {
  const Sample s = varied(torus(4, 4));
  for (const std::string more : {"drag.rate=0.5", "contact.damping=0.3"}) {
    const Ran run = ran(s, scene_of({"run.stepper=\"velocity_verlet\"", "loading.strain_rate=0.2",
                                     "loading.ramp_strain=0.01", "loading.strain=1.5", more}));
    EXPECT_EQ(run.facts.ended.substr(0, 9), "separated") << more;
    EXPECT_LT(run.facts.residual, 5e-3) << more;
    EXPECT_GT(run.events.size(), 5u) << more;
  }
}

TEST(MovingBoxRun, whose_walls_break_keeps_its_ledger_at_rest_and_in_time) {
  const Sample s = torus(2, 2);
  for (const std::string scheme : {"quasi_static", "velocity_verlet"}) {
    std::vector<std::string> settings = {"run.stepper=\"" + scheme + "\"", "cells.break_force=4",
                                         "links.normal_strength=1e6", "links.tangential_strength=1e6"};
    if (scheme != "quasi_static")
      for (const char* more : {"loading.strain_rate=0.2", "loading.ramp_strain=0.01", "drag.rate=0.5"})
        settings.push_back(more);
    const Ran run = ran(s, scene_of(settings));
    EXPECT_LT(run.facts.residual, 1e-2) << scheme;
    EXPECT_GT(run.column("broken_bars").back(), 1) << scheme;
  }
}

// Slow against all swings, and damped: the stress is that at rest, and so is what the box does across.
TEST(MovingBoxRun, in_slow_time_is_as_at_rest) {
  const Sample s = torus(2, 2);
  for (const std::string across : {"true", "false"}) {
    const std::vector<std::string> same = {"loading.strain=0.02", "links.normal_strength=1e6",
                                           "links.tangential_strength=1e6", "loading.normal_only=" + across};
    auto slow = same, fine = same;
    fine.push_back("run.residual=1e-8");
    for (const char* more : {"run.stepper=\"velocity_verlet\"", "loading.strain_rate=0.001", "drag.rate=0.5",
                             "output.response=40", "loading.ramp_strain=0.002"})
      slow.push_back(more);
    const Ran rest = ran(s, scene_of(fine)), time = ran(s, scene_of(slow));
    // The last row but one: then the box stops at once, which the cells feel.
    const std::size_t last = time.column("strain").size() - 2;
    EXPECT_NEAR(time.column("strain")[last] / rest.column("strain").back(), 1, 1e-9);
    EXPECT_NEAR(time.column("stress")[last] / rest.column("stress").back(), 1, 4e-3);
    for (int c = 0; c < 2; ++c)
      EXPECT_NEAR(time.last.doubles("box_size").at(c) - rest.last.doubles("box_size").at(c), 0, 2e-5);
  }
}

// The same swing by schemes that share no code but the terms'.
TEST(MovingBoxRun, in_time_swings_alike_by_explicit_and_by_implicit_steps) {
  const Sample s = torus(2, 2);
  const auto swing = [&](const std::string& scheme, double step) {
    const Ran run =
        ran(s, scene_of({"run.stepper=\"" + scheme + "\"", "loading.strain=0.03", "loading.strain_rate=0.03",
                         "links.normal_strength=1e6", "links.tangential_strength=1e6", "run.residual=1e-9",
                         "output.response=20", fmt::format("run.time_step={}", step)}));
    return run.last.doubles("box_size").at(0) - s.box.size().x();
  };
  const double exact = swing("velocity_verlet", 5e-4);
  EXPECT_LT(exact, -1e-3);
  EXPECT_NEAR(swing("generalised_alpha", 2.5e-3) / exact, 1, 0.01);
  EXPECT_NEAR(swing("backward_euler", 2.5e-3) / exact, 1, 0.1);
}

TEST(MovingBoxRun, in_time_tears_alike_wherever_it_begins_and_on_any_number_of_threads) {
  const Sample s = varied(torus(4, 4));
  const std::vector<std::string> settings = {"run.stepper=\"velocity_verlet\"", "loading.strain_rate=0.3",
                                             "loading.strain=0.1", "drag.rate=0.3"};
  auto parallel = settings;
  parallel.push_back("run.threads=3");
  Sample away = s;
  for (Vec2& p : away.x) p += Vec2(1.7, -0.9);
  const Ran one = ran(s, scene_of(settings)), other = ran(away, scene_of(settings)), team = ran(s, scene_of(parallel));
  ASSERT_GT(one.events.size(), 3u);
  ASSERT_EQ(one.events.size(), other.events.size());
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(one.events[k].link, other.events[k].link);
  const auto stress = one.column("stress"), there = other.column("stress");
  const double peak = *std::max_element(stress.begin(), stress.end());
  for (std::size_t k = 0; k < stress.size() / 2; ++k) EXPECT_NEAR(stress[k], there[k], 1e-6 * peak);
  EXPECT_EQ(one.response.rows, team.response.rows);
  EXPECT_EQ(one.last.doubles("x"), team.last.doubles("x"));
}

TEST(MovingBoxRun, interrupted_resumes_to_the_same_bits) {
  const Sample s = varied(torus(4, 4));
  for (const std::string scheme : {"quasi_static", "velocity_verlet", "backward_euler", "generalised_alpha"}) {
    std::vector<std::string> settings = {"run.stepper=\"" + scheme + "\"", "loading.strain=0.15"};
    if (scheme != "quasi_static") settings.push_back("loading.strain_rate=0.2"), settings.push_back("drag.rate=1");
    const Scene scene = scene_of(settings);
    const TemporaryFolder folder;
    const Ran whole = ran(s, scene);
    std::atomic<bool> stop = false;
    SimulateOptions options;
    options.interrupted = &stop;
    options.progress = [&](const RunProgress& now) { stop = now.broken > 4; };
    TrajectoryWriter writer(folder / "cut", s, {});
    EXPECT_TRUE(simulate(s, scene, writer, options).interrupted) << scheme;
    const Ran resumed = read(folder / "cut", resume(folder / "cut", {}));
    EXPECT_EQ(whole.response.rows, resumed.response.rows) << scheme;
    EXPECT_GT(whole.events.size(), 5u) << scheme;
    EXPECT_EQ(whole.events.size(), resumed.events.size()) << scheme;
    EXPECT_EQ(whole.last.doubles("x"), resumed.last.doubles("x")) << scheme;
    EXPECT_EQ(whole.last.doubles("box_size"), resumed.last.doubles("box_size")) << scheme;
  }
}

TEST(MovingBoxRun, a_frame_of_it_is_a_sample_whose_box_is_as_large_and_whose_links_hold_as_much) {
  const Sample s = varied(torus(4, 4));
  const Scene scene = scene_of({"loading.strain=0.1"});
  const TemporaryFolder folder;
  TrajectoryWriter writer(folder / "run", s, {});
  const Ran run = read(folder / "run", simulate(s, scene, writer, {}));
  const Sample frame = extract_sample(TrajectoryReader(folder / "run"), -1);
  ASSERT_LT(frame.links.size(), s.links.size());
  ASSERT_EQ(frame.link_image.size(), frame.links.size());
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(frame.box.size()[c], run.last.doubles("box_size").at(c), 1e-12);
  const auto model = build_model(frame, scene.stages[0], field_of(frame.x));
  EXPECT_NEAR(model->links->energy(field_of(frame.x)) / run.column("energy_links").back(), 1, 1e-9);
}

TEST(MovingBoxRun, a_stage_that_does_not_pull_holds_the_box_where_it_is) {
  const Scene scene = parse_scene(scene_of().text + R"(
[[stages]]
name = "pull"
loading.strain = 0.02
[[stages]]
name = "rest"
remove = ["loading", "stop.separated"]
run.stepper = "velocity_verlet"
stop.time = 0.5
)",
                                  "torus", {});
  const Sample s = torus(2, 2);
  const Ran run = ran(s, scene);
  EXPECT_NEAR(run.last.doubles("box_size").at(1) / s.box.size().y(), 1.02, 1e-12);
  EXPECT_LT(run.last.doubles("box_size").at(0), s.box.size().x());
  EXPECT_LT(run.column("kinetic").back(), 1e-9);
}

}  // namespace
}  // namespace lamella
