// Cases in which solvers for rest fail: a criterion and an outcome each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

bool in_two(const StudyRun& run) { return run.facts.ended.starts_with("separated"); }

/// The scene without [links], on its sample without any.
StudyRun unlinked(StudyBench& bench, const std::string& name, Scene scene) {
  Sample sample = sample_of(scene);
  sample.links.clear();
  for (Stage& stage : scene.stages) stage.links.clear(), stage.contact.reset();
  return bench.attempt(name, sample, scene);
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
  const StudyRun notched = bench.attempt("notched", "tissue.toml", with({"sample.notch.line=[[-1, 5], [4, 5]]"}));
  const double x = notched.reader.events().empty() ? -1 : notched.reader.events().front().position.x();
  cases.add("notch over 0.4 of the width", "weaker, and torn in two", in_two(notched) && peak(notched) < peak(torn),
            fmt::format("peak {:.3f} of the whole tissue's; first break at x = {:.2f}", peak(notched) / peak(torn), x),
            notched);
  const StudyRun tiny = bench.attempt("tiny_edges", "tissue.toml", with({"sample.walls.weld=0"}));
  double shortest = 1e300, mean = 0;
  const Sample& s = tiny.reader.sample();
  for (const Wall& wall : s.walls)
    shortest = std::min(shortest, wall.length), mean += wall.length / static_cast<double>(s.walls.size());
  cases.add("tiny edges", "torn in two; peak within 5 % of that with short edges welded",
            in_two(tiny) && std::abs(peak(tiny) / peak(torn) - 1) < 0.05,
            fmt::format("shortest wall {:.3g} of the mean; peak {:.3f} of the welded one's", shortest / mean,
                        peak(tiny) / peak(torn)),
            tiny);
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
