// Cracks of a periodic sample that close on themselves around its box.
#pragma once
#include <vector>

#include "generator/sample/sample.h"

namespace lamella {

/// An edge of a graph that is drawn on a cylinder: on the way from its one end to the other it goes so many times around.
struct WoundEdge {
  Index from = 0, to = 0;  // vertices
  double length = 0;       // [m]
  int around = 0;
};

/// The shortest closed way that goes around once in all, as edges in order; empty where there is none.
std::vector<Index> shortest_loop_around(const std::vector<WoundEdge>& edges);

}  // namespace lamella
