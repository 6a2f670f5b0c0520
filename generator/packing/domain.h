// What a tissue fills where that is not a box: closed polygons, one of them outside and the others holes in it.
#pragma once
#include <string>
#include <vector>

#include "generator/sample/polygon.h"
#include "generator/sample/scene.h"
#include "generator/sample/vec.h"

namespace lamella {

struct Domain {
  /// Closed polygons [m], the first point not repeated: what lies inside an odd number of them is the domain. From
  /// make_domain the first is the outer one and counter-clockwise, the others are holes and clockwise, so that the domain
  /// lies to the left of every edge; no two edges touch but neighbours in their common point.
  std::vector<std::vector<Vec2>> loops;
  std::vector<std::string> keys;  // of each loop: what the scene calls it
  Box box;                        // that encloses them
  double area = 0;                // [m2]

  /// By counting the edges to the right of p: a point on an edge may count as either.
  bool contains(const Vec2& p) const;
  /// Distance to the nearest edge [m], on either side.
  double distance_to_boundary(const Vec2& p) const;
};

/// The domain that a scene describes. Disks and rings have their centre at the origin. A circle becomes a regular polygon
/// of equal area, with its first corner at angle 0. Throws SceneError with all faults: points that are not finite, outlines
/// without area, or that cross or touch themselves or each other, holes outside the domain or inside one another.
Domain make_domain(const DomainScene& scene);

}  // namespace lamella
