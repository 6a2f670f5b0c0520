// From a picture of labels to proper cells: regions are joined, corners opened, holes filled.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "generator/image/labels.h"
#include "generator/image/regions.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

constexpr Index kOutside = -2;

/// The label at a place, kOutside beyond the picture.
Index label_at(const LabelImage& labels, int x, int y) {
  return x < 0 || y < 0 || x >= labels.width || y >= labels.height ? kOutside : labels.cell[labels.at(x, y)];
}

/// Joins what is no cell of its own: pieces of scattered cells, and regions that are too small.
class Joining {
 public:
  Joining(LabelImage& labels, int least_area)
      : labels_(labels), least_area_(least_area), regions_(regions_of(labels)), sets_(regions_.area.size()) {
    largest_.assign(labels.number.size(), -1);
    for (Index r = 0; r < count(); ++r) {
      const Index cell = regions_.cell[r];
      if (cell >= 0 && (largest_[cell] < 0 || regions_.area[r] > regions_.area[largest_[cell]])) largest_[cell] = r;
    }
  }

  void run(Cleaning& done) {
    std::vector<Index> leaving;
    for (Index r = 0; r < count(); ++r)
      if (is_piece(r) || regions_.area[r] < least_area_) leaving.push_back(r);
    if (leaving.empty()) return;
    std::stable_sort(leaving.begin(), leaving.end(),
                     [&](Index a, Index b) { return regions_.area[a] < regions_.area[b]; });
    find_boundaries(leaving);
    std::vector<std::uint32_t> scattered;
    for (const Index r : leaving) {
      // A small cell may have grown by what was joined to it.
      if (!is_piece(r) && regions_.area[r] >= least_area_) continue;
      const Index target = longest_boundary(r);
      if (target < 0) continue;  // fills the picture
      const Index cell = regions_.cell[r];
      if (is_piece(r)) {
        ++done.pieces;
        scattered.push_back(labels_.number[cell]);
      } else if (cell == kBackground) {
        ++done.small_gaps;
      } else {
        done.small.push_back(labels_.number[cell]);
      }
      join(r, target);
    }
    std::sort(scattered.begin(), scattered.end());
    scattered.erase(std::unique(scattered.begin(), scattered.end()), scattered.end());
    done.scattered.insert(done.scattered.end(), scattered.begin(), scattered.end());
    for (std::size_t k = 0; k < labels_.pixels(); ++k) labels_.cell[k] = regions_.cell[keeper(regions_.of[k])];
  }

 private:
  Index count() const { return static_cast<Index>(regions_.area.size()); }
  bool is_piece(Index r) const { return regions_.cell[r] >= 0 && largest_[regions_.cell[r]] != r; }
  Index keeper(Index r) { return keeper_.empty() ? r : keeper_[sets_.root(r)]; }

  /// For every region that may leave, the region across every side of its pixels.
  void find_boundaries(const std::vector<Index>& leaving) {
    slot_.assign(regions_.area.size(), -1);
    for (std::size_t i = 0; i < leaving.size(); ++i) slot_[leaving[i]] = static_cast<Index>(i);
    across_.resize(leaving.size());
    const auto meet = [&](Index a, Index b) {
      if (a == b) return;
      if (slot_[a] >= 0) across_[slot_[a]].push_back(b);
      if (slot_[b] >= 0) across_[slot_[b]].push_back(a);
    };
    for (int y = 0; y < labels_.height; ++y)
      for (int x = 0; x < labels_.width; ++x) {
        const std::size_t k = labels_.at(x, y);
        if (x > 0) meet(regions_.of[k], regions_.of[k - 1]);
        if (y > 0) meet(regions_.of[k], regions_.of[k - labels_.width]);
      }
    keeper_.resize(regions_.area.size());
    for (Index r = 0; r < count(); ++r) keeper_[r] = r;
  }

  /// The label that the region shares most of its boundary with, as a region of that label; -1: it has none.
  Index longest_boundary(Index r) {
    std::vector<std::pair<Index, Index>> met;  // label, region
    for (const Index other : across_[slot_[r]]) {
      const Index now = keeper(other);
      if (now != r) met.emplace_back(regions_.cell[now], now);
    }
    std::sort(met.begin(), met.end());
    Index best = -1;
    std::size_t longest = 0;
    for (std::size_t i = 0; i < met.size();) {
      std::size_t end = i;
      while (end < met.size() && met[end].first == met[i].first) ++end;
      if (end - i > longest) {
        longest = end - i;
        best = met[i].second;
      }
      i = end;
    }
    return best;
  }

  void join(Index r, Index target) {
    regions_.area[target] += regions_.area[r];
    if (slot_[target] >= 0) {
      auto& across = across_[slot_[target]];
      across.insert(across.end(), across_[slot_[r]].begin(), across_[slot_[r]].end());
    }
    across_[slot_[r]] = {};
    sets_.join(r, target);
    keeper_[sets_.root(r)] = target;
  }

  LabelImage& labels_;
  int least_area_;
  Regions regions_;
  UnionFind sets_;
  std::vector<Index> largest_;              // per cell: its largest region
  std::vector<Index> slot_;                 // per region: into across_, -1 where it stays
  std::vector<std::vector<Index>> across_;  // regions as first numbered
  std::vector<Index> keeper_;               // per set: the region that it has become
};

/// Opens the corners at which a cell touches itself: of its two pixels the one that has fewer of its own beside it goes
/// to the neighbour that it has more of beside it.
std::size_t open_pinches(LabelImage& labels) {
  std::size_t opened = 0;
  const auto beside = [&](int x, int y, Index cell) {
    return (label_at(labels, x - 1, y) == cell) + (label_at(labels, x + 1, y) == cell) +
           (label_at(labels, x, y - 1) == cell) + (label_at(labels, x, y + 1) == cell);
  };
  const auto open = [&](int x0, int y0, int x1, int y1) {  // diagonal pixels of one cell
    const Index cell = labels.cell[labels.at(x0, y0)];
    const Index first = labels.cell[labels.at(x1, y0)];
    const Index second = labels.cell[labels.at(x0, y1)];
    if (cell < 0 || cell != labels.cell[labels.at(x1, y1)] || cell == first || cell == second) return;
    const bool upper = beside(x0, y0, cell) <= beside(x1, y1, cell);
    const int x = upper ? x0 : x1;
    const int y = upper ? y0 : y1;
    labels.cell[labels.at(x, y)] = beside(x, y, first) >= beside(x, y, second) ? first : second;
    ++opened;
  };
  for (int y = 0; y + 1 < labels.height; ++y)
    for (int x = 0; x + 1 < labels.width; ++x) {
      open(x, y, x + 1, y + 1);
      open(x + 1, y, x, y + 1);
    }
  return opened;
}

struct Extent {
  int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;
};

std::vector<Extent> extents(const LabelImage& labels) {
  std::vector<Extent> extent(labels.number.size());
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      const Index cell = labels.cell[labels.at(x, y)];
      if (cell < 0) continue;
      Extent& e = extent[cell];
      e = {std::min(e.left, x), std::min(e.top, y), std::max(e.right, x), std::max(e.bottom, y)};
    }
  return extent;
}

/// Cells with holes, by their Euler number: 4 (pieces - holes) counts the 2 x 2 squares with one pixel of the cell, less
/// those with three (connected through sides; no square has two diagonal ones, since pinches are open).
std::vector<Index> cells_with_holes(const LabelImage& labels) {
  std::vector<std::int64_t> number(labels.number.size(), 0);
  for (int y = 0; y <= labels.height; ++y)
    for (int x = 0; x <= labels.width; ++x) {
      const std::array<Index, 4> four{label_at(labels, x - 1, y - 1), label_at(labels, x, y - 1),
                                      label_at(labels, x - 1, y), label_at(labels, x, y)};
      if (four[0] == four[1] && four[0] == four[2] && four[0] == four[3]) continue;
      for (std::size_t i = 0; i < 4; ++i) {
        if (four[i] < 0) continue;
        const auto same = std::count(four.begin(), four.end(), four[i]);
        if (same == 1) number[four[i]] += 1;
        const bool is_first = std::find(four.begin(), four.end(), four[i]) - four.begin() == static_cast<int>(i);
        if (same == 3 && is_first) number[four[i]] -= 1;
      }
    }
  std::vector<Index> holed;
  for (std::size_t c = 0; c < number.size(); ++c)
    if (number[c] <= 0) holed.push_back(static_cast<Index>(c));
  return holed;
}

/// Gives the cell what it encloses; false when those are cells of more area than its own.
bool fill_holes(LabelImage& labels, Index cell, const Extent& extent, std::vector<Index>& enclosed) {
  // Whatever can be reached from around the cell is outside.
  const int width = extent.right - extent.left + 3;
  const int height = extent.bottom - extent.top + 3;
  std::vector<char> outside(static_cast<std::size_t>(width) * height, 0);
  const auto is_cell = [&](int x, int y) { return label_at(labels, x + extent.left - 1, y + extent.top - 1) == cell; };
  std::vector<std::pair<int, int>> open{{0, 0}};
  outside[0] = 1;
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    for (const auto& [nx, ny] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
      if (nx < 0 || ny < 0 || nx >= width || ny >= height || is_cell(nx, ny)) continue;
      char& known = outside[static_cast<std::size_t>(ny) * width + nx];
      if (!known) open.emplace_back(nx, ny);
      known = 1;
    }
  }
  std::vector<std::size_t> hole;
  std::int64_t own = 0;
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x) {
      const std::size_t k = labels.at(x + extent.left - 1, y + extent.top - 1);
      if (is_cell(x, y))
        ++own;
      else if (!outside[static_cast<std::size_t>(y) * width + x])
        hole.push_back(k);
    }
  for (const std::size_t k : hole)
    if (labels.cell[k] >= 0) enclosed.push_back(labels.cell[k]);
  std::sort(enclosed.begin(), enclosed.end());
  enclosed.erase(std::unique(enclosed.begin(), enclosed.end()), enclosed.end());
  if (!enclosed.empty() && static_cast<std::int64_t>(hole.size()) > own) return false;
  for (const std::size_t k : hole) labels.cell[k] = cell;
  return true;
}

void drop_empty_cells(LabelImage& labels) {
  std::vector<Index> name(labels.number.size(), 0);
  for (const Index cell : labels.cell)
    if (cell >= 0) name[cell] = 1;
  std::vector<std::uint32_t> number;
  for (std::size_t c = 0; c < name.size(); ++c) {
    if (name[c] == 0) continue;
    name[c] = static_cast<Index>(number.size());
    number.push_back(labels.number[c]);
  }
  for (Index& cell : labels.cell)
    if (cell >= 0) cell = name[cell];
  labels.number = std::move(number);
}

}  // namespace

Cleaning clean_labels(LabelImage& labels, int least_area) {
  Cleaning done;
  constexpr int most = 100;  // seen: 3; without bound only if pixels went round in circles
  for (int pass = 0;; ++pass) {
    Joining(labels, least_area).run(done);
    drop_empty_cells(labels);
    const std::size_t opened = open_pinches(labels);
    if (opened == 0) break;
    done.pinches += opened;
    if (pass == most)
      throw SceneError("sample.image: cells touch themselves at corners whatever is tried; smooth the picture");
  }
  const auto extent = extents(labels);
  std::vector<std::string> faults;
  std::vector<Index> gone;
  for (const Index cell : cells_with_holes(labels)) {
    if (std::any_of(gone.begin(), gone.end(), [&](Index other) { return other == cell; })) continue;
    std::vector<Index> enclosed;
    if (!fill_holes(labels, cell, extent[cell], enclosed))
      faults.push_back(
          fmt::format("sample.image: label {} encloses {} cells that are larger than itself together; if it is what "
                      "lies between or around cells, give background = {}",
                      labels.number[cell], enclosed.size(), labels.number[cell]));
    done.filled.push_back(labels.number[cell]);
    gone.insert(gone.end(), enclosed.begin(), enclosed.end());
  }
  if (!faults.empty()) throw SceneError(faults);
  for (const Index other : gone) done.enclosed.push_back(labels.number[other]);
  drop_empty_cells(labels);
  return done;
}

}  // namespace lamella
