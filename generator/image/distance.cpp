#include "generator/image/distance.h"

#include <cmath>

namespace lamella {
namespace {

/// For every pixel the row of the nearest marked pixel of its column, or -1.
std::vector<Index> nearest_rows(const std::vector<char>& marked, int width, int height) {
  std::vector<Index> row(marked.size(), -1);
  const auto w = static_cast<std::size_t>(width);
  for (int y = 0; y < height; ++y)
    for (std::size_t k = y * w; k < (y + 1) * w; ++k) row[k] = marked[k] ? y : y > 0 ? row[k - w] : -1;
  for (int y = height - 2; y >= 0; --y)
    for (std::size_t k = y * w; k < (y + 1) * w; ++k) {
      const Index below = row[k + w];
      if (below >= 0 && (row[k] < 0 || below - y < y - row[k])) row[k] = below;
    }
  return row;
}

}  // namespace

std::vector<Index> nearest_marked(const std::vector<char>& marked, int width, int height) {
  std::vector<Index> nearest = nearest_rows(marked, width, height);
  struct Parabola {
    std::int64_t column, square;  // (x - column)^2 + square
    Index source;
    int from;  // it is the lowest from here on
  };
  std::vector<Parabola> lowest;
  for (int y = 0; y < height; ++y) {
    Index* row = nearest.data() + static_cast<std::size_t>(y) * width;
    lowest.clear();
    for (int x = 0; x < width; ++x) {
      if (row[x] < 0) continue;
      const std::int64_t rise = y - row[x];
      Parabola fresh{x, rise * rise, row[x] * width + x, 0};
      while (!lowest.empty()) {
        const Parabola& top = lowest.back();
        // First pixel at which the fresh one is strictly lower.
        const double crossing =
            static_cast<double>(fresh.column * fresh.column - top.column * top.column + fresh.square - top.square) /
            static_cast<double>(2 * (fresh.column - top.column));
        const double from = std::max(0.0, std::floor(crossing) + 1);
        if (from > top.from) {
          fresh.from = from < width ? static_cast<int>(from) : width;
          break;
        }
        lowest.pop_back();
      }
      if (fresh.from < width) lowest.push_back(fresh);
    }
    if (lowest.empty()) continue;
    std::size_t k = 0;
    for (int x = 0; x < width; ++x) {
      while (k + 1 < lowest.size() && lowest[k + 1].from <= x) ++k;
      row[x] = lowest[k].source;
    }
  }
  return nearest;
}

}  // namespace lamella
