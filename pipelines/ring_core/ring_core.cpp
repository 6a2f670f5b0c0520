// Sec. 4.4 of the paper: what a core does to a ring between plates (Figs. 14, 20 to 25), against the exact ring and against the
// static equilibrium of the very polygon that is simulated.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "pipelines/ring_core/exact_ring.h"
#include "pipelines/studies/squeezed_ring.h"
#include "pipelines/studies/static_ring.h"

namespace lamella {
namespace {

using std::numbers::pi;

/// Thicker walls, h = R / 10: forces at .1 to .5.
const std::map<double, std::vector<double>> kThickWalls{{1, {2.73238, 12.3720, 40.0764, 101.257, 214.011}},
                                                        {1e5, {4.57213, 29.6868, 130.694, 453.950, 1425.93}}};

std::string eta_name(double eta) { return eta == 1e5 ? "1e5" : fmt::format("{:g}", eta); }
std::string about(double eta, double strain) { return fmt::format("eta = {}, strain {:g}", eta_name(eta), strain); }

/// Stiff beside what presses: overlaps stay below 0.001 R.
double contact_stiffness(double eta) { return eta == 0 ? 1e6 : eta == 1 ? 2e6 : eta == 100 ? 1e7 : 3e7; }

std::vector<std::string> settings(double eta, double axial, int nodes, double strain, double rate) {
  return {fmt::format("sample.shapes.0.segments={}", nodes),
          fmt::format("cells.axial_rigidity={}", axial),
          fmt::format("cells.core.modulus={:.15g}", eta * polygon_shell(axial, nodes)),
          fmt::format("contact.normal_stiffness={}", contact_stiffness(eta)),
          fmt::format("loads.bottom.velocity_y={}", rate),
          fmt::format("loads.top.velocity_y={}", -rate),
          fmt::format("stop.time={}", (strain + 0.006) / rate + 1),  // the ramp
          fmt::format("output.frames={}", std::lround((strain + 0.006) / 0.0025))};
}

struct Squeezed {
  double eta = 0, axial = 4800;
  int nodes = 80;
  RingCourse course;
  std::vector<StaticRing> still;  // equilibria at the strains that are compared
  double ledger = 0;
};

Squeezed squeeze(StudyBench& bench, double eta, double axial, int nodes, double strain) {
  Squeezed ring;
  ring.eta = eta, ring.axial = axial, ring.nodes = nodes;
  const double rate = bench.small() ? 0.01 : 0.005;
  const StudyRun run = bench.run(fmt::format("eta{}_n{}_s{:g}", eta_name(eta), nodes, axial), "core.toml",
                                 settings(eta, axial, nodes, strain, rate));
  ring.course = ring_course(run);
  ring.ledger = run.ledger();
  std::vector<double> strains;
  for (double e = 0.1; e < strain + 0.01; e += 0.1) strains.push_back(e);
  ring.still = static_ring({nodes, axial, eta * polygon_shell(axial, nodes)}, strains);
  return ring;
}

double length_of(const SqueezedRing& r) { return contact_length(r.force, r.moment, r.pressure); }

/// Which K makes eta: the table's errors are those of eta times the stiffness of the polygon, not of the circle.
void definition(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("What eta multiplies");
  report.text(
      "Static equilibria of polygons with eta = 1 (Newton's method, `pipelines/studies/static_ring.cpp`): error of F "
      "against the exact ring. Another program's equilibria of discrete rings are known to be off by -3.6 -1.6 +0.1 "
      "+0.4 +0.5 % at N = 40 and strain 0.1 to 0.5; these are the errors with K = eta (k_s/s) tan(pi/N), eta times the "
      "polygon's own stiffness. `stiffness_ratio` takes the circle of the polygon's rest area, which makes K 0.1 % "
      "less at N = 40. The study sets `modulus` to the polygon's K.");
  const int nodes = 40;
  const double stated[] = {-3.6, -1.6, .1, .4, .5};
  const double radius = std::sqrt(nodes / (2 * pi) * std::sin(2 * pi / nodes));  // of the circle of the rest area
  ReportTable table{{"K", "0.1", "0.2", "0.3", "0.4", "0.5"}, {}};
  const std::pair<std::string, double> definitions[] = {{"EA/2R (circle)", 2400.0},
                                                        {"stiffness_ratio", 2400.0 / radius},
                                                        {"k_s/s tan(pi/N) (polygon)", polygon_shell(4800, nodes)}};
  for (const auto& [name, core] : definitions) {
    std::vector<std::string> row{name};
    const auto still = static_ring({nodes, 4800, core}, {.1, .2, .3, .4, .5});
    for (std::size_t k = 0; k < still.size(); ++k) {
      const double error = 100 * (still[k].force / kExactRings[1].rows[k].force - 1);
      row.push_back(fmt::format("{:+.2f} %", error));
      if (core == polygon_shell(4800, nodes))
        report.compare_absolute(fmt::format("error of F [%], polygon, N = 40, strain {:g}", still[k].strain), error,
                                stated[k], .06);
    }
    table.rows.push_back(row);
  }
  report.table(table);
}

/// The dynamic run against the static equilibrium of the same polygon: what loading rate, drag, penalty and time step do.
void against_static(StudyReport& report, const std::vector<Squeezed>& rings) {
  report.section("The run against static equilibrium of the same polygon");
  report.text("What loading rate, drag, penalty of contact and time step add. Forces, pressures and volumes to 0.5 %.");
  for (const Squeezed& ring : rings)
    for (const StaticRing& still : ring.still) {
      const SqueezedRing found = ring.course.at(still.strain);
      const std::string which =
          fmt::format("N = {}, h/R = {:g}, {}", ring.nodes, std::sqrt(12 / ring.axial), about(ring.eta, still.strain));
      report.compare(which + ": F", found.force, still.force, .005);
      report.compare(which + ": 1 - V/V0", found.shrinkage, still.shrinkage, .005);
      report.compare_absolute(which + ": a/b0", found.width, still.width, .001);
    }
  for (const Squeezed& ring : rings) {
    const std::string which =
        fmt::format("N = {}, h/R = {:g}, eta = {}", ring.nodes, std::sqrt(12 / ring.axial), eta_name(ring.eta));
    double largest = 0;
    for (const SqueezedRing& f : ring.course.frames)
      for (double push : f.push) largest = std::max(largest, push);
    report.at_most(which + ": largest overlap with a plate, over R",
                   largest / (contact_stiffness(ring.eta) * ring.course.spacing), .001);
    report.at_most(which + ": residual of the ledger", ring.ledger, 1e-3);
  }
}

void against_exact(StudyReport& report, const std::vector<Squeezed>& rings) {
  report.section("Against the exact ring");
  report.text(
      "N = 80; the continuous ring, extensible and pressurised. Allowed is the polygon's own error, which is "
      "F within 2 % at "
      "strain 0.1, 0.5 % beyond with a core, 1 % without one. The flat length L_c follows from the first moment of the "
      "force and the pressure.");
  ReportTable edges{{"ring", "edge force, found", "exact", "L_c/b0, found", "exact", "touching nodes reach"}, {}};
  for (const Squeezed& ring : rings) {
    if (ring.nodes != 80 || ring.axial != 4800) continue;
    const RingTable& table = *std::find_if(std::begin(kExactRings), std::end(kExactRings),
                                           [&](const RingTable& t) { return t.eta == ring.eta; });
    for (const ExactRing& exact : table.rows) {
      const SqueezedRing found = ring.course.at(exact.strain);
      const std::string which = about(ring.eta, exact.strain);
      report.compare(which + ": F", found.force, exact.force, ring.eta == 0 ? .01 : exact.strain < .15 ? .02 : .005);
      if (ring.eta > 0) report.compare(which + ": p", found.pressure, exact.pressure, exact.strain < .15 ? .02 : .005);
      report.compare(which + ": 1 - V/V0", found.shrinkage, exact.shrinkage, exact.strain < .15 ? .02 : .005);
      report.compare_absolute(which + ": a/b0", found.width, exact.width, .0015);
      report.compare_absolute(which + ": L_c/b0", length_of(found) / 2, exact.contact, .015);
      report.compare(which + ": W_s/W_b", found.stretch_over_bending(), exact.energies, .04);
      edges.rows.push_back({which, fmt::format("{:.4g}", edge_force(found.force, found.moment, found.pressure)),
                            fmt::format("{:.4g}", exact.edge), fmt::format("{:.4f}", length_of(found) / 2),
                            fmt::format("{:.4f}", exact.contact), fmt::format("{:.4f}", found.touching / 2)});
      report.at_most(which + ": reach of the touching nodes beyond L_c, in segments",
                     (found.touching - 2 * exact.contact) / ring.course.spacing, 3);
    }
  }
  report.text(
      "Where the force goes: F = p s L_c + edge force. Edge forces are differences of large numbers and come out less "
      "well than F. Touching "
      "nodes reach up to two segments further than the flat part.");
  report.table(edges);
}

const Squeezed& find(const std::vector<Squeezed>& rings, double eta, double axial = 4800) {
  return *std::find_if(rings.begin(), rings.end(), [&](const Squeezed& r) { return r.eta == eta && r.axial == axial; });
}

/// Forces of the upper plate on nodes, over what the core presses on the wall around each, p s l; sorted along x.
struct Profile {
  std::vector<double> x, share;
};
Profile profile(const SqueezedRing& ring) {
  Profile p;
  const std::size_t n = ring.x.size();
  for (std::size_t k = n / 2; k-- > 0;) {  // counter-clockwise from the x axis: the upper half, left to right
    const double length = (ring.x[(k + n - 1) % n].x() - ring.x[(k + 1) % n].x()) / 2;
    if (std::abs(ring.x[k].x()) < 1.2 && length > 0)
      p.x.push_back(ring.x[k].x()), p.share.push_back(ring.push[k] / (ring.pressure * length));
  }
  return p;
}

void pressures(StudyReport& report, const std::vector<Squeezed>& rings) {
  report.section("Pressure along the contact (Fig. 24)");
  report.text(
      "Force of the plate on each node over p s l, with p the core's pressure and l the present spacing. In the flat "
      "part it is 1: there the "
      "wall only hands the core's pressure on. It falls to 0 within two nodes of the end, so the structure of Fig. 24 "
      "holds; the level is p, "
      "not p* = EI / (R l^2 s), which depends on the mesh. Judged are the nodes that are further than 2.5 segments, "
      "and "
      "than three times sqrt(EI / p R s), over which bending decays, from the flat part's end.");
  Chart chart{.title = "Pressure of the plate, eta = 1e5", .x_label = "x / R", .y_label = "nodal force / p s l"};
  for (const Squeezed& ring : rings) {
    if (ring.axial != 4800 || ring.eta == 0) continue;
    for (const StaticRing& still : ring.still) {
      const SqueezedRing& found = ring.course.nearest(still.strain);
      const Profile p = profile(found);
      const double layer = 1 / std::sqrt(found.pressure);  // of bending at the edge, sqrt(EI / T) with T = p R s
      const double flat = length_of(found) / 2 - std::max(2.5 * ring.course.spacing, 3 * layer);
      double off = 0;
      int inside = 0;
      for (std::size_t k = 0; k < p.x.size(); ++k)
        if (std::abs(p.x[k]) < flat) off = std::max(off, std::abs(p.share[k] - 1)), ++inside;
      if (inside > 0)
        report.at_most(fmt::format("N = {}, {}: largest deviation from p s l over {} nodes", ring.nodes,
                                   about(ring.eta, still.strain), inside),
                       off, .005);
      if (ring.eta != 1e5 || ring.nodes != rings.front().nodes || still.strain < .15) continue;
      const int colour = static_cast<int>(std::lround(still.strain * 10)) - 2;
      chart.curves.push_back(line_curve(colour, fmt::format("strain {:g}", still.strain), p.x, p.share));
      chart.curves.push_back(dotted_curve(colour, "", p.x, p.share));
    }
  }
  report.chart("pressure", "Dots: nodes.", chart);
}

/// The curves of the paper's figures: what was computed as lines, what is exact as dots.
void figures(StudyReport& report, const std::vector<Squeezed>& rings) {
  report.section("The figures");
  Chart volume{.title = "Volume (Fig. 21)", .x_label = "strain 1 - b / b0", .y_label = "V / V0"};
  Chart length{.title = "Contact length (Fig. 22)", .x_label = "strain 1 - b / b0", .y_label = "L_c / b0"};
  Chart force{.title = "Force (Fig. 25)", .x_label = "strain 1 - b / b0", .y_label = "F R^2 / EI"};
  Chart energies{.title = "Stretching over bending (Fig. 14)", .x_label = "strain 1 - b / b0", .y_label = "W_s / W_b"};
  force.y_scale = energies.y_scale = Scale::kLogarithmic;
  for (const RingTable& table : kExactRings) {
    const RingCourse& course = find(rings, table.eta).course;
    const int colour = static_cast<int>(&table - kExactRings);
    const std::string label = "eta = " + eta_name(table.eta);
    const auto strain = course.inward(&SqueezedRing::strain);
    std::vector<double> lengths, ratios;
    for (std::size_t f = 0; f <= course.turn(); ++f) {
      lengths.push_back(length_of(course.frames[f]) / 2);
      ratios.push_back(strain[f] > .02 ? course.frames[f].stretch_over_bending() : 0);
    }
    volume.curves.push_back(line_curve(colour, label, strain, course.inward(&SqueezedRing::area)));
    length.curves.push_back(line_curve(colour, label, strain, lengths));
    force.curves.push_back(line_curve(colour, label, strain, course.inward(&SqueezedRing::force)));
    energies.curves.push_back(line_curve(colour, label, strain, ratios));
    for (const ExactRing& e : table.rows) {
      volume.curves.push_back(dotted_curve(colour, "", {e.strain}, {1 - e.shrinkage}));
      length.curves.push_back(dotted_curve(colour, "", {e.strain}, {e.contact}));
      force.curves.push_back(dotted_curve(colour, "", {e.strain}, {e.force}));
      energies.curves.push_back(dotted_curve(colour, "", {e.strain}, {e.energies}));
    }
  }
  ring_picture(report, "shapes",
               "Rings at strain 0.3 (Fig. 20). The core makes the flat part long and the sides round.",
               {{"eta = 0", find(rings, 0).course.at(.3)},
                {"eta = 1", find(rings, 1).course.at(.3)},
                {"eta = 1e5", find(rings, 1e5).course.at(.3)}});
  report.chart("volume", "N = 80; dots: exact.", volume);
  report.chart("contact_length", "N = 80; dots: exact. With a core, nodes that land one by one show.", length);
  report.chart("force", "N = 80; dots: exact.", force);
  report.chart("energies", "N = 80; dots: exact.", energies);
}

/// What the paper says of these rings, in numbers.
void claims(StudyReport& report, const std::vector<Squeezed>& rings) {
  report.section("What of the paper holds, and what does not");
  const Squeezed& stiff = find(rings, 1e5);
  const auto exact = [](double eta) -> const std::vector<ExactRing>& {
    return std::find_if(std::begin(kExactRings), std::end(kExactRings),
                        [&](const RingTable& t) { return t.eta == eta; })
        ->rows;
  };

  report.text("**Fig. 21: the volume is constant for eta = 1e5.** It is:");
  report.at_most("eta = 1e5, strain 0.3: 1 - V/V0", stiff.course.at(.3).shrinkage, 5e-6);

  report.text(
      "**Fig. 22: L_c / b0 grows with slope 2.1 for eta = 1e5.** The slope is not constant: it grows from 2.4 to 3.7. "
      "A stadium of constant "
      "area, L_c / b0 = pi/4 (1/b - b), has the chord 2.09 over strains 0 to 0.4, which is what 2.1 looks like. Slopes "
      "over 0.1 of strain:");
  for (double eta : {1., 1e5})
    for (std::size_t k = 1; k + 1 < 5; ++k) {
      const ExactRing &from = exact(eta)[k], &to = exact(eta)[k + 1];
      const RingCourse& course = find(rings, eta).course;
      const double slope = (length_of(course.at(to.strain)) - length_of(course.at(from.strain))) / 2 / .1;
      report.compare_absolute(
          fmt::format("eta = {}: slope of L_c/b0 from {:g} to {:g}", eta_name(eta), from.strain, to.strain), slope,
          (to.contact - from.contact) / .1, .15);
    }

  report.text(
      "**Figs. 23, 36: F grows as L_c^2, as for a solid cylinder.** It grows faster, about as the cube. Corrected Eq. "
      "36 is L_c = "
      "(16 F R (1 - nu^2) / (pi s E))^(1/2), with 16 where 2 is printed. A cylinder whose F and L_c agree with the "
      "ring's at strain 0.3 has "
      "E / (1 - nu^2) = 16 F R / (pi s L_c^2); it carries more than the ring before and less than half of it at 0.5.");
  Chart chart{.title = "Force over contact length (Fig. 23)", .x_label = "L_c / b0", .y_label = "F R^2 / EI"};
  chart.x_scale = chart.y_scale = Scale::kLogarithmic;
  for (double eta : {0., 1., 1e5}) {
    const RingCourse& course = find(rings, eta).course;
    const int colour = eta == 1e5 ? 3 : static_cast<int>(eta);
    std::vector<double> lengths, forces;
    for (std::size_t f = 0; f <= course.turn(); ++f)
      if (length_of(course.frames[f]) > .04)
        lengths.push_back(length_of(course.frames[f]) / 2), forces.push_back(course.frames[f].force);
    chart.curves.push_back(line_curve(colour, "eta = " + eta_name(eta), lengths, forces));
    for (const ExactRing& e : exact(eta))
      if (e.contact > .02) chart.curves.push_back(dotted_curve(colour, "", {e.contact}, {e.force}));
    if (eta == 0) continue;
    const ExactRing &from = exact(eta)[2], &to = exact(eta)[3];
    const SqueezedRing a = course.at(.3), b = course.at(.4);
    report.compare_absolute(fmt::format("eta = {}: exponent d ln F / d ln L_c from 0.3 to 0.4", eta_name(eta)),
                            std::log(b.force / a.force) / std::log(length_of(b) / length_of(a)),
                            std::log(to.force / from.force) / std::log(to.contact / from.contact), .15);
  }
  const SqueezedRing middle = stiff.course.at(.3);
  const double hertz = middle.force / std::pow(length_of(middle), 2);
  report.compare("eta = 1e5: E R^3 s / ((1 - nu^2) EI) of the cylinder", 16 * hertz / pi,
                 16 * 509.062 / (pi * std::pow(1.0345, 2)), .06);
  for (double strain : {.2, .5}) {
    const SqueezedRing r = stiff.course.at(strain);
    const ExactRing& e = exact(1e5)[strain < .3 ? 1 : 4];
    report.compare(
        fmt::format("eta = 1e5, strain {:g}: force of that cylinder at the same L_c, over the ring's", strain),
        hertz * std::pow(length_of(r), 2) / r.force, 509.062 * std::pow(e.contact / .51725, 2) / e.force, .08);
  }
  std::vector<double> lengths, forces;
  for (double half = .05; half < 1.3; half *= 1.1) lengths.push_back(half), forces.push_back(hertz * 4 * half * half);
  Curve cylinder = line_curve(4, "Hertz, corrected Eq. 36", lengths, forces);
  cylinder.style.dashes = {5, 3};
  chart.curves.push_back(cylinder);
  report.chart("force_length",
               "N = 80; dots: exact; dashed: the solid cylinder that agrees with eta = 1e5 at strain 0.3.", chart);

  report.text(
      "**Eq. 35: F = (F* + p s l) L_c / l.** p s L_c is right, the rest depends on the mesh: with F* = EI / (R l) it "
      "adds EI L_c / (R l^2), "
      "which grows as N^2. What is right is F = p s L_c + the force of the edges. Eq. 35 over the exact F at strain "
      "0.3:");
  for (const Squeezed& ring : rings) {
    if (ring.eta != 1e5 || ring.axial != 4800) continue;
    const SqueezedRing r = ring.course.at(.3);
    const double l = ring.course.spacing, length = length_of(r);
    report.compare(fmt::format("eta = 1e5, N = {}: Eq. 35 over F", ring.nodes),
                   (1 / l + r.pressure * l) * length / l / r.force, (1 / l + 441.927 * l) * 1.0345 / l / 509.062, .05);
  }

  report.text(
      "**Thin walls.** A stadium of constant area has p R^3 / EI = S (1 - b)^2 / 2b^2 and F = 2 p L_c / b0. For eta = "
      "1e5 the ring is within a "
      "few per cent of it:");
  for (const ExactRing& e : exact(1e5)) {
    if (e.strain < .15) continue;
    const double b = 1 - e.strain;
    const double stadium = 4800 * std::pow((1 - b) / b, 2) * pi / 4 * (1 / b - b);
    report.compare(fmt::format("eta = 1e5, strain {:g}: F against the stadium", e.strain),
                   stiff.course.at(e.strain).force, stadium, e.strain < .25 ? .035 : .015);
  }

  report.text(
      "**W_s / W_b goes as h^-2 and becomes infinite in the limit of thin walls.** True where the core imposes the "
      "stretching: times 3.8 where h halves (eta = 1e5). "
      "Without core it is the other way round, a quarter:");
  const double ratio =
      stiff.course.at(.5).stretch_over_bending() / find(rings, 1e5, 1200).course.at(.5).stretch_over_bending();
  report.compare("eta = 1e5, strain 0.5: W_s/W_b at h = R/20 over that at h = R/10 (N = 80 is 3 % off by itself)",
                 ratio, 3.8, .05);
  const auto empty = static_ring({80, 1200, 0}, {.5});
  const double without = find(rings, 0).course.at(.5).stretch_over_bending() / (empty[0].bars / empty[0].hinges);
  report.between("eta = 0, strain 0.5: the same (h = R/10: static)", without, .24, .26);
}

void thick_walls(StudyReport& report, const std::vector<Squeezed>& rings) {
  report.section("Thicker walls, h = R / 10");
  report.text("F against the exact ring of S = 1200, N = 80.");
  for (const auto& [eta, forces] : kThickWalls)
    for (std::size_t k = 0; k < forces.size(); ++k) {
      const double strain = .1 * static_cast<double>(k + 1);
      report.compare(about(eta, strain) + ": F", find(rings, eta, 1200).course.at(strain).force, forces[k],
                     k == 0 ? .02 : .0075);
    }
}

/// A polygon between plates lies more softly on a side than on a vertex, or the other way round, by turns; free to roll, it does.
void rolling(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("What the guide is for");
  report.text(
      "The scene holds the vertices under the plates in their place along the plates. Left free, the polygon keeps its "
      "symmetry for a while and "
      "then rolls, by up to a few segments, each time the next side is softer to lie on than a vertex: static "
      "equilibrium with the vertex in the middle is no "
      "longer stable. This is an error of resolution, like that of F itself. N = 40, eta = 100, not judged:");
  Scene free = bench.scene("core.toml", settings(100, 4800, 40, .5, .005));
  std::erase_if(free.stages.front().loads, [](const LoadScene& l) { return l.name == "guide"; });
  const RingCourse course = ring_course(bench.run("rolling", sample_of(free), free));
  const auto still = static_ring({40, 4800, 100 * polygon_shell(4800, 40)}, {.1, .2, .3, .4, .5});
  ReportTable table{{"strain", "upper vertex at x / R", "F over that of the symmetric equilibrium"}, {}};
  for (const StaticRing& s : still) {
    const SqueezedRing found = course.at(s.strain);
    table.rows.push_back({fmt::format("{:g}", s.strain), fmt::format("{:+.4f}", found.x[10].x()),
                          fmt::format("{:.4f}", found.force / s.force)});
  }
  report.table(table);
}

}  // namespace

void study_ring_core(StudyBench& bench) {
  std::vector<Squeezed> rings;
  if (bench.small()) {
    rings.push_back(squeeze(bench, 1, 4800, 40, .3));
    rings.push_back(squeeze(bench, 100, 4800, 40, .3));
    rings.push_back(squeeze(bench, 1e5, 4800, 40, .2));
  } else {
    for (double eta : {0., 1., 100., 1e5}) rings.push_back(squeeze(bench, eta, 4800, 80, .5));
    for (double eta : {1., 1e5}) rings.push_back(squeeze(bench, eta, 4800, 40, .5));
    for (double eta : {1., 1e5}) rings.push_back(squeeze(bench, eta, 1200, 80, .5));
  }
  definition(bench);
  against_static(bench.report, rings);
  if (bench.small()) {
    pressures(bench.report, rings);
    return;
  }
  against_exact(bench.report, rings);
  pressures(bench.report, rings);
  figures(bench.report, rings);
  claims(bench.report, rings);
  thick_walls(bench.report, rings);
  rolling(bench);
}

}  // namespace lamella
