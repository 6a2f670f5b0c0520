// Samples that repeat along x, pulled along y: nothing may depend on which image of a cell is at home, on where the box begins, or on how
// many periods the box holds.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "generator/sample/errors.h"
#include "simulator/loads.h"
#include "simulator/steppers/quasi_static.h"
#include "simulator/steppers/stable_time_step.h"
#include "simulator/stop_conditions.h"
#include "tests/simulator/static_rig.h"
#include "tests/simulator/tissues.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

constexpr int kRows = 4, kColumns = 3;

Sample strip(int columns = kColumns, int segments = 2) {
  return hexagons(kRows, columns, segments, 0.1, {true, false});
}

/// By how many boxes each cell is moved.
using Shifts = std::vector<Image>;

Shifts some_shifts(const Sample& s) {
  Shifts shifts;
  for (Index c = 0; c < s.cells(); ++c)
    shifts.push_back({static_cast<std::int8_t>(s.periodic[0] ? c * 7 % 5 - 2 : 0),
                      static_cast<std::int8_t>(s.periodic[1] ? c * 3 % 4 - 1 : 0)});
  return shifts;
}

/// The same sample with other images of its cells at home.
Sample rehomed(Sample s, const Shifts& shifts) {
  for (Index c = 0; c < s.cells(); ++c)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) s.x[i] += displacement(shifts[c], s.box);
  for (std::size_t l = 0; l < s.links.size(); ++l) {
    const Wall& wall = s.walls[s.links[l].wall];
    s.link_image[l] = s.link_image[l] + shifts[wall.cell_a] - shifts[wall.cell_b];
  }
  return s;
}

Field rehomed(const Sample& s, Field x, const Shifts& shifts) {
  for (Index c = 0; c < s.cells(); ++c)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) x.add(i, displacement(shifts[c], s.box));
  return x;
}

double largest_difference(const Field& a, const Field& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a.at(i) - b.at(i)).norm());
  return most;
}

double largest(const Field& f) { return largest_difference(f, Field(f.size())); }

Field forces(const Model& model, const Field& x) {
  Field f(x.size());
  for (const Term* term : model.terms()) term->add_force(x, f);
  return f;
}

/// Links pulled and sheared, walls bent, and some cells pressed onto the neighbours they are no longer linked to.
Field deformed(const Sample& s) { return shaken(s, 0.04, 3); }

TEST(PeriodicLinks, have_forces_and_stiffness_that_are_derivatives_of_their_energy) {
  for (const Periodic& periodic : {Periodic{true, false}, {true, true}})
    for (const int columns : {1, 2}) {
      const Sample s = hexagons(2, columns, 2, 0.1, periodic);
      const auto model = build_model(s, stage_of(), field_of(s.x));
      expect_consistent_derivatives(*model->links, deformed(s), 1e-6, 1e-6);
      const Field f = forces(*model, deformed(s));
      Vec2 net = Vec2::Zero();
      for (std::size_t i = 0; i < f.size(); ++i) net += f.at(i);
      EXPECT_LT(net.norm(), 1e-12 * largest(f));
    }
}

TEST(PeriodicLinks, are_free_of_force_at_rest_across_the_sides) {
  const Sample s = hexagons(2, 1, 2, 0.1, {true, true});
  const auto model = build_model(s, stage_of(), field_of(s.x));
  EXPECT_NEAR(model->links->energy(field_of(s.x)), 0, 1e-24);
  EXPECT_EQ(s.walls.size(), 6u);  // three to a cell, although there are but two cells
}

TEST(PeriodicLinks, act_alike_wherever_the_cells_are_at_home_and_wherever_the_box_lies) {
  for (const Periodic& periodic : {Periodic{true, false}, {true, true}}) {
    const Sample s = hexagons(kRows, kColumns, 2, 0.1, periodic);
    const Shifts shifts = some_shifts(s);
    const Sample elsewhere = rehomed(s, shifts);
    const Field x = deformed(s), y = rehomed(s, x, shifts);
    // All links broken: contact alone.
    Stage pressed = stage_of();
    pressed.links.clear();
    pressed.contact->normal_stiffness = 800;
    const auto touching = build_model(s, pressed, x), touching_there = build_model(elsewhere, pressed, y);
    EXPECT_GT(touching->contacts->energy(x), 1e-3);
    EXPECT_NEAR(touching_there->contacts->energy(y) / touching->contacts->energy(x), 1, 1e-10);
    EXPECT_LT(largest_difference(forces(*touching, x), forces(*touching_there, y)),
              1e-11 * largest(forces(*touching, x)));

    const auto model = build_model(s, stage_of(), x), other = build_model(elsewhere, stage_of(), y);
    const Field f = forces(*model, x);
    EXPECT_NEAR(other->energy(y) / model->energy(x), 1, 1e-12);
    EXPECT_LT(largest_difference(f, forces(*other, y)), 1e-12 * largest(f));

    Sample away = s;
    Field z = x;
    const Vec2 by(0.377, -1.21);
    for (Vec2& p : away.x) p += by;
    away.box = {away.box.lo + by, away.box.hi + by};
    for (std::size_t i = 0; i < z.size(); ++i) z.add(i, by);
    const auto moved = build_model(away, stage_of(), z);
    EXPECT_NEAR(moved->energy(z) / model->energy(x), 1, 1e-12);
    EXPECT_LT(largest_difference(f, forces(*moved, z)), 1e-12 * largest(f));
  }
}

TEST(PeriodicSample, of_two_periods_has_the_forces_of_one_twice) {
  const Sample one = strip(), two = strip(2 * kColumns);
  const Field x = deformed(one);
  Field y(two.nodes());
  const auto twin = [&](Index c, int copy) { return c / kColumns * 2 * kColumns + copy * kColumns + c % kColumns; };
  const double width = one.box.size().x();
  for (Index c = 0; c < one.cells(); ++c)
    for (int copy = 0; copy < 2; ++copy)
      for (Index k = 0; k < one.cell_size(c); ++k)
        y.set(two.cell_begin[twin(c, copy)] + k, x.at(one.cell_begin[c] + k) + Vec2(copy * width, 0));
  const auto model = build_model(one, stage_of(), x), doubled = build_model(two, stage_of(), y);
  EXPECT_NEAR(doubled->energy(y) / model->energy(x), 2, 1e-12);
  const Field f = forces(*model, x), g = forces(*doubled, y);
  for (Index c = 0; c < one.cells(); ++c)
    for (int copy = 0; copy < 2; ++copy)
      for (Index k = 0; k < one.cell_size(c); ++k)
        EXPECT_LT((f.at(one.cell_begin[c] + k) - g.at(two.cell_begin[twin(c, copy)] + k)).norm(), 1e-12 * largest(f));
}

double stable_dt(const Rig& rig) {
  return stable_time_step(*rig.model, rig.state.x, std::vector<std::uint8_t>(rig.state.x.size(), 0)).dt;
}

/// The lowest row held, the highest moving up.
std::vector<Load> pulled(const Sample& s, double speed, bool holds_x = true) {
  const int columns = s.cells() / kRows;
  std::vector<Index> low, high;
  for (int c = 0; c < columns; ++c) low.push_back(c), high.push_back((kRows - 1) * columns + c);
  std::vector<Load> loads{moving_cells(s, low, Vec2(0, 0)), moving_cells(s, high, Vec2(0, speed))};
  for (Load& load : loads) load.holds[0] = holds_x;
  return loads;
}

struct Torn {
  std::vector<Index> links;
  double energy = 0, force = 0, time = 0;
};

/// In time, until nothing joins the two grips.
Torn torn(const Sample& s, double friction) {
  Rig rig(s, stage_of(6.0, friction), pulled(s, 0.4));
  const double dt = 0.4 * stable_dt(rig);
  Torn out;
  for (out.time = 0; out.time < 6; out.time += dt) {
    rig.stepper.step(dt, dt);
    for (const Break& b : rig.stepper.take_breaks()) out.links.push_back(b.link), out.energy += b.energy;
  }
  const std::vector<Index> part = parts_of(*rig.model);
  std::set<Index> low;
  for (Index i : rig.loads[0].nodes) low.insert(part[i]);
  for (Index i : rig.loads[1].nodes) EXPECT_EQ(low.count(part[i]), 0u) << "still joined";
  return out;
}

TEST(PeriodicSample, tears_alike_in_time_wherever_its_cells_are_at_home) {
  for (const double friction : {0.0, 0.4}) {
    const Sample s = strip();
    const Torn here = torn(s, friction), elsewhere = torn(rehomed(s, some_shifts(s)), friction);
    EXPECT_GT(here.links.size(), 5u);
    EXPECT_EQ(here.links.size(), elsewhere.links.size());
    EXPECT_NEAR(here.energy / elsewhere.energy, 1, 1e-6);
  }
}

TEST(PeriodicSample, that_drifts_through_its_sides_swings_as_one_that_does_not) {
  const Sample s = strip(2);
  Stage stage = stage_of();
  stage.drag.reset();
  const auto after = [&](double drift) {
    Rig rig(s, stage);
    rig.state.x = deformed(s);
    rig.model->contacts->rebuild(rig.state.x);
    for (std::size_t i = 0; i < rig.state.v.size(); ++i) rig.state.v.x[i] = drift;
    const double dt = 0.3 * stable_dt(rig);
    int steps = 0;
    for (; steps * dt < 2; ++steps) rig.stepper.step(dt, dt);
    Field x = rig.state.x;
    for (double& at : x.x) at -= drift * steps * dt;
    return x;
  };
  const Field still = after(0), drifting = after(4);  // 8 m, more than two boxes
  EXPECT_GT(largest_difference(still, field_of(s.x)), 1e-3);
  EXPECT_LT(largest_difference(still, drifting), 1e-9);
}

StaticRig at_rest(const Sample& s, std::optional<double> strength, std::vector<Load> loads) {
  return {s, stage_of(strength), std::move(loads), {.residual = 1e-9, .longest = 0.02}};
}

TEST(PeriodicSample, at_rest_takes_the_same_stress_with_more_periods_and_other_homes) {
  const auto stress = [](const Sample& s) {
    StaticRig rig = at_rest(s, {}, pulled(s, 0.2));
    rig.run();
    EXPECT_EQ(rig.stepper->over(), "");
    return rig.stepper->load_forces()[1].y() / s.box.size().x();
  };
  const double one = stress(strip());
  EXPECT_GT(one, 0);
  EXPECT_NEAR(stress(strip(2 * kColumns)) / one, 1, 1e-6);
  EXPECT_NEAR(stress(strip(1)) / one, 1, 1e-6);
  const Sample s = strip();
  EXPECT_NEAR(stress(rehomed(s, some_shifts(s))) / one, 1, 1e-6);
}

TEST(PeriodicSample, at_rest_needs_nothing_to_hold_it_across_the_pull) {
  const Sample s = strip();
  const auto force = [&](bool holds_x) {
    StaticRig rig = at_rest(s, {}, pulled(s, 0.2, holds_x));
    rig.run();
    EXPECT_EQ(rig.stepper->over(), "");
    // It stays where it is: nothing pushes it along x.
    double mean = 0;
    for (Index i = 0; i < s.nodes(); ++i) mean += (rig.stepper->x().x[i] - s.x[i].x()) / s.nodes();
    EXPECT_NEAR(mean, 0, 1e-6);
    return rig.stepper->load_forces()[1].y();
  };
  EXPECT_GT(force(true), force(false));  // free to slide, the grips hold less
  EXPECT_GT(force(false), 0.5 * force(true));
}

TEST(PeriodicSample, at_rest_is_torn_from_side_to_side) {
  const Sample s = strip();
  StaticRig rig = at_rest(s, 6.0, pulled(s, 2));
  rig.run();
  const std::vector<Index> part = parts_of(*rig.model);
  std::set<Index> low;
  for (Index i : rig.loads[0].nodes) low.insert(part[i]);
  for (Index i : rig.loads[1].nodes) EXPECT_EQ(low.count(part[i]), 0u);
  EXPECT_GT(rig.model->links->broken(), 5);
}

TEST(PeriodicSample, has_no_grips_where_it_repeats) {
  Sample s = strip();
  s.side.assign(s.nodes(), 0);
  for (Index i = s.cell_begin[0]; i < s.cell_begin[kColumns]; ++i) s.side[i] = kBottom;
  for (Index i = s.cell_begin[s.cells() - kColumns]; i < s.nodes(); ++i) s.side[i] = kTop;
  Stage stage = stage_of();
  stage.loading = LoadingScene{};
  stage.loading->strain_rate = 1;
  const auto loads = build_loads(s, stage);
  EXPECT_EQ(loads.size(), 2u);
  EXPECT_EQ(measure_gauge(s, stage, loads).width, s.box.size().x());
  stage.loading->axis = "x";
  const auto message = [&](const Sample& of) -> std::string {
    try {
      build_loads(of, stage);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_NE(message(s).find("the sample repeats along x"), std::string::npos) << message(s);
  EXPECT_NE(message(s).find("pull along y"), std::string::npos);
}

}  // namespace
}  // namespace lamella
