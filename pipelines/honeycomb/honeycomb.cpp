// Honeycombs of linked cells: moduli and first break against closed forms, by equilibrium and by runs; patches that grips pull; a torn one.
#include <fmt/format.h>

#include <cmath>

#include "pipelines/honeycomb/periodic_scene.h"
#include "pipelines/studies/study.h"
#include "postproc/drawing/tissue_drawing.h"
#include "postproc/output_file.h"
#include "postproc/quantities/cell_energy.h"
#include "postproc/quantities/cell_stress.h"
#include "postproc/quantities/material_constants.h"

namespace lamella {
namespace {

// In units of L = s = EI = 1, with EA = 1200 and k_t = 0.1 k_n unless stated. Stress along x pulls at a family of walls, along y along one.
constexpr double kEA = 1200, kEI = 1;
constexpr double kNoGap = 1e-8;  // distance of facing centre lines where formulas have none
constexpr const char* kDirection[] = {"normal to a wall family", "along a wall family"};

std::vector<std::string> settings_of(int n, double k_n, double k_t, double gap) {
  return {fmt::format("sample.walls.segments={}", n), fmt::format("links.normal_stiffness={}", k_n),
          fmt::format("links.tangential_stiffness={}", k_t), fmt::format("cells.radius={}", gap / 2)};
}

/// A unit cell with the sample that it looks at.
struct Lattice {
  Scene scene;
  Sample sample;
  UnitCell cell;
  Lattice(const StudyBench& bench, const std::vector<std::string>& settings)
      : scene(bench.scene("unit_cell.toml", settings)), sample(sample_of(scene)), cell(sample, scene.stages.front()) {}
};

struct Closed {
  double young = 0, poisson = 0, bulk = 0, shear = 0;
};

/// n = 1, links and core of finite stiffness.
Closed one_segment(double k_n, double k_t, double core) {
  const double k_w = 6 * kEI, k_a = 2 * kEA, root = std::sqrt(3.0);
  Closed c;
  c.bulk = 1 / (1 / (k_a / (2 * root) + core) + 1 / (root * k_n));
  c.shear = 1 / (root * (1 / k_w + 1 / k_a) + 2 / (root * (k_n + k_t)));
  c.young = 4 / (1 / c.bulk + 1 / c.shear);
  c.poisson = 1 - c.young / (2 * c.bulk);
  return c;
}

/// Rigid links, any n.
Closed rigid_links(double n) {
  const double k_w = 24 * kEI / (1 + 1 / n + 2 / (n * n)), k_a = 2 * kEA;
  Closed c;
  c.young = 4 / std::sqrt(3.0) * k_w / (1 + 3 * k_w / k_a);
  c.poisson = (1 - k_w / k_a) / (1 + 3 * k_w / k_a);
  return c;
}

/// Known to the digits given, for g = 0.
struct Known {
  int n;
  double k_n, young, poisson, normal, along;  // sigma_c L / f_n0 in the two directions
};
const Known kKnown[] = {{1, 100, 13.024608, .953001, 1.41935, 2.08118}, {2, 10, 12.378958, .732296, 1.69488, 2.57235},
                        {2, 100, 22.723222, .925096, 1.23448, 1.91764}, {2, 1000, 26.690937, .973150, 1.12153, 1.74110},
                        {4, 10, 14.908373, .795214, 2.19272, 3.47877},  {4, 100, 28.997978, .922516, 1.25056, 2.03933},
                        {4, 1000, 37.597904, .962838, .99957, 1.60556}, {8, 10, 17.315638, .854011, 2.93330, 4.84103},
                        {8, 100, 32.694494, .933810, 1.52604, 2.56593}, {8, 1000, 42.815274, .960170, .99149, 1.65802}};

void moduli(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Moduli");
  report.text(
      "One cell among copies of itself: the equilibrium of its nodes under a mean strain, from the assembled "
      "stiffness of bars, hinges, links and core (all rows of this section are static). Facing centre lines lie "
      "1e-8 apart, as the closed forms have no gap. In units of L = s = EI = 1, with EA = 1200. First rigid links: "
      "links of 1e6 and 2e6 (k_t = k_n), extrapolated to stiffness without end:");
  Chart chart{.title = "Young's modulus of honeycombs", .x_label = "segments n of a side", .y_label = "E* L^3 s / EI"};
  chart.x_scale = Scale::kLogarithmic;
  std::vector<double> x, y, n_exact, exact;
  for (const int n : {1, 2, 4, 8, 16}) {
    if (bench.small() && n > 4) continue;
    // What links of stiffness k add to the compliance falls with 1 / k.
    const SheetModuli soft = Lattice(bench, settings_of(n, 1e6, 1e6, 1e-11)).cell.moduli();
    const SheetModuli stiff = Lattice(bench, settings_of(n, 2e6, 2e6, 1e-11)).cell.moduli();
    const double young = 2 * stiff.young_x - soft.young_x;
    report.compare(fmt::format("rigid links, n = {}: E*", n), young, rigid_links(n).young, 1e-4);
    report.compare(fmt::format("rigid links, n = {}: nu*", n), 2 * stiff.poisson_x - soft.poisson_x,
                   rigid_links(n).poisson, 1e-4);
    x.push_back(n), y.push_back(young);
  }
  for (double n = 1; n <= 16; n *= 1.05) n_exact.push_back(n), exact.push_back(rigid_links(n).young);
  chart.curves = {line_curve(4, "rigid links, closed form", n_exact, exact), dotted_curve(4, "", x, y)};

  report.text("Then n = 1, for which links and cores of finite stiffness have closed forms:");
  struct Case {
    std::string what;
    double k_n, k_t, core;
  };
  for (const Case& one : {Case{"k_n = 100, k_t = 10", 100, 10, 0},
                          {"k_n = k_t = 50", 50, 50, 0},
                          {"k_n = 100, k_t = 10, core K = 300", 100, 10, 300}}) {
    auto settings = settings_of(1, one.k_n, one.k_t, kNoGap);
    if (one.core > 0) settings.push_back(fmt::format("cells.core.modulus={}", one.core));
    const Lattice lattice(bench, settings);
    const SheetModuli found = lattice.cell.moduli();
    const Closed closed = one_segment(one.k_n, one.k_t, one.core);
    report.compare("n = 1, " + one.what + ": K*", found.bulk, closed.bulk, 2e-6);
    report.compare("n = 1, " + one.what + ": G*", found.shear, closed.shear, 2e-6);
    report.compare("n = 1, " + one.what + ": E*", found.young_x, closed.young, 2e-6);
    report.compare("n = 1, " + one.what + ": nu*", found.poisson_x, closed.poisson, 2e-6);
  }

  report.text("And more segments, whose values are known from a solution of their own:");
  double anisotropy = 0;
  for (const Known& known : kKnown) {
    if (bench.small() && known.n > 4) continue;
    const Lattice lattice(bench, settings_of(known.n, known.k_n, 0.1 * known.k_n, kNoGap));
    const SheetModuli found = lattice.cell.moduli();
    report.compare(fmt::format("n = {}, k_n = {:g}: E*", known.n, known.k_n), found.young_x, known.young, 2e-6);
    report.compare(fmt::format("n = {}, k_n = {:g}: nu*", known.n, known.k_n), found.poisson_x, known.poisson, 2e-6);
    anisotropy = std::max({anisotropy, std::abs(found.young_y / found.young_x - 1),
                           std::abs(2 * found.shear * (1 + found.poisson_x) / found.young_x - 1)});
  }
  report.at_most("largest anisotropy of these: E* along the walls, and 2 G* (1 + nu*), over E*", anisotropy, 1e-6);
  int colour = 0;
  for (const double k_n : {10.0, 100.0, 1000.0}) {
    x.clear(), y.clear();
    for (const Known& known : kKnown)
      if (known.k_n == k_n)
        x.push_back(known.n),
            y.push_back(Lattice(bench, settings_of(known.n, k_n, 0.1 * k_n, kNoGap)).cell.moduli().young_x);
    chart.curves.push_back(dotted_curve(colour, fmt::format("k_n = {:g}", k_n), x, y));
    ++colour;
  }
  report.chart("moduli",
               "Stiffness over segments of a side: rigid links on their closed form, and links of finite stiffness.",
               chart);
}

void first_break(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("First break: equilibrium");
  report.text(
      "The uniaxial stress at which the first link breaks, with f_t0 = f_n0 and alpha = 2. For n = 1 it depends on "
      "k_t / k_n alone.");
  for (const auto& [ratio, normal, along] : {std::tuple(0.1, 1.41935, 2.08118), std::tuple(1.0, 2.0, 2.11010)}) {
    const Lattice lattice(bench, settings_of(1, 100, 100 * ratio, kNoGap));
    for (int axis : {0, 1})
      report.compare(fmt::format("n = 1, k_t / k_n = {:g}: sigma_c L / f_n0 {}", ratio, kDirection[axis]),
                     lattice.cell.first_break(uniaxial(axis), 1, 1), axis == 0 ? normal : along, 1e-5);
  }
  for (const Known& known : kKnown) {
    if (known.n == 1 || (bench.small() && known.n > 4)) continue;
    const Lattice lattice(bench, settings_of(known.n, known.k_n, 0.1 * known.k_n, kNoGap));
    for (int axis : {0, 1})
      report.compare(fmt::format("n = {}, k_n = {:g}: sigma_c L / f_n0 {}", known.n, known.k_n, kDirection[axis]),
                     lattice.cell.first_break(uniaxial(axis), 1, 1), axis == 0 ? known.normal : known.along, 1e-5);
  }
  // Share of a wall's force in each of its end links, pulled evenly on all sides.
  const Lattice stiff(bench, settings_of(8, 1e4, 1e3, kNoGap));
  const auto force = stiff.cell.link_forces_at(stiff.cell.strain_of(Eigen::Matrix2d::Identity()));
  double end = 0, sum = 0;
  for (std::size_t l = 0; l < force.size(); ++l) {
    const Link& link = stiff.sample.links[l];
    if (!stiff.cell.touches_centre(link)) continue;
    sum += force[l].normal;
    if (link.wall_end) end += force[l].normal / 2;
  }
  report.compare_absolute(
      "n = 8, k_n = 1e4, equal pull on all sides: share of each corner link in the force of its wall", end / sum, 0.47,
      0.005);
}

void gap(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Gap between the walls");
  report.text(
      "Formulas have no gap g between facing centre lines; samples have at least the thickness of two walls. A "
      "link that carries f_t turns its walls by f_t g, and the frame of a link turns with its walls, which moves "
      "its ends by g times that angle: as much as the link gives way where k_t g is not small beside EI / L^2. So "
      "the rule g <= 1e-3 L is good for k_n = 100 and no more; at k_t g = 0.1 EI / L^2 a honeycomb is 2 % "
      "stronger. First known values, for cells whose sides keep the length L, load normal to a wall family, k_t = "
      "0.1 k_n:");
  const auto strength = [&](int n, double k_n, double g) {
    auto settings = settings_of(n, k_n, 0.1 * k_n, g);
    settings.push_back(
        fmt::format("sample.side={:.17g}", 1 + g / std::sqrt(3.0)));  // insets shorten a side by g / sqrt 3
    return Lattice(bench, settings).cell.first_break(uniaxial(0), 1, 1);
  };
  const double none = strength(1, 100, kNoGap);
  report.compare_absolute("n = 1, k_n = 100, g = 1e-3: relative change of sigma_c", strength(1, 100, 1e-3) / none - 1,
                          0.0013, 5e-5);
  report.compare_absolute("n = 1, k_n = 100, g = 1e-2: relative change of sigma_c", strength(1, 100, 1e-2) / none - 1,
                          0.013, 5e-4);
  report.compare("n = 1, k_n = 1000, g = 0.05: sigma_c L / f_n0", strength(1, 1000, 0.05), 1.294, 1e-3);
  report.text(
      "With n = 4 the tangent of links between the ends counts, which is not settled by symmetry: at k_n = 1000, g "
      "= 0.05, a solution with another frame has 1.835; this one has the last value of the table.");
  ReportTable table{{"n", "k_n", "no gap", "g = 1e-4", "g = 1e-3", "g = 1e-2", "g = 0.05"}, {}};
  const std::vector<std::pair<int, double>> cases{{1, 100}, {1, 1000}, {4, 100}, {4, 1000}};
  for (const auto& [n, k_n] : cases) {
    std::vector<std::string> row{fmt::format("{}", n), fmt::format("{:g}", k_n)};
    for (const double g : {kNoGap, 1e-4, 1e-3, 1e-2, 0.05}) row.push_back(fmt::format("{:.5f}", strength(n, k_n, g)));
    table.rows.push_back(row);
  }
  report.table(std::move(table));
}

struct CellBreak {
  double stress = 0, young = 0, ledger = 0;
};

/// Pulls slowly in a run, up to the first break of a link of the central cell.
CellBreak pull_cell(StudyBench& bench, int n, double k_n, int axis) {
  const double strength = 1e-4;  // so small that tension in the walls, f L^2 / EI, does not stiffen them
  auto settings = settings_of(n, k_n, 0.1 * k_n, 1e-4);
  settings.push_back(fmt::format("links.normal_strength={}", strength));
  settings.push_back(fmt::format("links.tangential_strength={}", strength));
  const Lattice lattice(bench, settings);
  const std::string name = fmt::format("cell_{}_{:g}_{}", n, k_n, axis == 0 ? "normal" : "along");
  const Eigen::Matrix2d full = 1.1 * lattice.cell.first_break(uniaxial(axis), strength, strength) * uniaxial(axis);
  const auto scene = [&](double time) {
    return periodic_scene(bench, "unit_cell.toml", name, settings, lattice.cell, lattice.sample, full, time,
                          0.2 * time);
  };
  const double omega = lowest_frequency_of(lattice.sample, scene(1));
  const double time = (bench.small() ? 100 : 150) * 2 * M_PI / omega;
  settings.push_back(fmt::format("drag.rate={}", 0.005 * omega));
  settings.push_back(fmt::format("stop.time={}", time));
  const StudyRun run = bench.run(name, lattice.sample, scene(time));
  CellBreak found;
  double broke = -1;
  for (const Event& e : run.reader.events())
    if (broke < 0 && lattice.cell.touches_centre(lattice.sample.links[e.link])) broke = e.time;
  if (broke < 0) return found;
  const auto imposed = [&](double t) { return (t - 0.1 * time) / (0.9 * time); };  // share of `full`, behind the ramp
  const Eigen::Matrix2d strain = lattice.cell.strain_of(full);
  double share = 0;  // of the stress found over that imposed
  int frames = 0;
  for (int f = run.reader.frames() - 1; f > 0 && frames < 5; --f) {
    const Frame frame = run.reader.frame(f);
    if (frame.time >= broke) continue;
    const FrameView view(lattice.sample, frame);
    const Stress s = cell_stress(view, cell_shapes(lattice.sample, view.x), 1)[lattice.cell.centre()];
    share += (axis == 0 ? s.xx : s.yy) / (imposed(frame.time) * full(axis, axis));
    ++frames;
  }
  share /= frames;
  found.stress = share * imposed(broke) * full(axis, axis) / strength;
  found.young = share * full(axis, axis) / strain(axis, axis);
  found.ledger = run.ledger();
  return found;
}

void runs(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("First break: runs");
  report.text(
      "Nine cells; those around the middle one move as an infinite honeycomb's would, slowly, and the middle one "
      "is free. *sigma_c* is its mean stress (Love and Weber) when its first link breaks, *E** that stress over "
      "the mean strain. Facing centre lines lie 1e-4 apart, which adds up to 0.1 %. Every scene is in "
      "OUT/honeycomb/scenes/, for `lamella run`.");
  Chart chart{.title = "First break of honeycombs", .x_label = "segments n of a side", .y_label = "sigma_c L / f_n0"};
  chart.x_scale = Scale::kLogarithmic;
  double worst_ledger = 0;
  int colour = 0;
  for (const double k_n : {10.0, 100.0, 1000.0}) {
    std::vector<double> line_n, line[2], dot_n[2], dot[2];
    for (const int n : {1, 2, 3, 4, 6, 8, 12}) {
      if (bench.small() && n > 4) continue;
      const Lattice lattice(bench, settings_of(n, k_n, 0.1 * k_n, kNoGap));
      line_n.push_back(n);
      for (int axis : {0, 1}) line[axis].push_back(lattice.cell.first_break(uniaxial(axis), 1, 1));
    }
    for (const Known& known : kKnown) {
      if (known.k_n != k_n || (bench.small() && (k_n != 100 || known.n > 2))) continue;
      for (int axis : {0, 1}) {
        const CellBreak found = pull_cell(bench, known.n, k_n, axis);
        const std::string what = fmt::format("n = {}, k_n = {:g}, {}", known.n, k_n, kDirection[axis]);
        report.compare(what + ": sigma_c L / f_n0", found.stress, axis == 0 ? known.normal : known.along, 3e-3);
        report.compare(what + ": E*", found.young, known.young, 1e-3);
        worst_ledger = std::max(worst_ledger, found.ledger);
        dot_n[axis].push_back(known.n), dot[axis].push_back(found.stress);
      }
    }
    for (int axis : {0, 1}) {
      Curve curve = line_curve(colour, axis == 0 ? fmt::format("k_n = {:g}", k_n) : "", line_n, line[axis]);
      if (axis == 1) curve.style.dashes = {4, 3};
      chart.curves.push_back(curve);
      chart.curves.push_back(dotted_curve(colour, "", dot_n[axis], dot[axis]));
    }
    ++colour;
  }
  report.at_most("largest residual of the energy ledger", worst_ledger, 1e-3);
  report.chart("first_break",
               "Stress at the first break over segments of a side: equilibrium (lines; dashed: load along a wall "
               "family) and runs (dots). Finer sides put more "
               "links into a wall, and more of its force onto those at its corners.",
               chart);
}

/// Resultant of the model's forces on the moving grip along the load, and strain, at the first break.
struct PatchBreak {
  double strain = 0, stress = 0;
};

PatchBreak solve_patch(const Sample& sample, const Stage& stage) {
  const Field rest = field_of(sample.x);
  const auto model = build_model(sample, stage, rest);
  const auto loads = build_loads(sample, stage);
  const Gauge gauge = measure_gauge(sample, stage, loads);
  const StaticBreak found = find_first_break(*model, loads, rest, 1e-5 * gauge.length / gauge.speed);
  Field f(rest.size());
  for (const Term* term : model->terms()) term->add_force(found.x, f);
  PatchBreak out;
  out.strain = found.factor * gauge.speed / gauge.length;
  for (Index i : loads[1].nodes) out.stress -= f.at(i)[gauge.component] / (gauge.width * gauge.depth);
  return out;
}

/// Strain and stress of a run at its first break; the stress in proportion to the last row before it.
PatchBreak first_break_of(const StudyRun& run) {
  if (run.reader.events().empty()) return {};
  const double broke = run.reader.events().front().time;
  const auto time = run.column("time"), strain = run.column("strain"), stress = run.column("stress");
  std::size_t k = 0;
  while (k + 1 < time.size() && time[k + 1] < broke) ++k;
  PatchBreak found;
  found.strain = value_at(time, strain, broke);
  found.stress = stress[k] * found.strain / strain[k];
  return found;
}

void patches(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Patches between grips");
  report.text(
      "Patches have no closed form: a run of `patch.toml`, pulled slowly, against the equilibrium of the same "
      "model. Its first link breaks at the grips' corners.");
  for (const std::string axis : {"y", "x"}) {
    if (bench.small() && axis == "x") continue;
    std::vector<std::string> settings{"loading.axis=" + axis};
    if (bench.small())
      settings.insert(settings.end(), {"sample.columns=3", "sample.rows=4", "sample.walls.segments=2",
                                       "loading.strain_rate=1e-6", "loading.strain=3.2e-5"});
    const Scene scene = bench.scene("patch.toml", settings);
    const Sample sample = sample_of(scene);
    const StudyRun run = bench.run("patch_" + axis, sample, scene);
    const PatchBreak exact = solve_patch(sample, scene.stages.front());
    const PatchBreak found = first_break_of(run);
    report.compare("pulled along " + axis + ": strain at the first break", found.strain, exact.strain, 5e-3);
    report.compare("pulled along " + axis + ": stress at the first break", found.stress, exact.stress, 5e-3);
    report.at_most("pulled along " + axis + ": residual of the energy ledger", run.ledger(), 1e-3);
  }
}

void tear(StudyBench& bench) {
  if (bench.small()) return;
  StudyReport& report = bench.report;
  report.section("A honeycomb torn apart");
  const StudyRun run = bench.run("tear", "tear.toml");
  const auto stress = run.column("stress"), strain = run.column("strain"), time = run.column("time");
  const std::size_t peak = static_cast<std::size_t>(std::max_element(stress.begin(), stress.end()) - stress.begin());
  int middle = 0;
  while (middle + 1 < run.reader.frames() && run.reader.frame(middle + 1).time <= time[peak]) ++middle;
  const Frame frames[] = {run.reader.frame(middle), run.reader.frame(run.reader.frames() - 1)};
  const FrameView views[] = {{run.reader.sample(), frames[0]}, {run.reader.sample(), frames[1]}};
  const double w_0 = link_reference_energy(views[0]);
  double largest = 0;
  for (const double e : cell_energy(views[0]).total) largest = std::max(largest, e / w_0);
  const auto setup = test_setup(run.reader.provenance());
  report.picture(
      "tear",
      fmt::format("`tear.toml` near its largest stress (strain {:.2f} %) and when it is in two ({:.2f} %). Cells by "
                  "elastic energy, broken links in red.",
                  100 * value_at(run.column("time"), run.column("strain"), frames[0].time), 100 * strain.back()),
      {620, 330}, [&](Canvas& canvas) {
        const Box world = drawn_extent({&views[0], &views[1]}, setup);
        for (int k : {0, 1}) {
          const PageMap map(world, {Vec2(10 + 265 * k, 10), Vec2(265 + 265 * k, 320)});
          const CellEnergy energy = cell_energy(views[k]);
          draw_cells(canvas, map, views[k], [&](Index c) { return viridis(energy.total[c] / w_0 / largest); });
          for (std::size_t l = 0; l < views[k].sample.links.size(); ++l)
            if (!views[k].intact(static_cast<Index>(l)))
              canvas.line(link_mark(map, views[k], static_cast<Index>(l), views[k].x), {{0.9, 0.2, 0.16}, 1.5, {}});
          draw_grips(canvas, map, views[k], *setup);
        }
        draw_colour_bar(canvas, {Vec2(555, 60), Vec2(567, 270)},
                        {.low = 0, .high = largest, .label = "elastic energy of a cell / W\u2080", .map = viridis});
      });
  report.at_most("residual of the energy ledger", run.ledger(), 1e-3);
  report.holds("it ends in two parts", run.facts.ended.starts_with("separated"), run.facts.ended);
}

}  // namespace

void study_honeycomb(StudyBench& bench) {
  moduli(bench);
  first_break(bench);
  gap(bench);
  runs(bench);
  patches(bench);
  tear(bench);
}

}  // namespace lamella
