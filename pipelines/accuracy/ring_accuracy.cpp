// The elastic and the plastic ring: error of the plates' force against every knob.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "pipelines/accuracy/answer.h"
#include "pipelines/accuracy/measured.h"

namespace lamella {
namespace {

constexpr double kStrains[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
// Force times R^2 / EI at those strains: extensible elastica of S = 4800, and static equilibrium of N mass points (physics 2b).
constexpr double kExact[] = {1.173541, 2.114380, 2.928696, 3.985800, 5.738405, 8.962960};
struct Discrete {
  int nodes;
  double force[6];
};
constexpr Discrete kDiscrete[] = {{20, {1.10978, 2.00900, 2.78479, 3.87283, 5.58672, 7.76718}},
                                  {40, {1.15684, 2.08688, 2.90862, 3.96586, 5.61588, 8.85644}},
                                  {80, {1.16932, 2.10743, 2.92627, 3.97809, 5.70336, 8.91452}},
                                  {160, {1.17248, 2.11264, 2.92653, 3.98466, 5.73179, 8.95511}},
                                  {320, {1.17328, 2.11394, 2.92817, 3.98498, 5.73737, 8.96132}}};

/// All that a user can turn.
struct Knobs {
  int nodes = 80;
  double rate = 0.005;  // strain in the unit of time
  double drag = 2;
  double hinge_dashpot = 0;
  double fraction = 0.8;
  double stiffness = 4800;  // S = EA R^2 / EI
  double contact = 10;      // k_n l^2 / k_b

  std::vector<std::string> settings() const {
    const double l = 2 * std::sin(std::numbers::pi / nodes);
    return {fmt::format("sample.shapes.0.segments={}", nodes),
            fmt::format("run.slowdown={:.9g}", 0.01 / rate),
            fmt::format("drag.rate={:.9g}", drag),
            fmt::format("cells.hinge_dashpot={:.9g}", hinge_dashpot),
            fmt::format("run.step_fraction={:.9g}", fraction),
            fmt::format("cells.axial_rigidity={:.9g}", stiffness),
            fmt::format("contact.normal_stiffness={:.9g}", contact / std::pow(l, 4))};
  }
  std::string name() const {
    return fmt::format("ring_{}_{:g}_{:g}_{:g}_{:g}_{:g}_{:g}", nodes, rate, drag, hinge_dashpot, fraction, stiffness,
                       contact);
  }
};

/// Linear between points.
double between(const std::vector<double>& x, const std::vector<double>& y, double place) {
  std::size_t k = 1;
  while (k + 1 < x.size() && x[k] < place) ++k;
  return y[k - 1] + (place - x[k - 1]) / (x[k] - x[k - 1]) * (y[k] - y[k - 1]);
}

/// Force of the lid at the six strains of the ring itself, from the extent of its nodes (not the plates' gap: contact gives way). The
/// extent is smooth in time, and read between frames; the force is not, and read between rows.
Answer forces_at_strains(const StudyRun& run, int nodes) {
  std::vector<double> strain, time;
  for (int f = 0; f < run.reader.frames(); ++f) {
    const auto x = run.positions(f);
    double low = x[0].y(), high = low;
    for (int k = 0; k < nodes; ++k) low = std::min(low, x[k].y()), high = std::max(high, x[k].y());
    strain.push_back(1 - (high - low) / 2), time.push_back(run.reader.frame(f).time);
  }
  const auto force = run.column("force_y_lid"), rows = run.column("time");
  Answer answer{"force", "", {kStrains, kStrains + 6}, {}};
  for (double place : kStrains) answer.load.push_back(-between(rows, force, between(strain, time, place)));
  return answer;
}

double error_against(const Answer& found, const double (&exact)[6]) {
  double square = 0;
  for (int k = 0; k < 6; ++k) square += std::pow(found.load[k] / exact[k] - 1, 2) / 6;
  return std::sqrt(square);
}

const double (&discrete_of(int nodes))[6] {
  return std::find_if(std::begin(kDiscrete), std::end(kDiscrete), [&](const Discrete& d) { return d.nodes == nodes; })
      ->force;
}

/// Runs each set of knobs once, and remembers what came out.
class RingRuns {
 public:
  explicit RingRuns(StudyBench& bench) : bench_(bench) {}

  /// The elastica, or the N mass points at rest.
  enum class Against { kElastica, kPoints };
  Measured run(const Knobs& knobs, Against against, const std::string& setting, const std::string& group, double knob) {
    const Known& known = at(knobs);
    Measured m = known.cost;
    m.setting = setting, m.group = group, m.knob = knob;
    m.error = error_against(known.answer, against == Against::kElastica ? kExact : discrete_of(knobs.nodes));
    return m;
  }
  /// Forces at the six strains.
  const Answer& answer(const Knobs& knobs) { return at(knobs).answer; }

 private:
  struct Known {
    Measured cost;
    Answer answer;
  };
  const Known& at(const Knobs& knobs) {
    const auto found = known_.find(knobs.name());
    if (found != known_.end()) return found->second;
    const StudyRun done = bench_.run(knobs.name(), "ring.toml", knobs.settings());
    return known_.emplace(knobs.name(), Known{measured(done, "", "", 0, 0), forces_at_strains(done, knobs.nodes)})
        .first->second;
  }

  StudyBench& bench_;
  std::map<std::string, Known> known_;
};

struct Damping {
  const char* name;
  double drag, dashpot;
};

}  // namespace

void accuracy_of_ring(StudyBench& bench, std::vector<EstimatedError>& estimates) {
  StudyReport& report = bench.report;
  RingRuns runs(bench);
  using Against = RingRuns::Against;
  report.section("The elastic ring between plates");
  report.text(
      "Error: root mean square over strains 0.1 to 0.6 of the relative error of the plates' force. Rate: strain in the "
      "unit of time\n"
      "sqrt(m R^4 / EI), m the mass per length; the slowest swing of the ring lasts 2.34 of it. Drag in its inverse, "
      "hinge dashpot in EI times it.\n"
      "Against the N mass points at rest, only pace, damping and step are judged; against the elastica, all.");

  const bool small = bench.small();
  Knobs base;
  if (small) base.nodes = 40, base.rate = 0.01;
  std::vector<Measured> sweep;
  for (double fraction : small ? std::vector<double>{0.25, 0.8} : std::vector<double>{0.1, 0.25, 0.5, 0.8, 0.95}) {
    Knobs k = base;
    k.fraction = fraction;
    sweep.push_back(runs.run(k, Against::kPoints, fmt::format("{:g} of the stable step", fraction), "", fraction));
  }
  report.text("**Time step.** It has no influence on the force; only the energy ledger feels it.");
  sweep_table(report, sweep);
  report.at_most("ratio of the errors at the largest and the smallest step, less 1",
                 std::abs(sweep.back().error / sweep.front().error - 1), 0.02);

  report.text(fmt::format("**Pace and damping**, N = {}, against the mass points at rest.", base.nodes));
  const std::vector<Damping> dampings = small ? std::vector<Damping>{{"drag 2", 2, 0}}
                                              : std::vector<Damping>{{"no damping", 0, 0},
                                                                     {"drag 0.5", 0.5, 0},
                                                                     {"drag 2", 2, 0},
                                                                     {"drag 5.4", 5.4, 0},
                                                                     {"hinge dashpot 0.05", 0, 0.05}};
  const std::vector<double> rates =
      small ? std::vector<double>{0.04, 0.02} : std::vector<double>{0.04, 0.02, 0.01, 0.005, 0.0025};
  std::vector<Measured> paces;
  for (const Damping& damping : dampings) {
    std::vector<Measured> one;
    for (double rate : rates) {
      Knobs k = base;
      k.rate = rate, k.drag = damping.drag, k.hinge_dashpot = damping.dashpot;
      one.push_back(
          runs.run(k, Against::kPoints, fmt::format("{}, rate {:g}", damping.name, rate), damping.name, rate));
    }
    paces.insert(paces.end(), one.begin(), one.end());
    if (damping.drag >= 2)
      report.text(fmt::format("Observed order in the pace with {}: {}.", damping.name, order_text(one)));
  }
  sweep_table(report, paces);
  work_precision(report, "ring_pace", fmt::format("Ring, N = {}, against N points at rest", base.nodes), paces);

  if (!small) {
    report.text("**Resolution**, rate 0.0025, drag 0.5, against the elastica.");
    sweep.clear();
    for (int nodes : {20, 40, 80, 160, 320}) {
      Knobs k = base;
      k.nodes = nodes, k.rate = 0.0025, k.drag = 0.5;
      sweep.push_back(runs.run(k, Against::kElastica, fmt::format("N = {}", nodes), "", 1.0 / nodes));
    }
    sweep_table(report, sweep);
    report.text(
        fmt::format("Observed order in N: {} (after the onset of flattening the error swings with the place of the "
                    "contact's edge).",
                    order_text({sweep.begin(), sweep.end() - 1})));

    report.text(
        "**Stiffness of the walls** S = EA R^2 / EI (a stand-in for inextensible ones) **and of the contact**, rate "
        "0.005, drag 0.5, against the elastica of S = 4800.");
    sweep.clear();
    for (double s : {300.0, 1200.0, 4800.0}) {
      Knobs k = base;
      k.stiffness = s, k.drag = 0.5;
      sweep.push_back(runs.run(k, Against::kElastica, fmt::format("S = {:g}", s), "", s));
    }
    for (double contact : {0.1, 1.0, 10.0, 100.0}) {
      Knobs k = base;
      k.contact = contact, k.drag = 0.5;
      sweep.push_back(runs.run(k, Against::kElastica, fmt::format("k_n l^2 / k_b = {:g}", contact), "", contact));
    }
    sweep_table(report, sweep);
  }

  report.text("**What to choose**, against the elastica, over all resolutions, paces and dampings:");
  std::vector<Measured> all;
  const std::vector<int> resolutions = small ? std::vector<int>{20, 40} : std::vector<int>{20, 40, 80, 160};
  const std::vector<Damping> tried =
      small ? std::vector<Damping>{{"drag 0.5", 0.5, 0}}
            : std::vector<Damping>{{"drag 0.5", 0.5, 0}, {"drag 2", 2, 0}, {"hinge dashpot 0.05", 0, 0.05}};
  for (const Damping& damping : tried)
    for (int nodes : resolutions)
      for (double rate : small ? std::vector<double>{0.01} : std::vector<double>{0.04, 0.02, 0.01, 0.005, 0.0025}) {
        if (damping.dashpot > 0 && nodes > 80) continue;  // its step falls with l^3: a hundred times the price of drag
        Knobs k = base;
        k.nodes = nodes, k.rate = rate, k.drag = damping.drag, k.hinge_dashpot = damping.dashpot;
        all.push_back(runs.run(k, Against::kElastica, fmt::format("N = {}, rate {:g}, {}", nodes, rate, damping.name),
                               fmt::format("{}, N = {}", damping.name, nodes), rate));
      }
  if (!small) {
    Knobs k = base;
    k.nodes = 320, k.rate = 0.00125, k.drag = 0.5;
    all.push_back(runs.run(k, Against::kElastica, "N = 320, rate 0.00125, drag 0.5", "drag 0.5, N = 320", k.rate));
  }
  std::vector<Measured> shown;
  for (const Measured& m : all)
    if (m.group.starts_with("drag 0.5")) shown.push_back(m);
  work_precision(report, "ring", "Ring, drag 0.5, against the elastica", shown);
  recommend(report, "ring's force", all);

  // The estimate of two paces, as `lamella run --accuracy` makes it.
  for (int nodes : small ? std::vector<int>{40} : std::vector<int>{40, 80, 160})
    for (double rate : small ? std::vector<double>{0.02} : std::vector<double>{0.02, 0.01, 0.005, 0.0025}) {
      Knobs k = base;
      k.nodes = nodes, k.rate = 2 * rate;
      const Answer fast = runs.answer(k);
      k.rate = rate;
      const Answer slow = runs.answer(k);
      Answer exact = slow;
      exact.load.assign(std::begin(discrete_of(nodes)), std::end(discrete_of(nodes)));
      estimates.push_back({fmt::format("ring, N = {}, rate {:g}", nodes, rate), error_of_slower(slow, fast, 2).larger(),
                           distance(slow, exact, slow.progress).larger()});
    }
}

void accuracy_of_plastic_ring(StudyBench& bench) {
  StudyReport& report = bench.report;
  const bool small = bench.small();
  report.section("The plastic ring between plates");
  report.text(
      "Walls that yield at M_Y = 5e-5 EI / R: the force is 4 M_Y / (R sqrt(1 - eps^2)) (deRuntz and Hodge) for a "
      "rigid, perfectly plastic ring. It\n"
      "saw-tooths, because the contact jumps from node to node; error: root mean square over windows of 0.1 of strain, "
      "centred at 0.15 to 0.55, of the relative error of the\n"
      "mean force in the window. Rate: strain in the unit of time.");
  struct Plastic {
    int nodes;
    double rate, drag, fraction;
    double stiffness = 50, yield = 5e-5;
  };
  const auto exact_in = [](double low, double high) { return 4 * (std::asin(high) - std::asin(low)) / (high - low); };
  Answer last;
  const auto run = [&](const Plastic& p, const std::string& setting, const std::string& group, double knob) {
    const double l = 2 * std::sin(std::numbers::pi / p.nodes);
    const StudyRun done = bench.run(
        fmt::format("plastic_{}_{:g}_{:g}_{:g}_{:g}_{:g}", p.nodes, p.rate, p.drag, p.fraction, p.stiffness, p.yield),
        "plastic_ring.toml",
        {fmt::format("sample.shapes.0.segments={}", p.nodes), fmt::format("run.slowdown={:.9g}", 1e-4 / p.rate),
         fmt::format("drag.rate={:.9g}", p.drag), fmt::format("run.step_fraction={:.9g}", p.fraction),
         fmt::format("cells.axial_rigidity={:.9g}", p.stiffness), fmt::format("cells.yield_moment={:.9g}", p.yield),
         fmt::format("contact.normal_stiffness={:.9g}", 1 / std::pow(l, 2))});
    // Strain from the plates: contact gives way by less than 1e-4 of R at these forces. Rows are denser than frames.
    const auto force = done.column("force_y_lid"), time = done.column("time");
    double square = 0;
    last = {"force", "", {}, {}};
    for (int w = 0; w < 5; ++w) {
      const double low = 0.1 + 0.1 * w, high = low + 0.1;
      double sum = 0;
      int count = 0;
      for (std::size_t k = 0; k < time.size(); ++k)
        if (const double strain = time[k] * p.rate; strain >= low && strain < high) sum += std::abs(force[k]), ++count;
      const double mean = sum / count / p.yield;
      last.progress.push_back(0.5 * (low + high)), last.load.push_back(mean);
      square += std::pow(mean / exact_in(low, high) - 1, 2) / 5;
    }
    return measured(done, setting, group, knob, std::sqrt(square));
  };

  std::vector<Measured> all, sweep;
  const std::vector<int> resolutions = small ? std::vector<int>{20} : std::vector<int>{20, 40, 80};
  const std::vector<double> rates =
      small ? std::vector<double>{4e-4} : std::vector<double>{8e-4, 4e-4, 2e-4, 1e-4, 5e-5};
  for (int nodes : resolutions)
    for (double rate : rates)
      all.push_back(run({nodes, rate, 0.05, 0.8}, fmt::format("N = {}, rate {:g}, drag 0.05", nodes, rate),
                        fmt::format("N = {}, drag 0.05", nodes), rate));
  if (!small)
    for (double drag : {0.0, 0.01, 0.2})
      for (double rate : {4e-4, 1e-4})
        sweep.push_back(run({40, rate, drag, 0.8}, fmt::format("N = 40, rate {:g}, drag {:g}", rate, drag),
                            "N = 40, other drag", rate));
  if (!small)
    for (double fraction : {0.2, 0.5})
      sweep.push_back(run({40, 4e-4, 0.05, fraction},
                          fmt::format("N = 40, rate 0.0004, drag 0.05, step {:g}", fraction), "N = 40, other step",
                          fraction));
  if (!small)
    for (double s : {200.0, 800.0})
      sweep.push_back(run({40, 4e-4, 0.05, 0.8, s}, fmt::format("N = 40, rate 0.0004, drag 0.05, S = {:g}", s),
                          "N = 40, other S", s));
  all.insert(all.end(), sweep.begin(), sweep.end());
  sweep_table(report, all);
  work_precision(report, "plastic_ring", "Plastic ring", all);
  recommend(report, "plastic ring's force", all);
}

}  // namespace lamella
