#include "generator/tissue/check_tiles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "generator/packing/domain.h"
#include "generator/sample/errors.h"
#include "generator/tissue/lattice.h"
#include "generator/tissue/violations.h"

namespace lamella {
namespace {

bool check_corners(const Mosaic& tiles, std::vector<std::string>& all) {
  Violations bad;
  for (const MosaicCell& tile : tiles.cells) {
    if (tile.vertex.size() < 3) bad.add("{}: a tile of {} corners", tile.name, tile.vertex.size());
    for (const Index v : tile.vertex)
      if (v < 0 || v >= static_cast<Index>(tiles.vertices.size())) bad.add("{}: no vertex {}", tile.name, v);
  }
  bad.append_to(all);
  return !bad.any();
}

/// Sums over all tiles, in more digits than they have: in double, equal areas would all round the same way.
struct Sums {
  long double area = 0, free = 0;
  std::int64_t free_edges = 0, sides = 0, around = 0, squares = 0;
};

Sums add_up(const Mosaic& tiles, const std::vector<std::vector<EdgePlace>>& opposite, std::vector<std::string>& all) {
  Violations bad;
  Sums sums;
  for (std::size_t c = 0; c < tiles.cells.size(); ++c) {
    const MosaicCell& tile = tiles.cells[c];
    const auto points = polygon_of(tiles, tile);
    const double area = polygon_area(points);
    if (!(area > 0)) bad.add("{}: a tile of area {}", tile.name, area);
    sums.area += area;
    const auto n = static_cast<std::int64_t>(points.size());
    sums.squares += n * n;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (opposite[c][k].cell >= 0) {
        ++sums.sides;
        sums.around += static_cast<std::int64_t>(tiles.cells[opposite[c][k].cell].vertex.size());
        continue;
      }
      ++sums.free_edges;
      sums.free += (points[(k + 1) % points.size()] - points[k]).norm();
      if (tiles.periodic[0] && tiles.periodic[1]) bad.add("{}: its wall {} has one side only", tile.name, k);
    }
  }
  bad.append_to(all);
  return sums;
}

bool agree(long double found, double asked) {
  return std::abs(static_cast<double>(found - asked)) <= 1e-12 * std::abs(asked);
}

}  // namespace

std::vector<std::string> check_tiles(const Mosaic& tiles, const Filled& filled) {
  std::vector<std::string> all;
  if (!check_corners(tiles, all)) return all;
  std::vector<std::vector<EdgePlace>> opposite;
  try {
    opposite = opposite_edges(tiles);
  } catch (const SceneError& error) {
    return error.faults();
  }
  const Sums sums = add_up(tiles, opposite, all);
  if (!filled.known || !all.empty()) return all;
  Violations bad;
  std::vector<char> used(tiles.vertices.size(), 0);
  for (const MosaicCell& tile : tiles.cells)
    for (const Index v : tile.vertex) used[v] = 1;
  const std::int64_t vertices = std::count(used.begin(), used.end(), 1), edges = sums.sides / 2 + sums.free_edges,
                     faces = static_cast<std::int64_t>(tiles.cells.size());
  if (vertices - edges + faces != filled.euler)
    bad.add("tiles: V - E + F = {} - {} + {} instead of {}", vertices, edges, faces, filled.euler);
  // <n m(n)> = <n^2>: every tile is counted by each of its neighbours.
  if (sums.free_edges == 0 && sums.around != sums.squares)
    bad.add("tiles: the numbers of sides of all neighbours sum to {} instead of {}", sums.around, sums.squares);
  if (filled.area > 0 && !agree(sums.area, filled.area))
    bad.add("tiles: their areas sum to {:.17g} m2 instead of {:.17g}", static_cast<double>(sums.area), filled.area);
  if (filled.area > 0 && !agree(sums.free, filled.around))
    bad.add("tiles: their free edges sum to {:.17g} m, the boundary is {:.17g} m long", static_cast<double>(sums.free),
            filled.around);
  bad.append_to(all);
  return all;
}

Filled filled_by(const SampleScene& scene, const Box& box) {
  const bool whole = scene.kind == "tissue" || scene.kind == "bricks" || scene.kind == "honeycomb";
  if (!whole || (scene.notch && !scene.notch->polygon.empty())) return {};
  const Periodic periodic = periodic_of(scene);
  Filled filled{.known = true};
  if (periodic[0] || periodic[1]) filled.euler = 0;
  if (scene.domain) {
    const Domain domain = make_domain(*scene.domain);
    filled.euler = 2 - static_cast<int>(domain.loops.size());
    filled.area = domain.area;
    for (const auto& loop : domain.loops)
      for (std::size_t k = 0; k < loop.size(); ++k) filled.around += (loop[(k + 1) % loop.size()] - loop[k]).norm();
  } else if (scene.kind != "honeycomb" || (periodic[0] && periodic[1])) {
    filled.area = box.area();
    filled.around = 2 * ((periodic[0] ? 0 : box.size().y()) + (periodic[1] ? 0 : box.size().x()));
  }
  return filled;
}

}  // namespace lamella
