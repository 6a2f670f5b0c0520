// Cells from elsewhere: text, `x y cell` a line, consecutive points of a cell; Neper's .tess; .off.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "generator/generate.h"
#include "generator/sample/sample.h"
#include "generator/sample/vec.h"

namespace lamella {

struct ImportedCell {
  std::string label;
  std::vector<Vec2> points;   // counter-clockwise [m]
  std::vector<int> lines;     // of the file, of every point
  std::vector<Index> vertex;  // of every point its number, where the file numbers what cells share; otherwise empty
};

/// *.tess and *.off: read_numbered_polygons. Of other files columns are separated by blanks, commas or semicolons, `#` starts a comment, the cell's label is any word. Either
/// orientation; a closing point that repeats the first is left out, with a note. Throws SceneError with every fault as
/// `file:line: ...`: wrong columns, no number, not finite, fewer than three points, repeated points, no area, a
/// label used again later, outlines that cross themselves. DataError when the file cannot be read.
std::vector<ImportedCell> read_polygons(const std::filesystem::path& path, double scale, Notes& notes);

/// Faces of a .tess or .off file, whose vertices are numbered: two cells that name the same vertices share a wall, and
/// nothing is compared by place. An .off file in which no two faces share a vertex is one whose walls coincide: then
/// ImportedCell::vertex stays empty. Checked as far as the format goes; read_polygons checks the rest.
std::vector<ImportedCell> read_numbered_polygons(const std::filesystem::path& path, double scale, Notes& notes);

}  // namespace lamella
