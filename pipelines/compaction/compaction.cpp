// Sec. 5 of the paper: rings deposited under gravity are compacted by a lid, and unloaded; four sets of parameters from one sample.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "generator/sample/voids.h"
#include "pipelines/studies/study.h"
#include "postproc/drawing/tissue_drawing.h"
#include "postproc/quantities/cell_energy.h"
#include "postproc/quantities/cell_shape.h"
#include "postproc/quantities/packing_state.h"
#include "simulator/trajectory/extract.h"

namespace lamella {
namespace {

const double kStrain = 0.3;           // ln(H0 / H)
const double kVoidRatio = 0.04;       // or this, whichever comes first
const double kReferenceStress = 0.5;  // sigma* = EI / (2 R^3 s)
const double kWallRadius = 0.1;
const std::size_t kRowsPerFrame = 10;  // of compact.toml

struct Set {
  std::string name, label;
  std::vector<std::string> settings;
  double speed;  // of the lid
};

const std::vector<Set> kSets{
    {"empty", "\u03b7 = 0", {}, 0.03},
    {"soft_core", "\u03b7 = 1", {"cells.core.stiffness_ratio=1"}, 0.04},
    {"stiff_core", "\u03b7 = 1000", {"cells.core.stiffness_ratio=1000", "contact.normal_stiffness=30000"}, 0.04},
    {"plastic", "\u03b7 = 0, plastic", {"cells.yield_moment=0.1"}, 0.02},
};

/// A frame of a compaction.
struct State {
  int stage = 0;  // 0 loading, 1 rest, 2 unloading
  int frame = 0;
  double strain = 0;  // ln(H0 / H)
  double lid_stress = 0, floor_stress = 0,
         stress = 0;   // while the lid moves means over the time between two frames; mean of both
  double kinetic = 0;  // [J]
  PackingState packing;
};

struct Compaction {
  StudyRun run;
  Set set;
  std::vector<State> states;

  /// The last frame of a stage.
  const State& end_of(int stage) const {
    return *std::find_if(states.rbegin(), states.rend(), [&](const State& s) { return s.stage == stage; });
  }
  std::vector<double> of(int stage, const std::function<double(const State&)>& value) const {
    std::vector<double> values;
    for (const State& s : states)
      if (s.stage == stage) values.push_back(value(s));
    return values;
  }
  /// Share of the cells in the loss of room, dV_s / dV, both since the sample: of what the centre lines enclose, or of outlines. A wall
  /// that stretches keeps its thickness 2 r, so that outlines may grow around a core that keeps its area.
  double share(const State& s) const { return lost(s, &PackingState::cell_area); }
  double outline_share(const State& s) const { return lost(s, &PackingState::outline_area); }
  double lost(const State& s, double PackingState::*area) const {
    return (states.front().packing.*area - s.packing.*area) / (states.front().packing.room - s.packing.room);
  }
};

double strain_of(const State& s) { return s.strain; }
double stress_of(const State& s) { return s.stress / kReferenceStress; }
double voids_of(const State& s) { return s.packing.void_ratio; }

/// The deposited sample of `count` rings of mean radius 1 with `nodes` mass points each, in a box of the asked width.
Sample deposited(StudyBench& bench, const std::string& name, int count, int nodes, double width) {
  const double height = count * std::numbers::pi * (1 + 0.0866 * 0.0866) / (0.7 * width), r = kWallRadius;
  const auto wall = [](int k, double x0, double y0, double x1, double y1) {
    return std::vector<std::string>{fmt::format("sample.shapes.{}.from=[{:.9g},{:.9g}]", k, x0, y0),
                                    fmt::format("sample.shapes.{}.to=[{:.9g},{:.9g}]", k, x1, y1)};
  };
  std::vector<std::string> settings{
      fmt::format("sample.packing.count={}", count), fmt::format("sample.ring_nodes={}", nodes),
      fmt::format("sample.width={:.9g}", width), fmt::format("sample.height={:.9g}", height)};
  for (const auto& one : {wall(0, -2 * r, -r, width + 2 * r, -r), wall(1, -r, 0, -r, height + 2),
                          wall(2, width + r, 0, width + r, height + 2), wall(3, 0, height + r, width, height + r)})
    settings.insert(settings.end(), one.begin(), one.end());
  const StudyRun run = bench.run("deposit_" + name, "deposit.toml", settings);
  StudyReport& report = bench.report;
  report.at_most(fmt::format("{}: residual of the energy ledger", run.facts.ended), run.ledger(), 5e-3);
  report.holds("the lid has touched", run.facts.ended.find("load 'lid' exerts") == 0, run.facts.ended);
  return extract_sample(run.reader, -1);
}

Compaction compacted(StudyBench& bench, const std::string& name, const Sample& sample, Set set) {
  const double height = room_between_walls(sample, sample.x)->size().y();
  const double time = kStrain * height / set.speed;  // some more than it takes: 1 - exp(-0.3) < 0.3
  set.settings.push_back(fmt::format("stop.compaction={:.9g}", -std::expm1(-kStrain)));
  set.settings.push_back(fmt::format("stop.void_ratio={}", kVoidRatio));
  set.settings.push_back(fmt::format("stop.time={:.9g}", time));
  set.settings.push_back(fmt::format("loads.lid.velocity_y={:.9g}", -set.speed));
  set.settings.push_back(fmt::format("stages.unload.stop.time={:.9g}", time));
  set.settings.push_back(fmt::format("stages.unload.loads.lid.velocity_y={:.9g}", set.speed));
  Compaction done{bench.run(name, sample, bench.scene("compact.toml", set.settings)), set, {}};
  const auto time_of = done.run.column("time"), stage_of = done.run.column("stage");
  const auto lid = done.run.column("force_y_lid"), floor = done.run.column("force_y_floor");
  const auto kinetic = done.run.column("kinetic");
  const double width = room_between_walls(sample, sample.x)->size().x();
  std::size_t row = 0;
  for (int k = 0; k < done.run.reader.frames(); ++k) {
    const Frame frame = done.run.reader.frame(k);
    while (stage_of[row] != frame.stage || time_of[row] < frame.time) ++row;
    State state;
    state.stage = frame.stage, state.frame = k;
    const std::size_t reach = frame.stage == 1 ? 0 : kRowsPerFrame / 2;
    int rows = 0;
    for (std::size_t r = row - std::min(row, reach); r <= std::min(row + reach, lid.size() - 1); ++r)
      if (stage_of[r] == frame.stage)
        state.lid_stress -= lid[r] / width, state.floor_stress += floor[r] / width, ++rows;
    state.lid_stress /= rows, state.floor_stress /= rows;
    state.stress = 0.5 * (state.lid_stress + state.floor_stress);
    state.kinetic = kinetic[row];
    state.packing = *packing_state(FrameView(done.run.reader.sample(), frame));
    state.strain = -std::log1p(-state.packing.compaction);
    done.states.push_back(state);
  }
  return done;
}

/// Void ratio by throwing points into the room: shares nothing with covered_area.
double void_ratio_by_points(const Sample& sample, const std::vector<Vec2>& x, int points) {
  const Box room = *room_between_walls(sample, x);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  int inside = 0;
  for (int k = 0; k < points; ++k) {
    const Vec2 p = room.lo + Vec2(unit(random), unit(random)).cwiseProduct(room.size());
    bool covered = false;
    for (Index c = 0; c < sample.cells() && !covered; ++c) {
      if (!sample.closed[c]) continue;
      const Index begin = sample.cell_begin[c], end = sample.cell_begin[c + 1];
      if ((x[begin] - p).norm() > 8) continue;  // no ring is that long
      double turns = 0;
      for (Index i = begin; i < end && !covered; ++i) {
        const Vec2 a = x[i] - p, b = x[sample.next(c, i)] - p, d = b - a;
        turns += std::atan2(cross(a, b), a.dot(b));
        const double t = std::clamp(-a.dot(d) / d.squaredNorm(), 0.0, 1.0);
        covered = (a + t * d).norm() < sample.radius[c];
      }
      covered = covered || std::abs(turns) > std::numbers::pi;
    }
    inside += covered;
  }
  return static_cast<double>(points) / inside - 1;
}

/// The state of unloading at which the stress has fallen below 1 % of its largest.
const State& unloaded(const Compaction& c) {
  for (const State& s : c.states)
    if (s.stage == 2 && s.stress < 0.01 * c.end_of(0).stress) return s;
  return c.end_of(2);
}

/// Largest residual of the ledger once a tenth of the work is done: before, the impact of the lid is all there is to compare with.
double ledger(const StudyRun& run) {
  const auto residual = run.column("residual"), work = run.column("work");
  double most = 0, largest = 0;
  for (double w : work) most = std::max(most, std::abs(w));
  for (std::size_t k = 0; k < work.size(); ++k)
    if (std::abs(work[k]) > 0.1 * most) largest = std::max(largest, residual[k]);
  return largest;
}

/// C of Eq. 38 over the last decade of the loading's stress.
FittedLine compressibility(const Compaction& c) {
  const double largest = c.end_of(0).stress;
  std::vector<double> x, y;
  for (const State& s : c.states)
    if (s.stage == 0 && s.stress > 0.1 * largest) x.push_back(std::log10(stress_of(s))), y.push_back(voids_of(s));
  return fitted_line(x, y);
}

// ---- what is checked ------------------------------------------------------------------------------------------------

void check_run(StudyReport& report, const Compaction& c) {
  const std::string& of = c.set.label;
  report.at_most(of + ": residual of the energy ledger, from a tenth of the work on", ledger(c.run), 2e-3);
  const State& rest = c.end_of(1);
  report.compare(of + ": at rest, stress on the floor over that on the lid", rest.floor_stress / rest.lid_stress, 1,
                 0.01);
  // Inertia and drag: what the lid feels beyond the floor while it moves, as a share of the largest stress.
  double difference = 0;
  for (const State& s : c.states)
    if (s.stage == 0) difference = std::max(difference, std::abs(s.lid_stress - s.floor_stress));
  report.at_most(of + ": while loading, lid and floor differ by, over the largest stress",
                 difference / c.end_of(0).stress, 0.15);
  // e is defined by the room, so the two measures of the cells' area are what can disagree: overlaps are between them.
  const double covered = rest.packing.room / (1 + rest.packing.void_ratio);
  report.between(of + ": compacted, overlaps over the area of the cells", rest.packing.outline_area / covered - 1,
                 -1e-4, 0.02);
}

void check_voids(StudyReport& report, const Compaction& c, int points) {
  const State& rest = c.end_of(1);
  const double e = rest.packing.void_ratio;
  const double deviation = (1 + e) * std::sqrt(e / points);  // of the estimate, by the binomial law
  report.compare_absolute(
      fmt::format("{}: compacted, void ratio by {} random points (allowed: 4 deviations)", c.set.label, points),
      void_ratio_by_points(c.run.reader.sample(), c.run.positions(rest.frame), points), e, 4 * deviation);
}

void report_inertia(StudyReport& report, const std::vector<Compaction>& all) {
  ReportTable table{{"set", "speed of the lid", "rate", "inertial number at the end", "kinetic over elastic, largest",
                     "stress: loading's end", "at rest"},
                    {}};
  for (const Compaction& c : all) {
    const State& end = c.end_of(0);
    const Sample& sample = c.run.reader.sample();
    const double height = room_between_walls(sample, sample.x)->size().y(), rate = c.set.speed / height;
    const double density = 2 * std::numbers::pi / (std::numbers::pi * (1 + end.packing.void_ratio));
    double share = 0;
    for (const State& s : c.states) {
      if (s.stage != 0 || s.strain < 0.05) continue;
      const Frame frame = c.run.reader.frame(s.frame);
      const CellEnergy energy = cell_energy(FrameView(sample, frame));
      double stored = 0;
      for (double of_cell : energy.total) stored += of_cell;
      share = std::max(share, s.kinetic / stored);
    }
    table.rows.push_back({c.set.label, fmt::format("{:.3g}", c.set.speed), fmt::format("{:.2e}", rate),
                          fmt::format("{:.1e}", 2 * rate * std::sqrt(density / end.stress)),
                          fmt::format("{:.1e}", share), fmt::format("{:.4g}", end.stress),
                          fmt::format("{:.4g}", c.end_of(1).stress)});
  }
  report.text(
      "How nearly static: inertial number I = 2 R rate (density / stress)^1/2; kinetic over elastic energy beyond a "
      "strain of 0.05; and the stress on the lid before and after it stands still. Rates in (EI / mass per length "
      "R^4)^1/2.");
  report.table(std::move(table));
}

void report_outcomes(StudyReport& report, const std::vector<Compaction>& all) {
  ReportTable table{{"set", "ended by", "strain", "stress / \u03c3*", "e at H0", "e compacted", "dV_s / dV",
                     "by outlines", "C (95 %)", "residual strain", "e there", "aspect", "circularity"},
                    {}};
  for (const Compaction& c : all) {
    const State &end = c.end_of(0), &rest = c.end_of(1);
    const FittedLine line = compressibility(c);
    table.rows.push_back({c.set.label, end.packing.void_ratio < kVoidRatio * 1.05 ? "void ratio" : "strain",
                          fmt::format("{:.3f}", end.strain), fmt::format("{:.4g}", stress_of(end)),
                          fmt::format("{:.4f}", c.states.front().packing.void_ratio),
                          fmt::format("{:.4f}", end.packing.void_ratio), fmt::format("{:.3f}", c.share(end)),
                          fmt::format("{:.3f}", c.outline_share(end)),
                          fmt::format("{:.3f} \u00b1 {:.3f}", -line.slope, line.half_width),
                          fmt::format("{:.3f}", unloaded(c).strain), fmt::format("{:.4f}", voids_of(unloaded(c))),
                          fmt::format("{:.3f}", rest.packing.aspect), fmt::format("{:.4f}", rest.packing.circularity)});
  }
  report.text(
      "Strain is ln(H0 / H), H0 the height at the lid's first touch; stress the mean of that on lid and floor, over "
      "\u03c3* = EI / 2 R^3 s; e the void "
      "ratio by outlines, overlaps counted once. dV_s / dV is the cells' share in the loss of room, by what the walls' "
      "centre lines enclose, and by outlines "
      "(a stretched wall keeps its thickness, so that outlines grow around cores that do not). C is minus the slope of "
      "e over log10 of the stress, over the "
      "last decade of stress; its interval takes the frames for independent, which they are not quite. Residual "
      "strain, and e there: where unloading has "
      "brought the stress below 1 % of its largest. Aspect and circularity (4 pi A / P^2): means over the cells, "
      "compacted and at rest.");
  report.table(std::move(table));
}

/// (1 + e) V_s = V: what the paper's numbers for e, strain and dV_s do not fulfil.
void report_kinematics(StudyReport& report, const std::vector<Compaction>& all) {
  report.section("Kinematics: the paper's numbers contradict each other");
  report.text(
      "Room is cells plus pores: (1 + e) V_s = V. From e0, the strain and the share s of the cells in the loss of room "
      "follows "
      "1 + e = (1 + e0) exp(-strain) / (1 - s (1 + e0) (1 - exp(-strain))). With the paper's e0 = 0.22 and strain 0.3: "
      "stiff cores (s = 0) would end at a "
      "negative void ratio, where the paper says 0.04. Its strain or its e0 is measured from another state than H0; "
      "its numbers are no targets here. "
      "Runs of this study fulfil the identity but for overlaps, which are the difference between V_s and the area that "
      "is covered.");
  ReportTable table{{"", "e0", "strain", "dV_s / dV", "e that follows", "e stated or found"}, {}};
  const auto follows = [](double e0, double strain, double share) {
    const double left = std::exp(-strain);
    return (1 + e0) * left / (1 - share * (1 + e0) * (1 - left)) - 1;
  };
  struct Stated {
    const char* what;
    double share, e;
  };
  for (const Stated& s :
       {Stated{"paper, \u03b7 = 0", 0.37, 0.10}, {"paper, \u03b7 = \u221e", 0.0, 0.04}, {"paper, plastic", 0.22, 0.06}})
    table.rows.push_back({s.what, "0.22", "0.3", fmt::format("{:.2f}", s.share),
                          fmt::format("{:.3f}", follows(0.22, 0.3, s.share)), fmt::format("{:.2f}", s.e)});
  for (const Compaction& c : all) {
    const State& rest = c.end_of(1);
    const double e0 = c.states.front().packing.void_ratio, e = rest.packing.void_ratio;
    const double found = follows(e0, rest.strain, c.outline_share(rest));
    table.rows.push_back({"here, " + c.set.label, fmt::format("{:.4f}", e0), fmt::format("{:.3f}", rest.strain),
                          fmt::format("{:.3f}", c.outline_share(rest)), fmt::format("{:.4f}", found),
                          fmt::format("{:.4f}", e)});
  }
  report.table(std::move(table));
  report.at_most("paper's numbers: void ratio that follows for stiff cores", follows(0.22, 0.3, 0), 0);
  for (const Compaction& c : all) {
    const State& rest = c.end_of(1);
    report.compare_absolute(c.set.label + ": void ratio that follows (overlaps are the difference)",
                            follows(c.states.front().packing.void_ratio, rest.strain, c.outline_share(rest)),
                            rest.packing.void_ratio, 0.02);
  }
}

void compare_sets(StudyReport& report, const std::vector<Compaction>& all) {
  const Compaction &empty = all[0], &soft = all[1], &stiff = all[2], &plastic = all[3];
  report.at_most("stiff cores keep their volume: share in the loss of room", stiff.share(stiff.end_of(0)), 0.02);
  report.holds("cells lose the less volume the stiffer their core",
               empty.share(empty.end_of(0)) > soft.share(soft.end_of(0)) &&
                   soft.share(soft.end_of(0)) > stiff.share(stiff.end_of(0)),
               fmt::format("{:.3f} > {:.3f} > {:.3f}", empty.share(empty.end_of(0)), soft.share(soft.end_of(0)),
                           stiff.share(stiff.end_of(0))));
  report.holds("plastic rings keep more strain than elastic ones", unloaded(plastic).strain > unloaded(empty).strain,
               fmt::format("{:.3f} > {:.3f}", unloaded(plastic).strain, unloaded(empty).strain));
  report.holds("plastic rings bear less", plastic.end_of(0).stress < empty.end_of(0).stress,
               fmt::format("{:.3g} < {:.3g}", stress_of(plastic.end_of(0)), stress_of(empty.end_of(0))));
  report.holds("unloaded, elastic rings are round again, plastic ones not",
               empty.end_of(2).packing.circularity > plastic.end_of(2).packing.circularity,
               fmt::format("circularity {:.4f} > {:.4f}", empty.end_of(2).packing.circularity,
                           plastic.end_of(2).packing.circularity));
}

// ---- what is drawn --------------------------------------------------------------------------------------------------

/// Loading full, unloading dashed, one colour a set.
void add_paths(Chart& chart, const std::vector<Compaction>& all, const std::function<double(const State&)>& x,
               const std::function<double(const Compaction&, const State&)>& y, double from = 0) {
  for (std::size_t k = 0; k < all.size(); ++k)
    for (const int stage : {0, 2}) {
      const Compaction& c = all[k];
      Curve curve = line_curve(static_cast<int>(k), stage == 0 ? c.set.label : "", {}, {});
      if (stage == 2) curve.style.dashes = {4, 3};
      for (const State& s : c.states)
        if (s.stage == stage && s.strain >= from && s.stress > 0) curve.x.push_back(x(s)), curve.y.push_back(y(c, s));
      chart.curves.push_back(curve);
    }
}

void draw_histogram(StudyReport& report, const std::string& name, const std::string& what,
                    const std::vector<Compaction>& all, double low, double high,
                    const std::function<double(const CellShape&)>& value) {
  const int bins = 24;
  Chart chart{.title = "Compacted, at rest", .x_label = what, .y_label = "share of the cells"};
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Sample& sample = all[k].run.reader.sample();
    const auto x = all[k].run.positions(all[k].end_of(1).frame);
    std::vector<double> count(bins, 0), middle;
    double cells = 0;
    for (int b = 0; b < bins; ++b) middle.push_back(low + (b + 0.5) * (high - low) / bins);
    for (Index c = 0; c < sample.cells(); ++c) {
      if (!sample.closed[c]) continue;
      const double share = (value(cell_shape(sample, x, c)) - low) / (high - low);
      ++count[static_cast<std::size_t>(std::clamp(static_cast<int>(share * bins), 0, bins - 1))], ++cells;
    }
    for (double& n : count) n /= cells;
    chart.curves.push_back(line_curve(static_cast<int>(k), all[k].set.label, middle, count));
  }
  report.chart(name, fmt::format("Distribution of the {} ({} bins; the outer ones hold what is beyond).", what, bins),
               chart);
}

struct Panel {
  const Compaction* of;
  int frame;
  std::string title;
};

/// Panels two abreast; `fill` colours a cell by its energy over the mean of all cells.
void draw_panels(StudyReport& report, const std::string& name, const std::string& caption,
                 const std::vector<Panel>& panels, const std::function<Colour(double)>& fill,
                 const std::optional<ColourBar>& bar) {
  const double wide = 360, head = 18, margin = bar ? 74 : 0;
  const Sample& first = panels.front().of->run.reader.sample();
  const Box room = *room_between_walls(first, first.x);
  const Box world{room.lo - Vec2::Constant(0.6), room.hi + Vec2::Constant(0.6)};
  const double high = wide * world.size().y() / world.size().x();
  const int rows = static_cast<int>(panels.size() + 1) / 2;
  report.picture(name, caption, {2 * wide + 30 + margin, rows * (high + head + 8)}, [&](Canvas& canvas) {
    for (std::size_t k = 0; k < panels.size(); ++k) {
      const double left = 10 + static_cast<double>(k % 2) * (wide + 10),
                   top = static_cast<double>(k / 2) * (high + head + 8);
      canvas.text({left + 4, top + 13}, panels[k].title);
      const StudyRun& run = panels[k].of->run;
      const Frame frame = run.reader.frame(panels[k].frame);
      const FrameView view(run.reader.sample(), frame);
      const std::vector<double> energy = cell_energy(view).total;
      double sum = 0, cells = 0;
      for (Index c = 0; c < view.sample.cells(); ++c)
        if (view.sample.closed[c]) sum += energy[c], ++cells;
      const Box page{{left, top + head}, {left + wide, top + head + high}};
      canvas.clipped(page, [&] {
        draw_cells(canvas, PageMap(world, page), view, [&](Index c) {
          return view.sample.closed[c] ? fill(energy[c] * cells / sum) : Colour{0.45, 0.47, 0.52};
        });
      });
    }
    const double middle = 0.5 * rows * (high + head + 8);
    if (bar) draw_colour_bar(canvas, {{2 * wide + 30, middle - 90}, {2 * wide + 42, middle + 90}}, *bar);
  });
}

void draw(StudyReport& report, const std::vector<Compaction>& all) {
  report.section("Figures");
  Chart stress{.title = "Compaction and unloading", .x_label = "ln(H0 / H)", .y_label = "\u03c3 / \u03c3*"};
  stress.y_scale = Scale::kLogarithmic;
  add_paths(stress, all, strain_of, [](const Compaction&, const State& s) { return std::max(1e-3, stress_of(s)); });
  report.chart("stress_strain", "Stress over strain (Fig. 27); full: loading, dashed: unloading.", stress);
  Chart voids{.title = "Void ratio", .x_label = "\u03c3 / \u03c3*", .y_label = "e"};
  voids.x_scale = Scale::kLogarithmic;
  const auto stress_on_page = [](const State& s) { return std::max(1e-3, stress_of(s)); };
  add_paths(voids, all, stress_on_page, [](const Compaction&, const State& s) { return voids_of(s); });
  report.chart("void_ratio", "Void ratio over stress (Fig. 28a).", voids);
  Chart share{.title = "Share of the cells", .x_label = "\u03c3 / \u03c3*", .y_label = "dV_s / dV"};
  share.x_scale = Scale::kLogarithmic;
  add_paths(
      share, all, stress_on_page, [](const Compaction& c, const State& s) { return c.share(s); }, 0.01);
  report.chart("share", "What of the loss of room the cells lose (Fig. 28b), beyond a strain of 0.01.", share);
  Chart shape{.title = "Shape of the cells", .x_label = "ln(H0 / H)", .y_label = "mean aspect"};
  add_paths(shape, all, strain_of, [](const Compaction&, const State& s) { return s.packing.aspect; });
  report.chart("aspect", "Mean aspect (root of the ratio of principal second moments of area).", shape);
  draw_histogram(report, "aspects", "aspect", all, 1, 2.5, [](const CellShape& s) { return s.aspect; });
  draw_histogram(report, "circularities", "circularity", all, 0.7, 1,
                 [](const CellShape& s) { return s.circularity(); });

  const Compaction& empty = all[0];
  const int last = empty.end_of(0).frame;
  const auto plain = [](double) { return Colour{0.80, 0.87, 0.93}; };
  draw_panels(
      report, "snapshots", "The set \u03b7 = 0 (Fig. 26).",
      {{&empty, 0, "first touch"},
       {&empty, last / 2, fmt::format("strain {:.2f}", empty.states[static_cast<std::size_t>(last / 2)].strain)},
       {&empty, last, fmt::format("strain {:.2f}", empty.end_of(0).strain)},
       {&empty, empty.end_of(2).frame, "unloaded"}},
      plain, std::nullopt);
  const double most = 5;
  ColourBar bar{.low = 1, .high = most, .open_end = true, .label = "energy of a cell / mean"};
  bar.map = embers;
  std::vector<Panel> panels;
  for (const Compaction& c : all)
    panels.push_back({&c, c.end_of(1).frame, fmt::format("{}, strain {:.2f}", c.set.label, c.end_of(1).strain)});
  draw_panels(
      report, "energies", "Compacted (Fig. 29): elastic energy of each cell over the mean; white below it.", panels,
      [most](double energy) {
        return energy < 1 ? Colour{1, 1, 1} : embers((energy - 1) / (most - 1));
      },
      bar);
}

// ---- errors, on smaller samples -------------------------------------------------------------------------------------

double value_at_strain(const Compaction& c, double strain, const std::function<double(const State&)>& value) {
  const State* before = &c.states.front();
  for (const State& s : c.states) {
    if (s.stage != 0) break;
    if (s.strain >= strain && s.strain > before->strain) {
      const double u = (strain - before->strain) / (s.strain - before->strain);
      return (1 - u) * value(*before) + u * value(s);
    }
    before = &s;
  }
  return value(*before);
}

void report_errors(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Errors, on a sample of 40 rings");
  report.text(
      "The same 40 rings, compacted with half the speed, with 20 and 40 nodes a ring (deposited anew: frictionless "
      "packings of other polygons also "
      "settle otherwise), and with stiffer cores. Stresses over \u03c3* at equal strains.");
  const auto one = [&](const std::string& name, const Sample& sample, std::vector<std::string> settings, double speed) {
    return compacted(bench, name, sample, {name, name, std::move(settings), speed});
  };
  const auto row = [&](const std::string& what, const Compaction& c, const std::vector<double>& strains) {
    std::vector<std::string> cells{what, fmt::format("{:.4f}", c.states.front().packing.void_ratio)};
    for (double strain : strains) {
      const bool reached = c.end_of(0).strain >= strain;
      cells.push_back(reached ? fmt::format("{:.4g}", value_at_strain(c, strain, stress_of)) : "");
      cells.push_back(reached ? fmt::format("{:.4f}", value_at_strain(c, strain, voids_of)) : "");
    }
    cells.push_back(fmt::format("{:.4f}", c.share(c.end_of(0))));
    return cells;
  };
  const Sample coarse = deposited(bench, "40_coarse", 40, 20, 12), fine = deposited(bench, "40_fine", 40, 40, 12);
  ReportTable elastic{{"\u03b7 = 0", "e at H0", "stress at 0.1", "e", "stress at 0.2", "e", "dV_s / dV at the end"},
                      {}};
  const Compaction slow = one("slow", coarse, {}, 0.005), medium = one("medium", coarse, {}, 0.01);
  elastic.rows.push_back(row("20 nodes, speed 0.01", medium, {0.1, 0.2}));
  elastic.rows.push_back(row("20 nodes, speed 0.005", slow, {0.1, 0.2}));
  const Compaction many = one("fine", fine, {}, 0.01);
  elastic.rows.push_back(row("40 nodes, speed 0.01", many, {0.1, 0.2}));
  report.table(std::move(elastic));
  report.at_most("half the speed changes the stress at strain 0.2 by",
                 std::abs(value_at_strain(medium, 0.2, stress_of) / value_at_strain(slow, 0.2, stress_of) - 1), 0.1);
  ReportTable stiff{
      {"20 nodes, speed 0.01", "e at H0", "stress at 0.08", "e", "stress at 0.12", "e", "dV_s / dV at the end"}, {}};
  std::vector<Compaction> cores;
  for (const char* eta : {"100", "1000", "10000"}) {
    cores.push_back(one(fmt::format("eta_{}", eta), coarse,
                        {fmt::format("cells.core.stiffness_ratio={}", eta), "contact.normal_stiffness=30000"}, 0.01));
    stiff.rows.push_back(row(fmt::format("\u03b7 = {}", eta), cores.back(), {0.08, 0.12}));
  }
  report.table(std::move(stiff));
  const double at = std::min(cores[1].end_of(0).strain, cores[2].end_of(0).strain);
  report.at_most(fmt::format("\u03b7 = 1000 instead of 10000 changes the stress at strain {:.3f} by", at),
                 std::abs(value_at_strain(cores[1], at, stress_of) / value_at_strain(cores[2], at, stress_of) - 1),
                 0.1);
}

}  // namespace

void study_compaction(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Deposition");
  const Sample sample = bench.small() ? deposited(bench, "24", 24, 16, 9) : deposited(bench, "500", 500, 24, 60);
  const Box room = *room_between_walls(sample, sample.x);
  report.text(fmt::format("{} rings, at the lid's first touch: height {:.4f}, width {:.4f}, void ratio {:.4f}.",
                          sample.cells() - 4, room.size().y(), room.size().x(), void_ratio(sample, sample.x, room)));
  report.section("Compaction of one sample with four sets of parameters");
  std::vector<Compaction> all;
  for (Set set : kSets) {
    if (bench.small() && set.name == "stiff_core") {  // a third of the steps
      set.label = "\u03b7 = 100";
      set.settings.front() = "cells.core.stiffness_ratio=100";
    }
    all.push_back(compacted(bench, set.name, sample, set));
  }
  report_outcomes(report, all);
  report_inertia(report, all);
  for (const Compaction& c : all) check_run(report, c);
  check_voids(report, all[0], bench.small() ? 20000 : 100000);
  check_voids(report, all[2], bench.small() ? 20000 : 100000);
  compare_sets(report, all);
  report_kinematics(report, all);
  draw(report, all);
  if (!bench.small()) report_errors(bench);
}

}  // namespace lamella
