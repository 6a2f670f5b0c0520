// Short edges of a tessellation, welded to a point: four tiles then meet there.
#pragma once
#include <string>
#include <vector>

#include "generator/packing/laguerre.h"

namespace lamella {

/// Collapses edges not longer than `threshold` [m], shortest first, each to one vertex that all its tiles share. Corners of
/// the box stay, vertices on a side stay on it, tiles keep at least three vertices and stay convex, and their areas still
/// sum to the box. An edge that cannot be welded under these conditions is left and noted. Returns the number welded.
int weld_short_edges(Tessellation& tessellation, double threshold, std::vector<std::string>* notes = nullptr);

}  // namespace lamella
