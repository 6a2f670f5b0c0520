#include "generator/tissue/packed_tiles.h"

#include <fmt/format.h>

#include "generator/tissue/outlines.h"

namespace lamella {

LaguerreOptions laguerre_options(const PackingScene& scene, const Periodic& periodic) {
  LaguerreOptions options;
  if (scene.duplicates == "keep_first") options = {Duplicates::kKeepFirst, Hidden::kReport, periodic};
  options.periodic = periodic;
  return options;
}

Tessellation tessellate_packing(const std::vector<Disk>& disks, const Box& box, const LaguerreOptions& options,
                                Notes& notes) {
  Tessellation tessellation = tessellate(disks, box, options);
  if (!tessellation.hidden.empty()) {
    std::vector<std::string> names;
    for (const Index site : tessellation.hidden) names.push_back(fmt::format("site {}", site));
    notes.push_back(fmt::format("{} sites have no cell: {}", names.size(), listed(names)));
  }
  return tessellation;
}

}  // namespace lamella
