#include "generator/packing/tile_maker.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace lamella {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Index kUnused = -1, kOutside = -2;

// Sides in counter-clockwise order; corner q lies between side q and side q + 1.
constexpr std::array<Index, 4> kSides = {kBottomSide, kRightSide, kTopSide, kLeftSide};

Image sum(const Image& a, const Image& b) {
  return {static_cast<std::int8_t>(a[0] + b[0]), static_cast<std::int8_t>(a[1] + b[1])};
}
Image minus(const Image& a) { return {static_cast<std::int8_t>(-a[0]), static_cast<std::int8_t>(-a[1])}; }

}  // namespace

/// The line p(s) = foot + s t of an edge, a on its left, and where it enters and leaves the box.
struct TileMaker::Axis {
  Vec2 foot, t;
  double enter = -kInfinity, leave = kInfinity;
  int enter_side = -1, leave_side = -1;
  bool beside = false;  // parallel to a side, and outside it

  Axis(const PowerSite& a, const PowerSite& b, const Box& box, const Periodic& periodic) {
    const Vec2 d = b.centre - a.centre;
    const double d2 = d.squaredNorm();
    foot = a.centre + d * (0.5 + (a.weight - b.weight) / (2 * d2));
    t = left_of(d) / std::sqrt(d2);
    if (!periodic[0]) cut(t.x(), foot.x(), box.lo.x(), box.hi.x(), 3, 1);
    if (!periodic[1]) cut(t.y(), foot.y(), box.lo.y(), box.hi.y(), 0, 2);
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

std::size_t TileMaker::Hash::operator()(const Key& key) const {
  std::uint64_t h = static_cast<std::uint32_t>(key[0]) | static_cast<std::uint64_t>(key[1]) << 32;
  h = (h ^ static_cast<std::uint64_t>(key[2]) << 20) * 0x9e3779b97f4a7c15u;
  return h ^ (h >> 32);
}

TileMaker::TileMaker(const PlaneDiagram& plane, std::vector<Vec2>& vertices)
    : plane_(plane),
      d_(plane.diagram),
      periodic_(plane.periodic[0] || plane.periodic[1]),
      vertices_(vertices),
      id_(d_.vertices.size(), kUnused) {
  corner_.fill(-1);
  vertices_.clear();
  vertices_.reserve(d_.vertices.size());
  // Strictly inside: a wall that lies along a side belongs to the side.
  for (std::size_t v = 0; v < id_.size(); ++v)
    for (const int axis : {0, 1})
      if (!plane.periodic[axis] &&
          !(d_.vertices[v][axis] > plane.box.lo[axis] && d_.vertices[v][axis] < plane.box.hi[axis]))
        id_[v] = kOutside;
}

void TileMaker::make(Index site, Tile& tile) {
  tile.site = site;
  tile.vertex.clear();
  tile.neighbour.clear();
  tile.image.clear();
  tile.across.clear();
  if (d_.ring_begin[site] == d_.ring_end[site]) return;
  if (!make_uncut(site, tile)) make_cut(site, tile);
  place(tile);
}

/// The plain case: all corners inside the box. Leaves the tile as it is when they are not.
bool TileMaker::make_uncut(Index site, Tile& tile) {
  const Index begin = d_.ring_begin[site], end = d_.ring_end[site];
  for (Index k = begin; k < end; ++k)
    if (d_.ring_vertex[k] < 0 || id_[plane_.vertex_copy(d_.ring_vertex[k]).of] == kOutside) return false;
  for (Index k = begin; k < end; ++k) {
    const Copy corner = plane_.vertex_copy(d_.ring_vertex[k]), neighbour = plane_.site_copy(d_.ring_site[k]);
    tile.vertex.push_back(vertex(corner.of));
    tile.neighbour.push_back(neighbour.of);
    if (!periodic_) continue;
    tile.image.push_back(corner.image);
    tile.across.push_back(neighbour.image);
  }
  return true;
}

void TileMaker::make_cut(Index site, Tile& tile) {
  chain_.clear();
  for (Index k = d_.ring_begin[site]; k < d_.ring_end[site]; ++k) {
    const Cut cut = cut_edge(site, k);
    if (!cut.empty) chain_.push_back({cut.begin, cut.end, plane_.site_copy(d_.ring_site[k])});
  }
  const auto add = [&](const EdgeEnd& corner, const Copy& neighbour) {
    tile.vertex.push_back(corner.vertex);
    tile.neighbour.push_back(neighbour.of);
    if (!periodic_) return;
    tile.image.push_back(corner.image);
    tile.across.push_back(neighbour.image);
  };
  const auto gaps = static_cast<std::size_t>(
      std::count_if(chain_.begin(), chain_.end(), [](const Side& side) { return side.end.side >= 0; }));
  for (std::size_t k = 0; k < chain_.size(); ++k) {
    const Side& here = chain_[k];
    const Side& next = chain_[(k + 1) % chain_.size()];
    add(here.begin, here.neighbour);
    if (here.end.side < 0) {
      assert(here.end.vertex == next.begin.vertex);
      continue;
    }
    add(here.end, {kSides[here.end.side], {0, 0}});
    add_boundary(tile, here.end.side, corners_between(site, here.end, next.begin, gaps));
  }
}

/// Where the site was given, rather than where it lies in the box.
void TileMaker::place(Tile& tile) const {
  if (plane_.wrapped.empty()) return;
  const Image& here = plane_.wrapped[tile.site];
  for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
    tile.image[k] = sum(tile.image[k], here);
    if (tile.neighbour[k] >= 0)
      tile.across[k] = sum(tile.across[k], sum(here, minus(plane_.wrapped[tile.neighbour[k]])));
  }
}

/// Seen from the site. Both tiles of an edge must get the same: it is cut as seen from the one of lower index.
TileMaker::Cut TileMaker::cut_edge(Index site, Index k) {
  const Copy other = plane_.site_copy(d_.ring_site[k]);
  const bool from_here = site < other.of || (site == other.of && other.image > Image{0, 0});
  const Image frame = from_here ? Image{0, 0} : other.image;  // of the lower one, as seen from the site
  const Index low = from_here ? site : other.of, high = from_here ? other.of : site;
  const Image across = from_here ? other.image : minus(other.image);
  const auto in_frame = [&](Index v) {
    if (v < 0) return Copy{-1, {0, 0}};
    const Copy c = plane_.vertex_copy(v);
    return Copy{c.of, sum(c.image, minus(frame))};
  };
  const auto [place, is_new] = cuts_.try_emplace(Key{low, high, (across[0] + 1) * 4 + across[1] + 1});
  if (is_new) {
    Copy begin = in_frame(d_.ring_vertex[k]), end = in_frame(d_.ring_vertex[d_.next(site, k)]);
    if (!from_here) std::swap(begin, end);
    PowerSite b = plane_.site[high];
    b.centre += displacement(across, plane_.box);
    place->second = cut_edge(plane_.site[low], b, begin, end);
  }
  Cut cut = place->second;
  cut.begin.image = sum(cut.begin.image, frame);
  cut.end.image = sum(cut.end.image, frame);
  if (!from_here) std::swap(cut.begin, cut.end);
  return cut;
}

/// What the box leaves of the edge between a and b, a on its left, from `begin` to `end`; a vertex of -1 is at infinity.
TileMaker::Cut TileMaker::cut_edge(const PowerSite& a, const PowerSite& b, const Copy& begin, const Copy& end) {
  const auto inside = [&](const Copy& v) { return v.of >= 0 && id_[v.of] != kOutside; };
  const auto inner_end = [&](const Copy& v) { return EdgeEnd{vertex(v.of), v.image}; };
  const bool begin_inside = inside(begin), end_inside = inside(end);
  if (begin_inside && end_inside) return {false, inner_end(begin), inner_end(end)};
  Axis axis(a, b, plane_.box, plane_.periodic);
  if (axis.enter_side < 0) {
    // Along the two sides there are. Inside, and yet with an end outside: by rounding, and then that end is on a side.
    if (!begin_inside && !end_inside) return {};
    const bool upper =
        axis.foot[plane_.periodic[0] ? 1 : 0] > (plane_.box.lo + plane_.box.hi)[plane_.periodic[0] ? 1 : 0] / 2;
    axis.enter_side = axis.leave_side = plane_.periodic[0] ? (upper ? 2 : 0) : (upper ? 1 : 3);
    axis.enter = begin.of < 0 ? 0 : axis.parameter(position(begin));
    axis.leave = end.of < 0 ? 0 : axis.parameter(position(end));
    return begin_inside ? Cut{false, inner_end(begin), crossing(axis, true)}
                        : Cut{false, crossing(axis, false), inner_end(end)};
  }
  // A vertex outside the box lies before the entry or behind the exit; compared with the middle, rounding cannot confuse the two.
  const bool begin_before = begin.of < 0 || axis.parameter(position(begin)) < axis.middle();
  const bool end_behind = end.of < 0 || axis.parameter(position(end)) > axis.middle();
  if (begin_inside) return {false, inner_end(begin), crossing(axis, end_behind)};
  if (end_inside) return {false, crossing(axis, !begin_before), inner_end(end)};
  if (axis.beside || !(axis.enter < axis.leave) || !begin_before || !end_behind) return {};
  const EdgeEnd first = crossing(axis, false);
  return {false, first, crossing(axis, true)};
}

TileMaker::EdgeEnd TileMaker::crossing(const Axis& axis, bool at_exit) {
  const int side = at_exit ? axis.leave_side : axis.enter_side;
  Vec2 p = axis.foot + (at_exit ? axis.leave : axis.enter) * axis.t;
  for (const int k : {0, 1})
    if (!plane_.periodic[k]) p[k] = std::clamp(p[k], plane_.box.lo[k], plane_.box.hi[k]);
  if (side == 1 || side == 3)
    p.x() = side == 1 ? plane_.box.hi.x() : plane_.box.lo.x();
  else
    p.y() = side == 2 ? plane_.box.hi.y() : plane_.box.lo.y();
  return {add_vertex(p), {0, 0}, side};
}

Index TileMaker::vertex(Index v) {
  if (id_[v] == kUnused) id_[v] = add_vertex(d_.vertices[v]);
  return id_[v];
}

Vec2 TileMaker::position(const Copy& vertex) const {
  return d_.vertices[vertex.of] + displacement(vertex.image, plane_.box);
}

Index TileMaker::add_vertex(const Vec2& p) {
  vertices_.push_back(p + plane_.origin);
  return static_cast<Index>(vertices_.size()) - 1;
}

Vec2 TileMaker::corner_position(int q) const {
  const Box& box = plane_.box;
  return {q < 2 ? box.hi.x() : box.lo.x(), q == 0 || q == 3 ? box.lo.y() : box.hi.y()};
}

/// The next `count` corners after `side`, each followed by the side behind it.
void TileMaker::add_boundary(Tile& tile, int side, int count) {
  for (int q = side; q < side + count; ++q) {
    Index& corner = corner_[q % 4];
    if (corner < 0) corner = add_vertex(corner_position(q % 4));
    tile.vertex.push_back(corner);
    tile.neighbour.push_back(kSides[(q + 1) % 4]);
  }
}

/// Corners of the box on the way along its boundary from where the tile's walls leave the box to where they come back.
/// Counting sides alone cannot tell none from all four, nor, when both ends agree with a corner up to rounding, -1
/// from three. Then the far corners decide, and if the tile touches the boundary in `gaps` > 1 pieces, the distance.
int TileMaker::corners_between(Index site, const EdgeEnd& from, const EdgeEnd& to, std::size_t gaps) const {
  if (periodic_) return 0;  // the site's own images keep its tile from going round
  const int count = (to.side - from.side + 4) % 4;
  if (count != 0 && count != 3) return count;
  const Vec2 first = corner_position(from.side), second = corner_position((from.side + 1) % 4),
             third = corner_position((from.side + 2) % 4);
  if (!owns(site, second) || (count == 0 && !owns(site, third))) return 0;
  const Vec2 way = vertices_[to.vertex] - vertices_[from.vertex];
  const Vec2 along = -left_of(second - first).normalized();  // of the side `from`: the next one turned back
  const double tolerance = 1e-12 * plane_.box.size().maxCoeff();
  if (count == 0) return gaps == 1 || way.dot(along) < -tolerance ? 4 : 0;
  return gaps == 1 || way.norm() > tolerance ? 3 : 0;
}

bool TileMaker::make_whole_box(Tile& tile) {
  for (const Index site : d_.order) {
    if (!owns(site, (plane_.box.lo + plane_.box.hi) / 2)) continue;
    tile = {.site = site, .vertex = {}, .neighbour = {}, .image = {}, .across = {}};
    add_boundary(tile, 0, 4);
    return true;
  }
  return false;
}

bool TileMaker::owns(Index site, const Vec2& p) const {
  for (Index k = d_.ring_begin[site]; k < d_.ring_end[site]; ++k)
    if (power(d_.ring_site[k], p) < power(site, p)) return false;
  return true;
}

double TileMaker::power(Index site, const Vec2& p) const {
  return (p - plane_.site[site].centre).squaredNorm() - plane_.site[site].weight;
}

}  // namespace lamella
