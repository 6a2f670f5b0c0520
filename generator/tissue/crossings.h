// Which segments of a set cross: a cell grid, so that a million segments take seconds.
#pragma once
#include <vector>

#include "generator/sample/vec.h"

namespace lamella {

/// A segment that belongs to `owner`, `before` and `after` being its neighbours there (or -1): neighbours share an
/// end and never count as crossing.
struct OwnedSegment {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  int owner = 0;
  int before = -1, after = -1;
};

struct Crossing {
  int first = 0, second = 0;  // first < second
};

/// Pairs of segments with a common point that is no end of either (to rounding), in ascending order; at most `most`.
std::vector<Crossing> find_crossings(const std::vector<OwnedSegment>& segments, std::size_t most = 1000);

/// Cells of a uniform grid over points and boxes; `visit` sees candidates, some more than once.
class Grid {
 public:
  Grid(const Box& box, double spacing, std::size_t items);
  void add(int item, const Vec2& lo, const Vec2& hi);
  template <class Visit>
  void visit(const Vec2& lo, const Vec2& hi, Visit&& see) const {
    int x0, y0, x1, y1;
    range(lo, hi, x0, y0, x1, y1);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        for (const int item : cells_[static_cast<std::size_t>(y) * columns_ + x]) see(item);
  }

 private:
  void range(const Vec2& lo, const Vec2& hi, int& x0, int& y0, int& x1, int& y1) const;

  Box box_;
  double step_;
  int columns_, rows_;
  std::vector<std::vector<int>> cells_;
};

}  // namespace lamella
