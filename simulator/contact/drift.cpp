#include "simulator/contact/drift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace lamella {
namespace {

/// Longest vector between a point of one box and a point of the other.
double farthest(const Box& a, const Box& b) { return (a.hi - b.lo).cwiseMax(b.hi - a.lo).norm(); }

}  // namespace

std::vector<Box> bounding_boxes(const Sample& sample, const Field& x) {
  std::vector<Box> boxes(sample.cells());
  for (Index c = 0; c < sample.cells(); ++c) {
    const auto ends = [&](const std::vector<double>& v) {
      double lo = v[sample.cell_begin[c]], hi = lo;
      for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i)
        lo = std::min(lo, v[i]), hi = std::max(hi, v[i]);
      return std::pair{lo, hi};
    };
    const auto [x0, x1] = ends(x.x);
    const auto [y0, y1] = ends(x.y);
    boxes[c] = {{x0, y0}, {x1, y1}};
  }
  return boxes;
}

std::vector<std::pair<Index, Index>> meeting_boxes(const std::vector<Box>& boxes, double grow) {
  std::vector<std::pair<Index, Index>> pairs;
  std::vector<Index> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return boxes[a].lo.x() < boxes[b].lo.x(); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Box& a = boxes[order[k]];
    for (std::size_t m = k + 1; m < order.size() && boxes[order[m]].lo.x() <= a.hi.x() + 2 * grow; ++m) {
      const Box& b = boxes[order[m]];
      if (b.lo.y() <= a.hi.y() + 2 * grow && a.lo.y() <= b.hi.y() + 2 * grow)
        pairs.push_back(std::minmax(order[k], order[m]));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Drift::Drift(const Sample& sample, const Field& x, double reach) : start_(x) {
  const auto boxes = bounding_boxes(sample, x);
  for (const Box& box : boxes) range_ += box.size().mean() / static_cast<double>(boxes.size());
  neighbours_ = meeting_boxes(boxes, 0.5 * (reach + range_));
}

double Drift::relative(const Sample& sample, const Field& x) const {
  Field moved(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) moved.x[i] = x.x[i] - start_.x[i], moved.y[i] = x.y[i] - start_.y[i];
  return relative_motion(sample, moved);
}

double Drift::relative_motion(const Sample& sample, const Field& moved) const {
  const auto boxes = bounding_boxes(sample, moved);
  double most = 0;
  for (const Box& box : boxes) {
    // Cells that were no neighbours have not met while each has moved by less than half of what lay between.
    if (box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()).norm() > 0.5 * range_)
      return std::numeric_limits<double>::infinity();
    most = std::max(most, box.size().norm());
  }
  for (const auto& [a, b] : neighbours_) most = std::max(most, farthest(boxes[a], boxes[b]));
  return most;
}

}  // namespace lamella
