// A crack between two beams, through links that soften: while it grows the contour integral around its tip is the toughness, whatever the
// length over which they soften.
#include "tests/simulator/tissues.h"

namespace lamella {
namespace {

/// Two open chains of `segments` bars of length 1, 0.2 apart, linked from node `crack` on. The upper runs to the right, the lower back.
Sample facing_chains(int segments, int crack) {
  Sample s;
  std::vector<Vec2> upper, lower;
  for (int i = 0; i <= segments; ++i) upper.emplace_back(i, 0.1), lower.emplace_back(segments - i, -0.1);
  add_cell(s, upper, false, 0.1, "cells");
  add_cell(s, lower, false, 0.1, "cells");
  s.walls.push_back({0, 1, static_cast<double>(segments - crack)});
  const auto facing = [&](int i) { return static_cast<Index>(2 * segments + 1 - i); };
  for (int i = crack; i <= segments; ++i) {
    const bool first = i == crack, last = i == segments;
    Link link;
    link.a = i, link.b = facing(i);
    link.a_prev = first ? i : i - 1, link.a_next = last ? i : i + 1;
    link.b_next = facing(first ? i : i - 1), link.b_prev = facing(last ? i : i + 1);
    link.wall = 0, link.wall_end = first || last;
    link.spacing = 1, link.length = first || last ? 0.5 : 1;
    link.offset_n = 0.2;
    s.links.push_back(link);
  }
  s.box = {{0, -1}, {static_cast<double>(segments), 1}};
  return s;
}

/// The beams, pulled apart slowly until the crack has grown by some ten spacings: J over the toughness at each of 40 times at which two
/// links or more are gone. `zone`: (EI G / f^2)^(1/4), of the order of the length over which links soften, in spacings.
std::vector<double> contour_integrals(double zone) {
  const int segments = 110, crack = 36;
  const Sample s = facing_chains(segments, crack);
  const double toughness = 4e-7;  // [J/m]: arms turn by 0.02
  Stage stage;
  stage.cells["cells"] = cell_scene(4.0, 1.0, 1.0);  // arms that bend little do not stretch
  const double strength = std::sqrt(toughness) / (zone * zone), last_opening = 2 * toughness / strength;
  LinkScene links = link_scene("length", strength / (0.1 * last_opening), 0.0, strength);
  links.tangential_stiffness = 0.3 * links.normal_stiffness;
  links.law = "cohesive_zone";
  links.toughness = toughness;
  stage.links["links"] = links;
  stage.drag = DragScene{5e-4};
  const auto end = [&](Index node, double speed) {
    Load load;
    load.nodes = {node};
    load.holds[1] = true, load.holds[0] = speed == 0;
    load.velocity = {0, speed};
    return load;
  };
  // Without a zone the crack would begin to grow at the half opening sqrt(G / EI) a^2 / 3.
  const double total = 4e5, dt = 0.4, speed = 2.6 * std::sqrt(toughness) * crack * crack / 3 / total;
  Rig rig(s, stage, {end(0, speed), end(2 * segments + 1, -speed), end(segments, 0), end(segments + 1, 0)});
  std::vector<double> out;
  const int every = static_cast<int>(total / dt / 40);
  for (int n = 0; n * dt < total; ++n) {
    rig.loads[0].factor = rig.loads[1].factor = smooth_ramp((n + 0.5) * dt / (0.1 * total));
    if (n % every != 0) {
      rig.stepper.step(dt, dt);
      continue;
    }
    const Measurement m = rig.stepper.measured_step(dt, dt, nullptr);
    const Vec2 first = rig.state.x.at(1) - rig.state.x.at(0);
    const double pull = 0.5 * (m.load_force[0].y() - m.load_force[1].y()), slope = std::atan2(-first.y(), first.x());
    if (rig.model->links->broken() >= 2) out.push_back(2 * pull * slope / toughness);
  }
  EXPECT_GT(rig.model->links->broken(), 8);
  return out;
}

// Paris and Paris: with forces P that part the ends of two beams, which turn there by theta each, the contour integral is J s = 2 P theta
// (with slender arms and a short zone P^2 a^2 / EI). It is the toughness as long as the zone in which links soften moves on unchanged, and
// so the critical load is sqrt(G s EI) / a at the length a that the arms' own compliance has.
TEST(DoubleCantilever, a_crack_grows_where_the_contour_integral_is_the_toughness_however_long_the_zone) {
  for (const double zone : {5.0, 8.0}) {
    const std::vector<double> found = contour_integrals(zone);
    ASSERT_GT(found.size(), 5u);
    double mean = 0;
    for (const double ratio : found) {
      EXPECT_NEAR(ratio, 1, 0.06) << zone;  // links go one by one, and shake the arms: more than the mean
      mean += ratio / static_cast<double>(found.size());
    }
    EXPECT_NEAR(mean, 1, 0.01) << zone;  // 2 % of J are 1 % of the load
  }
}

}  // namespace
}  // namespace lamella
