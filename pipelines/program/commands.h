// The subcommands, free of how arguments are parsed.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "generator/sample/scene.h"
#include "pipelines/program/progress.h"

namespace lamella {

struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::string> settings;  // --set
  std::optional<std::uint64_t> seed;
  std::optional<int> threads;
  std::optional<std::string> accuracy;  // "1%", "0.01"
};

/// Reads and validates the scene with --set, --seed, --threads and --accuracy over it. Its threads are in use from then on.
Scene load_scene(const SceneArguments& arguments);

enum class Beginning { afresh, resumed };

// Each throws SceneError, DataError, SolverError or Interrupted.
void simulate_command(const SceneArguments& arguments, const std::filesystem::path& sample,
                      const std::filesystem::path& out, Beginning beginning, Verbosity verbosity);
/// A frame's positions as a sample: extract_sample.
void extract_command(const std::filesystem::path& trajectory, int frame, const std::filesystem::path& out,
                     Verbosity verbosity);
void post_command(const std::filesystem::path& trajectory, const std::filesystem::path& folder, Verbosity verbosity);
/// Generates, simulates and shows, all in `folder`.
void run_command(const SceneArguments& arguments, const std::filesystem::path& folder, Beginning beginning,
                 Verbosity verbosity);
/// Does all of a run up to the first step, in memory. `sample` "": generated from the scene.
void check_command(const SceneArguments& arguments, const std::filesystem::path& sample);

}  // namespace lamella
