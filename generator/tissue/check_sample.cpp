// The invariants of a sample. Shares nothing with the code that makes samples.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "generator/generate.h"
#include "generator/tissue/crossings.h"

namespace lamella {
namespace {

constexpr std::size_t kMost = 20;  // violations of one kind that are listed

class Violations {
 public:
  template <class... T>
  void add(fmt::format_string<T...> format, T&&... values) {
    if (list_.size() < kMost) list_.push_back(fmt::format(format, std::forward<T>(values)...));
    ++count_;
  }
  void append_to(std::vector<std::string>& all) const {
    all.insert(all.end(), list_.begin(), list_.end());
    if (count_ > list_.size()) all.push_back(fmt::format("... and {} more like it", count_ - list_.size()));
  }
  bool any() const { return count_ > 0; }

 private:
  std::vector<std::string> list_;
  std::size_t count_ = 0;
};

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
    bad.add("{} links have images, of {}; all have in a periodic sample, none in another", s.link_image.size(),
            s.links.size());
  if (s.closed.size() != cells || s.group.size() != cells || s.radius.size() != cells || s.rest_area.size() != cells ||
      s.tile_area.size() != cells)
    bad.add("an array per cell does not have {} entries", cells);
  bad.append_to(all);
  return !bad.any();
}

void check_cells(const Sample& s, std::vector<std::string>& all) {
  Violations bad;
  double tiles = 0;
  for (Index c = 0; c < s.cells(); ++c) {
    const Index begin = s.cell_begin[c];
    if (s.group[c] < 0 || s.group[c] >= static_cast<Index>(s.group_names.size()))
      bad.add("cell {}: group {} does not exist", c, s.group[c]);
    if (!(std::isfinite(s.radius[c]) && s.radius[c] >= 0)) bad.add("cell {}: radius {}", c, s.radius[c]);
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
    if (!(s.tile_area[c] >= s.rest_area[c] * (1 - 1e-9)))
      bad.add("cell {}: its tile {} m2 is smaller than its rest area {} m2", c, s.tile_area[c], s.rest_area[c]);
    // A shape beside a tissue has an area of its own; it takes none of the box.
    Vec2 mean = Vec2::Zero();
    for (Index k = begin; k < s.cell_begin[c + 1]; ++k) mean += s.x[k] / s.cell_size(c);
    for (int axis = 0; axis < 2; ++axis)
      if (s.periodic[axis]) mean[axis] = s.box.lo[axis];  // some image of it lies in the box
    if (s.box.contains(mean)) tiles += s.tile_area[c];
  }
  if (tiles > s.box.area() * (1 + 1e-9))
    bad.add("the tiles have {} m2 together, more than the box with {} m2", tiles, s.box.area());
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

void check_links(const Sample& s, std::vector<std::string>& all) {
  Violations bad;
  const auto cell = cell_of_node(s);
  const auto exists = [&](Index k) { return k >= 0 && k < s.nodes(); };
  std::set<std::tuple<Index, Index, Image>> seen;
  Index wall = 0;
  for (std::size_t l = 0; l < s.links.size(); ++l) {
    const Link& link = s.links[l];
    if (!exists(link.a) || !exists(link.b) || !exists(link.a_prev) || !exists(link.a_next) || !exists(link.b_prev) ||
        !exists(link.b_next) || link.wall < 0 || link.wall >= static_cast<Index>(s.walls.size())) {
      bad.add("link {}: names a node or wall that does not exist", l);
      continue;
    }
    const Wall& of = s.walls[link.wall];
    if (link.wall < wall) bad.add("link {}: links are not sorted by wall", l);
    wall = link.wall;
    const Image image = s.link_image.empty() ? Image{0, 0} : s.link_image[l];
    const bool ordered = of.cell_a < of.cell_b || (of.cell_a == of.cell_b && image != Image{0, 0});
    if (cell[link.a] != of.cell_a || cell[link.b] != of.cell_b || !ordered)
      bad.add("link {}: joins cells {} and {}, its wall is between {} and {}", l, cell[link.a], cell[link.b], of.cell_a,
              of.cell_b);
    if (cell[link.a_prev] != cell[link.a] || cell[link.a_next] != cell[link.a] || cell[link.b_prev] != cell[link.b] ||
        cell[link.b_next] != cell[link.b])
      bad.add("link {}: its tangent leaves its cells", l);
    if ((image[0] != 0 && !s.periodic[0]) || (image[1] != 0 && !s.periodic[1]) ||
        std::max(std::abs(image[0]), std::abs(image[1])) > kFarthestImage)
      bad.add("link {}: displaced by ({}, {}) boxes", l, image[0], image[1]);
    if (l > 0 && s.links[l - 1].wall == link.wall && !s.link_image.empty() && s.link_image[l - 1] != image)
      bad.add("link {}: its image is not that of the link before, on the same wall", l);
    if (!seen.emplace(link.a, link.b, image).second)
      bad.add("link {}: a second link between nodes {} and {}", l, link.a, link.b);
    if (!(link.length > 0 && std::isfinite(link.length) && link.spacing > 0 && std::isfinite(link.spacing)))
      bad.add("link {}: tributary length {} m, spacing {} m", l, link.length, link.spacing);
    const Vec2 tau = (s.x[link.a_next] - s.x[link.a_prev]) - (s.x[link.b_next] - s.x[link.b_prev]);
    if (!(tau.norm() > 0)) {
      bad.add("link {}: its tangent has no direction", l);
      continue;
    }
    const Vec2 t = tau.normalized();
    const Vec2 across = s.x[link.b] + link_displacement(s, l) - s.x[link.a];
    if (!(across.dot(right_of(t)) > 0)) bad.add("link {}: its normal does not point from a to b", l);
    const Vec2 off(across.dot(right_of(t)) - link.offset_n, across.dot(t) - link.offset_t);
    if (!(off.norm() <= 1e-9 * (across.norm() + link.spacing)))
      bad.add("link {}: not free of force where it is (off by {} m)", l, off.norm());
  }
  bad.append_to(all);
}

/// The shell of a cell, displaced, as segments of which each knows its neighbours.
void add_segments(const Sample& s, Index c, const Vec2& off, std::vector<OwnedSegment>& segments) {
  const Index begin = s.cell_begin[c], count = s.segments(c);
  const auto first = static_cast<int>(segments.size());
  const bool closed = s.closed[c] != 0;
  for (Index k = 0; k < count; ++k) {
    const int before = k > 0 ? first + k - 1 : closed ? first + count - 1 : -1;
    const int after = k + 1 < count ? first + k + 1 : closed ? first : -1;
    segments.push_back({s.x[begin + k] + off, s.x[s.next(c, begin + k)] + off, c, before, after});
  }
}

/// Images of all cells that reach into the rectangle around the cells where they are: a periodic sample's neighbours.
void add_images(const Sample& s, std::vector<OwnedSegment>& segments) {
  std::vector<Box> around;
  Box all{s.x.front(), s.x.front()};
  for (Index c = 0; c < s.cells(); ++c) {
    Box own{s.x[s.cell_begin[c]], s.x[s.cell_begin[c]]};
    for (Index k = s.cell_begin[c]; k < s.cell_begin[c + 1]; ++k)
      own.lo = own.lo.cwiseMin(s.x[k]), own.hi = own.hi.cwiseMax(s.x[k]);
    all.lo = all.lo.cwiseMin(own.lo), all.hi = all.hi.cwiseMax(own.hi);
    around.push_back(own);
  }
  const Vec2 period = s.box.size();
  const auto farthest = [&](int axis) {
    const double reach = (all.hi[axis] - all.lo[axis]) / period[axis];
    return s.periodic[axis] ? static_cast<int>(std::min(reach, 1.0 * kFarthestImage)) : 0;
  };
  for (int j = -farthest(1); j <= farthest(1); ++j)
    for (int i = -farthest(0); i <= farthest(0); ++i)
      for (Index c = 0; c < s.cells() && (i != 0 || j != 0); ++c) {
        const Vec2 off(i * period.x(), j * period.y());
        const Vec2 lo = around[c].lo + off, hi = around[c].hi + off;
        if ((lo.array() < all.hi.array()).all() && (hi.array() > all.lo.array()).all())
          add_segments(s, c, off, segments);
      }
}

void check_crossings(const Sample& s, std::vector<std::string>& all) {
  Violations bad;
  std::vector<OwnedSegment> segments;
  for (Index c = 0; c < s.cells(); ++c) add_segments(s, c, Vec2(0, 0), segments);
  if (is_periodic(s) && !s.x.empty()) add_images(s, segments);
  for (const Crossing& crossing : find_crossings(segments)) {
    const OwnedSegment& a = segments[crossing.first];
    const OwnedSegment& b = segments[crossing.second];
    if (a.owner == b.owner)
      bad.add("cell {} crosses itself near ({:g}, {:g})", a.owner, a.from.x(), a.from.y());
    else
      bad.add("cells {} and {} cross near ({:g}, {:g})", a.owner, b.owner, b.from.x(), b.from.y());
  }
  bad.append_to(all);
}

}  // namespace

std::vector<std::string> check_sample(const Sample& sample) {
  std::vector<std::string> all;
  if (!check_shapes_of_arrays(sample, all)) return all;
  check_cells(sample, all);
  check_nodes(sample, all);
  check_links(sample, all);
  if (all.empty()) check_crossings(sample, all);
  return all;
}

}  // namespace lamella
