// The invariants of a sample. Shares nothing with the code that makes samples.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/generate.h"
#include "generator/tissue/violations.h"

namespace lamella {
namespace {

bool check_shapes_of_arrays(const Sample& s, std::vector<std::string>& all) {
  Violations bad;
  if (s.cell_begin.empty() || s.cell_begin.front() != 0 || s.cell_begin.back() != s.nodes() ||
      !std::is_sorted(s.cell_begin.begin(), s.cell_begin.end()))
    bad.add("cell_begin does not divide the {} nodes among cells", s.nodes());
  const auto nodes = s.x.size();
  const auto cells = s.cell_begin.empty() ? 0 : s.cell_begin.size() - 1;
  if (s.side.size() != nodes || s.rest_length.size() != nodes || s.rest_angle.size() != nodes ||
      s.hinge_length.size() != nodes)
    bad.add("an array per node does not have {} entries", nodes);
  if (s.link_image.size() != (is_periodic(s) ? s.links.size() : 0))
    bad.add("link_image has {} entries for {} links; all links have images in a periodic sample, none in another",
            s.link_image.size(), s.links.size());
  if (s.closed.size() != cells || s.group.size() != cells || s.radius.size() != cells || s.rest_area.size() != cells ||
      s.tile_area.size() != cells)
    bad.add("an array per cell does not have {} entries", cells);
  if (!s.link_strength.empty() && s.link_strength.size() != s.links.size())
    bad.add("link_strength has {} entries for {} links", s.link_strength.size(), s.links.size());
  if (!s.cell_thickness.empty() && s.cell_thickness.size() != cells)
    bad.add("cell_thickness has {} entries for {} cells", s.cell_thickness.size(), cells);
  bad.append_to(all);
  return !bad.any();
}

void check_cells(const Sample& s, double filled, std::vector<std::string>& all) {
  Violations bad;
  if (!(std::isfinite(s.box.area()) && (s.box.size().array() > 0).all()))
    bad.add("the box runs from ({}, {}) to ({}, {})", s.box.lo.x(), s.box.lo.y(), s.box.hi.x(), s.box.hi.y());
  double tiles = 0;
  for (Index c = 0; c < s.cells(); ++c) {
    const Index begin = s.cell_begin[c];
    if (s.group[c] < 0 || s.group[c] >= static_cast<Index>(s.group_names.size()))
      bad.add("cell {}: group {} does not exist", c, s.group[c]);
    if (!(std::isfinite(s.radius[c]) && s.radius[c] >= 0)) bad.add("cell {}: radius {}", c, s.radius[c]);
    if (!s.cell_thickness.empty() && !(std::isfinite(s.cell_thickness[c]) && s.cell_thickness[c] > 0))
      bad.add("cell {}: a factor {} on its wall's thickness", c, s.cell_thickness[c]);
    if (!s.closed[c]) {
      if (s.cell_size(c) < 2) bad.add("cell {}: an open chain of {} nodes", c, s.cell_size(c));
      continue;
    }
    if (s.cell_size(c) < 3) {
      bad.add("cell {}: a closed shell of {} nodes", c, s.cell_size(c));
      continue;
    }
    const double area = polygon_area(s.x.data() + begin, s.cell_size(c));
    if (!(area > 0)) bad.add("cell {}: its nodes do not run counter-clockwise (area {})", c, area);
    if (!(std::isfinite(s.rest_area[c]) && s.rest_area[c] > 0)) bad.add("cell {}: rest area {}", c, s.rest_area[c]);
    // A shell inscribed in a convex tile is no larger; in a concave corner, segments may cut across what is not the tile's.
    const auto convex = [&] {
      const auto angles = s.rest_angle.begin() + begin;
      return std::all_of(angles, angles + s.cell_size(c), [](double angle) { return angle >= 0; });
    };
    if (!(s.tile_area[c] >= s.rest_area[c] * (1 - 1e-9)) && (!(s.tile_area[c] > 0) || convex()))
      bad.add("cell {}: its tile {} m2 is smaller than its rest area {} m2", c, s.tile_area[c], s.rest_area[c]);
    // A shape beside a tissue has an area of its own; it takes none of the box.
    Vec2 mean = Vec2::Zero();
    for (Index k = begin; k < s.cell_begin[c + 1]; ++k) mean += s.x[k] / s.cell_size(c);
    for (const int axis : {0, 1})
      if (s.periodic[axis]) mean[axis] = s.box.lo[axis];  // inside, as one of its images is
    if (s.box.contains(mean)) tiles += s.tile_area[c];
  }
  if (tiles > s.box.area() * (1 + 1e-9))
    bad.add("the tiles have {} m2 together, more than the box with {} m2", tiles, s.box.area());
  if (filled > 0 && !(std::abs(tiles - filled) <= 1e-9 * filled))
    bad.add("the tiles have {} m2 together; they must fill {} m2", tiles, filled);
  bad.append_to(all);
}

void check_nodes(const Sample& s, std::vector<std::string>& all) {
  Violations bad;
  for (Index c = 0; c < s.cells(); ++c) {
    for (Index k = s.cell_begin[c]; k < s.cell_begin[c + 1]; ++k) {
      if (!s.x[k].allFinite()) bad.add("node {} of cell {}: position not finite", k, c);
      if (s.starts_segment(c, k)) {
        if (!(std::isfinite(s.rest_length[k]) && s.rest_length[k] > 0))
          bad.add("segment {} of cell {}: rest length {}", k, c, s.rest_length[k]);
        if (!((s.x[s.next(c, k)] - s.x[k]).norm() > 0)) bad.add("segment {} of cell {} has no length", k, c);
      } else if (s.rest_length[k] != 0) {
        bad.add("node {} ends chain {} but has a rest length", k, c);
      }
      if (!std::isfinite(s.rest_angle[k])) bad.add("node {} of cell {}: rest angle {}", k, c, s.rest_angle[k]);
      if (!(std::isfinite(s.hinge_length[k]) && s.hinge_length[k] >= 0))
        bad.add("node {} of cell {}: hinge length {}", k, c, s.hinge_length[k]);
    }
  }
  bad.append_to(all);
}

}  // namespace

std::vector<std::string> check_sample(const Sample& sample, double filled) {
  std::vector<std::string> all;
  if (!check_shapes_of_arrays(sample, all)) return all;
  check_cells(sample, filled, all);
  check_nodes(sample, all);
  check_walls_and_links(sample, all);
  if (all.empty()) check_crossings(sample, all);
  return all;
}

}  // namespace lamella
