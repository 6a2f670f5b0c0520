// Single shells: chains, plates, boxes, rings and polygons; and rings on the disks of a packing.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "generator/packing/packing.h"
#include "generator/sample/sample.h"
#include "generator/sample/scene.h"

namespace lamella {

/// Minkowski radius of a group's cells.
using RadiusOfGroup = std::function<double(const std::string& group)>;

/// Appends one shape.
/// - chain, plate: `segments` equal segments from `from` to `to`. A clamped end has one more node and segment
///   beyond it: these two nodes are selected by clamp_start and clamp_end and are to be held. The hinge at the
///   clamp is half a segment long, since only the free half bends ("full": the naive clamp, first-order only).
/// - box: an open chain down the left side, along the bottom and up the right side, `segments` on each.
/// - ring: `segments` vertices on the circle of radius `size`, the first at angle `rotation`.
/// - polygon: the points, each side cut into `segments` (1 when not given).
/// Throws SceneError for what cannot be made.
void add_shape(const ShapeScene& shape, const RadiusOfGroup& radius, Sample& sample);

/// One ring of `nodes` vertices in every disk, on the circle of radius disk radius - Minkowski radius: outlines
/// stay in the disks. `tile_areas` are those of the disks' tiles, by disk; empty: the disks' own.
Sample make_rings(const Packing& packing, int nodes, double radius, const std::string& group,
                  const std::vector<double>& tile_areas);

}  // namespace lamella
