// What still holds together: components of pieces of shells (a whole shell, or what broken bars have cut it into) joined by intact links.
#pragma once
#include <vector>

#include "postproc/frame_view.h"

namespace lamella {

struct Fragments {
  std::vector<std::int32_t> of_node;  // 0 is the fragment of most pieces, ties by the lowest node
  std::vector<std::int32_t> id;       // per cell: that of most of its nodes, ties by the lowest fragment
  int count = 0;
};

Fragments fragments(const FrameView& view);

/// Sides of the box across `axis` (0: left and right, 1: bottom and top).
struct SidePair {
  std::uint8_t low, high;
};
inline SidePair sides_across(int axis) { return axis == 0 ? SidePair{kLeft, kRight} : SidePair{kBottom, kTop}; }

/// True when no path of shells and intact links joins the two sides across `axis`, each side counted as one piece.
/// False when the sample has no cells at one of them. Of a box that is pulled: when no such path goes round it along the axis.
bool separated(const FrameView& view, int axis);

/// Cracks that cross the tissue: none while it is not separated; else one, and one more for every fragment that lies between
/// the grips, from one free side to the other. In a box that is pulled as many as fragments that go round it across the pull, one at least.
int through_cracks(const FrameView& view, const Fragments& pieces, int axis);

}  // namespace lamella
