// Sec. 3 of the paper: cantilever and simply supported beam against the closed forms of the discrete model, then large deflections against
// the elastica.
#include <fmt/format.h>

#include <cmath>

#include "pipelines/studies/study.h"

namespace lamella {
namespace {

const double kLoad = 1e-4;  // slopes of 5e-5: what large deflections add is below 1e-8

std::string segments(int n) { return fmt::format("sample.shapes.0.segments={}", n); }

/// Deflections of the nodes, downward positive. Nodes of a clamp's ghost left out.
std::vector<Vec2> deflections(const StudyRun& run, int n) {
  const auto x = run.positions();
  std::vector<Vec2> out;
  for (std::size_t k = x.size() - static_cast<std::size_t>(n) - 1; k < x.size(); ++k)
    out.emplace_back(x[k].x(), -x[k].y());
  return out;
}

/// Deflection over the continuous beam's, for all n, against its closed form.
void small_deflections(StudyBench& bench) {
  StudyReport& report = bench.report;
  const std::vector<int> all = bench.small() ? std::vector<int>{8, 16} : std::vector<int>{8, 16, 20, 32, 64, 100};
  report.section("Small deflections: the closed forms of the discrete model");
  report.text(
      "Deflection over that of the continuous beam, with n segments. Half a hinge at the clamp is second order, a full "
      "one first.");
  struct Case {
    std::string name, scene, what;
    std::vector<std::string> settings;
    double beam;  // deflection of the continuous beam
    double (*closed_form)(double n);
  };
  const std::vector<Case> cases{
      {"cantilever",
       "cantilever.toml",
       "cantilever, half a hinge at the clamp",
       {},
       kLoad / 3,
       [](double n) { return 1 + 1 / (2 * n * n); }},
      {"naive",
       "cantilever.toml",
       "cantilever, a full hinge (naive clamp)",
       {"sample.shapes.0.clamp_hinge=full"},
       kLoad / 3,
       [](double n) { return 1 + 3 / (2 * n) + 1 / (2 * n * n); }},
      {"supported",
       "supported.toml",
       "two supports, load at the centre",
       {},
       kLoad / 48,
       [](double n) { return 1 + 2 / (n * n); }},
      {"uniform", "uniform.toml", "two supports, uniform load", {}, 5 * kLoad / 384, [](double n) {
         return 1 + 4 / (5 * n * n);
       }}};
  Chart chart{.title = "Error of the deflection", .x_label = "segments", .y_label = "relative error"};
  chart.x_scale = chart.y_scale = Scale::kLogarithmic;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const Case& one = cases[c];
    std::vector<double> ns, errors, fine, exact;
    for (int n : all) {
      auto settings = one.settings;
      settings.push_back(segments(n));
      const StudyRun run = bench.run(fmt::format("{}_{}", one.name, n), one.scene, settings);
      const auto nodes = deflections(run, n);
      const bool tip = one.scene == "cantilever.toml";
      const double ratio = nodes[static_cast<std::size_t>(tip ? n : n / 2)].y() / one.beam;
      report.compare(fmt::format("{}, n = {}", one.what, n), ratio, one.closed_form(n), 1e-6);
      ns.push_back(n), errors.push_back(ratio - 1);
    }
    for (double n = 8; n <= 100; n *= 1.1) fine.push_back(n), exact.push_back(one.closed_form(n) - 1);
    chart.curves.push_back(line_curve(static_cast<int>(c), one.what, fine, exact));
    chart.curves.push_back(dotted_curve(static_cast<int>(c), "", ns, errors));
    const Order order = observed_order(ns, errors);
    if (one.name == "naive")
      report.between("observed order of the naive clamp", order.order, 0.9, 1.2);
    else
      report.compare_absolute("observed order: " + one.what, order.order, 2, 0.05);
  }
  report.chart("deflections", "Errors of the four beams (dots) on their closed forms (lines).", chart);
}

void profiles(StudyBench& bench) {
  StudyReport& report = bench.report;
  const int n = 16;
  report.section("Profiles: Eq. 14 and the corrected Eq. 16");
  report.text(
      "Eq. 16 as printed is the profile under a uniform load; for the load at the centre it is xi (3 - 4 xi^2) on xi "
      "<= 1/2. The discrete\n"
      "profile may be off by its own closed form, at most 2 / n^2 of the largest deflection.");
  Chart chart{.title = "Profiles", .x_label = "x / L", .y_label = "deflection over the largest of the beam"};
  struct Profile {
    std::string name, scene, what;
    double largest;
    double (*shape)(double x);
  };
  const std::vector<Profile> all{
      {"profile_cantilever", "cantilever.toml", "cantilever, Eq. 14", kLoad / 3,
       [](double x) { return x * x * (3 - x) / 2; }},
      {"profile_point", "supported.toml", "load at the centre, corrected Eq. 16", kLoad / 48,
       [](double x) { return x <= 0.5 ? x * (3 - 4 * x * x) : (1 - x) * (3 - 4 * (1 - x) * (1 - x)); }},
      {"profile_uniform", "uniform.toml", "uniform load", 5 * kLoad / 384,
       [](double x) { return 3.2 * (x - 2 * x * x * x + x * x * x * x); }}};
  for (std::size_t p = 0; p < all.size(); ++p) {
    const Profile& profile = all[p];
    const StudyRun run = bench.run(profile.name, profile.scene, {segments(n)});
    std::vector<double> x, y, fine, exact;
    double worst = 0;
    for (const Vec2& node : deflections(run, n)) {
      x.push_back(node.x()), y.push_back(node.y() / profile.largest);
      worst = std::max(worst, std::abs(y.back() - profile.shape(node.x())));
    }
    for (int k = 0; k <= 100; ++k) fine.push_back(0.01 * k), exact.push_back(profile.shape(0.01 * k));
    report.at_most(profile.what + ": largest distance from the profile, n = 16", worst, 2.0 / (n * n) + 1e-6);
    chart.curves.push_back(line_curve(static_cast<int>(p), profile.what, fine, exact));
    chart.curves.push_back(dotted_curve(static_cast<int>(p), "", x, y));
  }
  report.chart("profiles", "Profiles at n = 16 (dots) on those of continuous beams (lines).", chart);
}

/// Tip of the elastica under a dead load a = P L^2 / EI (elliptic integrals, physics 2a).
struct Elastica {
  double a, x, y;
};
const Elastica kElastica[] = {{0.5, .98408104, .16214358}, {1, .94356676, .30172077},  {2, .83935828, .49345748},
                              {5, .61237164, .71379152},   {10, .44500440, .81060902}, {20, .31611443, .86869590}};

void large_deflections(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Large deflections: the elastica");
  report.text(
      "Tip of a cantilever under a dead load P, with a = P L^2 / EI, against elliptic integrals. Error: distance of "
      "the tips over L. Walls of\n"
      "EA L^2 / EI = 1e7 stand for inextensible ones.");
  Chart shapes{.title = "Cantilevers under a dead load", .x_label = "x / L", .y_label = "y / L"};
  Chart errors{.title = "Error of the tip", .x_label = "segments", .y_label = "distance over L"};
  errors.x_scale = errors.y_scale = Scale::kLogarithmic;
  const std::vector<int> all = bench.small() ? std::vector<int>{10, 20, 40} : std::vector<int>{10, 20, 40, 80};
  const double discrete_x[] = {.610980, .612027, .612286, .612350};  // a = 5, n = 10, 20, 40, 80
  const double discrete_y[] = {.717018, .714598, .713993, .713842};
  for (std::size_t e = 0; e < std::size(kElastica); ++e) {
    const Elastica& exact = kElastica[e];
    if (bench.small() && exact.a != 5) continue;
    std::vector<double> ns, distances, x, y;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const int n = all[k];
      const StudyRun run = bench.run(fmt::format("elastica_{:g}_{}", exact.a, n), "cantilever.toml",
                                     {segments(n), "cells.axial_rigidity=1e7", "stop.time=12", "loads.weight.ramp=3",
                                      fmt::format("loads.weight.force_y={}", -exact.a)});
      const auto nodes = deflections(run, n);
      const double distance = (nodes.back() - Vec2(exact.x, exact.y)).norm();
      ns.push_back(n), distances.push_back(distance);
      if (exact.a == 5) {
        report.compare_absolute(fmt::format("a = 5, n = {}: x of the tip, discrete equilibrium", n), nodes.back().x(),
                                discrete_x[k], 2e-6);
        report.compare_absolute(fmt::format("a = 5, n = {}: y of the tip, discrete equilibrium", n), nodes.back().y(),
                                discrete_y[k], 2e-6);
      }
      x.clear(), y.clear();
      for (const Vec2& node : nodes) x.push_back(node.x()), y.push_back(-node.y());
    }
    const Order order = observed_order(ns, distances);
    report.compare_absolute(fmt::format("a = {:g}: observed order (95 %: +- {:.3f})", exact.a, order.half_width),
                            order.order, 2, 0.05);
    report.at_most(fmt::format("a = {:g}: distance of the tips, n = {}", exact.a, all.back()), distances.back(),
                   1.0 / (all.back() * all.back()));
    const int colour = static_cast<int>(e);
    shapes.curves.push_back(line_curve(colour, fmt::format("a = {:g}", exact.a), x, y));
    shapes.curves.push_back(dotted_curve(colour, "", {exact.x}, {-exact.y}));
    errors.curves.push_back(dotted_curve(colour, fmt::format("a = {:g}", exact.a), ns, distances));
    errors.curves.push_back(line_curve(colour, "", ns, distances));
  }
  report.chart("elastica", "Shapes, and exact tips (dots).", shapes);
  report.chart("elastica_order", "Error of the tip over the number of segments: order 2.", errors);
  std::vector<double> ns, distances;
  for (int n : bench.small() ? std::vector<int>{10, 20} : std::vector<int>{16, 32, 64}) {
    const StudyRun run = bench.run(fmt::format("elastica_naive_{}", n), "cantilever.toml",
                                   {segments(n), "cells.axial_rigidity=1e7", "stop.time=12", "loads.weight.ramp=3",
                                    "loads.weight.force_y=-5", "sample.shapes.0.clamp_hinge=full"});
    ns.push_back(n), distances.push_back((deflections(run, n).back() - Vec2(.61237164, .71379152)).norm());
  }
  report.compare_absolute("a = 5, naive clamp: observed order", observed_order(ns, distances).order, 1, 0.1);
  if (!bench.small()) report.compare("a = 5, naive clamp, n = 64: distance of the tips", distances.back(), .0110, 0.02);
}

}  // namespace

void study_beams(StudyBench& bench) {
  small_deflections(bench);
  profiles(bench);
  large_deflections(bench);
}

}  // namespace lamella
