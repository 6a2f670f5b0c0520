// Measures and checks of a tessellation, however it was made.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "generator/packing/laguerre.h"

namespace lamella {
namespace {

bool on_side(const Box& box, const Vec2& p, Index side) {
  switch (side) {
    case kLeftSide:
      return p.x() == box.lo.x();
    case kRightSide:
      return p.x() == box.hi.x();
    case kBottomSide:
      return p.y() == box.lo.y();
    default:
      return p.y() == box.hi.y();
  }
}

}  // namespace

Vec2 corner(const Tessellation& tessellation, const Tile& tile, std::size_t k) {
  const Vec2& x = tessellation.vertices[tile.vertex[k]];
  return tile.image.empty() ? x : x + displacement(tile.image[k], tessellation.box);
}

double tile_area(const Tessellation& tessellation, const Tile& tile) {
  const Vec2 origin = corner(tessellation, tile, 0);
  double twice = 0;
  for (std::size_t k = 1; k + 1 < tile.vertex.size(); ++k)
    twice += cross(corner(tessellation, tile, k) - origin, corner(tessellation, tile, k + 1) - origin);
  return twice / 2;
}

Vec2 tile_centroid(const Tessellation& tessellation, const Tile& tile) {
  const Vec2 origin = corner(tessellation, tile, 0);
  double twice = 0;
  Vec2 moment = Vec2::Zero();
  for (std::size_t k = 1; k + 1 < tile.vertex.size(); ++k) {
    const Vec2 a = corner(tessellation, tile, k) - origin, b = corner(tessellation, tile, k + 1) - origin;
    twice += cross(a, b);
    moment += cross(a, b) * (a + b) / 3;
  }
  return origin + moment / twice;
}

double edge_length(const Tessellation& tessellation, const Tile& tile, std::size_t k) {
  return (corner(tessellation, tile, (k + 1) % tile.vertex.size()) - corner(tessellation, tile, k)).norm();
}

double mean_edge_length(const Tessellation& tessellation) {
  double sum = 0, sides = 0;
  for (const Tile& tile : tessellation.tiles)
    for (std::size_t k = 0; k < tile.vertex.size(); ++k)
      if (tile.neighbour[k] >= 0) sum += edge_length(tessellation, tile, k), ++sides;
  return sides > 0 ? sum / sides : 0;
}

std::vector<std::string> check_tessellation(const Tessellation& tessellation) {
  std::vector<std::string> faults;
  const Index vertices = static_cast<Index>(tessellation.vertices.size());
  for (const Tile& tile : tessellation.tiles) {
    if (tile.vertex.size() < 3 || tile.vertex.size() != tile.neighbour.size())
      faults.push_back(
          fmt::format("tile {}: {} vertices and {} neighbours", tile.site, tile.vertex.size(), tile.neighbour.size()));
    for (const Index v : tile.vertex)
      if (v < 0 || v >= vertices) faults.push_back(fmt::format("tile {}: no vertex {}", tile.site, v));
  }
  if (!faults.empty()) return faults;

  // Edges as (from, to): the tile on their left and what lies on their right.
  std::map<std::pair<Index, Index>, std::pair<Index, Index>> edges;
  std::set<Index> used;
  double sum = 0;
  // Shorter than this, directions are rounding.
  const double scale = std::sqrt(tessellation.box.area() / static_cast<double>(tessellation.tiles.size()));
  for (const Tile& tile : tessellation.tiles) {
    const double area = tile_area(tessellation, tile);
    sum += area;
    if (!(area > 0)) faults.push_back(fmt::format("tile {}: area {}", tile.site, area));
    const std::size_t n = tile.vertex.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Index u = tile.vertex[k], v = tile.vertex[(k + 1) % n], w = tile.vertex[(k + 2) % n];
      used.insert(u);
      if (!edges.insert({{u, v}, {tile.site, tile.neighbour[k]}}).second)
        faults.push_back(fmt::format("edge {} {} has two tiles on its left", u, v));
      const auto& x = tessellation.vertices;
      if (cross(x[v] - x[u], x[w] - x[v]) < -1e-12 * scale * scale)
        faults.push_back(fmt::format("tile {} is not convex at vertex {}", tile.site, v));
      if (tile.neighbour[k] < 0 &&
          !(on_side(tessellation.box, x[u], tile.neighbour[k]) && on_side(tessellation.box, x[v], tile.neighbour[k])))
        faults.push_back(fmt::format("tile {}: edge {} {} does not lie on its side of the box", tile.site, u, v));
    }
  }
  Index walls = 0, boundary = 0;
  for (const auto& [ends, tiles] : edges) {
    if (tiles.second < 0) {
      ++boundary;
      continue;
    }
    const auto twin = edges.find({ends.second, ends.first});
    if (twin == edges.end() || twin->second != std::pair{tiles.second, tiles.first})
      faults.push_back(fmt::format("the wall of tiles {} and {} has one side only", tiles.first, tiles.second));
    ++walls;
  }
  const Index euler =
      static_cast<Index>(used.size()) - (walls / 2 + boundary) + static_cast<Index>(tessellation.tiles.size());
  if (euler != 1) faults.push_back(fmt::format("V - E + F = {} instead of 1", euler));
  const double area = tessellation.box.area();
  if (!(std::abs(sum - area) <= 1e-12 * area))
    faults.push_back(fmt::format("the areas sum to {:.17g} instead of {:.17g}", sum, area));
  return faults;
}

}  // namespace lamella
