#include "generator/tissue/bricks.h"

#include <fmt/format.h>

#include "generator/sample/errors.h"
#include "generator/tissue/lattice.h"

namespace lamella {
namespace {

/// Places along a row in whole numbers, so that those of two rows are the same or are not: 2 i at i bricks, 2 i + 1 at i + shift.
struct Row {
  std::vector<int> ends;  // of its bricks, from the left; the last is the right end of the last
};

class Courses {
 public:
  explicit Courses(const SampleScene& s) : s_(s), periodic_(periodic_of(s)) {
    for (int j = 0; j < s.rows; ++j) {
      const bool shifted = s.shift > 0 && j % 2 == 1;
      Row row;
      if (shifted && !periodic_[0]) row.ends.push_back(0);
      for (int i = 0; i < s.columns; ++i) row.ends.push_back(2 * i + (shifted ? 1 : 0));
      row.ends.push_back(2 * s.columns + (shifted && periodic_[0] ? 1 : 0));
      rows_.push_back(std::move(row));
    }
    const int lines = periodic_[1] ? s.rows : s.rows + 1;
    id_.assign(static_cast<std::size_t>(lines), std::vector<Index>(static_cast<std::size_t>(places()), -1));
    for (int j = 0; j < s.rows; ++j)
      for (const int line : {j, j + 1})
        for (const int end : rows_[static_cast<std::size_t>(j)].ends) at(line, end) = -2;
    mosaic_.periodic = periodic_;
    mosaic_.box = {Vec2::Zero(), Vec2(s.columns * s.brick.x(), s.rows * s.brick.y())};
    number_vertices();
  }

  Mosaic take() {
    for (int j = 0; j < s_.rows; ++j) {
      const std::vector<int>& ends = rows_[static_cast<std::size_t>(j)].ends;
      for (std::size_t i = 0; i + 1 < ends.size(); ++i) add_brick(j, static_cast<int>(i), ends[i], ends[i + 1]);
    }
    return std::move(mosaic_);
  }

 private:
  /// Places of a line; along x the last is the first again, or an end of its own.
  int places() const { return 2 * s_.columns + (periodic_[0] ? 0 : 1); }
  Index& at(int line, int place) {
    return id_[static_cast<std::size_t>(line) % id_.size()][static_cast<std::size_t>(place % places())];
  }

  void number_vertices() {
    for (std::size_t j = 0; j < id_.size(); ++j)
      for (int place = 0; place < places(); ++place)
        if (Index& id = id_[j][static_cast<std::size_t>(place)]; id == -2) {
          id = static_cast<Index>(mosaic_.vertices.size());
          const double x = place / 2 + (place % 2 == 1 ? s_.shift : 0);
          mosaic_.vertices.emplace_back(x * s_.brick.x(), static_cast<double>(j) * s_.brick.y());
        }
  }

  void add_corner(MosaicCell& cell, int line, int place, int bits) {
    cell.vertex.push_back(at(line, place));
    if (periodic_[0] || periodic_[1])
      cell.image.push_back({static_cast<std::int8_t>(place / places()),
                            static_cast<std::int8_t>(static_cast<std::size_t>(line) / id_.size())});
    cell.side.push_back(static_cast<std::uint8_t>(bits));
  }

  void add_brick(int j, int i, int from, int to) {
    const bool low = j == 0 && !periodic_[1], high = j + 1 == s_.rows && !periodic_[1];
    const bool left = from == 0 && !periodic_[0], right = to == 2 * s_.columns && !periodic_[0];
    MosaicCell cell;
    cell.name = fmt::format("brick {},{}", i, j);
    for (int place = from; place < to; ++place)
      if (at(j, place) >= 0) add_corner(cell, j, place, low ? kBottom : 0);
    add_corner(cell, j, to, right ? kRight : 0);
    for (int place = to; place > from; --place)
      if (at(j + 1, place) >= 0) add_corner(cell, j + 1, place, high ? kTop : 0);
    add_corner(cell, j + 1, from, left ? kLeft : 0);
    mosaic_.cells.push_back(std::move(cell));
  }

  const SampleScene& s_;
  Periodic periodic_;
  std::vector<Row> rows_;
  std::vector<std::vector<Index>> id_;  // of each line between rows and each place; -1: no vertex there
  Mosaic mosaic_;
};

}  // namespace

Mosaic make_bricks(const SampleScene& s) {
  if (s.columns < 1 || s.rows < 1 || !(s.brick.array() > 0).all() || !s.brick.allFinite())
    throw SceneError(
        fmt::format("sample.brick = [{:g}, {:g}] with {} columns and {} rows: bricks need a positive width and height, "
                    "and at least one column and row",
                    s.brick.x(), s.brick.y(), s.columns, s.rows));
  if (!(s.shift >= 0 && s.shift < 1))
    throw SceneError(fmt::format("sample.shift = {:g}: must be at least 0 and below 1, in widths of a brick", s.shift));
  if (static_cast<double>(s.columns) * s.rows > 2e7)
    throw SceneError(fmt::format("sample: {} x {} bricks are more than the 2e7 that are possible", s.columns, s.rows));
  if (periodic_of(s)[1] && s.shift > 0 && s.rows % 2 != 0)
    throw SceneError(
        fmt::format("sample.rows: {} rows of bricks, of which every second is shifted, do not repeat along y; give an "
                    "even number, such as {}",
                    s.rows, s.rows + 1));
  return Courses(s).take();
}

}  // namespace lamella
