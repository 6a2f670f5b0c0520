// The tiles of a packing's disks, as [sample.packing] wants them.
#pragma once
#include <vector>

#include "generator/generate.h"
#include "generator/packing/laguerre.h"
#include "generator/sample/scene.h"

namespace lamella {

/// Duplicates and hidden disks are errors, or with packing.duplicates = "keep_first" left out.
LaguerreOptions laguerre_options(const PackingScene& scene, const Periodic& periodic = {false, false});

/// Tessellates; a note names the disks that have no tile.
Tessellation tessellate_packing(const std::vector<Disk>& disks, const Box& box, const LaguerreOptions& options,
                                Notes& notes);

}  // namespace lamella
