#include "generator/image/segment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "generator/image/distance.h"
#include "generator/image/regions.h"

namespace lamella {
namespace {

/// A constriction narrower than this fraction of the narrower cell parts two cells.
constexpr double kConstriction = 0.75;
/// Unless the widths differ by less than pixels can tell [pixels].
constexpr double kSameWidth = 1;

/// Convolves the rows with a Gaussian, mirrored at the sides, and transposes. `value` is height x width.
std::vector<float> blurred_rows(const std::vector<float>& value, int width, int height, double deviation) {
  const int reach = static_cast<int>(std::ceil(3 * deviation));
  std::vector<float> weight;
  for (int k = 0; k <= reach; ++k) weight.push_back(static_cast<float>(std::exp(-0.5 * k * k / deviation / deviation)));
  const float total = 2 * std::accumulate(weight.begin() + 1, weight.end(), 0.0F) + weight[0];
  std::vector<float> result(value.size());
  std::vector<float> row(static_cast<std::size_t>(width) + 2 * reach);
  for (int y = 0; y < height; ++y) {
    const float* from = value.data() + static_cast<std::size_t>(y) * width;
    for (int x = -reach; x < width + reach; ++x) {
      int mirrored = x % (2 * width);
      if (mirrored < 0) mirrored += 2 * width;
      row[x + reach] = from[std::min(mirrored, 2 * width - 1 - mirrored)];
    }
    for (int x = 0; x < width; ++x) {
      float sum = weight[0] * row[x + reach];
      for (int k = 1; k <= reach; ++k) sum += weight[k] * (row[x + reach - k] + row[x + reach + k]);
      result[static_cast<std::size_t>(x) * height + y] = sum / total;
    }
  }
  return result;
}

/// The basins of the distance, as labels; kBackground on walls. Pixels come from the deepest on; where two basins
/// meet, the place is a constriction of its width, and they are one cell unless it is narrow.
LabelImage basins(const std::vector<std::int64_t>& square, int width, int height) {
  std::vector<Index> order;
  for (std::size_t k = 0; k < square.size(); ++k)
    if (square[k] > 0) order.push_back(static_cast<Index>(k));
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return square[a] > square[b]; });
  std::vector<Index> basin(square.size(), -1);
  UnionFind sets;
  std::vector<double> depth;  // of every set: the largest distance in it
  for (const Index k : order) {
    const double here = std::sqrt(static_cast<double>(square[k]));
    std::array<Index, 4> met{};
    std::size_t count = 0;
    Index deepest = -1;  // neighbour
    const auto look = [&](bool inside, Index other) {
      if (!inside || basin[other] < 0) return;
      met[count++] = basin[other];
      if (deepest < 0 || square[other] > square[deepest]) deepest = other;
    };
    look(k % width > 0, k - 1);
    look(k % width < width - 1, k + 1);
    look(k >= width, k - width);
    look(k / width < height - 1, k + width);
    if (count == 0) {
      basin[k] = sets.add();
      depth.push_back(here);
      continue;
    }
    basin[k] = basin[deepest];
    for (std::size_t i = 0; i < count; ++i) {
      const Index a = sets.root(met[i]);
      const Index b = sets.root(basin[k]);
      const double shallower = std::min(depth[a], depth[b]);
      if (a == b || (here < kConstriction * shallower && shallower - here > kSameWidth)) continue;
      const double deeper = std::max(depth[a], depth[b]);
      sets.join(a, b);
      depth[sets.root(a)] = deeper;
    }
  }
  LabelImage labels{width, height, std::vector<Index>(square.size(), kBackground), {}};
  std::vector<Index> name(depth.size(), -1);
  for (std::size_t k = 0; k < square.size(); ++k) {
    if (basin[k] < 0) continue;
    Index& cell = name[sets.root(basin[k])];
    if (cell < 0) {
      cell = static_cast<Index>(labels.number.size());
      labels.number.push_back(static_cast<std::uint32_t>(cell) + 1);
    }
    labels.cell[k] = cell;
  }
  return labels;
}

/// One quantile of the thickness along each wall. Across the middle of a wall the distances to the cells on both sides
/// sum to its thickness: of n pixels between two cells the k-th is k and n + 1 - k pixels from them.
std::vector<double> thicknesses(const LabelImage& grown, const std::vector<std::int64_t>& to_cell, double quantile) {
  std::map<std::pair<Index, Index>, std::vector<double>> across;
  const auto meet = [&](std::size_t p, std::size_t q) {
    const Index a = grown.cell[p], b = grown.cell[q];
    if (a == b || a < 0 || b < 0 || (to_cell[p] == 0 && to_cell[q] == 0)) return;
    across[std::minmax(a, b)].push_back(std::sqrt(static_cast<double>(to_cell[p])) +
                                        std::sqrt(static_cast<double>(to_cell[q])));
  };
  for (int y = 0; y < grown.height; ++y)
    for (int x = 0; x < grown.width; ++x) {
      if (x > 0) meet(grown.at(x - 1, y), grown.at(x, y));
      if (y > 0) meet(grown.at(x, y - 1), grown.at(x, y));
    }
  std::vector<double> result;
  for (auto& [wall, widths] : across) {
    if (widths.size() < 4) continue;
    const auto at = widths.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(widths.size()));
    std::nth_element(widths.begin(), at, widths.end());
    result.push_back(*at);
  }
  return result;
}

/// Median along each wall, which forgets its ends, where walls meet; then mean and deviation over walls.
void measure_walls(const LabelImage& grown, const std::vector<std::int64_t>& to_cell, Segmentation& result) {
  const auto medians = thicknesses(grown, to_cell, 0.5);
  result.walls = static_cast<int>(medians.size());
  if (medians.empty()) return;
  double squares = 0;
  for (const double t : medians) result.thickness += t / result.walls;
  for (const double t : medians) squares += (t - result.thickness) * (t - result.thickness);
  result.deviation = std::sqrt(squares / result.walls);
}

/// Thickness up to which dark places are walls: a first guess that places between cells that are far apart do not spoil.
double thin(const LabelImage& grown, const std::vector<std::int64_t>& to_cell) {
  const auto least = thicknesses(grown, to_cell, 0.1);
  return least.empty() ? 0 : 3 * std::accumulate(least.begin(), least.end(), 0.0) / static_cast<double>(least.size());
}

std::vector<std::int64_t> squares_to(const std::vector<char>& marked, int width, int height,
                                     std::vector<Index>& nearest) {
  nearest = nearest_marked(marked, width, height);
  std::vector<std::int64_t> square(marked.size());
  const std::int64_t far = static_cast<std::int64_t>(width) * width + static_cast<std::int64_t>(height) * height;
  for (std::size_t k = 0; k < square.size(); ++k)
    square[k] = nearest[k] < 0 ? far : square_distance(static_cast<Index>(k), nearest[k], width);
  return square;
}

void flip(std::vector<char>& mask) {
  for (char& m : mask) m = static_cast<char>(!m);
}

/// Gives the connected parts of `mask` that have fewer pixels to its complement.
void drop_specks(std::vector<char>& mask, int width, int height, int least_area) {
  LabelImage parts{width, height, std::vector<Index>(mask.begin(), mask.end()), {}};
  const Regions regions = regions_of(parts);
  for (std::size_t k = 0; k < mask.size(); ++k)
    if (regions.area[regions.of[k]] < least_area) mask[k] = 0;
}

}  // namespace

double otsu_threshold(const std::vector<float>& value) {
  constexpr int bins = 1024;
  std::array<double, bins> count{};
  for (const float v : value) ++count[static_cast<std::size_t>(std::clamp(static_cast<int>(v * bins), 0, bins - 1))];
  double total = 0;
  for (int k = 0; k < bins; ++k) total += count[k] * k;
  const auto all = static_cast<double>(value.size());
  double below = 0, moment = 0, best = -1;
  int first = 0, last = 0;  // of the thresholds that are equally good: the middle is taken
  for (int k = 0; k + 1 < bins; ++k) {
    below += count[k];
    moment += count[k] * k;
    if (below == 0 || below == all) continue;
    const double difference = moment / below - (total - moment) / (all - below);
    const double between = below * (all - below) * difference * difference;
    if (between > best * (1 + 1e-12)) {
      best = between;
      first = k;
    }
    if (between >= best * (1 - 1e-12)) last = k;
  }
  return (0.5 * (first + last) + 1) / bins;
}

Segmentation segment(const Picture& picture, const Segmenting& how) {
  const int width = picture.width, height = picture.height;
  std::vector<float> value(picture.pixels());
  for (std::size_t k = 0; k < value.size(); ++k)
    value[k] = static_cast<float>(static_cast<double>(picture.value[k]) / picture.white);
  const std::vector<float> unblurred = how.smoothing > 0 ? value : std::vector<float>();
  if (how.smoothing > 0)
    value = blurred_rows(blurred_rows(value, width, height, how.smoothing), height, width, how.smoothing);
  Segmentation result;
  result.threshold = how.threshold ? *how.threshold : otsu_threshold(value);
  const auto wall_mask = [&](const std::vector<float>& grey) {
    std::vector<char> wall(grey.size());
    for (std::size_t k = 0; k < grey.size(); ++k) wall[k] = (grey[k] < result.threshold) == how.dark_walls;
    drop_specks(wall, width, height, how.least_area);
    flip(wall);
    drop_specks(wall, width, height, how.least_area);
    flip(wall);
    return wall;
  };
  std::vector<char> wall = wall_mask(value);
  std::vector<Index> nearest;
  result.labels = basins(squares_to(wall, width, height, nearest), width, height);
  if (result.labels.number.empty()) return result;
  flip(wall);
  const auto to_cell = squares_to(wall, width, height, nearest);
  LabelImage grown = result.labels;
  for (std::size_t k = 0; k < grown.pixels(); ++k) grown.cell[k] = result.labels.cell[nearest[k]];
  close_gaps(result.labels, std::max(4, static_cast<int>(std::ceil(thin(grown, to_cell))) + 1));
  // The blur makes thin walls thicker, so they are measured without it, where they are not background.
  std::vector<char> sharp = how.smoothing > 0 ? wall_mask(unblurred) : wall;
  if (how.smoothing > 0) flip(sharp);
  measure_walls(result.labels, squares_to(sharp, width, height, nearest), result);
  return result;
}

}  // namespace lamella
