#include "simulator/contact/drift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "simulator/contact/images.h"
#include "simulator/moving_box.h"

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

namespace {

/// Pairs of boxes that meet when grown, the lower first, in no order.
template <class Visit>
void for_each_meeting_pair(const std::vector<Box>& boxes, double grow, Visit visit) {
  std::vector<Index> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return boxes[a].lo.x() < boxes[b].lo.x(); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Box& a = boxes[order[k]];
    for (std::size_t m = k + 1; m < order.size() && boxes[order[m]].lo.x() <= a.hi.x() + 2 * grow; ++m) {
      const Box& b = boxes[order[m]];
      if (b.lo.y() <= a.hi.y() + 2 * grow && a.lo.y() <= b.hi.y() + 2 * grow)
        visit(std::min(order[k], order[m]), std::max(order[k], order[m]));
    }
  }
}

/// The same of a periodic sample: cells are brought home, and those near its sides have copies beyond them.
std::vector<Meeting> meeting_images(const Sample& sample, const Vec2& period, const std::vector<Box>& boxes,
                                    double grow) {
  const Homes homes(sample, period, boxes);
  std::vector<Box> copies;
  std::vector<std::pair<Index, Steps>> of_copy;  // its cell, and by how many boxes that is displaced
  for (Index c = 0; c < static_cast<Index>(boxes.size()); ++c)
    homes.for_each_copy(boxes[c], c, 2 * grow, [&](const Steps& steps) {
      const Vec2 off = homes.displacement(steps);
      copies.push_back({boxes[c].lo + off, boxes[c].hi + off});
      of_copy.emplace_back(c, steps);
    });
  std::vector<Meeting> found;
  for_each_meeting_pair(copies, grow, [&](Index p, Index q) {
    const auto& [a, of_a] = of_copy[p];
    const auto& [b, of_b] = of_copy[q];
    if (of_a != homes.home(a) && of_b != homes.home(b)) return;  // seen from one of the two at home as well
    Meeting meeting{a, b, image_between(of_a, of_b)};
    if (a > b || (a == b && meeting.image < Image{0, 0})) meeting = {b, a, opposite(meeting.image)};
    found.push_back(meeting);
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace

std::vector<Meeting> meeting_boxes(const Sample& sample, const Vec2& period, const std::vector<Box>& boxes,
                                   double grow) {
  if (is_periodic(sample)) return meeting_images(sample, period, boxes, grow);
  std::vector<Meeting> found;
  for_each_meeting_pair(boxes, grow, [&](Index a, Index b) { found.push_back({a, b, {0, 0}}); });
  std::sort(found.begin(), found.end());
  return found;
}

Drift::Drift(const Sample& sample, const Field& x, double reach) : start_(x) {
  const auto boxes = bounding_boxes(sample, x);
  for (const Box& box : boxes) range_ += box.size().mean() / static_cast<double>(boxes.size());
  const Vec2 period = box_size(sample, x);
  if (box_moves(sample, x)) {
    list_images(sample, boxes, period, 0.5 * (reach + range_));
    return;
  }
  for (const Meeting& meeting : meeting_boxes(sample, period, boxes, 0.5 * (reach + range_)))
    if (meeting.a != meeting.b && (neighbours_.empty() || neighbours_.back() != std::pair{meeting.a, meeting.b}))
      neighbours_.emplace_back(meeting.a, meeting.b);
}

double Drift::relative(const Sample& sample, const Field& x) const {
  Field moved(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) moved.x[i] = x.x[i] - start_.x[i], moved.y[i] = x.y[i] - start_.y[i];
  return relative_motion(sample, moved);
}

double Drift::relative_motion(const Sample& sample, const Field& moved) const {
  const auto boxes = bounding_boxes(sample, moved);
  if (box_moves(sample, moved)) return motion_of_images(boxes, box_growth(sample, moved));
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

// Two cells whose middles are in the box are |k| - 1 boxes apart at least through an image of k steps.
void Drift::list_images(const Sample& sample, const std::vector<Box>& boxes, const Vec2& period, double grow) {
  images_ = meeting_boxes(sample, period, boxes, grow);
  const Homes homes(sample, period, boxes);
  for (Index c = 0; c < sample.cells(); ++c) {
    home_.emplace_back(static_cast<double>(homes.home(c)[0]), static_cast<double>(homes.home(c)[1]));
    const double share = (boxes[c].size().array() + 2 * grow).matrix().cwiseQuotient(period).maxCoeff();
    reaching_ = std::max(reaching_, 2 + std::floor(share));
  }
}

double Drift::motion_of_images(const std::vector<Box>& boxes, const Vec2& growth) const {
  double most = 0;
  for (std::size_t c = 0; c < boxes.size(); ++c) {
    // As above, of the cell at home; half of what an image moves beside it counts for either cell.
    const Vec2 with = home_[c].cwiseProduct(growth), lo = boxes[c].lo + with, hi = boxes[c].hi + with;
    if (lo.cwiseAbs().cwiseMax(hi.cwiseAbs()).norm() + 0.5 * reaching_ * growth.norm() > 0.5 * range_)
      return std::numeric_limits<double>::infinity();
    most = std::max(most, boxes[c].size().norm());
  }
  for (const auto& [a, b, image] : images_) {
    const Vec2 with = displacement(image, growth);  // of a
    most = std::max(most, farthest({boxes[a].lo + with, boxes[a].hi + with}, boxes[b]));
  }
  return most;
}

double Drift::farthest_image() const {
  double most = 0;
  for (const Meeting& meeting : images_) most = std::max(most, steps_of(meeting.image).norm());
  return most;
}

}  // namespace lamella
