#include "simulator/simulate.h"

#include <fmt/format.h>

#include "generator/sample/errors.h"
#include "simulator/stage.h"

namespace lamella {
namespace {

/// Runs stages from `first` on. `start`: where stage `first` starts.
RunFacts run_stages(const Sample& sample, const Scene& scene, TrajectoryWriter& writer, const SimulateOptions& options,
                    int first, const ArraySet& start, StageStart how, const std::vector<std::string>& columns) {
  RunFacts facts;
  std::map<std::string, ArraySet> ends;  // last frame of each stage, by name
  ArraySet from = start;
  for (int s = first; s < static_cast<int>(scene.stages.size()); ++s) {
    const Stage& stage = scene.stages[s];
    if (s > first && !stage.from.empty() && stage.from != scene.stages[s - 1].name) {
      const auto at = ends.find(stage.from);
      if (at == ends.end())
        throw SceneError(fmt::format(
            "stages: stage '{}' continues '{}', whose end is not at hand; it must have run before, in this run",
            stage.name, stage.from));
      from = at->second;
    }
    const auto run = make_stage(sample, scene, s, from, s > first ? StageStart::kContinued : how);
    for (const auto& line : run->summary())
      if (options.say) options.say(line);
    facts.ended = run->run(writer, options, columns, facts);
    if (facts.interrupted) break;
    from = run->last();
    ends[stage.name] = from;
  }
  facts.node_steps = facts.seconds > 0 ? static_cast<double>(facts.timed_steps) * sample.nodes() / facts.seconds : 0.0;
  writer.set_provenance("ended", facts.ended);
  writer.set_provenance("steps", std::to_string(facts.steps));
  writer.set_provenance("seconds_stepping", fmt::format("{:.3f}", facts.seconds));
  writer.set_provenance("seconds_frames_and_rows", fmt::format("{:.3f}", facts.frame_seconds));
  writer.set_provenance("node_steps_per_second", fmt::format("{:.4g}", facts.node_steps));
  writer.finish(facts.ended);
  return facts;
}

/// Columns and provenance of all stages, each built once on the sample at rest: scene and sample are found to fit, or not, before
/// anything is computed.
void prepare(const Sample& sample, const Scene& scene, std::vector<std::string>& columns,
             std::vector<std::string>& units, Provenance& provenance) {
  for (int s = 0; s < static_cast<int>(scene.stages.size()); ++s) {
    const auto run = make_stage(sample, scene, s, ArraySet{}, StageStart::kFresh);
    run->columns(columns, units);
    run->describe(provenance);
  }
}

}  // namespace

RunFacts simulate(const Sample& sample, const Scene& scene, TrajectoryWriter& writer, const SimulateOptions& options) {
  std::vector<std::string> columns, units;
  Provenance provenance;
  prepare(sample, scene, columns, units, provenance);
  provenance["title"] = scene.title;
  provenance["scene"] = scene.text;
  provenance["scene_file"] = scene.path.filename().string();
  provenance["seed"] = std::to_string(scene.seed);
  std::string overrides;
  for (const auto& o : scene.overrides) overrides += o + "\n";
  provenance["overrides"] = overrides;
  provenance["compiler"] = "g++ " __VERSION__;
  provenance["version"] = LAMELLA_VERSION;
  for (const auto& [key, value] : provenance) writer.set_provenance(key, value);
  writer.set_response_columns(columns, units);
  return run_stages(sample, scene, writer, options, 0, ArraySet{}, StageStart::kFresh, columns);
}

RunFacts resume(const std::filesystem::path& path, const SimulateOptions& options) {
  auto writer = TrajectoryWriter::resume(path);
  if (!writer.ended().empty() && writer.ended() != "interrupted") {  // complete already
    RunFacts facts;
    facts.ended = writer.ended();
    writer.finish(facts.ended);
    return facts;
  }
  const auto provenance = writer.provenance();
  const auto fact = [&](const std::string& key) {
    const auto at = provenance.find(key);
    return at == provenance.end() ? std::string() : at->second;
  };
  if (fact("scene").empty())
    throw DataError(path.string() + ": holds no scene, so it cannot be resumed; simulate again");
  if (writer.frames() == 0) throw DataError(path.string() + ": was interrupted before its first frame; simulate again");
  std::vector<std::string> overrides;
  const std::string lines = fact("overrides");
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = lines.find('\n', at);
    overrides.push_back(lines.substr(at, end - at));
    at = end + 1;
  }
  Scene scene = parse_scene(fact("scene"), fact("scene_file"), overrides);
  const Sample sample = writer.sample();
  const ArraySet restart = writer.restart();
  const std::vector<std::string> columns = writer.response_columns();
  const int stage = static_cast<int>(restart.doubles("clock").at(2));
  if (stage < 0 || stage >= static_cast<int>(scene.stages.size()))
    throw DataError(
        fmt::format("{}: its restart is of stage {}, and its scene has {}", path.string(), stage, scene.stages.size()));
  return run_stages(sample, scene, writer, options, stage, restart, StageStart::kResumed, columns);
}

std::vector<std::string> start_up_summary(const Sample& sample, const Scene& scene) {
  std::vector<std::string> lines;
  for (int s = 0; s < static_cast<int>(scene.stages.size()); ++s)
    for (auto& line : make_stage(sample, scene, s, ArraySet{}, StageStart::kFresh)->summary())
      lines.push_back(std::move(line));
  return lines;
}

}  // namespace lamella
