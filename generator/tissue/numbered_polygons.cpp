// Polygons of files that number their vertices: Neper's .tess, and .off of computer graphics.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "generator/packing/tess_file.h"
#include "generator/packing/word_reader.h"
#include "generator/tissue/polygon_file.h"

namespace lamella {
namespace {

std::vector<ImportedCell> tess_cells(const std::filesystem::path& path, double scale, Notes& notes) {
  const TessFile tess = read_tess(path);
  if (tess.periodic)
    notes.push_back(fmt::format("{}: periodic; its cells are taken as they lie, without their images", path.string()));
  std::vector<ImportedCell> cells;
  cells.reserve(tess.faces.size());
  for (std::size_t f = 0; f < tess.faces.size(); ++f) {
    ImportedCell cell;
    cell.label = std::to_string(tess.id[f]);
    cell.vertex = tess.faces[f].vertex;
    cell.lines.assign(cell.vertex.size(), tess.faces[f].line);
    for (const Index v : cell.vertex) cell.points.push_back(scale * tess.vertices[v]);
    cells.push_back(std::move(cell));
  }
  return cells;
}

/// Points of an .off file in the plane z = 0.
std::vector<Vec2> off_points(WordReader& in, int count, double scale) {
  std::vector<Vec2> points;
  for (int k = 0; k < count; ++k) {
    const double x = in.number("x"), y = in.number("y"), z = in.number("z");
    if (z != 0) in.refuse(fmt::format("z is {}; must be 0, for cells in the plane", z));
    points.push_back(scale * Vec2(x, y));
    in.pass_line();  // normals or colours
  }
  return points;
}

ImportedCell off_face(WordReader& in, const std::vector<Vec2>& points) {
  ImportedCell cell;
  const int corners = in.count("the number of the face's vertices");
  if (corners < 3) in.refuse(fmt::format("a face of {} vertices; it needs at least 3", corners));
  for (int k = 0; k < corners; ++k) {
    cell.vertex.push_back(in.whole("a face's vertex", 0, static_cast<int>(points.size()) - 1));
    cell.lines.push_back(in.line());
    cell.points.push_back(points[cell.vertex.back()]);
  }
  auto sorted = cell.vertex;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
    in.refuse(fmt::format("the face has vertex {} twice", *twice));
  in.pass_line();  // its colour
  return cell;
}

std::vector<ImportedCell> off_cells(const std::filesystem::path& path, double scale) {
  WordReader in(path, "polygons (.off)");
  if (in.next("OFF") != "OFF") in.refuse("an .off file begins with OFF");
  const int count = in.count("the number of vertices");
  const int faces = in.count("the number of faces");
  in.whole("the number of edges", 0, std::numeric_limits<int>::max());
  const std::vector<Vec2> points = off_points(in, count, scale);
  std::vector<ImportedCell> cells;
  std::vector<int> uses(points.size(), 0);
  for (int f = 0; f < faces; ++f) {
    cells.push_back(off_face(in, points));
    cells.back().label = std::to_string(f);
    for (const Index v : cells.back().vertex) ++uses[v];
  }
  if (!in.at_end()) {
    in.next("the end");
    in.refuse(fmt::format("more than the {} faces that the file announces", faces));
  }
  // Cells that name no common vertex may still lie side by side: then places decide.
  if (std::none_of(uses.begin(), uses.end(), [](int n) { return n > 1; }))
    for (ImportedCell& cell : cells) cell.vertex.clear();
  return cells;
}

}  // namespace

std::vector<ImportedCell> read_numbered_polygons(const std::filesystem::path& path, double scale, Notes& notes) {
  return path.extension() == ".off" ? off_cells(path, scale) : tess_cells(path, scale, notes);
}

}  // namespace lamella
