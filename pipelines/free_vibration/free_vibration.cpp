// Rings that nothing holds: frequencies, spin, buckling under pressure; and what the motion of any sample must conserve.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "pipelines/free_vibration/free_motion.h"

namespace lamella {
namespace {

constexpr double kPi = std::numbers::pi;

std::string segments(int n) { return fmt::format("sample.shapes.0.segments={}", n); }

/// Velocities of the mode of n waves whose wall does not stretch: cos(n theta) outwards, -sin(n theta) / n along. n = 0: breathing.
Vec2 mode_velocity(const Vec2& x, int n) {
  const double theta = std::atan2(x.y(), x.x());
  const Vec2 outwards = x / x.norm();
  return std::cos(n * theta) * outwards - (n > 0 ? std::sin(n * theta) / n : 0.0) * left_of(outwards);
}

/// The part of the ring's shape that has n waves, at equal times.
struct Swing {
  std::vector<double> amplitude;
  double interval = 0;  // [s]
};

Swing swing_of(const StudyRun& run, int n, int stage) {
  Swing out;
  std::vector<double> times;
  for (int f = 0; f < run.reader.frames(); ++f) {
    const Frame frame = run.reader.frame(f);
    if (frame.stage != stage) continue;
    times.push_back(frame.time);
    const auto x = run.positions(f);
    double sum = 0;
    for (std::size_t k = 0; k < x.size(); ++k)
      sum += x[k].norm() * std::cos(n * 2 * kPi * static_cast<double>(k) / static_cast<double>(x.size()));
    out.amplitude.push_back((n > 0 ? 2 : 1) * sum / static_cast<double>(x.size()));
  }
  out.amplitude.pop_back();  // one step after the frame before it
  out.interval = times[1] - times[0];
  return out;
}

/// Angular frequency of a sinusoid about a constant: y(k - s) + y(k + s) = 2 cos(w s interval) y(k) + constant for every k, by least
/// squares, with s such that the cosine's angle is about 1.2.
double frequency(const Swing& swing, double guess) {
  const auto& y = swing.amplitude;
  const auto s = static_cast<std::size_t>(std::max(1.0, std::round(1.2 / (guess * swing.interval))));
  double yy = 0, y1 = 0, count = 0, zy = 0, z1 = 0;
  const double middle = y[0];  // the constant is large beside the swing
  for (std::size_t k = s; k + s < y.size(); ++k) {
    const double here = y[k] - middle, z = y[k - s] + y[k + s] - 2 * middle;
    yy += here * here, y1 += here, zy += z * here, z1 += z, count += 1;
  }
  const double slope = (count * zy - z1 * y1) / (count * yy - y1 * y1);
  return std::acos(0.5 * slope) / (static_cast<double>(s) * swing.interval);
}

void modes(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Frequencies of a free ring");
  report.text(
      "Unit: sqrt(EI / mu R^4), with EA R^2 / EI = 4800. All three modes swing in one run, by 1e-5 R; the part of the "
      "shape with n waves "
      "swings with omega_n.");
  struct Row {
    int nodes;
    double exact[3];
  };
  const Row rows[] = {
      {20, {2.64054, 7.17405, 12.97341}}, {40, {2.67209, 7.48280, 14.14333}}, {80, {2.67995, 7.56082, 14.44526}}};
  const double ring[] = {2.68328, 7.58947, 14.55214};
  std::vector<double> ns;
  std::vector<double> errors[3];
  Chart swings{
      .title = "One run, three modes", .x_label = "time", .y_label = "part of the shape with n waves / 1e-5 R"};
  for (const Row& row : rows) {
    if (bench.small() && row.nodes == 80) continue;
    Scene scene = bench.scene("ring.toml", {segments(row.nodes)});
    const Sample sample = sample_of(scene);
    state_velocities(scene.stages[0], sample, [](const Vec2& x) {
      Vec2 v = Vec2::Zero();
      for (int n : {2, 3, 4}) v += 1e-5 * mode_velocity(x, n);
      return v;
    });
    const StudyRun run = bench.run(fmt::format("ring_{}", row.nodes), sample, scene);
    ns.push_back(row.nodes);
    for (int n : {2, 3, 4}) {
      const Swing swing = swing_of(run, n, 0);
      const double found = frequency(swing, ring[n - 2]);
      report.compare(fmt::format("N = {}: omega_{}", row.nodes, n), found, row.exact[n - 2], 1e-5);
      errors[n - 2].push_back(found / ring[n - 2] - 1);
      if (row.nodes != 40) continue;
      std::vector<double> t, y;
      for (std::size_t f = 0; f < swing.amplitude.size(); ++f)
        t.push_back(static_cast<double>(f) * swing.interval), y.push_back(swing.amplitude[f] / 1e-5);
      swings.curves.push_back(line_curve(n - 2, fmt::format("n = {}", n), t, y));
    }
  }
  report.text(
      "The continuous ring of the formula cannot stretch. Walls of S = 4800 can, and swing slower by about 1 / S: with "
      "N = 80 this shows in the order of the "
      "lowest mode.");
  for (int n : {2, 3, 4})
    report.compare_absolute(fmt::format("observed order, omega_{} against the continuous ring", n),
                            observed_order(ns, errors[n - 2]).order, 2, n == 2 ? 0.2 : 0.1);
  report.chart("modes", "The modes of two, three and four waves, N = 40.", swings);

  report.text(
      "Breathing stretches the walls only: omega = sqrt(4 k_s sin^2(pi / N) / m) = sqrt(EA / mu R^2), whatever N.");
  for (const Row& row : rows) {
    if (bench.small() && row.nodes == 80) continue;
    Scene scene = bench.scene("ring.toml", {segments(row.nodes), "stop.time=1", "run.step_fraction=0.02"});
    const Sample sample = sample_of(scene);
    state_velocities(scene.stages[0], sample, [](const Vec2& x) -> Vec2 { return 1e-5 * mode_velocity(x, 0); });
    const StudyRun run = bench.run(fmt::format("breathing_{}", row.nodes), sample, scene);
    report.compare(fmt::format("N = {}: breathing", row.nodes), frequency(swing_of(run, 0, 0), 69.28203), 69.28203,
                   1e-5);
  }
}

/// Mean of a quantity that swings about it, weighted so that the ends do not count.
double smooth_mean(const std::vector<double>& values) {
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double w = 1 - std::cos(2 * kPi * (static_cast<double>(k) + 0.5) / static_cast<double>(values.size()));
    sum += w * values[k], weights += w;
  }
  return sum / weights;
}

void spin(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("A spinning polygon");
  report.text(
      "R' / R = 1 / (1 - m Omega^2 / (4 k_s sin^2(pi / N))): hinges of a polygon that grows do not notice. Dashpots in "
      "the "
      "bars bring the breathing to\nrest. They work with velocities half a step old, which in a rotation look like a "
      "stretching with the rate Omega^2 dt / 2, so they are taken out\nbefore anything is measured; what is left of "
      "the "
      "breathing is averaged out.");
  const StudyRun run = bench.run("spin", "spin.toml");
  const Scene scene = bench.scene("spin.toml");
  std::vector<double> sizes, rates;
  double start = 0, end = 0;
  for (int f = 0; f < run.reader.frames(); ++f) {
    const Motion motion = motion_of(scene, run, f);
    (f == 0 ? start : end) = motion.angular_momentum;
    if (run.reader.frame(f).stage == 0) continue;
    double size = 0;
    const auto x = run.positions(f);
    for (const Vec2& p : x) size += p.norm() / static_cast<double>(x.size());
    sizes.push_back(size), rates.push_back(motion.angular_momentum / motion.moment_of_inertia);
  }
  report.compare("R' / R at Omega = 10, EA R^2 / EI = 4800", smooth_mean(sizes), 1.0212766, 2e-6);
  report.compare("Omega", smooth_mean(rates), 10, 4e-6);
  report.at_most("change of the angular momentum, relative", std::abs(end - start) / start, 1e-12);
}

/// A ring under pressure, brought to rest by dashpots and then swinging in the mode of two waves.
Swing swing_under(StudyBench& bench, int nodes, double pressure) {
  Scene scene = bench.scene("pressed.toml", {segments(nodes), fmt::format("cells.core.pressure=-{}", pressure)});
  const Sample sample = sample_of(scene);
  state_velocities(scene.stages[1], sample, [](const Vec2& x) -> Vec2 { return 1e-5 * mode_velocity(x, 2); });
  return swing_of(bench.run(fmt::format("pressed_{}_{:.4g}", nodes, pressure), sample, scene), 2, 1);
}

void buckling(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Pressure from outside");
  report.text(
      "A pressure that follows the surface (a drained core of negative pressure) lowers the square of the lowest "
      "frequency "
      "in proportion, to 0 at p_c, where the\nring buckles. The line through the squares at p = 1.5 and 2.5 EI / R^3 "
      "is "
      "followed to 0; the square at 0.5 shows that it is a line. EA R^2 / EI = 48000.");
  Chart chart{.title = "The lowest frequency under pressure",
              .x_label = "p R^3 / EI",
              .y_label = "square of the frequency / (EI / mu R^4)"};
  int colour = 0;
  struct Row {
    int nodes;
    double critical;
  };
  for (const Row& row : {Row{12, 2.82843}, {20, 2.93829}, {40, 2.98458}, {80, 2.99615}}) {
    if (bench.small() && row.nodes > 20) continue;
    std::vector<double> p{0.5, 1.5, 2.5}, squares;
    for (const double pressure : p) {
      const double w = frequency(swing_under(bench, row.nodes, pressure), std::sqrt(2.4 * (row.critical - pressure)));
      squares.push_back(w * w);
    }
    const double slope = (squares[2] - squares[1]) / (p[2] - p[1]), critical = p[2] - squares[2] / slope;
    report.compare(fmt::format("N = {}: p_c R^3 / EI", row.nodes), critical, row.critical, 2e-4);
    report.compare(fmt::format("N = {}: square of the frequency at p = 0.5, beside the line", row.nodes), squares[0],
                   squares[1] + slope * (p[0] - p[1]), 1e-3);
    chart.curves.push_back(
        line_curve(colour, fmt::format("N = {}", row.nodes), {0.5, critical}, {squares[2] + slope * (0.5 - p[2]), 0}));
    chart.curves.push_back(dotted_curve(colour++, "", p, squares));
  }
  report.chart("pressure", "Squares of the lowest frequency (dots) and the lines through the last two of each.", chart);

  const double critical = 2.93829;  // N = 20
  const auto largest = [&](double share) {
    double most = 0;
    for (double a : swing_under(bench, 20, share * critical).amplitude) most = std::max(most, std::abs(a) / 1e-5);
    return most;
  };
  // about 1 / 0.59 with sin or sinh(0.59 t), t up to 10
  report.between("N = 20, 5 % below p_c: largest swing, over the velocity of the kick", largest(0.95), 1.3, 2.1);
  report.at_least("N = 20, 5 % above p_c: the same", largest(1.05), 100);
}

}  // namespace

void study_invariants(StudyBench& bench);

void study_free_vibration(StudyBench& bench) {
  modes(bench);
  spin(bench);
  buckling(bench);
  study_invariants(bench);
}

}  // namespace lamella
