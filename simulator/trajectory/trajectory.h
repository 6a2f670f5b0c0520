// A trajectory: the sample, the frames of a run, its response curve, its events and the point to restart from.
// The simulator writes it, postproc reads it, and neither knows the other. HDF5 stays behind this header.
//
// While a run goes on, everything is written to a folder beside the target, `NAME.h5.parts/`, one small file per frame,
// each complete (written under a temporary name, flushed, renamed). `finish` merges the parts into NAME.h5, again by
// renaming. So Ctrl-C, kill -9 and a full disk cost at most the frame in progress, and an existing NAME.h5 is
// untouched until its successor is complete. Reading NAME.h5 when only its parts exist merges them first.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "generator/sample/sample.h"

namespace lamella {

/// Array with a name, as it goes to disk. `per` says what its rows are: "node", "cell", "segment", "link", "contact",
/// "grip" or "model". Vectors have components = 2 and are stored row by row.
struct NamedArray {
  std::string name;  // snake_case
  std::string unit;  // "Pa", "N/m", "1", ...
  std::string per;
  int components = 1;
  std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::int64_t>> data;
};

/// Arrays by name. `find` returns nullptr where the scene has no such thing; `doubles` and `ints` throw DataError.
class ArraySet {
 public:
  void add(NamedArray array);
  const NamedArray* find(const std::string& name) const;
  const std::vector<double>& doubles(const std::string& name) const;
  const std::vector<std::int32_t>& ints(const std::string& name) const;
  const std::vector<std::int64_t>& longs(const std::string& name) const;
  const std::vector<NamedArray>& all() const { return arrays_; }

 private:
  std::vector<NamedArray> arrays_;
};

/// One frame. Always present: "x" (node, 2 components, m). Present where the scene has the term: see docs/formats.md.
struct Frame {
  double time = 0;  // [s], continues through stages
  std::int64_t step = 0;
  std::int32_t stage = 0;
  ArraySet arrays;
};

/// The table of the response curve: one row per sample, columns by name ("time", "strain", "stress", ...).
struct Response {
  std::vector<std::string> columns;
  std::vector<std::string> units;
  std::vector<std::vector<double>> rows;
};

/// A break of a link, or of a bar of a wall.
struct Event {
  double time = 0;  // [s]
  std::int64_t step = 0;
  std::int32_t link = 0;         // index into Sample::links; -1: a bar broke
  std::int32_t bar = -1;         // the bar's segment (its first node); -1: a link broke
  Vec2 position = Vec2::Zero();  // midpoint of link or bar [m]
  double f_n = 0, f_t = 0;       // forces at break [N]; of a bar its tension and 0
  double mode_mix = 0;           // atan2(|f_t / f_t0|, f_n / f_n0) [rad]: 0 pure opening, pi/2 pure shear
  double energy = 0;             // released, booked as fracture [J]
  double strain = 0;             // nominal strain at break
  std::int32_t stage = 0;
  // At rest, where loads wait for one break after the other; -1 in time.
  std::int64_t avalanche = -1;  // of which it is part, counted in the stage
  std::int64_t place = -1;      // in it
  double released = 0;          // energy that was free to become motion after it [J]
};

/// Text facts of the run: version, compiler, scene text, effective values, limits, warnings. Sorted by key.
using Provenance = std::map<std::string, std::string>;

/// Writes a run to PATH through PATH.parts/. Throws DataError, with the system's reason, when a file cannot be written.
class TrajectoryWriter {
 public:
  /// Starts a new run (removes parts of an earlier, unfinished one). Creates the folder at once, so that an unwritable target
  /// is found before anything is computed.
  TrajectoryWriter(std::filesystem::path path, const Sample& sample, const Provenance& provenance);
  /// Continues the run in `path`: keeps all it has, up to its last frame. Unfinished parts are newer than `path` and go first.
  static TrajectoryWriter resume(std::filesystem::path path);
  TrajectoryWriter(TrajectoryWriter&&) noexcept;
  ~TrajectoryWriter();

  // Where a resumed run stands: ask here rather than a reader, which would read `path` even beside newer parts.
  int frames() const;
  Sample sample() const;
  const Provenance& provenance() const;
  const std::vector<std::string>& response_columns() const;
  const std::string& ended() const;  // "interrupted" for parts; empty in a new run
  Frame last_frame() const;          // throws DataError when there is none
  ArraySet restart() const;          // state at the last frame

  void set_response_columns(std::vector<std::string> columns, std::vector<std::string> units);
  void add_response(const std::vector<double>& row);  // kept in memory until the next frame
  void add_event(const Event& event);                 // likewise
  void set_provenance(const std::string& key, const std::string& value);
  /// Writes the frame, the response rows and events since the last one, and the state to restart from (it replaces the
  /// last one). Complete on disk when it returns.
  void write_frame(const Frame& frame, const ArraySet& restart);
  /// Merges everything into PATH and removes the parts. `ended` says why the run ended ("strain reached", "interrupted").
  void finish(const std::string& ended);

 private:
  struct Impl;
  explicit TrajectoryWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Reads a trajectory, frame by frame. Throws DataError with one sentence when PATH is missing, truncated, of another
/// version, or inconsistent (array of wrong length, NaN, times that do not increase).
class TrajectoryReader {
 public:
  explicit TrajectoryReader(std::filesystem::path path);
  TrajectoryReader(TrajectoryReader&&) noexcept;
  ~TrajectoryReader();

  const Sample& sample() const;
  const Provenance& provenance() const;
  const std::string& ended() const;
  const Response& response() const;
  const std::vector<Event>& events() const;
  int frames() const;
  Frame frame(int index) const;
  ArraySet restart() const;  // state at the last frame

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lamella
