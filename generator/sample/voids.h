// The room between straight walls and how much of it cells cover: void ratio and compaction of a packing.
#pragma once
#include <optional>
#include <vector>

#include "generator/sample/sample.h"

namespace lamella {

/// The rectangle between the inner faces of the walls: on each side of the closed cells' mean node the nearest segment of an open
/// chain that runs along that side. Empty where a side has none, or there are no closed cells.
std::optional<Box> room_between_walls(const Sample& sample, const std::vector<Vec2>& x);

/// Area of the room that the outlines of closed cells (sphero-polygons) cover, overlaps counted once [m2]. By horizontal lines, 64 to a
/// mean radius: off by up to half their distance at a flat top, 0.5 % of a single square, and by far less where cells are round and many. It takes some 10 ms for 500 cells.
double covered_area(const Sample& sample, const std::vector<Vec2>& x, const Box& room);

/// Area of the room that no cell covers over the area that cells cover.
double void_ratio(const Sample& sample, const std::vector<Vec2>& x, const Box& room);

}  // namespace lamella
