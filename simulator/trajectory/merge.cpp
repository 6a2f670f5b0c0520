// How the parts of a run become one file.
#include <fmt/format.h>

#include "generator/sample/errors.h"
#include "generator/sample/sample_file.h"
#include "simulator/trajectory/parts.h"

namespace lamella {
namespace {

/// What is collected while the frames are copied.
struct Collected {
  std::vector<double> time;
  std::vector<std::int64_t> step;
  std::vector<std::int32_t> stage;
  Response response;
  std::vector<Event> events;

  void add(const FramePart& part) {
    time.push_back(part.instant.time), step.push_back(part.instant.step), stage.push_back(part.instant.stage);
    add_rows(part);
  }
  void add_rows(const FramePart& part) {
    response.rows.insert(response.rows.end(), part.rows.begin(), part.rows.end());
    events.insert(events.end(), part.events.begin(), part.events.end());
  }
};

/// Copies the frames of the file that the run continues, and the curve and events up to its last frame.
void add_base(const h5::Node& base, const Parts& parts, int frames, h5::Node& into, Collected& collected) {
  collected.time = base.doubles("time"), collected.step = base.longs("step"), collected.stage = base.ints("stage");
  if (collected.time.size() != static_cast<std::size_t>(frames))
    throw DataError(
        fmt::format("{} has {} frames, but {} continues one of {}; it is another run, so move one of them away",
                    parts.path.string(), collected.time.size(), parts.folder.string(), frames));
  const auto from = base.group("frames");
  for (int i = 0; i < frames; ++i) into.copy(from, frame_name(i), frame_name(i));
  auto response = read_response(base.group("response"));
  if (!response.rows.empty() && response.columns != collected.response.columns)
    throw DataError(fmt::format("{}: the columns of the response differ from those that the run is continued with",
                                parts.path.string()));
  collected.response.rows = std::move(response.rows);
  collected.events = read_events(base.group("events"));
  const auto rows = static_cast<std::size_t>(base.integer("response_rows_at_restart"));
  const auto events = static_cast<std::size_t>(base.integer("events_at_restart"));
  if (rows < collected.response.rows.size()) collected.response.rows.resize(rows);
  if (events < collected.events.size()) collected.events.resize(events);
}

void fill_trajectory(h5::Node& file, const Parts& parts, const Run& run, const FramePart& tail,
                     const std::string& ended) {
  file.write_text("format", kTrajectoryFormat);
  file.write_text("ended", ended);
  auto sample = file.make_group("sample");
  write_sample(sample, read_sample(parts.sample()));
  auto provenance = file.make_group("provenance");
  write_provenance(provenance, run.provenance);

  Collected collected;
  collected.response.columns = run.columns, collected.response.units = run.units;
  auto frames = file.make_group("frames");
  const int in_parts = parts.count_frames(run.base_frames);
  if (run.base_frames > 0) {
    const auto base = h5::Node::open(parts.path);
    add_base(base, parts, run.base_frames, frames, collected);
    if (in_parts == 0) file.copy(base, "restart", "restart");
  }
  for (int i = run.base_frames; i < run.base_frames + in_parts; ++i) {
    frames.copy(h5::Node::open(parts.frame(i)), "frame", frame_name(i));
    collected.add(read_frame_part(parts.frame(i), run.columns.size()));
  }
  if (in_parts > 0) file.copy(h5::Node::open(parts.restart(run.base_frames + in_parts - 1)), "restart", "restart");

  file.write_integer("response_rows_at_restart", static_cast<std::int64_t>(collected.response.rows.size()));
  file.write_integer("events_at_restart", static_cast<std::int64_t>(collected.events.size()));
  collected.add_rows(tail);
  file.write("time", collected.time);
  file.write_text("time@unit", "s");
  file.write("step", collected.step);
  file.write("stage", collected.stage);
  auto response = file.make_group("response");
  write_response(response, collected.response);
  auto events = file.make_group("events");
  write_events(events, collected.events);
}

}  // namespace

void merge_parts(const Parts& parts, const Run& run, const FramePart& tail, const std::string& ended) {
  try {
    h5::replace_file(parts.path, [&](h5::Node& file) { fill_trajectory(file, parts, run, tail, ended); });
  } catch (const DataError& error) {
    throw DataError(fmt::format("{}; every frame is kept in {}", error.what(), parts.folder.string()));
  }
  parts.remove();
}

}  // namespace lamella
