#include "generator/tissue/crossings.h"

#include <algorithm>
#include <cmath>

#include "generator/sample/parallel.h"

namespace lamella {
namespace {

/// Twice the signed area of (a, b, c), 0 within the rounding of its terms.
double orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double first = (b.x() - a.x()) * (c.y() - a.y());
  const double second = (b.y() - a.y()) * (c.x() - a.x());
  const double scale = a.cwiseAbs().maxCoeff() + b.cwiseAbs().maxCoeff() + c.cwiseAbs().maxCoeff();
  const double rounding = 1e-15 * (std::abs(first) + std::abs(second) + scale * (b - a).cwiseAbs().maxCoeff());
  const double twice = first - second;
  return std::abs(twice) <= rounding ? 0 : twice;
}

bool cross_properly(const OwnedSegment& s, const OwnedSegment& t) {
  return orientation(s.from, s.to, t.from) * orientation(s.from, s.to, t.to) < 0 &&
         orientation(t.from, t.to, s.from) * orientation(t.from, t.to, s.to) < 0;
}

bool boxes_apart(const OwnedSegment& s, const OwnedSegment& t) {
  const auto apart = [](double a, double b, double c, double d) {
    return std::max(a, b) < std::min(c, d) || std::max(c, d) < std::min(a, b);
  };
  return apart(s.from.x(), s.to.x(), t.from.x(), t.to.x()) || apart(s.from.y(), s.to.y(), t.from.y(), t.to.y());
}

/// Which cells of a uniform grid a set of segments, known beforehand, touches: two flat arrays, where a list for every
/// cell would be a million small ones.
class Bins {
 public:
  explicit Bins(const std::vector<OwnedSegment>& segments) : segments_(segments) {
    Vec2 hi = segments[0].from;
    lo_ = hi;
    double length = 0;
    for (const OwnedSegment& s : segments) {
      lo_ = lo_.cwiseMin(s.from.cwiseMin(s.to));
      hi = hi.cwiseMax(s.from.cwiseMax(s.to));
      length += (s.to - s.from).norm();
    }
    const Vec2 size = hi - lo_;
    const auto count = static_cast<double>(segments.size());
    step_ =
        std::max({length / count, std::sqrt(size.x() * size.y() / (4 * count + 4)), size.maxCoeff() * 1e-4, 1e-300});
    columns_ = static_cast<int>(size.x() / step_) + 1;
    rows_ = static_cast<int>(size.y() / step_) + 1;
    begin_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
    for (const OwnedSegment& s : segments) each_bin(s, [&](std::size_t bin) { ++begin_[bin + 1]; });
    for (std::size_t b = 1; b < begin_.size(); ++b) begin_[b] += begin_[b - 1];
    items_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < segments.size(); ++i)
      each_bin(segments[i], [&](std::size_t bin) { items_[next[bin]++] = static_cast<int>(i); });
  }

  /// Segments of lower index in the same cells of the grid; some more than once.
  template <class Visit>
  void visit_lower(int index, Visit&& see) const {
    each_bin(segments_[index], [&](std::size_t bin) {
      for (std::size_t k = begin_[bin]; k < begin_[bin + 1] && items_[k] < index; ++k) see(items_[k]);
    });
  }

 private:
  template <class Visit>
  void each_bin(const OwnedSegment& s, Visit&& see) const {
    const auto place = [&](double d, int count) { return static_cast<int>(std::clamp(d / step_, 0.0, count - 1.0)); };
    const int x0 = place(std::min(s.from.x(), s.to.x()) - lo_.x(), columns_);
    const int x1 = place(std::max(s.from.x(), s.to.x()) - lo_.x(), columns_);
    const int y0 = place(std::min(s.from.y(), s.to.y()) - lo_.y(), rows_);
    const int y1 = place(std::max(s.from.y(), s.to.y()) - lo_.y(), rows_);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) see(static_cast<std::size_t>(y) * columns_ + x);
  }

  const std::vector<OwnedSegment>& segments_;
  Vec2 lo_;
  double step_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::size_t> begin_;
  std::vector<int> items_;
};

}  // namespace

Grid::Grid(const Box& box, double spacing, std::size_t items) : box_(box) {
  // No finer than a few cells for each item: a grid must not outgrow what it holds.
  const double least = std::sqrt(box.area() / static_cast<double>(4 * items + 4));
  const Vec2 size = box.size();
  step_ = std::max({spacing, least, size.maxCoeff() * 1e-4, 1e-300});
  columns_ = static_cast<int>(size.x() / step_) + 1;
  rows_ = static_cast<int>(size.y() / step_) + 1;
  cells_.resize(static_cast<std::size_t>(columns_) * rows_);
}

void Grid::range(const Vec2& lo, const Vec2& hi, int& x0, int& y0, int& x1, int& y1) const {
  const auto place = [](double d, int count) { return static_cast<int>(std::clamp(d, 0.0, count - 1.0)); };
  x0 = place((lo.x() - box_.lo.x()) / step_, columns_);
  y0 = place((lo.y() - box_.lo.y()) / step_, rows_);
  x1 = place((hi.x() - box_.lo.x()) / step_, columns_);
  y1 = place((hi.y() - box_.lo.y()) / step_, rows_);
}

void Grid::add(int item, const Vec2& lo, const Vec2& hi) {
  int x0, y0, x1, y1;
  range(lo, hi, x0, y0, x1, y1);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) cells_[static_cast<std::size_t>(y) * columns_ + x].push_back(item);
}

std::vector<Crossing> find_crossings(const std::vector<OwnedSegment>& segments, std::size_t most) {
  constexpr std::size_t kPiece = 1 << 14;
  if (segments.empty()) return {};
  const Bins bins(segments);
  std::vector<std::vector<Crossing>> pieces((segments.size() + kPiece - 1) / kPiece);
  for_pieces(segments.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    std::vector<Crossing>& found = pieces[begin / kPiece];
    for (std::size_t i = begin; i < end && found.size() < most; ++i) {
      const OwnedSegment& s = segments[i];
      const auto first = static_cast<std::ptrdiff_t>(found.size());
      bins.visit_lower(static_cast<int>(i), [&](int other) {
        if (other == s.before || other == s.after) return;
        const OwnedSegment& t = segments[other];
        if (boxes_apart(s, t) || !cross_properly(s, t)) return;
        found.push_back({other, static_cast<int>(i)});
      });
      // Bins may have shown one more than once.
      std::sort(found.begin() + first, found.end(),
                [](const Crossing& a, const Crossing& b) { return a.first < b.first; });
      found.erase(std::unique(found.begin() + first, found.end(),
                              [](const Crossing& a, const Crossing& b) { return a.first == b.first; }),
                  found.end());
    }
  });
  std::vector<Crossing> found;
  for (const auto& piece : pieces) found.insert(found.end(), piece.begin(), piece.end());
  if (found.size() > most) found.resize(most);
  return found;
}

}  // namespace lamella
