#include "generator/tissue/inset_areas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "generator/sample/errors.h"
#include "generator/sample/polygon.h"

namespace lamella {
namespace {

/// Corners of the inset, one for each edge that is left, about the first corner of the polygon.
std::vector<Vec2> inset_corners(const std::vector<Vec2>& polygon, const Inset& inset, double distance) {
  std::vector<Vec2> corners;
  for (const InsetEdge& edge : inset.edges) {
    const Vec2 start = polygon[edge.edge] - polygon[0];
    const Vec2 along = (polygon[(edge.edge + 1) % polygon.size()] - polygon[edge.edge]).normalized();
    corners.push_back(start + edge.from * along + distance * left_of(along));
  }
  return corners;
}

/// Edges of a tile that have a direction. Cocircular sites leave edges without length.
std::vector<std::size_t> proper_edges(const Tessellation& tessellation, const Tile& tile) {
  const double least = 1e-14 * tessellation.box.size().norm();
  std::vector<std::size_t> proper;
  for (std::size_t k = 0; k < tile.vertex.size(); ++k)
    if (edge_length(tessellation, tile, k) > least) proper.push_back(k);
  return proper;
}

}  // namespace

double inset_area(const std::vector<Vec2>& polygon, double distance) {
  const Inset inset = inset_polygon(polygon, distance);
  if (inset.outcome != Inset::Outcome::whole) return 0;
  return std::max(0.0, polygon_area(inset_corners(polygon, inset, distance)));
}

TileMeasures measure_insets(const Tessellation& tessellation, const std::vector<Vec2>& centres,
                            const std::vector<double>& distance) {
  TileMeasures measures{std::vector<double>(centres.size(), 0), centres, {}};
  for (const Tile& tile : tessellation.tiles) {
    const std::vector<std::size_t> proper = proper_edges(tessellation, tile);
    if (proper.size() < 3) continue;
    std::vector<Vec2> polygon;
    for (const std::size_t k : proper) polygon.push_back(corner(tessellation, tile, k));
    const double s = distance[tile.site];
    const Inset inset = inset_polygon(polygon, s);
    if (inset.outcome != Inset::Outcome::whole) continue;
    measures.area[tile.site] = std::max(0.0, polygon_area(inset_corners(polygon, inset, s)));
    measures.centroid[tile.site] = tile_centroid(tessellation, tile);
    for (const InsetEdge& edge : inset.edges) {
      const Index other = tile.neighbour[proper[edge.edge]];
      // A wall that moves by u changes the inset by u times what the inset leaves of it. The two sides of a wall differ in
      // that; their mean, half from each tile, keeps the derivative symmetric, and the iteration still converges.
      if (other < 0) continue;
      const Image image = tile.across.empty() ? Image{0, 0} : tile.across[proper[edge.edge]];
      measures.walls.push_back({tile.site, other, image, (edge.to - edge.from) / 2});
    }
  }
  return measures;
}

AreaProblem inset_problem(const AreaProblem& tiles, std::vector<double> distance) {
  AreaProblem problem = tiles;
  problem.measure = [box = tiles.box, periodic = tiles.periodic, distance = std::move(distance)](
                        const std::vector<Vec2>& centres, const std::vector<double>& weights) {
    const LaguerreOptions options{Duplicates::kKeepFirst, Hidden::kReport, periodic};
    return measure_insets(tessellate(centres, weights, box, options), centres, distance);
  };
  return problem;
}

std::vector<double> tiles_around_insets(const std::vector<double>& shares, const std::vector<double>& distance,
                                        double total) {
  // A polygon around a circle of radius p has the area c p^2 and, inset by s, c (p - s)^2; for a hexagon c = 2 sqrt 3.
  const double root = std::sqrt(2 * std::numbers::sqrt3);
  const double share_sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  std::vector<double> areas(shares.size());
  const auto sum_at = [&](double insets) {
    double sum = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const double side = std::sqrt(insets * shares[i] / share_sum) + root * distance[i];
      sum += areas[i] = side * side;
    }
    return sum;
  };
  if (sum_at(0) >= total)
    throw SceneError(fmt::format(
        "sample.areas.of = \"inset\": walls of this thickness need at least {:.3g} m2 for {} cells, the tissue has "
        "{:.3g} m2; choose a smaller radius or gap, or fewer cells",
        sum_at(0), shares.size(), total));
  double low = 0, high = total;
  for (int k = 0; k < 60; ++k) (sum_at((low + high) / 2) < total ? low : high) = (low + high) / 2;
  sum_at(low);
  return areas;
}

}  // namespace lamella
