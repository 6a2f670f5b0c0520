#include "pipelines/ring_between_plates/paper_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipelines/ring_between_plates/elastica.h"
#include "pipelines/ring_between_plates/ring_charts.h"

namespace lamella {
namespace {

using std::numbers::pi;
using Ring = PressedRing;

/// Least squares over the frames of the way in with strain in [low, high].
struct Line {
  double slope = 0, zero = 0;  // value = slope (strain - zero)
};
Line fitted(const Squeeze& s, Measure value, double low, double high) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Ring& r : s.press()) {
    if (r.strain < low || r.strain > high) continue;
    n += 1, x += r.strain, y += r.*value, xx += r.strain * r.strain, xy += r.strain * (r.*value);
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return {slope, x / n - y / n / slope};
}

/// Largest force on nodes well inside the flat part, over the whole force.
double interior_share(const Squeeze& s, const Ring& ring, double l) {
  double largest = 0;
  for (const NodeForce& node : upper_forces(s.run(), ring.frame))
    if (std::abs(node.x) < ring.contact_length - 1.5 * l) largest = std::max(largest, node.force);
  return largest / ring.force;
}

/// F / F* over L_c / l of the elastica, with N nodes.
double exact_ratio(int n, double strain) {
  const Elastica e = elastica(strain, kRingAxial);
  return e.force * std::pow(2 * pi / n, 2) / (2 * e.contact_length);
}

std::string number(double value, int digits = 3) { return fmt::format("{:.{}g}", value, digits); }

}  // namespace

void study_contact_claims(StudyBench& bench, const RigidCase& fine, const RigidCase& coarse) {
  StudyReport& report = bench.report;
  const Squeeze& ring = fine.ring;
  const double l = ring_segment(fine.nodes), n2 = fine.nodes * fine.nodes;
  report.section("What the paper says of the contact, rigid plates");
  report.text(
      fmt::format("*Fig. 12, slope pi/2.* L_c / b0 grows by 2.188 for one of strain, a constant, and not by pi/2 = "
                  "1.571, from strain 0.2824 on, where "
                  "it is 0 and the curvature\nunder the plates has vanished; nothing happens at L_c = 0.16 b0. N = {}.",
                  fine.nodes));
  const Line line = fitted(ring, &Ring::contact_length, 0.35, 0.6);
  report.compare("slope of L_c / b0 over strain, 0.35 to 0.6", line.slope, 2.18844, 0.03);
  report.compare_absolute("strain at which that line is 0", line.zero, contact_onset(kRingAxial), 10 / n2 + 0.001);
  const double tenth = ring.at(&Ring::strain, 0.1, &Ring::top), twentieth = ring.at(&Ring::strain, 0.05, &Ring::top);
  report.compare_absolute("strain at which the curvature under the plates vanishes, straight on from 0.1 and 0.05 / R",
                          2 * twentieth - tenth, contact_onset(kRingAxial), 10 / n2 + 0.001);
  report.text(
      "*Figs. 15 and 16, F / F* = L_c / l and the plateau p*.* F* = EI / (R l) is the force that would keep one node "
      "straight if its "
      "neighbours did not. In a flat part every hinge holds\nthe same moment EI / R, so that its nodes need no force, "
      "M_(k-1) - 2 M_k + M_(k+1) = "
      "0: all of F sits at the two ends, and does not depend on l, while F* grows as N.\nTheir ratio is 28.34 / (N^2 "
      "b^2 L_c) with b = 1 - strain "
      "and L_c in b0, near 1 only where N is 16.");
  if (fine.nodes >= 80)
    report.at_most("force on a node inside the flat part over F, strain 0.5",
                   interior_share(ring, ring.nearest(0.5), l), 1e-3);
  ReportTable table{
      {"N", "strain", "F / F*", "L_c / l", "their ratio", "exact", "nodes at a plate", "nodes that carry force"}, {}};
  for (const RigidCase& c : {fine, coarse})
    for (const double strain : {.1, .2, .3, .4, .5, .6}) {
      const double segment = ring_segment(c.nodes), exact = elastica(strain, kRingAxial).contact_length;
      const double force = c.ring.at(&Ring::force, strain), length = c.ring.at(&Ring::contact_length, strain);
      const Ring& frame = c.ring.nearest(strain);
      table.rows.push_back({fmt::format("{}", c.nodes), number(strain), number(force * segment),
                            length > 1e-6 ? number(2 * length / segment) : "0",
                            length > 0.01 ? number(force * segment * segment / (2 * length)) : "",
                            exact > 0 ? number(exact_ratio(c.nodes, strain)) : "", number(frame.touching),
                            number(frame.pushing)});
    }
  report.table(table);
  report.compare(fmt::format("N = {}, strain 0.5: F / F* over L_c / l (the paper: 1)", fine.nodes),
                 ring.at(&Ring::force, 0.5) * l * l / (2 * ring.at(&Ring::contact_length, 0.5)),
                 exact_ratio(fine.nodes, 0.5), 40 / n2 + 0.02);
  report.chart("pressure_rigid",
               fmt::format("Fig. 16 with rigid plates, N = {}: the contact's ends carry everything.", fine.nodes),
               pressure_chart("Contact pressure, rigid plates", ring, {.1, .3, .5, .6}, &Ring::strain, l));
}

void study_soft_plates(StudyBench& bench, const RigidCase& fine, const RigidCase& coarse) {
  StudyReport& report = bench.report;
  const int n = 80;
  const double l = ring_segment(n);
  report.section("Soft plates, which imitate the paper's figures, N = 80");
  report.text(
      "With k_n l^2 / k_b = 0.001 and 0.01 walls sink in. Strain counts here from the plates' positions, as a "
      "compliant plate would be read: then the "
      "contact's length, counted in touching\nnodes, grows with a mean slope of 1.4 to 1.6, and the pressure has a "
      "parabola, then a plateau that falls over "
      "several nodes; but at 0.02 p*, not p*. Forces: means of the ways in and out, against static\nequilibria of the "
      "same soft problem.");
  struct Soft {
    double ratio, force[6];
    int pushing[6];
  };
  const Soft all[] = {{0.001, {.635, 1.460, 2.347, 3.317, 4.441, 5.825}, {9, 13, 17, 19, 23, 27}},
                      {0.01, {1.035, 1.996, 2.905, 3.911, 5.340, 7.805}, {}}};
  Chart lengths{.title = "Length of the contact", .x_label = "strain", .y_label = "L_c / b0"};
  lengths.curves.push_back(line_curve(4, "rigid, exact", {.2823, .7}, {0, 2.18844 * (.7 - .2823)}));
  Chart fifteen{.title = "Force over contact length", .x_label = "L_c / l", .y_label = "F / F*"};
  fifteen.curves.push_back(dashed_curve(4, "Eq. 31", {0, 6}, {0, 6}));
  int colour = 0;
  for (const Soft& soft : all) {
    const Squeeze s(bench.run(fmt::format("soft_{:g}", soft.ratio), "soft.toml",
                              {fmt::format("contact.normal_stiffness={}", soft.ratio / std::pow(l, 4))}));
    const std::string name = fmt::format("k_n l^2 / k_b = {:g}", soft.ratio);
    for (int k = 0; k < 6; ++k) {
      const double strain = 0.1 * (k + 1);
      report.compare(fmt::format("{}, strain {:.1f}: F R^2 / EI", name, strain),
                     s.at(&Ring::force, strain, &Ring::plate_strain), soft.force[k], 0.002);
      if (soft.pushing[k] > 0)
        report.compare_absolute(fmt::format("{}, strain {:.1f}: nodes that carry force", name, strain),
                                s.nearest(strain, &Ring::plate_strain).pushing, soft.pushing[k], 0);
    }
    const Ring& first = s.nearest(0.1, &Ring::plate_strain);
    const Ring& last = s.nearest(0.6, &Ring::plate_strain);
    report.between(fmt::format("{}: mean slope of L_c / b0, touching nodes, 0.1 to 0.6", name),
                   (last.pushing - first.pushing) * l / 2 / 0.5, 1.3, 1.7);
    if (soft.ratio == 0.001) {
      double level = 0;
      for (const NodeForce& node : upper_forces(s.run(), s.nearest(0.5, &Ring::plate_strain).frame))
        if (std::abs(node.x) < l / 2) level = node.force * l;
      report.between(name + ": level of the plateau over p*, strain 0.5 (the paper: 1)", level, 0.018, 0.021);
      report.compare_absolute(name + ": largest overlap over R, strain 0.6", last.overlap(), 0.12, 0.02);
      report.chart("pressure_soft",
                   "Fig. 16 with soft plates, k_n l^2 / k_b = 0.001: parabola, then plateau, at 0.02 p*.",
                   pressure_chart("Contact pressure, soft plates", s, {.1, .3, .5, .6}, &Ring::plate_strain, l));
    }
    std::vector<double> strain, length, over, force;
    for (const Ring& r : s.press()) {
      strain.push_back(r.plate_strain), length.push_back(r.pushing * l / 2);
      over.push_back(r.pushing), force.push_back(r.force * l);
    }
    lengths.curves.push_back(line_curve(colour, name + ", nodes that carry force", strain, length));
    fifteen.curves.push_back(line_curve(colour++, name, over, force));
  }
  lengths.curves.push_back(dashed_curve(5, "slope pi/2", {.0, .7}, {0, pi / 2 * .7}));
  report.chart("soft_lengths",
               "Fig. 12 with soft plates: contact length by counting nodes, beside the rigid plates' exact line.",
               lengths);
  for (const RigidCase& c : {fine, coarse}) {
    const double segment = ring_segment(c.nodes);
    std::vector<double> over, force;
    for (const Ring& r : c.ring.press())
      over.push_back(2 * r.contact_length / segment), force.push_back(r.force * segment);
    fifteen.curves.push_back(line_curve(colour++, fmt::format("rigid, N = {}", c.nodes), over, force));
  }
  report.chart("force_over_length", "Fig. 15: F / F* over L_c / l. Only N = 16 comes near Eq. 31.", fifteen);
}

}  // namespace lamella
