// Studies: questions to the program whose answers are known. Each is a folder of pipelines/ with its scenes, a page for people, and one
// function that runs the scenes and reports what it found beside what is exact.
#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "generator/sample/sample.h"
#include "generator/sample/scene.h"
#include "pipelines/studies/report.h"
#include "postproc/frame_view.h"
#include "simulator/simulate.h"
#include "simulator/trajectory/trajectory.h"

namespace lamella {

/// A finished run and easy ways into its numbers.
struct StudyRun {
  RunFacts facts;
  std::string error;  // what the numerics said when they gave up; empty: the run ended as its scene asked
  TrajectoryReader reader;

  /// A column of the response. Throws DataError when there is none.
  std::vector<double> column(const std::string& name) const;
  double last(const std::string& name) const { return column(name).back(); }
  /// Positions of the nodes in a frame; -1: the last.
  std::vector<Vec2> positions(int frame = -1) const;
  /// An array of a frame. Throws DataError when there is none.
  std::vector<double> array(const std::string& name, int frame = -1) const;
  /// Largest residual of the energy ledger over the rows.
  double ledger() const;

  int index(int frame) const { return frame < 0 ? reader.frames() + frame : frame; }
};

enum class StudySize { kFull, kSmall };  // small: a few seconds, for the tests

class StudyBench {
 public:
  /// `source`: the study's folder in pipelines/. `out`: where its results go; it is there.
  StudyBench(std::filesystem::path source, const std::filesystem::path& out, StudySize size,
             const std::atomic<bool>* interrupted, std::function<void(const std::string&)> say)
      : report(out),
        source_(std::move(source)),
        out_(out),
        size_(size),
        interrupted_(interrupted),
        say_(std::move(say)) {}

  StudyReport report;

  bool small() const { return size_ == StudySize::kSmall; }
  const std::filesystem::path& out() const { return out_; }
  /// The scene of that file of the study's folder, `settings` ("section.key=value") put over it.
  Scene scene(const std::string& file, const std::vector<std::string>& settings = {}) const;
  /// Generates and simulates the scene into OUT/runs/NAME.h5. Throws what the numerics throw.
  StudyRun run(const std::string& name, const std::string& file, const std::vector<std::string>& settings = {});
  /// The same with a sample of one's own.
  StudyRun run(const std::string& name, const Sample& sample, const Scene& scene);
  /// The same where the numerics may give up: then `error` of the run says how, and its frames are those up to there.
  StudyRun attempt(const std::string& name, const std::string& file, const std::vector<std::string>& settings = {});
  StudyRun attempt(const std::string& name, const Sample& sample, const Scene& scene);

  /// A line for whoever watches.
  void say(const std::string& line) const;

  /// Sums over all runs so far.
  double node_steps() const { return node_steps_; }
  int runs() const { return runs_; }

 private:
  std::filesystem::path source_, out_;
  StudySize size_;
  const std::atomic<bool>* interrupted_;
  std::function<void(const std::string&)> say_;
  double node_steps_ = 0;
  int runs_ = 0;
};

struct Study {
  std::string name;      // of its folder
  std::string question;  // one sentence, for the overview
  void (*run)(StudyBench& bench) = nullptr;
};

/// All studies, in the order of the overview.
const std::vector<Study>& studies();
/// The study of a folder such as pipelines/beams; nullptr where there is none.
const Study* find_study(const std::filesystem::path& folder);

/// Makes the sample of a scene and checks it. Throws SceneError.
Sample sample_of(const Scene& scene);
/// Lowest frequency [rad/s] of a sample under the first stage of a scene, at rest: what "slow" means for it. Throws SolverError where nothing
/// swings.
double lowest_frequency_of(const Sample& sample, const Scene& scene);

}  // namespace lamella
