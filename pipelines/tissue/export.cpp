#include "pipelines/tissue/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "generator/sample/errors.h"
#include "generator/statistics/tables.h"
#include "generator/tissue/mosaic_text.h"
#include "pipelines/tissue/tissue_pictures.h"
#include "postproc/output_file.h"
#include "postproc/vtk_writer.h"

namespace lamella {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> write_tables(const fs::path& path, const Mosaic& mosaic) {
  const MosaicTables tables = tables_of(mosaic, measure(mosaic));
  std::vector<fs::path> files;
  for (const auto& [name, text] : {std::pair<const char*, const std::string&>{"cells", tables.cells},
                                   {"walls", tables.walls},
                                   {"vertices", tables.vertices}}) {
    files.push_back(path.parent_path() / fmt::format("{}_{}.csv", path.stem().string(), name));
    write_text_file(files.back(), text);
  }
  return files;
}

Mesh mesh_of(const Mosaic& mosaic) {
  const PlainMosaic plain = in_one_piece(mosaic);
  const MosaicMeasures measures = measure(mosaic);
  Mesh mesh;
  mesh.points = plain.vertices;
  std::vector<int> cell, number, neighbours, layer, group;
  std::vector<float> area, perimeter, circularity, elongation;
  std::vector<std::string> groups;
  for (std::size_t c = 0; c < plain.cells.size(); ++c) {
    mesh.connectivity.insert(mesh.connectivity.end(), plain.cells[c].begin(), plain.cells[c].end());
    mesh.end_cell();
    const CellMeasures& of = measures.cells[c];
    cell.push_back(static_cast<int>(c));
    const std::int64_t of_file = mosaic.cells[c].number;
    number.push_back(of_file <= std::numeric_limits<int>::max() ? static_cast<int>(of_file) : -1);
    neighbours.push_back(of.neighbours);
    layer.push_back(of.layer);
    const auto known = std::find(groups.begin(), groups.end(), mosaic.cells[c].group);
    group.push_back(static_cast<int>(known - groups.begin()));
    if (known == groups.end()) groups.push_back(mosaic.cells[c].group);
    area.push_back(static_cast<float>(of.area));
    perimeter.push_back(static_cast<float>(of.perimeter));
    circularity.push_back(static_cast<float>(of.circularity));
    elongation.push_back(static_cast<float>(of.elongation));
  }
  mesh.cell_data = {{"cell", 1, cell},
                    {"number", 1, number},
                    {"group", 1, group},
                    {"neighbours", 1, neighbours},
                    {"layer", 1, layer},
                    {"area", 1, area},
                    {"perimeter", 1, perimeter},
                    {"circularity", 1, circularity},
                    {"elongation", 1, elongation}};
  return mesh;
}

}  // namespace

bool is_export_ending(const fs::path& path) {
  static constexpr std::array kEndings{".csv", ".tess", ".off", ".txt", ".vtp", ".svg", ".png", ".pdf"};
  return std::find(kEndings.begin(), kEndings.end(), path.extension().string()) != kEndings.end();
}

std::vector<fs::path> write_cells(const fs::path& path, const Mosaic& mosaic, const std::vector<Disk>& seeds) {
  const std::string ending = path.extension().string();
  if (!is_export_ending(path))
    throw DataError(fmt::format("{}: unknown format \"{}\"; must end in {}", path.string(), ending, kExportEndings));
  if (ending == ".csv") return write_tables(path, mosaic);
  if (ending == ".tess")
    write_text_file(path, tess_text(mosaic, seeds));
  else if (ending == ".off")
    write_text_file(path, off_text(mosaic));
  else if (ending == ".txt")
    write_text_file(path, polygons_text(mosaic));
  else if (ending == ".vtp")
    write_vtp(path, mesh_of(mosaic));
  else
    draw_mosaic(path, mosaic);
  return {path};
}

Mosaic outlines_of(const Sample& sample) {
  Mosaic mosaic;
  mosaic.box = sample.box;
  for (Index c = 0; c < sample.cells(); ++c) {
    if (!sample.closed[c]) continue;
    MosaicCell cell;
    for (Index k = sample.cell_begin[c]; k < sample.cell_begin[c + 1]; ++k) {
      cell.vertex.push_back(static_cast<Index>(mosaic.vertices.size()));
      cell.side.push_back(sample.side[k]);
      mosaic.vertices.push_back(sample.x[k]);
    }
    cell.name = fmt::format("cell {}", c);
    cell.group = sample.group_names[sample.group[c]];
    mosaic.cells.push_back(std::move(cell));
  }
  if (mosaic.cells.empty()) throw DataError("the sample has no closed cell to export");
  return mosaic;
}

}  // namespace lamella
