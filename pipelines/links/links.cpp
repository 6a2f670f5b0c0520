// Cohesive links alone: where one breaks over all mixes of opening and shear, and what blocks and lap joints of several hold.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "generator/sample/sample_file.h"
#include "pipelines/links/lap_strength.h"
#include "pipelines/studies/equilibrium.h"
#include "pipelines/studies/facing_chains.h"
#include "pipelines/studies/study.h"
#include "postproc/output_file.h"

namespace lamella {
namespace {

// ---- a single link ----

// single.toml
constexpr double kNormal = 1, kTangential = 0.1, kNormalStrength = 1, kShearStrength = 0.5;

/// Way along the path (u cos phi, u sin phi) at which zeta = a u + b^alpha u^alpha - 1 is 0.
double breaking_way(double phi, double alpha) {
  const double a = kNormal * std::cos(phi) / kNormalStrength, b = kTangential * std::sin(phi) / kShearStrength;
  if (alpha == 2) return 2 / (a + std::sqrt(a * a + 4 * b * b));
  const auto zeta = [&](double u) { return a * u + std::pow(b * u, alpha) - 1; };
  double low = 0, high = 1;
  while (zeta(high) < 0) high *= 2;
  for (int k = 0; k < 200; ++k) (zeta(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
  return low;
}

struct PathBreak {
  double way = 0, f_n = 0, f_t = 0, energy = 0;  // of the run's first event
  std::size_t broken = 0;                        // links, all in that step
  double ledger = 0;
};

PathBreak follow_path(StudyBench& bench, double degrees, double alpha, double time_step) {
  const double phi = degrees * std::numbers::pi / 180;
  const StudyRun run =
      bench.run(fmt::format("single_{:g}_{:g}_{:g}", degrees, alpha, time_step), "single.toml",
                {fmt::format("links.exponent={}", alpha), fmt::format("loads.move.velocity_x={}", std::sin(phi)),
                 fmt::format("loads.move.velocity_y={}", std::cos(phi)), fmt::format("run.time_step={}", time_step),
                 fmt::format("stop.time={}", std::ceil(1.05 * breaking_way(phi, alpha)))});
  const auto& events = run.reader.events();
  PathBreak found;
  if (events.empty()) return found;
  found = {events[0].time, events[0].f_n, std::abs(events[0].f_t), events[0].energy, 0, run.ledger()};
  for (const Event& e : events) found.broken += e.step <= events[0].step + 1 ? 1 : 0;
  return found;
}

void single_link(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("A single link: every mix of opening, shear and pressure");
  report.text(
      "The two sides of a link part along (u cos phi, u sin phi); beyond 90 degrees it is pressed. It breaks at "
      "u_c = 2 / (A + sqrt(A^2 + 4 B^2)) with A = k_n cos(phi) / f_n0, B = k_t sin(phi) / f_t0 (alpha = 2; for "
      "alpha = 4 the root is found numerically). The step is 1e-4, so that the first configuration beyond the "
      "criterion is at most 1e-4 beyond it. Both links of the wall break, to rounding, at once: within one step.");
  const std::vector<double> all = bench.small() ? std::vector<double>{0, 45, 90, 120}
                                                : std::vector<double>{0, 15, 30, 45, 60, 75, 80, 85, 90, 100, 120};
  Chart locus{.title = "Where a link breaks", .x_label = "f_n / f_n0", .y_label = "f_t / f_t0"};
  int colour = 0;
  double worst_ledger = 0;
  bool together = true;
  for (const double alpha : {2.0, 4.0}) {
    std::vector<double> x, y, curve_x, curve_y;
    for (const double degrees : all) {
      const double exact = breaking_way(degrees * std::numbers::pi / 180, alpha);
      const PathBreak found = follow_path(bench, degrees, alpha, 1e-4);
      report.compare(fmt::format("u_c, alpha = {:g}, phi = {:g} degrees", alpha, degrees), found.way, exact, 1.1e-4);
      // What the link loses, from tau = f_t / f_t0 on the curve.
      const double tau = kTangential * std::sin(degrees * std::numbers::pi / 180) * exact / kShearStrength;
      const double opening = 1 - std::pow(tau, alpha);
      const double lost = opening * opening + tau * tau * kShearStrength * kShearStrength * kNormal /
                                                  (kNormalStrength * kNormalStrength * kTangential);
      report.compare(fmt::format("energy at break over W_0, alpha = {:g}, phi = {:g} degrees", alpha, degrees),
                     found.energy / (kNormalStrength * kNormalStrength / (2 * kNormal)), lost, 4e-4);
      x.push_back(found.f_n / kNormalStrength), y.push_back(found.f_t / kShearStrength);
      worst_ledger = std::max(worst_ledger, found.ledger);
      together = together && found.broken == 2;
    }
    for (double t = 0; t <= 3.3; t += 0.01)
      if (1 - std::pow(t, alpha) > -9.4) curve_x.push_back(1 - std::pow(t, alpha)), curve_y.push_back(t);
    locus.curves.push_back(
        line_curve(colour, fmt::format("f_n / f_n0 + (f_t / f_t0)^{:g} = 1", alpha), curve_x, curve_y));
    locus.curves.push_back(dotted_curve(colour, "", x, y));
    ++colour;
  }
  report.holds("both links of the wall break within one step of each other", together,
               together ? "in every run" : "not in every run");
  report.at_most("largest residual of the energy ledger, all paths", worst_ledger, 1e-3);
  report.chart(
      "criterion",
      "Forces at which links of the runs broke (dots) on the yield curves. Pressed links (left of 0) hold more "
      "shear, without limit.",
      locus);
  report.text(
      "A link is found broken at the first step beyond the criterion, so its forces exceed it by at most k v dt / "
      "f0. At phi = 0, with v = 1:");
  for (const double step : {0.03, 0.003}) {
    const PathBreak found = follow_path(bench, 0, 2, step);
    report.between(fmt::format("f_n / f_n0 - 1 at the break, time step {:g}", step), found.f_n / kNormalStrength - 1, 0,
                   kNormal * step / kNormalStrength);
  }
}

// ---- blocks ----

/// Load at the first break of a run whose force grows smoothly to `full` over `time`.
double load_at_break(const StudyRun& run, double full, double time) {
  const auto& events = run.reader.events();
  return events.empty() ? std::nan("") : full * smooth_ramp(events.front().time / time);
}

void blocks(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Stiff blocks: n links at once, and one after another");
  report.text(
      "A block whose walls are 1e3 times stiffer than its links is pulled off another one by a force that grows "
      "slowly (over 50 periods of the block on its links). Pulled evenly, n links hold n f_n0, and break at one "
      "load, or nearly: what a wall bends makes them differ in the fourth digit. Pushed along the wall they hold n "
      "f_t0; pulled at the last link, f_n0 n (n + 1) / (4 n - 2), because links at the other end are pressed.");
  const double f_n0 = 1e-3, f_t0 = 5e-4;  // normal.toml and its like
  Chart chart{.title = "Blocks", .x_label = "links n", .y_label = "load at break over the strength of a link"};
  std::vector<double> n_line, normal_line, peel_line, n_dots, normal_dots, shear_dots, peel_dots;
  for (int n = 2; n <= 12; ++n)
    n_line.push_back(n), normal_line.push_back(n), peel_line.push_back(n * (n + 1) / (4.0 * n - 2));
  for (const int n : bench.small() ? std::vector<int>{3} : std::vector<int>{2, 3, 5, 11}) {
    const double omega = std::sqrt(n / 4.0);  // a block of mass 4 on n links of stiffness 1
    const double time = 2 * std::numbers::pi * (bench.small() ? 25 : 50) / omega;
    const auto run = [&](const std::string& kind, const char* force, double full) {
      return bench.run(fmt::format("{}_{}", kind, n), kind + ".toml",
                       {fmt::format("sample.walls.segments={}", n - 1), fmt::format("loads.pull.{}={}", force, full),
                        fmt::format("loads.pull.ramp={}", time), fmt::format("stop.time={}", time),
                        fmt::format("drag.rate={}", 0.03 * omega)});
    };
    /// Load at the n-th break over that at the first.
    const auto spread = [&](const StudyRun& r) {
      const auto& events = r.reader.events();
      if (events.size() < static_cast<std::size_t>(n)) return std::nan("");
      return smooth_ramp(events[n - 1].time / time) / smooth_ramp(events.front().time / time);
    };
    const double load = 2 * n * f_n0;
    const StudyRun normal = run("normal", "force_y", load), shear = run("shear", "force_x", load),
                   peel = run("peel", "force_y", 1.2 * (n + 4) / 4 * f_n0);
    const double normal_found = load_at_break(normal, load, time) / f_n0;
    const double shear_found = load_at_break(shear, load, time) / f_t0;
    const double peel_found = load_at_break(peel, 1.2 * (n + 4) / 4 * f_n0, time) / f_n0;
    report.compare(fmt::format("pulled evenly, n = {}: F_c / f_n0", n), normal_found, n, 2e-3);
    report.compare(fmt::format("pushed along, n = {}: F_c / f_t0", n), shear_found, n, 2e-3);
    report.compare(fmt::format("peeled, n = {}: F_c / f_n0", n), peel_found, n * (n + 1) / (4.0 * n - 2), 2e-3);
    report.compare(fmt::format("pulled evenly, n = {}: load at the last break over that at the first", n),
                   spread(normal), 1, 1e-3);
    n_dots.push_back(n), normal_dots.push_back(normal_found), shear_dots.push_back(shear_found),
        peel_dots.push_back(peel_found);
  }
  chart.curves = {line_curve(0, "pulled evenly: n", n_line, normal_line),
                  line_curve(1, "peeled: n (n + 1) / (4 n - 2)", n_line, peel_line),
                  dotted_curve(0, "", n_dots, normal_dots),
                  dotted_curve(2, "pushed along the wall", n_dots, shear_dots), dotted_curve(1, "", n_dots, peel_dots)};
  report.chart("blocks", "Loads at which stiff blocks broke loose (dots) and the balance of forces (lines).", chart);
}

// ---- lap shear ----

void lap_shear(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Lap shear: n links share a pull");
  report.text(
      "Two chains of bars k_s with n tangential links k_t, pulled at opposite ends: T_c = f_t0 sinh(n mu / 2) / "
      "(sinh(mu / 2) cosh(mu (n - 1) / 2)), 2 cosh(mu) = 2 + 2 k_t / k_s. However many links there are, a joint "
      "holds no more than 2 f_t0 / (1 - e^-mu). *Static* rows solve for equilibrium, the others are runs under a "
      "slowly growing pull (100 periods of the slowest swing).");
  Chart chart{.title = "Lap joints", .x_label = "links n", .y_label = "T_c / f_t0"};
  chart.x_scale = Scale::kLogarithmic;
  const std::filesystem::path samples = bench.out() / "samples";
  make_folder(samples);
  double worst_ledger = 0;
  int colour = 0;
  for (const double ratio : {0.01, 0.1, 1.0}) {
    std::vector<double> x_line, y_line, x, y;
    for (int n = 2; n <= 60; ++n) x_line.push_back(n), y_line.push_back(lap_strength(n, ratio));
    const std::vector<int> all = bench.small() ? std::vector<int>{2, 5, 10} : std::vector<int>{2, 5, 10, 20, 40};
    for (const int n : all) {
      const Sample sample = make_facing_chains({.segments = n - 1});
      write_sample(samples / fmt::format("lap_{}.h5", n), sample);
      std::vector<std::string> settings{fmt::format("links.tangential_stiffness={}", ratio)};
      const double omega = lowest_frequency_of(sample, bench.scene("lap_shear.toml", settings));
      const double time = 2 * std::numbers::pi * (bench.small() ? 50 : 100) / omega,
                   full = 2e-3 * lap_strength(n, ratio);
      settings.insert(settings.end(),
                      {fmt::format("drag.rate={}", 0.03 * omega), fmt::format("loads.pull.force_x={}", full),
                       fmt::format("loads.pull.ramp={}", time), fmt::format("stop.time={}", time),
                       fmt::format("run.time_step={}", std::min(0.1, time / 20000))});
      const Scene scene = bench.scene("lap_shear.toml", settings);
      const StudyRun run = bench.run(fmt::format("lap_{:g}_{}", ratio, n), sample, scene);
      const double exact = lap_strength(n, ratio), found = load_at_break(run, full, time) / 1e-3;
      report.compare(fmt::format("k_t / k_s = {:g}, n = {}: T_c / f_t0", ratio, n), found, exact, 2e-3);
      const Field rest = field_of(sample.x);
      const auto model = build_model(sample, scene.stages.front(), rest);
      const StaticBreak at_rest = find_first_break(*model, build_loads(sample, scene.stages.front()), rest, 0.1);
      report.compare(fmt::format("k_t / k_s = {:g}, n = {}: T_c / f_t0, static", ratio, n),
                     at_rest.factor * full / 1e-3, exact, 1e-8);
      worst_ledger = std::max(worst_ledger, run.ledger());
      x.push_back(n), y.push_back(found);
    }
    const double limit = 2 / (1 - std::exp(-std::acosh(1 + ratio)));
    chart.curves.push_back(line_curve(colour, fmt::format("k_t / k_s = {:g}", ratio), x_line, y_line));
    chart.curves.push_back(dotted_curve(colour, "", x, y));
    Curve bound = line_curve(colour, "", {2, 60}, {limit, limit});
    bound.style.width = 0.8, bound.style.dashes = {3, 3};
    chart.curves.push_back(bound);
    ++colour;
  }
  report.at_most("largest residual of the energy ledger", worst_ledger, 1e-3);
  report.chart("lap_shear", "Strength of lap joints: runs (dots), closed form (lines), limit of many links (dashed).",
               chart);
}

}  // namespace

void study_links(StudyBench& bench) {
  single_link(bench);
  blocks(bench);
  lap_shear(bench);
}

}  // namespace lamella
