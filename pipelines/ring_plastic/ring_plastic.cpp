// Sec. 4.3 of the paper and Fig. 10: a perfectly plastic ring between plates against deRuntz and Hodge's rigid-plastic ring, and what a stiff core
// leaves of a plastic ring when it is released.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipelines/studies/squeezed_ring.h"
#include "pipelines/studies/static_ring.h"

namespace lamella {
namespace {

using std::numbers::pi;

const double kYield = 5e-5;  // M_Y of plastic.toml
const double kTooth = 0.04;  // of strain: half the distance from one node's landing to the next, N = 80

/// deRuntz and Hodge: the rigid-plastic ring turns about four hinges, lies flat between two of them, and its side arcs keep their radius.
/// Lengths over b0.
struct Rigid {
  explicit Rigid(double strain) {
    const double angle = std::asin(strain);
    force = 4 / std::cos(angle), contact = angle, width = angle + std::cos(angle);
    area = 4 / pi * (angle * (1 - strain) + (pi / 2 - angle) / 2 - std::sin(2 * angle) / 4);
  }
  static double mean_force(double from, double to) { return 4 * (std::asin(to) - std::asin(from)) / (to - from); }
  double force = 0;  // F R / M_Y
  double contact = 0, width = 0, area = 0;
};

struct PlasticRing {
  int nodes = 80;
  double drag = .05;
  RingCourse course;
  double released = 0;  // b / b0 at the end
  double plastic = 0;   // share of the work
  double last = 0;      // largest strain asked for
};

PlasticRing press(StudyBench& bench, int nodes, double drag, double strain) {
  const double rate = 1e-4;
  PlasticRing ring;
  ring.nodes = nodes, ring.drag = drag, ring.last = strain;
  const StudyRun run = bench.run(fmt::format("n{}_drag{:g}", nodes, drag), "plastic.toml",
                                 {fmt::format("sample.shapes.0.segments={}", nodes), fmt::format("drag.rate={}", drag),
                                  fmt::format("stages.press.stop.time={}", strain / rate)});
  ring.course = ring_course(run);
  ring.released = 1 - ring.course.frames.back().strain;
  const auto stages = run.column("stage"), works = run.column("work"), plastics = run.column("plastic");
  for (std::size_t k = 0; k < stages.size(); ++k)
    if (stages[k] == 0) ring.plastic = plastics[k] / works[k];
  return ring;
}

double length_of(const SqueezedRing& r) { return contact_length(r.force, r.moment, 0); }

void rigid_plastic(StudyReport& report, const std::vector<PlasticRing>& rings) {
  report.section("Against deRuntz and Hodge");
  report.text(
      "M_Y = 5e-5 EI / R: F = 4 M_Y / (R sqrt(1 - strain^2)), L_c / b0 = asin(strain). The contact jumps from node to "
      "node, so F "
      "saw-tooths by some per cent. Its mean over about one tooth (work over shortening, over +-0.04 of strain at N = "
      "80, where there is room) is compared with the "
      "mean of the exact force over the same strains; allowed are 8 %.");
  for (const PlasticRing& ring : rings) {
    for (double strain = .1; strain < ring.last + .01; strain += .1) {
      if (ring.nodes < 40 && strain > .55) continue;  // half a tooth is missing
      const std::string which = fmt::format("N = {}, drag {:g}, strain {:g}", ring.nodes, ring.drag, strain);
      const SqueezedRing& found = ring.course.nearest(strain);
      const Rigid there(found.strain);
      const double tooth = kTooth * 80 / ring.nodes, end = ring.course.frames[ring.course.turn()].strain;
      const double from = std::max(.02, strain - tooth), to = std::min(strain + tooth, end);
      report.compare(which + ": mean F R / M_Y", ring.course.mean_force(from, to) / kYield, Rigid::mean_force(from, to),
                     .08);
      if (ring.nodes < 40) continue;
      const double profile = ring.nodes == 80 ? .003 : .006;
      report.compare_absolute(which + ": a/b0", found.width, there.width, profile);
      report.compare_absolute(which + ": V/V0", found.area, there.area, profile);
      report.compare_absolute(which + ": L_c/b0, to one segment", length_of(found) / 2, there.contact,
                              ring.course.spacing / 2);
    }
    report.at_least(fmt::format("N = {}, drag {:g}: plastic work over work", ring.nodes, ring.drag), ring.plastic, .95);
    const double end = 1 - ring.course.frames[ring.course.turn()].strain;
    report.compare_absolute(fmt::format("N = {}, drag {:g}: b/b0 after release", ring.nodes, ring.drag), ring.released,
                            end, 5e-4);
  }
  report.text(
      "Where the rest of F goes: over all strains, what flows in the hinges accounts for the exact force, and the "
      "excess is drag, for all N alike. With a fifth of the drag a fifth of the "
      "excess is left.");
  ReportTable table{{"ring", "mean F over exact", "flow alone"}, {}};
  for (const PlasticRing& ring : rings) {
    const double to = ring.course.frames[ring.course.turn()].strain, exact = Rigid::mean_force(.05, to) * kYield;
    const double all = ring.course.mean_force(.05, to) / exact;
    const double flow = ring.course.mean_force(.05, to, &SqueezedRing::plastic) / exact;
    const std::string which = fmt::format("N = {}, drag {:g}", ring.nodes, ring.drag);
    table.rows.push_back({which, fmt::format("{:.4f}", all), fmt::format("{:.4f}", flow)});
    report.compare(which + ": force that flows, mean over all strains beyond 0.05, over exact", flow, 1,
                   .01 * 80 / ring.nodes);
  }
  report.table(table);
}

/// Forces on the nodes of the upper plate over the whole force, sorted along x.
Curve profile(const SqueezedRing& ring, int colour) {
  std::vector<double> x, share;
  for (std::size_t k = ring.x.size() / 2; k-- > 0;)
    if (std::abs(ring.x[k].x()) < .8) x.push_back(ring.x[k].x()), share.push_back(ring.push[k] / ring.force);
  return line_curve(colour, fmt::format("strain {:.1f}", ring.strain), x, share);
}

/// Share of the force between the outermost nodes that carry any.
double inner_share(const SqueezedRing& ring) {
  double inner = 0;
  for (std::size_t k = 0; k < ring.x.size(); ++k)
    if (std::abs(ring.x[k].x()) < ring.touching / 2 - 1e-6) inner += ring.push[k] / 2;
  return inner / ring.force;
}

void claims(StudyReport& report, const PlasticRing& ring) {
  const RingCourse& course = ring.course;
  const double l = course.spacing;
  report.section("What of the paper holds, and what does not");
  report.text(
      "**Eq. 34, Fig. 17: F / F** = L_c / l with F** = M_Y / l.** It would make F grow as N^2 at the same strain; the "
      "work F db must "
      "equal M_Y times all turning of hinges, which is of the order of M_Y and knows no N. F l / M_Y beside L_c / l:");
  ReportTable table{{"strain", "L_c / l = F / F** by Eq. 34", "F / F**, found", "rigid-plastic"}, {}};
  Chart force{.title = "Force (Fig. 17)", .x_label = "L_c / l", .y_label = "F / F**"};
  force.y_scale = Scale::kLogarithmic;
  std::vector<double> lengths, forces, exact;
  for (double strain = .05; strain < .59; strain += .01) {
    const Rigid rigid(strain);
    lengths.push_back(2 * rigid.contact / l), exact.push_back(rigid.force * l);
    forces.push_back(course.mean_force(strain - .02, strain + .02) / kYield * l);
  }
  for (double strain : {.1, .2, .3, .4, .5}) {
    const double found = course.mean_force(strain - kTooth, strain + kTooth) / kYield * l;
    table.rows.push_back({fmt::format("{:g}", strain), fmt::format("{:.1f}", 2 * Rigid(strain).contact / l),
                          fmt::format("{:.3f}", found), fmt::format("{:.3f}", Rigid(strain).force * l)});
  }
  report.table(table);
  force.curves = {line_curve(0, "found", lengths, forces), line_curve(1, "deRuntz and Hodge", lengths, exact),
                  line_curve(4, "Eq. 34", lengths, lengths)};
  report.chart("force_length", "N = 80, F averaged over 0.04 of strain.", force);

  report.text(
      "**Fig. 18: a broad plateau of pressure p**.** Where the wall lies flat between the edges its moment is M_Y "
      "everywhere, and a uniform "
      "moment needs no force: the edges carry all of it.");
  Chart pressure{.title = "Forces on the plate (Fig. 18)", .x_label = "x / R", .y_label = "nodal force / F"};
  int colour = 0;
  double inner = 0;
  for (double strain : {.1, .3, .5, .6}) {
    const SqueezedRing& r = course.nearest(strain);
    Curve curve = profile(r, colour);
    pressure.curves.push_back(curve);
    pressure.curves.push_back(dotted_curve(colour++, "", curve.x, curve.y));
    inner = std::max(inner, inner_share(r));
  }
  report.at_most("share of F carried between the two edges, largest of strains 0.1, 0.3, 0.5, 0.6", inner, .02);
  report.chart("pressure", "N = 80; dots: nodes.", pressure);

  report.text(
      "**Fig. 19: at large strains the volumes of the plastic and the elastic ring coincide.** Their difference grows, "
      "to 0.0255 V0 at strain 0.6:");
  Chart volume{.title = "Volume (Fig. 19)", .x_label = "strain 1 - b / b0", .y_label = "V / V0"};
  std::vector<double> strains, rigid;
  for (double strain = .02; strain < .601; strain += .02)
    strains.push_back(strain), rigid.push_back(Rigid(strain).area);
  const auto elastic = static_ring({80, 4800, 0}, strains);
  std::vector<double> areas;
  for (const StaticRing& s : elastic) areas.push_back(s.area);
  volume.curves = {line_curve(0, "plastic", course.inward(&SqueezedRing::strain), course.inward(&SqueezedRing::area)),
                   dotted_curve(1, "deRuntz and Hodge", strains, rigid), line_curve(2, "elastic", strains, areas)};
  for (double strain : {.2, .4, .6}) {
    const double found = static_ring({80, 4800, 0}, {strain})[0].area - course.at(strain, .01).area;
    const double expected = strain == .2 ? .95396 - .95216 : strain == .4 ? .83549 - .81901 : .63800 - .61249;
    report.compare_absolute(fmt::format("strain {:g}: V/V0 of the elastic ring less that of the plastic one", strain),
                            found, expected, .001);
  }
  report.chart("volume", "N = 80; elastic: static equilibrium.", volume);
}

/// Fig. 10: the ring with eta = 1e5, to strain 0.35 and back.
struct Released {
  std::string what;
  int nodes = 40;
  double rate = .005;
  RingCourse course;
  double largest_bar = 0, least_bar = 0;  // plastic strain of bars at the end

  const SqueezedRing& end() const { return course.frames.back(); }
};

Released release(StudyBench& bench, const std::string& what, int nodes, double rate,
                 const std::vector<std::string>& extra) {
  Released r;
  r.what = what, r.nodes = nodes, r.rate = rate;
  std::vector<std::string> settings{fmt::format("sample.shapes.0.segments={}", nodes),
                                    fmt::format("cells.core.modulus={:.15g}", 1e5 * 2400 / std::cos(pi / nodes)),
                                    fmt::format("loads.bottom.velocity_y={}", rate),
                                    fmt::format("loads.top.velocity_y={}", -rate),
                                    fmt::format("stages.press.stop.time={}", .35 / rate)};
  if (bench.small()) settings.insert(settings.end(), {"stages.open.stop.time=5", "stages.rest.stop.time=5"});
  settings.insert(settings.end(), extra.begin(), extra.end());
  const StudyRun run = bench.run(fmt::format("core_{}_n{}_rate{:g}", what, nodes, rate), "plastic_core.toml", settings);
  r.course = ring_course(run);
  const auto bars = run.array("bar_plastic_length");
  const auto [least, largest] = std::minmax_element(bars.begin(), bars.begin() + nodes);
  r.least_bar = *least / r.course.spacing, r.largest_bar = *largest / r.course.spacing;
  return r;
}

const std::vector<std::string> kElasticBars{"cells.yield_force=1e9"};
const std::vector<std::string> kElastic{"cells.yield_force=1e9", "cells.yield_moment=1e9"};

void fig10(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("A stiff core, pressed to 0.35 and released (Fig. 10)");
  report.text(
      "eta = 1e5. The elastic ring comes back to a circle. If only hinges flow, as the paper's caption says, the bars "
      "that the core has stretched "
      "pull the ring back nearly to a circle. If bars flow too, at the same yield stress (F_Y = 4 M_Y / h), the wall "
      "keeps its length and the "
      "ring the shape that it has under the plates. There is no closed form for the residual shape; it is converged in "
      "N and rate. What has one is the pressed ring "
      "whose bars flow: a membrane of tension F_Y around a fixed area, p s b = 2 F_Y and F = p s L_c, up to what "
      "hinges add.");
  std::vector<Released> all;
  const double rate = bench.small() ? .01 : .005;
  const int nodes = bench.small() ? 20 : 40;
  if (!bench.small()) {
    all.push_back(release(bench, "elastic", nodes, rate, kElastic));
    all.push_back(release(bench, "hinges", nodes, rate, kElasticBars));
  }
  all.push_back(release(bench, "both", nodes, rate, {}));
  if (!bench.small()) {
    all.push_back(release(bench, "both", 80, rate, {}));
    all.push_back(release(bench, "both", nodes, rate / 2, {}));
  }
  ReportTable table{{"what flows", "N", "rate", "F R^2 / EI at 0.35", "residual strain 1 - b/b0", "residual a/b0",
                     "plastic strain of bars"},
                    {}};
  for (const Released& r : all)
    table.rows.push_back({r.what == "both"     ? "hinges and bars"
                          : r.what == "hinges" ? "hinges"
                                               : "nothing",
                          fmt::format("{}", r.nodes), fmt::format("{:g}", r.rate),
                          fmt::format("{:.4g}", r.course.frames[r.course.turn()].force),
                          fmt::format("{:.4f}", r.end().strain), fmt::format("{:.4f}", r.end().width),
                          fmt::format("{:.3f} to {:.3f}", r.least_bar, r.largest_bar)});
  report.table(table);
  for (const Released& r : all) {
    const std::string which = fmt::format("N = {}, rate {:g}", r.nodes, r.rate);
    if (r.what == "elastic") report.at_most(which + ", elastic: residual strain", std::abs(r.end().strain), .001);
    if (r.what == "hinges") report.between(which + ", hinges flow: residual strain", r.end().strain, .001, .05);
    if (r.what != "both") continue;
    report.between(which + ", hinges and bars flow: residual strain", r.end().strain, .34, .35);
    const SqueezedRing& pressed = r.course.frames[r.course.turn()];
    const double b = 1 - pressed.strain, length = pi / 2 * (1 / b - b);
    report.compare(which + ": p R / F_Y at 0.35", pressed.pressure / 4, 1 / b, .02);
    report.compare(which + ": F R / F_Y at 0.35", pressed.force / 4, length / b, .05);
    report.compare_absolute(which + ": a/b0 at 0.35", pressed.width, length / 2 + b, .02);
  }
  if (bench.small()) return;
  const double residual = all[2].end().strain;
  report.compare_absolute("residual strain at N = 80 beside N = 40", all[3].end().strain, residual, .003);
  report.compare_absolute("residual strain at half the rate", all[4].end().strain, residual, .001);
  const auto turned = [](const Released& r) { return r.course.frames[r.course.turn()]; };
  ring_picture(report, "released", "eta = 1e5 at strain 0.35 and after release (Fig. 10).",
               {{"elastic, 0.35", turned(all[0])}, {"released", all[0].end()}});
  ring_picture(
      report, "released_plastic", "The same where hinges flow, and where hinges and bars do.",
      {{"hinges flow, released", all[1].end()}, {"both flow, 0.35", turned(all[3])}, {"released", all[3].end()}});
  report.text(
      "Bars that flow without hardening under one tension share out their stretching as chance will have it: the "
      "smallest and the largest plastic strain "
      "of bars differ widely, and more so with finer rings. The shape hardly notices, but these strains are no "
      "property of the wall.");
}

}  // namespace

void study_ring_plastic(StudyBench& bench) {
  std::vector<PlasticRing> rings;
  if (bench.small())
    rings.push_back(press(bench, 40, .05, .3));
  else
    for (int nodes : {20, 40, 80}) rings.push_back(press(bench, nodes, .05, .6));
  if (!bench.small()) rings.push_back(press(bench, 40, .01, .6));
  rigid_plastic(bench.report, rings);
  if (!bench.small()) {
    claims(bench.report, rings[2]);
    const RingCourse& course = rings[2].course;
    ring_picture(
        bench.report, "shapes", "The plastic ring, and what stays of it.",
        {{"strain 0.3", course.nearest(.3)}, {"strain 0.6", course.nearest(.6)}, {"released", course.frames.back()}});
  }
  fig10(bench);
}

}  // namespace lamella
