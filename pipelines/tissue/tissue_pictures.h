// Pictures of tiles and of shells.
#pragma once
#include <filesystem>

#include "generator/statistics/mosaic_statistics.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// The cells, each group in its colour. One file, by its ending: .png, .pdf or .svg.
void draw_mosaic(const std::filesystem::path& path, const Mosaic& mosaic);

/// The tissue twice, side by side: coloured by the number of neighbours, and by area over the mean. Cells that statistics
/// of neighbours leave out are pale in the first. STEM.png and STEM.pdf.
std::vector<std::filesystem::path> draw_neighbours_and_areas(const std::filesystem::path& stem, const Mosaic& mosaic,
                                                             const MosaicMeasures& measures);

}  // namespace lamella
