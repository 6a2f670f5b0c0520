#include "pipelines/ring_between_plates/ring_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lamella {
namespace {

using std::numbers::pi;
using Ring = PressedRing;

/// a / b_0 of an ellipse of constant perimeter (Eq. 26 of the paper) by bisection.
double ellipse_width(double strain) {
  const double b = 1 - strain;
  double low = 1, high = 2;
  for (int k = 0; k < 50; ++k) {
    const double a = (low + high) / 2;
    (3 * (a + b) - std::sqrt((a + 3 * b) * (3 * a + b)) < 2 ? low : high) = a;
  }
  return low;
}

template <typename Function>
std::vector<double> applied(const std::vector<double>& x, const Function& f) {
  std::vector<double> y;
  for (const double value : x) y.push_back(f(value));
  return y;
}

std::vector<double> thinned(const std::vector<double>& values) {
  const std::size_t step = std::max<std::size_t>(1, values.size() / 35);
  std::vector<double> few;
  for (std::size_t k = 0; k < values.size(); k += step) few.push_back(values[k]);
  return few;
}

}  // namespace

ExactCurves::ExactCurves(int count, double axial) {
  for (int k = 1; k <= count; ++k) rings_.push_back(elastica(0.7 * k / count, axial));
}

std::vector<double> ExactCurves::of(double Elastica::*value) const {
  std::vector<double> all;
  for (const Elastica& ring : rings_) all.push_back(ring.*value);
  return all;
}

Curve dashed_curve(int colour, const std::string& label, std::vector<double> x, std::vector<double> y) {
  Curve curve = line_curve(colour, label, std::move(x), std::move(y));
  curve.style.dashes = {4, 3};
  curve.style.width = 1;
  return curve;
}

Curve ring_dots(int colour, const std::string& label, const Squeeze& squeeze, Measure y, Measure x) {
  return dotted_curve(colour, label, thinned(squeeze.pressed(x)), thinned(squeeze.pressed(y)));
}

void draw_shape_charts(StudyReport& report, const ExactCurves& exact, const Squeeze& ring, int nodes) {
  const std::string found = fmt::format("N = {}", nodes);
  const std::vector<double> strain = exact.strain();
  Chart width{.title = "Width", .x_label = "strain 1 - b / b0", .y_label = "a / b0"};
  width.curves = {
      line_curve(4, "elastica", strain, exact.of(&Elastica::width)),
      dashed_curve(1, "ellipse, Eq. 26", strain, applied(strain, ellipse_width)),
      dashed_curve(2, "stadium, Eq. 27", strain, applied(strain, [](double e) { return 1 + (pi / 2 - 1) * e; })),
      ring_dots(0, found, ring, &Ring::width)};
  report.chart("width", "Fig. 11: from an ellipse's width to nearly a stadium's.", width);

  Chart length{.title = "Length of the contact", .x_label = "strain 1 - b / b0", .y_label = "L_c / b0"};
  length.curves = {line_curve(4, "elastica", strain, exact.of(&Elastica::contact_length)),
                   dashed_curve(2, "stadium, Eq. 28: slope pi/2", {0, 0.7}, {0, 0.7 * pi / 2}),
                   ring_dots(0, found + ", moment of the force", ring, &Ring::contact_length),
                   ring_dots(1, found + ", nodes at the plate", ring, &Ring::touching_length)};
  report.chart(
      "contact_length",
      "Fig. 12: the contact's length, from the force's first moment and from the outermost nodes at the plate.",
      length);

  Chart area{.title = "Area", .x_label = "strain 1 - b / b0", .y_label = "V / V0"};
  area.curves = {line_curve(4, "elastica", strain, exact.of(&Elastica::area)),
                 dashed_curve(2, "stadium, Eq. 29", strain, applied(strain, [](double e) { return 1 - e * e; })),
                 ring_dots(0, found, ring, &Ring::area)};
  report.chart("area", "Fig. 13: Eq. 29 is too large by 0.72 % at most.", area);

  Chart energy{.title = "Energy", .x_label = "strain 1 - b / b0", .y_label = "R W / EI"};
  energy.curves = {line_curve(4, "bending, elastica", strain, exact.of(&Elastica::bending)),
                   ring_dots(0, found + ", bending", ring, &Ring::bending)};
  std::vector<double> exact_ratio, x, ratio;
  for (const Elastica& e : exact.rings()) exact_ratio.push_back(1e4 * e.stretching / e.bending);
  for (const Ring& r : ring.press())
    if (r.strain > 0.02) x.push_back(r.strain), ratio.push_back(1e4 * r.stretching / r.bending);
  energy.right_label = "10^4 W_s / W_b";
  energy.right_curves = {line_curve(2, "W_s / W_b, elastica", strain, exact_ratio),
                         dotted_curve(1, found + ", W_s / W_b", thinned(x), thinned(ratio))};
  report.chart("energy", "Energy of bending, and of stretching over it (Fig. 14, eta = 0).", energy);

  Chart curvature{.title = "Curvature", .x_label = "strain 1 - b / b0", .y_label = "R kappa"};
  curvature.curves = {line_curve(4, "elastica", strain, exact.of(&Elastica::top)),
                      line_curve(4, "", strain, exact.of(&Elastica::side)),
                      ring_dots(0, found + ", at the plate", ring, &Ring::top),
                      ring_dots(1, found + ", at the side", ring, &Ring::side)};
  report.chart("curvature", "The contact begins to be flat where the curvature at the plate has vanished.", curvature);
}

void draw_rings(StudyReport& report, const Squeeze& ring, double axial) {
  const std::vector<double> strains{0, .1, .2, .3, .4, .5, .6, .7};
  const Vec2 size(640, 250);
  report.picture(
      "rings", "The ring between the plates: nodes (dots) on the elastica (line).", size, [&](Canvas& canvas) {
        const double unit = 44;  // [pt] for R
        for (std::size_t k = 0; k < strains.size(); ++k) {
          const Vec2 middle(80.0 + 160.0 * static_cast<double>(k % 4), k < 4 ? 60 : 190);
          const auto placed = [&](const Vec2& x) { return Vec2(middle.x() + unit * x.x(), middle.y() - unit * x.y()); };
          const Ring& frame = ring.nearest(strains[k]);
          if (frame.strain > 0.01) {
            const std::vector<Vec2> quarter = elastica(frame.strain, axial).outline;
            for (const Vec2& sign : {Vec2(1, 1), Vec2(-1, 1), Vec2(1, -1), Vec2(-1, -1)}) {
              std::vector<Vec2> line;
              for (const Vec2& x : quarter) line.push_back(placed(x.cwiseProduct(sign)));
              canvas.line(line, {{0.45, 0.45, 0.48}, 1.2, {}});
            }
          }
          const auto x = ring.run().positions(frame.frame);
          const auto nodes = static_cast<std::size_t>(ring.run().reader.sample().cell_begin[1]);
          for (std::size_t i = 0; i < nodes; ++i) canvas.dot(placed(x[i]), 1.3, curve_colour(0));
          for (const double side : {1.0, -1.0}) {
            const double y = side * (1 - frame.strain + 0.05);
            canvas.line({placed({-1.5, y}), placed({1.5, y})}, {curve_colour(1), 1.6, {}});
          }
          const Vec2 below = placed({0, -(1 - frame.strain + 0.05)}) + Vec2(0, 13);
          std::string words = fmt::format("strain {:.1f}", strains[k]);
          if (frame.strain > 0.01) words += fmt::format(", F = {:.2f} EI / R^2", frame.force);
          canvas.text(below, words, {.size = 8, .anchor = Anchor::kCentre});
        }
      });
}

Chart pressure_chart(const std::string& title, const Squeeze& ring, const std::vector<double>& strains, Measure over,
                     double segment) {
  Chart chart{.title = title, .x_label = "x / R", .y_label = "p / p*"};
  for (std::size_t k = 0; k < strains.size(); ++k) {
    std::vector<double> x, p, line_x, line_p;
    for (const NodeForce& node : upper_forces(ring.run(), ring.nearest(strains[k], over).frame)) {
      // Nodes between, or beyond, carry nothing.
      if (x.empty() || node.x - x.back() > 1.5 * segment) {
        if (!x.empty()) line_x.push_back(x.back() + segment), line_p.push_back(0);
        line_x.push_back(node.x - segment), line_p.push_back(0);
      }
      x.push_back(node.x), p.push_back(node.force * segment);
      line_x.push_back(x.back()), line_p.push_back(p.back());
    }
    if (x.empty()) continue;
    line_x.push_back(x.back() + segment), line_p.push_back(0);
    const auto colour = static_cast<int>(k);
    chart.curves.push_back(dotted_curve(colour, fmt::format("strain {:g}", strains[k]), x, p));
    chart.curves.push_back(line_curve(colour, "", line_x, line_p));
    chart.curves.back().style.width = 0.8;
  }
  return chart;
}

}  // namespace lamella
