#include "generator/sample/sample.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace lamella {
namespace {

Index group_index(Sample& sample, const std::string& group) {
  const auto found = std::find(sample.group_names.begin(), sample.group_names.end(), group);
  if (found != sample.group_names.end()) return static_cast<Index>(found - sample.group_names.begin());
  sample.group_names.push_back(group);
  return static_cast<Index>(sample.group_names.size()) - 1;
}

}  // namespace

double turning_angle(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 in = b - a;
  const Vec2 out = c - b;
  return std::atan2(cross(in, out), in.dot(out));
}

double polygon_area(const Vec2* points, Index count) {
  // About the first point, so that a small cell far from the origin keeps its digits.
  double twice = 0;
  for (Index k = 1; k + 1 < count; ++k) twice += cross(points[k] - points[0], points[k + 1] - points[0]);
  return twice / 2;
}

Index add_cell(Sample& sample, const std::vector<Vec2>& points, bool closed, double radius, const std::string& group) {
  assert(points.size() >= (closed ? 3u : 2u));
  if (sample.cell_begin.empty()) sample.cell_begin.push_back(0);
  const Index c = sample.cells();
  const Index begin = sample.cell_begin.back();
  const auto count = static_cast<Index>(points.size());

  sample.x.insert(sample.x.end(), points.begin(), points.end());
  if (closed && polygon_area(points.data(), count) < 0) std::reverse(sample.x.begin() + begin, sample.x.end());
  sample.cell_begin.push_back(begin + count);
  sample.closed.push_back(closed ? 1 : 0);
  sample.group.push_back(group_index(sample, group));
  sample.radius.push_back(radius);
  const double area = closed ? polygon_area(sample.x.data() + begin, count) : 0;
  sample.rest_area.push_back(area);
  sample.tile_area.push_back(area);

  const std::size_t nodes = sample.x.size();
  sample.side.resize(nodes, 0);
  sample.rest_length.resize(nodes, 0);
  sample.rest_angle.resize(nodes, 0);
  sample.hinge_length.resize(nodes, 0);
  for (Index k = begin; k < begin + count; ++k)
    if (sample.starts_segment(c, k)) sample.rest_length[k] = (sample.x[sample.next(c, k)] - sample.x[k]).norm();
  for (Index k = begin; k < begin + count; ++k) {
    if (!closed && (k == begin || k + 1 == begin + count)) continue;
    const Index before = sample.prev(c, k);
    sample.rest_angle[k] = turning_angle(sample.x[before], sample.x[k], sample.x[sample.next(c, k)]);
    sample.hinge_length[k] = (sample.rest_length[before] + sample.rest_length[k]) / 2;
  }
  return c;
}

std::vector<Index> cell_of_node(const Sample& sample) {
  std::vector<Index> cell(sample.x.size());
  for (Index c = 0; c < sample.cells(); ++c)
    std::fill(cell.begin() + sample.cell_begin[c], cell.begin() + sample.cell_begin[c + 1], c);
  return cell;
}

}  // namespace lamella
