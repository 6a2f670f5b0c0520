// Coulomb friction as springs with a limit: what sticks comes back, what slides stops where energy says, no vertex is felt, and nothing
// turns by itself.
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "generator/sample/selection.h"
#include "pipelines/studies/study.h"
#include "simulator/model.h"

namespace lamella {
namespace {

// of the scenes with a block
constexpr double kWeight = 45, kLimit = 0.3 * kWeight;  // mu N [N]
constexpr double kNormal = 9 * 1e4;                     // nine nodes on the plate [N/m]

std::vector<Index> nodes_of(const Sample& sample, const std::string& group) {
  Selection selection;
  selection.group = group;
  return select_nodes(sample, selection);
}

Vec2 mean_of(const std::vector<Vec2>& x, const std::vector<Index>& nodes) {
  Vec2 sum = Vec2::Zero();
  for (Index i : nodes) sum += x[i];
  return sum / static_cast<double>(nodes.size());
}

/// A column of the response in one stage.
std::vector<double> column_of(const StudyRun& run, const std::string& name, int stage) {
  const auto stages = run.column("stage"), all = run.column(name);
  std::vector<double> out;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (stages[k] == stage) out.push_back(all[k]);
  return out;
}

/// Where a body is in x at every frame of a stage.
std::vector<double> course(const StudyRun& run, const std::vector<Index>& nodes, int stage) {
  std::vector<double> out;
  for (int f = 0; f < run.reader.frames(); ++f)
    if (run.reader.frame(f).stage == stage) out.push_back(mean_of(run.positions(f), nodes).x());
  return out;
}

void pull_and_release(StudyBench& bench, const std::string& name, const std::string& plate,
                      const std::vector<std::string>& settings, Chart& chart) {
  StudyReport& report = bench.report;
  const StudyRun run = bench.run(name, "stick.toml", settings);
  // The plate's own nodes come under the block, or leave it, during the pull: their springs begin without stretch.
  const bool vertices = name == "stick_vertices";
  if (vertices)
    report.text(
        "A node of the plate that comes under the block, or leaves it, during the pull begins or ends with a spring of "
        "its own: the sum of "
        "k_t is not quite that of the nine nodes, and 0.2 % of the way is left after release.");
  // The springs hold the nodes on the plate; the block above them tilts a little.
  std::vector<Index> standing;
  for (Index i : nodes_of(run.reader.sample(), "block"))
    if (run.reader.sample().x[i].y() < 0.2) standing.push_back(i);
  const double start = course(run, standing, 0).back(), stretch = kLimit / (0.5 * kNormal);
  const auto friction = [&](int stage) {
    auto force = column_of(run, "force_x_plate", stage);
    for (double& f : force) f /= -kLimit;
    return force;
  };
  const auto way = [&](int stage) {
    auto x = course(run, standing, stage);
    for (double& w : x) w = (w - start) / stretch;
    return x;
  };
  report.compare(plate + ", pulled with 0.9 mu N: friction over the pull", friction(1).back() / 0.9, 1,
                 vertices ? 1e-4 : 1e-6);
  report.compare(plate + ", pulled with 0.9 mu N: way over F / sum of k_t", way(1).back() / 0.9, 1,
                 vertices ? 0.02 : 1e-3);
  report.at_most(plate + ", released: what is left of that way", std::abs(way(2).back()) / 0.9, vertices ? 5e-3 : 1e-6);
  report.compare(plate + ", pulled with 1.1 mu N: friction over mu N", friction(3).back(), 1, vertices ? 2e-3 : 1e-6);
  const char* labels[] = {"", "pulled with 0.9 mu N", "released", "pulled with 1.1 mu N"};
  for (const int stage : {3, 1, 2}) {
    const auto x = way(stage);
    const auto rows = friction(stage);
    std::vector<double> y;  // rows are ten to a frame; the last frame and row come one step after those before
    for (std::size_t f = 0; f < x.size(); ++f) y.push_back(rows[std::min(10 * f, rows.size() - 1)]);
    chart.curves.push_back(stage == 2 ? dotted_curve(stage, labels[stage], x, y)
                                      : line_curve(stage, labels[stage], x, y));
  }
}

void stick(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("A block on a plate sticks below mu N");
  report.text(
      "Nine nodes stand on the plate, each with a spring of stiffness k_t. The block is pulled with 0.9 mu N, "
      "released, "
      "and pulled with 1.1 mu N, while drag\nkeeps it slow. On the plate of many segments all nine nodes pass a vertex "
      "of "
      "the plate, half-way through the pull.");
  Chart chart{.title = "Pulled, released, pulled anew",
              .x_label = "way over mu N / sum of k_t",
              .y_label = "friction over mu N"};
  pull_and_release(bench, "stick", "plate of one segment", {}, chart);
  report.chart("stick", "Friction on the block against its way: up and back on one line, then over the limit.", chart);
  Chart vertices = chart;
  vertices.curves.clear();
  // 0.000135: half of the way that 0.9 mu N stretches the springs
  pull_and_release(
      bench, "stick_vertices", "plate of many segments",
      {"sample.shapes.1.segments=32", "sample.shapes.1.from=[-2.999865, 0]", "sample.shapes.1.to=[5.000135, 0]"},
      vertices);
}

/// The largest of a run of frames, by a parabola through the three highest.
double farthest(const std::vector<double>& x) {
  std::size_t k = 1;
  for (std::size_t f = 1; f + 1 < x.size(); ++f)
    if (x[f] > x[k]) k = f;
  const double slope = 0.5 * (x[k + 1] - x[k - 1]), bend = x[k + 1] - 2 * x[k] + x[k - 1];
  return x[k] - 0.5 * slope * slope / bend;
}

void stop(StudyBench& bench) {
  StudyReport& report = bench.report;
  const double exact = 2.0 * 2 / (2 * 0.3 * 10);  // v^2 / 2 mu g [m]
  report.section("A block with the velocity v stops after v^2 / (2 mu g)");
  report.text(
      "Friction grows from 0 to mu N only while the springs stretch, by d = mu N / sum of k_t: the block gets farther "
      "by "
      "d / 2. This is all that is wrong, and it\nfalls as 1 / k_t.");
  std::vector<double> ratios, errors, closed;
  for (const double ratio :
       bench.small() ? std::vector<double>{0.1, 0.5} : std::vector<double>{0.05, 0.1, 0.2, 0.5, 1}) {
    const StudyRun run =
        bench.run(fmt::format("stop_{:g}", ratio), "stop.toml", {fmt::format("contact.tangential_ratio={:g}", ratio)});
    const auto block = nodes_of(run.reader.sample(), "block");
    const double found = (farthest(course(run, block, 1)) - course(run, block, 0).back()) / exact;
    const double late = 0.5 * kLimit / (ratio * kNormal) / exact;
    report.compare(fmt::format("k_t = {:g} k_n: way over v^2 / 2 mu g, beside 1 + d mu g / v^2", ratio), found,
                   1 + late, 1e-5);
    if (ratio == 0.5) {
      report.compare("k_t = 0.5 k_n: way over v^2 / 2 mu g", found, 1, 1e-3);
      report.at_most("k_t = 0.5 k_n: residual of the energy ledger", run.ledger(), 1e-6);
    }
    ratios.push_back(ratio), errors.push_back(found - 1), closed.push_back(late);
  }
  report.compare_absolute("observed order of the error in 1 / k_t", observed_order(ratios, errors).order, 1, 0.01);
  Chart chart{.title = "How far the block slides", .x_label = "k_t / k_n", .y_label = "way over v^2 / 2 mu g, less 1"};
  chart.x_scale = chart.y_scale = Scale::kLogarithmic;
  chart.curves.push_back(line_curve(0, "d mu g / v^2", ratios, closed));
  chart.curves.push_back(dotted_curve(0, "found", ratios, errors));
  report.chart("stop", "Error of the way against the stiffness of the friction springs.", chart);
}

/// Largest change of a curve from one row to the one `stride` on.
double largest_change(const std::vector<double>& force, std::size_t stride) {
  double change = 0;
  for (std::size_t k = stride; k < force.size(); ++k) change = std::max(change, std::abs(force[k] - force[k - stride]));
  return change;
}

/// A curve without jumps changes half as much in half the time; what is left over as the time goes to 0 is a jump.
void look_for_jumps(StudyReport& report, const std::string& what, const std::vector<double>& force) {
  const double one = largest_change(force, 1), two = largest_change(force, 2);
  report.at_most(what + ": largest change between rows", one, 2e-2);
  report.at_most(what + ": of that a jump", std::abs(2 * one - two), 1e-4);
}

void slide(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("No jump of force over vertices and segments");
  report.text(
      "A block is drawn over a plate of 80 segments, a stiff ring over hills and valleys of 4.6 degrees, each at "
      "constant speed; the "
      "force that this takes, over mu N.\nThe largest change between two rows halves when rows are twice as close; "
      "what does not is a jump. Where "
      "the plate's vertices pass the block's edges, their normals\nturn, and the pull swings by 2 %.");
  const StudyRun block = bench.run("slide", "slide.toml");
  std::vector<double> time, pull;
  const auto all = column_of(block, "force_x_draw", 1), times = column_of(block, "time", 1);
  for (std::size_t k = all.size() / 8; k < all.size(); ++k)  // without the start, where the springs stretch
    time.push_back(times[k] - times[0]), pull.push_back(all[k] / kLimit);
  look_for_jumps(report, "block on a plate", pull);
  double mean = 0;
  for (double p : pull) mean += p / static_cast<double>(pull.size());
  report.compare("block on a plate: mean pull over mu N", mean, 1, 2e-3);

  const StudyRun ring = bench.run("hills", "hills.toml");
  auto force = ring.column("force_x_ring");
  const auto normal = ring.column("force_y_ring");
  double weight = 0;
  for (double n : normal) weight -= n / static_cast<double>(normal.size());
  for (double& f : force) f /= 0.3 * weight;
  look_for_jumps(report, "ring on hills", force);
  Chart chart{.title = "Drawn over vertices", .x_label = "way / length of a segment", .y_label = "pull over mu N"};
  std::vector<double> segments, hills;
  for (double t : time) segments.push_back(t / 0.1);
  for (double t : ring.column("time")) hills.push_back(t / 0.25);
  chart.curves.push_back(line_curve(1, "ring on hills (N: its mean)", hills, force));
  chart.curves.push_back(line_curve(0, "block on a plate", segments, pull));
  report.chart("slide", "The pull at constant speed, over the way in segments of the ground.", chart);
}

/// Momentum and angular momentum about the origin, of a group of nodes, half a step before the frame.
struct Motion {
  Vec2 momentum = Vec2::Zero();
  double angular = 0;
  double sum = 0, sum_angular = 0;  // of magnitudes
};

Motion motion_of(const StudyRun& run, const Model& model, const std::vector<Index>& nodes, int frame) {
  const auto x = run.positions(frame);
  const auto v = run.array("v", frame);
  Motion out;
  for (Index i : nodes) {
    const Vec2 p = model.mass[i] * Vec2(v[2 * i], v[2 * i + 1]);
    out.momentum += p, out.angular += cross(x[i], p);
    out.sum += p.norm(), out.sum_angular += x[i].norm() * p.norm();
  }
  return out;
}

/// Couple of the friction about the centre lines: f_t times the distance of node and foot, over all contacts of a frame.
double couple_of_friction(const StudyRun& run, int frame) {
  const auto force = run.array("contact_force", frame);
  double sum = 0;
  for (std::size_t k = 0; k + 1 < force.size(); k += 2) sum += force[k + 1] * 0.1;  // two radii of 0.05
  return sum;
}

void rub(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Two rings that rub");
  report.text(
      "A spinning ring hits another one off its centre. Friction acts where the outlines meet, off the centre lines by "
      "the radius r of the walls: mass points carry no "
      "moment,\nso its couple f_t (r_i + r_j) goes to the two nodes of the segment that is touched. Left out, it would "
      "be gained or lost as angular momentum; how much, is "
      "shown.");
  const StudyRun run = bench.run("rings", "rings.toml");
  const Scene scene = bench.scene("rings.toml");
  const Sample& sample = run.reader.sample();
  Field x(sample.nodes());
  for (Index i = 0; i < sample.nodes(); ++i) x.set(i, sample.x[i]);
  const auto model = build_model(sample, scene.stages[0], x);
  const std::vector<Index> bodies[] = {nodes_of(sample, "striker"), nodes_of(sample, "target")};
  std::vector<double> time, part[2], lost;
  Motion first;
  double drift = 0, turn = 0, left_out = 0, before = 0;
  for (int f = 0; f < run.reader.frames(); ++f) {
    Motion both;
    time.push_back(run.reader.frame(f).time);
    for (int b : {0, 1}) {
      const Motion one = motion_of(run, *model, bodies[b], f);
      part[b].push_back(one.angular);
      both.momentum += one.momentum, both.angular += one.angular;
      both.sum += one.sum, both.sum_angular += one.sum_angular;
    }
    const double couple = couple_of_friction(run, f);
    if (f > 0) left_out += 0.5 * (couple + before) * (time[f] - time[f - 1]);
    before = couple;
    lost.push_back(left_out);
    if (f == 0) first = both;
    drift = std::max(drift, (both.momentum - first.momentum).norm() / first.sum);
    turn = std::max(turn, std::abs(both.angular - first.angular) / first.sum_angular);
  }
  report.at_most("drift of the momentum, over the sum of |m v|", drift, 1e-12);
  report.at_most("drift of the angular momentum, over the sum of |x| |m v|", turn, 1e-12);
  report.at_least("angular momentum that the second ring got, over that of the first",
                  std::abs(part[1].back() - part[1][0]) / std::abs(first.angular), 0.005);
  report.at_least("couples f_t (r_i + r_j) over that", std::abs(left_out) / std::abs(part[1].back() - part[1][0]), 0.0);
  report.at_least("share of the kinetic energy that friction took", run.last("friction") / run.column("kinetic")[0],
                  0.01);
  report.at_most("residual of the energy ledger", run.ledger(), 1e-4);
  Chart chart{.title = "Two rings that rub", .x_label = "time", .y_label = "angular momentum about the origin"};
  chart.curves.push_back(line_curve(0, "first ring", time, part[0]));
  chart.curves.push_back(line_curve(1, "second ring", time, part[1]));
  std::vector<double> sum;
  for (std::size_t k = 0; k < time.size(); ++k) sum.push_back(part[0][k] + part[1][k]);
  chart.curves.push_back(line_curve(4, "both", time, sum));
  chart.curves.push_back(line_curve(2, "what the couples amount to", time, lost));
  report.chart("rings", "Angular momentum of the two rings.", chart);
}

}  // namespace

void study_friction(StudyBench& bench) {
  stick(bench);
  stop(bench);
  slide(bench);
  rub(bench);
}

}  // namespace lamella
