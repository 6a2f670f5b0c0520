// The invariants of the tissue of a domain. Shares nothing with the code that clips tiles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "generator/tissue/domain_tissue.h"

namespace lamella {
std::vector<std::string> check_domain_tissue(const DomainTissue& tissue, const Loops& loops) {
  std::vector<std::string> faults;
  const auto& cells = tissue.mosaic.cells;
  std::vector<std::pair<Vec2, Vec2>> sides;
  double area = 0;
  for (const auto& loop : loops) {
    area += polygon_area(loop);
    for (std::size_t k = 0; k < loop.size(); ++k) sides.emplace_back(loop[k], loop[(k + 1) % loop.size()]);
  }
  std::map<std::pair<Index, Index>, bool> edges;  // whether on the boundary
  std::set<Index> used;
  double sum = 0, on_boundary = 0, around = 0;
  const double size = tissue.mosaic.box.size().maxCoeff();
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto points = polygon_of(tissue.mosaic, cells[c]);
    const double own = polygon_area(points);
    if (!(own > 0)) faults.push_back(fmt::format("{}: area {}", cells[c].name, own));
    sum += own;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Index u = cells[c].vertex[k], v = cells[c].vertex[(k + 1) % points.size()];
      const Index side = tissue.boundary[c][k];
      used.insert(u);
      if (!edges.insert({{u, v}, side >= 0}).second)
        faults.push_back(fmt::format("edge {} {} has two cells on its left", u, v));
      if (side < 0) continue;
      const auto& [a, b] = sides[side];
      const Vec2 &p = points[k], &q = points[(k + 1) % points.size()];
      if (distance_to_segment(p, a, b) > 1e-13 * size || distance_to_segment(q, a, b) > 1e-13 * size)
        faults.push_back(fmt::format("edge {} {} of {} does not lie on the boundary", u, v, cells[c].name));
      on_boundary += (q - p).dot((b - a).normalized());
    }
    auto vertex = cells[c].vertex;
    std::sort(vertex.begin(), vertex.end());
    if (vertex.size() < 3 || std::adjacent_find(vertex.begin(), vertex.end()) != vertex.end())
      faults.push_back(fmt::format("{} touches itself", cells[c].name));
  }
  for (const auto& [a, b] : sides) around += (b - a).norm();
  Index count = 0;
  for (const auto& [ends, boundary] : edges) {
    const bool twin = edges.contains({ends.second, ends.first});
    if (twin == boundary)
      faults.push_back(fmt::format("edge {} {} {}", ends.first, ends.second,
                                   boundary ? "of the boundary has a cell on both sides" : "has one side only"));
    if (boundary || ends.first < ends.second) ++count;
  }
  const auto euler = static_cast<Index>(used.size()) - count + static_cast<Index>(cells.size());
  const auto holes = static_cast<Index>(loops.size()) - 1;
  if (euler != 1 - holes) faults.push_back(fmt::format("V - E + F = {} instead of {}", euler, 1 - holes));
  if (!(std::abs(sum - area) <= 1e-12 * area))
    faults.push_back(fmt::format("the areas sum to {:.17g} instead of {:.17g}", sum, area));
  if (!(std::abs(on_boundary - around) <= 1e-12 * around))
    faults.push_back(fmt::format("the cells cover {:.17g} m of {:.17g} m of the boundary", on_boundary, around));
  return faults;
}

}  // namespace lamella
