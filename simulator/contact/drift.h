// How far neighbouring shells have moved against each other since the candidate list was made. Tells a list that is still good from one
// that is not while the whole sample is being pulled: what counts is the relative motion of neighbours, not the way of the grips.
#pragma once
#include <compare>
#include <utility>
#include <vector>

#include "generator/sample/sample.h"
#include "simulator/positions.h"

namespace lamella {

/// Boxes around the nodes of every cell.
std::vector<Box> bounding_boxes(const Sample& sample, const Field& x);

/// Cell a, displaced by the image, is near cell b: a < b, or a cell and its own image ahead.
struct Meeting {
  Index a = 0, b = 0;
  Image image{0, 0};
  auto operator<=>(const Meeting&) const = default;
};

/// Cells, and images of cells, whose boxes, grown by `grow` on all sides, meet. Each once, in order. `period`: lengths of the sample's
/// box [m]. Throws SolverError where cells of a periodic sample have moved apart by more boxes than an image can count.
std::vector<Meeting> meeting_boxes(const Sample& sample, const Vec2& period, const std::vector<Box>& boxes,
                                   double grow);

class Drift {
 public:
  Drift() = default;
  /// `reach` is the distance up to which the list is complete.
  Drift(const Sample& sample, const Field& x, double reach);

  /// No node has moved by more against a node that it may touch than this [m]; infinite where that cannot be told.
  double relative(const Sample& sample, const Field& x) const;
  /// The same of a motion from anywhere on, as long as neighbours are the same [m].
  double relative_motion(const Sample& sample, const Field& moved) const;
  const Field& start() const { return start_; }
  /// Steps of the farthest image that a cell may meet, where the box moves.
  double farthest_image() const;
  std::size_t bytes() const { return 2 * sizeof(double) * start_.size() + sizeof(neighbours_[0]) * neighbours_.size(); }

 private:
  void list_images(const Sample& sample, const std::vector<Box>& boxes, const Vec2& period, double grow);
  double motion_of_images(const std::vector<Box>& boxes, const Vec2& growth) const;

  Field start_;
  double range_ = 0;  // cells further apart than this (and the reach) are not neighbours [m]
  std::vector<std::pair<Index, Index>> neighbours_;  // through whatever image: it moves as the cell does
  // Where the box moves, an image does not.
  std::vector<Meeting> images_;  // in place of neighbours_
  std::vector<Vec2> home_;       // per cell: by how many lengths of the box it is displaced at home
  double reaching_ = 0;          // cells at home may meet through that many steps
};

}  // namespace lamella
