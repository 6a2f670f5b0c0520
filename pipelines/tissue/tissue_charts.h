// Charts of a tissue's statistics: sizes, neighbours, and the laws of Lewis and of Aboav and Weaire.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "generator/statistics/mosaic_statistics.h"

namespace lamella {

using ChartFiles = std::vector<std::filesystem::path>;  // STEM.png, STEM.pdf

/// Areas over their mean, as bars; beside them what was asked for, in proportion (none: left out), under the name of `what`.
ChartFiles draw_areas(const std::filesystem::path& stem, const MosaicStatistics& s, const std::vector<double>& asked,
                      const std::string& what);
/// p_n, with standard errors.
ChartFiles draw_neighbour_counts(const std::filesystem::path& stem, const MosaicStatistics& s);
ChartFiles draw_lewis(const std::filesystem::path& stem, const MosaicStatistics& s);
ChartFiles draw_aboav(const std::filesystem::path& stem, const MosaicStatistics& s);

}  // namespace lamella
