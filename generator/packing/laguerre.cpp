#include "generator/packing/laguerre.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "generator/packing/power_diagram.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

// Sides in counter-clockwise order; corner q lies between side q and side q + 1.
constexpr std::array<Index, 4> kSides = {kBottomSide, kRightSide, kTopSide, kLeftSide};

Vec2 corner_position(const Box& box, int q) {
  return {q < 2 ? box.hi.x() : box.lo.x(), q == 0 || q == 3 ? box.lo.y() : box.hi.y()};
}

double power(const Disk& disk, const Vec2& p) { return (p - disk.centre).squaredNorm() - disk.radius * disk.radius; }

/// One end of a clipped edge: a vertex of the diagram that lies inside the box (side -1), or a point on a side (0 .. 3, ccw).
struct EdgeEnd {
  Index vertex = -1;  // id in the tessellation
  int side = -1;
};

/// What the box leaves of an edge. Every edge is cut once for both its tiles, so that they cannot disagree.
struct ClippedEdge {
  EdgeEnd begin, end;
};

/// The line p(s) = foot + s t of an edge, and where it enters and leaves the box.
struct Axis {
  Vec2 foot, t;
  double enter = -std::numeric_limits<double>::infinity(), leave = std::numeric_limits<double>::infinity();
  int enter_side = -1, leave_side = -1;
  bool beside = false;  // parallel to a side, and outside it

  Axis(const Disk& a, const Disk& b, const Box& box) {
    const Vec2 d = b.centre - a.centre;
    const double d2 = d.squaredNorm();
    foot = a.centre + d * (0.5 + (a.radius * a.radius - b.radius * b.radius) / (2 * d2));
    t = left_of(d) / std::sqrt(d2);
    cut(t.x(), foot.x(), box.lo.x(), box.hi.x(), 3, 1);
    cut(t.y(), foot.y(), box.lo.y(), box.hi.y(), 0, 2);
  }
  double parameter(const Vec2& p) const { return (p - foot).dot(t); }
  double middle() const { return (enter + leave) / 2; }

 private:
  void cut(double slope, double at, double lo, double hi, int lo_side, int hi_side) {
    if (slope == 0) {
      beside = beside || at <= lo || at >= hi;
      return;
    }
    const double s_lo = (lo - at) / slope, s_hi = (hi - at) / slope;
    const double first = std::min(s_lo, s_hi), last = std::max(s_lo, s_hi);
    if (first > enter) enter = first, enter_side = slope > 0 ? lo_side : hi_side;
    if (last < leave) leave = last, leave_side = slope > 0 ? hi_side : lo_side;
  }
};

class BoxClipper {
 public:
  BoxClipper(const std::vector<Disk>& disks, const PowerDiagram& diagram, const Box& box, Tessellation& result)
      : disks_(disks), diagram_(diagram), box_(box), result_(result), id_(diagram.vertices.size(), -1) {
    corner_.fill(-1);
    result_.vertices.clear();
    result_.tiles.clear();
    for (const PowerEdge& edge : diagram.edges) clipped_.push_back(clip(edge));
  }

  /// The tile of `site`; empty when it has no part in the box.
  Tile tile(Index site) {
    struct Side {
      EdgeEnd begin, end;
      Index neighbour;
    };
    std::vector<Side> chain;
    for (Index k = diagram_.ring_begin[site]; k < diagram_.ring_begin[site + 1]; ++k) {
      const PowerEdge& edge = diagram_.edges[diagram_.ring[k]];
      const auto& cut = clipped_[diagram_.ring[k]];
      if (!cut) continue;
      if (edge.a == site)
        chain.push_back({cut->begin, cut->end, edge.b});
      else
        chain.push_back({cut->end, cut->begin, edge.a});
    }
    Tile tile{.site = site, .vertex = {}, .neighbour = {}, .image = {}, .across = {}};
    if (chain.empty()) {
      if (owns(site, (box_.lo + box_.hi) / 2) && nothing_cuts_the_box()) add_boundary(tile, 0, 4);
      return tile;
    }
    const auto gaps = static_cast<std::size_t>(
        std::count_if(chain.begin(), chain.end(), [](const Side& side) { return side.end.side >= 0; }));
    for (std::size_t k = 0; k < chain.size(); ++k) {
      const Side& here = chain[k];
      const Side& next = chain[(k + 1) % chain.size()];
      tile.vertex.push_back(here.begin.vertex);
      tile.neighbour.push_back(here.neighbour);
      if (here.end.side < 0) {
        assert(here.end.vertex == next.begin.vertex);
        continue;
      }
      tile.vertex.push_back(here.end.vertex);
      tile.neighbour.push_back(kSides[here.end.side]);
      add_boundary(tile, here.end.side, corners_between(site, here.end, next.begin, gaps));
    }
    return tile;
  }

 private:
  std::optional<ClippedEdge> clip(const PowerEdge& edge) {
    const bool begin_inside = inside(edge.begin), end_inside = inside(edge.end);
    if (begin_inside && end_inside) return ClippedEdge{{vertex(edge.begin)}, {vertex(edge.end)}};
    const Axis axis(disks_[edge.a], disks_[edge.b], box_);
    // A vertex outside the box lies before the entry or behind the exit; compared with the middle, rounding cannot confuse the two.
    const bool begin_before = edge.begin < 0 || axis.parameter(diagram_.vertices[edge.begin]) < axis.middle();
    const bool end_behind = edge.end < 0 || axis.parameter(diagram_.vertices[edge.end]) > axis.middle();
    if (begin_inside) return ClippedEdge{{vertex(edge.begin)}, crossing(axis, end_behind)};
    if (end_inside) return ClippedEdge{crossing(axis, !begin_before), {vertex(edge.end)}};
    if (axis.beside || !(axis.enter < axis.leave) || !begin_before || !end_behind) return {};
    return ClippedEdge{crossing(axis, false), crossing(axis, true)};
  }

  EdgeEnd crossing(const Axis& axis, bool at_exit) {
    const int side = at_exit ? axis.leave_side : axis.enter_side;
    Vec2 p = axis.foot + (at_exit ? axis.leave : axis.enter) * axis.t;
    p = p.cwiseMax(box_.lo).cwiseMin(box_.hi);
    if (side == 1 || side == 3)
      p.x() = side == 1 ? box_.hi.x() : box_.lo.x();
    else
      p.y() = side == 2 ? box_.hi.y() : box_.lo.y();
    return {add_vertex(p), side};
  }

  /// Strictly: a wall that lies along a side belongs to the side.
  bool inside(Index v) const {
    return v >= 0 && (diagram_.vertices[v].array() > box_.lo.array()).all() &&
           (diagram_.vertices[v].array() < box_.hi.array()).all();
  }

  Index vertex(Index v) {
    if (id_[v] < 0) id_[v] = add_vertex(diagram_.vertices[v]);
    return id_[v];
  }

  Index add_vertex(const Vec2& p) {
    result_.vertices.push_back(p);
    return static_cast<Index>(result_.vertices.size()) - 1;
  }

  /// The next `count` corners after `side`, each followed by the side behind it.
  void add_boundary(Tile& tile, int side, int count) {
    for (int q = side; q < side + count; ++q) {
      Index& corner = corner_[q % 4];
      if (corner < 0) corner = add_vertex(corner_position(box_, q % 4));
      tile.vertex.push_back(corner);
      tile.neighbour.push_back(kSides[(q + 1) % 4]);
    }
  }

  /// Corners of the box on the way along its boundary from where the tile's walls leave the box to where they come back.
  /// Counting sides alone cannot tell none from all four, nor, when both ends agree with a corner up to rounding, -1
  /// from three. Then the far corners decide, and if the tile touches the boundary in `gaps` > 1 pieces, the distance.
  int corners_between(Index site, const EdgeEnd& from, const EdgeEnd& to, std::size_t gaps) const {
    const int count = (to.side - from.side + 4) % 4;
    if (count != 0 && count != 3) return count;
    const Vec2 first = corner_position(box_, from.side), second = corner_position(box_, (from.side + 1) % 4),
               third = corner_position(box_, (from.side + 2) % 4);
    if (!owns(site, second) || (count == 0 && !owns(site, third))) return 0;
    const Vec2 way = result_.vertices[to.vertex] - result_.vertices[from.vertex];
    const Vec2 along = -left_of(second - first).normalized();  // of the side `from`: the next one turned back
    const double tolerance = 1e-12 * box_.size().maxCoeff();
    if (count == 0) return gaps == 1 || way.dot(along) < -tolerance ? 4 : 0;
    return gaps == 1 || way.norm() > tolerance ? 3 : 0;
  }

  bool owns(Index site, const Vec2& p) const {
    for (Index k = diagram_.ring_begin[site]; k < diagram_.ring_begin[site + 1]; ++k) {
      const PowerEdge& edge = diagram_.edges[diagram_.ring[k]];
      if (power(disks_[edge.a == site ? edge.b : edge.a], p) < power(disks_[site], p)) return false;
    }
    return true;
  }

  bool nothing_cuts_the_box() const {
    return std::none_of(clipped_.begin(), clipped_.end(), [](const auto& cut) { return cut.has_value(); });
  }

  const std::vector<Disk>& disks_;
  const PowerDiagram& diagram_;
  const Box& box_;
  Tessellation& result_;
  std::vector<Index> id_;  // of the diagram's vertices in the result, -1 until used
  std::array<Index, 4> corner_;
  std::vector<std::optional<ClippedEdge>> clipped_;
};

std::string name_of(const std::vector<Disk>& disks, Index i) {
  return fmt::format("disk {} (x = {:.9g}, y = {:.9g}, r = {:.9g})", i, disks[i].centre.x(), disks[i].centre.y(),
                     disks[i].radius);
}

/// The first few faults in full, the rest as a number.
[[noreturn]] void refuse(std::vector<std::string> faults) {
  constexpr std::size_t kShown = 20;
  if (faults.size() > kShown) {
    const std::size_t more = faults.size() - kShown;
    faults.resize(kShown);
    faults.push_back(fmt::format("and {} more of this kind", more));
  }
  throw SceneError(std::move(faults));
}

void refuse_bad_disks(const std::vector<Disk>& disks, const Box& box) {
  if (disks.empty()) throw SceneError("the packing has no disks: a tessellation needs at least one");
  if (!(box.size().array() > 0).all() || !box.size().allFinite())
    throw SceneError(
        fmt::format("the box is {} x {} m: width and height must be positive", box.size().x(), box.size().y()));
  std::vector<std::string> faults;
  for (Index i = 0; i < static_cast<Index>(disks.size()); ++i) {
    if (!disks[i].centre.allFinite() || !(disks[i].radius >= 0) || !std::isfinite(disks[i].radius))
      faults.push_back(name_of(disks, i) + " is not a disk: coordinates must be finite and the radius not negative");
    else if (!box.contains(disks[i].centre))
      faults.push_back(fmt::format(
          "{} has its centre outside the box [{:.9g}, {:.9g}] x [{:.9g}, {:.9g}]: move it inside or enlarge the box",
          name_of(disks, i), box.lo.x(), box.hi.x(), box.lo.y(), box.hi.y()));
  }
  if (!faults.empty()) refuse(std::move(faults));
}

/// All sites but later duplicates, which go to `dropped`.
std::vector<Index> distinct_sites(const std::vector<Disk>& disks, Duplicates duplicates, std::vector<Index>& dropped) {
  const auto key = [&](Index i) { return std::array{disks[i].centre.x(), disks[i].centre.y(), disks[i].radius}; };
  std::vector<Index> order(disks.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index i, Index j) {
    const auto a = key(i), b = key(j);
    return a != b ? a < b : i < j;
  });
  std::vector<Index> sites;
  std::vector<std::string> faults;
  Index first = -1;
  for (const Index i : order) {
    if (first >= 0 && key(i) == key(first)) {
      dropped.push_back(i);
      faults.push_back(fmt::format(
          "{} is the same as disk {}: remove one of them, or set sample.packing.duplicates = \"keep_first\"",
          name_of(disks, i), first));
    } else {
      sites.push_back(first = i);
    }
  }
  if (!faults.empty() && duplicates == Duplicates::kRefuse) refuse(std::move(faults));
  std::sort(sites.begin(), sites.end());
  return sites;
}

/// Tiles of `sites`; returns the sites that have no area in the box.
std::vector<Index> tessellate_sites(const std::vector<Disk>& disks, const std::vector<Index>& sites,
                                    Tessellation& result) {
  const PowerDiagram diagram = power_diagram(disks, sites);
  BoxClipper clipper(disks, diagram, result.box, result);
  std::vector<Index> without_area;
  for (const Index site : sites) {
    Tile tile = diagram.visible[site] ? clipper.tile(site) : Tile{};
    // A tile cut by a side almost along a wall can be left with an area that is rounding only.
    if (tile.vertex.empty() || tile_area(result, tile) <= 1e-15 * result.box.area())
      without_area.push_back(site);
    else
      result.tiles.push_back(std::move(tile));
  }
  return without_area;
}

}  // namespace

Tessellation tessellate(const std::vector<Disk>& disks, const Box& box, const LaguerreOptions& options) {
  if (options.periodic[0] || options.periodic[1]) throw SceneError("periodic tessellation: to come");
  refuse_bad_disks(disks, box);
  Tessellation result;
  result.box = box;
  std::vector<Index> sites = distinct_sites(disks, options.duplicates, result.hidden);
  std::vector<Index> hidden;
  // A hidden site does not change the diagram, but slivers do by their rounding: once more without, until there are none.
  for (std::vector<Index> without_area; !(without_area = tessellate_sites(disks, sites, result)).empty();) {
    std::vector<Index> rest;
    std::set_difference(sites.begin(), sites.end(), without_area.begin(), without_area.end(), std::back_inserter(rest));
    hidden.insert(hidden.end(), without_area.begin(), without_area.end());
    sites = std::move(rest);
  }
  std::sort(hidden.begin(), hidden.end());
  if (!hidden.empty() && options.hidden == Hidden::kRefuse) {
    std::vector<std::string> faults;
    for (const Index i : hidden)
      faults.push_back(name_of(disks, i) +
                       " has no tile in the box, larger disks beside it hide it: remove it, enlarge it, or use disks "
                       "that do not overlap");
    refuse(std::move(faults));
  }
  result.hidden.insert(result.hidden.end(), hidden.begin(), hidden.end());
  std::sort(result.hidden.begin(), result.hidden.end());
  return result;
}

Tessellation tessellate(const std::vector<Vec2>& centres, const std::vector<double>& weights, const Box& box,
                        const LaguerreOptions& options) {
  std::vector<Disk> disks;
  const double least = weights.empty() ? 0 : *std::min_element(weights.begin(), weights.end());
  for (std::size_t i = 0; i < centres.size(); ++i) disks.push_back({centres[i], std::sqrt(weights[i] - least)});
  return tessellate(disks, box, options);
}

TileMeasures measure_tiles(const std::vector<Vec2>& centres, const std::vector<double>& weights, const Box& box,
                           Periodic periodic) {
  const Tessellation t = tessellate(centres, weights, box, {Duplicates::kKeepFirst, Hidden::kReport, periodic});
  TileMeasures measures{std::vector<double>(centres.size(), 0), centres, {}};
  for (const Tile& tile : t.tiles) {
    measures.area[tile.site] = tile_area(t, tile);
    measures.centroid[tile.site] = tile_centroid(t, tile);
    for (std::size_t k = 0; k < tile.vertex.size(); ++k)
      if (tile.neighbour[k] > tile.site)
        measures.walls.push_back({tile.site, tile.neighbour[k], {0, 0}, edge_length(t, tile, k)});
  }
  return measures;
}

}  // namespace lamella
