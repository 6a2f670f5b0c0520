// From polygons that share walls to shells of mass points that face each other across every shared wall, and to the
// links that join them.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "generator/generate.h"
#include "generator/sample/sample.h"
#include "generator/sample/scene.h"
#include "generator/tissue/mosaic.h"
#include "generator/tissue/outlines.h"

namespace lamella {

/// Every cell is inset by radius + gap / 2. Mass points are placed on the shared wall, evenly over the part that
/// both inset sides cover, and projected to the two sides: facing points lie 2 radius + gap apart along the wall's
/// normal, with no tangential offset. Corners of a side beyond that part stay mass points unless they are closer
/// than a quarter of the spacing to the last facing point, which then takes the corner's place (its link is
/// oblique, and stress-free all the same). Throws SceneError naming cells that vanish or fall apart. Notes: edges
/// that vanish, walls with one side only.
Bonding face_walls(const Mosaic& mosaic, const WallsScene& walls, double radius, Notes& notes);
/// With a radius per cell [m]: facing points of cells a and b lie radius[a] + radius[b] + gap apart.
Bonding face_walls(const Mosaic& mosaic, const WallsScene& walls, const std::vector<double>& radius, Notes& notes);

/// The above, as cells of `group` of a sample whose box is that of the mosaic.
Sample make_tissue(const Mosaic& mosaic, const WallsScene& walls, double radius, const std::string& group,
                   Notes& notes);

/// Minkowski radius of a group's walls [m].
using RadiusOfGroup = std::function<double(const std::string& group)>;

/// The same with groups and thicknesses as the cells of the mosaic have them. The factors are in the sample if one is not 1.
Sample make_tissue(const Mosaic& mosaic, const WallsScene& walls, const RadiusOfGroup& radius_of, Notes& notes);

}  // namespace lamella
