#include "generator/tissue/lattice.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "generator/sample/errors.h"

namespace lamella {

Periodic periodic_of(const SampleScene& sample) {
  return {sample.periodic.find('x') != std::string::npos, sample.periodic.find('y') != std::string::npos};
}

Mosaic mosaic_of(const Tessellation& tessellation) {
  Mosaic mosaic;
  mosaic.box = tessellation.box;
  mosaic.periodic = tessellation.periodic;
  mosaic.vertices = tessellation.vertices;
  mosaic.cells.reserve(tessellation.tiles.size());
  for (const Tile& tile : tessellation.tiles) {
    MosaicCell cell;
    cell.vertex = tile.vertex;
    cell.image = tile.image;
    cell.name = fmt::format("site {}", tile.site);
    cell.number = tile.site;
    for (const Index neighbour : tile.neighbour) {
      switch (neighbour) {
        case kLeftSide:
          cell.side.push_back(kLeft);
          break;
        case kRightSide:
          cell.side.push_back(kRight);
          break;
        case kBottomSide:
          cell.side.push_back(kBottom);
          break;
        case kTopSide:
          cell.side.push_back(kTop);
          break;
        default:
          cell.side.push_back(0);
      }
    }
    mosaic.cells.push_back(std::move(cell));
  }
  return mosaic;
}

namespace {

/// What a pattern's number of lines must be to repeat across them.
void require_even(int lines, const char* key, const char* axis, const std::string& orientation) {
  if (lines % 2 != 0)
    throw SceneError(
        fmt::format("sample.{}: {} hexagons with orientation = \"{}\" do not repeat along {}, where every second is "
                    "shifted by half a cell; give an even number, such as {}",
                    key, lines, orientation, axis, lines + 1));
}

}  // namespace

Mosaic make_honeycomb(const SampleScene& sample) {
  if (sample.columns < 1 || sample.rows < 1 || !(sample.side > 0))
    throw SceneError("sample: a honeycomb needs columns and rows of at least 1 and a positive side");
  if (static_cast<double>(sample.columns) * sample.rows > 2e7)
    throw SceneError(
        fmt::format("sample: {} x {} hexagons are more than the 2e7 that are possible", sample.columns, sample.rows));
  // Pointy hexagons on the lattice x = i sqrt(3)/2 side, y = j side/2; flat ones are the same with x and y exchanged.
  const bool flat = sample.orientation == "flat";
  const int along = flat ? sample.rows : sample.columns;
  const int lines = flat ? sample.columns : sample.rows;
  Mosaic mosaic;
  mosaic.periodic = periodic_of(sample);
  const bool repeats = mosaic.periodic[0] || mosaic.periodic[1];
  const bool rows_repeat = mosaic.periodic[flat ? 1 : 0], lines_repeat = mosaic.periodic[flat ? 0 : 1];
  if (lines_repeat) require_even(lines, flat ? "columns" : "rows", flat ? "x" : "y", sample.orientation);
  const int width = rows_repeat ? 2 * along : 2 * along + 2;
  const int height = lines_repeat ? 3 * lines : 3 * lines + 2;
  std::vector<Index> id(static_cast<std::size_t>(width) * height, -1);
  const double half_width = std::sqrt(3.0) / 2 * sample.side;
  const auto place = [&](int i, int j) {
    Vec2 p(i * half_width, j * sample.side / 2);
    if (flat) std::swap(p.x(), p.y());
    return p;
  };
  const auto vertex = [&](int i, int j) {
    Index& known = id[static_cast<std::size_t>(j) * width + i];
    if (known < 0) {
      known = static_cast<Index>(mosaic.vertices.size());
      mosaic.vertices.push_back(place(i, j));
    }
    return known;
  };
  constexpr std::array<std::array<int, 2>, 6> corner{{{1, 0}, {2, 1}, {2, 3}, {1, 4}, {0, 3}, {0, 1}}};
  mosaic.cells.reserve(static_cast<std::size_t>(along) * lines);
  for (int line = 0; line < lines; ++line) {
    for (int k = 0; k < along; ++k) {
      MosaicCell cell;
      for (std::size_t c = 0; c < 6; ++c) {
        const auto& at = corner[flat ? 5 - c : c];  // exchanging x and y turns the way round
        const int i = 2 * k + line % 2 + at[0], j = 3 * line + at[1];
        cell.vertex.push_back(vertex(i % width, j % height));
        if (!repeats) continue;
        Image image{static_cast<std::int8_t>(i / width), static_cast<std::int8_t>(j / height)};
        if (flat) std::swap(image[0], image[1]);
        cell.image.push_back(image);
      }
      cell.side.assign(6, 0);
      cell.name = flat ? fmt::format("hexagon {},{}", line, k) : fmt::format("hexagon {},{}", k, line);
      mosaic.cells.push_back(std::move(cell));
    }
  }
  mosaic.box = {Vec2::Zero(),
                place(2 * along + (lines > 1 && !rows_repeat ? 1 : 0), 3 * lines + (lines_repeat ? 0 : 1))};
  mark_rough_sides(mosaic);
  return mosaic;
}

}  // namespace lamella
