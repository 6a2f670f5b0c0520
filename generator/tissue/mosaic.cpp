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
  Image step;       // the image in which `high` lies, seen from `low`
  Index cell, edge;
  bool rising;  // runs from low to high
  Image at;     // of `low`, as the cell has it
  auto wall() const { return std::tie(low, high, step); }
};

Image image_of(const MosaicCell& cell, std::size_t corner) {
  return cell.image.empty() ? Image{0, 0} : cell.image[corner % cell.image.size()];
}

DirectedEdge directed_edge(const MosaicCell& cell, std::size_t c, std::size_t k) {
  const Index from = cell.vertex[k], to = cell.vertex[(k + 1) % cell.vertex.size()];
  const Image at = image_of(cell, k), step = image_of(cell, k + 1) - at;
  // An edge that ends in an image of the vertex where it starts rises where the image is displaced forwards.
  const bool rising = from != to ? from < to : step > Image{0, 0};
  const auto own = static_cast<Index>(c), edge = static_cast<Index>(k);
  if (rising) return {from, to, step, own, edge, true, at};
  return {to, from, opposite(step), own, edge, false, at + step};
}

}  // namespace

std::vector<std::vector<EdgePlace>> opposite_edges(const Mosaic& mosaic) {
  std::vector<DirectedEdge> all;
  std::vector<std::vector<EdgePlace>> opposite(mosaic.cells.size());
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c) {
    const MosaicCell& cell = mosaic.cells[c];
    opposite[c].resize(cell.vertex.size());
    for (std::size_t k = 0; k < cell.vertex.size(); ++k) all.push_back(directed_edge(cell, c, k));
  }
  std::sort(all.begin(), all.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
    return std::tie(a.low, a.high, a.step, a.cell, a.edge) < std::tie(b.low, b.high, b.step, b.cell, b.edge);
  });
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i + 1;
    while (end < all.size() && all[end].wall() == all[i].wall()) ++end;
    const DirectedEdge& a = all[i];
    if (end - i == 2 && a.rising != all[i + 1].rising) {
      const DirectedEdge& b = all[i + 1];
      opposite[a.cell][a.edge] = {b.cell, b.edge, a.at - b.at};
      opposite[b.cell][b.edge] = {a.cell, a.edge, b.at - a.at};
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
  for (std::size_t k = 0; k < cell.vertex.size(); ++k) points.push_back(corner_of(mosaic, cell, k));
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
    area += polygon_area(points);
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
    area += polygon_area(points);
  }
  const double diameter = 2 * std::sqrt(area / (std::numbers::pi * static_cast<double>(mosaic.cells.size())));
  const double reach = 0.6 * diameter;
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c) {
    auto& cell = mosaic.cells[c];
    for (std::size_t k = 0; k < cell.vertex.size(); ++k) {
      if (opposite[c][k].cell >= 0) continue;
      const Vec2 from = corner_of(mosaic, cell, k);
      const Vec2 to = corner_of(mosaic, cell, (k + 1) % cell.vertex.size());
      const Vec2 middle = (from + to) / 2;
      const Vec2 outward = right_of(to - from).normalized();
      const double facing = 0.5 - 1e-9;  // up to 60 degrees off, so that both slanted walls of a hexagon count
      const auto looks_at = [&](double towards, double distance) { return towards > facing && distance < reach; };
      if (!mosaic.periodic[0]) {
        if (looks_at(-outward.x(), middle.x() - mosaic.box.lo.x())) cell.side[k] |= kLeft;
        if (looks_at(outward.x(), mosaic.box.hi.x() - middle.x())) cell.side[k] |= kRight;
      }
      if (!mosaic.periodic[1]) {
        if (looks_at(-outward.y(), middle.y() - mosaic.box.lo.y())) cell.side[k] |= kBottom;
        if (looks_at(outward.y(), mosaic.box.hi.y() - middle.y())) cell.side[k] |= kTop;
      }
    }
  }
}

std::vector<Vec2> ways_home(const Vec2& point, const Box& box, const Periodic& periodic) {
  const Vec2 period = box.size();
  Vec2 home(0, 0);
  for (int axis = 0; axis < 2; ++axis)
    if (periodic[axis]) home[axis] = -std::floor((point[axis] - box.lo[axis]) / period[axis]);
  std::vector<Vec2> ways;
  for (int j = periodic[1] ? -1 : 0; j <= (periodic[1] ? 1 : 0); ++j)
    for (int i = periodic[0] ? -1 : 0; i <= (periodic[0] ? 1 : 0); ++i)
      ways.emplace_back((home + Vec2(i, j)).cwiseProduct(period));
  return ways;
}

Index remove_cells_inside(Mosaic& mosaic, const std::vector<Vec2>& polygon) {
  const auto removed = std::erase_if(mosaic.cells, [&](const MosaicCell& cell) {
    const Vec2 centre = polygon_centre(polygon_of(mosaic, cell));
    const auto ways = ways_home(centre, mosaic.box, mosaic.periodic);
    return std::any_of(ways.begin(), ways.end(), [&](const Vec2& way) { return is_inside(polygon, centre + way); });
  });
  return static_cast<Index>(removed);
}

}  // namespace lamella
