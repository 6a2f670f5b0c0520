// Whether the output can be written, found before anything is computed and without leaving a trace.
#pragma once
#include <filesystem>

namespace lamella {

/// Throws DataError when no file can be made at `path`.
void require_writable_file(const std::filesystem::path& path);
/// Throws DataError when `path` is not a folder and cannot become one, or no file can be made in it.
void require_writable_folder(const std::filesystem::path& path);

}  // namespace lamella
