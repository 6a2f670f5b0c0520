#include "generator/statistics/cell_measures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lamella {
namespace {

/// Area, centre and central second moments [m4] of a polygon, about its first corner so that small cells keep digits.
struct Moments2 {
  double area = 0;
  Vec2 centre = Vec2::Zero();
  double xx = 0, xy = 0, yy = 0;
};

Moments2 moments_of(const std::vector<Vec2>& points) {
  Moments2 m;
  Vec2 first = Vec2::Zero();
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    // The triangle (0, p, q): area w / 2, centre (p + q) / 3, moments w / 24 (pp + qq + (p + q)(p + q)).
    const Vec2 p = points[k] - points[0], q = points[k + 1] - points[0], s = p + q;
    const double w = cross(p, q);
    m.area += w / 2;
    first += w * s / 6;
    m.xx += w / 24 * (p.x() * p.x() + q.x() * q.x() + s.x() * s.x());
    m.xy += w / 24 * (p.x() * p.y() + q.x() * q.y() + s.x() * s.y());
    m.yy += w / 24 * (p.y() * p.y() + q.y() * q.y() + s.y() * s.y());
  }
  const Vec2 c = first / m.area;
  m.xx -= m.area * c.x() * c.x();
  m.xy -= m.area * c.x() * c.y();
  m.yy -= m.area * c.y() * c.y();
  m.centre = points[0] + c;
  return m;
}

CellMeasures shape_of(const std::vector<Vec2>& points) {
  CellMeasures cell;
  const Moments2 m = moments_of(points);
  cell.area = m.area;
  cell.centre = m.centre;
  for (std::size_t k = 0; k < points.size(); ++k)
    cell.perimeter += (points[(k + 1) % points.size()] - points[k]).norm();
  cell.circularity = 4 * std::numbers::pi * cell.area / (cell.perimeter * cell.perimeter);
  const double mean = (m.xx + m.yy) / 2, split = std::hypot((m.xx - m.yy) / 2, m.xy);
  if (mean > split) cell.elongation = std::sqrt((mean + split) / (mean - split));
  // Round to rounding: no direction.
  if (split > 1e-9 * mean) cell.direction = std::atan2(m.xy, (m.xx - m.yy) / 2) / 2;
  return cell;
}

double edge_length(const std::vector<Vec2>& points, std::size_t k) {
  return (points[(k + 1) % points.size()] - points[k]).norm();
}

/// Walks around a cell, from where the neighbour changes, and collects its walls.
void add_walls(Index cell, const std::vector<EdgePlace>& across, const std::vector<Vec2>& points, MosaicMeasures& all) {
  const std::size_t count = across.size();
  // Of a narrow torus a cell may meet one neighbour through several images, and itself: each image is a neighbour.
  const auto same = [](const EdgePlace& a, const EdgePlace& b) { return a.cell == b.cell && a.image == b.image; };
  std::size_t start = 0;
  while (start < count && same(across[start], across[(start + count - 1) % count])) ++start;
  EdgePlace before;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = (start + i) % count;
    const EdgePlace& there = across[k];
    if (there.cell < 0) {
      all.cells[cell].layer = 0;
    } else {
      const bool first = i == 0 || !same(there, before);
      if (first) all.neighbours[cell].push_back(there.cell);
      if (comes_first(cell, there)) {
        if (first) all.walls.push_back({cell, there.cell, 0});
        all.walls.back().length += edge_length(points, k);
      }
    }
    before = there;
  }
  all.cells[cell].neighbours = static_cast<Index>(all.neighbours[cell].size());
}

/// Steps to the nearest cell with a free edge, breadth first.
void count_layers(MosaicMeasures& all) {
  std::vector<Index> front;
  for (Index c = 0; c < static_cast<Index>(all.cells.size()); ++c)
    if (all.cells[c].layer == 0) front.push_back(c);
  for (Index layer = 1; !front.empty(); ++layer) {
    std::vector<Index> next;
    for (const Index c : front)
      for (const Index other : all.neighbours[c])
        if (all.cells[other].layer < 0) {
          all.cells[other].layer = layer;
          next.push_back(other);
        }
    front = std::move(next);
  }
}

}  // namespace

MosaicMeasures measure(const Mosaic& mosaic) {
  const auto across = opposite_edges(mosaic);
  MosaicMeasures all;
  all.neighbours.resize(mosaic.cells.size());
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c) {
    const auto points = polygon_of(mosaic, mosaic.cells[c]);
    all.cells.push_back(shape_of(points));
    all.cells.back().layer = -1;
    add_walls(static_cast<Index>(c), across[c], points, all);
  }
  count_layers(all);
  return all;
}

}  // namespace lamella
