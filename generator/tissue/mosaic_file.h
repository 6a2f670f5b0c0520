// The tiles of a tissue, kept in the file of its sample: what was before walls were inset.
#pragma once
#include <filesystem>
#include <optional>

#include "generator/sample/h5.h"
#include "generator/sample/sample.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// Writes sample and tiles to one file; tile k is that of cell k. A mosaic without cells is not written.
void write_sample(const std::filesystem::path& path, const Sample& sample, const Mosaic& tiles);

/// The tiles that a sample's file holds, if it does. Throws DataError for arrays that do not fit together.
std::optional<Mosaic> read_tiles(const std::filesystem::path& path);

}  // namespace lamella
