#include "generator/sample/voids.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lamella {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLinesInRadius = 64;
constexpr double kStraight = 1e-3;  // slope up to which a segment runs along a side of the room

struct Interval {
  double from, to;
};

/// The stretch of the line at height y that lies within `radius` of the segment from p to q. Empty: from > to.
Interval capsule_at(const Vec2& p, const Vec2& q, double radius, double y) {
  Interval out{kInfinity, -kInfinity};
  const auto include = [&](double x) { out.from = std::min(out.from, x), out.to = std::max(out.to, x); };
  for (const Vec2& end : {p, q}) {
    const double off = y - end.y(), half = radius * radius - off * off;
    if (half >= 0) include(end.x() - std::sqrt(half)), include(end.x() + std::sqrt(half));
  }
  const Vec2 d = q - p;
  const double length = d.norm();
  if (!(length > 0) || d.y() == 0) return out;  // along the line: what its ends say is all
  const Vec2 side = radius / length * left_of(d);
  for (const Vec2& from : {Vec2(p + side), Vec2(p - side)}) {
    const double t = (y - from.y()) / d.y();
    if (t >= 0 && t <= 1) include(from.x() + t * d.x());
  }
  return out;
}

/// Lines at equal distances through a room, and what is covered of each.
class Lines {
 public:
  Lines(const Box& room, double distance)
      : room_(room),
        count_(std::max(1, static_cast<int>(std::ceil(room.size().y() / distance)))),
        step_(room.size().y() / count_),
        covered_(static_cast<std::size_t>(count_)),
        crossings_(static_cast<std::size_t>(count_)) {}

  void add_cell(const Vec2* x, Index nodes, double radius) {
    double low = kInfinity, high = -kInfinity;
    for (Index k = 0; k < nodes; ++k) {
      const Vec2 &p = x[k], &q = x[(k + 1) % nodes];
      const double lower = std::min(p.y(), q.y()), upper = std::max(p.y(), q.y());
      low = std::min(low, lower), high = std::max(high, upper);
      for (int i = first(lower - radius); i < end(upper + radius); ++i) {
        const double y = at(i);
        if (const Interval in = capsule_at(p, q, radius, y); in.from < in.to) line(covered_, i).push_back(in);
        if ((p.y() <= y) != (q.y() <= y))
          line(crossings_, i).push_back(p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x()));
      }
    }
    for (int i = first(low); i < end(high); ++i) {
      std::vector<double>& crossed = line(crossings_, i);
      std::sort(crossed.begin(), crossed.end());
      for (std::size_t k = 0; k + 1 < crossed.size(); k += 2) line(covered_, i).push_back({crossed[k], crossed[k + 1]});
      crossed.clear();
    }
  }

  double covered_area() {
    double sum = 0;
    for (std::vector<Interval>& line : covered_) {
      std::sort(line.begin(), line.end(), [](const Interval& a, const Interval& b) { return a.from < b.from; });
      double reached = room_.lo.x();
      for (const Interval& in : line) {
        const double from = std::max(in.from, reached), to = std::min(in.to, room_.hi.x());
        if (to > from) sum += to - from, reached = to;
      }
    }
    return sum * step_;
  }

 private:
  template <class T>
  static std::vector<T>& line(std::vector<std::vector<T>>& of, int i) {
    return of[static_cast<std::size_t>(i)];
  }
  double at(int i) const { return room_.lo.y() + (i + 0.5) * step_; }
  /// Lines from `first(y)` on lie above y, those before `end(y)` below it.
  int first(double y) const {
    return std::clamp(static_cast<int>(std::ceil((y - room_.lo.y()) / step_ - 0.5)), 0, count_);
  }
  int end(double y) const {
    return std::clamp(static_cast<int>(std::floor((y - room_.lo.y()) / step_ - 0.5)) + 1, 0, count_);
  }

  Box room_;
  int count_;
  double step_;
  std::vector<std::vector<Interval>> covered_;
  std::vector<std::vector<double>> crossings_;  // of the cell at hand
};

}  // namespace

std::optional<Box> room_between_walls(const Sample& sample, const std::vector<Vec2>& x) {
  Vec2 centre = Vec2::Zero();
  double nodes = 0;
  for (Index c = 0; c < sample.cells(); ++c)
    for (Index i = sample.cell_begin[c]; sample.closed[c] && i < sample.cell_begin[c + 1]; ++i)
      centre += x[static_cast<std::size_t>(i)], ++nodes;
  if (nodes == 0) return std::nullopt;
  centre /= nodes;
  Box room{Vec2::Constant(-kInfinity), Vec2::Constant(kInfinity)};
  for (Index c = 0; c < sample.cells(); ++c)
    for (Index i = sample.cell_begin[c]; !sample.closed[c] && i + 1 < sample.cell_begin[c + 1]; ++i) {
      const Vec2 &p = x[static_cast<std::size_t>(i)], &q = x[static_cast<std::size_t>(i) + 1];
      for (const int axis : {0, 1}) {  // the wall stands across this axis
        if (std::abs(q[axis] - p[axis]) > kStraight * std::abs(q[1 - axis] - p[1 - axis])) continue;
        const double place = 0.5 * (p[axis] + q[axis]);
        if (place < centre[axis])
          room.lo[axis] = std::max(room.lo[axis], place + sample.radius[c]);
        else
          room.hi[axis] = std::min(room.hi[axis], place - sample.radius[c]);
      }
    }
  if (!room.lo.allFinite() || !room.hi.allFinite() || !(room.size().minCoeff() > 0)) return std::nullopt;
  return room;
}

double covered_area(const Sample& sample, const std::vector<Vec2>& x, const Box& room) {
  double area = 0, cells = 0;
  for (Index c = 0; c < sample.cells(); ++c)
    if (sample.closed[c]) area += sample.rest_area[c], ++cells;
  if (cells == 0) return 0;
  Lines lines(room, std::sqrt(area / cells / std::numbers::pi) / kLinesInRadius);
  for (Index c = 0; c < sample.cells(); ++c)
    if (sample.closed[c]) lines.add_cell(x.data() + sample.cell_begin[c], sample.cell_size(c), sample.radius[c]);
  return lines.covered_area();
}

double void_ratio(const Sample& sample, const std::vector<Vec2>& x, const Box& room) {
  return room.area() / covered_area(sample, x, room) - 1;
}

}  // namespace lamella
