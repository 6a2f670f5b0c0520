#include "generator/tissue/packed_tiles.h"

#include <fmt/format.h>

#include "generator/sample/errors.h"
#include "generator/tissue/outlines.h"

namespace lamella {

LaguerreOptions laguerre_options(const PackingScene& scene, const Periodic& periodic) {
  LaguerreOptions options;
  if (scene.duplicates == "keep_first") options = {Duplicates::kKeepFirst, Hidden::kReport, periodic};
  options.periodic = periodic;
  return options;
}

Tessellation tessellate_packing(const std::vector<Disk>& disks, const Box& box, const LaguerreOptions& options,
                                Notes& notes, const std::vector<int>& number) {
  Tessellation tessellation = tessellate(disks, box, options);
  refuse_faults(check_disks(tessellation, disks));
  if (!tessellation.hidden.empty()) {
    std::vector<std::string> names;
    for (const Index site : tessellation.hidden)
      names.push_back(fmt::format("site {}", number.empty() ? site : number[site]));
    notes.push_back(fmt::format("{} sites have no cell: {}", names.size(), listed(names)));
  }
  return tessellation;
}

void refuse_faults(const std::vector<std::string>& faults) {
  if (faults.empty()) return;
  auto all = faults;
  all.insert(all.begin(), "sample: the tessellation is not sound");
  throw SceneError(all);
}

}  // namespace lamella
