// Cells, walls and vertices of a mosaic as tables (CSV).
#pragma once
#include <string>

#include "generator/statistics/cell_measures.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

struct MosaicTables {
  std::string cells, walls, vertices;  // docs/formats.md names the columns
};
MosaicTables tables_of(const Mosaic& mosaic, const MosaicMeasures& measures);

}  // namespace lamella
