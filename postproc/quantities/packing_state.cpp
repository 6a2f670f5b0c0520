#include "postproc/quantities/packing_state.h"

#include <fmt/format.h>

#include "generator/sample/voids.h"
#include "postproc/quantities/cell_shape.h"

namespace lamella {

std::optional<PackingState> packing_state(const FrameView& view) {
  const Sample& sample = view.sample;
  const auto rest = room_between_walls(sample, sample.x), room = room_between_walls(sample, view.x);
  if (!rest || !room) return std::nullopt;
  PackingState state;
  state.time = view.frame.time, state.stage = view.frame.stage;
  state.room = room->area();
  state.compaction = 1 - room->area() / rest->area();
  state.void_ratio = void_ratio(sample, view.x, *room);
  double cells = 0;
  for (Index c = 0; c < sample.cells(); ++c) {
    if (!sample.closed[c]) continue;
    const CellShape shape = cell_shape(sample, view.x, c);
    state.outline_area += shape.outline_area, state.cell_area += shape.area;
    state.aspect += shape.aspect, state.circularity += shape.circularity();
    ++cells;
  }
  state.aspect /= cells, state.circularity /= cells;
  return state;
}

std::string packing_csv(const std::vector<PackingState>& states) {
  std::string text =
      "time [s],stage [1],room [m2],compaction [1],void_ratio [1],outline_area [m2],cell_area [m2],aspect "
      "[1],circularity [1]\n";
  for (const PackingState& s : states)
    text += fmt::format("{:.10g},{},{:.10g},{:.10g},{:.8g},{:.10g},{:.10g},{:.8g},{:.8g}\n", s.time, s.stage, s.room,
                        s.compaction, s.void_ratio, s.outline_area, s.cell_area, s.aspect, s.circularity);
  return text;
}

}  // namespace lamella
