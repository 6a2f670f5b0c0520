// Tissues for other programs: one call, the format by the file's ending.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "generator/packing/packing.h"
#include "generator/sample/sample.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// Endings that write_cells knows.
inline constexpr const char* kExportEndings = ".csv, .tess, .off, .txt, .vtp, .svg, .png or .pdf";
bool is_export_ending(const std::filesystem::path& path);

/// Writes the cells of a mosaic and returns the files: .csv becomes NAME_cells.csv, NAME_walls.csv and NAME_vertices.csv.
/// `seeds`: for .tess, of every cell; may be empty. Throws DataError for other endings and for what cannot be written.
std::vector<std::filesystem::path> write_cells(const std::filesystem::path& path, const Mosaic& mosaic,
                                               const std::vector<Disk>& seeds = {});

/// The centre lines of a sample's closed shells as cells, which share no vertex. Throws DataError when there are none.
Mosaic outlines_of(const Sample& sample);

/// A picture of the shells with walls as thick as they are: .svg, .png or .pdf.
void draw_sample(const std::filesystem::path& path, const Sample& sample);

}  // namespace lamella
