// Polygons as lists of corners [m], the first not repeated.
#pragma once
#include <vector>

#include "generator/sample/vec.h"

namespace lamella {

/// Signed: positive when the polygon is counter-clockwise [m2]. About its first corner, so that small polygons far from the
/// origin keep their digits.
double polygon_area(const std::vector<Vec2>& polygon);

/// From p to the nearest point of the segment from a to b [m].
double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b);

/// Whether the point lies inside the polygon, of either orientation. A point on an edge may count as either; of two polygons that share the edge,
/// one has it.
bool is_inside(const std::vector<Vec2>& polygon, const Vec2& p);

}  // namespace lamella
