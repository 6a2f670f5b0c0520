// Slow fracture: the stepper at rest beside the explicit one at falling rates, on an ensemble of small tissues.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>
#include <optional>

#include "generator/sample/errors.h"
#include "pipelines/accuracy/fracture_answer.h"
#include "pipelines/accuracy/measured.h"

namespace lamella {
namespace {

/// Of this process: the machine may have other work, and then seconds on the clock say nothing.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

constexpr double kRate = 2500;  // of the scene, at slowdown 1 [Hz]

struct Method {
  std::string name, key;  // for people, and for names of runs
  std::string group;      // curve of the chart
  double slowdown = 0;    // 0: at rest
  std::vector<std::string> settings;
  std::size_t samples = 0;  // of the ensemble that it is tried on
};

struct Try {
  std::optional<FractureAnswer> answer;  // nothing where the numerics gave up
  double seconds = 0;
  RunFacts facts;
};

/// Means over the samples that have an answer. Errors are relative to the reference.
struct Judged {
  Method method;
  double peak = 0, signed_peak = 0, strain_at_peak = 0, work = 0, signed_work = 0;
  double first_strain = 0;
  double same_first = 0;        // share of samples in which the same link breaks first
  double links = 0, walls = 0;  // overlaps
  double seconds = 0;           // of a sample
  std::size_t answers = 0;
};

/// The same tissues, pulled apart by one method after the other.
class Ensemble {
 public:
  Ensemble(StudyBench& bench, int cells, std::size_t samples) : bench_(bench), cells_(cells) {
    for (std::size_t k = 0; k < samples; ++k)
      samples_.push_back(sample_of(bench.scene("slow_fracture.toml", of_sample(k))));
  }

  /// The first one to be tried is the reference of all others.
  Judged judge(const Method& method) {
    std::vector<Try> tries;
    const std::size_t count = std::min(method.samples, samples_.size());
    for (std::size_t k = 0; k < count; ++k) tries.push_back(attempt(method, k));
    if (reference_.empty()) {
      for (const Try& t : tries) {
        if (!t.answer) throw SolverError("slow fracture: the reference at rest gave up");
        reference_.push_back(*t.answer);
      }
    }
    Judged judged{.method = method};
    for (const Try& t : tries) judged.answers += t.answer.has_value();
    const double share = 1 / static_cast<double>(std::max<std::size_t>(1, judged.answers));
    for (std::size_t k = 0; k < count; ++k) {
      judged.seconds += tries[k].seconds / static_cast<double>(count);
      if (!tries[k].answer) continue;
      const FractureAnswer& found = *tries[k].answer;
      const FractureAnswer& exact = reference_[k];
      const double off = found.peak_stress / exact.peak_stress - 1, work = found.work / exact.work - 1;
      judged.peak += share * std::abs(off), judged.signed_peak += share * off;
      judged.work += share * std::abs(work), judged.signed_work += share * work;
      judged.strain_at_peak += share * std::abs(found.strain_at_peak / exact.strain_at_peak - 1);
      judged.first_strain += share * std::abs(found.first_break_strain / exact.first_break_strain - 1);
      judged.same_first += share * (found.first_link == exact.first_link);
      judged.links += share * overlap(found.links, exact.links);
      judged.walls += share * overlap(found.walls, exact.walls);
    }
    if (judged.answers == 0) judged.peak = std::nan("");
    bench_.say(fmt::format("slow fracture, {} cells, {}: {} of {} samples, {:.1f} s of CPU", cells_, method.name,
                           judged.answers, count, judged.seconds * static_cast<double>(count)));
    return judged;
  }

  /// One sample by one method.
  Try attempt(const Method& method, std::size_t k) {
    std::vector<std::string> settings = of_sample(k);
    settings.insert(settings.end(), method.settings.begin(), method.settings.end());
    const Scene scene = bench_.scene("slow_fracture.toml", settings);
    const double start = cpu_seconds();
    const StudyRun run = bench_.attempt(fmt::format("slow_{}_{}_{}", cells_, method.key, k + 1), samples_[k], scene);
    Try tried{{}, cpu_seconds() - start, run.facts};
    if (run.error.empty()) tried.answer = fracture_answer_of(run);
    return tried;
  }

  const Sample& sample(std::size_t k) const { return samples_[k]; }
  double slowest_swing(std::size_t k) const {
    return lowest_frequency_of(samples_[k], bench_.scene("slow_fracture.toml", of_sample(k)));
  }
  std::size_t size() const { return samples_.size(); }

 private:
  /// Cells stay as large as in the scene, whatever their number.
  std::vector<std::string> of_sample(std::size_t k) const {
    const double scale = std::sqrt(cells_ / 60.0);
    return {fmt::format("seed={}", k + 1), fmt::format("sample.packing.count={}", cells_),
            fmt::format("sample.width={:.9g}", 0.62e-3 * scale), fmt::format("sample.height={:.9g}", 0.97e-3 * scale)};
  }

  StudyBench& bench_;
  int cells_;
  std::vector<Sample> samples_;
  std::vector<FractureAnswer> reference_;
};

Method at_rest(const std::string& name, const std::string& key, const std::vector<std::string>& settings,
               std::size_t samples) {
  Method method{name, key, "at rest: " + name, 0, {"run.stepper=quasi_static"}, samples};
  method.settings.insert(method.settings.end(), settings.begin(), settings.end());
  return method;
}

struct Damping {
  std::string name;
  double drag;
  std::string stepper = "velocity_verlet";
};

Method in_time(const Damping& damping, double slowdown, std::size_t samples) {
  // A row costs as much as a step, and a fast run has few steps. Swings that a step of generalised alpha does not resolve it must not keep:
  // with the default share of them it finds no solution of many a slow step.
  const int rows = std::min(5000, static_cast<int>(1000 * slowdown));
  return {fmt::format("in time, {}, slowdown {:g}", damping.name, slowdown),
          fmt::format("{}_{:g}_{:g}", damping.stepper, damping.drag, slowdown),
          fmt::format("in time, {}", damping.name),
          slowdown,
          {fmt::format("run.slowdown={:g}", slowdown), fmt::format("drag.rate={:g}", damping.drag),
           fmt::format("output.response={}", rows), fmt::format("run.stepper={}", damping.stepper),
           "run.spectral_radius=0"},
          samples};
}

std::string signed_text(double error) { return fmt::format("{:+.2g} %", 100 * error); }

void judged_table(StudyReport& report, const std::vector<Judged>& all) {
  ReportTable table{
      {"method", "samples", "error of peak stress", "its mean with sign", "strain at peak", "work",
       "its mean with sign", "strain at first break", "same first link", "broken links", "cracked walls", "CPU s"},
      {}};
  for (const Judged& j : all) {
    const std::string samples = j.answers == j.method.samples ? fmt::format("{}", j.answers)
                                                              : fmt::format("{} of {}", j.answers, j.method.samples);
    if (j.answers == 0)
      table.rows.push_back({j.method.name, samples, error_text(j.peak), "", "", "", "", "", "", "", "",
                            fmt::format("{:.2g}", j.seconds)});
    else
      table.rows.push_back({j.method.name, samples, error_text(j.peak), signed_text(j.signed_peak),
                            error_text(j.strain_at_peak), error_text(j.work), signed_text(j.signed_work),
                            error_text(j.first_strain), fmt::format("{:.2f}", j.same_first),
                            fmt::format("{:.2f}", j.links), fmt::format("{:.2f}", j.walls),
                            fmt::format("{:.2g}", j.seconds)});
  }
  report.table(table);
}

/// "35 %, 12 %, 5 %".
std::string listed(const std::vector<Judged>& sweep, double Judged::*error) {
  std::string text;
  for (const Judged& j : sweep) text += (text.empty() ? "" : ", ") + error_text(j.*error);
  return text;
}

/// Seconds at which a sweep from fast to slow comes below an error of the peak and stays there, by straight lines between
/// logarithms; infinite where it does not.
double seconds_for(const std::vector<Judged>& sweep, double accepted) {
  if (sweep.empty() || !(sweep.back().peak <= accepted)) return std::numeric_limits<double>::infinity();
  std::size_t k = sweep.size() - 1;
  while (k > 0 && sweep[k - 1].peak <= accepted) --k;
  if (k == 0) return sweep[0].seconds;
  const Judged &above = sweep[k - 1], &below = sweep[k];
  const double u = std::log(above.peak / accepted) / std::log(above.peak / std::max(below.peak, 1e-6));
  return above.seconds * std::pow(below.seconds / above.seconds, u);
}

void draw(StudyReport& report, const std::vector<Judged>& rest, const std::vector<Judged>& time) {
  constexpr double kFloor = 1e-4;
  std::vector<Measured> all;
  double low = kFloor, high = kFloor;
  for (const auto* list : {&time, &rest})
    for (const Judged& j : *list) {
      if (j.answers == 0 || &j == &rest.front()) continue;
      Measured m{.setting = j.method.name, .group = j.method.group, .knob = j.method.slowdown};
      m.error = std::max(j.peak, kFloor), m.seconds = j.seconds, m.joined = j.method.slowdown > 0;
      high = std::max(high, m.error);
      all.push_back(m);
    }
  const double seconds = rest.front().seconds;
  const Curve reference{{seconds, seconds},
                        {100 * low, 100 * high},
                        {kReferenceColour, 1, {3, 3}},
                        "at rest: one link at a time (error 0)"};
  precision_over_seconds(report, "slow_fracture", "Slow fracture", all, {reference});
}

void tell_the_setup(StudyReport& report, const Ensemble& ensemble, int cells) {
  const double swing = ensemble.slowest_swing(0);
  report.text(fmt::format(
      "What slow dynamics answers, beside equilibrium after every break (`run.stepper = \"quasi_static\"`, section 9b "
      "of "
      "[model.md](model.md)): {} elastic tissues of {} cells with\n"
      "3 segments on a wall (`slow_fracture.toml`), without contact, so that both solve the same problem, pulled apart "
      "until they part. Reference: at rest, one link at a time. Errors are relative, means of their\n"
      "magnitudes over the samples unless a sign is shown; work: of the grips until the sample parts; links and walls: "
      "those that broke (of a wall, any link), what both runs have over what either has\n"
      "(Jaccard). CPU seconds are those of the whole run of a sample, other work on the machine left out. Slowdown 1 "
      "is "
      "{:g} Hz of strain, {:.2g} of it in the slowest swing of the first sample, which is critically damped by\n"
      "a drag of {:.2g} Hz; dampings: {}.",
      ensemble.size(), cells, kRate, kRate * 2 * std::numbers::pi / swing, 2 * swing,
      "light 5e4 Hz (as in the tissue above), near critical 1.8e5 Hz, strong 5e5 Hz, overdamped 2e6 Hz"));
}

/// What is no error of either: the trend with the rate, and what inertia does.
void tell_the_difference(StudyReport& report, const std::vector<Judged>& light, const std::vector<Judged>& critical,
                         const std::vector<Judged>& strong, const std::vector<Judged>& over, bool small) {
  const Judged &slow = critical.back(), &calm = over.back(), &lively = light.back();
  std::string same;
  for (const Judged& j : over) same += fmt::format("{}{:.0f} %", same.empty() ? "" : ", ", 100 * j.links);
  report.text(fmt::format(
      "**The witness.** The method at rest must not be its own judge. Up to the first break nothing has fallen, and "
      "both must agree but for the rate: from fast to slow the strain at the first break is off by\n"
      "{} near critical damping, by {} with strong damping. After it they come together where drag leaves avalanches "
      "no "
      "momentum and the pull is slow beside it: overdamped, the peak stress is off by\n"
      "{} (at last {} with its sign), the work by {}, and of the links that break in either run {} break in both. "
      "Explicit runs come to the answer at rest as the rate falls.",
      listed(critical, &Judged::first_strain), listed(strong, &Judged::first_strain), listed(over, &Judged::peak),
      signed_text(calm.signed_peak), listed(over, &Judged::work), same));
  report.at_most("strain at the first break, near critical damping, slowest pull: error", slow.first_strain, 0.02);
  report.at_most("the same over that of the fastest pull", slow.first_strain / critical.front().first_strain, 0.2);
  report.at_most("peak stress, overdamped, slowest pull: error", calm.peak, small ? 0.1 : 0.04);
  if (!small)  // two tiny samples scatter too much for a trend
    report.at_most("the same over that of the fastest pull", calm.peak / over.front().peak, 0.5);
  report.text(fmt::format(
      "**Where they differ because of physics.** Inertia carries an avalanche past equilibrium: it breaks links that "
      "would hold at rest, and spends on motion what the grips would still have had to do.\n"
      "That does not go away with the rate. At slowdown {:g} near critical damping the first break is off by {} only, "
      "yet the peak stress by {} ({} on average), the work by {} ({}), and {:.0f} % of the links that break in\n"
      "either run break in both; with light damping at slowdown {:g}: {} ({}), {} ({}), {:.0f} %. Strong damping still "
      "leaves "
      "{} of the peak at its slowest pull: drag damps short swings less than long ones, and a break sets off short "
      "ones.\n"
      "A tissue in a viscous medium is answered at rest, a dry and ringing one in time.",
      slow.method.slowdown, error_text(slow.first_strain), error_text(slow.peak), signed_text(slow.signed_peak),
      error_text(slow.work), signed_text(slow.signed_work), 100 * slow.links, lively.method.slowdown,
      error_text(lively.peak), signed_text(lively.signed_peak), error_text(lively.work),
      signed_text(lively.signed_work), 100 * lively.links, error_text(strong.back().peak)));
}

/// What 3 % of the peak cost each way.
void tell_the_factor(StudyReport& report, const std::vector<Judged>& rest,
                     const std::vector<std::vector<Judged>>& sweeps) {
  constexpr double kAccepted = 0.03;
  const Judged& reference = rest.front();
  const Judged* cheapest = &reference;
  for (const Judged& j : rest)
    if (j.peak <= kAccepted && j.seconds < cheapest->seconds) cheapest = &j;
  double least = std::numeric_limits<double>::infinity();
  std::string best;
  const Judged* nearest = nullptr;
  for (const auto& sweep : sweeps) {
    if (const double seconds = seconds_for(sweep, kAccepted); seconds < least)
      least = seconds, best = sweep.front().method.group;
    for (const Judged& j : sweep)
      if (!nearest || j.peak < nearest->peak) nearest = &j;
  }
  const std::string cheap =
      fmt::format("At rest, one link at a time takes {:.2g} s; the cheapest variant within 3 %, {}, {:.2g} s.",
                  reference.seconds, cheapest->method.name, cheapest->seconds);
  if (std::isinf(least)) {
    report.text(
        fmt::format("**What 3 % of the peak stress costs.** *Not reached in time*: the nearest is {} with {} and "
                    "{:.2g} s a sample, "
                    "{:.0f} times what the reference costs. {}",
                    nearest->method.name, error_text(nearest->peak), nearest->seconds,
                    nearest->seconds / reference.seconds, cheap));
    return;
  }
  report.text(fmt::format(
      "**What 3 % of the peak stress costs.** {} Of the explicit sweeps, {} is the first to come below 3 % and stay "
      "there: after {:.2g} s a sample (between two rates by logarithms),\n"
      "{:.0f} times the reference and {:.0f} times that variant. (Slow pulls were tried on fewer samples than fast "
      "ones.)",
      cheap, best, least, least / reference.seconds, least / cheapest->seconds));
}

/// The number, and how far off the reference it is.
std::string beside(double found, double exact, double unit, bool reference) {
  const std::string text = fmt::format("{:.4g}", found / unit);
  return reference ? text : fmt::format("{} ({})", text, signed_text(found / exact - 1));
}

constexpr int kCellsForAll = 400;  // methods that are dear are tried on tissues up to this

/// Whether the methods agree on larger tissues too, and what each costs.
void larger_tissues(StudyBench& bench, const std::vector<int>& sizes) {
  bench.report.text(
      "**Larger tissues.** One sample each, cells as large as above; in brackets how far off the first row. Overdamped "
      "in time; the explicit step at the smallest size only, and the dearer implicit ones up to 400 cells. "
      "Where drag holds back, what the grips do takes time to reach the middle, in proportion to the square of the "
      "way: "
      "a slowdown that is slow for a small tissue is fast for a large one.");
  ReportTable table{{"cells", "links", "method", "peak stress [kPa]", "strain at peak [%]", "work [uJ]", "broken links",
                     "overlap", "of walls", "CPU s"},
                    {}};
  for (const int cells : sizes) {
    Ensemble one(bench, cells, 1);
    const auto slowly = [](const std::string& stepper, const std::string& name, double slowdown) {
      return in_time({"overdamped, " + name, 2e6, stepper}, slowdown, 1);
    };
    std::vector<Method> methods{at_rest("at rest, one link at a time", "one", {}, 1),
                                at_rest("at rest, all links at once", "all", {"run.breaking=all_at_once"}, 1),
                                slowly("backward_euler", "backward Euler", 1000)};
    if (cells <= kCellsForAll) {
      methods.push_back(slowly("backward_euler", "backward Euler", 100));
      methods.push_back(slowly("generalised_alpha", "generalised alpha", 100));
    }
    if (cells == sizes.front()) methods.push_back(slowly("velocity_verlet", "explicit", 100));
    std::optional<FractureAnswer> exact;
    for (const Method& method : methods) {
      const Try found = one.attempt(method, 0);
      bench.say(fmt::format("slow fracture, {} cells, {}: {:.1f} s of CPU", cells, method.name, found.seconds));
      const std::string size = fmt::format("{}", cells), links = fmt::format("{}", one.sample(0).links.size()),
                        seconds = fmt::format("{:.2g}", found.seconds);
      if (!found.answer) {
        table.rows.push_back({size, links, method.name, error_text(std::nan("")), "", "", "", "", "", seconds});
        continue;
      }
      const bool reference = !exact;
      if (reference) exact = found.answer;
      const FractureAnswer& answer = *found.answer;
      table.rows.push_back({size, links, method.name, beside(answer.peak_stress, exact->peak_stress, 1e3, reference),
                            beside(answer.strain_at_peak, exact->strain_at_peak, 1e-2, reference),
                            beside(answer.work, exact->work, 1e-6, reference), fmt::format("{}", answer.links.size()),
                            fmt::format("{:.2f}", overlap(answer.links, exact->links)),
                            fmt::format("{:.2f}", overlap(answer.walls, exact->walls)), seconds});
    }
  }
  bench.report.table(table);
}

}  // namespace

void accuracy_of_slow_fracture(StudyBench& bench) {
  const bool small = bench.small();
  StudyReport& report = bench.report;
  const double begin = cpu_seconds();
  report.section("Slow fracture: at rest against in time");
  const int cells = small ? 25 : 60;
  Ensemble ensemble(bench, cells, small ? 2 : 12);
  const std::size_t samples = ensemble.size();

  std::vector<Judged> rest;
  for (const Method& method : {at_rest("one link at a time", "one", {}, samples),
                               at_rest("all links at once", "all", {"run.breaking=all_at_once"}, samples),
                               at_rest("residual 1e-2", "residual", {"run.residual=1e-2"}, samples),
                               at_rest("load tolerance 1e-2", "tolerance", {"run.load_tolerance=1e-2"}, samples)})
    rest.push_back(ensemble.judge(method));
  // Slow pulls are dear, and tried on fewer samples.
  const auto sweep = [&](const Damping& damping, const std::vector<double>& slowdowns) {
    std::vector<Judged> judged;
    for (const double slowdown : slowdowns) {
      const std::size_t count = small || slowdown < 30 ? samples : slowdown < 100 ? samples / 2 : samples / 4;
      judged.push_back(ensemble.judge(in_time(damping, slowdown, count)));
    }
    return judged;
  };
  using Slowdowns = std::vector<double>;
  const std::vector<Judged> light = sweep({"light damping", 5e4}, small ? Slowdowns{10} : Slowdowns{1, 3, 10});
  const std::vector<Judged> critical =
      sweep({"near critical damping", 1.8e5}, small ? Slowdowns{1, 10} : Slowdowns{1, 3, 10, 30});
  const std::vector<Judged> strong =
      sweep({"strong damping", 5e5}, small ? Slowdowns{1, 10} : Slowdowns{1, 3, 10, 30, 100});
  const std::vector<Judged> over = sweep({"overdamped", 2e6}, small ? Slowdowns{10, 100} : Slowdowns{10, 30, 100});
  // As long as the time between two rows: 1e-4 of strain, however slow.
  const std::vector<Judged> implicit = sweep({"overdamped, backward Euler", 2e6, "backward_euler"},
                                             small ? Slowdowns{100} : Slowdowns{10, 30, 100, 1000});
  const std::vector<Judged> sharper = sweep({"overdamped, generalised alpha", 2e6, "generalised_alpha"},
                                            small ? Slowdowns{100} : Slowdowns{10, 30, 100, 1000});
  std::vector<Judged> time;
  for (const auto& list : {light, critical, strong, over, implicit, sharper})
    time.insert(time.end(), list.begin(), list.end());

  tell_the_setup(report, ensemble, cells);
  judged_table(report, rest);
  judged_table(report, time);
  draw(report, rest, time);
  tell_the_difference(report, light, critical, strong, over, small);
  if (!small) tell_the_factor(report, rest, {light, critical, strong, over});
  if (!small) larger_tissues(bench, {100, 400, 1600, 3600});
  bench.say(fmt::format("slow fracture: {:.0f} s of CPU in all", cpu_seconds() - begin));
}

}  // namespace lamella
