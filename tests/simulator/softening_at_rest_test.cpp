// Links that soften, at rest: limit points that are followed or fallen from, and branches that no search leaves by itself.
#include <algorithm>
#include <cmath>

#include "tests/simulator/static_rig.h"
#include "tests/simulator/tissues.h"
#include "tests/support/samples.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

LinkScene softening(const char* per, double k_n, double k_t, double strength, double toughness) {
  LinkScene links = link_scene(per, k_n, k_t, strength);
  links.law = "cohesive_zone";
  links.toughness = toughness;
  return links;
}

/// One link between two bars in line with it, which are pulled apart: the springs in series with it. A foot at each bar's end holds the
/// link's frame.
struct LinkBetweenBars {
  static constexpr double kGap = 0.1, kBar = 2, kRigidity = 1, kStiffness = 1, kStrength = 1e-3, kToughness = 1.5e-6;
  static constexpr double kOnset = kStrength / kStiffness, kEnd = 2 * kToughness / kStrength;  // openings
  static constexpr double kCompliance = 2 * kBar / kRigidity;                                  // of both bars
  static constexpr double kTurn = kOnset + kCompliance * kStrength;  // way at which the curve turns back
  static constexpr double kWay = 6e-3;                               // in a time of 1

  LinkBetweenBars() {
    const double y = 0.5 * kGap;
    add_cell(sample, {{0, y + kBar}, {0, y}, {1, y}}, false, 0.05, "cells");
    add_cell(sample, {{1, -y}, {0, -y}, {0, -y - kBar}}, false, 0.05, "cells");
    sample.walls.push_back({0, 1, 1.0});
    Link link;
    link.a = link.a_prev = 1, link.a_next = 2;
    link.b = link.b_next = 4, link.b_prev = 3;
    link.wall = 0, link.wall_end = true, link.spacing = link.length = 1, link.offset_n = kGap;
    sample.links.push_back(link);
    sample.box = {{-1, -3}, {2, 3}};
    stage.cells["cells"] = cell_scene(kRigidity, 1.0, 1.0);
    stage.links["links"] = softening("link", kStiffness, kStiffness, kStrength, kToughness);
    const auto held = [&](std::vector<Index> nodes, bool along_y, double speed) {
      Load load;
      load.nodes = std::move(nodes);
      load.holds[0] = true, load.holds[1] = along_y, load.velocity = {0, speed};
      return load;
    };
    loads = {held({0}, true, kWay), held({5}, true, 0), held({1, 4}, false, 0)};
  }
  static double law(double opening) {
    if (opening <= kOnset) return kStiffness * opening;
    return std::max(0.0, kStrength * (kEnd - opening) / (kEnd - kOnset));
  }
  double opening(const Field& x) const { return x.y[1] - x.y[4] - kGap; }

  Sample sample;
  Stage stage;
  std::vector<Load> loads;
};

TEST(SofteningAtRest, a_load_follows_a_link_in_series_with_springs_back_along_its_closed_form) {
  const LinkBetweenBars series;
  StaticRig rig(series.sample, series.stage, series.loads, {.residual = 1e-7, .follow = true, .longest = 0.02});
  double least_after_peak = 1, peak = 0;
  int on_the_way_back = 0;
  for (int k = 0; rig.stepper->time() < 1 && k < 1000; ++k) {
    rig.stepper->load_towards(1, [] { return true; });
    const double way = series.kWay * rig.stepper->time(), force = rig.stepper->load_forces()[0].y();
    const double opening = series.opening(rig.stepper->x());
    EXPECT_NEAR(way, opening + series.kCompliance * force, 1e-6 * series.kWay);
    EXPECT_NEAR(force, series.law(opening), 1e-5 * series.kStrength);
    if (opening > 1.01 * series.kOnset && opening < series.kEnd) ++on_the_way_back;
    if (opening > 1.01 * series.kOnset) least_after_peak = std::min(least_after_peak, way);
    peak = std::max(peak, force);
  }
  EXPECT_EQ(rig.stepper->time(), 1);
  EXPECT_NEAR(peak, series.kStrength, 0.01 * series.kStrength);
  EXPECT_GT(on_the_way_back, 5);
  EXPECT_LT(least_after_peak, series.kEnd + 0.02 * series.kWay);
  const StaticWorks w = rig.stepper->works();
  EXPECT_NEAR(w.fracture, series.kToughness, 1e-9 * series.kToughness);
  EXPECT_NEAR(w.loads, series.kToughness, 0.01 * series.kToughness);  // all work has become new surface
  EXPECT_EQ(w.released, 0);
  EXPECT_EQ(rig.stepper->falls(), 0);
}

TEST(SofteningAtRest, a_link_in_series_with_springs_falls_where_its_closed_form_turns_back_and_releases_what_is_left) {
  const LinkBetweenBars series;
  StaticRig rig(series.sample, series.stage, series.loads, {.residual = 1e-7, .longest = 0.02});
  double last = 0;  // way before the fall
  while (rig.stepper->time() < 1) {
    rig.stepper->load_towards(1, [] { return true; });
    if (rig.stepper->falls() == 0) last = series.kWay * rig.stepper->time();
  }
  EXPECT_NEAR(last, series.kTurn, 0.02 * 0.02 * series.kWay);
  EXPECT_EQ(rig.stepper->falls(), 1);
  const StaticWorks w = rig.stepper->works();
  const double stored = 0.5 * series.kStrength * series.kTurn;
  EXPECT_NEAR(w.released, stored - series.kToughness, 0.01 * stored);
  EXPECT_LT(rig.open(), 1e-3);
}

/// Hexagons with stiff links that soften, pulled apart.
struct SofteningTissue {
  SofteningTissue() : sample(hexagons(4, 3, 4, 0.05)) {
    stage.cells["cells"] = cell_scene(1200.0, 1.0, 1.0);
    stage.links["links"] = softening("length", 2000.0, 600.0, 1.0, 0.0256);
  }
  std::vector<Load> loads(double way) const {
    return {moving_cells(sample, {0, 1, 2}, Vec2(0, 0)), moving_cells(sample, {9}, Vec2(0.3 * way, way))};
  }
  Sample sample;
  Stage stage;
};

TEST(SofteningAtRest, the_area_under_a_followed_curve_is_what_fracture_took) {
  const SofteningTissue tissue;
  StaticRig rig(tissue.sample, tissue.stage, tissue.loads(0.15), {.follow = true, .longest = 0.02});
  double farthest = 0, back = 0, toughness = 0;
  while (rig.stepper->time() < 1) {
    rig.stepper->load_towards(1, [] { return true; });
    farthest = std::max(farthest, rig.stepper->time());
    back = std::max(back, farthest - rig.stepper->time());
  }
  EXPECT_GT(back, 0.2);
  const auto breaks = rig.stepper->take_breaks();
  for (const BreakAtRest& b : breaks) toughness += 0.0256 * tissue.sample.links[b.link.link].length;
  EXPECT_GT(breaks.size(), 10u);
  const StaticWorks w = rig.stepper->works();
  EXPECT_GT(w.fracture, toughness);                     // others are damaged
  EXPECT_NEAR(w.loads, w.fracture, 3e-2 * w.fracture);  // a fifth more where the sample falls
  EXPECT_LT(rig.open(), 1e-3);
}

TEST(SofteningAtRest, an_arch_behind_a_spring_is_followed_through_its_snap_back) {
  // Half a shallow arch: a bar from a pin to an apex that slides, F = k (l_0 - l) (h - w) / l at the deflection w; a long bar above the
  // apex is the spring through which the way u = w + F / k_s is prescribed.
  const double height = 0.2, rigidity = 1, spring = 200.0 / 3, rest = std::hypot(1, height);
  Sample arch;
  add_cell(arch, {{0, 0}, {1, height}, {1, height + spring}}, false, 0.05, "cells");
  arch.box = {{0, -1}, {2, 70}};
  Stage stage;
  stage.cells["cells"] = cell_scene(rigidity, 1e-9, 1.0);
  Load pin, apex, top;
  pin.nodes = {0}, pin.holds[0] = pin.holds[1] = true;
  apex.nodes = {1}, apex.holds[0] = true;
  top.nodes = {2}, top.holds[0] = top.holds[1] = true, top.velocity = {0, -0.8};
  for (const bool follow : {true, false}) {
    StaticRig rig(arch, stage, {pin, apex, top}, {.residual = 1e-6, .follow = follow, .longest = 0.02});
    int past = 0;
    bool back = false;
    double last = 0;
    for (int k = 0; rig.stepper->time() < 1 && k < 2000; ++k) {
      rig.stepper->load_towards(1, [] { return true; });
      const double w = height - rig.stepper->x().y[1], length = std::hypot(1, height - w);
      const double force = rigidity / rest * (rest - length) * (height - w) / length;
      EXPECT_NEAR(0.8 * rig.stepper->time(), w + force * spring / rigidity, 1e-5);
      if (w > 0.8 * height && w < 1.4 * height) ++past;  // where it would not stay under its load
      back |= rig.stepper->time() < last;
      last = rig.stepper->time();
    }
    EXPECT_EQ(rig.stepper->time(), 1);
    EXPECT_EQ(past > 3, follow);
    EXPECT_EQ(back, follow);
    EXPECT_EQ(rig.stepper->falls(), follow ? 0 : 1);
    EXPECT_LT(rig.open(), 1e-2);
  }
}

TEST(SofteningAtRest, strength_and_ledger_do_not_hang_on_residual_or_load_step) {
  const SofteningTissue tissue;
  std::vector<double> peaks;
  for (const auto& [residual, longest] : {std::pair{1e-4, 0.02}, {1e-6, 0.02}, {1e-4, 0.01}}) {
    StaticRig rig(tissue.sample, tissue.stage, tissue.loads(0.15), {.residual = residual, .longest = longest});
    double peak = 0;
    while (rig.stepper->time() < 1) {
      rig.stepper->load_towards(1, [] { return true; });
      peak = std::max(peak, rig.stepper->load_forces()[1].y());
      EXPECT_LT(rig.open(), 1e-2) << rig.stepper->time();
    }
    peaks.push_back(peak);
  }
  // Alike links beside each other bifurcate: which of them goes on is a matter of rounding.
  EXPECT_NEAR(peaks[1], peaks[0], 2e-2 * peaks[0]);
  EXPECT_NEAR(peaks[2], peaks[0], 2e-2 * peaks[0]);
}

}  // namespace
}  // namespace lamella
