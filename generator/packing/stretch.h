// Cells longer one way than the other: what is to be filled is squeezed, filled with cells that are round on average, and
// drawn back, at the same area.
#pragma once
#include <Eigen/Core>

#include "generator/packing/domain.h"
#include "generator/sample/scene.h"

namespace lamella {

/// The affine map that makes a circle an ellipse of the same area, ratio times as long as wide, its long way at `angle`.
Eigen::Matrix2d stretch_map(const StretchScene& stretch);

/// The same of a stretch along x or along y: the factors of these axes, whose product is 1. Throws SceneError for other angles.
Vec2 stretch_of_axes(const StretchScene& stretch);

/// The domain that the map takes to `domain`, as polygons in a scene.
DomainScene squeezed(const Domain& domain, const Eigen::Matrix2d& map);

/// A box as a domain.
DomainScene as_domain(const Box& box);

}  // namespace lamella
