// Scenes of other studies by equilibrium, beside their oracles, and the seconds of both ways.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipelines/double_cantilever/exact_beam.h"
#include "pipelines/honeycomb/periodic_scene.h"
#include "pipelines/links/lap_strength.h"
#include "pipelines/quasi_static/at_rest.h"
#include "pipelines/ring_between_plates/elastica.h"
#include "pipelines/ring_between_plates/pressed_ring.h"
#include "pipelines/ring_core/exact_ring.h"
#include "pipelines/studies/squeezed_ring.h"
#include "pipelines/studies/static_ring.h"

namespace lamella::at_rest {
namespace {

using Settings = std::vector<std::string>;

Settings operator+(Settings a, const Settings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Plates move at half of `rate` each, so that strain is rate times time; a frame every 0.01 of strain.
Settings squeezed_at_rest(double strain, const char* upper, const char* lower) {
  return {kStepper,
          fmt::format("loads.{}.ramp=0", upper),
          fmt::format("loads.{}.ramp=0", lower),
          fmt::format("stop.time={}", strain / 0.005),
          fmt::format("output.frames={}", std::lround(strain / 0.01)),
          fmt::format("run.load_steps={}", std::lround(strain / 0.01)),
          "run.residual=1e-6"};
}

/// Value at a strain, linear between frames.
double at_strain(const std::vector<double>& strain, const std::vector<double>& value, double at) {
  for (std::size_t k = 1; k < strain.size(); ++k)
    if (strain[k - 1] <= at && strain[k] > at)
      return value[k - 1] + (value[k] - value[k - 1]) * (at - strain[k - 1]) / (strain[k] - strain[k - 1]);
  return std::nan("");
}

std::string seconds(double s) { return fmt::format("{:.2g}", s); }

/// Seconds of the scene's own run, in time.
double explicit_seconds(StudyBench& bench, const std::string& name, const std::string& file, const Settings& settings) {
  return bench.run(name + "_in_time", file, settings).facts.seconds;
}

double load_at_first_break(const StudyRun& run, double full, double time) {
  const auto& events = run.reader.events();
  return events.empty() ? std::nan("") : full * smooth_ramp(events.front().time / time);
}

}  // namespace

void rings(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Ring between plates");
  report.text(
      "`ring_between_plates/elastic.toml` at rest, vertices towards the plates. F R^2 / EI against the equilibrium of "
      "the same polygon between rigid plates (`pipelines/studies/static_ring.cpp`: Newton's method with an active "
      "set, nothing in common with the simulator), and the order of its error against the elastica.");
  const std::vector<double> strains =
      bench.small() ? std::vector<double>{.1, .2, .3} : std::vector<double>{.1, .2, .3, .4, .5, .6};
  ReportTable table{{"N"}, {}};
  for (const double e : strains) table.head.push_back(fmt::format("strain {:g}", e));
  table.head.insert(table.head.end(), {"error, largest", "equilibria", "seconds", "seconds in time"});
  const std::string file = "../ring_between_plates/elastic.toml";
  std::vector<double> ns, error_1, error_2;
  Chart chart{.title = "Error of the force", .x_label = "N", .y_label = "relative error"};
  chart.x_scale = chart.y_scale = Scale::kLogarithmic;
  std::vector<double> to_polygon;
  for (const int n : bench.small() ? std::vector<int>{20, 40} : std::vector<int>{20, 40, 80, 160, 320}) {
    // k_n l^2 / k_b of a node: as in ring_between_plates
    const double ratio = n <= 20 ? 400 : n <= 80 ? 100 : n <= 160 ? 20 : 10, l = ring_segment(n);
    const Settings common{fmt::format("sample.shapes.0.segments={}", n),
                          fmt::format("contact.normal_stiffness={}", ratio / std::pow(l, 4))};
    Scene scene = bench.scene(file, common + squeezed_at_rest(strains.back() + 0.02, "upper_plate", "lower_plate"));
    scene.stages.resize(1);  // no way back
    StudyRun run = bench.run(fmt::format("ring_{}", n), sample_of(scene), scene);
    const RunFacts facts = run.facts;
    const Squeeze ring(std::move(run));
    const auto exact = static_ring({n, 4800, 0}, strains);
    std::vector<std::string> row{fmt::format("{}", n)};
    double worst = 0;
    for (std::size_t k = 0; k < strains.size(); ++k) {
      const double found = ring.pressing(&PressedRing::force, strains[k]);
      const double error = found / exact[k].force - 1;
      worst = std::max(worst, std::abs(error));
      row.push_back(fmt::format("{:.5f}", found));
      // Beyond strain 0.28 the plates' softness enters where their contact begins and ends.
      report.compare(fmt::format("N = {}, strain {:g}: F", n, strains[k]), found, exact[k].force,
                     strains[k] < .25 ? 1e-3
                     : n == 20        ? 5e-3
                                      : 2e-3);
    }
    ns.push_back(n), to_polygon.push_back(worst);
    error_1.push_back(std::abs(ring.pressing(&PressedRing::force, .1) / elastica(.1, kRingAxial).force - 1));
    error_2.push_back(std::abs(ring.pressing(&PressedRing::force, .2) / elastica(.2, kRingAxial).force - 1));
    std::string in_time = "-";
    if (!bench.small() && n <= 160) {
      Scene moving = bench.scene(file, common + Settings{fmt::format("stop.time={}", strains.back() / 0.005 + 5)});
      moving.stages.resize(1);
      in_time = seconds(bench.run(fmt::format("ring_{}_in_time", n), sample_of(moving), moving).facts.seconds);
    }
    row.insert(row.end(), {fmt::format("{:.1e}", worst), fmt::format("{}", facts.static_cost.searches),
                           seconds(facts.seconds), in_time});
    table.rows.push_back(row);
  }
  report.table(table);
  if (ns.size() >= 4) {
    const auto until_160 = [](const std::vector<double>& v) {
      return std::vector<double>(v.begin() + 1, v.begin() + 4);
    };
    report.compare_absolute("strain 0.1: order of the error against the elastica, N = 40 to 160",
                            observed_order(until_160(ns), until_160(error_1)).order, 2, 0.06);
    report.compare_absolute("strain 0.2: the same", observed_order(until_160(ns), until_160(error_2)).order, 2, 0.06);
  }
  const auto add = [&](int k, const std::string& label, const std::vector<double>& y) {
    chart.curves.push_back(line_curve(k, label, ns, y)), chart.curves.push_back(dotted_curve(k, "", ns, y));
  };
  add(0, "against the elastica, strain 0.1", error_1), add(1, "the same, strain 0.2", error_2),
      add(3, "against the polygon, largest", to_polygon);
  report.chart("ring",
               "Against the smooth ring the error is that of the polygon, of order 2. What is left against the polygon "
               "itself is the plates' softness, k_n l^2 / k_b = 400 (N = 20), 100, 20 and 10 (N = 320).",
               chart);
}

void cores(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Ring with a core");
  report.text(
      "`ring_core/core.toml` at rest. F R^2 / EI against the equilibrium of the same polygon, and in the table the "
      "exact ring's.");
  const int n = bench.small() ? 40 : 80;
  ReportTable table{{"eta", "strain", "F", "polygon", "exact ring", "seconds", "seconds in time"}, {}};
  for (const RingTable& exact : kExactRings) {
    if (exact.eta == 0 || (bench.small() && exact.eta == 100)) continue;
    const double end = bench.small() ? .2 : .5;
    const double stiffness = exact.eta == 1 ? 2e6 : exact.eta == 100 ? 1e7 : 3e7;  // of contacts, as in ring_core
    const double core = exact.eta * polygon_shell(4800, n);
    const Settings common{fmt::format("sample.shapes.0.segments={}", n),
                          fmt::format("cells.core.modulus={:.15g}", core),
                          fmt::format("contact.normal_stiffness={}", stiffness)};
    const std::string name = fmt::format("core_{:g}", exact.eta);
    const StudyRun run =
        bench.attempt(name, "../ring_core/core.toml", common + squeezed_at_rest(end + .02, "top", "bottom"));
    const RingCourse course = ring_course(run);
    const auto strain = course.inward(&SqueezedRing::strain), force = course.inward(&SqueezedRing::force);
    std::string in_time = "-";
    if (!bench.small()) in_time = seconds(explicit_seconds(bench, name, "../ring_core/core.toml", common));
    report.holds(fmt::format("eta = {:g}: pressed to strain {:g}", exact.eta, end), run.error.empty(),
                 run.error.empty() ? run.facts.ended : run.error);
    for (const ExactRing& e : exact.rows) {
      if (e.strain > end + .01) continue;
      const double polygon = static_ring({n, 4800, core}, {e.strain}).front().force;
      const double found = at_strain(strain, force, e.strain);
      report.compare(fmt::format("eta = {:g}, strain {:g}: F", exact.eta, e.strain), found, polygon, 2e-3);
      table.rows.push_back({fmt::format("{:g}", exact.eta), fmt::format("{:g}", e.strain), fmt::format("{:.5g}", found),
                            fmt::format("{:.5g}", polygon), fmt::format("{:.5g}", e.force), seconds(run.facts.seconds),
                            in_time});
    }
  }
  report.table(table);
}

void lap_joints_and_blocks(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Lap joints and blocks");
  report.text(
      "Scenes of `pipelines/links` at rest: loads at the first break against their closed forms. A link breaks within "
      "1e-6 of its criterion (`load_tolerance`).");
  ReportTable table{{"case", "load at the first break", "closed form", "breaks", "seconds", "seconds in time"}, {}};
  const Settings fine{kStepper, "run.load_tolerance=1e-6", "run.residual=1e-7"};
  for (const double ratio : {.01, .1, 1.0})
    for (const int n : bench.small() ? std::vector<int>{5, 10} : std::vector<int>{2, 5, 10, 20, 40}) {
      const Sample sample = make_facing_chains({.segments = n - 1});
      const double exact = lap_strength(n, ratio), full = 1.2e-3 * exact;
      const Scene scene =
          bench.scene("../links/lap_shear.toml",
                      fine + Settings{fmt::format("links.tangential_stiffness={}", ratio),
                                      fmt::format("loads.pull.force_x={}", full), "loads.pull.ramp=1", "stop.time=1"});
      const StudyRun run = bench.run(fmt::format("lap_{:g}_{}", ratio, n), sample, scene);
      const double found = load_at_first_break(run, full, 1) / 1e-3;
      const std::string what = fmt::format("lap joint, k_t / k_s = {:g}, n = {}", ratio, n);
      report.compare(what + ": T_c / f_t0", found, exact, 1e-5);
      table.rows.push_back({what, fmt::format("{:.6f}", found), fmt::format("{:.6f}", exact),
                            fmt::format("{}", run.reader.events().size()), seconds(run.facts.seconds), "-"});
    }
  for (const int n : bench.small() ? std::vector<int>{3} : std::vector<int>{3, 5, 11})
    for (const std::string kind : {"normal", "shear", "peel"}) {
      const double strength = kind == "shear" ? 5e-4 : 1e-3;
      const double exact = kind == "peel" ? n * (n + 1) / (4.0 * n - 2) : n, full = 1.5 * exact * strength;
      const std::string file = "../links/" + kind + ".toml";
      const Settings common{fmt::format("sample.walls.segments={}", n - 1),
                            fmt::format("loads.pull.force_{}={}", kind == "shear" ? "x" : "y", full)};
      const std::string name = fmt::format("{}_{}", kind, n);
      const StudyRun run = bench.run(name, file, fine + common);
      const double found = load_at_first_break(run, full, 180) / strength;
      report.compare(name + ": F_c over the strength of a link", found, exact,
                     1e-3);  // blocks are 1e3 stiffer, not rigid
      report.compare(name + ": links that break", static_cast<double>(run.reader.events().size()), n, 0);
      table.rows.push_back({name, fmt::format("{:.6f}", found), fmt::format("{:.6f}", exact),
                            fmt::format("{}", run.reader.events().size()), seconds(run.facts.seconds),
                            bench.small() ? "-" : seconds(explicit_seconds(bench, name, file, common))});
    }
  report.table(table);
}

void beams(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Double cantilever: first break");
  report.text(
      "Against the exact discrete solution, P_c = f_n0 q / (beta (1 + c (p - 1))). Arms turn by 0.002, so that large "
      "deflections add some 1e-5.");
  ReportTable table{{"beta", "c", "P_c / f_n0", "exact", "half opening / f_n0", "exact", "seconds"}, {}};
  for (const double beta : bench.small() ? std::vector<double>{.1, 1} : std::vector<double>{.01, .1, 1, 10})
    for (const int crack : {5, 20, 80}) {
      if (crack == 80 && (bench.small() || beta > 1)) continue;
      const ExactBeam exact(beta, crack);
      const double strength = strength_for(exact, crack, 0.002), opening = strength * exact.half_opening();
      const Scene scene = [&] {
        Scene s = bench.scene("../double_cantilever/double_cantilever.toml",
                              {kStepper, "run.load_tolerance=1e-6", "run.residual=1e-7", "output.frames=4",
                               fmt::format("links.normal_stiffness={}", beta * beta / 2),
                               fmt::format("links.tangential_stiffness={}", beta * beta / 2),
                               fmt::format("links.normal_strength={}", strength),
                               fmt::format("links.tangential_strength={}", strength), "loads.open_upper.ramp=0",
                               "loads.open_lower.ramp=0", fmt::format("loads.open_upper.velocity_y={}", opening),
                               fmt::format("loads.open_lower.velocity_y={}", -opening), "stages.open.stop.time=1.001"});
        s.stages.resize(1);
        return s;
      }();
      const StudyRun run =
          bench.run(fmt::format("beam_{:g}_{}", beta, crack), make_facing_chains(glued_beam(beta, crack)), scene);
      const auto& events = run.reader.events();
      const auto time = run.column("time"), force = run.column("force_y_open_upper");
      double load = std::nan(""), half = std::nan("");
      if (!events.empty()) {
        const auto row = static_cast<std::size_t>(
            std::lower_bound(time.begin(), time.end(), events[0].time * (1 - 1e-12)) - time.begin());
        load = force.at(row) / strength, half = events[0].time * exact.half_opening();
      }
      const std::string what = fmt::format("beta = {:g}, c = {}", beta, crack);
      report.compare(what + ": P_c / f_n0", load, exact.load(), 1e-3);
      report.compare(what + ": half opening / f_n0", half, exact.half_opening(), 1e-3);
      table.rows.push_back({fmt::format("{:g}", beta), fmt::format("{}", crack), fmt::format("{:.6g}", load),
                            fmt::format("{:.6g}", exact.load()), fmt::format("{:.6g}", half),
                            fmt::format("{:.6g}", exact.half_opening()), seconds(run.facts.seconds)});
    }
  report.table(table);
}

void honeycombs(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Honeycomb: first break");
  report.text(
      "One free hexagon in an infinite honeycomb, as in `pipelines/honeycomb`, k_t = k_n / 10: stress at the first "
      "break of one of its links. Judged against the linear solution of the same lattice, whose facing lines lie 1e-4 "
      "apart; the known values, in the table, are those without a gap (n = 1: a closed form).");
  struct Case {
    int n;
    double k_n, known[2];
  };
  const std::vector<Case> all{{1, 100, {1.41935, 2.08118}},
                              {2, 100, {1.23448, 1.91764}},
                              {4, 100, {1.25056, 2.03933}},
                              {8, 10, {2.93330, 4.84103}}};
  ReportTable table{{"n", "k_n", "load", "sigma_c L / f_n0", "lattice", "known, no gap", "seconds"}, {}};
  for (const Case& one : all) {
    if (bench.small() && one.n > 2) continue;
    const double strength = 1e-4;
    const Settings settings{fmt::format("sample.walls.segments={}", one.n),
                            fmt::format("links.normal_stiffness={}", one.k_n),
                            fmt::format("links.tangential_stiffness={}", 0.1 * one.k_n),
                            fmt::format("links.normal_strength={}", strength),
                            fmt::format("links.tangential_strength={}", strength),
                            kStepper,
                            "run.load_tolerance=1e-6",
                            "run.residual=1e-7",
                            "output.frames=4",
                            "stop.time=1"};
    const std::string file = "../honeycomb/unit_cell.toml";
    const Scene scene = bench.scene(file, settings);
    const Sample sample = sample_of(scene);
    const UnitCell cell(sample, scene.stages.front());
    for (const int axis : {0, 1}) {
      const std::string load = axis == 0 ? "normal" : "along", name = fmt::format("cell_{}_{}", one.n, load);
      const double exact = cell.first_break(uniaxial(axis), strength, strength) / strength;
      const Scene pulled =
          periodic_scene(bench, file, name, settings, cell, sample, 1.1 * exact * strength * uniaxial(axis), 1, 0);
      const StudyRun run = bench.run(name, sample, pulled);
      double found = std::nan("");
      for (const Event& e : run.reader.events())
        if (std::isnan(found) && cell.touches_centre(sample.links[e.link])) found = 1.1 * exact * e.time;
      report.compare(fmt::format("n = {}, k_n = {:g}, {}: sigma_c L / f_n0", one.n, one.k_n, load), found, exact, 1e-3);
      table.rows.push_back({fmt::format("{}", one.n), fmt::format("{:g}", one.k_n), load, fmt::format("{:.5f}", found),
                            fmt::format("{:.5f}", exact), fmt::format("{:.5f}", one.known[axis]),
                            seconds(run.facts.seconds)});
    }
  }
  report.table(table);
}

}  // namespace lamella::at_rest
