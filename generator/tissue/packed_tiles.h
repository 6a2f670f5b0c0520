// The tiles of a packing's disks, as [sample.packing] wants them.
#pragma once
#include <string>
#include <vector>

#include "generator/generate.h"
#include "generator/packing/laguerre.h"
#include "generator/sample/scene.h"

namespace lamella {

/// Duplicates and hidden disks are errors, or with packing.duplicates = "keep_first" left out.
LaguerreOptions laguerre_options(const PackingScene& scene, const Periodic& periodic = {false, false});

/// Tessellates, and checks that the tiles are those of the disks; a note names the disks that have no tile, by their
/// `number` where that is given.
Tessellation tessellate_packing(const std::vector<Disk>& disks, const Box& box, const LaguerreOptions& options,
                                Notes& notes, const std::vector<int>& number = {});

/// Throws SceneError for what the checks of a tessellation have found.
void refuse_faults(const std::vector<std::string>& faults);

}  // namespace lamella
