#include "generator/tissue/mosaic.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

struct DirectedEdge {
  Index low, high;  // vertices
  Index cell, edge;
  bool rising;  // runs from low to high
};

}  // namespace

std::vector<std::vector<EdgePlace>> opposite_edges(const Mosaic& mosaic) {
  std::vector<DirectedEdge> all;
  std::vector<std::vector<EdgePlace>> opposite(mosaic.cells.size());
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c) {
    const auto& vertex = mosaic.cells[c].vertex;
    opposite[c].resize(vertex.size());
    for (std::size_t k = 0; k < vertex.size(); ++k) {
      const Index from = vertex[k];
      const Index to = vertex[(k + 1) % vertex.size()];
      all.push_back({std::min(from, to), std::max(from, to), static_cast<Index>(c), static_cast<Index>(k), from < to});
    }
  }
  std::sort(all.begin(), all.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
    return std::tie(a.low, a.high, a.cell, a.edge) < std::tie(b.low, b.high, b.cell, b.edge);
  });
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i + 1;
    while (end < all.size() && all[end].low == all[i].low && all[end].high == all[i].high) ++end;
    const DirectedEdge& a = all[i];
    if (end - i == 2 && a.rising != all[i + 1].rising) {
      const DirectedEdge& b = all[i + 1];
      opposite[a.cell][a.edge] = {b.cell, b.edge};
      opposite[b.cell][b.edge] = {a.cell, a.edge};
    } else if (end - i >= 2) {
      faults.push_back(mosaic.cells[a.cell].name + " and " + mosaic.cells[all[i + 1].cell].name +
                       " lie on the same side of a shared wall: they overlap; a wall has one cell on each side");
    }
    i = end;
  }
  if (!faults.empty()) throw SceneError(faults);
  return opposite;
}

std::vector<Vec2> polygon_of(const Mosaic& mosaic, const MosaicCell& cell) {
  std::vector<Vec2> points;
  points.reserve(cell.vertex.size());
  for (const Index v : cell.vertex) points.push_back(mosaic.vertices[v]);
  return points;
}

Vec2 polygon_centre(const std::vector<Vec2>& points) {
  Vec2 moment = Vec2::Zero();
  double twice = 0;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const Vec2 p = points[k] - points[0];
    const Vec2 q = points[k + 1] - points[0];
    moment += cross(p, q) * (p + q) / 3;
    twice += cross(p, q);
  }
  return points[0] + moment / twice;
}

void order_by_rows(Mosaic& mosaic) {
  struct Place {
    double row, x;
    std::size_t cell;
  };
  double area = 0;
  for (const auto& cell : mosaic.cells) {
    const auto points = polygon_of(mosaic, cell);
    area += polygon_area(points.data(), static_cast<Index>(points.size()));
  }
  const double row_height = std::sqrt(area / static_cast<double>(std::max<std::size_t>(1, mosaic.cells.size())));
  std::vector<Place> places;
  places.reserve(mosaic.cells.size());
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c) {
    const Vec2 centre = polygon_centre(polygon_of(mosaic, mosaic.cells[c]));
    places.push_back({std::floor((centre.y() - mosaic.box.lo.y()) / row_height), centre.x(), c});
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return std::tie(a.row, a.x, a.cell) < std::tie(b.row, b.x, b.cell); });
  std::vector<MosaicCell> ordered;
  ordered.reserve(places.size());
  for (const Place& place : places) ordered.push_back(std::move(mosaic.cells[place.cell]));
  mosaic.cells = std::move(ordered);
}

void mark_rough_sides(Mosaic& mosaic) {
  const auto opposite = opposite_edges(mosaic);
  double area = 0;
  for (const auto& cell : mosaic.cells) {
    const auto points = polygon_of(mosaic, cell);
    area += polygon_area(points.data(), static_cast<Index>(points.size()));
  }
  const double diameter = 2 * std::sqrt(area / (std::numbers::pi * static_cast<double>(mosaic.cells.size())));
  const double reach = 0.6 * diameter;
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c) {
    auto& cell = mosaic.cells[c];
    for (std::size_t k = 0; k < cell.vertex.size(); ++k) {
      if (opposite[c][k].cell >= 0) continue;
      const Vec2& from = mosaic.vertices[cell.vertex[k]];
      const Vec2& to = mosaic.vertices[cell.vertex[(k + 1) % cell.vertex.size()]];
      const Vec2 middle = (from + to) / 2;
      const Vec2 outward = right_of(to - from).normalized();
      const double facing = 0.5 - 1e-9;  // up to 60 degrees off, so that both slanted walls of a hexagon count
      if (-outward.x() > facing && middle.x() - mosaic.box.lo.x() < reach) cell.side[k] |= kLeft;
      if (outward.x() > facing && mosaic.box.hi.x() - middle.x() < reach) cell.side[k] |= kRight;
      if (-outward.y() > facing && middle.y() - mosaic.box.lo.y() < reach) cell.side[k] |= kBottom;
      if (outward.y() > facing && mosaic.box.hi.y() - middle.y() < reach) cell.side[k] |= kTop;
    }
  }
}

bool is_inside(const std::vector<Vec2>& polygon, const Vec2& point) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[j];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (point.y() - a.y()) * (b.x() - a.x()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

Index remove_cells_inside(Mosaic& mosaic, const std::vector<Vec2>& polygon) {
  const auto removed = std::erase_if(mosaic.cells, [&](const MosaicCell& cell) {
    return is_inside(polygon, polygon_centre(polygon_of(mosaic, cell)));
  });
  return static_cast<Index>(removed);
}

}  // namespace lamella
