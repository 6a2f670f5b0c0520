#include "pipelines/program/commands.h"

#include <fmt/format.h>

#include "generator/sample/errors.h"
#include "generator/sample/parallel.h"
#include "generator/sample/sample_file.h"
#include "generator/tissue/mosaic_file.h"
#include "pipelines/program/accurate_run.h"
#include "pipelines/program/generating.h"
#include "pipelines/program/interrupt.h"
#include "pipelines/program/writable.h"
#include "postproc/output_file.h"
#include "postproc/postproc.h"
#include "simulator/simulate.h"
#include "simulator/trajectory/extract.h"
#include "simulator/trajectory/trajectory.h"

namespace lamella {
namespace {

namespace fs = std::filesystem;

const Verbosity kNormal = Verbosity::normal;

/// A scene that was only meant to make a sample says nowhere when its run ends.
void require_run(const Scene& scene) {
  for (const Stage& stage : scene.stages)
    if (!stage.loading && !stage.stop.time && !stage.stop.at_rest)
      throw SceneError(fmt::format("{}: stop: nothing ends the run; give [loading], stop.time or stop.at_rest",
                                   scene.path.string()));
}

void say_summary(const Sample& sample, const Scene& scene, Progress& progress) {
  for (const auto& line : start_up_summary(sample, scene)) progress.say(line);
}

SimulateOptions simulate_options(Progress& progress) {
  SimulateOptions options;
  options.interrupted = &interrupted();
  options.progress = [&](const RunProgress& run) {
    const std::string stage = run.stages > 1 ? run.stage_name + ", " : "";
    progress.show(run.done, fmt::format("{}time {:.3g} s, strain {:.4f}, stress {:.3g} Pa, {} broken links", stage,
                                        run.time, run.strain, run.stress, run.broken));
  };
  return options;
}

void report(const RunFacts& facts, const fs::path& trajectory, Progress& progress) {
  progress.finish();
  if (facts.interrupted)
    throw Interrupted(fmt::format("interrupted; what was computed is in {}; go on with the same command and --resume",
                                  trajectory.string()));
  if (const SolverCost& cost = facts.static_cost; cost.searches > 0)
    progress.say(fmt::format("  {}; {} equilibria by {} iterations, with {} factorisations and {} in part", facts.ended,
                             cost.searches, cost.iterations, cost.factorizations, cost.partial_factorizations));
  else
    progress.say(fmt::format("  {}; {} steps, {:.3g} node-steps/s", facts.ended, facts.steps, facts.node_steps));
}

void simulate_to(const Sample& sample, const Scene& scene, const fs::path& out, Progress& progress) {
  say_summary(sample, scene, progress);  // finds what does not fit, before anything on disk is touched
  make_folder(fs::absolute(out).parent_path());
  TrajectoryWriter writer(out, sample, {});
  progress.start("simulate");
  report(simulate(sample, scene, writer, simulate_options(progress)), out, progress);
}

/// --threads changes nothing but the speed.
std::string joined_settings(const std::vector<std::string>& settings) {
  std::string out;
  for (const auto& setting : settings)
    if (!setting.starts_with("run.threads=")) out += setting + "\n";
  return out;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
    lines.push_back(text.substr(at, end - at));
  return lines;
}

/// A run goes on as it began: the scene on the command line must be the one that the trajectory holds.
void resume_to(const Scene& scene, const fs::path& out, Progress& progress) {
  {
    const TrajectoryReader reader(out);
    const auto fact = [&](const char* key) {
      const auto found = reader.provenance().find(key);
      return found == reader.provenance().end() ? std::string() : found->second;
    };
    if (fact("scene") != scene.text || joined_settings(lines_of(fact("overrides"))) != joined_settings(scene.overrides))
      throw SceneError(fmt::format(
          "{}: was begun with another scene or other --set; resume with those, or run without --resume", out.string()));
  }
  progress.start("resume");
  report(resume(out, simulate_options(progress)), out, progress);
}

bool is_begun(const fs::path& trajectory) {
  return fs::exists(trajectory) || fs::exists(fs::path(trajectory.string() + ".parts"));
}

void show_to(const fs::path& trajectory, const fs::path& folder, Progress& progress,
             std::vector<Quantity> accuracy = {}) {
  PostOptions options;
  options.accuracy = std::move(accuracy);
  options.progress = [&](double done, const std::string& what) {
    stop_if_interrupted();
    progress.show(done, what);
  };
  progress.start("post");
  const PostResult result = post(trajectory, folder, options);
  progress.finish();
  for (const auto& warning : result.summary.warnings) progress.say("  warning: " + warning);
  for (const auto& file : result.files) progress.say("  " + file.string());
}

}  // namespace

Scene load_scene(const SceneArguments& arguments) {
  std::vector<std::string> settings = arguments.settings;
  if (arguments.seed) settings.push_back(fmt::format("seed={}", *arguments.seed));
  if (arguments.accuracy) settings.push_back(fmt::format("run.accuracy={}", *arguments.accuracy));
  if (arguments.threads) settings.push_back(fmt::format("run.threads={}", *arguments.threads));
  Scene scene = read_scene(arguments.scene, settings);
  use_threads(scene.stages.front().run.threads);
  return scene;
}

void simulate_command(const SceneArguments& arguments, const fs::path& sample_path, const fs::path& out,
                      Beginning beginning, Verbosity verbosity) {
  const Scene scene = load_scene(arguments);
  require_run(scene);
  if (scene.stages.front().run.accuracy)
    throw SceneError("run.accuracy: takes several runs; use `lamella run`, or leave it out");
  require_writable_file(out);
  Progress progress(verbosity);
  if (beginning == Beginning::resumed && is_begun(out)) return resume_to(scene, out, progress);
  simulate_to(read_sample(sample_path), scene, out, progress);
  progress.say(out.string());
}

void extract_command(const fs::path& trajectory, int frame, const fs::path& out, Verbosity verbosity) {
  require_writable_file(out);
  const TrajectoryReader reader(trajectory);
  const Sample sample = extract_sample(reader, frame);
  make_folder(fs::absolute(out).parent_path());
  write_sample(out, sample);
  Progress(verbosity).say(fmt::format("{}: frame {} of {}, {} cells, {} nodes, {} links", out.string(),
                                      frame < 0 ? reader.frames() + frame : frame, reader.frames(), sample.cells(),
                                      sample.nodes(), sample.links.size()));
}

void post_command(const fs::path& trajectory, const fs::path& folder, Verbosity verbosity) {
  require_writable_folder(folder);
  Progress progress(verbosity);
  show_to(trajectory, folder, progress);
}

void run_command(const SceneArguments& arguments, const fs::path& folder, Beginning beginning, Verbosity verbosity) {
  const Scene scene = load_scene(arguments);
  require_run(scene);
  require_writable_folder(folder);
  Progress progress(verbosity);
  const fs::path trajectory = folder / "trajectory.h5";
  std::vector<Quantity> accuracy;
  if (beginning == Beginning::resumed && scene.stages.front().run.accuracy)
    throw SceneError("--resume: a run to an accuracy is several runs, and starts anew; leave --resume out");
  if (beginning == Beginning::resumed && is_begun(trajectory)) {
    resume_to(scene, trajectory, progress);
  } else {
    Origin origin;
    const Sample sample = generate_sample(scene, progress, &origin);
    start_up_summary(sample, scene);  // finds what does not fit, before anything on disk is touched
    make_folder(folder);
    write_sample(folder / "sample.h5", sample, origin.tiles);
    if (const auto accepted = scene.stages.front().run.accuracy) {
      say_summary(sample, scene, progress);
      const auto scene_at = [&](const std::vector<std::string>& settings) {
        SceneArguments at = arguments;
        at.settings.insert(at.settings.end(), settings.begin(), settings.end());
        return load_scene(at);
      };
      accuracy = run_to_accuracy(scene_at, sample, *accepted, folder, progress, [&] {
                   return simulate_options(progress);
                 }).quantities;
    } else {
      simulate_to(sample, scene, trajectory, progress);
    }
  }
  stop_if_interrupted();
  show_to(trajectory, folder, progress, accuracy);
}

void check_command(const SceneArguments& arguments, const fs::path& sample_path) {
  const Scene scene = load_scene(arguments);
  Progress progress(kNormal);
  const Sample sample = sample_path.empty() ? generate_sample(scene, progress) : read_sample(sample_path);
  progress.say(fmt::format("  {} cells, {} nodes, {} links", sample.cells(), sample.nodes(), sample.links.size()));
  if (scene.stages.front().loading || scene.stages.front().stop.time || scene.stages.front().stop.at_rest)
    say_summary(sample, scene, progress);
  progress.say(scene.path.string() + ": fine");
}

}  // namespace lamella
