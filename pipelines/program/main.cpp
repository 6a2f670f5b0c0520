// The lamella program: its subcommands and their arguments. The only file that sees CLI11.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <thread>

#include "pipelines/program/commands.h"
#include "pipelines/program/compare.h"
#include "pipelines/program/ensemble.h"
#include "pipelines/program/exit_status.h"
#include "pipelines/program/generating.h"
#include "pipelines/program/interrupt.h"
#include "pipelines/program/study.h"
#include "pipelines/tissue/export.h"

namespace lamella {
namespace {

/// What the subcommands read from the command line.
struct Arguments {
  SceneArguments scene;
  std::filesystem::path out, sample, trajectory, accuracy;
  std::vector<std::filesystem::path> runs, exports;
  std::filesystem::path report;
  std::optional<int> threads;
  std::string of;
  std::string seeds;
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  int frame = -1;
  StudyArguments study;
  bool quiet = false, resume = false, markdown = false, small = false;

  Verbosity verbosity() const { return quiet ? Verbosity::quiet : Verbosity::normal; }
  Beginning beginning() const { return resume ? Beginning::resumed : Beginning::afresh; }
};

CLI::App* subcommand(CLI::App& app, const char* name, const char* sentence, const char* example) {
  CLI::App* command = app.add_subcommand(name, sentence);
  command->footer(fmt::format("Example:\n  {}", example));
  return command;
}

CLI::Option* add_scene(CLI::App* command, Arguments& arguments) {
  CLI::Option* scene = command->add_option("SCENE", arguments.scene.scene, "Scene file (TOML)");
  command->add_option("--set", arguments.scene.settings, "key=value over the scene, such as loading.strain=0.2")
      ->allow_extra_args(false);
  command->add_option("--seed", arguments.scene.seed, "Seed of all random numbers, instead of the scene's")
      ->check(CLI::NonNegativeNumber);
  return scene;
}

CLI::Option* add_out(CLI::App* command, Arguments& arguments, const char* sentence) {
  return command->add_option("-o,--output", arguments.out, sentence)->required();
}

void add_running(CLI::App* command, Arguments& arguments) {
  command->add_option("--threads", arguments.scene.threads,
                      "Threads, of the generator too; the result does not depend on it");
  command->add_flag("--resume", arguments.resume, "Go on from the last frame of an interrupted run");
}

void add_quiet(CLI::App* command, Arguments& arguments) {
  command->add_flag("-q,--quiet", arguments.quiet, "Print nothing but errors");
}

int run_program(int argc, char** argv) {
  CLI::App app("lamella generates 2D samples of cellular tissue, loads them until they fracture, and shows how.",
               "lamella");
  app.require_subcommand(1);
  app.footer("`lamella SUBCOMMAND --help` explains each. Example:\n  lamella run scene.toml -o results");
  Arguments a;

  CLI::App* run = subcommand(app, "run", "Generate, simulate and show, all in one folder",
                             "lamella run scene.toml -o results --set loading.strain=0.2\n"
                             "  lamella run scene.toml -o results --accuracy 1%\n"
                             "  lamella run scene.toml -o results --seeds 1-10 --jobs 2");
  add_scene(run, a)->required();
  add_out(run, a, "Folder of the results");
  add_running(run, a);
  add_quiet(run, a);
  CLI::Option* accuracy = run->add_option(
      "--accuracy", a.scene.accuracy,
      "Error of the largest load that you accept, such as 1%: pace, damping and step are chosen, the error estimated");
  accuracy->excludes("--resume");
  CLI::Option* seeds =
      run->add_option("--seeds", a.seeds, "A range A-B: one run for each, then mean and deviation")->excludes("--seed");
  run->add_option("--jobs", a.jobs, "Runs at once, with --seeds")
      ->check(CLI::Range(1, 1024))
      ->needs(seeds)
      ->capture_default_str();

  CLI::App* generate = subcommand(app, "generate", "Make a sample",
                                  "lamella generate scene.toml -o sample.h5 --seed 7\n"
                                  "  lamella generate scene.toml -o sample.h5 --export cells.tess --report statistics");
  add_scene(generate, a)->required();
  add_out(generate, a, "Sample to write (HDF5)");
  generate->add_option("--export", a.exports, fmt::format("Cells for other programs as well: {}", kExportEndings))
      ->allow_extra_args(false);
  generate->add_option("--report", a.report, "Folder for statistics of the sample, with pictures");
  generate->add_option("--threads", a.threads, "Threads of the generator; the result does not depend on it")
      ->check(CLI::Range(1, 256));
  add_quiet(generate, a);

  CLI::App* simulate =
      subcommand(app, "simulate", "Load a sample", "lamella simulate scene.toml --sample sample.h5 -o trajectory.h5");
  add_scene(simulate, a)->required();
  simulate->add_option("--sample", a.sample, "Sample to load (HDF5)")->required();
  add_out(simulate, a, "Trajectory to write (HDF5)");
  add_running(simulate, a);
  add_quiet(simulate, a);

  CLI::App* extract = subcommand(app, "extract", "Make a frame of a trajectory a sample for other scenes",
                                 "lamella extract trajectory.h5 -o sample.h5 --frame 20");
  extract->add_option("TRAJECTORY", a.trajectory, "Trajectory (HDF5)")->required();
  add_out(extract, a, "Sample to write (HDF5)");
  extract->add_option("--frame", a.frame, "Which, from 0; negative: from the end")->capture_default_str();
  add_quiet(extract, a);

  CLI::App* exporting = subcommand(app, "export", "Write the cells of a sample for other programs",
                                   "lamella export sample.h5 -o cells.off\n"
                                   "  lamella export trajectory.h5 -o cells.vtp --frame 20");
  exporting->add_option("FILE", a.sample, "Sample or trajectory (HDF5)")->required();
  add_out(exporting, a, "File to write, in the format of its ending");
  exporting->add_option("--of", a.of, "What: tiles (before walls are inset) or outlines; tiles where there are any")
      ->check(CLI::IsMember({"tiles", "outlines"}));
  exporting->add_option("--frame", a.frame, "Of a trajectory, from 0; negative: from the end")->capture_default_str();
  add_quiet(exporting, a);

  CLI::App* post = subcommand(app, "post", "Show a trajectory: ParaView files, tables, pictures, report",
                              "lamella post trajectory.h5 -o results");
  post->add_option("TRAJECTORY", a.trajectory, "Trajectory (HDF5)")->required();
  add_out(post, a, "Folder of the results");
  add_quiet(post, a);

  CLI::App* compare = subcommand(app, "compare", "Show runs side by side: one table of their numbers, one chart",
                                 "lamella compare elastic plastic -o both");
  compare->add_option("RUN", a.runs, "Folders that `lamella run` wrote")->required();
  add_out(compare, a, "Folder of the comparison");
  add_quiet(compare, a);

  CLI::App* study = subcommand(app, "study", "Run studies of pipelines/ and compare their numbers with exact ones",
                               "lamella study pipelines/beams -o results\n"
                               "  lamella study pipelines/beams pipelines/friction -o results --page verification.md");
  study->add_option("FOLDER", a.study.folders, "Folders of studies")->required();
  study->add_option("-o,--output", a.study.out, "Folder of the results, one folder in it for each study")->required();
  study->add_option("--page", a.study.page, "One page of all of them (Markdown), its pictures in a folder beside it");
  study->add_flag("--small", a.small, "Fewer and smaller runs: a few seconds");
  study->add_option("--jobs", a.study.jobs, "Studies at once")->check(CLI::Range(1, 1024))->capture_default_str();
  add_quiet(study, a);

  CLI::App* accuracy_study =
      subcommand(app, "accuracy", "Measure error against cost of every method and resolution, and recommend settings",
                 "lamella accuracy pipelines/accuracy -o results --page accuracy.md");
  accuracy_study->add_option("FOLDER", a.accuracy, "Folder of the study's scenes, pipelines/accuracy")->required();
  accuracy_study->add_option("-o,--output", a.study.out, "Folder of the results")->required();
  accuracy_study->add_option("--page", a.study.page, "Page to write (Markdown), its pictures in a folder beside it");
  accuracy_study->add_flag("--small", a.small, "Fewer and smaller runs: a few seconds");
  add_quiet(accuracy_study, a);

  CLI::App* describe =
      subcommand(app, "describe", "List every parameter of a scene: unit, range, default", "lamella describe | less");
  describe->add_flag("--markdown", a.markdown, "As the page docs/scene_reference.md");

  CLI::App* check = subcommand(app, "check", "Validate a scene and all that it names, up to the first step",
                               "lamella check scene.toml");
  add_scene(check, a)->required();
  check->add_option("--sample", a.sample, "Sample that the scene is for, instead of its own");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  listen_for_interrupts();
  int status = 0;
  const int caught = exit_status_of("lamella", [&] {
    if (run->parsed() && !a.seeds.empty())
      status = ensemble_command(a.scene, parse_seeds(a.seeds), a.jobs, a.out, a.beginning(), a.verbosity());
    else if (run->parsed())
      run_command(a.scene, a.out, a.beginning(), a.verbosity());
    else if (generate->parsed())
      generate_command({a.scene, a.out, a.exports, a.report, a.threads}, a.verbosity());
    else if (simulate->parsed())
      simulate_command(a.scene, a.sample, a.out, a.beginning(), a.verbosity());
    else if (extract->parsed())
      extract_command(a.trajectory, a.frame, a.out, a.verbosity());
    else if (exporting->parsed())
      export_command(a.sample, a.of, a.frame, a.out, a.verbosity());
    else if (post->parsed())
      post_command(a.trajectory, a.out, a.verbosity());
    else if (compare->parsed())
      compare_command(a.runs, a.out, a.verbosity());
    else if (study->parsed()) {
      a.study.size = a.small ? StudySize::kSmall : StudySize::kFull;
      status = study_command(a.study, a.verbosity());
    } else if (accuracy_study->parsed()) {
      a.study.size = a.small ? StudySize::kSmall : StudySize::kFull;
      status = accuracy_command(a.accuracy, a.study, a.verbosity());
    } else if (check->parsed())
      check_command(a.scene, a.sample);
    else if (describe->parsed())
      std::fputs((a.markdown ? scene_reference() : describe_scene()).c_str(), stdout);
  });
  return caught != 0 ? caught : status;
}

}  // namespace
}  // namespace lamella

int main(int argc, char** argv) { return lamella::run_program(argc, argv); }
