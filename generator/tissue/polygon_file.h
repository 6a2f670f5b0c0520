// Cells from elsewhere: text, `x y cell` a line, consecutive points of a cell.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "generator/generate.h"
#include "generator/sample/vec.h"

namespace lamella {

struct ImportedCell {
  std::string label;
  std::vector<Vec2> points;  // counter-clockwise [m]
  std::vector<int> lines;    // of the file, of every point
};

/// Columns are separated by blanks, commas or semicolons, `#` starts a comment, the cell's label is any word. Either
/// orientation; a closing point that repeats the first is left out, with a note. Throws SceneError with every fault as
/// `file:line: ...`: wrong columns, no number, not finite, fewer than three points, repeated points, no area, a
/// label used again later, outlines that cross themselves. DataError when the file cannot be read.
std::vector<ImportedCell> read_polygons(const std::filesystem::path& path, double scale, Notes& notes);

}  // namespace lamella
