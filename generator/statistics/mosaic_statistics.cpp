#include "generator/statistics/mosaic_statistics.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

template <class Get>
Moments moments_of(const std::vector<CellMeasures>& cells, const std::vector<bool>& counts, Get get) {
  std::vector<double> values;
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (counts[c]) values.push_back(get(cells[c]));
  return moments(values);
}

/// Mean and standard error of what is added.
struct Mean {
  double sum = 0, squares = 0;
  Index count = 0;
  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double value() const { return count > 0 ? sum / count : 0; }
  double error() const {
    return count > 1 ? std::sqrt(std::max(0.0, squares / count - value() * value()) / (count - 1)) : 0;
  }
};

/// n m(n): the sum of the neighbours' n, over n.
void relate_neighbours(const MosaicMeasures& measures, const std::vector<bool>& counts, MosaicStatistics& s) {
  std::vector<double> n, sums;
  std::map<Index, Mean> mean;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    const auto& around = measures.neighbours[c];
    if (!counts[c] || !std::all_of(around.begin(), around.end(), [&](Index other) { return counts[other]; })) continue;
    double sum = 0;
    for (const Index other : around) sum += measures.cells[other].neighbours;
    n.push_back(measures.cells[c].neighbours);
    sums.push_back(sum);
    if (!around.empty()) mean[measures.cells[c].neighbours].add(sum / static_cast<double>(around.size()));
  }
  s.aboav = fit_line(n, sums);
  s.aboav_a = 6 - s.aboav.slope;
  s.weaire_sum = moments(sums).mean;
  for (const auto& [neighbours, of] : mean) {
    ByNeighbours& entry = s.by_neighbours[neighbours];
    entry.surrounded = of.count;
    entry.neighbours = of.value();
    entry.neighbours_error = of.error();
  }
}

void relate_areas(const MosaicMeasures& measures, const std::vector<bool>& counts, MosaicStatistics& s) {
  std::vector<double> excess, areas;
  std::map<Index, Mean> mean;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    if (!counts[c]) continue;
    const CellMeasures& cell = measures.cells[c];
    excess.push_back(cell.neighbours - 6);
    areas.push_back(cell.area / s.areas.mean);
    mean[cell.neighbours].add(areas.back());
  }
  s.lewis = fit_line(excess, areas);
  for (const auto& [neighbours, of] : mean) {
    ByNeighbours& entry = s.by_neighbours[neighbours];
    entry.count = of.count;
    entry.share = of.count / static_cast<double>(s.counted);
    entry.area = of.value();
    entry.area_error = of.error();
  }
}

}  // namespace

Histogram histogram(const std::vector<double>& values, double low, double high, int bars) {
  Histogram h{low, (high - low) / bars, std::vector<double>(bars, 0)};
  if (values.empty() || !(h.width > 0)) return h;
  const double each = 1 / (h.width * static_cast<double>(values.size()));
  for (const double v : values) {
    const auto k = static_cast<long>(std::floor((v - low) / h.width));
    if (k >= 0 && k < bars) h.density[k] += each;
  }
  return h;
}

MosaicStatistics statistics(const MosaicMeasures& measures, Index layers) {
  const auto& cells = measures.cells;
  MosaicStatistics s;
  s.cells = static_cast<Index>(cells.size());
  std::vector<bool> counts(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    counts[c] = cells[c].layer < 0 || cells[c].layer >= layers;
    s.counted += counts[c];
  }
  s.all_areas = moments_of(cells, std::vector<bool>(cells.size(), true), [](const auto& c) { return c.area; });
  s.areas = moments_of(cells, counts, [](const auto& c) { return c.area; });
  s.perimeters = moments_of(cells, counts, [](const auto& c) { return c.perimeter; });
  s.circularities = moments_of(cells, counts, [](const auto& c) { return c.circularity; });
  s.elongations = moments_of(cells, counts, [](const auto& c) { return c.elongation; });
  s.neighbours = moments_of(cells, counts, [](const auto& c) { return c.neighbours; });
  s.mu2 = s.neighbours.variance;
  s.square_mean = s.mu2 + s.neighbours.mean * s.neighbours.mean;
  std::vector<double> lengths;
  for (const SharedWall& wall : measures.walls)
    if (counts[wall.cell_a] && counts[wall.cell_b]) lengths.push_back(wall.length);
  s.walls = moments(lengths);
  std::vector<double> relative;
  for (const CellMeasures& cell : cells) relative.push_back(cell.area / s.all_areas.mean);
  // Four standard deviations, and more bars where there are cells to fill them.
  const double high = std::max(1.5, 1 + 4 * s.all_areas.cv());
  const int bars = std::clamp(static_cast<int>(2 * std::cbrt(static_cast<double>(cells.size()))), 12, 80);
  // The mean lies in the middle of a bar: equal areas are one bar, whatever their rounding.
  const double width = 1 / (std::max(1.0, std::floor(bars / high)) + 0.5);
  const int count = static_cast<int>(std::ceil(high / width));
  s.area_histogram = histogram(relative, 0, count * width, count);
  if (s.counted == 0) return s;
  relate_areas(measures, counts, s);
  relate_neighbours(measures, counts, s);
  return s;
}

}  // namespace lamella
