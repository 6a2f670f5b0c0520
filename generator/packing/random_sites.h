// Sites at random: where nothing is known of the places, only of the sizes.
#pragma once
#include <cstdint>
#include <vector>

#include "generator/packing/packing.h"

namespace lamella {

/// Moves every disk of a packing to a place of its own in the box, or in the domain, uniformly at random: disks overlap then.
void scatter(Packing& packing, std::uint64_t seed, const Domain* domain = nullptr);

/// Disks of these radii scattered over a box, or a domain, that they fill to packing.fraction: as `pack` has it for its space.
Packing scattered(const PackingScene& scene, const std::vector<double>& radii, const PackingSpace& space,
                  std::uint64_t seed);

}  // namespace lamella
