#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "generator/sample/errors.h"
#include "generator/sample/sample_file.h"
#include "simulator/trajectory/parts.h"

namespace lamella {

struct TrajectoryWriter::Impl {
  Parts parts;
  PartsLock lock;
  Run run;
  bool run_changed = false;
  Counts counts;
  int frames = 0;               // of the base and in parts
  std::optional<Instant> last;  // of the last frame
  std::string ended;            // why the run that is resumed ended
  FramePart pending;            // rows and events since then
  bool disposable = true;       // until the parts hold something that is nowhere else

  explicit Impl(const std::filesystem::path& path) : parts(path), lock(parts) {}

  ~Impl() {
    // A run that came to no frame leaves nothing behind.
    if (disposable) parts.remove();
  }

  void begin(const Sample& sample) {
    parts.clear();
    counts = counts_of(sample);
    write_sample(parts.sample(), sample);
    write_run(parts, run);
  }

  void save_changes() {
    if (run_changed) write_run(parts, run);
    run_changed = false;
  }
};

namespace {

void check_target(const std::filesystem::path& path) {
  std::error_code error;
  const auto folder = path.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, error))
    throw DataError(fmt::format("{} cannot be written: the folder {} does not exist", path.string(), folder.string()));
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw DataError(fmt::format("{} cannot be written: it is not a file", path.string()));
}

}  // namespace

TrajectoryWriter::TrajectoryWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

TrajectoryWriter::TrajectoryWriter(std::filesystem::path path, const Sample& sample, const Provenance& provenance) {
  check_target(path);
  impl_ = std::make_unique<Impl>(path);
  impl_->run.provenance = provenance;
  impl_->begin(sample);
}

TrajectoryWriter TrajectoryWriter::resume(std::filesystem::path path) {
  check_target(path);
  std::error_code error;
  if (!Parts(path).hold_a_run() && !std::filesystem::exists(path, error))
    throw DataError(fmt::format("{} does not exist, nor do parts of it; there is nothing to resume", path.string()));
  auto impl = std::make_unique<Impl>(path);
  if (impl->parts.hold_a_run()) {
    impl->disposable = false;
    impl->ended = "interrupted";
    impl->run = read_run(impl->parts);
    impl->counts = counts_of(read_sample(impl->parts.sample()));
    impl->frames = impl->run.base_frames + impl->parts.count_frames(impl->run.base_frames);
  } else {
    const TrajectoryReader base(path);
    impl->run = {base.frames(), base.response().columns, base.response().units, base.provenance()};
    impl->frames = base.frames();
    impl->ended = base.ended();
    impl->begin(base.sample());
  }
  TrajectoryWriter writer(std::move(impl));
  const Frame last = writer.last_frame();
  writer.impl_->last = Instant{last.time, last.step, last.stage};
  return writer;
}

TrajectoryWriter::TrajectoryWriter(TrajectoryWriter&&) noexcept = default;
TrajectoryWriter::~TrajectoryWriter() = default;

int TrajectoryWriter::frames() const { return impl_->frames; }
Sample TrajectoryWriter::sample() const { return read_sample(impl_->parts.sample()); }
const Provenance& TrajectoryWriter::provenance() const { return impl_->run.provenance; }
const std::vector<std::string>& TrajectoryWriter::response_columns() const { return impl_->run.columns; }
const std::string& TrajectoryWriter::ended() const { return impl_->ended; }

Frame TrajectoryWriter::last_frame() const {
  if (impl_->frames == 0)
    throw DataError(fmt::format("{} has no frame yet; there is nothing to resume", impl_->parts.path.string()));
  if (impl_->frames == impl_->run.base_frames) return TrajectoryReader(impl_->parts.path).frame(impl_->frames - 1);
  const auto file = impl_->parts.frame(impl_->frames - 1);
  Frame frame = read_frame_of_part(file);
  check_frame(frame, impl_->counts, file.string());
  return frame;
}

ArraySet TrajectoryWriter::restart() const {
  if (impl_->frames == impl_->run.base_frames) return TrajectoryReader(impl_->parts.path).restart();
  return read_arrays(h5::Node::open(impl_->parts.restart(impl_->frames - 1)).group("restart"));
}

void TrajectoryWriter::set_response_columns(std::vector<std::string> columns, std::vector<std::string> units) {
  auto& run = impl_->run;
  if (columns.size() != units.size())
    throw DataError(fmt::format("{}: the response has {} columns and {} units", impl_->parts.path.string(),
                                columns.size(), units.size()));
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c].empty() || columns[c].find_first_of("/@.\n") != std::string::npos ||
        std::count(columns.begin(), columns.end(), columns[c]) > 1)
      throw DataError(fmt::format("{}: '{}' is no name for a column of the response; must be a word that no other has",
                                  impl_->parts.path.string(), columns[c]));
  if (columns == run.columns && units == run.units) return;
  if (impl_->frames > 0)
    throw DataError(
        fmt::format("{}: the columns of the response cannot change within a run; the scene must have the same "
                    "terms and loads when it is resumed",
                    impl_->parts.path.string()));
  run.columns = std::move(columns), run.units = std::move(units);
  impl_->run_changed = true;
}

void TrajectoryWriter::add_response(const std::vector<double>& row) {
  if (row.size() != impl_->run.columns.size())
    throw DataError(fmt::format("{}: a row of the response has {} values; must have {}", impl_->parts.path.string(),
                                row.size(), impl_->run.columns.size()));
  for (std::size_t c = 0; c < row.size(); ++c)
    if (!std::isfinite(row[c]))
      throw DataError(fmt::format("{}: '{}' of the response is not a finite number", impl_->parts.path.string(),
                                  impl_->run.columns[c]));
  impl_->pending.rows.push_back(row);
}

void TrajectoryWriter::add_event(const Event& event) {
  check_event(event, impl_->counts, impl_->parts.path.string());
  impl_->pending.events.push_back(event);
}

void TrajectoryWriter::set_provenance(const std::string& key, const std::string& value) {
  impl_->run.provenance[key] = value;
  impl_->run_changed = true;
}

void TrajectoryWriter::write_frame(const Frame& frame, const ArraySet& restart) {
  const std::string where = fmt::format("{}: frame {}", impl_->parts.path.string(), impl_->frames);
  const Instant instant{frame.time, frame.step, frame.stage};
  check_order(impl_->last, instant, where);
  check_frame(frame, impl_->counts, where);
  const int index = impl_->frames;
  impl_->save_changes();
  h5::replace_file(
      impl_->parts.restart(index),
      [&](h5::Node& file) {
        auto group = file.make_group("restart");
        write_arrays(group, restart);
      },
      h5::Storage::plain);
  write_frame_part(impl_->parts.frame(index), frame, impl_->pending, impl_->run.columns.size());
  std::error_code error;
  if (index > 0) std::filesystem::remove(impl_->parts.restart(index - 1), error);
  impl_->pending = {};
  impl_->last = instant;
  ++impl_->frames;
  impl_->disposable = false;
}

void TrajectoryWriter::finish(const std::string& ended) {
  merge_parts(impl_->parts, impl_->run, impl_->pending, ended);
  impl_->disposable = false;
}

}  // namespace lamella
