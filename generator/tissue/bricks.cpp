#include "generator/tissue/bricks.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

using Line = std::vector<double>;  // places of vertical joints, and the ends of the box, from the left [bricks]

Line joints(const SampleScene& s, int row) {
  Line line{0};
  if (s.shift > 0 && row % 2 == 1)
    for (int i = 0; i < s.columns; ++i) line.push_back(i + s.shift);
  else
    for (int i = 1; i < s.columns; ++i) line.push_back(i);
  line.push_back(s.columns);
  return line;
}

/// All joints that end on the line between two rows. Those of both are the same numbers, or apart by the shift.
Line merged(const Line& a, const Line& b) {
  Line all;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

void refuse_bad_bricks(const SampleScene& s) {
  if (s.columns < 1 || s.rows < 1 || !(s.brick.array() > 0).all() || !s.brick.allFinite())
    throw SceneError(
        fmt::format("sample.brick = [{:g}, {:g}] with {} columns and {} rows: bricks need a positive width and height, "
                    "and at least one column and row",
                    s.brick.x(), s.brick.y(), s.columns, s.rows));
  if (!(s.shift >= 0 && s.shift < 1))
    throw SceneError(fmt::format("sample.shift = {:g}: must be at least 0 and below 1, in widths of a brick", s.shift));
  if (static_cast<double>(s.columns) * s.rows > 2e7)
    throw SceneError(fmt::format("sample: {} x {} bricks are more than the 2e7 that are possible", s.columns, s.rows));
}

}  // namespace

Mosaic make_bricks(const SampleScene& s) {
  refuse_bad_bricks(s);
  Mosaic mosaic;
  mosaic.box = {Vec2::Zero(), Vec2(s.columns * s.brick.x(), s.rows * s.brick.y())};
  const auto add_line = [&](const Line& line, int j) {
    const auto first = static_cast<Index>(mosaic.vertices.size());
    for (const double x : line) mosaic.vertices.emplace_back(x * s.brick.x(), j * s.brick.y());
    return first;
  };
  const auto place = [](const Line& line, double x) {
    return static_cast<Index>(std::lower_bound(line.begin(), line.end(), x) - line.begin());
  };
  Line below = joints(s, 0);
  Index below_first = add_line(below, 0);
  for (int j = 0; j < s.rows; ++j) {
    const Line row = joints(s, j);
    const bool last = j + 1 == s.rows;
    const Line above = last ? row : merged(row, joints(s, j + 1));
    const Index above_first = add_line(above, j + 1);
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      MosaicCell cell;
      const Index b0 = place(below, row[i]), b1 = place(below, row[i + 1]);
      const Index a0 = place(above, row[i]), a1 = place(above, row[i + 1]);
      for (Index k = b0; k < b1; ++k) {
        cell.vertex.push_back(below_first + k);
        cell.side.push_back(j == 0 ? kBottom : 0);
      }
      cell.vertex.push_back(below_first + b1);
      cell.side.push_back(i + 2 == row.size() ? kRight : 0);
      for (Index k = a1; k > a0; --k) {
        cell.vertex.push_back(above_first + k);
        cell.side.push_back(last ? kTop : 0);
      }
      cell.vertex.push_back(above_first + a0);
      cell.side.push_back(i == 0 ? kLeft : 0);
      cell.name = fmt::format("brick {},{}", i, j);
      mosaic.cells.push_back(std::move(cell));
    }
    below = above;
    below_first = above_first;
  }
  return mosaic;
}

}  // namespace lamella
