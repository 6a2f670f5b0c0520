// A ring between plates, to the end: flat contact, crushed elements, inverted area, soft walls, stiff cores, plastic hinges.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipelines/hard_cases/hard_cases.h"
#include "pipelines/hard_cases/tools.h"

namespace lamella::hard_cases {
namespace {

constexpr double kSpeed = 0.02;       // of each plate in the elastic scenes
const double kSide = 0.07852;         // length of a segment of 80: 2 sin(pi / 80)
const double kFlattened = 1.4355400;  // exact elastica after the onset of flattening: F R^2 / EI = this / (1 - eps)^2
const double kContactSlope = 2.1884396;  // and Lc / b0 = pi / 2 - this (1 - eps)

/// The ring (cell 0) in one frame, pressed by the plates (cells 1, above, and 2). All over R, EI / R^2.
struct RingShape {
  int stage = 0;
  double time = 0;
  double strain = 0;          // from the extent of its nodes
  double plates = 0;          // strain from where the plates are
  double area = 0;            // over that at rest
  double width = 0;           // over 2 R
  double force = 0;           // of the upper plate
  double contact_length = 0;  // Lc / b0 = <|x|>: from the first moment of that force
  double inside = 0;          // largest force of a node away from both edges of the contact
  double uneven = 0;          // there: largest |f / (p l) - 1|, with a core
  double overlap = 0;         // largest, of node and plate
  double shortest = 0;        // segment over its rest length
};

RingShape shape_of(const StudyRun& run, int index) {
  const Sample& sample = run.reader.sample();
  const Frame frame = run.reader.frame(run.index(index));
  const FrameView view(sample, frame);
  RingShape out;
  out.time = frame.time, out.stage = frame.stage;
  Vec2 lo = view.x[0], hi = view.x[0];
  for (Index i = 0; i < sample.cell_size(0); ++i) lo = lo.cwiseMin(view.x[i]), hi = hi.cwiseMax(view.x[i]);
  out.strain = 1 - 0.5 * (hi.y() - lo.y()), out.width = 0.5 * (hi.x() - lo.x());
  out.area = area_of(sample, 0, view.x) / sample.rest_area[0];
  const double reach = sample.radius[0] + sample.radius[1];
  out.overlap = std::max(reach - (view.x[sample.cell_begin[1]].y() - hi.y()),
                         reach - (lo.y() - view.x[sample.cell_begin[2]].y()));
  out.plates = 1 - 0.5 * (view.x[sample.cell_begin[1]].y() - view.x[sample.cell_begin[2]].y()) + reach;
  out.shortest = shortest_segment(sample, view.x);
  if (!view.has("contact_force")) return out;
  const auto& force = *view.doubles("contact_force");
  const auto &node = *view.ints("contact_node"), &cell = *view.ints("contact_cell");
  double moment = 0, edge = 0;
  for (std::size_t k = 0; k < node.size(); ++k)
    if (cell[k] == 1) {
      const double x = std::abs(view.x[node[k]].x());
      out.force += force[2 * k], moment += x * force[2 * k], edge = std::max(edge, x);
    }
  out.contact_length = out.force > 0 ? moment / out.force : 0;
  const double pressure = view.has("pressure") ? (*view.doubles("pressure"))[0] : 0;
  for (std::size_t k = 0; k < node.size(); ++k) {
    if (cell[k] != 1 || std::abs(view.x[node[k]].x()) > edge - 2.5 * kSide) continue;
    out.inside = std::max(out.inside, force[2 * k]);
    const Index i = node[k];
    const double l = 0.5 * (view.x[sample.next(0, i)] - view.x[sample.prev(0, i)]).norm();
    if (pressure > 0) out.uneven = std::max(out.uneven, std::abs(force[2 * k] / (pressure * l) - 1));
  }
  return out;
}

std::vector<RingShape> shapes_of(const StudyRun& run) {
  std::vector<RingShape> out;
  for (int k = 0; k < run.reader.frames(); ++k) out.push_back(shape_of(run, k));
  return out;
}

/// Mean force of the plates while they move by `window` (strain) about that of the time: work over way, so that nothing of the chatter of
/// nodes on plates is left in it.
double mean_force(const StudyRun& run, int stage, double time, double speed, double window) {
  const auto times = run.column("time"), work = run.column("work"), stages = run.column("stage");
  std::vector<double> t, w;
  for (std::size_t k = 0; k < times.size(); ++k)
    if (static_cast<int>(stages[k]) == stage) t.push_back(times[k]), w.push_back(work[k]);
  const auto at = [&](double when) {
    const auto after = std::upper_bound(t.begin() + 1, t.end() - 1, when) - t.begin();
    const auto k = static_cast<std::size_t>(after);
    const double u = (when - t[k - 1]) / (t[k] - t[k - 1]);
    return (1 - u) * w[k - 1] + u * w[k];
  };
  const double half = 0.5 * window / speed;
  const double from = std::max(t.front(), time - half), to = std::min(t.back(), time + half);
  return (at(to) - at(from)) / (2 * speed * (to - from));
}

/// Value at a strain, between frames, of what grows like a power of it.
double at_strain(const std::vector<double>& strain, const std::vector<double>& value, double wanted) {
  for (std::size_t k = 1; k < strain.size(); ++k)
    if (strain[k] >= wanted && strain[k - 1] < wanted) {
      const double u = (wanted - strain[k - 1]) / (strain[k] - strain[k - 1]);
      return std::exp((1 - u) * std::log(value[k - 1]) + u * std::log(value[k]));
    }
  return std::nan("");
}

Panel panel_at(const StudyRun& run, int frame) {
  return {&run.reader.sample(), run.positions(frame), fmt::format("strain {:.3f}", shape_of(run, frame).strain), {}};
}

int frame_at_strain(const std::vector<RingShape>& shapes, double strain) {
  int best = 0;
  for (std::size_t k = 0; k < shapes.size(); ++k)
    if (std::abs(shapes[k].strain - strain) < std::abs(shapes[best].strain - strain)) best = static_cast<int>(k);
  return best;
}

void flat_contact(StudyBench& bench, const std::vector<RingShape>& shapes) {
  StudyReport& report = bench.report;
  report.section("Flat contact of an empty ring");
  report.text(
      "Between rigid plates (k_n l^2 / k_b = 100, N = 80) the flat part of the wall carries nothing: its moment is the "
      "same everywhere, "
      "and two nodes at\neach of its edges take F / 2. At strain 0.5, at rest.");
  const RingShape* rest = nullptr;
  std::vector<double> strain, length;
  for (const RingShape& s : shapes) {
    if (s.stage == 1) rest = &s;
    if (s.stage != 1) strain.push_back(s.strain), length.push_back(s.contact_length);
  }
  report.compare("force at strain 0.5: discrete equilibrium", rest->force, 5.70336, 2e-3);
  report.at_most("largest force of a node between the edges, over F", rest->inside / rest->force, 1e-3);
  report.compare_absolute("contact length at strain 0.5, Lc / b0, from the first moment of the force",
                          rest->contact_length, 0.4724, 0.005);
  report.compare("slope of contact length over strain, 0.35 to 0.6", slope_of(strain, length, 0.35, 0.6), kContactSlope,
                 0.03);
  Chart chart{.title = "Contact length of a crushed ring", .x_label = "strain", .y_label = "Lc / b0"};
  std::vector<double> x, y;
  for (double e = 0.2822; e < 0.98; e += 0.02)
    x.push_back(e), y.push_back(std::numbers::pi / 2 - kContactSlope * (1 - e));
  chart.curves = {line_curve(0, "exact elastica", x, y), dotted_curve(1, "found", strain, length)};
  report.chart("contact_length", "First moment of the plate's force, on the exact line.", chart);
}

void collapse_of_elements(StudyBench& bench, const StudyRun& run, const std::vector<RingShape>& shapes) {
  StudyReport& report = bench.report;
  report.section("Collapse of elements");
  report.text(
      "The force of a linear bar has a finite barrier, k_s l0^2 / 2, and M / l none at all: a segment below 0.1 of its "
      "rest length stops "
      "the run. In a ring crushed\nto strain 0.95 no segment comes near that.");
  double shortest = 1;
  bool numbers = true;
  for (const RingShape& s : shapes)
    shortest = std::min(shortest, s.shortest), numbers = numbers && std::isfinite(s.force);
  report.at_least("shortest segment over its rest length, up to strain 0.957", shortest, 0.1);
  report.holds("no frame holds what is no number", numbers, fmt::format("{} frames", shapes.size()));
  const auto residual = run.column("residual"), time = run.column("time");
  double worst = 0;  // of the last stage, once its work is more than a start
  const double from = shapes[frame_at_strain(shapes, 0.7)].time, to = shapes[frame_at_strain(shapes, 0.95)].time;
  for (std::size_t k = 0; k < residual.size(); ++k)
    if (time[k] >= from && time[k] <= to) worst = std::max(worst, residual[k]);
  report.at_most("residual of the energy ledger, strain 0.7 to 0.95", worst, 1e-5);
  const RingShape& near = shapes[frame_at_strain(shapes, 0.9)];
  const double window = 0.0359, exact = kFlattened / (std::pow(1 - near.strain, 2) - 0.25 * window * window);
  report.compare_absolute(
      "mean force about strain 0.9, over the exact mean (a prototype with 80 segments: 123 / 143.6)",
      mean_force(run, 2, near.time, kSpeed, window) / exact, 123 / 143.6, 0.1);
  report.text(
      fmt::format("The exact elastica has {:.1f} there. Its side loops are turned around on 0.1 R, a segment is 0.08 R "
                  "long: 80 of them are too few, and "
                  "the code cannot know it.",
                  kFlattened / std::pow(1 - 0.9, 2)));
  const StudyRun bars = bench.attempt("collapsing_bars", "collapsing_bars.toml");
  expect_stop(bench, "a chain pressed into itself", bars, "segment 0 of cell 0 has collapsed to 0.09");
}

void inverted_area(StudyBench& bench, const std::vector<RingShape>& shapes) {
  StudyReport& report = bench.report;
  report.section("Inverted area");
  report.text(
      "A linear core cannot push with more than p0 + K, so a cell can be turned inside out. A cell below 0.02 of its "
      "rest area stops the run; "
      "so does one that\nhas gone past it. This, like the collapse of segments, is looked for at every row of the "
      "response and not in "
      "every step: an inverted cell stays\ninverted, and a look costs as much as some steps.");
  report.at_most("an empty ring is crushed to this share of its area", shapes.back().area, 0.08);
  Scene open = bench.scene("external_pressure.toml");
  open.stages[0].contact.reset();
  const StudyRun inverted = bench.attempt("external_pressure_without_contact", sample_of(open), open);
  expect_stop(bench, "a ring folded by external pressure, without contact", inverted, "cell 0 has ");
  // The same with rows as dense as it takes to see the bound itself.
  open.stages[0].output.response = 20000;
  const StudyRun dense = bench.attempt("external_pressure_dense_rows", sample_of(open), open);
  const auto share = dense.error.find("has ");
  report.between("area left at the stop, rows every second step",
                 share == std::string::npos ? std::nan("") : std::stod(dense.error.substr(share + 4)), 0.0175, 0.02);
}

}  // namespace

void crushed_ring(StudyBench& bench) {
  const StudyRun run = bench.run("ring_between_plates", "ring_between_plates.toml");
  const auto shapes = shapes_of(run);
  flat_contact(bench, shapes);
  collapse_of_elements(bench, run, shapes);
  draw_panels(
      bench, "crushed_ring", "An empty ring between plates.",
      {panel_at(run, frame_at_strain(shapes, 0.3)), panel_at(run, frame_at_strain(shapes, 0.6)), panel_at(run, -1)},
      Box{{-1.8, -1.05}, {1.8, 1.05}});
  inverted_area(bench, shapes);
}

void soft_wall(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Soft wall trap");
  report.text(
      "A plate that gives way makes the flat part carry load and hides the edge forces: with k_n l^2 / k_b = 0.001 the "
      "ring sinks in by a "
      "tenth of its radius. Strain\nfrom the plates then puts forces wrong by up to half, strain from the nodes by a "
      "tenth. What tells it: the "
      "overlap, and k_n l^2 / k_b, which the program\nsays when it starts.");
  const StudyRun run = bench.run("soft_wall", "soft_wall.toml");
  const double expected[] = {.635, 1.460, 2.347, 3.317, 4.441, 5.825};  // of a prototype, same wall, N = 80
  const auto shapes = shapes_of(run);
  std::vector<double> strain, plates, force;
  double overlap = 0;
  for (const RingShape& s : shapes) {
    strain.push_back(s.strain), plates.push_back(s.plates), force.push_back(s.force + 1e-300);
    overlap = std::max(overlap, s.overlap);
  }
  ReportTable table{
      {"strain", "F, strain from the plates", "the same, a prototype", "F, strain from the nodes", "F, rigid wall"},
      {}};
  const double exact[] = {1.173541, 2.114380, 2.928696, 3.985800, 5.738405, 8.962960};
  double worst = 0;
  for (int k = 0; k < 6; ++k) {
    const double e = 0.1 * (k + 1), f = at_strain(plates, force, e);
    table.rows.push_back({fmt::format("{:.1f}", e), fmt::format("{:.3f}", f), fmt::format("{:.3f}", expected[k]),
                          fmt::format("{:.3f}", at_strain(strain, force, e)), fmt::format("{:.3f}", exact[k])});
    worst = std::max(worst, std::abs(f / expected[k] - 1));
  }
  report.table(table);
  report.at_most("soft wall: forces, off those of a prototype with the same wall", worst, 0.015);
  report.at_least("soft wall: largest overlap over R", overlap, 0.1);
  const auto& said = run.reader.provenance().at("summary");
  const std::string key = "contact against walls: k_n l^2 / k_b = ";
  const auto from = said.find(key);
  report.compare("k_n l^2 / k_b, as the program says it when it starts",
                 from == std::string::npos ? std::nan("") : std::stod(said.substr(from + key.size())), 1e-3, 0.01);
  const StudyRun stiff = bench.run("stiff_wall", "ring_between_plates.toml", {"stages.flat.stop.time=5"});
  double largest = 0;
  for (const RingShape& s : shapes_of(stiff)) largest = std::max(largest, s.overlap);
  report.at_most("k_n l^2 / k_b = 100, up to strain 0.6: largest overlap over R", largest, 1e-3);
  draw_panels(bench, "soft_wall",
              "Strain 0.5 between soft and stiff plates; walls and plates are drawn with their radius.",
              {panel_at(run, frame_at_strain(shapes, 0.5)), panel_at(stiff, frame_at_strain(shapes_of(stiff), 0.5))},
              Box{{-1.6, -0.8}, {1.6, 0.8}});
}

void stiff_core(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Stiff core, eta = 1e5");
  report.text(
      "The core adds K s sum |dA/dx|^2 / A0 to the stiffness, and the perimeter grows as the ring is pressed: a step "
      "fixed at 0.9 of the limit "
      "at rest diverges at strain\n0.415. Here the step is found again at every frame.");
  const StudyRun run = bench.run("stiff_core", "stiff_core.toml");
  const double force[] = {12.3142, 109.186, 509.062, 1794.37, 5666.99};
  const double lost[] = {1.317e-7, 6.294e-7, 1.841e-6, 4.450e-6, 1.001e-5};
  std::vector<double> strain, mean, area;
  double uneven = 0;
  for (const RingShape& s : shapes_of(run)) {
    if (s.time < 1 || s.time > 25.8) continue;
    strain.push_back(s.strain), mean.push_back(mean_force(run, 0, s.time, kSpeed, 0.004)), area.push_back(1 - s.area);
    if (s.strain > 0.3) uneven = std::max(uneven, s.uneven);
  }
  for (int k = 0; k < 5; ++k)
    report.compare(fmt::format("F R^2 / EI at strain {:.1f}", 0.1 * (k + 1)), at_strain(strain, mean, 0.1 * (k + 1)),
                   force[k], k == 0 ? 0.02 : 0.005);
  for (int k = 0; k < 5; ++k)
    report.compare(fmt::format("1 - V / V0 at strain {:.1f}", 0.1 * (k + 1)), at_strain(strain, area, 0.1 * (k + 1)),
                   lost[k], 0.05);
  report.at_most("wall force of inner nodes: largest distance from p s l, relative, strain 0.3 to 0.5", uneven, 0.01);
  report.at_most("residual of the energy ledger", run.ledger(), 1e-3);
  draw_panels(bench, "stiff_core", "Strain 0.5 with a core of eta = 1e5: the area is that at rest to 1e-5.",
              {panel_at(run, -1)}, Box{{-1.8, -0.7}, {1.8, 0.7}});
}

void plastic_ring(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Perfectly plastic ring");
  report.text(
      "Limit of a rigid, perfectly plastic ring (deRuntz and Hodge): F = 4 M_Y / (R sqrt(1 - eps^2)). Yield at M_Y R / "
      "EI = 1e-3, N = 80. The "
      "contact jumps from node to\nnode, so forces are means over a strain of 0.04.");
  const StudyRun run = bench.run("plastic_ring", "plastic_ring.toml");
  const double speed = 0.002, yield = 1e-3;
  const auto shapes = shapes_of(run);
  std::vector<double> strain, force, exact;
  double worst_force = 0, worst_area = 0, worst_width = 0;
  for (const RingShape& s : shapes) {
    if (s.strain < 0.08 || s.strain > 0.6) continue;
    const double e = s.strain, al = std::asin(e), pi = std::numbers::pi;
    strain.push_back(e), exact.push_back(4 / std::sqrt(1 - e * e));
    force.push_back(mean_force(run, 0, s.time, speed, 0.04) / yield);
    worst_force = std::max(worst_force, std::abs(force.back() / exact.back() - 1));
    worst_area =
        std::max(worst_area, std::abs(s.area - 4 / pi * (al * (1 - e) + (pi / 2 - al) / 2 - std::sin(2 * al) / 4)));
    worst_width = std::max(worst_width, std::abs(s.width - al - std::cos(al)));
  }
  report.at_most("force, strain 0.08 to 0.6: largest distance from the limit, relative", worst_force, 0.08);
  report.at_most("area V / V0: largest distance from the limit", worst_area, 0.003);
  report.at_most("width a / b0: largest distance from the limit", worst_width, 0.003);
  report.at_least("plastic work over work", run.last("plastic") / run.last("work"), 0.95);
  report.at_most("residual of the energy ledger", run.ledger(), 1e-3);
  Chart chart{.title = "Perfectly plastic ring", .x_label = "strain", .y_label = "F R / M_Y"};
  chart.curves = {line_curve(0, "4 / sqrt(1 - strain^2)", strain, exact), dotted_curve(1, "found", strain, force)};
  report.chart("plastic_force", "Force of the plates over that of one yielding hinge.", chart);
  draw_panels(bench, "plastic_ring", "A plastic ring at strains 0.3 and 0.6.",
              {panel_at(run, frame_at_strain(shapes, 0.3)), panel_at(run, frame_at_strain(shapes, 0.6))},
              Box{{-1.6, -0.9}, {1.6, 0.9}});
}

}  // namespace lamella::hard_cases
