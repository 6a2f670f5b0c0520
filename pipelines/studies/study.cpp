#include "pipelines/studies/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "generator/generate.h"
#include "generator/sample/errors.h"
#include "pipelines/studies/equilibrium.h"
#include "postproc/output_file.h"
#include "simulator/lowest_frequency.h"

namespace lamella {

std::vector<double> StudyRun::column(const std::string& name) const {
  const Response& response = reader.response();
  const auto at = std::find(response.columns.begin(), response.columns.end(), name);
  if (at == response.columns.end()) throw DataError(fmt::format("the response has no column '{}'", name));
  std::vector<double> values;
  values.reserve(response.rows.size());
  for (const auto& row : response.rows) values.push_back(row[static_cast<std::size_t>(at - response.columns.begin())]);
  return values;
}

std::vector<Vec2> StudyRun::positions(int frame) const {
  const Frame f = reader.frame(index(frame));
  return FrameView(reader.sample(), f).x;
}

std::vector<double> StudyRun::array(const std::string& name, int frame) const {
  return reader.frame(index(frame)).arrays.doubles(name);
}

double StudyRun::ledger() const {
  const auto residuals = column("residual");
  return *std::max_element(residuals.begin(), residuals.end());
}

Sample sample_of(const Scene& scene) {
  Notes notes;
  Sample sample = generate(scene, notes);
  const auto violations = check_sample(sample);
  if (!violations.empty()) throw SceneError(fmt::format("{}: sample: {}", scene.path.string(), violations.front()));
  return sample;
}

double lowest_frequency_of(const Sample& sample, const Scene& scene) {
  const Field rest = field_of(sample.x);
  const auto model = build_model(sample, scene.stages.front(), rest);
  const auto found = lowest_frequency(*model, build_loads(sample, scene.stages.front()), rest);
  if (!found) throw SolverError(fmt::format("{}: nothing swings in it", scene.path.string()));
  return *found;
}

Scene StudyBench::scene(const std::string& file, const std::vector<std::string>& settings) const {
  return read_scene(source_ / file, settings);
}

StudyRun StudyBench::run(const std::string& name, const std::string& file, const std::vector<std::string>& settings) {
  const Scene s = scene(file, settings);
  return run(name, sample_of(s), s);
}

StudyRun StudyBench::run(const std::string& name, const Sample& sample, const Scene& scene) {
  StudyRun done = attempt(name, sample, scene);
  if (!done.error.empty()) throw SolverError(fmt::format("{}: {}", name, done.error));
  return done;
}

StudyRun StudyBench::attempt(const std::string& name, const std::string& file,
                             const std::vector<std::string>& settings) {
  const Scene s = scene(file, settings);
  return attempt(name, sample_of(s), s);
}

StudyRun StudyBench::attempt(const std::string& name, const Sample& sample, const Scene& scene) {
  const std::filesystem::path path = out_ / "runs" / (name + ".h5");
  make_folder(path.parent_path());
  SimulateOptions options;
  options.interrupted = interrupted_;
  RunFacts facts;
  std::string error;
  {
    TrajectoryWriter writer(path, sample, {});
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    try {
      facts = simulate(sample, scene, writer, options);
      // The machine may have other work: what counts is the share of the time in which this process was at it.
      const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const double own = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
      if (own < wall) facts.seconds *= own / wall, facts.frame_seconds *= own / wall;
    } catch (const SolverError& gave_up) {
      error = gave_up.what();
    }
  }
  if (facts.interrupted) throw Interrupted("interrupted; the study starts anew next time");
  ++runs_;
  node_steps_ += static_cast<double>(facts.steps) * sample.nodes();
  say(fmt::format("  {}: {}; {} steps, {:.2f} s", name, error.empty() ? facts.ended : error, facts.steps,
                  facts.seconds + facts.frame_seconds));
  return {facts, error, TrajectoryReader(path)};
}

void StudyBench::say(const std::string& line) const {
  if (say_) say_(line);
}

const Study* find_study(const std::filesystem::path& folder) {
  std::filesystem::path path = std::filesystem::absolute(folder).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  for (const Study& study : studies())
    if (study.name == path.filename()) return &study;
  return nullptr;
}

}  // namespace lamella
