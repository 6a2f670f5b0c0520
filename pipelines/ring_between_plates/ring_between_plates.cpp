// Sec. 4 of the paper without core and plasticity: an elastic ring between rigid plates against the discrete model's own equilibria and
// against the elastica, there and back.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipelines/ring_between_plates/elastica.h"
#include "pipelines/ring_between_plates/paper_claims.h"
#include "pipelines/ring_between_plates/pressed_ring.h"
#include "pipelines/ring_between_plates/ring_charts.h"
#include "pipelines/studies/study.h"

namespace lamella {
namespace {

using std::numbers::pi;
using Ring = PressedRing;

enum class Turned { kVertex, kFlat };  // what lies under the plates

/// k_n l^2 / k_b of a node: rigid, overlaps below 0.001 R, and no dearer than need be.
double stiffness_ratio(int n) { return n <= 20 ? 400 : n <= 80 ? 100 : n <= 160 ? 20 : 10; }

struct Setup {
  int n = 80;
  Turned turned = Turned::kVertex;
  double strain = 0.71;
  double slowdown = 1;
  int frames = 280;
  int plate_segments = 1;
  double stiffer = 1;  // plates than stiffness_ratio says
};

Squeeze squeeze(StudyBench& bench, const std::string& name, const Setup& setup) {
  const double l = ring_segment(setup.n);
  std::vector<std::string> settings{
      fmt::format("sample.shapes.0.segments={}", setup.n),
      fmt::format("sample.shapes.1.segments={}", setup.plate_segments),
      fmt::format("sample.shapes.2.segments={}", setup.plate_segments),
      fmt::format("contact.normal_stiffness={}", setup.stiffer * stiffness_ratio(setup.n) / std::pow(l, 4)),
      fmt::format("stop.time={}", setup.strain / 0.005 + 1),
      fmt::format("run.slowdown={}", setup.slowdown),
      fmt::format("output.frames={}", setup.frames)};
  if (setup.turned == Turned::kFlat) {
    settings.push_back(fmt::format("sample.shapes.0.rotation={}", pi / 2 + pi / setup.n));
    settings.push_back(fmt::format("loads.axis.nodes.box=[{0}, -1.02, {1}, 1.02]", -0.6 * l, 0.6 * l));
  }
  return Squeeze(bench.run(name, "elastic.toml", settings));
}

/// Equilibria of the discrete ring between rigid walls by an active-set solver, S = 4800: F R^2 / EI at kTabulated.
struct DiscreteTable {
  int n;
  Turned turned;
  double force[6];
};
const double kTabulated[] = {.1, .2, .3, .4, .5, .6};
const DiscreteTable kDiscrete[] = {
    {20, Turned::kVertex, {1.10978, 2.00900, 2.78479, 3.87283, 5.58672, 7.76718}},
    {40, Turned::kVertex, {1.15684, 2.08688, 2.90862, 3.96586, 5.61588, 8.85644}},
    {80, Turned::kVertex, {1.16932, 2.10743, 2.92627, 3.97809, 5.70336, 8.91452}},
    {160, Turned::kVertex, {1.17248, 2.11264, 2.92653, 3.98466, 5.73179, 8.95511}},
    {320, Turned::kVertex, {1.17328, 2.11394, 2.92817, 3.98498, 5.73737, 8.96132}},
    {40, Turned::kFlat, {1.15029, 2.10079, 2.91424, 3.92876, 5.70160, 8.74963}},
    {80, Turned::kFlat, {1.16777, 2.11100, 2.92026, 3.97792, 5.72897, 8.93171}},
};

/// A run beside its table.
struct Case {
  DiscreteTable table;
  Squeeze ring;
  bool vertex() const { return table.turned == Turned::kVertex; }
};

void check_the_oracle(StudyReport& report) {
  report.section("The oracle itself");
  report.text(
      "The exact curves below are quadratures of the elastica (`elastica.cpp`). Without stretch (S infinite) they have "
      "a closed form where "
      "the contact is flat:\nF R^2 / EI = B^2 / b^2 with B = 1.1981402 and b = 1 - strain.");
  const double endless = std::numeric_limits<double>::infinity();
  report.compare_absolute("strain where flat contact begins, S infinite", contact_onset(endless), 0.2822300, 1e-6);
  report.compare_absolute("the same, S = 4800", contact_onset(kRingAxial), 0.282368, 1e-6);
  report.compare("F at strain 0.2, S infinite", elastica(0.2, endless).force, 2.115300, 2e-6);
  report.compare("F at strain 0.6, S infinite", elastica(0.6, endless).force, 1.4355400 / 0.16, 2e-6);
  report.compare("F at strain 0.2, S = 4800", elastica(0.2, kRingAxial).force, 2.114380, 2e-6);
  report.compare("F at strain 0.6, S = 4800", elastica(0.6, kRingAxial).force, 8.962960, 2e-6);
}

void against_the_polygon(StudyReport& report, const std::vector<Case>& cases, const ExactCurves& exact) {
  report.section("Force against the equilibria of the discrete model");
  report.text(
      "F R^2 / EI of the same polygon at rest between rigid walls, with a vertex or a side under the plates. Taken at "
      "these very strains, "
      "linear between two frames, without averaging over a window.\n*In*: on the way in, at the scene's rate 0.005 and "
      "drag 0.5; drag "
      "adds up to 0.004. *Mean*: of the ways in and out, in which what pulls with the speed cancels: what is left "
      "beyond strain 0.28 is the plates' own softness (below).");
  for (const Case& c : cases)
    for (std::size_t k = 0; k < std::size(kTabulated); ++k) {
      const std::string what =
          fmt::format("N = {}, {}, strain {:g}", c.table.n, c.vertex() ? "vertex" : "flat", kTabulated[k]);
      report.compare(what + ", in", c.ring.pressing(&Ring::force, kTabulated[k]), c.table.force[k], 0.005);
      report.compare(what + ", mean", c.ring.at(&Ring::force, kTabulated[k]), c.table.force[k],
                     kTabulated[k] < 0.25 ? 0.0003
                     : c.table.n == 20    ? 0.005
                                          : 0.002);
    }
  Chart chart{.title = "Force of a plate", .x_label = "strain 1 - b / b0", .y_label = "F R^2 / EI"};
  chart.curves.push_back(line_curve(4, "elastica, S = 4800", exact.strain(), exact.of(&Elastica::force)));
  int colour = 0;
  for (const Case& c : cases)
    if (c.vertex() && c.table.n <= 80)
      chart.curves.push_back(ring_dots(colour++, fmt::format("N = {}", c.table.n), c.ring, &Ring::force));
  report.chart("force", "Force over strain on the way in (dots) and the elastica (line).", chart);
}

void against_the_elastica(StudyReport& report, const Squeeze& s, int n) {
  report.section(fmt::format("Shape, energy and contact against the elastica, N = {}", n));
  report.text(
      "Means of the ways in and out. What is allowed is what a polygon of N sides differs from the smooth ring. L_c / "
      "b0 is <|x|> / R, contact "
      "forces as weights. Curvatures: 1 + M R / EI of the node.");
  const double order = 1.0 / (n * n);
  for (const double strain : {.1, .2, .3, .4, .5, .6, .7}) {
    if (s.press().back().strain < strain) continue;
    const Elastica e = elastica(strain, kRingAxial);
    const auto row = [&](const std::string& what) { return fmt::format("strain {:g}: {}", strain, what); };
    report.compare(row("F R^2 / EI"), s.at(&Ring::force, strain), e.force, 40 * order);
    // The sides' curvature at strain 0.7 is twice that at 0.45.
    report.compare_absolute(row("a / b0"), s.at(&Ring::width, strain), e.width, (strain < 0.65 ? 3 : 6) * order);
    report.compare_absolute(row("V / V0"), s.at(&Ring::area, strain), e.area, (strain < 0.65 ? 1 : 2) * order);
    report.compare(row("R W_b / EI"), s.at(&Ring::bending, strain), e.bending, 40 * order);
    report.compare(row("W_s / W_b"), s.at(&Ring::stretching, strain) / s.at(&Ring::bending, strain),
                   e.stretching / e.bending, 80 * order);
    report.compare_absolute(row("L_c / b0"), s.at(&Ring::contact_length, strain), e.contact_length, 40 * order);
    report.compare_absolute(row("curvature at the plates times R"), s.at(&Ring::top, strain), e.top, 80 * order);
    report.compare(row("curvature at the sides times R"), s.at(&Ring::side, strain), e.side, 40 * order);
  }
}

void convergence(StudyReport& report, const std::vector<Case>& cases) {
  report.section("Convergence");
  report.text(
      "Relative error of F against the elastica with S = 4800, means of the ways in and out. Before the contact is "
      "flat it falls with order 2 as "
      "-23 / N^2 (strain 0.1) and -21 / N^2 (0.2); beyond, the contact's\nedge jumps from node to node, and the error "
      "changes its sign within 40 / N^2.");
  Chart chart{.title = "Error of the force", .x_label = "N", .y_label = "relative error"};
  chart.x_scale = chart.y_scale = Scale::kLogarithmic;
  for (std::size_t k = 0; k < std::size(kTabulated); ++k) {
    const double strain = kTabulated[k], exact = elastica(strain, kRingAxial).force;
    std::vector<double> ns, errors, sizes;
    for (const Case& c : cases) {
      if (!c.vertex()) continue;
      ns.push_back(c.table.n);
      errors.push_back(c.ring.at(&Ring::force, strain) / exact - 1);
      sizes.push_back(std::abs(errors.back()));
      if (strain > 0.25 && c.table.n >= 40)
        report.at_most(fmt::format("strain {:g}, N = {}: error of F times N^2", strain, c.table.n),
                       sizes.back() * c.table.n * c.table.n, 40);
    }
    if (strain < 0.25) {
      const Order order = observed_order({ns.begin() + 1, ns.begin() + 4}, {errors.begin() + 1, errors.begin() + 4});
      report.compare_absolute(fmt::format("strain {:g}: observed order, N = 40 to 160", strain), order.order, 2, 0.05);
      report.compare(fmt::format("strain {:g}: error of F times N^2, N = 40", strain), errors[1] * 1600,
                     strain < 0.15 ? -23 : -21, 0.05);
    }
    const auto colour = static_cast<int>(k);
    chart.curves.push_back(dotted_curve(colour, fmt::format("strain {:g}", strain), ns, sizes));
    chart.curves.push_back(line_curve(colour, "", ns, sizes));
    chart.curves.back().style.width = 0.6;
  }
  chart.curves.push_back(dashed_curve(6, "40 / N^2", {20, 320}, {40.0 / 400, 40.0 / 102400}));
  report.chart("convergence", "Error of the force over the number of nodes.", chart);
}

/// Work that the plates did from frame to frame, by the trapezoidal rule.
double work(const std::vector<Ring>& curve) {
  double sum = 0;
  for (std::size_t k = 1; k < curve.size(); ++k)
    sum += (curve[k].force + curve[k - 1].force) / 2 * 2 * (curve[k].plate_strain - curve[k - 1].plate_strain);
  return sum;
}

void there_and_back(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("There and back");
  report.text(
      "An elastic ring gives back what it took. What it keeps at finite speed is taken by drag and falls with the "
      "rate; it comes back round. N = "
      "40, the scene's rate times 1, 1/2, 1/4.");
  Chart chart{.title = "Way in less way out", .x_label = "strain", .y_label = "F in - F out [EI / R^2]"};
  ReportTable table{
      {"rate", "work done on the ring", "given back", "share lost", "largest distance from the first shape"}, {}};
  std::vector<double> slow, lost;
  int colour = 0;
  for (const double slowdown : {1.0, 2.0, 4.0}) {
    const Squeeze s = squeeze(bench, fmt::format("slow_{:g}", slowdown), {.n = 40, .slowdown = slowdown});
    const double in = work(s.press()), out = -work(s.release());
    slow.push_back(slowdown), lost.push_back((in - out) / in);
    const auto first = s.run().positions(0), last = s.run().positions();
    double distance = 0;
    for (std::size_t k = 0; k < 40; ++k) distance = std::max(distance, (last[k] - first[k]).norm());
    table.rows.push_back({fmt::format("{:g}", 0.005 / slowdown), fmt::format("{:.5f}", in), fmt::format("{:.5f}", out),
                          fmt::format("{:.2e}", lost.back()), fmt::format("{:.1e}", distance)});
    report.at_most(fmt::format("rate {:g}: share of the work that is not given back", 0.005 / slowdown), lost.back(),
                   0.003 / slowdown);
    report.at_most(fmt::format("rate {:g}: largest distance of a node from where it began, over R", 0.005 / slowdown),
                   distance, 2e-3 / slowdown);
    std::vector<double> strain, gap;
    for (double e = 0.01; e < 0.7; e += 0.005) {
      strain.push_back(e);
      gap.push_back(2 * (s.pressing(&Ring::force, e) - s.at(&Ring::force, e)));
    }
    chart.curves.push_back(line_curve(colour++, fmt::format("rate {:g}", 0.005 / slowdown), strain, gap));
  }
  report.table(table);
  report.chart("loop", "Force on the way in less force on the way out: falls with the rate. N = 40.", chart);
}

void other_plates(StudyBench& bench, const Squeeze& one) {
  StudyReport& report = bench.report;
  report.section("Other plates");
  report.text(
      "A plate of one segment has no nodes that could seek the ring: it pushes the ring's nodes with their whole "
      "stiffness. Plates of 57 segments push "
      "with half of it from each side. Plates ten times\nas stiff, k_n l^2 / k_b = 1000, come closer to the discrete "
      "model's equilibria between walls that "
      "do not yield at all. N = 40, means.");
  const Squeeze many = squeeze(bench, "plates_57", {.n = 40, .strain = 0.63, .plate_segments = 57});
  const Squeeze stiff = squeeze(bench, "plates_stiff", {.n = 40, .strain = 0.63, .stiffer = 10});
  const auto table = std::find_if(std::begin(kDiscrete), std::end(kDiscrete), [](const auto& t) { return t.n == 40; });
  for (std::size_t k = 0; k < std::size(kTabulated); ++k) {
    const double strain = kTabulated[k];
    report.compare(fmt::format("strain {:g}: F, plates of 57 segments over plates of one", strain),
                   many.at(&Ring::force, strain) / one.at(&Ring::force, strain), 1, 0.002);
    report.compare(fmt::format("strain {:g}: F, plates ten times as stiff", strain), stiff.at(&Ring::force, strain),
                   table->force[k], 0.0005);
  }
}

}  // namespace

void study_ring_between_plates(StudyBench& bench) {
  StudyReport& report = bench.report;
  check_the_oracle(report);
  const ExactCurves exact(bench.small() ? 28 : 140, kRingAxial);
  std::vector<Case> cases;
  for (const DiscreteTable& table : kDiscrete) {
    const bool vertex = table.turned == Turned::kVertex;
    if (bench.small() && (table.n > 40 || !vertex)) continue;
    cases.push_back({table, squeeze(bench, fmt::format("{}_{}", vertex ? "vertex" : "flat", table.n),
                                    {.n = table.n,
                                     .turned = table.turned,
                                     .strain = bench.small() || table.n > 160 || !vertex ? 0.63 : 0.71,
                                     .frames = bench.small() ? 120 : 280})});
  }
  against_the_polygon(report, cases, exact);
  const auto shown = std::find_if(cases.begin(), cases.end(),
                                  [&](const Case& c) { return c.vertex() && c.table.n == (bench.small() ? 40 : 80); });
  against_the_elastica(report, shown->ring, shown->table.n);
  draw_shape_charts(report, exact, shown->ring, shown->table.n);
  draw_rings(report, shown->ring, kRingAxial);
  if (!bench.small()) convergence(report, cases);
  if (!bench.small()) there_and_back(bench);
  if (!bench.small()) other_plates(bench, cases[1].ring);
  const Squeeze coarse = squeeze(bench, "vertex_16", {.n = 16, .strain = 0.63, .frames = 120});
  study_contact_claims(bench, {shown->ring, shown->table.n}, {coarse, 16});
  if (!bench.small()) study_soft_plates(bench, {shown->ring, shown->table.n}, {coarse, 16});
}

}  // namespace lamella
