// Runs side by side, as a subcommand.
#pragma once
#include <filesystem>
#include <vector>

#include "pipelines/program/progress.h"

namespace lamella {

/// Writes comparison.csv, comparison.png and comparison.pdf into `out`, from folders that `run` wrote. Throws DataError.
void compare_command(const std::vector<std::filesystem::path>& runs, const std::filesystem::path& out,
                     Verbosity verbosity);

}  // namespace lamella
