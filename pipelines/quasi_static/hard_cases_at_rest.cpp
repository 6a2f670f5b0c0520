// Cases in which solvers for rest fail: a criterion and an outcome each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "generator/sample/errors.h"
#include "pipelines/hard_cases/tools.h"
#include "pipelines/quasi_static/at_rest.h"

namespace lamella::at_rest {
namespace {

using Settings = std::vector<std::string>;

double peak(const StudyRun& run) {
  const auto stress = run.column("stress");
  return *std::max_element(stress.begin(), stress.end());
}

/// A row of the table, and a finding.
class Cases {
 public:
  explicit Cases(StudyReport& report) : report_(report) {}
  void add(const std::string& what, const std::string& criterion, bool met, const std::string& seen,
           const StudyRun& run) {
    const std::string said = run.error.empty() ? seen : seen + "; " + run.error;
    report_.holds(what + ": " + criterion, met, said);
    table_.rows.push_back(
        {what, fmt::format("{}", run.reader.events().size()), fmt::format("{}", run.facts.static_cost.searches),
         fmt::format("{}", run.facts.static_cost.factorizations), fmt::format("{:.2g}", run.facts.seconds)});
  }
  void finish() { report_.table(table_); }

 private:
  StudyReport& report_;
  ReportTable table_{{"case", "breaks", "equilibria", "factorisations", "seconds"}, {}};
};

/// Links that break in both runs, over those that do in either.
double overlap_of_breaks(const StudyRun& a, const StudyRun& b) {
  std::set<int> in_a, either;
  std::size_t both = 0;
  for (const Event& e : a.reader.events()) in_a.insert(e.link);
  either = in_a;
  for (const Event& e : b.reader.events()) both += in_a.count(e.link), either.insert(e.link);
  return either.empty() ? 1 : static_cast<double>(both) / static_cast<double>(either.size());
}

bool in_two(const StudyRun& run) { return run.facts.ended.starts_with("separated"); }

/// The scene without [links], on its sample without any.
StudyRun unlinked(StudyBench& bench, const std::string& name, Scene scene) {
  Sample sample = sample_of(scene);
  sample.links.clear();
  for (Stage& stage : scene.stages) stage.links.clear(), stage.contact.reset();
  return bench.attempt(name, sample, scene);
}

/// Edges and segments of a thousandth of the others: bars a thousand times as stiff beside them.
void tiny_edges(StudyBench& bench, Cases& cases, const Settings& settings, const StudyRun& torn) {
  const auto shortest_of = [](const std::vector<double>& lengths) {
    const double mean = std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
    return *std::min_element(lengths.begin(), lengths.end()) / mean;
  };
  const auto seen = [&](const StudyRun& run, const std::string& what) {
    const SolverCost &cost = run.facts.static_cost, &plain = torn.facts.static_cost;
    return fmt::format("{}; peak {:.5f} of that without, {:.2f} of its links too; {} iterations instead of {}", what,
                       peak(run) / peak(torn), overlap_of_breaks(run, torn), cost.iterations, plain.iterations);
  };
  const auto near = [&](const StudyRun& run, double band) {
    return in_two(run) && std::abs(peak(run) / peak(torn) - 1) < band;
  };
  const Scene scene = bench.scene("tissue.toml", settings);
  const Sample& welded = torn.reader.sample();
  const double mean = std::accumulate(welded.rest_length.begin(), welded.rest_length.end(), 0.0) / welded.nodes();
  const Sample split = hard_cases::with_tiny_segments(welded, 1e-3 * mean);
  const StudyRun tiny = bench.attempt("tiny_segments", split, scene);
  cases.add("tiny segments, one in each cell", "torn in two; peak within 1 %", near(tiny, 0.01),
            seen(tiny, fmt::format("shortest segment {:.2g} of the mean", shortest_of(split.rest_length))), tiny);
}

/// Brittle links break first where walls end on a free side, notch or none: they soften here. Returns the run of the deepest notch.
StudyRun notches(StudyBench& bench, Cases& cases) {
  const Settings soft{"loading.strain=0.6", "links.law=\"cohesive_zone\"", "links.toughness=0.0256"};
  const StudyRun whole = bench.attempt("soft", "tissue.toml", soft);
  std::optional<StudyRun> last;
  for (const double tip : {4.0, 5.0, 6.0}) {
    Settings settings = soft;
    settings.push_back(fmt::format("sample.notch.line=[[-1, 5], [{:g}, 5]]", tip));
    StudyRun run = bench.attempt(fmt::format("notched_{:g}", tip), "tissue.toml", settings);
    const auto& events = run.reader.events();
    const Vec2 first = events.empty() ? Vec2(-9, -9) : events.front().position;
    const double away = (first - Vec2(tip, 5)).norm();
    cases.add(fmt::format("notch over {:g} of the width, links that soften", tip / 10),
              "weaker, first break within 1 of its tip (cells are 1.7 across), torn in two",
              in_two(run) && peak(run) < peak(whole) && away < 1,
              fmt::format("peak {:.3f} of the whole tissue's; first break at ({:.2f}, {:.2f}), {:.2f} from the tip",
                          peak(run) / peak(whole), first.x(), first.y(), away),
              run);
    last.emplace(std::move(run));
  }
  return std::move(*last);
}

/// A tenth of the links absent from the start, contact in their place: no force before the load, and weaker.
void missing_links(StudyBench& bench, Cases& cases, Settings settings, const StudyRun& torn) {
  settings.insert(settings.end(), {"sample.walls.missing=0.1", "contact.friction=0"});
  const StudyRun flawed = bench.attempt("missing_links", "tissue.toml", settings);
  const auto all = torn.reader.sample().links.size(), left = flawed.reader.sample().links.size();
  const double before = flawed.column("stress").front();
  cases.add("a tenth of the links absent from the start, with contact",
            "so many of them, no stress at strain 0, weaker, torn in two",
            in_two(flawed) && left == all - static_cast<std::size_t>(std::lround(0.1 * static_cast<double>(all))) &&
                std::abs(before) < 1e-9 && peak(flawed) < peak(torn),
            fmt::format("{} of {} links; stress {:.1e}; peak {:.3f} of the whole tissue's", left, all, before,
                        peak(flawed) / peak(torn)),
            flawed);
}

void tissues(StudyBench& bench, Cases& cases) {
  const Settings small = {"loading.strain=0.6", bench.small() ? "sample.walls.segments=3" : "sample.walls.segments=4"};
  const auto with = [&](Settings more) {
    more.insert(more.begin(), small.begin(), small.end());
    return more;
  };
  const StudyRun torn = bench.attempt("torn", "tissue.toml", with({}));
  cases.add("complete separation", "ends in two parts, without stress",
            in_two(torn) && std::abs(torn.last("stress")) < 1e-3,
            fmt::format("{}; stress {:.1e}", torn.facts.ended, torn.last("stress")), torn);
  const StudyRun loose = unlinked(bench, "no_links",
                                  bench.scene("tissue.toml", {"stop.separated=false", "loading.strain=0.1",
                                                              "sample.packing.count=16", "sample.walls.segments=3"}));
  cases.add("no links", "rest is found, without stress", loose.error.empty() && std::abs(loose.last("stress")) < 1e-9,
            fmt::format("{}; stress {:.1e}", loose.facts.ended, loose.last("stress")), loose);
  const StudyRun notched = notches(bench, cases);
  tiny_edges(bench, cases, with({}), torn);
  missing_links(bench, cases, with({}), torn);
  const StudyRun pressed =
      bench.attempt("pressed", "tissue.toml",
                    with({"loading.kind=\"compression\"", "loading.strain=0.1", "links.normal_strength=100",
                          "links.tangential_strength=100", "cells.bending_rigidity=0.02", "contact.friction=0"}));
  cases.add("compression with buckling walls and contact", "rest to the end, under pressure",
            pressed.error.empty() && pressed.last("stress") < 0,
            fmt::format("{}; stress {:.3g}", pressed.facts.ended, pressed.last("stress")), pressed);
  hard_cases::draw_panels(bench, "hard_cases", "Torn in two; torn from a notch; pressed.",
                          {{&torn.reader.sample(), torn.positions(-1), "torn", {}},
                           {&notched.reader.sample(), notched.positions(-1), "from a notch", {}},
                           {&pressed.reader.sample(), pressed.positions(-1), "pressed", {}}});
}

void many_at_once(StudyBench& bench, Cases& cases) {
  const Settings block{kStepper, "sample.walls.segments=10", "loads.pull.force_y=0.02"};
  for (const std::string breaking : {"one_at_a_time", "all_at_once"}) {
    Settings settings = block;
    settings.push_back("run.breaking=\"" + breaking + "\"");
    const StudyRun run = bench.attempt("at_once_" + breaking, "../links/normal.toml", settings);
    std::set<std::int64_t> avalanches;
    for (const Event& e : run.reader.events()) avalanches.insert(e.avalanche);
    cases.add(
        "eleven links at once under a dead load, " + breaking,
        "one avalanche, at the end of which nothing holds the load; the stage ends there",
        run.error.empty() && run.reader.events().size() == 11 && avalanches.size() == 1 &&
            run.facts.ended.starts_with("nothing holds"),
        fmt::format("{} breaks, {} avalanche; {}", run.reader.events().size(), avalanches.size(), run.facts.ended),
        run);
  }
}

/// Pressure beyond what a wall that flows can hold: the run must give up, say where, and leave what a further run goes on from.
void gives_up(StudyBench& bench, Cases& cases) {
  const StudyRun run = bench.attempt("gives_up", "overinflated.toml");
  const auto said = [&](const char* part) { return run.error.find(part) != std::string::npos; };
  const double last = run.reader.frame(run.reader.frames() - 1).time;
  cases.add("pressure that nothing can hold", "gives up with time, residual and node, at the limit 0.5 s",
            said("t = ") && said("internal force") && said("on node") && last > 0.45 && last < 0.52,
            fmt::format("last state at {:.3f} s", last), run);
  // The same again, resumed from the state that it left: it comes no further, and leaves it as it is.
  std::string again;
  try {
    resume(bench.out() / "runs" / "gives_up.h5", {});
  } catch (const SolverError& error) {
    again = error.what();
  }
  bench.report.holds("resumed from there", !again.empty(),
                     again.empty() ? "went on" : "reads the last good state, and gives up again: " + again);
  const StudyRun relieved =
      bench.attempt("relieved", "overinflated.toml", {"stages.hold.cells.yield_force=3", "stages.fill.stop.time=0.45"});
  cases.add("stopped before it, and on with stronger walls", "a further stage goes on to the end",
            relieved.error.empty(), relieved.facts.ended, relieved);
}

}  // namespace

void hard_cases(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Hard cases");
  report.text(
      "A criterion and an outcome each; what each took is in the table. One cell alone, and a stiff core, are the "
      "rings above.");
  Cases cases(report);
  tissues(bench, cases);
  many_at_once(bench, cases);
  gives_up(bench, cases);
  cases.finish();
}

}  // namespace lamella::at_rest
