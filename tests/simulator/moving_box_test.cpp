// Samples that repeat both ways, their box pulled (moving_box.h): forces on the box's lengths are derivatives of the energy by them, and nothing
// depends on where the box begins, on which image of a cell is at home, or on how many periods the box holds.
#include "simulator/moving_box.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <optional>

#include "generator/sample/errors.h"
#include "generator/sample/way_round.h"
#include "simulator/loads.h"
#include "simulator/simulate.h"
#include "simulator/steppers/quasi_static.h"
#include "simulator/steppers/stable_time_step.h"
#include "simulator/stop_conditions.h"
#include "tests/simulator/tissues.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

Sample torus(int rows = 2, int columns = 2, int segments = 2) {
  return hexagons(rows, columns, segments, 0.1, {true, true});
}

Stage stage_of(std::optional<double> strength = {}, double friction = 0) {
  Stage stage;
  stage.cells["cells"] = cell_scene(400, 0.5, 1);
  stage.links["links"] = link_scene("length", 800, 300, strength);
  stage.contact = ContactScene{};
  stage.contact->friction = friction;
  stage.drag = DragScene{0.5};
  return stage;
}

Stage softening(double strength, double toughness) {
  Stage stage = stage_of(strength);
  stage.links["links"].law = "cohesive_zone";
  stage.links["links"].toughness = toughness;
  stage.links["links"].shear_toughness = 1.5 * toughness;
  return stage;
}

Field with_box(Field x, const Vec2& growth = Vec2(0, 0)) {
  append_box(x, growth);
  return x;
}

/// Nodes anywhere near where they are at rest, in a box that is longer along x and shorter along y.
Field deformed(const Sample& s, double amplitude = 0.04) {
  return with_box(shaken(s, amplitude, 3), 0.02 * s.box.size().cwiseProduct(Vec2(1, -1.5)));
}

TEST(MovingBox, links_have_forces_on_it_and_stiffness_that_are_derivatives_of_their_energy) {
  for (const int columns : {1, 2}) {
    const Sample s = torus(2, columns);
    const Field x = deformed(s);
    const auto model = build_model(s, stage_of(), x);
    expect_consistent_derivatives(*model->links, x, 1e-6, 1e-6);
    EXPECT_GT(force_of(*model->links, x).tail<2>().cwiseAbs().minCoeff(), 1e-3);
  }
}

TEST(MovingBox, links_that_soften_have_such_forces_too) {
  const Sample s = torus();
  const Field x = deformed(s, 0.02);
  const auto model = build_model(s, softening(10, 0.4), x);
  Field on = x;
  model->links->commit(x);
  EXPECT_GT(model->links->dissipated(), 0);
  on.add(s.nodes(), Vec2(0.004, 0.003));
  for (Index i = 0; i < s.nodes(); ++i) on.add(i, 0.1 * (x.at(i) - s.x[i]));
  expect_consistent_derivatives(*model->links, on, 1e-7, 1e-5);
}

TEST(MovingBox, contacts_and_their_friction_have_such_forces_too) {
  for (const double friction : {0.0, 0.4}) {
    const Sample s = torus(2, 1);
    const Field x = deformed(s, 0.03);
    Stage pressed = stage_of({}, friction);
    pressed.links.clear();
    pressed.contact->normal_stiffness = 800;
    const auto model = build_model(s, pressed, x);
    model->contacts->commit(x);
    Field on = x;
    on.add(s.nodes(), Vec2(-0.002, 0.003));
    for (Index i = 0; i < s.nodes(); ++i) on.add(i, 0.02 * (x.at(i) - s.x[i]));
    EXPECT_GT(std::abs(force_of(*model->contacts, on).tail<2>()[0]), 1e-3);
    expect_consistent_derivatives(*model->contacts, on, 1e-7, 2e-6);
  }
}

// By the same energies of a sample whose box is that long from the beginning on.
TEST(MovingBox, that_has_grown_is_the_box_of_a_larger_sample) {
  const Sample s = torus();
  const Field x = deformed(s);
  Sample larger = s;
  larger.box.hi += box_growth(s, x);
  Field y = x;
  y.x.pop_back(), y.y.pop_back();
  Stage pressed = stage_of({}, 0.4);
  pressed.links.clear();
  pressed.contact->normal_stiffness = 800;
  for (const Stage& stage : {stage_of(), pressed}) {
    const auto model = build_model(s, stage, x), other = build_model(larger, stage, y);
    EXPECT_GT(model->energy(x), 1e-6);
    EXPECT_NEAR(model->energy(x) / other->energy(y), 1, 1e-12);
  }
}

TEST(MovingBox, relative_coordinates_are_undone_and_take_forces_that_do_the_same_work) {
  const Sample s = torus();
  const Field x = deformed(s), w = relative(s, x), back = absolute(s, w);
  Field f = with_box(shaken(s, 1.0, 5), Vec2(0.3, -0.7)), g = f, dw = with_box(shaken(s, 1.0, 7), Vec2(0.2, 0.4));
  make_relative(s, g);
  const Field dx = absolute(s, dw);
  double here = 0, there = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_LT((back.at(i) - x.at(i)).norm(), 1e-14);
    here += f.at(i).dot(dx.at(i)), there += g.at(i).dot(dw.at(i));
  }
  EXPECT_NEAR(here / there, 1, 1e-12);
}

TEST(MovingBox, is_gone_round_by_what_is_joined_to_its_own_image_and_by_nothing_else) {
  const Image none{0, 0}, right{1, 0}, up{0, 1}, left{-1, 0};
  EXPECT_TRUE(goes_round(1, {{0, 0, right}}, 0));
  EXPECT_FALSE(goes_round(1, {{0, 0, right}}, 1));
  EXPECT_TRUE(goes_round(3, {{0, 1, none}, {1, 2, none}, {2, 0, up}}, 1));
  EXPECT_FALSE(goes_round(3, {{0, 1, none}, {1, 2, none}, {2, 0, up}}, 0));
  EXPECT_FALSE(goes_round(3, {{0, 1, right}, {1, 2, none}}, 0));                // no ring
  EXPECT_FALSE(goes_round(3, {{0, 1, right}, {1, 2, none}, {2, 0, left}}, 0));  // a ring that comes back
}

// ---- at rest ----

Stage pulled_stage(const std::string& axis, double strain, std::optional<double> strength, bool free_across,
                   const std::string& kind = "tension") {
  Stage stage = stage_of(strength);
  stage.loading = LoadingScene{};
  stage.loading->axis = axis, stage.loading->kind = kind;
  stage.loading->strain_rate = strain, stage.loading->strain = strain;
  stage.loading->normal_only = free_across;
  return stage;
}

struct AtRest {
  AtRest(const Sample& s, const Stage& of, double residual = 1e-9)
      : stage(of),
        model(build_model(s, stage, with_box(field_of(s.x)))),
        loads(build_loads(s, stage)),
        gauge(measure_gauge(s, stage, loads)),
        path(stage, gauge) {
    QuasiStaticSettings settings;
    settings.longest = 0.05;
    settings.residual = residual;
    stepper.emplace(*model, loads, path, with_box(field_of(s.x)), 0.0, settings);
    stepper->settle();
  }
  void run(double until) {
    while (stepper->time() < until && stepper->over().empty()) {
      stepper->load_towards(until, [] { return true; });
      peak = std::max(peak, std::abs(stress()));
      if (stepper->critical()) stepper->fall([] { return true; });
    }
  }
  double stress() const { return grip_forces(gauge, stepper->load_forces())[1] / (gauge.width * gauge.depth); }
  /// Of the box's length across the pull.
  double strain_across() const {
    const Vec2 growth = box_growth(model->sample, stepper->x());
    return growth[1 - gauge.axis] / model->sample.box.size()[1 - gauge.axis];
  }
  Stage stage;
  std::unique_ptr<Model> model;
  std::vector<Load> loads;
  Gauge gauge;
  LoadPath path;
  std::optional<QuasiStatic> stepper;
  double peak = 0;
};

TEST(MovingBox, at_rest_takes_the_same_stress_with_more_periods_and_wherever_it_begins) {
  for (const std::string axis : {"x", "y"})
    for (const bool free_across : {false, true}) {
      const auto response = [&](const Sample& s) {
        AtRest rig(s, pulled_stage(axis, 0.02, {}, free_across));
        rig.run(1);
        EXPECT_EQ(rig.stepper->over(), "");
        return Vec2(rig.stress(), rig.strain_across());
      };
      const Vec2 one = response(torus(2, 1));
      EXPECT_GT(one[0], 0);
      if (free_across)
        EXPECT_LT(one[1], -1e-4);
      else
        EXPECT_EQ(one[1], 0);
      Sample away = torus(2, 1);
      for (Vec2& p : away.x) p += Vec2(0.7, -1.3);  // through the sides of the box, which stays
      for (const Sample& other : {torus(2, 2), torus(4, 1), away})
        EXPECT_LT((response(other) - one).norm(), 1e-6 * one.norm());
    }
}

TEST(MovingBox, at_rest_bears_the_same_stress_until_the_first_break_with_more_periods_and_wherever_it_begins) {
  for (const std::string axis : {"x", "y"}) {
    const auto strength = [&](const Sample& s) {
      AtRest rig(s, pulled_stage(axis, 0.6, 6.0, true));
      while (!rig.stepper->critical() && rig.stepper->time() < 1) rig.stepper->load_towards(1, [] { return true; });
      EXPECT_TRUE(rig.stepper->critical());
      return rig.stress();
    };
    const double one = strength(torus(2, 1));
    EXPECT_GT(one, 1);
    Sample away = torus(2, 1);
    for (Vec2& p : away.x) p += Vec2(-0.4, 1.1);
    for (const Sample& other : {torus(2, 2), torus(4, 1), away}) EXPECT_NEAR(strength(other) / one, 1, 1e-4);
  }
}

/// Strengths that differ from link to link, the same for a link and its twins in a box of more periods.
Sample varied(Sample s, unsigned seed = 1) {
  std::mt19937 random(seed);
  for (std::size_t l = 0; l < s.links.size(); ++l) s.link_strength.push_back(0.5 + random() / 4294967296.0);
  return s;
}

TEST(MovingBox, at_rest_is_torn_until_nothing_goes_round_it) {
  for (const std::string axis : {"x", "y"})
    for (const bool free_across : {false, true}) {
      const Sample s = varied(torus(4, 4));
      AtRest rig(s, pulled_stage(axis, 0.6, 6.0, free_across), 1e-6);
      EXPECT_TRUE(joined_round(*rig.model, rig.gauge.axis));
      rig.run(1);
      EXPECT_FALSE(joined_round(*rig.model, rig.gauge.axis));
      EXPECT_GT(rig.peak, 1);
      EXPECT_LT(std::abs(rig.stress()), 1e-3 * rig.peak);
      if (!free_across) continue;
      // Where the box is free its links pull nowhere across: they have let go of what would.
      EXPECT_NEAR(rig.stepper->solver().force().at(s.nodes())[1 - rig.gauge.axis], 0, 1e-4);
    }
}

TEST(MovingBox, at_rest_is_pressed_together_as_it_is_pulled_apart_where_that_is_little) {
  const Sample s = torus();
  const auto stress = [&](const std::string& kind) {
    AtRest rig(s, pulled_stage("y", 1e-5, {}, true, kind));
    rig.run(1);
    return rig.stress();
  };
  EXPECT_LT(stress("compression"), 0);
  EXPECT_NEAR(stress("compression") / stress("tension"), -1, 1e-3);
}

// ---- whole runs ----

Scene scene_of(const std::vector<std::string>& settings = {}) {
  return parse_scene(R"(
[sample]
kind = "honeycomb"
columns = 4
rows = 4
side = 1
periodic = "xy"
walls = { segments = 2 }
[cells]
axial_rigidity = 400
bending_rigidity = 0.5
mass_per_length = 1
radius = 0.05
[links]
normal_stiffness = 800
tangential_stiffness = 300
normal_strength = 6
tangential_strength = 6
[contact]
friction = 0.3
[loading]
strain_rate = 1
strain = 0.4
normal_only = true
[stop]
separated = true
[run]
stepper = "quasi_static"
[output]
frames = 20
response = 100
)",
                     "torus", settings);
}

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

TEST(MovingBox, bounds_the_step_below_the_exact_limit_and_not_far_below) {
  const Sample s = torus(2, 2);
  const Field x = with_box(field_of(s.x));
  Stage stage = stage_of();
  stage.contact.reset();
  const auto model = build_model(s, stage, x);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(2 * x.size(), 2 * x.size());
  for (const Term* term : model->terms()) k += stiffness_of(*term, x);
  Eigen::MatrixXd to_x = Eigen::MatrixXd::Identity(k.rows(), k.cols());
  Eigen::VectorXd root(k.rows());
  for (Index i = 0; i <= s.nodes(); ++i)
    for (int c = 0; c < 2; ++c) {
      root[2 * i + c] = std::sqrt(model->inverse_mass[i]);
      if (i < s.nodes()) to_x(2 * i + c, 2 * s.nodes() + c) = carried_share(s, i)[c];
    }
  const Eigen::MatrixXd scaled = root.asDiagonal() * (to_x.transpose() * k * to_x) * root.asDiagonal();
  const double exact = 2 / std::sqrt(scaled.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff());
  const double bound = stable_time_step(*model, x, std::vector<std::uint8_t>(x.size(), 0)).dt;
  EXPECT_LE(bound, exact);
  EXPECT_GT(bound, 0.6 * exact);
}

TEST(MovingBox, that_cannot_be_pulled_so_is_refused) {
  const auto message = [](const std::vector<std::string>& settings) -> std::string {
    const Scene scene = scene_of(settings);
    try {
      build_loads(torus(), scene.stages[0]);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(message({}), "none");
  const std::string shear = message({"loading.kind=\"shear\"", "loading.normal_only=false"});
  EXPECT_NE(shear.find("torus:"), std::string::npos) << shear;
  EXPECT_NE(shear.find("loading.kind"), std::string::npos) << shear;
  EXPECT_NE(message({"loading.both=true"}).find("has no grips"), std::string::npos);
  EXPECT_NE(message({"gravity.acceleration=[0, -10]"}).find("bear its weight"), std::string::npos);
  Scene held = scene_of();
  LoadScene load;
  load.name = "held", load.velocity_x = 0;
  load.nodes.box = Box{{-1, -1}, {1, 1}};
  held.stages[0].loads.push_back(load);
  EXPECT_THROW(build_loads(torus(), held.stages[0]), SceneError);
}

}  // namespace
}  // namespace lamella
