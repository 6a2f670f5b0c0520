#include "pipelines/program/writable.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "generator/sample/errors.h"

namespace lamella {
namespace fs = std::filesystem;

void require_writable_folder(const fs::path& path) {
  fs::path standing = fs::absolute(path).lexically_normal();
  std::error_code error;
  while (!fs::exists(fs::symlink_status(standing, error)) && standing.has_relative_path())
    standing = standing.parent_path();
  if (!fs::is_directory(standing, error))
    throw DataError(fmt::format("{}: {} is not a folder; give the path of a folder", path.string(), standing.string()));
  if (access(standing.c_str(), W_OK | X_OK) != 0)
    throw DataError(fmt::format("{}: cannot write in {}: {}; give a folder that you may write to", path.string(),
                                standing.string(), std::strerror(errno)));
}

void require_writable_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error))
    throw DataError(fmt::format("{}: is a folder; give the name of a file", path.string()));
  if (!path.has_filename()) throw DataError(fmt::format("{}: names no file", path.string()));
  require_writable_folder(fs::absolute(path).parent_path());
}

}  // namespace lamella
