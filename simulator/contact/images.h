// Where the cells of a periodic sample are seen from each other. Positions are never wrapped: a cell that has wandered through a side of the
// box goes on beyond it. To find neighbours, cells are brought home for a moment, each as a whole.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "generator/sample/sample.h"
#include "simulator/positions.h"

namespace lamella {

/// Whole numbers of boxes along x and y.
using Steps = std::array<std::int64_t, 2>;

/// By how many boxes a is displaced as seen from b, when both are displaced by these. Throws SolverError beyond what an image counts.
Image image_between(const Steps& of_a, const Steps& of_b);

class Homes {
 public:
  /// `around`: the rectangles around the cells; `period`: lengths of the box [m]. Throws SolverError where one reaches over more boxes than
  /// can be searched.
  Homes(const Sample& sample, const Vec2& period, const std::vector<Box>& around);

  /// The steps that bring the middle of a cell into the box.
  const Steps& home(Index cell) const { return home_[cell]; }
  Vec2 displacement(const Steps& steps) const {
    return {static_cast<double>(steps[0]) * period_.x(), static_cast<double>(steps[1]) * period_.y()};
  }
  /// The steps, home among them, that bring a rectangle (or a point) of this cell to less than `grow` from what all cells cover at home.
  template <class Visit>
  void for_each_copy(const Box& of, Index cell, double grow, Visit visit) const {
    Steps from = home_[cell], to = from;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (!periodic_[axis]) continue;
      from[axis] = std::min(from[axis], steps(all_.lo[axis] - grow - of.hi[axis], axis, true));
      to[axis] = std::max(to[axis], steps(all_.hi[axis] + grow - of.lo[axis], axis, false));
    }
    for (Steps at = from; at[1] <= to[1]; ++at[1])
      for (at[0] = from[0]; at[0] <= to[0]; ++at[0]) visit(at);
  }

 private:
  std::int64_t steps(double distance, std::size_t axis, bool up) const;

  Periodic periodic_;
  Vec2 period_;
  std::vector<Steps> home_;  // per cell
  Box all_;                  // around all cells at home
};

/// Every cell at home.
Field brought_home(const Sample& sample, const Homes& homes, const Field& x);

}  // namespace lamella
