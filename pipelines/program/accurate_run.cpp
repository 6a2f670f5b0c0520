#include "pipelines/program/accurate_run.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "generator/sample/errors.h"
#include "pipelines/accuracy/answer.h"
#include "pipelines/accuracy/choice.h"
#include "postproc/output_file.h"
#include "postproc/quantities/energy_budget.h"

namespace lamella {
namespace {

namespace fs = std::filesystem;

struct Paced {
  Choice choice;
  Answer answer;
  RunFacts facts;
  fs::path trajectory;
  std::optional<ErrorEstimate> error;
  double work = 0;                               // of the whole run [J]
  double error_of_place = 0, error_of_work = 0;  // relative: where the load is largest; of that work
};

double last_work(const TrajectoryReader& run) {
  const std::vector<double> work = response_column(run.response(), "work");
  return work.empty() ? 0.0 : work.back();
}

nlohmann::ordered_json row_of(const Paced& run) {
  nlohmann::ordered_json row{{"settings", run.choice.settings()},
                             {"largest_load", run.answer.load[run.answer.peak()]},
                             {"reached_at", run.answer.progress[run.answer.peak()]},
                             {"steps", run.facts.steps},
                             {"seconds", run.facts.seconds + run.facts.frame_seconds},
                             {"ledger_residual", run.facts.residual}};
  if (run.error) row["estimated_error_of_largest_load"] = run.error->peak;
  if (run.error) row["estimated_error_of_curve"] = run.error->curve;
  return row;
}

}  // namespace

AccurateRun run_to_accuracy(const std::function<Scene(const std::vector<std::string>&)>& scene_at, const Sample& sample,
                            double accepted, const fs::path& folder, Progress& progress,
                            const std::function<SimulateOptions()>& options) {
  std::vector<Paced> runs;
  const auto run_at = [&](Choice choice) {
    const Scene scene = scene_at(choice.settings());
    Paced run{choice, {}, {}, folder / "accuracy" / fmt::format("pace_{}.h5", runs.size() + 1), {}};
    make_folder(run.trajectory.parent_path());
    progress.start(fmt::format("pace {}", runs.size() + 1));
    {
      TrajectoryWriter writer(run.trajectory, sample, {});
      run.facts = simulate(sample, scene, writer, options());
    }
    progress.finish();
    if (run.facts.interrupted)
      throw Interrupted(fmt::format("interrupted; runs so far are in {}; a run to an accuracy starts anew next time",
                                    (folder / "accuracy").string()));
    run.answer = answer_of(TrajectoryReader(run.trajectory), choice.slowdown, runs.empty() ? nullptr : &runs[0].answer);
    run.work = last_work(TrajectoryReader(run.trajectory));
    if (!runs.empty()) {
      const Paced& before = runs.back();
      const double ratio = choice.effort() / before.choice.effort();
      run.error = error_of_slower(run.answer, before.answer, ratio);
      const auto off = [&](double now, double then) { return now != 0 ? std::abs(then / now - 1) / (ratio - 1) : 0.0; };
      run.error_of_place = off(run.answer.progress[run.answer.peak()], before.answer.progress[before.answer.peak()]);
      run.error_of_work = off(run.work, before.work);
    }
    progress.say(fmt::format("  pace {}: {}: largest {} {:.6g} {}{}", runs.size() + 1, choice.sentence(),
                             run.answer.name, run.answer.load[run.answer.peak()], run.answer.unit,
                             run.error ? fmt::format(", estimated error {:.2g}", run.error->larger()) : ""));
    runs.push_back(std::move(run));
  };

  Choice choice = first_choice(sample, scene_at({}), accepted);
  run_at(choice.times(0.5)), run_at(choice);
  const auto off = [&] { return std::max(runs.back().error->larger(), runs.back().facts.residual); };
  while (off() > accepted && within_reach(off(), accepted, kMostRuns - static_cast<int>(runs.size()))) {
    // An open ledger is the step's error, not the pace's.
    if (choice.step_fraction && runs.back().facts.residual > accepted) *choice.step_fraction /= 2;
    choice = slower(choice, runs.back().error->larger(), accepted);
    run_at(choice);
  }

  const Paced& last = runs.back();
  AccurateRun result{accepted, last.error->larger(), {}};
  nlohmann::ordered_json json{{"accepted_error", accepted}, {"load", last.answer.name}, {"unit", last.answer.unit}};
  for (const Paced& run : runs) json["runs"].push_back(row_of(run));
  write_text_file(folder / "accuracy.json", json.dump(2) + "\n");
  fs::rename(last.trajectory, folder / "trajectory.h5");
  const char* covers = last.choice.fineness
                           ? "; of tolerances and load steps: by the difference of the two finest runs, taken as first "
                             "order in both; the number of mass "
                             "points is the scene's, and what inertia would do in avalanches is not in this"
                           : "; of pace, drag and time step: by the difference of the runs at the two slowest paces, "
                             "taken as first order in "
                             "the "
                             "pace; the number of mass points is the scene's, and its error is not in this";
  result.quantities = {{"accepted_error", accepted, "1", "of the largest load, as asked for"},
                       {"estimated_error_of_largest_load", last.error->peak, "1", std::string("relative") + covers},
                       {"estimated_error_of_curve", last.error->curve, "1",
                        std::string("root mean square over the way to the largest load, relative") + covers},
                       {"estimated_error_of_place_of_largest_load", last.error_of_place, "1",
                        std::string("of the strain (or time) at which it is reached, relative") + covers},
                       {"estimated_error_of_work", last.error_of_work, "1",
                        std::string("of the work of the whole run, breaks included, relative") + covers}};
  if (off() > accepted)
    throw SolverError(
        fmt::format("an error of {:.3g} is not reached: after {} runs, the last with {}, {:.3g} is estimated for the "
                    "{} and the energy ledger is open by {:.2g}; the runs are in {}. Accept more, or look there for "
                    "what swings or breaks",
                    accepted, runs.size(), last.choice.sentence(), result.estimated, last.answer.name,
                    last.facts.residual, folder.string()));
  return result;
}

}  // namespace lamella
