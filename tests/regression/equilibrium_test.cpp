// Equilibria and first breaks without time: against beams, the elastica and lap joints.
#include "pipelines/studies/equilibrium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "generator/generate.h"
#include "generator/sample/errors.h"
#include "pipelines/studies/facing_chains.h"
#include "pipelines/studies/study.h"

namespace lamella {
namespace {

/// Tip of the cantilever of pipelines/beams with n segments under a dead load of 1 in the scene's unit.
Vec2 tip_of_cantilever(int n, double load, const std::string& axial_rigidity) {
  const Scene scene =
      read_scene(LAMELLA_SOURCE_DIR "/pipelines/beams/cantilever.toml",
                 {"sample.shapes.0.segments=" + std::to_string(n), "cells.axial_rigidity=" + axial_rigidity,
                  "loads.weight.force_y=" + std::to_string(-load)});
  const Sample sample = sample_of(scene);
  const Field rest = field_of(sample.x);
  const auto model = build_model(sample, scene.stages.front(), rest);
  const Equilibrium found = find_equilibrium(*model, build_loads(sample, scene.stages.front()), 1, rest);
  EXPECT_LT(found.unbalanced, 1e-6 * load);
  return found.x.at(found.x.size() - 1);
}

TEST(Equilibrium, of_a_cantilever_bends_as_the_closed_form_of_the_discrete_beam) {
  for (int n : {4, 16})
    EXPECT_NEAR(-tip_of_cantilever(n, 1e-3, "1000").y() / (1e-3 / 3) / (1 + 0.5 / (n * n)), 1, 1e-6) << n;
}

TEST(Equilibrium, under_large_loads_is_the_elastica) {
  const Vec2 tip = tip_of_cantilever(10, 5, "1e7");  // P L^2 / EI = 5, physics 2a
  EXPECT_NEAR(tip.x(), .610980, 1e-6);
  EXPECT_NEAR(-tip.y(), .717018, 1e-6);
}

/// Two chains of bars with tangential links, kept straight.
struct Lap {
  explicit Lap(int links) : chains{.segments = links - 1}, sample(make_facing_chains(chains)) {
    stage.cells["cells"].thickness = 0.1;
    stage.cells["cells"].axial_rigidity = 1;
    stage.cells["cells"].bending_rigidity = 0;
    stage.cells["cells"].mass_per_length = 1;
    LinkScene& scene = stage.links["links"];
    scene.per = "link";
    scene.normal_stiffness = 1, scene.tangential_stiffness = 0.1;
    scene.normal_strength = scene.tangential_strength = 1e-3;
    Load straight;
    straight.holds[1] = true;
    for (Index i = 0; i < sample.nodes(); ++i) straight.nodes.push_back(i);
    Load hold, pull;
    hold.nodes = {lower_node(chains, 0)};
    hold.holds[0] = true;
    pull.nodes = {upper_node(chains, chains.segments)};
    pull.pushes = true;
    pull.force = {Vec2(1, 0)};
    loads = {straight, hold, pull};
  }
  StaticBreak first_break() const {
    const Field rest = field_of(sample.x);
    return find_first_break(*build_model(sample, stage, rest), loads, rest, 1e-4);
  }
  FacingChains chains;
  Sample sample;
  Stage stage;
  std::vector<Load> loads;
};

TEST(FirstBreak, of_a_lap_joint_is_that_of_the_closed_form_at_either_end) {
  for (const auto& [n, exact] : {std::pair(2, 2.0), std::pair(5, 4.253521), std::pair(20, 5.580572)}) {
    const StaticBreak found = Lap(n).first_break();
    EXPECT_NEAR(found.factor / 1e-3 / exact, 1, 1e-6) << n;
    EXPECT_NEAR(std::abs(found.force.tangential), 1e-3, 1e-12);
    EXPECT_TRUE(found.link == 0 || found.link == n - 1);
  }
}

TEST(FirstBreak, is_the_same_whether_the_end_is_pulled_or_moved) {
  Lap lap(5);
  const StaticBreak pulled = lap.first_break();
  const Index end = lap.loads[2].nodes[0];
  lap.loads[2].pushes = false, lap.loads[2].holds[0] = true;
  lap.loads[2].velocity = Vec2(1, 0);
  EXPECT_NEAR(lap.first_break().factor / (pulled.x.x[end] - lap.sample.x[end].x()), 1, 1e-9);
}

TEST(FirstBreak, is_none_where_no_load_reaches_a_link) {
  Lap lap(3);
  lap.loads[2].force = {Vec2(0, 0)};
  EXPECT_THROW(lap.first_break(), SolverError);
}

TEST(Equilibrium, is_none_of_a_chain_that_nothing_holds) {
  Lap lap(3);
  lap.loads.erase(lap.loads.begin() + 1);
  EXPECT_THROW(lap.first_break(), SolverError);
}

TEST(FacingChains, make_a_sample_that_holds_all_invariants) {
  EXPECT_TRUE(
      check_sample(make_facing_chains({.segments = 12, .first_link = 4, .spacing = 0.5, .radius = 0.02})).empty());
  EXPECT_TRUE(check_sample(make_facing_chains({})).empty());
}

}  // namespace
}  // namespace lamella
