// What the undamped scheme keeps, whatever the sample does: momentum, angular momentum, energy to second order, the answer when everything
// is turned, and the way back.
#include <fmt/format.h>

#include <cmath>

#include "pipelines/free_vibration/free_motion.h"

namespace lamella {
namespace {

void momentum(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Momentum and angular momentum");
  report.text(
      "Drift over the run, relative to the sum of |m v| and of |x| |m v|: two filled rings that collide, and a tissue "
      "that tears itself apart.");
  for (const char* name : {"collision", "tissue"}) {
    const Scene scene = bench.scene(std::string(name) + ".toml");
    const StudyRun run = bench.run(name, std::string(name) + ".toml");
    const Motion first = motion_of(scene, run, 0);
    double drift = 0, turn = 0;
    for (int f = 1; f < run.reader.frames(); ++f) {
      const Motion now = motion_of(scene, run, f);
      drift = std::max(drift, (now.momentum - first.momentum).norm() / first.largest_momentum);
      turn = std::max(turn, std::abs(now.angular_momentum - first.angular_momentum) / first.largest_angular_momentum);
    }
    report.at_most(fmt::format("{}: drift of the momentum", name), drift, 1e-12);
    report.at_most(fmt::format("{}: drift of the angular momentum", name), turn, 1e-12);
    if (!run.reader.events().empty())
      report.at_least("tissue: links that broke", static_cast<double>(run.reader.events().size()), 10);
  }
}

void energy(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Energy");
  report.text(
      "Largest departure of the whole energy from that at the start, over the largest energy: a filled ring that "
      "swings by a "
      "third of its radius, at four time steps.\nA contact opens and closes at some instant within a step, so the "
      "order of "
      "the two rings that collide is only near 2.");
  Chart chart{
      .title = "Departure of the energy", .x_label = "time step", .y_label = "largest departure over the energy"};
  chart.x_scale = chart.y_scale = Scale::kLogarithmic;
  int colour = 0;
  for (const char* name : {"swing", "collision"}) {
    const bool smooth = colour == 0;
    std::vector<double> inverse, steps, drifts;
    for (const double fraction : {0.8, 0.4, 0.2, 0.1}) {
      const StudyRun run = bench.run(fmt::format("{}_{:g}", name, fraction), std::string(name) + ".toml",
                                     {fmt::format("run.step_fraction={:g}", fraction)});
      steps.push_back(std::stod(run.reader.provenance().at("time_step")));
      inverse.push_back(1 / steps.back()), drifts.push_back(run.ledger());
      if (fraction == 0.8)
        report.at_most(fmt::format("{}: departure at 0.8 of the stable step", name), drifts.back(), 5e-3);
    }
    report.compare_absolute(fmt::format("{}: observed order", name), observed_order(inverse, drifts).order, 2,
                            smooth ? 0.1 : 0.3);
    chart.curves.push_back(line_curve(colour++, name, steps, drifts));
  }
  report.chart("energy", "Departure of the energy against the time step.", chart);
}

Vec2 turned(const Vec2& v, double angle) {
  return {std::cos(angle) * v.x() - std::sin(angle) * v.y(), std::sin(angle) * v.x() + std::cos(angle) * v.y()};
}

/// Velocities at the time of a frame itself: half a kick after those that are stored.
std::vector<Vec2> velocities_at(const StudyRun& run, const Scene& scene, int frame) {
  const auto x = field_of(run.positions(frame));
  const auto v = run.array("v", frame);
  const auto model = build_model(run.reader.sample(), scene.stages.back(), x);
  Field f(x.size());
  for (const Term* term : model->terms()) term->add_force(x, f);
  const double dt = std::stod(run.reader.provenance().at("time_step"));
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < x.size(); ++i)
    out.push_back(Vec2(v[2 * i], v[2 * i + 1]) + 0.5 * dt * model->inverse_mass[i] * f.at(i));
  return out;
}

double largest_distance(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

void objectivity(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Objectivity");
  report.text(
      "The tissue that tears itself apart once more, positions and velocities turned by 0.6435 rad; the answer is "
      "turned back.");
  Scene scene = bench.scene("tissue.toml");
  Sample sample = sample_of(scene);
  const StudyRun straight = bench.run("straight", sample, scene);
  const auto velocity = velocities_at(straight, scene, 0);
  const double angle = 0.6435;
  for (Vec2& x : sample.x) x = turned(x, angle);
  std::vector<Vec2> turned_velocity;
  for (const Vec2& v : velocity) turned_velocity.push_back(turned(v, angle));
  state_velocities(scene.stages[0], turned_velocity);
  const StudyRun run = bench.run("turned", sample, scene);
  auto back = run.positions();
  for (Vec2& x : back) x = turned(x, -angle);
  report.at_most("largest distance of a node from where it was", largest_distance(back, straight.positions()), 1e-9);
  report.holds(
      "the same links broke, in the same order",
      [&] {
        const auto &a = straight.reader.events(), &b = run.reader.events();
        if (a.size() != b.size()) return false;
        for (std::size_t k = 0; k < a.size(); ++k)
          if (a[k].link != b[k].link) return false;
        return true;
      }(),
      fmt::format("{} links", straight.reader.events().size()));
}

void reversal(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Time reversal");
  report.text(
      "The two rings that collide, then the same from where they ended with all velocities reversed. Velocities are "
      "stored half a step behind: "
      "what is\nreversed is that at the end itself, half a kick later, which [[initial]] puts half a step before the "
      "new start.");
  Scene scene = bench.scene("collision.toml");
  Sample sample = sample_of(scene);
  const StudyRun there = bench.run("there", sample, scene);
  const auto start = there.positions(0), end = there.positions();
  auto velocity = velocities_at(there, scene, there.reader.frames() - 1);
  for (Vec2& v : velocity) v = -v;
  sample.x = end;
  state_velocities(scene.stages[0], velocity);
  const StudyRun back = bench.run("back", sample, scene);
  report.at_most("largest distance of a node from where it began", largest_distance(back.positions(), start), 1e-9);
  report.at_least("how far the farthest had gone", largest_distance(start, end), 1);
}

}  // namespace

void study_invariants(StudyBench& bench) {
  momentum(bench);
  energy(bench);
  objectivity(bench);
  reversal(bench);
}

}  // namespace lamella
