#include "generator/packing/plane_diagram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace lamella {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Image operator-(const Image& a, const Image& b) {
  return {static_cast<std::int8_t>(a[0] - b[0]), static_cast<std::int8_t>(a[1] - b[1])};
}

/// Wraps the sites into the box and rounds them to a grid on which displacements by its lengths are exact.
void wrap(PlaneDiagram& plane, const Box& box) {
  Vec2 length = box.size();
  plane.box = box;
  plane.wrapped.assign(plane.site.size(), {0, 0});
  for (const int axis : {0, 1}) {
    if (!plane.periodic[axis]) continue;
    int exponent;  // length < 2^exponent: coordinates from -length to 2 length are whole numbers of 53 bits on the grid
    std::frexp(length[axis], &exponent);
    const double grid = std::ldexp(1.0, exponent - 51);
    length[axis] = std::nearbyint(length[axis] / grid) * grid;
    plane.origin[axis] = box.lo[axis];
    for (std::size_t i = 0; i < plane.site.size(); ++i) {
      double& x = plane.site[i].centre[axis];
      x -= box.lo[axis];
      const double times = std::floor(x / length[axis]);
      x = std::nearbyint((x - times * length[axis]) / grid) * grid;
      int wrapped = static_cast<int>(times);
      if (x >= length[axis]) x -= length[axis], ++wrapped;
      if (x < 0) x += length[axis], --wrapped;  // the quotient rounded up
      plane.wrapped[i][axis] = static_cast<std::int8_t>(wrapped);
    }
    plane.box.lo[axis] = 0;
    plane.box.hi[axis] = length[axis];
  }
  const auto inside = [](const Image& image) { return image[0] == 0 && image[1] == 0; };
  if (std::all_of(plane.wrapped.begin(), plane.wrapped.end(), inside)) plane.wrapped = {};
}

/// Copies within reach of a rectangle about the box, and the check that they are enough.
class Surroundings {
 public:
  /// rho: see plane_diagram.
  Surroundings(PlaneDiagram& plane, double rho) : plane_(plane), rho_(rho) {
    const Vec2 length = plane.box.size();
    slack_ = 1e-9 * length.maxCoeff();
    // A corner whose power is at most rho lies within sqrt(rho + w) of its site.
    for (const int axis : {0, 1}) {
      for (Index i = 0; i < plane.sites && plane.periodic[axis]; ++i) {
        const double x = plane.site[i].centre[axis], depth = std::min(x, length[axis] - x);
        overhang_[axis] = std::max(overhang_[axis], reach(plane.site[i]) - depth);
      }
    }
  }

  void add_copies() {
    plane_.site.resize(plane_.sites);
    plane_.copy.clear();
    const int columns = plane_.periodic[0] ? 1 : 0, rows = plane_.periodic[1] ? 1 : 0;
    for (Index i = 0; i < plane_.sites; ++i) {
      const double distance = reach(plane_.site[i]) + slack_;
      for (int row = -rows; row <= rows; ++row) {
        for (int column = -columns; column <= columns; ++column) {
          const Image image{static_cast<std::int8_t>(column), static_cast<std::int8_t>(row)};
          PowerSite copied = plane_.site[i];
          copied.centre += displacement(image, plane_.box);
          if ((row == 0 && column == 0) || !(outside(copied.centre).norm() <= distance)) continue;
          plane_.site.push_back(copied);
          plane_.copy.push_back({i, image});
        }
      }
    }
  }

  /// The rho that the cells found would need; infinite when one of them is not bounded.
  double needed() const {
    if (rho_ == kInfinity) return rho_;
    const PowerDiagram& d = plane_.diagram;
    double most = -kInfinity;
    for (const Index site : d.order)
      for (Index k = d.ring_begin[site]; k < d.ring_end[site]; ++k) most = std::max(most, needed(site, k));
    return most;
  }

 private:
  double reach(const PowerSite& site) const { return std::sqrt(std::max(0.0, rho_ + site.weight)); }

  /// From the rectangle to a point outside it.
  Vec2 outside(const Vec2& p) const {
    Vec2 way = Vec2::Zero();
    for (const int axis : {0, 1})
      if (plane_.periodic[axis])
        way[axis] = std::max({0.0, -overhang_[axis] - p[axis], p[axis] - plane_.box.hi[axis] - overhang_[axis]});
    return way;
  }

  double depth(const Vec2& p) const {
    double least = kInfinity;
    for (const int axis : {0, 1})
      if (plane_.periodic[axis])
        least = std::min({least, p[axis] + overhang_[axis], plane_.box.hi[axis] + overhang_[axis] - p[axis]});
    return std::max(0.0, least);
  }

  double needed(Index site, const Vec2& corner) const {
    const double inside = depth(corner);
    return (corner - plane_.site[site].centre).squaredNorm() - plane_.site[site].weight - inside * inside;
  }

  /// At the ends of what the box, where it is not periodic, leaves of an edge.
  double needed(Index site, Index k) const {
    const PowerDiagram& d = plane_.diagram;
    const Index begin = d.ring_vertex[k], end = d.ring_vertex[d.next(site, k)];
    if (plane_.periodic[0] && plane_.periodic[1]) return begin < 0 ? kInfinity : needed(site, d.vertices[begin]);
    const int axis = plane_.periodic[0] ? 1 : 0;
    const double lo = plane_.box.lo[axis], hi = plane_.box.hi[axis];
    const auto within = [&](Index v) { return v >= 0 && d.vertices[v][axis] >= lo && d.vertices[v][axis] <= hi; };
    double most = within(begin) ? needed(site, d.vertices[begin]) : -kInfinity;
    if (within(begin) && within(end)) return most;
    const PowerSite &a = plane_.site[site], &b = plane_.site[d.ring_site[k]];
    const Vec2 way = b.centre - a.centre, along = left_of(way);
    const Vec2 foot = a.centre + way * (0.5 + (a.weight - b.weight) / (2 * way.squaredNorm()));
    const auto parameter = [&](Index v) { return (d.vertices[v] - foot).dot(along) / along.squaredNorm(); };
    double from = begin < 0 ? -kInfinity : parameter(begin), to = end < 0 ? kInfinity : parameter(end);
    if (along[axis] != 0) {
      const double s = (lo - foot[axis]) / along[axis], t = (hi - foot[axis]) / along[axis];
      from = std::max(from, std::min(s, t)), to = std::min(to, std::max(s, t));
    } else if (foot[axis] < lo || foot[axis] > hi) {
      return most;
    }
    if (from > to) return most;
    if (!std::isfinite(from) || !std::isfinite(to)) return kInfinity;
    return std::max({most, needed(site, foot + from * along), needed(site, foot + to * along)});
  }

  PlaneDiagram& plane_;
  double rho_;
  double slack_ = 0;  // for the rounding of all this [m]
  Vec2 overhang_ = Vec2::Zero();
};

/// Twice the square of the largest void among as many points placed at random, which a packing never has.
double first_guess(const PlaneDiagram& plane) {
  if (plane.sites < 64) return kInfinity;
  const double n = plane.sites;
  return plane.box.area() / n * (std::log(n) + 8) / std::numbers::pi;
}

double mean_weight(const PlaneDiagram& plane) {
  double mean = 0;
  for (const PowerSite& site : plane.site) mean += site.weight / plane.sites;
  return mean;
}

/// Which vertices are images of each other: those whose sites are images of each other. The one that stands for them has a
/// site of the box as its site of lowest index and, where that one occurs more than once, as its last.
class Vertices {
 public:
  explicit Vertices(PlaneDiagram& plane) : plane_(plane), d_(plane.diagram) {}

  void find_canonical() {
    plane_.canonical.resize(d_.vertices.size());
    std::vector<Entry> entries;
    for (Index v = 0; v < static_cast<Index>(d_.vertices.size()); ++v) {
      plane_.canonical[v] = {v, {0, 0}};
      if (d_.member_begin[v] == d_.member_begin[v + 1]) continue;
      sort_members(v);
      const Image image = owner(v).image;
      entries.push_back({key(v, image), v, image});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
    for (auto first = entries.begin(); first != entries.end();) {
      const auto last = std::find_if(first, entries.end(), [&](const Entry& e) { return e.key != first->key; });
      for (auto e = first; e != last; ++e) {
        if (e->image == Image{0, 0}) continue;
        const auto found = std::find_if(first, last, [&](const Entry& c) {
          return c.image == Image{0, 0} && same(*e, c);
        });
        if (found == last && outside(e->vertex)) continue;
        if (found == last)
          throw std::logic_error("a vertex of a periodic power diagram has no image at its first site");
        plane_.canonical[e->vertex] = {found->vertex, e->image};
      }
      first = last;
    }
  }

 private:
  struct Entry {
    std::uint64_t key;
    Index vertex;
    Image image;  // of the owner
  };

  /// Beyond a side of the box, where nobody asks for it and cells need not be those of the plane.
  bool outside(Index v) const {
    for (const int axis : {0, 1})
      if (!plane_.periodic[axis] &&
          !(d_.vertices[v][axis] >= plane_.box.lo[axis] && d_.vertices[v][axis] <= plane_.box.hi[axis]))
        return true;
    return false;
  }

  Copy member(Index k) const { return plane_.site_copy(d_.member[k]); }

  void sort_members(Index v) {
    std::sort(d_.member.begin() + d_.member_begin[v], d_.member.begin() + d_.member_begin[v + 1],
              [&](Index a, Index b) {
                const Copy s = plane_.site_copy(a), t = plane_.site_copy(b);
                return std::pair(s.of, s.image) < std::pair(t.of, t.image);
              });
  }

  Copy owner(Index v) const {
    Index k = d_.member_begin[v];
    while (k + 1 < d_.member_begin[v + 1] && member(k + 1).of == member(k).of) ++k;
    return member(k);
  }

  /// A hash of the members, all displaced by -image.
  std::uint64_t key(Index v, const Image& image) const {
    std::uint64_t h = 0;
    for (Index k = d_.member_begin[v]; k < d_.member_begin[v + 1]; ++k) {
      const Copy m = member(k);
      const Image at = m.image - image;
      h = (h ^ (static_cast<std::uint64_t>(m.of) << 16 | static_cast<std::uint8_t>(at[0]) << 8 |
                static_cast<std::uint8_t>(at[1]))) *
          0x9e3779b97f4a7c15u;
      h ^= h >> 29;
    }
    return h;
  }

  bool same(const Entry& a, const Entry& b) const {
    const Index count = d_.member_begin[a.vertex + 1] - d_.member_begin[a.vertex];
    if (count != d_.member_begin[b.vertex + 1] - d_.member_begin[b.vertex]) return false;
    for (Index k = 0; k < count; ++k) {
      const Copy s = member(d_.member_begin[a.vertex] + k), t = member(d_.member_begin[b.vertex] + k);
      if (s.of != t.of || s.image - a.image != t.image - b.image) return false;
    }
    return true;
  }

  PlaneDiagram& plane_;
  PowerDiagram& d_;
};

}  // namespace

PlaneDiagram plane_diagram(std::vector<PowerSite> sites, const Box& box, Periodic periodic, double* reach) {
  PlaneDiagram plane;
  plane.sites = static_cast<Index>(sites.size());
  plane.site = std::move(sites);
  plane.periodic = periodic;
  plane.box = box;
  if (!periodic[0] && !periodic[1]) {
    plane.diagram = power_diagram(plane.site, plane.sites);
    return plane;
  }
  wrap(plane, box);
  const double mean = mean_weight(plane);  // a common shift of all weights shifts all powers the other way
  double rho = (reach && *reach != 0 ? *reach : first_guess(plane)) - mean;
  for (int attempt = 0;; ++attempt) {
    Surroundings surroundings(plane, rho);
    surroundings.add_copies();
    plane.diagram = power_diagram(plane.site, plane.sites);
    const double needed = surroundings.needed();
    if (needed <= rho) {
      // Copies are few, and a second diagram costs as much as the first: with some room for what will change.
      if (reach && rho < kInfinity) *reach = rho + mean + (attempt == 0 ? 0 : 0.25 * plane.box.area() / plane.sites);
      break;
    }
    rho = attempt < 3 ? needed + 1e-6 * plane.box.area() / plane.sites : kInfinity;  // beyond the rounding
  }
  Vertices(plane).find_canonical();
  return plane;
}

}  // namespace lamella
