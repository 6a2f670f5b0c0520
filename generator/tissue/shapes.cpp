#include "generator/tissue/shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "generator/sample/errors.h"
#include "generator/sample/polygon.h"

namespace lamella {
namespace {

/// Appends the points of (from, to] at `segments` equal distances.
void extend(std::vector<Vec2>& points, const Vec2& to, int segments) {
  const Vec2 from = points.back();
  for (int k = 1; k <= segments; ++k) points.push_back(k == segments ? to : from + (to - from) * k / segments);
}

std::vector<Vec2> ring_points(const Vec2& centre, double radius, int count, double rotation) {
  std::vector<Vec2> points;
  for (int k = 0; k < count; ++k) {
    const double angle = rotation + 2 * std::numbers::pi * k / count;
    points.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

void require(bool holds, const ShapeScene& shape, const std::string& what) {
  if (!holds) throw SceneError(fmt::format("sample.shapes: {} of group {}: {}", shape.kind, shape.group, what));
}

void add_straight(const ShapeScene& shape, double radius, Sample& sample) {
  require(shape.segments >= 1, shape, "segments must be at least 1");
  require((shape.to - shape.from).norm() > 0, shape, "from and to coincide; they must be two points");
  const bool at_start = shape.clamp == "start" || shape.clamp == "both";
  const bool at_end = shape.clamp == "end" || shape.clamp == "both";
  const Vec2 step = (shape.to - shape.from) / shape.segments;
  std::vector<Vec2> points;
  if (at_start) points.push_back(shape.from - step);
  points.push_back(shape.from);
  extend(points, shape.to, shape.segments);
  if (at_end) points.push_back(shape.to + step);
  const Index cell = add_cell(sample, points, false, radius, shape.group);
  // Straight by construction: what rounding made of the angles is no rest angle.
  for (Index k = sample.cell_begin[cell]; k < sample.cell_begin[cell + 1]; ++k) sample.rest_angle[k] = 0;
  if (shape.clamp_hinge == "full") return;
  if (at_start) sample.hinge_length[sample.cell_begin[cell] + 1] /= 2;
  if (at_end) sample.hinge_length[sample.cell_begin[cell + 1] - 2] /= 2;
}

}  // namespace

void add_shape(const ShapeScene& shape, const RadiusOfGroup& radius_of, Sample& sample) {
  const double radius = radius_of(shape.group);
  require(shape.clamp == "none" || shape.kind == "chain" || shape.kind == "plate", shape,
          "only a chain or a plate has an end to clamp");
  if (shape.kind == "chain" || shape.kind == "plate") {
    add_straight(shape, radius, sample);
  } else if (shape.kind == "box") {
    const Vec2 lo = shape.from.cwiseMin(shape.to);
    const Vec2 hi = shape.from.cwiseMax(shape.to);
    require((hi - lo).minCoeff() > 0, shape, "from and to must be opposite corners of a box with an area");
    require(shape.segments >= 1, shape, "segments (on each side) must be at least 1");
    std::vector<Vec2> points{{lo.x(), hi.y()}};
    for (const Vec2& corner : {lo, Vec2(hi.x(), lo.y()), hi}) extend(points, corner, shape.segments);
    add_cell(sample, points, false, radius, shape.group);
  } else if (shape.kind == "ring") {
    require(shape.size > 0, shape, "size (radius of the vertices) must be positive");
    require(shape.segments >= 3, shape, "a ring needs at least 3 segments");
    add_cell(sample, ring_points(shape.centre, shape.size, shape.segments, shape.rotation), true, radius, shape.group);
  } else if (shape.kind == "polygon") {
    const std::size_t least = shape.open ? 2 : 3;
    require(shape.points.size() >= least, shape, fmt::format("needs at least {} points", least));
    const int segments = std::max(1, shape.segments);
    std::vector<Vec2> points{shape.points.front()};
    for (std::size_t k = 1; k < shape.points.size(); ++k) extend(points, shape.points[k], segments);
    if (!shape.open) {
      extend(points, shape.points.front(), segments);
      points.pop_back();
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (shape.open && k + 1 == points.size()) break;
      require((points[(k + 1) % points.size()] - points[k]).norm() > 0, shape,
              "two consecutive points coincide; the closing point is not repeated");
    }
    require(shape.open || std::abs(polygon_area(points)) > 0, shape, "its points enclose no area");
    add_cell(sample, points, !shape.open, radius, shape.group);
  } else {
    require(false, shape, "unknown kind; chain, plate, box, ring or polygon");
  }
}

Sample make_rings(const Packing& packing, int nodes, double radius, const std::string& group,
                  const std::vector<double>& tile_areas) {
  if (nodes < 3) throw SceneError("sample.ring_nodes: a ring needs at least 3 nodes");
  std::vector<std::string> faults;
  Sample sample;
  sample.box = packing.box;
  for (std::size_t i = 0; i < packing.disks.size(); ++i) {
    const Disk& disk = packing.disks[i];
    if (!(disk.radius > radius)) {
      faults.push_back(
          fmt::format("disk {} has radius {:.4g} m, no more than the Minkowski radius {:.4g} m of its wall: "
                      "choose thinner walls or larger disks",
                      i, disk.radius, radius));
      continue;
    }
    const Index cell = add_cell(sample, ring_points(disk.centre, disk.radius - radius, nodes, 0), true, radius, group);
    sample.tile_area[cell] = tile_areas.empty() ? std::numbers::pi * disk.radius * disk.radius : tile_areas[i];
  }
  if (!faults.empty()) throw SceneError(faults);
  return sample;
}

}  // namespace lamella
