// Samples that repeat both ways, their box pulled (moving_box.h): forces on the box's lengths are derivatives of the energy by them, and nothing
// depends on where the box begins, on which image of a cell is at home, or on how many periods the box holds.
#include "simulator/moving_box.h"

#include <cmath>
#include <optional>

#include "generator/sample/errors.h"
#include "generator/sample/way_round.h"
#include "simulator/loads.h"
#include "simulator/steppers/quasi_static.h"
#include "simulator/steppers/stable_time_step.h"
#include "simulator/stop_conditions.h"
#include "tests/simulator/torus.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

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
