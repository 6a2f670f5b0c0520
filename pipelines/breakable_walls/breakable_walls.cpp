// Walls that break: the force and energy of a single break, the pressure at which a cell bursts, cracks through cells and between
// them, and the map of which happens over the strengths of walls and links.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipelines/studies/study.h"
#include "postproc/drawing/tissue_drawing.h"

namespace lamella {
namespace {

const Colour kFull{0.72, 0.84, 0.93}, kRest{0.93, 0.94, 0.95}, kCut{0.98, 0.88, 0.78}, kThrough{0.84, 0.15, 0.12},
    kBetween{0.12, 0.35, 0.70};

std::string set(const char* key, double value) { return fmt::format("{}={:.17g}", key, value); }

// ---- one chain ----------------------------------------------------------------------------------------------------

void chains(StudyBench& bench) {
  StudyReport& report = bench.report;
  const int n = 10;
  const double stiffness = 1000;  // EA / l0
  report.section("One chain: the force and the energy of a break");
  report.text(
      "Ten equal bars are drawn out slowly. Tension at the break: what the scene states, beyond it by one step's "
      "growth "
      "at most. Booked energy: T^2 / 2 k_s, the share 1 / n of the work of the grip, as all bars have stored as much.");
  const std::vector<double> strengths = bench.small() ? std::vector<double>{0.5} : std::vector<double>{0.25, 0.5, 1, 2};
  std::vector<double> forces, booked, fine, exact;
  for (const double strength : strengths) {
    const StudyRun run = bench.run(fmt::format("chain_{:g}", strength), "chain.toml",
                                   {set("cells.break_force", strength), set("stop.time", 10 + 100 * strength)});
    const std::string name = fmt::format("F_b = {:g}: ", strength);
    const auto& events = run.reader.events();
    report.compare_absolute(name + "bars broken", static_cast<double>(events.size()), 1, 0);
    if (events.empty()) continue;
    const Event& event = events.front();
    report.compare(name + "tension at the break", event.f_n, strength, 1e-3);
    report.compare(name + "booked energy, T^2 / 2 k_s of that tension", event.energy,
                   event.f_n * event.f_n / (2 * stiffness), 1e-12);
    report.compare(name + "booked energy, F_b^2 / 2 k_s", event.energy, strength * strength / (2 * stiffness), 2e-3);
    report.compare(name + "booked energy over the work, 1 / n", run.last("fracture") / run.last("work"), 1.0 / n, 2e-3);
    report.at_most(name + "energy still stored at the end over the work", run.last("energy_bars") / run.last("work"),
                   1e-6);
    report.at_most(name + "ledger", run.ledger(), 1e-3);
    forces.push_back(strength), booked.push_back(event.energy);
  }
  const StudyRun run =
      bench.run("chain_strain", "chain.toml", {set("cells.break_strain", 0.005), set("stop.time", 60)});
  const bool broke = !run.reader.events().empty();
  report.compare("break_strain = 0.005: tension at the break, EA times that", broke ? run.reader.events()[0].f_n : 0,
                 0.5, 1e-3);
  if (bench.small()) return;
  for (int k = 1; k <= 60; ++k) fine.push_back(k * 0.04), exact.push_back(fine.back() * fine.back() / (2 * stiffness));
  Chart chart{.title = "Energy of a break", .x_label = "strength F_b", .y_label = "booked energy"};
  chart.curves = {line_curve(0, "F_b^2 / 2 k_s", fine, exact), dotted_curve(0, "booked", forces, booked)};
  report.chart("chain", "Energy booked as fracture when one of ten bars breaks (dots) on its closed form.", chart);
}

// ---- a cell that bursts -------------------------------------------------------------------------------------------

/// The regular polygon of twelve bars, EA = 100 and R = 1 at rest, blown up to a tension of its bars.
struct Polygon {
  static constexpr int n = 12;
  static constexpr double rigidity = 100;
  double tension;

  double radius() const { return 1 + tension / rigidity; }
  double pressure() const { return tension / (radius() * std::cos(M_PI / n)); }
  static double rest_area() { return 0.5 * n * std::sin(2 * M_PI / n); }
  static double rest_length() { return 2 * std::sin(M_PI / n); }
  double stored() const { return n * tension * tension * rest_length() / (2 * rigidity); }
};

void draw_frames(StudyReport& report, const StudyRun& run, const std::vector<int>& frames) {
  const Sample& sample = run.reader.sample();
  std::vector<Frame> kept;
  for (const int k : frames) kept.push_back(run.reader.frame(k));
  std::vector<FrameView> views;
  std::vector<const FrameView*> all;
  views.reserve(kept.size());
  for (const Frame& frame : kept) views.emplace_back(sample, frame), all.push_back(&views.back());
  const Box world = drawn_extent(all, std::nullopt);
  const double width = 180, height = width * world.size().y() / world.size().x();
  const Vec2 size(width * static_cast<double>(views.size()) + 20, height + 50);
  report.picture("burst", "The cell before it bursts, and its ends as they fly apart and come to rest.", size,
                 [&](Canvas& canvas) {
                   for (std::size_t k = 0; k < views.size(); ++k) {
                     const Vec2 corner(10 + width * static_cast<double>(k), 34);
                     const PageMap map(world, {corner, corner + Vec2(width, height)});
                     draw_cells(canvas, map, views[k], [](Index) { return kFull; });
                     canvas.text(corner + Vec2(0.5 * width, -14), fmt::format("t = {:.4g}", views[k].frame.time),
                                 {.size = 11, .anchor = Anchor::kCentre});
                   }
                 });
}

void bursts(StudyBench& bench) {
  StudyReport& report = bench.report;
  const double strength = 5, pull = 0.05, rate = 6.0 / 500;
  report.section("A cell under pressure bursts");
  report.text(
      "A polygon of twelve bars (EA = 100, R = 1, EI = 1) is blown up slowly. Its bars carry T = p s R cos(pi / N) "
      "(the statics of physics.md 1, with the yield force replaced by the strength), R = 1 + T / EA. One bar is drawn "
      "by 1 % of its strength more than the others, breaks alone, and turns the shell into a chain.");
  {
    const StudyRun run = bench.run("burst", "burst.toml");
    const auto& events = run.reader.events();
    report.compare_absolute("bars broken", static_cast<double>(events.size()), 1, 0);
    if (!events.empty()) {
      const Event& event = events.front();
      report.holds("it is the bar that is drawn more", event.bar == 0, fmt::format("bar {}", event.bar));
      report.compare("pressure at the burst, (F_b - 0.05) / (s R cos(pi / N))", rate * event.time,
                     Polygon{strength - pull}.pressure(), 2e-3);
      const double stored = event.f_n * event.f_n * Polygon::rest_length() / (2 * Polygon::rigidity);
      report.compare("booked energy: bar, and hinges that hardly bend", event.energy, stored, 1e-3);
      const auto pressure = run.array("pressure");
      report.compare_absolute("pressure afterwards", pressure[0], 0, 0);
      int burst = 0;
      while (burst + 1 < run.reader.frames() && run.reader.frame(burst).time < event.time) ++burst;
      if (!bench.small())
        draw_frames(report, run,
                    {0, burst - 1, burst, std::min(burst + 1, run.reader.frames() - 1), run.reader.frames() - 1});
    }
    const double work = run.last("work");
    report.compare("work: what twelve bars had stored, and 3 % that the two small forces do on the open ends", work,
                   Polygon{strength - pull}.stored(), 0.05);
    report.at_most("kinetic energy at the end over that work", run.last("kinetic") / work, 1e-5);
    report.at_most("ledger", run.ledger(), 1e-3);
  }
  report.text("A perfect polygon has no weakest bar: all twelve reach their strength in the same step.");
  {
    const StudyRun run = bench.run("burst_perfect", "burst.toml", {"loads.down.force_y=0", "loads.up.force_y=0"});
    const auto& events = run.reader.events();
    report.compare_absolute("bars broken", static_cast<double>(events.size()), Polygon::n, 0);
    if (!events.empty()) {
      report.holds("in one step", events.front().time == events.back().time,
                   fmt::format("from {:.6g} to {:.6g}", events.front().time, events.back().time));
      report.compare("pressure at the burst, F_b / (s R cos(pi / N))", rate * events.front().time,
                     Polygon{strength}.pressure(), 2e-3);
    }
    report.compare("booked energy: what all bars had stored", run.last("fracture"), Polygon{strength}.stored(), 2e-3);
    report.compare("the same over the work of the pressure", run.last("fracture") / run.last("work"), 1, 2e-3);
  }
  report.text(
      "With a fluid of its own (K = 20, p0 = 7.3), the energy that the fluid would give by expanding to the pressure "
      "outside is lost as well: p^2 s A0 / 2 K.");
  {
    const StudyRun run = bench.run("fluid", "fluid.toml");
    const Polygon at{strength};
    const double modulus = 20, pressure = 7.3 - modulus * (at.radius() * at.radius() - 1);
    const double fluid = pressure * pressure * Polygon::rest_area() / (2 * modulus);
    report.compare("booked energy: bars and fluid", run.last("fracture"), at.stored() + fluid, 5e-3);
    report.at_most("ledger", run.ledger(), 1e-3);
  }
}

// ---- tissues ------------------------------------------------------------------------------------------------------

/// Where a tissue has broken. A cell that is cut in two counts with the distance of its cuts, a link with what it stands for.
struct Damage {
  double through = 0, between = 0;                 // [m]
  double energy_of_bars = 0, energy_of_links = 0;  // [J]
  int bars = 0, links = 0, cut = 0;

  double share() const { return through + between > 0 ? through / (through + between) : 0; }
};

Damage damage_of(const StudyRun& run) {
  const Sample& sample = run.reader.sample();
  std::vector<std::vector<Vec2>> cuts(sample.cells());
  const auto cell_of = cell_of_node(sample);
  Damage d;
  for (const Event& e : run.reader.events()) {
    if (e.bar < 0) {
      d.between += sample.links[e.link].length, d.energy_of_links += e.energy, ++d.links;
      continue;
    }
    const Index c = cell_of[e.bar];
    cuts[c].push_back(0.5 * (sample.x[e.bar] + sample.x[sample.next(c, e.bar)]));
    d.energy_of_bars += e.energy, ++d.bars;
  }
  for (const auto& places : cuts) {
    double longest = 0;
    for (const Vec2& p : places)
      for (const Vec2& q : places) longest = std::max(longest, (p - q).norm());
    d.through += longest;
    d.cut += places.size() > 1 ? 1 : 0;
  }
  return d;
}

/// The torn tissue, and where it broke, on the tissue at rest.
void draw_tissue(StudyReport& report, const std::string& name, const std::string& caption, const StudyRun& run) {
  const Sample& sample = run.reader.sample();
  const Frame last = run.reader.frame(run.reader.frames() - 1);
  Frame rest;
  std::vector<double> flat;
  for (const Vec2& p : sample.x) flat.push_back(p.x()), flat.push_back(p.y());
  rest.arrays.add({"x", "m", "node", 2, flat});
  const FrameView now(sample, last), before(sample, rest);
  const double width = 300;
  const Box world_now = drawn_extent({&now}, std::nullopt), world_rest = drawn_extent({&before}, std::nullopt);
  const double height =
      width * std::max(world_now.size().y() / world_now.size().x(), world_rest.size().y() / world_rest.size().x());
  const auto opened = [&](Index c) { return now.broken_bars() && now.broken_bars()->opened(c); };
  const auto cell_of = cell_of_node(sample);
  report.picture(name, caption, {2 * width + 40, height + 20}, [&](Canvas& canvas) {
    const PageMap left(world_now, {Vec2(10, 10), Vec2(10 + width, 10 + height)});
    draw_cells(canvas, left, now, [](Index) { return kFull; });
    const PageMap right(world_rest, {Vec2(30 + width, 10), Vec2(30 + 2 * width, 10 + height)});
    draw_cells(canvas, right, before, [&](Index c) { return opened(c) ? kCut : kRest; }, {0.66, 0.68, 0.72});
    for (const Event& e : run.reader.events())
      if (e.bar < 0) canvas.line(link_mark(right, before, e.link, sample.x), {kBetween, 2.6, {}});
    for (const Event& e : run.reader.events())
      if (e.bar >= 0) canvas.line(bar_mark(right, sample, cell_of[e.bar], e.bar), {kThrough, 2.6, {}});
  });
}

/// F_b over f_n0 L: the strength of a wall over that of a facing wall's links, L the mean length of an edge.
double strength_ratio(const Sample& sample, double wall, double link) {
  double length = 0;
  for (const Wall& w : sample.walls) length += w.length / static_cast<double>(sample.walls.size());
  return wall / (link * length);
}

void one_tissue(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("A tissue that breaks through cells as well as between them");
  const StudyRun run = bench.attempt(
      "tissue", "tissue.toml",
      bench.small() ? std::vector<std::string>{"sample.packing.count=20", "sample.width=4e-4", "sample.height=4e-4"}
                    : std::vector<std::string>{});
  const Damage d = damage_of(run);
  report.text(
      fmt::format("F_b / (f_n0 L) = {:.2f}. {} bars and {} links broke, {} cells are cut in two; {:.0f} % of the "
                  "crack's length runs "
                  "through cells. It ended: {}.",
                  strength_ratio(run.reader.sample(), 2.5e-3, 100), d.bars, d.links, d.cut, 100 * d.share(),
                  run.error.empty() ? run.reader.ended() : run.error));
  const auto stress = run.column("stress");
  report.at_most("stress at the end over the largest", stress.back() / *std::max_element(stress.begin(), stress.end()),
                 0.5);
  report.at_least("cells cut in two", d.cut, 1);
  report.at_least("broken links", d.links, 1);
  report.at_most("ledger", run.ledger(), 2e-3);
  if (bench.small()) return;
  draw_tissue(report, "tissue",
              "Left: the torn tissue; cells that a broken bar has opened are empty. Right: where it broke, at rest: "
              "between cells (blue) and through walls (red, cells that are opened tinted).",
              run);
}

Colour white_or_ink(double share) { return share < 0.55 ? Colour{1, 1, 1} : Colour{0.13, 0.14, 0.17}; }

void map_of_strengths(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Through or between? A map over the strengths of walls and links");
  const std::vector<double> walls =
      bench.small() ? std::vector<double>{1e-3, 8e-3} : std::vector<double>{1e-3, 2e-3, 4e-3, 8e-3};
  const std::vector<double> links =
      bench.small() ? std::vector<double>{50, 200} : std::vector<double>{25, 50, 100, 200};
  const std::size_t columns = walls.size(), rows = links.size();
  std::vector<double> share(columns * rows);
  ReportTable table;
  table.head = {"F_b [mN]",
                "f_n0 [N/m]",
                "F_b / (f_n0 L)",
                "bars",
                "links",
                "cells cut",
                "share through cells",
                "energy of bars / all",
                "strain at the end"};
  std::vector<std::pair<double, double>> points;
  double worst_ledger = 0;
  int parted = 0;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      std::vector<std::string> settings{set("cells.break_force", walls[c]), set("links.normal_strength", links[r]),
                                        set("links.tangential_strength", links[r]), "output.frames=4"};
      if (bench.small())
        settings.insert(settings.end(), {"sample.packing.count=16", "sample.width=4e-4", "sample.height=4e-4"});
      const StudyRun run = bench.attempt(fmt::format("map_{}_{}", c, r), "tissue.toml", settings);
      const Damage d = damage_of(run);
      share[r * columns + c] = d.share();
      worst_ledger = std::max(worst_ledger, run.ledger());
      parted += run.error.empty() && run.reader.ended().starts_with("separated") ? 1 : 0;
      const double ratio = strength_ratio(run.reader.sample(), walls[c], links[r]);
      points.emplace_back(ratio, d.share());
      const double energy = d.energy_of_bars + d.energy_of_links;
      table.rows.push_back({fmt::format("{:g}", 1e3 * walls[c]), fmt::format("{:g}", links[r]),
                            fmt::format("{:.3g}", ratio), std::to_string(d.bars), std::to_string(d.links),
                            std::to_string(d.cut), fmt::format("{:.2f}", d.share()),
                            fmt::format("{:.2f}", energy > 0 ? d.energy_of_bars / energy : 0),
                            fmt::format("{:.3g}", run.last("strain"))});
    }
  report.text(
      "Share through cells: length of the cuts through cells (distance of a cell's broken bars, at rest) over that and "
      "the length of the broken links. L: mean length of an edge.");
  report.table(table);
  double by_wall = 0, by_link = 0;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c + 1 < columns; ++c)
      by_wall = std::max(by_wall, share[r * columns + c + 1] - share[r * columns + c]);
  for (std::size_t r = 0; r + 1 < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c)
      by_link = std::max(by_link, share[r * columns + c] - share[(r + 1) * columns + c]);
  report.at_most("largest rise of the share from a wall to a stronger one", by_wall, 0.1);
  report.at_most("largest fall of the share from a link to a stronger one", by_link, 0.1);
  report.at_least("weakest walls, strongest links: share through cells", share[(rows - 1) * columns], 0.7);
  report.at_most("strongest walls, weakest links: share through cells", share[columns - 1], 0.02);
  report.text(fmt::format("{} of {} tissues parted within a strain of 0.3; in the others bridges of cells remain.",
                          parted, columns * rows));
  report.at_most("largest ledger", worst_ledger, 2e-3);
  if (bench.small()) return;

  const double cell = 62, left = 96, top = 46;
  report.picture(
      "map", "Share of the crack that runs through cells, over the strength of walls and of links.",
      {left + cell * static_cast<double>(columns) + 30, top + cell * static_cast<double>(rows) + 70},
      [&](Canvas& canvas) {
        canvas.text({left + 0.5 * cell * static_cast<double>(columns), 22}, "Share of the crack through cells",
                    {.size = 13, .anchor = Anchor::kCentre, .weight = Weight::kBold});
        for (std::size_t r = 0; r < rows; ++r) {
          const double y = top + cell * static_cast<double>(rows - 1 - r);
          canvas.text({left - 10, y + 0.5 * cell + 4}, fmt::format("{:g}", links[r]), {.anchor = Anchor::kRight});
          for (std::size_t c = 0; c < columns; ++c) {
            const double x = left + cell * static_cast<double>(c), value = share[r * columns + c];
            canvas.rectangle({{x + 1, y + 1}, {x + cell - 1, y + cell - 1}}, viridis(value));
            canvas.text({x + 0.5 * cell, y + 0.5 * cell + 5}, fmt::format("{:.2f}", value),
                        {.size = 13, .anchor = Anchor::kCentre, .colour = white_or_ink(value)});
          }
        }
        const double bottom = top + cell * static_cast<double>(rows);
        for (std::size_t c = 0; c < columns; ++c)
          canvas.text({left + cell * (static_cast<double>(c) + 0.5), bottom + 18}, fmt::format("{:g}", 1e3 * walls[c]),
                      {.anchor = Anchor::kCentre});
        canvas.text({left + 0.5 * cell * static_cast<double>(columns), bottom + 40}, "strength of a wall F_b [mN]",
                    {.size = 11, .anchor = Anchor::kCentre});
        canvas.text({34, top + 0.5 * cell * static_cast<double>(rows)}, "strength of links f_n0 [N/m]",
                    {.size = 11, .anchor = Anchor::kCentre, .angle = -M_PI / 2});
      });
  std::sort(points.begin(), points.end());
  std::vector<double> x, y;
  for (const auto& [ratio, value] : points) x.push_back(ratio), y.push_back(value);
  Chart chart{.title = "One number decides", .x_label = "F_b / (f_n0 L)", .y_label = "share through cells"};
  chart.x_scale = Scale::kLogarithmic;
  chart.curves = {dotted_curve(0, "", x, y)};
  report.chart("ratio", "The same shares over the ratio of the strengths of a wall and of the links along an edge.",
               chart);
}

}  // namespace

void study_breakable_walls(StudyBench& bench) {
  chains(bench);
  bursts(bench);
  one_tissue(bench);
  map_of_strengths(bench);
}

}  // namespace lamella
