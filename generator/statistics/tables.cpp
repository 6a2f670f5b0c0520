#include "generator/statistics/tables.h"

#include <fmt/format.h>

#include <iterator>

#include "generator/tissue/mosaic_text.h"

namespace lamella {
namespace {

using Text = fmt::memory_buffer;

std::string cell_table(const Mosaic& mosaic, const MosaicMeasures& measures) {
  Text text;
  auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "cell,group,x [m],y [m],area [m2],perimeter [m],neighbours,layer,circularity,elongation,"
                 "direction [rad],thickness,number\n");
  for (std::size_t c = 0; c < measures.cells.size(); ++c) {
    const CellMeasures& cell = measures.cells[c];
    fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{},{},{}\n", c, mosaic.cells[c].group, cell.centre.x(),
                   cell.centre.y(), cell.area, cell.perimeter, cell.neighbours, cell.layer, cell.circularity,
                   cell.elongation, cell.direction, mosaic.cells[c].thickness, mosaic.cells[c].number);
  }
  return {text.data(), text.size()};
}

/// One row per edge; a shared edge once, as its cell of lower index has it.
std::string wall_table(const Mosaic& mosaic, const PlainMosaic& plain) {
  const auto across = opposite_edges(mosaic);
  Text text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "cell_a,cell_b,vertex_a,vertex_b,length [m],side\n");
  for (std::size_t c = 0; c < plain.cells.size(); ++c) {
    const auto& cell = plain.cells[c];
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const EdgePlace there = across[c][k];
      const auto here = static_cast<Index>(c);
      if (there.cell >= 0 && !comes_first(here, there)) continue;
      const Index a = cell[k], b = cell[(k + 1) % cell.size()];
      const int side = k < mosaic.cells[c].side.size() ? mosaic.cells[c].side[k] : 0;
      fmt::format_to(out, "{},{},{},{},{},{}\n", c, there.cell, a, b, (plain.vertices[b] - plain.vertices[a]).norm(),
                     side);
    }
  }
  return {text.data(), text.size()};
}

std::string vertex_table(const PlainMosaic& plain) {
  std::vector<int> cells(plain.vertices.size(), 0);
  for (const auto& cell : plain.cells)
    for (const Index v : cell) ++cells[v];
  Text text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "vertex,x [m],y [m],cells\n");
  for (std::size_t v = 0; v < cells.size(); ++v)
    fmt::format_to(out, "{},{},{},{}\n", v, plain.vertices[v].x(), plain.vertices[v].y(), cells[v]);
  return {text.data(), text.size()};
}

}  // namespace

MosaicTables tables_of(const Mosaic& mosaic, const MosaicMeasures& measures) {
  const PlainMosaic plain = in_one_piece(mosaic);
  return {cell_table(mosaic, measures), wall_table(mosaic, plain), vertex_table(plain)};
}

}  // namespace lamella
