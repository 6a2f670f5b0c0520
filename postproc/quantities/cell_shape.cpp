#include "postproc/quantities/cell_shape.h"

#include <cmath>

namespace lamella {
namespace {

// Second moments of area about the centroid from those of the triangles (centroid, p, q): for a triangle with a corner in
// the origin, int x x^T dA = cross(p, q) / 24 * (p p^T + q q^T + (p + q)(p + q)^T).
void set_moments(CellShape& shape, const std::vector<Vec2>& points) {
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec2 p = points[k] - shape.centroid, q = points[(k + 1) % points.size()] - shape.centroid;
    const Vec2 sum = p + q;
    moments += cross(p, q) / 24 * (p * p.transpose() + q * q.transpose() + sum * sum.transpose());
  }
  const double mean = 0.5 * moments.trace();
  const double deviator = std::hypot(0.5 * (moments(0, 0) - moments(1, 1)), moments(0, 1));
  // A flattened cell keeps a finite aspect, so that files and means stay finite.
  const double smallest = std::max(mean - deviator, 1e-12 * std::abs(mean));
  if (smallest > 0) shape.aspect = std::sqrt((mean + deviator) / smallest);
  shape.orientation = 0.5 * std::atan2(2 * moments(0, 1), moments(0, 0) - moments(1, 1));
}

/// What is left of a shell or chain: strips of wall with round ends.
CellShape opened_shape(const FrameView& view, Index cell) {
  const Sample& sample = view.sample;
  CellShape shape;
  shape.opened = true;
  Vec2 moment = Vec2::Zero();
  const Vec2 origin = view.x[sample.cell_begin[cell]];
  int ends = sample.closed[cell] ? 0 : 1;
  for (Index i = sample.cell_begin[cell]; i < sample.cell_begin[cell + 1]; ++i) {
    if (!sample.starts_segment(cell, i)) continue;
    if (view.gone(i)) {
      ++ends;
      continue;
    }
    const Vec2 p = view.x[i] - origin, q = view.x[sample.next(cell, i)] - origin;
    const double length = (q - p).norm();
    shape.perimeter += length;
    moment += 0.5 * length * (p + q);
  }
  shape.centroid = origin;
  if (shape.perimeter > 0) shape.centroid += moment / shape.perimeter;
  const double r = sample.radius[cell];
  shape.outline_area = 2 * r * shape.perimeter + ends * M_PI * r * r;
  shape.outline_perimeter = 2 * shape.perimeter + ends * 2 * M_PI * r;
  return shape;
}

}  // namespace

double CellShape::circularity() const {
  return outline_perimeter > 0 ? 4 * M_PI * outline_area / (outline_perimeter * outline_perimeter) : 0;
}

CellShape cell_shape(const Sample& sample, const std::vector<Vec2>& x, Index cell) {
  const Index begin = sample.cell_begin[cell], size = sample.cell_size(cell);
  const bool closed = sample.closed[cell];
  const double r = sample.radius[cell];
  const std::vector<Vec2> points(x.begin() + begin, x.begin() + begin + size);
  CellShape shape;
  Vec2 line_moment = Vec2::Zero(), area_moment = Vec2::Zero();
  for (Index k = 0; k < sample.segments(cell); ++k) {
    // relative to the first point, so that nothing cancels far from the origin
    const Vec2 p = points[k] - points[0], q = points[(k + 1) % size] - points[0];
    const double length = (q - p).norm();
    shape.perimeter += length;
    line_moment += 0.5 * length * (p + q);
    if (closed) shape.area += 0.5 * cross(p, q), area_moment += cross(p, q) / 6 * (p + q);
  }
  shape.centroid = points[0];
  if (closed && shape.area != 0) {
    shape.centroid += area_moment / shape.area;
    set_moments(shape, points);
  } else if (shape.perimeter > 0) {
    shape.centroid += line_moment / shape.perimeter;
  }

  if (!closed) {
    shape.outline_area = 2 * r * shape.perimeter + M_PI * r * r;
    shape.outline_perimeter = 2 * shape.perimeter + 2 * M_PI * r;
    return shape;
  }
  // Steiner's formula; a convex corner of turning angle theta adds a sector r^2 theta / 2, at a concave one the two
  // bands overlap in a kite r^2 tan(theta / 2).
  shape.outline_area = shape.area + r * shape.perimeter;
  shape.outline_perimeter = shape.perimeter;
  for (Index k = 0; k < size; ++k) {
    const double theta = turning_angle(points[(k + size - 1) % size], points[k], points[(k + 1) % size]);
    const double kite = theta < 0 ? std::tan(std::max(theta, -0.9 * M_PI) / 2) : 0;
    shape.outline_area += r * r * (theta >= 0 ? 0.5 * theta : kite);
    shape.outline_perimeter += r * (theta >= 0 ? theta : 2 * kite);
  }
  return shape;
}

std::vector<CellShape> cell_shapes(const Sample& sample, const std::vector<Vec2>& x) {
  std::vector<CellShape> shapes;
  shapes.reserve(sample.cells());
  for (Index c = 0; c < sample.cells(); ++c) shapes.push_back(cell_shape(sample, x, c));
  return shapes;
}

std::vector<CellShape> cell_shapes(const FrameView& view) {
  std::vector<CellShape> shapes;
  shapes.reserve(view.sample.cells());
  for (Index c = 0; c < view.sample.cells(); ++c)
    shapes.push_back(view.broken_bars() && view.broken_bars()->opened(c) ? opened_shape(view, c)
                                                                         : cell_shape(view.sample, view.x, c));
  return shapes;
}

double tile_area(const Sample& sample, const CellShape& shape, Index cell) {
  if (sample.tile_area[cell] > 0 && sample.rest_area[cell] > 0)
    return sample.tile_area[cell] * (shape.opened ? 1 : shape.area / sample.rest_area[cell]);
  return shape.outline_area;
}

}  // namespace lamella
