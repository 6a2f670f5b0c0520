// Sec. 4.1 of the paper: the stiffness of a polygon's shell against pressure (Fig. 9, Eqs. 18 to 25), drained and undrained, and the pressure at which
// its bars yield.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "pipelines/studies/study.h"

namespace lamella {
namespace {

using std::numbers::pi;

const double kPlane = 1e5, kThickness = .05, kAxial = kPlane * kThickness;  // E', h, EA

/// K_shell = k_s / s tan(pi / N) with k_s = EA / l0.
double shell(int nodes) { return kAxial / (2 * std::cos(pi / nodes)); }

/// Pressure that holds a regular polygon whose sides are stretched by e: p s l cos(pi/N) = 2 T sin(pi/N) at every vertex, T = k_s l0 e,
/// l = l0 (1 + e). Hinges keep their angle.
double pressure(int nodes, double e) { return 2 * shell(nodes) * e / (1 + e); }

/// Growing function's zero.
template <typename Function>
double zero(double low, double high, const Function& f) {
  for (int k = 0; k < 200; ++k) (f((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  return low;
}

std::string segments(int nodes) { return fmt::format("sample.shapes.0.segments={}", nodes); }

/// Relative growth of the mean radius, and how far radii differ from it, relative.
struct Grown {
  double strain = 0, uneven = 0;
};
Grown grown(const StudyRun& run) {
  const auto x = run.positions();
  Vec2 middle = Vec2::Zero();
  for (const Vec2& p : x) middle += p / static_cast<double>(x.size());
  Grown g;
  for (const Vec2& p : x) g.strain += (p - middle).norm() / static_cast<double>(x.size());
  for (const Vec2& p : x) g.uneven = std::max(g.uneven, std::abs((p - middle).norm() / g.strain - 1));
  g.strain -= 1;
  return g;
}

std::vector<std::string> inflate(int nodes, double p) {
  return {segments(nodes), fmt::format("cells.core.pressure_history=[[0, 0], [1, {:.15g}]]", p)};
}

void stiffness(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("K_shell and the number of segments");
  report.text(
      "Pressure over relative change of area, at p = 1e-4 EA / R^2 s, over E' h / 2R. Exact is 1 / cos(pi/N), less the "
      "1.5e-4 that a stretch of "
      "1e-4 takes off. The paper's Eq. 22 gives it. Eq. 23 reads tan(pi/N) as 2 pi/N and takes k_s = E' h, which gives "
      "4 pi R / N s: it "
      "vanishes with many segments. With k_s = E' h s / l0 it is twice what it should be.");
  ReportTable table{{"N", "found", "1 / cos(pi/N)", "Eq. 23"}, {}};
  std::vector<double> ns, found, printed, fine, exact;
  for (int nodes : bench.small() ? std::vector<int>{12, 40} : std::vector<int>{6, 12, 20, 40, 80, 160}) {
    const double p = 1e-4 * kAxial;
    const StudyRun run = bench.run(fmt::format("linear_{}", nodes), "drained.toml", inflate(nodes, p));
    const double e = grown(run).strain, stiff = p / ((1 + e) * (1 + e) - 1) / (kAxial / 2);
    report.compare(fmt::format("N = {}: K_shell 2R / E' h", nodes), stiff, 1 / std::cos(pi / nodes), 1.6e-4);
    table.rows.push_back({fmt::format("{}", nodes), fmt::format("{:.6f}", stiff),
                          fmt::format("{:.6f}", 1 / std::cos(pi / nodes)), fmt::format("{:.3f}", 4 * pi / nodes)});
    ns.push_back(nodes), found.push_back(stiff), printed.push_back(4 * pi / nodes);
  }
  report.table(table);
  for (double n = ns.front(); n <= ns.back(); n *= 1.05) fine.push_back(n), exact.push_back(1 / std::cos(pi / n));
  Chart chart{.title = "Stiffness of the shell", .x_label = "segments", .y_label = "K_shell 2R / E' h"};
  chart.x_scale = Scale::kLogarithmic;
  chart.curves = {dotted_curve(0, "found", ns, found), line_curve(0, "1 / cos(pi/N)", fine, exact),
                  line_curve(1, "Eq. 23", ns, printed)};
  report.chart("stiffness", "K_shell depends on N by 1 / cos(pi/N) only.", chart);
}

void drained(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Drained: any pressure");
  report.text(
      "A drained polygon, up to a pressure of 1.5 K_shell: its sides are stretched by e with p = 2 K_shell e / (1 + "
      "e), exactly (Eqs. 20 and 21 without linearising). "
      "Past 2 K_shell no size holds it.");
  Chart chart{.title = "Pressure over size", .x_label = "V / V0 - 1", .y_label = "p / K_shell"};
  std::vector<double> volumes, pressures, fine, exact;
  for (double share : bench.small() ? std::vector<double>{.5} : std::vector<double>{.02, .1, .2, .5, 1, 1.5}) {
    const int nodes = 40;
    const double e = share / (2 - share);
    const StudyRun run =
        bench.run(fmt::format("drained_{:g}", share), "drained.toml", inflate(nodes, share * shell(nodes)));
    const Grown g = grown(run);
    report.compare(fmt::format("p = {:g} K_shell: R'/R", share), 1 + g.strain, 1 + e, 1e-6);
    report.at_most(fmt::format("p = {:g} K_shell: largest deviation of a radius", share), g.uneven, 1e-9);
    volumes.push_back((1 + g.strain) * (1 + g.strain) - 1), pressures.push_back(share);
  }
  if (!bench.small()) {
    const StudyRun stress = bench.run("plane_stress", "drained.toml",
                                      {"cells.core.pressure_history=[[0, 0], [1, 250]]", "cells.plane=stress"});
    const double stiffer = .91 * shell(40);
    report.compare("plane stress (E instead of E'), p = 250: R'/R", 1 + grown(stress).strain,
                   2 * stiffer / (2 * stiffer - 250), 1e-6);
  }
  for (double e = 0; e < 3; e += .02) fine.push_back((1 + e) * (1 + e) - 1), exact.push_back(2 * e / (1 + e));
  chart.curves = {line_curve(0, "exact", fine, exact), dotted_curve(0, "found", volumes, pressures),
                  line_curve(1, "linear, Eq. 22", {0, 1.5}, {0, 1.5})};
  report.chart("drained", "N = 40.", chart);
}

void undrained(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Undrained: K_e = K_core + K_shell");
  report.text(
      "A core with over-pressure p0 at its rest area expands until p0 - K ((1 + e)^2 - 1) = 2 K_shell e / (1 + e). At "
      "small p0 the effective modulus "
      "p0 / (V/V0 - 1) is K + K_shell (Eqs. 18 and 25, with the corrected K_shell).");
  const int nodes = 40;
  for (double eta : bench.small() ? std::vector<double>{1} : std::vector<double>{.5, 1, 10, 100}) {
    const double core = eta * shell(nodes);
    for (double share : {1e-4, .5}) {  // of K_e
      const double p0 = share * (core + shell(nodes));
      const StudyRun run = bench.run(fmt::format("undrained_{:g}_{:g}", eta, share), "undrained.toml",
                                     {segments(nodes), fmt::format("cells.core.modulus={:.15g}", core),
                                      fmt::format("cells.core.pressure={:.15g}", p0)});
      const double e = grown(run).strain;
      const double exact =
          zero(0, 2, [&](double s) { return pressure(nodes, s) + core * ((1 + s) * (1 + s) - 1) - p0; });
      const std::string which = fmt::format("eta = {:g}, p0 = {:g} K_e", eta, share);
      if (share < .1)
        report.compare(which + ": effective modulus over K_shell", p0 / ((1 + e) * (1 + e) - 1) / shell(nodes), 1 + eta,
                       1e-4);
      report.compare(which + ": R'/R", 1 + e, 1 + exact, 1e-6);
      report.compare(which + ": pressure left", run.array("pressure")[0], pressure(nodes, exact), 1e-5);
    }
  }
}

void yielding(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Bars that yield");
  const double yield = 5, e = yield / kAxial;
  report.text(
      "F_Y = 5, reached at a stretch of 0.001. Bars flow from p = F_Y / (s R' cos(pi/N)) on, R' = R (1 + F_Y / EA). "
      "The pressure grows slowly, and the first row "
      "with plastic work tells where. Then a core with the pressure 3 F_Y / R s inflates the polygon until p0 - K ((1 "
      "+ e)^2 - 1) = F_Y / (s R (1 + e) cos(pi/N)).");
  for (int nodes : bench.small() ? std::vector<int>{12} : std::vector<int>{6, 12, 40, 80}) {
    const double first = yield / ((1 + e) * std::cos(pi / nodes));
    const double top = 1.001 * first, time = 10;
    const StudyRun run = bench.run(
        fmt::format("yield_{}", nodes), "drained.toml",
        {segments(nodes), fmt::format("cells.yield_force={}", yield), fmt::format("stop.time={}", time),
         "output.response=5000",
         fmt::format("cells.core.pressure_history=[[0, 0], [1, {:.15g}], [{}, {:.15g}]]", .99 * first, time, top)});
    const auto times = run.column("time"), plastic = run.column("plastic");
    double found = 0;
    for (std::size_t k = 0; k < times.size() && found == 0; ++k)
      if (plastic[k] > 0) found = .99 * first + (times[k] - 1) / (time - 1) * (top - .99 * first);
    report.compare(fmt::format("N = {}: p R s / F_Y at first yield", nodes), found / yield,
                   1 / ((1 + e) * std::cos(pi / nodes)), 2e-4);
  }
  for (int nodes : bench.small() ? std::vector<int>{12} : std::vector<int>{12, 40}) {
    const double core = 10, p0 = 3 * yield;
    const StudyRun run = bench.run(
        fmt::format("flow_{}", nodes), "undrained.toml",
        {segments(nodes), fmt::format("cells.yield_force={}", yield), fmt::format("cells.core.modulus={}", core),
         fmt::format("cells.core.pressure={}", p0), "stop.time=400"});
    const auto held = [&](double s) { return yield / ((1 + s) * std::cos(pi / nodes)); };
    const double exact = zero(0, 2, [&](double s) { return held(s) + core * ((1 + s) * (1 + s) - 1) - p0; });
    report.compare(fmt::format("N = {}, flowing: R'/R", nodes), 1 + grown(run).strain, 1 + exact, 1e-4);
    report.compare(fmt::format("N = {}, flowing: pressure left", nodes), run.array("pressure")[0], held(exact), 1e-3);
    report.at_most(fmt::format("N = {}, flowing: residual of the ledger", nodes), run.ledger(), 1e-3);
  }
}

}  // namespace

void study_inflation(StudyBench& bench) {
  stiffness(bench);
  drained(bench);
  undrained(bench);
  yielding(bench);
}

}  // namespace lamella
