// The report of a generated sample: statistics as numbers, tables, charts and one page.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "generator/generate.h"

namespace lamella {

/// Writes statistics.json, statistics.csv (by number of neighbours), report.html and pictures into `folder`, which must
/// exist, and returns the files. A sample without tiles has a report of its packing or of its cells alone.
std::vector<std::filesystem::path> write_tissue_report(const std::filesystem::path& folder, const Scene& scene,
                                                       const Sample& sample, const Origin& origin, const Notes& notes);

}  // namespace lamella
