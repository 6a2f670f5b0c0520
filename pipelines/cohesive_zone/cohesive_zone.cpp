// Links that soften: one over all mode mixes against its closed forms, a crack between two beams against its toughness, and what the spacing
// of the links does to the strength of a honeycomb, beside brittle ones.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipelines/cohesive_zone/grown_crack.h"
#include "pipelines/cohesive_zone/split_beam.h"
#include "pipelines/studies/study.h"

namespace lamella {
namespace {

// ---- one link ----

// pair.toml
constexpr double kNormal = 1, kTangential = 0.3, kNormalStrength = 1, kShearStrength = 0.5, kToughness = 2,
                 kShearToughness = 5;

/// The closed form along (u cos phi, u sin phi): force along the path over u, for alpha = 2.
struct Path {
  double begins = 0, ends = 0;  // u
  double peak = 0;              // force along the path
  double toughness = 0;

  Path(double phi, bool power) {
    const double c = std::cos(phi), s = std::sin(phi), stiffness = kNormal * c * c + kTangential * s * s;
    const double a = kNormal * c / kNormalStrength, b = kTangential * s / kShearStrength;
    begins = 2 / (a + std::sqrt(a * a + 4 * b * b));
    peak = stiffness * begins;
    const double shear = kTangential * s * s / stiffness;
    toughness = power ? 1 / ((1 - shear) / kToughness + shear / kShearToughness)
                      : kToughness + (kShearToughness - kToughness) * shear * shear;
    ends = 2 * toughness / peak;
  }
  double force(double u) const {
    if (u < begins) return peak * u / begins;
    return u < ends ? peak * (ends - u) / (ends - begins) : 0;
  }
};

void one_link(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("One link: every mix of opening and shear");
  report.text(
      "The two sides of a link part along (u cos phi, u sin phi), until its criterion is reached at u_c and on until "
      "it is gone. Along such a path the force is a triangle: it peaks on the criterion, ends at 2 G_c / peak, and "
      "has the area G_c, the toughness at the mix of the path: by Benzeggagh and Kenane, eta = 2, and by the power "
      "law, eta = 1.");
  Chart chart{.title = "A link along straight paths", .x_label = "way u", .y_label = "force along the path"};
  int colour = 0;
  double worst_curve = 0, worst_ledger = 0;
  for (const bool power : {false, true})
    for (const double degrees :
         bench.small() ? std::vector<double>{0, 60, 90} : std::vector<double>{0, 15, 30, 45, 60, 75, 90}) {
      const double phi = degrees * std::numbers::pi / 180;
      const Path exact(phi, power);
      const double time = std::ceil(1.05 * exact.ends);
      const std::string law = power ? "power" : "benzeggagh_kenane",
                        where = fmt::format("{}, phi = {:g} degrees", power ? "power law" : "BK", degrees);
      const StudyRun run =
          bench.run(fmt::format("pair_{}_{:g}", law, degrees), "pair.toml",
                    {fmt::format("links.mixing=\"{}\"", law), fmt::format("loads.move.velocity_x={}", std::sin(phi)),
                     fmt::format("loads.move.velocity_y={}", std::cos(phi)), fmt::format("stop.time={}", time)});
      const auto& events = run.reader.events();
      report.compare(where + ": energy of the break over G_c", events.empty() ? 0 : events[0].energy / exact.toughness,
                     1, 1e-9);
      // The upper square is set in motion by the load.
      report.compare(where + ": work of the load but for the motion over 2 G_c",
                     (run.last("work") - run.last("kinetic")) / (2 * exact.toughness), 1, 1e-6);
      report.compare(where + ": u where it is gone", events.empty() ? 0 : events[0].time, exact.ends,
                     2e-3 / exact.ends);
      std::vector<double> u = run.column("time"), along = run.column("force_y_move"),
                          across = run.column("force_x_move");
      std::vector<double> x, y, line_x, line_y;
      for (std::size_t k = 0; k < u.size(); ++k) {
        const double force = 0.5 * std::abs(along[k] * std::cos(phi) + across[k] * std::sin(phi));
        worst_curve = std::max(worst_curve, std::abs(force - exact.force(u[k])) / exact.peak);
        if (k % 60 == 0) x.push_back(u[k]), y.push_back(force);
      }
      worst_ledger = std::max(worst_ledger, run.ledger());
      if (power || (degrees != 0 && degrees != 60 && degrees != 75 && degrees != 90)) continue;
      for (const double at : {0.0, exact.begins, exact.ends, time})
        line_x.push_back(at), line_y.push_back(exact.force(at));
      chart.curves.push_back(line_curve(colour, fmt::format("{:g} degrees", degrees), line_x, line_y));
      chart.curves.push_back(dotted_curve(colour++, "", x, y));
    }
  report.at_most("force beside the closed form: largest difference over the peak, all rows of all paths", worst_curve,
                 2e-3);
  report.at_most("largest residual of the energy ledger, all paths", worst_ledger, 1e-5);
  report.chart("paths", "Runs (dots) on the closed forms, Benzeggagh and Kenane's toughness.", chart);
}

// ---- a crack between two beams ----

void beams(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("A crack between two beams: J is the toughness");
  report.text(
      "Two beams are pulled apart slowly. Where forces P part their ends, which turn by theta each, the contour "
      "integral is J s = 2 P theta, P^2 a^2 / EI for slender arms and a short zone: P = sqrt(G s EI) / a. It must be "
      "the toughness while the crack grows, over however many spacings links soften: (EI G / f^2)^(1/4) says how "
      "many, roughly. Means over all frames from the second lost link on; single frames scatter more, because links "
      "go one by one.");
  Chart chart{.title = "Contour integral while a crack grows", .x_label = "time", .y_label = "J / G"};
  ReportTable table{{"(EI G / f^2)^(1/4) in spacings", "mean of J / G", "lowest", "highest"}, {}};
  int colour = 0;
  for (const double zone : bench.small() ? std::vector<double>{5} : std::vector<double>{1.5, 2, 3, 5, 8}) {
    const GrownCrack grown = grow_crack(bench, "beams.toml", zone);
    table.rows.push_back({fmt::format("{:g}", zone), fmt::format("{:.4f}", grown.mean),
                          fmt::format("{:.3f}", grown.lowest), fmt::format("{:.3f}", grown.highest)});
    if (zone >= 2) {
      report.compare(fmt::format("zone of {:g} spacings: mean of J / G", zone), grown.mean, 1, 1e-2);
      report.at_most(fmt::format("zone of {:g} spacings: residual of the energy ledger", zone), grown.ledger, 1e-4);
    }
    if (zone == 1.5 || zone == 3 || zone == 8 || bench.small())
      chart.curves.push_back(line_curve(colour++, fmt::format("{:g} spacings", zone), grown.time, grown.ratio));
  }
  report.table(table);
  report.chart("contour_integral",
               "Below two spacings the load rises between links that go one by one, and their energy goes into "
               "vibration; beyond, the crack grows smoothly.",
               chart);
}

// ---- a crack between two beams that slide ----

void split(StudyBench& bench) {
  using B = SplitBeam;
  StudyReport& report = bench.report;
  report.section("A crack in shear: an end-loaded split, at rest");
  report.text(fmt::format(
      "Two beams of thickness h = {:g}, bonded from x = {:g} on and held at x = L = {:g}, are bent at their free ends, "
      "both alike: the crack slides and does not open. Arms of rigidity EI share the force P, behind the crack both "
      "bend as one of EI_b = 2 EI + EA h^2 / 2 = {:g} EI: J s = P^2 a^2 (1 / 4 EI - 1 / 2 EI_b), and linear fracture "
      "mechanics says at which P the crack stands where the ends have gone a way. Neither needs the zone in which "
      "links "
      "soften, over some 5 of length; J is taken from forces and turns alone, P (theta_0 - theta_c) - M_c^2 / 2 EI_b "
      "with "
      "a section c ahead of the zone. Where links are few in the zone they go in groups, and the beams part a little "
      "while "
      "they do: the mode mix of the broken links, pi / 2 in pure shear, says how much.",
      B::kThickness, B::kCrack, B::kLength, B::kBonded));
  ReportTable table{{"spacing", "links gone", "mean of J / G", "lowest", "highest", "error of P, mean",
                     "mode mix, mean [rad]", "seconds"},
                    {}};
  Chart j{.title = "Contour integral while a crack slides", .x_label = "way of the ends", .y_label = "J / G"};
  Chart p{.title = "End-loaded split", .x_label = "way of the ends", .y_label = "P"};
  const double toughness = 1.5e-9;
  int colour = 0;
  std::vector<double> spacing, error;
  for (const int n : bench.small() ? std::vector<int>{100} : std::vector<int>{50, 100, 200, 400}) {
    const SplitCrack grown = slide_crack(bench, n, 5, toughness);
    const double l = B::kLength / n;
    table.rows.push_back({fmt::format("{:g}", l), fmt::format("{}", grown.broken), fmt::format("{:.4f}", grown.mean),
                          fmt::format("{:.3f}", grown.lowest), fmt::format("{:.3f}", grown.highest),
                          fmt::format("{:.2g} %", 100 * grown.force_error), fmt::format("{:.3f}", grown.mode_mix),
                          fmt::format("{:.2g}", grown.seconds)});
    spacing.push_back(l), error.push_back(grown.force_error);
    if (l <= 1) {
      report.compare(fmt::format("spacing {:g}: mean of J / G", l), grown.mean, 1, l < 1 ? 5e-3 : 2e-2);
      report.at_most(fmt::format("spacing {:g}: P against linear fracture mechanics, mean error", l), grown.force_error,
                     l < 1 ? 1e-2 : 2e-2);
      if (l < 1) report.at_least(fmt::format("spacing {:g}: mean mode mix [rad]", l), grown.mode_mix, 1.5);
    }
    j.curves.push_back(line_curve(colour, fmt::format("spacing {:g}", l), grown.way, grown.ratio));
    p.curves.push_back(dotted_curve(colour++, fmt::format("spacing {:g}", l), grown.way, grown.force));
  }
  if (!bench.small()) {
    bool falls = true;
    for (std::size_t k = 1; k < error.size(); ++k) falls = falls && error[k] < error[k - 1];
    report.holds("error of P falls whenever the spacing is halved", falls,
                 fmt::format("order {:.2f} from spacing {:g} to {:g}",
                             std::log(error.front() / error.back()) / std::log(spacing.front() / spacing.back()),
                             spacing.front(), spacing.back()));
  }
  std::vector<double> x, y;
  for (double a = B::kCrack; a <= 85; a += 0.5) {
    y.push_back(std::sqrt(toughness / B::release(1, a))), x.push_back(B::way(y.back(), a));
  }
  p.curves.push_back(line_curve(colour, "linear fracture mechanics", x, y));
  report.table(table);
  report.chart("split_contour_integral", "J rises to the toughness in shear, and stays there while the crack grows.",
               j);
  report.chart("split_force", "The force at the ends, beside that at which the crack stands.", p);
}

// ---- a honeycomb ----

struct Torn {
  double peak = 0;  // over f_n0
  double ledger = 0;
};

Torn tear(StudyBench& bench, const char* law, int segments, double stiffness) {
  std::vector<std::string> settings{
      fmt::format("sample.walls.segments={}", segments), fmt::format("links.normal_stiffness={}", stiffness),
      fmt::format("links.tangential_stiffness={}", 0.3 * stiffness), fmt::format("links.law=\"{}\"", law)};
  Scene scene = bench.scene("honeycomb.toml", settings);
  const StudyRun run = bench.run(fmt::format("{}_{}_{:g}", law, segments, stiffness), sample_of(scene), scene);
  Torn out;
  out.ledger = run.ledger();
  for (const double stress : run.column("stress")) out.peak = std::max(out.peak, stress);
  return out;
}

void honeycomb(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("A honeycomb: the spacing of the links");
  report.text(
      "Twenty-five hexagons of side 1 are torn apart slowly, with m segments a wall. Strengths are per length of "
      "wall. Brittle links next to a corner carry the more, the closer they are to it: the strength of the honeycomb "
      "falls as m grows, and the more so the stiffer they are. Links that soften (over about 0.4 of a wall) share the "
      "load out before they go: the strength settles.");
  Chart chart{.title = "Strength of a honeycomb", .x_label = "segments a wall m", .y_label = "peak stress L / f_n0"};
  chart.x_scale = Scale::kLogarithmic;
  ReportTable table{{"m", "brittle, k_n = 200", "brittle, k_n = 2000", "softening, k_n = 200", "softening, k_n = 2000"},
                    {}};
  const std::vector<int> all = bench.small() ? std::vector<int>{4, 8} : std::vector<int>{2, 4, 8, 16, 24};
  const std::vector<double> stiffnesses = bench.small() ? std::vector<double>{200} : std::vector<double>{200, 2000};
  for (const int m : all) table.rows.push_back({fmt::format("{}", m), "", "", "", ""});
  double worst_ledger = 0;
  int column = 1, colour = 0;
  for (const char* law : {"brittle", "cohesive_zone"})
    for (const double k_n : {200.0, 2000.0}) {
      const int at = column++;
      if (std::find(stiffnesses.begin(), stiffnesses.end(), k_n) == stiffnesses.end()) continue;
      std::vector<double> x, y;
      for (std::size_t row = 0; row < all.size(); ++row) {
        const Torn torn = tear(bench, law, all[row], k_n);
        x.push_back(all[row]), y.push_back(torn.peak);
        table.rows[row][at] = fmt::format("{:.4f}", torn.peak);
        worst_ledger = std::max(worst_ledger, torn.ledger);
      }
      const bool softens = law == std::string("cohesive_zone");
      const std::string name = fmt::format("{}, k_n = {:g}", softens ? "softening" : "brittle", k_n);
      if (softens)
        for (std::size_t row = 0; row + 1 < all.size(); ++row)
          if (all[row] >= 4)
            report.compare(fmt::format("{}: peak at m = {} over that at m = {}", name, all[row], all.back()),
                           y[row] / y.back(), 1, k_n > 200 ? 2e-2 : 1e-2);
      if (!softens)
        report.at_least(fmt::format("{}: peak at m = {} over that at m = {}", name, all.front(), all.back()),
                        y.front() / y.back(), bench.small() ? 1.01 : 1.2);
      chart.curves.push_back(line_curve(colour, name, x, y));
      chart.curves.push_back(dotted_curve(colour++, "", x, y));
    }
  report.table(table);
  report.at_most("largest residual of the energy ledger, all runs", worst_ledger, 1e-3);
  report.chart("spacing", "Peak stress by the spacing of the links, brittle and softening.", chart);
}

}  // namespace

void study_cohesive_zone(StudyBench& bench) {
  one_link(bench);
  beams(bench);
  split(bench);
  honeycomb(bench);
}

}  // namespace lamella
