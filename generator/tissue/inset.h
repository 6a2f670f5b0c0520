// Polygons shrunk by a distance: every edge moves inwards, and those that shrink to nothing on the way are taken out in
// the order in which they do, so that nothing ever folds over.
#pragma once
#include <vector>

#include "generator/sample/sample.h"

namespace lamella {

/// What is left of edge `edge`: from `from` to `to` along it, measured from its first vertex [m], moved inwards.
struct InsetEdge {
  Index edge = 0;
  double from = 0, to = 0;
};

struct Inset {
  enum class Outcome {
    whole,     // `edges` are what is left, in order; consecutive ones meet
    vanished,  // the polygon is thinner than twice the distance
    split      // a concave polygon would fall apart or touch itself
  };
  Outcome outcome = Outcome::whole;
  std::vector<InsetEdge> edges;
};

/// `polygon` is simple and counter-clockwise. Concave corners are mitred.
Inset inset_polygon(const std::vector<Vec2>& polygon, double distance);

/// The distance at which the polygon vanishes: its inradius when it is convex [m].
double vanishing_distance(const std::vector<Vec2>& polygon);

}  // namespace lamella
