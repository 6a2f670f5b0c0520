#include "postproc/output_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "generator/sample/errors.h"

namespace lamella {

void replace_output(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write) {
  // The ending stays the last part of the name: some libraries choose the format by it.
  const std::filesystem::path temporary =
      path.parent_path() / ("." + path.stem().string() + ".part" + path.extension().string());
  std::error_code ignored;
  try {
    write(temporary);
    std::error_code failure;
    std::filesystem::rename(temporary, path, failure);
    if (failure) throw DataError(path.string() + ": cannot be written: " + failure.message());
  } catch (...) {
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

void write_text_file(const std::filesystem::path& path, const std::string& text) {
  replace_output(path, [&](const std::filesystem::path& temporary) {
    errno = 0;
    std::ofstream file(temporary, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file) throw DataError(path.string() + ": cannot be written: " + std::strerror(errno ? errno : EIO));
  });
}

std::string read_binary_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw DataError(path.string() + ": cannot be read");
  return text.str();
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw DataError(folder.string() + ": cannot be made: " + failure.message());
}

}  // namespace lamella
