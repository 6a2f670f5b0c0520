// Cells meet: fast, with themselves, where the penalty is too soft to keep them out, and rubbing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "generator/sample/errors.h"
#include "pipelines/hard_cases/hard_cases.h"
#include "pipelines/hard_cases/tools.h"

namespace lamella::hard_cases {
namespace {

/// Largest overlap of a node with the other cell, over its radius.
double largest_overlap_of(const Sample& s, const std::vector<Vec2>& x) {
  double least = 1e300;
  const Field field = field_of(x);
  for (Index c = 0; c < s.cells(); ++c)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i)
      for (Index d = 0; d < s.cells(); ++d)
        for (Index k = s.cell_begin[d]; d != c && k < s.cell_begin[d + 1]; ++k)
          least = std::min(least, std::sqrt(squared_distance(x[i], x[k], x[s.next(d, k)])));
  return (2 * s.radius[0] - least) / s.radius[0];
}

/// Masses of the nodes of walls of mass 1 per length.
std::vector<double> wall_masses(const Sample& s) {
  std::vector<double> m(s.nodes());
  for (Index c = 0; c < s.cells(); ++c)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i)
      m[i] = 0.5 * (s.rest_length[i] + s.rest_length[s.prev(c, i)]);
  return m;
}

}  // namespace

void fast_impact(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Fast impact");
  report.text(
      "A ring is thrown at another one, off its centre. Time step from the present stiffness with contact closed; k_n "
      "= 4 m v^2 / r^2.");
  std::optional<StudyRun> shown;
  for (const double speed : {1.0, 3.0}) {
    const std::string name = fmt::format("v = {:g} of the wave speed", speed / 10);
    // k_n = kappa l of a node of mass l; l^2 cancels but for one factor
    StudyRun run = bench.run(fmt::format("fast_impact_{:g}", speed), "fast_impact.toml",
                             {fmt::format("loads.throw.velocity_x={}", speed),
                              fmt::format("contact.normal_stiffness={}", 1600 * speed * speed),
                              fmt::format("run.step_fraction={}", speed > 1 ? 0.25 : 0.5),
                              fmt::format("stages.flight.stop.time={}", 6 / speed)});
    const Sample& s = run.reader.sample();
    const auto m = wall_masses(s);
    Vec2 first = Vec2::Zero();
    double turn = 0, momentum_error = 0, turn_error = 0, overlap = 0, scale = 0, lever = 0;
    int start = 0;
    while (run.reader.frame(start).stage == 0) ++start;
    for (int k = start; k < run.reader.frames(); ++k) {
      const auto x = run.positions(k);
      const auto v = run.array("v", k);
      Vec2 momentum = Vec2::Zero();
      double angular = 0;
      for (Index i = 0; i < s.nodes(); ++i) {
        const Vec2 p = m[i] * Vec2(v[2 * i], v[2 * i + 1]);
        momentum += p, angular += cross(x[i], p);
        if (k == start) scale += p.norm(), lever += x[i].norm() * p.norm();
      }
      if (k == start) first = momentum, turn = angular;
      momentum_error = std::max(momentum_error, (momentum - first).norm() / scale);
      turn_error = std::max(turn_error, std::abs(angular - turn) / lever);
      overlap = std::max(overlap, largest_overlap_of(s, x));
    }
    const auto residual = run.column("residual"), stage = run.column("stage");
    double ledger = 0;
    for (std::size_t k = 0; k < residual.size(); ++k)
      if (stage[k] == 1) ledger = std::max(ledger, residual[k]);
    report.at_most(name + ": change of momentum, relative", momentum_error, 1e-12);
    report.at_most(name + ": change of angular momentum, relative", turn_error, 1e-12);
    report.at_most(
        name + ": residual of the energy ledger, step at " + (speed > 1 ? "a quarter of" : "half") + " the limit",
        ledger, 1e-3);
    report.between(name + ": largest overlap over r", overlap, 1e-3, 1);
    if (speed > 1)
      report.text(
          "At half the limit the faster impact leaves 2e-3: a node that meets a wall within a step gains or loses what "
          "that step misses.");
    if (speed == 3) shown.emplace(std::move(run));
  }
  const Sample& s = shown->reader.sample();
  draw_panels(bench, "fast_impact", "Rings collide at 0.3 of the wave speed of their walls.",
              {{&s, shown->positions(1), "thrown", {}},
               {&s, shown->positions(15), "in contact", {}},
               {&s, shown->positions(40), "after", {}}});
}

void self_contact_and_pass_through(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Self-contact and pass-through");
  report.text("A ring folded by a pressure from outside, until its walls lie on each other: it does not cross itself.");
  const StudyRun folded = bench.run("external_pressure", "external_pressure.toml");
  const Sample& ring = folded.reader.sample();
  int crossed = 0;
  for (int k = 0; k < folded.reader.frames(); ++k) crossed += crosses_itself(ring, 0, folded.positions(k));
  report.compare_absolute("frames in which the ring crosses itself", crossed, 0, 0);
  const auto contacts = folded.column("energy_contacts");
  report.at_least("energy of its contact with itself, at the end", contacts.back(), 1e-6);
  report.at_most("area left over that at rest", area_of(ring, 0, folded.positions()) / ring.rest_area[0], 0.5);
  draw_panels(bench, "folded_ring", "A ring under external pressure, before and after its walls meet.",
              {{&ring, folded.positions(8), fmt::format("t = {:.3g}", folded.reader.frame(8).time), {}},
               {&ring, folded.positions(11), fmt::format("t = {:.3g}", folded.reader.frame(11).time), {}},
               {&ring, folded.positions(), "at rest", {}}});

  report.text(
      "An unsigned distance pushes a node that has got through to the wrong side. So a node inside another cell, where "
      "it was not at the start, stops "
      "the run.");
  const Scene soft =
      bench.scene("fast_impact.toml", {"contact.normal_stiffness=2", "stages.flight.output.response=6000"});
  const Sample rings = sample_of(soft);
  const StudyRun through = bench.attempt("pass_through", rings, soft);
  expect_stop(bench, "contact too soft for the impact", through, "is inside cell ");
  const StudyRun plate = bench.attempt("through_a_plate", "ring_between_plates.toml", {"contact.normal_stiffness=100"});
  expect_stop(bench, "a ring pressed on a plate that is too soft", plate, "has gone through the wall of cell ");

  Rig rig(rings, soft.stages[0]);
  rig.state.x.set(45, Vec2(-1, 0.5));
  const auto said = rig.model->contacts->fault(rig.state.x);
  report.holds("a node placed inside another cell is found",
               said && said->find("node 45 of cell 1 is inside cell 0") != std::string::npos,
               said ? *said : "it is not");
  std::string refused = "it was not refused";
  try {
    sample_of(bench.scene("fast_impact.toml", {"sample.shapes.1.centre=[-0.3, 0.6]"}));
  } catch (const SceneError& error) {
    refused = error.what();
  }
  const auto at = refused.find("cells 0 and 1 cross");
  report.holds("a sample whose cells cross is refused before it is run", at != std::string::npos,
               at == std::string::npos ? "it was not refused" : refused.substr(at, refused.find('\n', at) - at));
}

void friction(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Friction");
  const double mu = 0.3, g = 10, mass = 5, speed = 3;
  report.text(
      "A stiff block on a plate of nodes. First as a rigid body moved along the plate, then by itself: pulled with 0.9 "
      "mu N and let go, dragged along, and "
      "thrown.");
  const Scene scene = bench.scene("sliding_block.toml");
  const Sample sample = sample_of(scene);
  Stage stage = scene.stages[0];
  stage.gravity.reset(), stage.drag.reset(), stage.loads.clear();
  stage.cells["cells"].bar_dashpot = stage.cells["cells"].hinge_dashpot = stage.contact->damping = 0;
  std::vector<Load> loads(2);
  for (Index c = 0; c < 2; ++c) {
    loads[c].holds[0] = loads[c].holds[1] = true;
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) loads[c].nodes.push_back(i);
  }
  loads[0].velocity = {1, 0};
  Rig rig(sample, stage, loads);
  const double press = 1e-4, dt = 1e-4;
  for (Index i = sample.cell_begin[0]; i < sample.cell_begin[1]; ++i) rig.state.x.add(i, {0, -press});
  rig.model->contacts->rebuild(rig.state.x);
  double jump = 0, ratio_error = 0;
  Vec2 before = Vec2::Zero();
  for (int n = 0; n < 10000; ++n) {
    const Measurement m = rig.stepper.measured_step(dt, dt, nullptr);
    const Vec2 force = -m.load_force[0];  // of the plate on the block
    if (n > 100) {
      jump = std::max(jump, (force - before).norm() / before.norm());
      ratio_error = std::max(ratio_error, std::abs(-force.x() / (mu * force.y()) - 1));
    }
    before = force;
  }
  report.at_most("rigid block, over three nodes of the plate: largest change of force in a step, relative", jump, 0.01);
  report.at_most("its friction over mu N: largest distance from 1", ratio_error, 0.01);
  report.text(
      "A node of the plate that comes under the block starts with a spring that is not stretched yet: friction lags by "
      "its share until the "
      "block has gone on by mu f_n / k_t. `pipelines/friction` shows that no jump is left when steps are made smaller, "
      "and a plate of one segment "
      "stops a thrown block within 0.1 %; on this one of nodes it rocks from node to node.");

  const StudyRun run = bench.run("sliding_block", "sliding_block.toml");
  const Sample& s = run.reader.sample();
  const auto m = wall_masses(s);
  const auto centre_of = [&](const StudyRun& of, int frame) {
    const auto x = of.positions(frame);
    double sum = 0, all = 0;
    for (Index i = 0; i < s.cell_size(0); ++i) sum += m[i] * x[i].x(), all += m[i];
    return sum / all;
  };
  const auto centre = [&](int frame) { return centre_of(run, frame); };
  std::vector<int> last(5);
  for (int k = 0; k < run.reader.frames(); ++k) last[run.reader.frame(k).stage] = k;
  const double rest = centre(last[0]), pulled = centre(last[1]), back = centre(last[2]);
  report.text(fmt::format("Pulled with 0.9 mu N, the block gives way by {:.3g}, of its length 2.", pulled - rest));
  report.at_most("pulled with 0.9 mu N and let go: what is left of that way, relative",
                 std::abs(back - rest) / (pulled - rest), 0.35);
  const auto stages = run.column("stage"), time = run.column("time"), along = run.column("force_x_plate"),
             up = run.column("force_y_plate");
  double rubbing = 0, pressing = 0, start = 0;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    if (stages[k] == 3 && stages[k - 1] == 2) start = time[k];
    if (stages[k] == 3 && time[k] > start + 0.2) rubbing -= along[k], pressing += up[k] - 9 * g;
  }
  report.compare("dragged along: mean friction over mean mu N", rubbing / (mu * pressing), 1, 0.004);
  // A plate of one segment has no nodes: only those of the block seek feet.
  const StudyRun smooth =
      bench.run("sliding_block_on_one_segment", "sliding_block.toml", {"sample.shapes.1.segments=1"});
  const auto way = [&](const StudyRun& of) {
    double most = 0;
    for (int k = last[3]; k <= last[4]; ++k) most = std::max(most, centre_of(of, k));
    return (most - centre_of(of, last[3])) / (speed * speed / (2 * mu * g));
  };
  report.compare("thrown, on a plate of one segment: the way to where it stops over v^2 / (2 mu g)", way(smooth), 1,
                 1e-3);
  report.compare("thrown, on the plate of nodes: the same", way(run), 1, 6e-3);
  const auto friction = run.column("friction");
  const auto from = std::find(stages.begin(), stages.end(), 4.0) - stages.begin();
  report.compare("thrown: energy dissipated by friction over m v^2 / 2",
                 (friction.back() - friction[static_cast<std::size_t>(from)]) / (0.5 * mass * speed * speed), 1, 6e-3);
  report.at_most("residual of the energy ledger", run.ledger(), 1e-3);
}

}  // namespace lamella::hard_cases
