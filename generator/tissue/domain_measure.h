// What optimal transport needs of the tiles of a domain.
#pragma once
#include "generator/packing/laguerre.h"
#include "generator/tissue/overlay.h"

namespace lamella {

/// Areas and centroids of the Laguerre cells inside the domain, and the lengths of their walls there. A cell counts with all its
/// pieces, connected or not: so areas depend on the weights as d area_a / d weight_b = -length / (2 distance of the
/// sites). Walls are sorted by their sites. Sites without a cell have area 0 and their centre as centroid.
TileMeasures measure_domain_tiles(const std::vector<Vec2>& centres, const std::vector<double>& weights,
                                  const Loops& loops);

}  // namespace lamella
