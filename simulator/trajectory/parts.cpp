#include "simulator/trajectory/parts.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "generator/sample/errors.h"
#include "generator/sample/sample_file.h"

namespace lamella {
namespace {

namespace fs = std::filesystem;

std::string holder(const fs::path& lock) {
  char text[32] = {};
  const int descriptor = ::open(lock.c_str(), O_RDONLY | O_CLOEXEC);
  const auto length = descriptor < 0 ? 0 : ::read(descriptor, text, sizeof text - 1);
  if (descriptor >= 0) ::close(descriptor);
  return length > 0 ? std::string(text, text + length) : "unknown";
}

/// The file may have been removed, with its folder, between opening and locking.
bool is_still_there(int descriptor, const fs::path& path) {
  struct stat mine {
  }, there{};
  return ::fstat(descriptor, &mine) == 0 && ::stat(path.c_str(), &there) == 0 && mine.st_ino == there.st_ino &&
         mine.st_dev == there.st_dev;
}

}  // namespace

fs::path Parts::frame(int index) const { return folder / fmt::format("frame_{:06d}.h5", index); }
fs::path Parts::restart(int index) const { return folder / fmt::format("restart_{:06d}.h5", index); }

bool Parts::hold_a_run() const {
  std::error_code error;
  return fs::exists(run(), error);
}

int Parts::count_frames(int first) const {
  std::error_code error;
  int count = 0;
  while (fs::exists(frame(first + count), error)) ++count;
  return count;
}

void Parts::clear() const {
  std::error_code error;
  if (fs::remove(run(), error)) h5::sync_folder(folder);
  std::vector<fs::path> ours;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with("frame_") || name.starts_with("restart_") || name == "sample.h5" || name.ends_with(".tmp"))
      ours.push_back(entry->path());
  }
  for (const auto& file : ours) fs::remove(file, error);
}

void Parts::remove() const {
  std::error_code error;
  clear();
  fs::remove(lock(), error);
  fs::remove(folder, error);
  h5::sync_folder(path.parent_path());
}

PartsLock::PartsLock(const Parts& parts) {
  while (true) {
    std::error_code error;
    fs::create_directory(parts.folder, error);
    if (error) throw DataError(fmt::format("{} cannot be written: {}", parts.folder.string(), error.message()));
    descriptor_ = ::open(parts.lock().c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor_ < 0 && errno == ENOENT) continue;  // another program has just removed the folder
    if (descriptor_ < 0)
      throw DataError(fmt::format("{} cannot be written: {}", parts.folder.string(), std::strerror(errno)));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(descriptor_);
      throw DataError(fmt::format("{} is being written by another program (process {}), which must end first",
                                  parts.path.string(), holder(parts.lock())));
    }
    if (is_still_there(descriptor_, parts.lock())) break;
    ::close(descriptor_);
  }
  const std::string process = std::to_string(::getpid());
  if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, process.data(), process.size(), 0) < 0) {
    const std::string why = std::strerror(errno);
    ::close(descriptor_);
    throw DataError(fmt::format("{} cannot be written: {}", parts.lock().string(), why));
  }
}

PartsLock::~PartsLock() { ::close(descriptor_); }

void write_run(const Parts& parts, const Run& run) {
  h5::replace_file(parts.run(), [&](h5::Node& file) {
    file.write_text("format", kTrajectoryFormat);
    file.write_integer("base_frames", run.base_frames);
    file.write_texts("columns", run.columns);
    file.write_texts("units", run.units);
    auto provenance = file.make_group("provenance");
    write_provenance(provenance, run.provenance);
  });
}

Run read_run(const Parts& parts) {
  const auto file = h5::Node::open(parts.run());
  check_trajectory_format(file);
  Run run;
  run.base_frames = static_cast<int>(file.integer("base_frames"));
  run.columns = file.texts("columns");
  run.units = file.texts("units");
  run.provenance = read_provenance(file.group("provenance"));
  if (run.base_frames < 0 || run.units.size() != run.columns.size())
    throw DataError(fmt::format("{} contradicts itself; the run must be started anew", parts.run().string()));
  return run;
}

void write_frame_part(const fs::path& path, const Frame& frame, const FramePart& part, std::size_t columns) {
  h5::replace_file(path, [&](h5::Node& file) {
    file.write_number("time", frame.time);
    file.write_integer("step", frame.step);
    file.write_integer("stage", frame.stage);
    auto arrays = file.make_group("frame");
    write_arrays(arrays, frame.arrays);
    std::vector<double> rows;
    for (const auto& row : part.rows) rows.insert(rows.end(), row.begin(), row.end());
    if (columns > 0) file.write("response", rows, static_cast<int>(columns));
    auto events = file.make_group("events");
    write_events(events, part.events);
  });
}

FramePart read_frame_part(const fs::path& path, std::size_t columns) {
  const auto file = h5::Node::open(path);
  FramePart part;
  part.instant = {file.number("time"), file.integer("step"), static_cast<std::int32_t>(file.integer("stage"))};
  if (columns > 0 && file.has("response")) {
    const auto rows = file.doubles("response", static_cast<int>(columns));
    for (auto row = rows.begin(); row != rows.end(); row += static_cast<std::ptrdiff_t>(columns))
      part.rows.emplace_back(row, row + static_cast<std::ptrdiff_t>(columns));
  }
  part.events = read_events(file.group("events"));
  return part;
}

Frame read_frame_of_part(const fs::path& path) {
  const auto file = h5::Node::open(path);
  return {file.number("time"), file.integer("step"), static_cast<std::int32_t>(file.integer("stage")),
          read_arrays(file.group("frame"))};
}

std::string frame_name(int index) { return fmt::format("{:06d}", index); }

void check_trajectory_format(const h5::Node& file) {
  if (!file.has_attribute("format"))
    throw DataError(fmt::format("{} is not a trajectory: its attribute 'format' is missing; must be '{}'", file.where(),
                                kTrajectoryFormat));
  if (const auto format = file.text("format"); format != kTrajectoryFormat)
    throw DataError(fmt::format("{} is of the format '{}'; must be '{}'", file.where(), format, kTrajectoryFormat));
}

}  // namespace lamella
