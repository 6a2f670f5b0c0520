// Charts of a tissue's statistics: sizes, neighbours, and the laws of Lewis and of Aboav and Weaire.
#pragma once
#include <filesystem>
#include <vector>

#include "generator/packing/packing.h"
#include "generator/statistics/mosaic_statistics.h"

namespace lamella {

using ChartFiles = std::vector<std::filesystem::path>;  // STEM.png, STEM.pdf

/// Areas over their mean, as bars; beside them those of the disks, which is what was asked for (none: left out).
ChartFiles draw_areas(const std::filesystem::path& stem, const MosaicStatistics& s, const std::vector<Disk>& disks);
/// p_n, with standard errors.
ChartFiles draw_neighbour_counts(const std::filesystem::path& stem, const MosaicStatistics& s);
ChartFiles draw_lewis(const std::filesystem::path& stem, const MosaicStatistics& s);
ChartFiles draw_aboav(const std::filesystem::path& stem, const MosaicStatistics& s);

}  // namespace lamella
