#include <fmt/format.h>

#include <utility>

#include "generator/sample/errors.h"
#include "generator/sample/sample_file.h"
#include "simulator/trajectory/parts.h"

namespace lamella {
namespace {

/// Makes the file of a run that never finished, and says so in it.
void merge_if_only_parts(const std::filesystem::path& path) {
  const Parts parts(path);
  std::error_code error;
  if (std::filesystem::exists(path, error) || !parts.hold_a_run()) return;
  const PartsLock lock(parts);
  const Run run = read_run(parts);
  if (run.base_frames > 0)
    throw DataError(fmt::format("{} is missing, and {} holds only what came after its {} frames; put it back",
                                path.string(), parts.folder.string(), run.base_frames));
  if (parts.count_frames(0) == 0)
    throw DataError(
        fmt::format("{}: the run was stopped before its first frame; it must be started anew", path.string()));
  merge_parts(parts, run, {}, "interrupted");
}

}  // namespace

struct TrajectoryReader::Impl {
  h5::Node file;
  std::string path;
  Sample sample;
  Counts counts;
  Provenance provenance;
  std::string ended;
  Response response;
  std::vector<Event> events;
  std::vector<Instant> instants;

  explicit Impl(const std::filesystem::path& from) : file(h5::Node::open(from)), path(from.string()) {
    check_trajectory_format(file);
    ended = file.text("ended");
    sample = read_sample(file.group("sample"));
    counts = counts_of(sample);
    provenance = read_provenance(file.group("provenance"));
    read_instants();
    response = read_response(file.group("response"));
    events = read_events(file.group("events"));
    for (const auto& event : events) check_event(event, counts, path);
  }

  void read_instants() {
    const auto time = file.doubles("time");
    const auto step = file.longs("step");
    const auto stage = file.ints("stage");
    const std::size_t groups = file.group("frames").names().size();
    if (step.size() != time.size() || stage.size() != time.size() || groups != time.size())
      throw DataError(fmt::format("{} holds {} frames, but {} times, {} steps and {} stages; must be as many of each",
                                  path, groups, time.size(), step.size(), stage.size()));
    std::optional<Instant> last;
    for (std::size_t i = 0; i < time.size(); ++i) {
      const Instant instant{time[i], step[i], stage[i]};
      check_order(last, instant, fmt::format("{}: frame {}", path, i));
      instants.push_back(instant);
      last = instant;
    }
  }
};

TrajectoryReader::TrajectoryReader(std::filesystem::path path) {
  merge_if_only_parts(path);
  impl_ = std::make_unique<Impl>(path);
}

TrajectoryReader::TrajectoryReader(TrajectoryReader&&) noexcept = default;
TrajectoryReader::~TrajectoryReader() = default;

const Sample& TrajectoryReader::sample() const { return impl_->sample; }
const Provenance& TrajectoryReader::provenance() const { return impl_->provenance; }
const std::string& TrajectoryReader::ended() const { return impl_->ended; }
const Response& TrajectoryReader::response() const { return impl_->response; }
const std::vector<Event>& TrajectoryReader::events() const { return impl_->events; }
int TrajectoryReader::frames() const { return static_cast<int>(impl_->instants.size()); }

Frame TrajectoryReader::frame(int index) const {
  const std::string where = fmt::format("{}: frame {}", impl_->path, index);
  if (index < 0 || index >= frames())
    throw DataError(fmt::format("{} does not exist; there are {} frames", where, frames()));
  const Instant& instant = impl_->instants[static_cast<std::size_t>(index)];
  Frame frame{instant.time, instant.step, instant.stage,
              read_arrays(impl_->file.group("frames").group(frame_name(index)))};
  check_frame(frame, impl_->counts, where);
  return frame;
}

ArraySet TrajectoryReader::restart() const {
  if (frames() == 0) throw DataError(fmt::format("{} has no frame; there is nothing to restart from", impl_->path));
  return read_arrays(impl_->file.group("restart"));
}

}  // namespace lamella
