// How arrays, events and the response curve lie in HDF5 groups, and what must be true of a frame. Private to this folder.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/sample/h5.h"
#include "simulator/trajectory/trajectory.h"

namespace lamella {

/// Rows that a frame's arrays must have.
struct Counts {
  std::size_t nodes = 0, cells = 0, links = 0;
};
Counts counts_of(const Sample& sample);

void write_arrays(h5::Node& group, const ArraySet& arrays);
ArraySet read_arrays(const h5::Node& group);

/// Throws DataError, beginning with `where`, unless "x" is there, every array has the rows that its `per` asks for, every
/// number is finite and every contact names a node and a cell.
void check_frame(const Frame& frame, const Counts& counts, const std::string& where);

/// Where a frame stands in the run.
struct Instant {
  double time = 0;  // [s]
  std::int64_t step = 0;
  std::int32_t stage = 0;
};
/// Time grows from frame to frame; a new stage may begin at the time at which the last one ended.
void check_order(const std::optional<Instant>& last, const Instant& next, const std::string& where);

void write_events(h5::Node& group, const std::vector<Event>& events);
std::vector<Event> read_events(const h5::Node& group);
void check_event(const Event& event, const Counts& counts, const std::string& where);

void write_response(h5::Node& group, const Response& response);
Response read_response(const h5::Node& group);

void write_provenance(h5::Node& group, const Provenance& provenance);
Provenance read_provenance(const h5::Node& group);

}  // namespace lamella
