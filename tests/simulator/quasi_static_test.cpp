// Equilibria, the loads of breaks, avalanches and the ledger of the stepper at rest: against closed forms and against itself.
#include "simulator/steppers/quasi_static.h"

#include <cmath>
#include <random>

#include "generator/sample/errors.h"
#include "tests/simulator/static_rig.h"
#include "tests/simulator/tissues.h"
#include "tests/support/samples.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

Load held(std::vector<Index> nodes, bool x, bool y) {
  Load load;
  load.nodes = std::move(nodes);
  load.holds[0] = x, load.holds[1] = y;
  return load;
}

/// A tissue whose lowest cells are held, and whose highest go up by `way` in a time of 1.
struct PulledTissue {
  explicit PulledTissue(double strength, int segments = 2) : sample(hexagons(4, 4, segments, 0.05)) {
    stage.cells["cells"] = cell_scene(400.0, 0.5, 1.0);
    stage.links["links"] = link_scene("length", 800.0, 300.0, strength);
  }
  std::vector<Load> loads(double way) const {
    return {moving_cells(sample, {0, 1, 2, 3}, Vec2(0, 0)), moving_cells(sample, {12, 13, 14, 15}, Vec2(0, way))};
  }
  Sample sample;
  Stage stage;
};

TEST(QuasiStatic, bars_in_series_share_the_way) {
  Sample chain = chain_sample(4);
  Stage stage;
  stage.cells["cells"] = cell_scene(8.0, 1.0, 1.0);
  const double l = chain.rest_length[0];
  Load pull = held({4}, true, true);
  pull.velocity = 0.1 * (chain.x[4] - chain.x[0]);
  StaticRig rig(chain, stage, {held({0}, true, true), pull});
  rig.run();
  for (Index i = 0; i < 4; ++i)
    EXPECT_NEAR((rig.stepper->x().at(i + 1) - rig.stepper->x().at(i)).norm(), 1.1 * l, 1e-4 * l);
  EXPECT_NEAR(rig.stepper->load_forces()[1].norm(), 8.0 * 0.1, 1e-4);
  EXPECT_NEAR(rig.stepper->works().loads, rig.energy(), 1e-3 * rig.energy());
}

TEST(QuasiStatic, equilibrium_is_a_minimum_against_every_other_search) {
  const PulledTissue tissue(1e9);
  StaticRig rig(tissue.sample, tissue.stage, tissue.loads(0.6), {.residual = 1e-10, .longest = 0.1});
  rig.run();
  // Straight to the end, without the way there.
  EquilibriumSolver fresh(*rig.model, rig.loads);
  Field x = field_of(tissue.sample.x);
  for (Index c : {12, 13, 14, 15})
    for (Index i = tissue.sample.cell_begin[c]; i < tissue.sample.cell_begin[c + 1]; ++i) x.y[i] += 0.6;
  ASSERT_TRUE(fresh.relax(x, 1e-10));
  double apart = 0;
  for (std::size_t i = 0; i < x.size(); ++i) apart = std::max(apart, (x.at(i) - rig.stepper->x().at(i)).norm());
  EXPECT_LT(apart, 1e-8);
}

TEST(QuasiStatic, links_break_at_their_criterion_and_none_is_left_beyond_it) {
  const PulledTissue tissue(6.0);
  StaticRig rig(tissue.sample, tissue.stage, tissue.loads(1.5));
  LinkForces work;
  std::size_t breaks = 0;
  while (rig.stepper->time() < 1) {
    rig.stepper->load_towards(1, [] { return true; });
    if (!rig.stepper->critical()) continue;
    // The load of a break is exact, ...
    EXPECT_NEAR(rig.model->links->most_loaded(rig.stepper->x(), work).zeta, 0, 1e-4);
    rig.stepper->fall([] { return true; });
    const auto now = rig.stepper->take_breaks();
    for (std::size_t k = 0; k < now.size(); ++k) {
      EXPECT_EQ(now[k].place, static_cast<std::int64_t>(k));
      EXPECT_GE(now[k].released, -1e-9);
    }
    breaks += now.size();
    // ... and after the avalanche all hold.
    EXPECT_LE(rig.model->links->most_loaded(rig.stepper->x(), work).zeta, 0);
  }
  EXPECT_GT(breaks, 10u);
  EXPECT_EQ(static_cast<Index>(breaks), rig.model->links->broken());
}

double ledger_residual(double strength, double longest) {
  const PulledTissue tissue(strength);
  StaticRig rig(tissue.sample, tissue.stage, tissue.loads(1.5),
                {.residual = 1e-9, .load_tolerance = 1e-6, .longest = longest});
  rig.run();
  const StaticWorks& w = rig.stepper->works();
  EXPECT_EQ(w.fracture > 0 && w.released > 0, strength < 1e6);
  return std::abs(w.loads - rig.energy() - w.fracture - w.released) / w.loads;
}

/// A tissue of 10 x 8 hexagons whose lowest row is held, and whose highest goes up.
StaticRig torn(const Sample& sample, double strength, double way) {
  Stage stage;
  stage.cells["cells"] = cell_scene(400.0, 0.5, 1.0);
  stage.links["links"] = link_scene("length", 800.0, 300.0, strength);
  std::vector<Index> low, high;
  for (Index c = 0; c < 10; ++c) low.push_back(c), high.push_back(70 + c);
  return StaticRig(sample, stage, {moving_cells(sample, low, Vec2(0, 0)), moving_cells(sample, high, Vec2(0, way))},
                   {.residual = 1e-6});
}

TEST(QuasiStatic, a_factor_that_is_made_anew_in_part_tears_the_same_links_at_the_same_loads) {
  Sample sample = hexagons(10, 8, 3, 0.05);
  std::mt19937 random(3);  // one link in ten is missing, so that no two are alike
  std::erase_if(sample.links, [&](const Link&) { return random() % 10 == 0; });
  const auto tear = [&](bool all_anew) {
    StaticRig rig = torn(sample, 20, 2.5);
    while (rig.stepper->time() < 1 && rig.stepper->over().empty()) {
      rig.stepper->load_towards(1, [] { return true; });
      if (rig.stepper->critical()) rig.stepper->fall([] { return true; });
      if (all_anew) rig.stepper->forget();
    }
    return std::pair{rig.stepper->take_breaks(), rig.stepper->solver().cost()};
  };
  const auto [breaks, cost] = tear(false);
  const auto [oracle, whole] = tear(true);
  EXPECT_GT(cost.partial_factorizations, cost.factorizations);
  EXPECT_GT(whole.factorizations, 3 * cost.factorizations);
  ASSERT_EQ(breaks.size(), oracle.size());
  ASSERT_GT(breaks.size(), 60u);
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    EXPECT_EQ(breaks[k].link.link, oracle[k].link.link);
    EXPECT_NEAR(breaks[k].time, oracle[k].time, 1e-3);
  }
}

TEST(QuasiStatic, the_ledger_closes_to_second_order_in_the_load_step) {
  const double whole = ledger_residual(1e9, 0.1), broken = ledger_residual(6, 0.0125);
  EXPECT_LT(whole, 2e-3);
  EXPECT_LT(ledger_residual(1e9, 0.025), whole / 15);
  EXPECT_LT(broken, 2e-3);
  EXPECT_LT(ledger_residual(6, 0.003125), broken / 12);
}

TEST(QuasiStatic, links_that_break_at_once_are_fewer_equilibria_than_one_after_the_other) {
  // Two stiff cells with five equal links, pulled apart by a dead force across their wall.
  const Sample pair = hexagons(2, 1, 4, 0.05);
  Stage stage;
  stage.cells["cells"] = cell_scene(1e4, 1e3, 1.0);
  stage.links["links"] = link_scene("link", 1.0, 1.0, 1e-3);
  Load pull;
  pull.name = "pull";
  for (Index i = pair.cell_begin[1]; i < pair.cell_begin[2]; ++i) pull.nodes.push_back(i);
  pull.pushes = pull.pushes_along[0] = pull.pushes_along[1] = true;
  const double nodes = static_cast<double>(pull.nodes.size());
  pull.force.assign(pull.nodes.size(), 5e-3 / 0.75 / nodes * Vec2(std::cos(M_PI / 3), std::sin(M_PI / 3)));
  pull.ramp = 1;
  std::int64_t searches[2];
  for (const bool at_once : {false, true}) {
    StaticRig rig(pair, stage, {moving_cells(pair, {0}, Vec2(0, 0)), pull}, {.all_at_once = at_once});
    rig.run();
    searches[at_once ? 1 : 0] = rig.stepper->solver().cost().searches;
    const auto breaks = rig.stepper->take_breaks();
    ASSERT_EQ(breaks.size(), 5u);
    EXPECT_EQ(breaks.back().place, 4);
    EXPECT_EQ(rig.stepper->over(), "nothing holds load 'pull' any more");
    // Five links of strength 1e-3 hold three quarters of the force.
    EXPECT_NEAR(smooth_ramp(breaks.front().time), 0.75, 2e-4);
  }
  EXPECT_LT(searches[1], searches[0]);
}

TEST(QuasiStatic, a_dead_load_that_nothing_holds_ends_the_stage) {
  const PulledTissue tissue(6.0);
  Load pull;
  pull.name = "pull";
  for (Index c : {12, 13, 14, 15})
    for (Index i = tissue.sample.cell_begin[c]; i < tissue.sample.cell_begin[c + 1]; ++i) pull.nodes.push_back(i);
  pull.pushes = pull.pushes_along[1] = true;
  pull.force.assign(pull.nodes.size(), Vec2(0, 1));
  pull.ramp = 1;
  StaticRig rig(tissue.sample, tissue.stage, {moving_cells(tissue.sample, {0, 1, 2, 3}, Vec2(0, 0)), pull});
  rig.run();
  EXPECT_EQ(rig.stepper->over(), "nothing holds load 'pull' any more");
  EXPECT_LT(rig.stepper->time(), 1);
}

TEST(QuasiStatic, walls_that_flow_carry_their_yield_force_and_keep_their_length) {
  Sample chain = chain_sample(4);
  Stage stage;
  stage.cells["cells"] = cell_scene(8.0, 1.0, 1.0);
  stage.cells["cells"].yield_force = 0.4;  // at strain 0.05
  stage.cells["cells"].yield_moment = 1e9;
  Load pull = held({4}, true, true);
  pull.velocity = 0.1 * (chain.x[4] - chain.x[0]);
  StaticRig rig(chain, stage, {held({0}, true, true), pull});
  rig.run();
  EXPECT_NEAR(rig.stepper->load_forces()[1].norm(), 0.4, 1e-9);
  const double length = (chain.x[4] - chain.x[0]).norm();
  EXPECT_NEAR(rig.model->plastic_dissipated(), 0.4 * 0.05 * length, 1e-6 * length);
  EXPECT_NEAR(rig.energy(), 0.5 * 0.4 * 0.05 * length, 1e-6 * length);
}

TEST(QuasiStatic, a_wall_breaks_at_its_strength_and_books_what_it_held) {
  // A ring under pressure bursts; then it is a chain without pressure.
  const Sample ring = ring_sample(20);
  Stage stage;
  stage.cells["cells"] = cell_scene(100.0, 1.0, 1.0);
  stage.cells["cells"].break_force = 2;
  stage.cells["cells"].core.emplace().drained = true;
  const std::vector<Vec2> history{{0, 0}, {1, 4}};
  stage.cells["cells"].core->pressure_history = history;
  StaticRig rig(ring, stage, {held({0}, true, true), held({10}, false, true)});
  rig.run();
  const auto breaks = rig.stepper->take_breaks();
  ASSERT_EQ(breaks.size(), 1u);
  EXPECT_EQ(breaks[0].link.link, -1);
  EXPECT_NEAR(breaks[0].wall.tension, 2, 2e-3);
  // A node is pushed by p l cos(pi / 20) and held by 2 T sin(pi / 20), l being a bar's length under T.
  const double length = ring.rest_length[0] * (1 + 2.0 / 100);
  EXPECT_NEAR(4 * breaks[0].time, 2 * 2 * std::tan(M_PI / 20) / length, 1e-3);
  const StaticWorks& w = rig.stepper->works();
  EXPECT_GT(w.fracture, 0);
  EXPECT_NEAR((w.loads + w.pressure - rig.energy() - w.fracture - w.released) / w.released, 0, 1e-2);
  EXPECT_LT(rig.energy(), 1e-3 * w.released);  // nothing holds it any more
}

TEST(QuasiStatic, gives_up_with_load_node_and_reason) {
  // Walls that flow at 1 hold a pressure of 1 / R, and no more.
  const Sample ring = ring_sample(20);
  Stage stage;
  stage.cells["cells"] = cell_scene(100.0, 1.0, 1.0);
  stage.cells["cells"].yield_force = 1;
  stage.cells["cells"].yield_moment = 1e9;
  stage.cells["cells"].core.emplace().drained = true;
  const std::vector<Load> loads{held({0}, true, true), held({10}, false, true)};
  stage.cells["cells"].core->pressure = 0.9;
  EXPECT_NO_THROW(StaticRig(ring, stage, loads));
  stage.cells["cells"].core->pressure = 1.2;
  try {
    const StaticRig rig(ring, stage, loads);
    ADD_FAILURE() << "an equilibrium that cannot be was found";
  } catch (const SolverError& error) {
    for (const char* part : {"t = 0 s", "no equilibrium to start from", "internal force", "on node"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lamella
