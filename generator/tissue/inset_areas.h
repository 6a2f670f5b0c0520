// What the inset leaves of tiles, as areas that weights can be solved for: the insides of cells whose walls have a thickness.
#pragma once
#include <vector>

#include "generator/packing/exact_areas.h"
#include "generator/tissue/inset.h"

namespace lamella {

/// Area of what the inset leaves of a simple, counter-clockwise polygon [m2]; 0 when it vanishes or falls apart.
double inset_area(const std::vector<Vec2>& polygon, double distance);

/// Measures what an inset by `distance`[i] leaves of the tile of site i [m]. Centroids are those of the tiles.
TileMeasures measure_insets(const Tessellation& tessellation, const std::vector<Vec2>& centres,
                            const std::vector<double>& distance);

/// The problem for insets instead of tiles.
AreaProblem inset_problem(const AreaProblem& tiles, std::vector<double> distance);

/// Areas of tiles whose insets have about these shares, if every tile is a regular hexagon: sites with these have a chance to
/// survive the inset. Throws SceneError when even so the walls would need more than `total` [m2].
std::vector<double> tiles_around_insets(const std::vector<double>& shares, const std::vector<double>& distance,
                                        double total);

}  // namespace lamella
