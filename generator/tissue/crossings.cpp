#include "generator/tissue/crossings.h"

#include <algorithm>
#include <cmath>

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
  std::vector<Crossing> found;
  if (segments.empty()) return found;
  Box box{segments[0].from, segments[0].from};
  double length = 0;
  for (const OwnedSegment& s : segments) {
    box.lo = box.lo.cwiseMin(s.from.cwiseMin(s.to));
    box.hi = box.hi.cwiseMax(s.from.cwiseMax(s.to));
    length += (s.to - s.from).norm();
  }
  Grid grid(box, length / static_cast<double>(segments.size()), segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const OwnedSegment& s = segments[i];
    const Vec2 lo = s.from.cwiseMin(s.to);
    const Vec2 hi = s.from.cwiseMax(s.to);
    const auto index = static_cast<int>(i);
    std::vector<int> crossed;
    grid.visit(lo, hi, [&](int other) {
      if (other == s.before || other == s.after) return;
      if (cross_properly(s, segments[other])) crossed.push_back(other);
    });
    std::sort(crossed.begin(), crossed.end());
    crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());
    for (const int other : crossed) {
      found.push_back({other, index});
      if (found.size() >= most) return found;
    }
    grid.add(index, lo, hi);
  }
  return found;
}

}  // namespace lamella
