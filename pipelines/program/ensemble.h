// The same scene with many seeds: each run in a process and a folder of its own, then mean and deviation of every number.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "pipelines/program/commands.h"

namespace lamella {

struct SeedRange {
  std::uint64_t first = 1, last = 1;
};
/// "1-10". Throws SceneError.
SeedRange parse_seeds(const std::string& text);

/// Runs into folder/seed_N, at most `jobs` at once; prints the statistics and writes them to folder/ensemble.json and
/// folder/ensemble.csv. Returns 0, or the exit status of the first run that failed.
int ensemble_command(const SceneArguments& arguments, const SeedRange& seeds, int jobs,
                     const std::filesystem::path& folder, Beginning beginning, Verbosity verbosity);

}  // namespace lamella
