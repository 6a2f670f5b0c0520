// The subcommands that make samples and hand them to other programs.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "generator/generate.h"
#include "pipelines/program/commands.h"

namespace lamella {

/// The scene's sample, sound; its notes are said. Throws SceneError, Interrupted.
Sample generate_sample(const Scene& scene, Progress& progress, Origin* origin = nullptr, Notes* notes = nullptr);

struct GenerateArguments {
  SceneArguments scene;
  std::filesystem::path out;                   // the sample
  std::vector<std::filesystem::path> exports;  // tiles (or outlines) for other programs, formats by their endings
  std::filesystem::path report;                // folder; empty: no report
  std::optional<int> threads;                  // instead of the scene's; a scene that has no run can say none
};
void generate_command(const GenerateArguments& arguments, Verbosity verbosity);

/// Writes the cells of a sample, or of a frame of a trajectory, in the format of `out`'s ending. `of`: "tiles",
/// "outlines", or "" for tiles where the file has them and outlines where not, and always outlines in a picture.
void export_command(const std::filesystem::path& from, const std::string& of, int frame,
                    const std::filesystem::path& out, Verbosity verbosity);

}  // namespace lamella
