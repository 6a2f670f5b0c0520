#include "generator/image/labels.h"

#include <algorithm>

#include "generator/image/distance.h"
#include "generator/image/regions.h"

namespace lamella {

Regions regions_of(const LabelImage& labels) {
  Regions regions;
  regions.of.resize(labels.pixels());
  UnionFind sets;
  const auto w = static_cast<std::size_t>(labels.width);
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      const std::size_t k = labels.at(x, y);
      const bool left = x > 0 && labels.cell[k - 1] == labels.cell[k];
      const bool up = y > 0 && labels.cell[k - w] == labels.cell[k];
      if (left && up && regions.of[k - 1] != regions.of[k - w]) sets.join(regions.of[k - 1], regions.of[k - w]);
      regions.of[k] = left ? regions.of[k - 1] : up ? regions.of[k - w] : sets.add();
    }
  std::vector<Index> name;  // of the provisional regions, in the order of their first pixels
  for (std::size_t k = 0; k < labels.pixels(); ++k) {
    const Index first = sets.root(regions.of[k]);
    if (first >= static_cast<Index>(name.size())) name.resize(first + 1, -1);
    if (name[first] < 0) {
      name[first] = static_cast<Index>(regions.cell.size());
      regions.cell.push_back(labels.cell[k]);
      regions.area.push_back(0);
    }
    regions.of[k] = name[first];
    ++regions.area[name[first]];
  }
  return regions;
}

LabelImage labels_of(const Picture& picture, std::uint32_t background, bool& pieces) {
  LabelImage labels;
  labels.width = picture.width;
  labels.height = picture.height;
  for (std::size_t k = 0; k < picture.value.size(); ++k)
    if (k == 0 || picture.value[k] != picture.value[k - 1]) labels.number.push_back(picture.value[k]);
  std::sort(labels.number.begin(), labels.number.end());
  labels.number.erase(std::unique(labels.number.begin(), labels.number.end()), labels.number.end());
  std::erase(labels.number, background);
  labels.number.shrink_to_fit();
  labels.cell.resize(picture.value.size());
  for (std::size_t k = 0; k < labels.cell.size(); ++k) {
    const std::uint32_t value = picture.value[k];
    if (k > 0 && value == picture.value[k - 1])
      labels.cell[k] = labels.cell[k - 1];
    else if (value == background)
      labels.cell[k] = kBackground;
    else
      labels.cell[k] = static_cast<Index>(std::lower_bound(labels.number.begin(), labels.number.end(), value) -
                                          labels.number.begin());
  }
  pieces = false;
  if (labels.number.size() != 1) return labels;
  const Regions regions = regions_of(labels);
  std::vector<Index> piece;
  Index count = 0;
  for (const Index cell : regions.cell) piece.push_back(cell == kBackground ? kBackground : count++);
  if (count < 2) return labels;
  pieces = true;
  for (std::size_t k = 0; k < labels.cell.size(); ++k) labels.cell[k] = piece[regions.of[k]];
  labels.number.clear();
  for (Index c = 1; c <= count; ++c) labels.number.push_back(static_cast<std::uint32_t>(c));
  return labels;
}

namespace {

/// Background pixels that a square of `side` background pixels covers.
std::vector<char> thick_background(const LabelImage& labels, int side) {
  const auto w = static_cast<std::size_t>(labels.width);
  std::vector<char> covered(labels.pixels(), 0);
  // Side of the largest square that ends at a pixel, by those of its three neighbours; a row at a time.
  std::vector<Index> above(w, 0), here(w, 0);
  for (int y = 0; y < labels.height; ++y) {
    for (std::size_t x = 0; x < w; ++x) {
      const bool free = labels.cell[y * w + x] == kBackground;
      here[x] = !free ? 0 : x == 0 || y == 0 ? 1 : 1 + std::min({above[x], above[x - 1], here[x - 1]});
      if (here[x] >= side) covered[y * w + x] = 1;
    }
    std::swap(above, here);
  }
  // The squares that end there: up to side - 1 pixels to the left, then up.
  const auto spread = [&](std::size_t last, std::size_t step, std::size_t count) {
    int reach = 0;
    for (std::size_t i = 0, k = last; i < count; ++i, k -= step) {
      if (covered[k])
        reach = side;
      else if (reach > 0)
        covered[k] = 1;
      if (reach > 0) --reach;
    }
  };
  for (int y = 0; y < labels.height; ++y) spread(labels.at(labels.width - 1, y), 1, w);
  for (int x = 0; x < labels.width; ++x)
    spread(labels.at(x, labels.height - 1), w, static_cast<std::size_t>(labels.height));
  return covered;
}

}  // namespace

std::size_t close_gaps(LabelImage& labels, int square) {
  if (labels.number.empty() || std::find(labels.cell.begin(), labels.cell.end(), kBackground) == labels.cell.end())
    return 0;
  const std::vector<char> background = thick_background(labels, square);
  std::vector<char> cells(labels.pixels());
  for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = labels.cell[k] != kBackground;
  const std::vector<Index> nearest = nearest_marked(cells, labels.width, labels.height);
  std::size_t given = 0;
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (!cells[k] && !background[k]) {
      labels.cell[k] = labels.cell[nearest[k]];
      ++given;
    }
  return given;
}

}  // namespace lamella
