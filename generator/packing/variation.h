// What varies from place to place in a tissue: sizes, groups, thickness and strength, by [[sample.layers]] and
// [sample.gradient].
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "generator/packing/packing.h"
#include "generator/sample/scene.h"
#include "generator/sample/vec.h"

namespace lamella {

using PositionFactor = SizeFactor;

/// Factor on the radii of disks at a place: that of gradient.size times that of the last layer that holds the place. Positions along
/// "radius" are distances from the middle of `box`. An empty function when nothing varies. Throws SceneError: positions that do not
/// increase, factors that are not positive.
PositionFactor size_factor(const SampleScene& scene, const Box& box);

/// The same of one gradient alone; `pairs` is one of its members, `key` its name for messages.
PositionFactor gradient_factor(const GradientScene& gradient, const std::vector<Vec2>& pairs, const std::string& key,
                               const Box& box);

/// The last layer that holds the point, or -1. A layer holds from <= position < to, or what lies inside its polygon.
int layer_at(const std::vector<LayerScene>& layers, const Box& box, const Vec2& point);

}  // namespace lamella
