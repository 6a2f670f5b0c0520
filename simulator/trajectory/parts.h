// The folder NAME.h5.parts/ of a run that is not finished: its files, its lock, and how they become NAME.h5.
//
//   run.h5             response columns, provenance, frames that NAME.h5 already has; written last, removed first: a
//                      folder without it holds no run
//   sample.h5          the sample
//   frame_000012.h5    one frame, with the response rows and events since the one before
//   restart_000012.h5  state at that frame; written before the frame, removed after the next one
//   lock               held by the program that writes, with its process number
//
// Every file is complete, because it is written under a temporary name and renamed. So the run is, at any time, its frames
// without a gap, and the state to restart from is there for the last of them.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "simulator/trajectory/tables.h"
#include "simulator/trajectory/trajectory.h"

namespace lamella {

/// The names of the files.
struct Parts {
  explicit Parts(const std::filesystem::path& target) : path(target), folder(target.string() + ".parts") {}

  std::filesystem::path path, folder;

  std::filesystem::path run() const { return folder / "run.h5"; }
  std::filesystem::path sample() const { return folder / "sample.h5"; }
  std::filesystem::path lock() const { return folder / "lock"; }
  std::filesystem::path frame(int index) const;
  std::filesystem::path restart(int index) const;

  bool hold_a_run() const;
  /// Frames in the folder from `first` on, up to the first that is missing.
  int count_frames(int first) const;
  /// Removes every file of ours except the lock, run.h5 first.
  void clear() const;
  /// Removes the folder too, if nothing else is in it.
  void remove() const;
};

/// Keeps a second program away from the folder. The system lets go of it when the program ends, however it ends.
class PartsLock {
 public:
  /// Makes the folder if it is missing. Throws DataError when another program, named by its process number, holds it.
  explicit PartsLock(const Parts& parts);
  PartsLock(const PartsLock&) = delete;
  PartsLock& operator=(const PartsLock&) = delete;
  ~PartsLock();

 private:
  int descriptor_ = -1;
};

/// Content of run.h5.
struct Run {
  int base_frames = 0;  // that NAME.h5 has already; the parts continue from there
  std::vector<std::string> columns, units;
  Provenance provenance;
};
void write_run(const Parts& parts, const Run& run);
Run read_run(const Parts& parts);

/// Content of a frame's file, but for the arrays.
struct FramePart {
  Instant instant;
  std::vector<std::vector<double>> rows;  // of the response curve
  std::vector<Event> events;
};
void write_frame_part(const std::filesystem::path& file, const Frame& frame, const FramePart& part,
                      std::size_t columns);
FramePart read_frame_part(const std::filesystem::path& file, std::size_t columns);
Frame read_frame_of_part(const std::filesystem::path& file);

/// Writes NAME.h5 from the frames of its predecessor, if the run continues it, and the parts, one frame in memory at a
/// time. `tail` are rows and events after the last frame: the curve is complete, and a resumed run computes them again.
void merge_parts(const Parts& parts, const Run& run, const FramePart& tail, const std::string& ended);

/// Name of a frame's group in NAME.h5.
std::string frame_name(int index);

constexpr const char* kTrajectoryFormat = "lamella trajectory 1";
void check_trajectory_format(const h5::Node& file);

}  // namespace lamella
