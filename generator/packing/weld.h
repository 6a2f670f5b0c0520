// Short edges of a tessellation, welded to a point: four tiles then meet there.
#pragma once
#include <string>
#include <vector>

#include "generator/packing/laguerre.h"

namespace lamella {

/// An edge that could not be welded.
struct ShortEdge {
  Vec2 at;            // one of its ends [m]
  double length = 0;  // [m]
};

/// One note on all of them: how many stay, the shortest length, the places of the first few; none where there are none.
void note_short_edges(std::vector<ShortEdge> left, const std::string& reason, std::vector<std::string>& notes);

/// Collapses edges not longer than `threshold` [m], shortest first, each to one vertex that all its tiles share. Corners of
/// the box stay, vertices on a side stay on it, tiles keep at least three vertices and stay convex, and their areas still
/// sum to the box. An edge that cannot be welded under these conditions is left and noted. Returns the number welded.
int weld_short_edges(Tessellation& tessellation, double threshold, std::vector<std::string>* notes = nullptr);

}  // namespace lamella
