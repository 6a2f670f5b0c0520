#include "generator/tissue/outlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

/// The two nodes of every pair, in the cell of lower index (a) and in the other (b).
struct PairNodes {
  std::vector<Index> a, b;
};

/// Mass points of one outline: clusters of candidates that follow each other more closely than `merge`.
/// node_of[k] is the mass point of candidate k.
struct Merged {
  std::vector<Vec2> points;
  std::vector<std::uint8_t> side;
  std::vector<Index> node_of;
};

/// Whether the outline turns away from its cell there: what lies beyond is another cell.
bool is_reflex(const std::vector<OutlineNode>& nodes, std::size_t k) {
  const std::size_t count = nodes.size();
  const Vec2 in = nodes[k].at - nodes[(k + count - 1) % count].at, out = nodes[(k + 1) % count].at - nodes[k].at;
  return cross(in, out) < -1e-9 * in.norm() * out.norm();
}

Merged merge_close(const std::vector<OutlineNode>& nodes, double merge) {
  const std::size_t count = nodes.size();
  Merged merged;
  merged.node_of.assign(count, -1);
  const auto gap_after = [&](std::size_t k) { return (nodes[(k + 1) % count].at - nodes[k].at).norm(); };
  // Start behind a gap that stays, so that no cluster is cut by the end of the list.
  std::size_t start = 0;
  while (start < count && gap_after((start + count - 1) % count) < merge) ++start;
  if (start == count) return merged;

  for (std::size_t i = 0; i < count;) {
    Vec2 sum = Vec2::Zero();
    int summed = 0;
    auto highest = OutlineNode::Kind::fill;
    bool reflex = false;
    std::uint8_t side = 0;
    const auto point = static_cast<Index>(merged.points.size());
    while (true) {
      const std::size_t k = (start + i) % count;
      const OutlineNode& node = nodes[k];
      // In the middle between a reflex corner and another the outline would reach into what lies beyond.
      const bool reflex_here = node.kind == OutlineNode::Kind::corner && is_reflex(nodes, k);
      if (std::pair(node.kind, reflex_here) > std::pair(highest, reflex)) {
        highest = node.kind;
        reflex = reflex_here;
        sum.setZero();
        summed = 0;
      }
      if (node.kind == highest && reflex_here == reflex) {
        sum += node.at;
        ++summed;
      }
      side |= node.side;
      merged.node_of[k] = point;
      ++i;
      if (i == count || gap_after(k) >= merge) break;
    }
    merged.points.push_back(sum / summed);
    merged.side.push_back(side);
  }
  return merged;
}

/// Segments of `cell` beside `node` that run along `direction`, as (previous, next); at least one of the two.
std::pair<Index, Index> stencil_along(const Sample& sample, Index cell, Index node, const Vec2& direction) {
  const Index before = sample.prev(cell, node);
  const Index after = sample.next(cell, node);
  const double aligned = 0.95;  // cosine of 18 degrees
  const bool in = (sample.x[node] - sample.x[before]).normalized().dot(direction) > aligned;
  const bool out = (sample.x[after] - sample.x[node]).normalized().dot(direction) > aligned;
  if (in == out) return {before, after};
  return in ? std::pair{before, node} : std::pair{node, after};
}

/// Links of one wall: pairs that merged into the same two nodes are one link.
std::vector<Link> links_of_wall(const Bonding& bonding, const FacingWall& wall, const PairNodes& nodes) {
  std::vector<Link> links;
  for (Index p = wall.first; p < wall.first + wall.count; ++p) {
    const FacingPair& pair = bonding.pairs[p];
    if (!pair.linked) continue;
    if (!links.empty() && links.back().a == nodes.a[p] && links.back().b == nodes.b[p]) {
      links.back().length += pair.length;
      links.back().spacing = std::max(links.back().spacing, pair.spacing);
      continue;
    }
    Link link;
    link.a = nodes.a[p];
    link.b = nodes.b[p];
    link.length = pair.length;
    link.spacing = pair.spacing;
    links.push_back(link);
  }
  return links;
}

/// Tangent stencils and stress-free offsets. Inside a wall both neighbours enter, at its ends only the one on the wall.
/// False when the link has no frame: its nodes coincide or lie the wrong way round.
bool set_frame(const Sample& sample, Index cell_a, Index cell_b, const FacingWall& wall, bool first, bool last,
               Link& link) {
  link.wall_end = first || last ? 1 : 0;
  if (first && last) {
    std::tie(link.a_prev, link.a_next) = stencil_along(sample, cell_a, link.a, wall.direction);
    std::tie(link.b_prev, link.b_next) = stencil_along(sample, cell_b, link.b, -wall.direction);
  } else {
    link.a_prev = first ? link.a : sample.prev(cell_a, link.a);
    link.a_next = last ? link.a : sample.next(cell_a, link.a);
    link.b_prev = last ? link.b : sample.prev(cell_b, link.b);
    link.b_next = first ? link.b : sample.next(cell_b, link.b);
  }
  const Vec2 tau = (sample.x[link.a_next] - sample.x[link.a_prev]) - (sample.x[link.b_next] - sample.x[link.b_prev]);
  if (!(tau.norm() > 0)) return false;
  const Vec2 tangent = tau.normalized();
  const Vec2 across = sample.x[link.b] + displacement(wall.image, sample.box) - sample.x[link.a];
  link.offset_n = across.dot(right_of(tangent));
  link.offset_t = across.dot(tangent);
  return link.offset_n > 0;
}

}  // namespace

std::string listed(const std::vector<std::string>& names) {
  const std::size_t shown = std::min<std::size_t>(10, names.size());
  std::string text =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

void add_bonded_cells(const Bonding& bonding, double radius, const std::string& group, Sample& sample, Notes& notes) {
  const double merge = kMergeFraction * bonding.spacing;
  const Index first_cell = sample.cell_begin.empty() ? 0 : sample.cells();
  PairNodes nodes{std::vector<Index>(bonding.pairs.size(), -1), std::vector<Index>(bonding.pairs.size(), -1)};
  // Which of the two cells of a pair comes first is the wall's to say, unless both are the same.
  std::vector<const FacingWall*> wall_of_pair(bonding.pairs.size(), nullptr);
  for (const FacingWall& wall : bonding.walls) std::fill_n(wall_of_pair.begin() + wall.first, wall.count, &wall);

  std::vector<std::string> too_small;
  std::vector<std::string> names;
  Index moved = 0;
  for (std::size_t c = 0; c < bonding.cells.size(); ++c) {
    const Outline& outline = bonding.cells[c];
    const Merged merged = merge_close(outline.nodes, merge);
    if (merged.points.size() < 3) {
      too_small.push_back(outline.name);
      continue;
    }
    const Index begin = sample.nodes();
    const Index cell = add_cell(sample, merged.points, true, radius, group);
    sample.tile_area[cell] = outline.tile_area;
    std::copy(merged.side.begin(), merged.side.end(), sample.side.begin() + begin);
    for (std::size_t k = 0; k < outline.nodes.size(); ++k) {
      const Index pair = outline.nodes[k].pair;
      if (pair < 0) continue;
      const Index node = begin + merged.node_of[k];
      const FacingWall& wall = *wall_of_pair[pair];
      const bool is_a = wall.cell_a == wall.cell_b ? outline.nodes[k].first_side : wall.cell_a == static_cast<Index>(c);
      (is_a ? nodes.a : nodes.b)[pair] = node;
      if ((sample.x[node] - outline.nodes[k].at).norm() > 1e-9 * bonding.spacing) ++moved;
    }
    names.push_back(outline.name);
  }
  if (!too_small.empty())
    throw SceneError(
        fmt::format("{}: fewer than three mass points at a spacing of {:.4g} m; ask for a smaller spacing "
                    "or more segments, or give the cells more equal sizes",
                    listed(too_small), bonding.spacing));

  std::vector<std::string> crushed;
  Index coupled = 0;
  for (const FacingWall& wall : bonding.walls) {
    const auto index = static_cast<Index>(sample.walls.size());
    const Index cell_a = first_cell + wall.cell_a;
    const Index cell_b = first_cell + wall.cell_b;
    sample.walls.push_back({cell_a, cell_b, wall.length});
    auto links = links_of_wall(bonding, wall, nodes);
    for (std::size_t k = 0; k < links.size(); ++k) {
      links[k].wall = index;
      if (set_frame(sample, cell_a, cell_b, wall, k == 0, k + 1 == links.size(), links[k])) {
        sample.links.push_back(links[k]);
        if (is_periodic(sample)) sample.link_image.push_back(wall.image);
        ++coupled;
      } else {
        crushed.push_back(bonding.cells[wall.cell_a].name + " - " + bonding.cells[wall.cell_b].name);
      }
    }
  }
  if (!crushed.empty())
    notes.push_back(fmt::format("{} links left out, because merging left their wall without a direction: {}",
                                crushed.size(), listed(crushed)));
  if (moved > 0)
    notes.push_back(
        fmt::format("{} of {} facing mass points merged with a corner closer than {} spacings; their links "
                    "are oblique and free of stress",
                    moved, 2 * bonding.pairs.size(), kMergeFraction));
  note_shortest_segment(sample, names, notes);
}

void note_shortest_segment(const Sample& sample, const std::vector<std::string>& cell_names, Notes& notes) {
  double shortest = 1e300;
  double sum = 0;
  Index in_cell = 0;
  Index segments = 0;
  double stiffest =
      0;  // of 2 (1/l + 1/l') / m, m = (l + l') / 2: what bounds omega^2 of stretching, 4 EA / (rho h s) left out
  for (Index c = 0; c < sample.cells(); ++c) {
    for (Index k = sample.cell_begin[c]; k < sample.cell_begin[c + 1]; ++k) {
      if (!sample.starts_segment(c, k)) continue;
      const double l = sample.rest_length[k];
      sum += l;
      ++segments;
      if (l < shortest) {
        shortest = l;
        in_cell = c;
      }
      if (sample.hinge_length[k] <= 0) continue;
      const double before = sample.rest_length[sample.prev(c, k)];
      stiffest = std::max(stiffest, 4 * (1 / l + 1 / before) / (l + before));
    }
  }
  if (segments == 0 || stiffest <= 0) return;
  const double mean = sum / segments;
  if (shortest > 0.999 * mean) return;
  const double step = std::sqrt(4 / (mean * mean) / stiffest);
  const std::string where =
      in_cell < static_cast<Index>(cell_names.size()) ? cell_names[in_cell] : fmt::format("cell {}", in_cell);
  notes.push_back(
      fmt::format("shortest segment {:.4g} m = {:.2f} mean segments, in {}; it leaves about {:.0f} % of the "
                  "time step of equal segments",
                  shortest, shortest / mean, where, 100 * std::min(1.0, step)));
}

}  // namespace lamella
