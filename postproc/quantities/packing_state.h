// How densely cells lie between straight walls, frame by frame.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "postproc/frame_view.h"

namespace lamella {

struct PackingState {
  double time = 0;  // [s]
  std::int32_t stage = 0;
  double room = 0;          // area between the walls [m2]
  double compaction = 0;    // by which the room has shrunk since the sample [1]
  double void_ratio = 0;    // room without cells over room with cells, by outlines, overlaps counted once [1]
  double outline_area = 0;  // sum over the cells, overlaps counted twice [m2]
  double cell_area = 0;     // sum of what the centre lines enclose [m2]
  double aspect = 0;        // mean over the cells [1]
  double circularity = 0;   // likewise [1]
};

/// Empty where the sample has no closed cells between walls on four sides (room_between_walls).
std::optional<PackingState> packing_state(const FrameView& view);

/// packing.csv (docs/outputs.md): a row for each frame.
std::string packing_csv(const std::vector<PackingState>& states);

}  // namespace lamella
