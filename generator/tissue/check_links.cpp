// The invariants of walls, of the links between them, and of outlines that must not cross.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "generator/tissue/crossings.h"
#include "generator/tissue/violations.h"

namespace lamella {
namespace {

void check_walls(const Sample& s, std::vector<std::string>& all) {
  Violations bad;
  for (std::size_t w = 0; w < s.walls.size(); ++w) {
    const Wall& wall = s.walls[w];
    // Of a periodic sample a cell may meet its own image.
    const bool ordered = wall.cell_a < wall.cell_b || (!s.link_image.empty() && wall.cell_a == wall.cell_b);
    if (wall.cell_a < 0 || wall.cell_b >= s.cells() || !ordered)
      bad.add("wall {}: is between cells {} and {}; a wall has two sides, the lower first", w, wall.cell_a,
              wall.cell_b);
    if (!(std::isfinite(wall.length) && wall.length >= 0)) bad.add("wall {}: length {} m", w, wall.length);
  }
  bad.append_to(all);
}

bool names_what_exists(const Sample& s, const Link& link) {
  for (const Index k : {link.a, link.b, link.a_prev, link.a_next, link.b_prev, link.b_next})
    if (k < 0 || k >= s.nodes()) return false;
  return link.wall >= 0 && link.wall < static_cast<Index>(s.walls.size());
}

/// Its frame and its rest: that it is free of force where it is.
void check_place(const Sample& s, std::size_t l, Violations& bad) {
  const Link& link = s.links[l];
  const Vec2 tau = (s.x[link.a_next] - s.x[link.a_prev]) - (s.x[link.b_next] - s.x[link.b_prev]);
  const double length = tau.norm();
  if (!(length > 0)) {
    bad.add("link {}: its tangent has no direction", l);
    return;
  }
  const Vec2 t = tau / length;
  Vec2 across = s.x[link.b] - s.x[link.a];
  if (!s.link_image.empty()) across += displacement(s.link_image[l], s.box);
  if (!(across.dot(right_of(t)) > 0)) bad.add("link {}: its normal does not point from a to b", l);
  const Vec2 off(across.dot(right_of(t)) - link.offset_n, across.dot(t) - link.offset_t);
  if (!(off.norm() <= 1e-9 * (across.norm() + link.spacing)))
    bad.add("link {}: not free of force where it is (off by {} m)", l, off.norm());
}

void check_extras(const Sample& s, std::size_t l, Violations& bad) {
  if (!s.link_image.empty()) {
    const Image image = s.link_image[l];
    for (const int axis : {0, 1}) {
      if (image[axis] != 0 && !s.periodic[axis])
        bad.add("link {}: reaches an image along {}, where nothing repeats", l, axis == 0 ? "x" : "y");
      if (std::abs(image[axis]) > kFarthestImage) bad.add("link {}: displaced by {} boxes", l, image[axis]);
    }
    if (l > 0 && s.links[l - 1].wall == s.links[l].wall && s.link_image[l - 1] != image)
      bad.add("link {}: its image is not that of the link before, on the same wall", l);
    const Wall& wall = s.walls[s.links[l].wall];
    if (wall.cell_a == wall.cell_b && image == Image{0, 0}) bad.add("link {}: joins a cell to itself", l);
  }
  if (!s.link_strength.empty() && !(std::isfinite(s.link_strength[l]) && s.link_strength[l] > 0))
    bad.add("link {}: a factor {} on its strength", l, s.link_strength[l]);
}

/// Two links between the same nodes, by sorting all pairs.
void check_pairs(const Sample& s, Violations& bad) {
  std::vector<std::array<std::int64_t, 2>> pairs;
  pairs.reserve(s.links.size());
  for (std::size_t l = 0; l < s.links.size(); ++l)
    pairs.push_back({std::int64_t{s.links[l].a} << 32 | s.links[l].b, static_cast<std::int64_t>(l)});
  std::sort(pairs.begin(), pairs.end());
  for (std::size_t k = 1; k < pairs.size(); ++k) {
    if (pairs[k][0] != pairs[k - 1][0]) continue;
    const auto l = static_cast<std::size_t>(pairs[k][1]);
    if (!s.link_image.empty() && s.link_image[l] != s.link_image[pairs[k - 1][1]]) continue;
    bad.add("link {}: a second link between nodes {} and {}", l, s.links[l].a, s.links[l].b);
  }
}

/// Tributary lengths share out what of a wall is linked: no more than there is.
void check_lengths(const Sample& s, const std::vector<double>& linked, Violations& bad) {
  for (std::size_t w = 0; w < s.walls.size(); ++w)
    if (linked[w] > s.walls[w].length * (1 + 1e-9))
      bad.add("wall {}: its links stand for {} m, more than its length {} m", w, linked[w], s.walls[w].length);
}

}  // namespace

void check_walls_and_links(const Sample& s, std::vector<std::string>& all) {
  check_walls(s, all);
  Violations bad;
  const auto cell = cell_of_node(s);
  std::vector<double> linked(s.walls.size(), 0);
  Index wall = 0;
  for (std::size_t l = 0; l < s.links.size(); ++l) {
    const Link& link = s.links[l];
    if (!names_what_exists(s, link)) {
      bad.add("link {}: names a node or wall that does not exist", l);
      continue;
    }
    const Wall& of = s.walls[link.wall];
    if (link.wall < wall) bad.add("link {}: links are not sorted by wall", l);
    wall = link.wall;
    if (cell[link.a] != of.cell_a || cell[link.b] != of.cell_b)
      bad.add("link {}: joins cells {} and {}, its wall is between {} and {}", l, cell[link.a], cell[link.b], of.cell_a,
              of.cell_b);
    if (cell[link.a_prev] != cell[link.a] || cell[link.a_next] != cell[link.a] || cell[link.b_prev] != cell[link.b] ||
        cell[link.b_next] != cell[link.b])
      bad.add("link {}: its tangent leaves its cells", l);
    if (!(link.length > 0 && std::isfinite(link.length) && link.spacing > 0 && std::isfinite(link.spacing)))
      bad.add("link {}: tributary length {} m, spacing {} m", l, link.length, link.spacing);
    linked[link.wall] += link.length;
    check_place(s, l, bad);
    check_extras(s, l, bad);
  }
  check_pairs(s, bad);
  check_lengths(s, linked, bad);
  bad.append_to(all);
}

namespace {

/// All segments of the sample, and of a periodic one copies of those that reach over its sides, each with the place of the
/// segment that it copies.
struct Segments {
  std::vector<OwnedSegment> all;
  std::size_t own = 0;  // the first ones; the rest are copies
};

Segments segments_of(const Sample& s) {
  Segments segments;
  segments.all.reserve(s.x.size());
  for (Index c = 0; c < s.cells(); ++c) {
    const auto first = static_cast<int>(segments.all.size());
    const int count = s.segments(c);
    for (int k = 0; k < count; ++k) {
      const Index node = s.cell_begin[c] + k;
      const int before = k > 0 ? first + k - 1 : s.closed[c] ? first + count - 1 : -1;
      const int after = k + 1 < count ? first + k + 1 : s.closed[c] ? first : -1;
      segments.all.push_back({s.x[node], s.x[s.next(c, node)], c, before, after});
    }
  }
  segments.own = segments.all.size();
  return segments;
}

/// Displacements that can bring one cell near another; half of them, as of two images one is the other's copy.
std::vector<Image> displacements(const Sample& s, const Box& around) {
  const auto farthest = [&](int axis) {
    const double reach = (around.hi[axis] - around.lo[axis]) / s.box.size()[axis];
    return s.periodic[axis] ? static_cast<int>(std::min(reach, 1.0 * kFarthestImage)) : 0;
  };
  std::vector<Image> images;
  const int most_x = farthest(0), most_y = farthest(1);
  for (int j = 0; j <= most_y; ++j)
    for (int i = j == 0 ? 1 : -most_x; i <= most_x; ++i)
      images.push_back({static_cast<std::int8_t>(i), static_cast<std::int8_t>(j)});
  return images;
}

void add_copies(const Sample& s, Segments& segments) {
  Box around{segments.all[0].from, segments.all[0].from};
  for (const OwnedSegment& segment : segments.all) {
    around.lo = around.lo.cwiseMin(segment.from);
    around.hi = around.hi.cwiseMax(segment.from);
  }
  for (const Image image : displacements(s, around)) {
    const Vec2 shift = displacement(image, s.box);
    for (Index c = 0, k = 0; c < s.cells(); ++c) {
      const Index end = k + s.segments(c);
      Box box{segments.all[k].from, segments.all[k].from};
      for (Index i = k; i < end; ++i) {
        box.lo = box.lo.cwiseMin(segments.all[i].from);
        box.hi = box.hi.cwiseMax(segments.all[i].from);
      }
      const bool near = ((box.lo + shift).array() <= around.hi.array()).all() &&
                        ((box.hi + shift).array() >= around.lo.array()).all();
      const auto moved = static_cast<int>(segments.all.size()) - k;
      for (Index i = k; near && i < end; ++i) {
        OwnedSegment copy = segments.all[i];
        copy.from += shift, copy.to += shift;
        if (copy.before >= 0) copy.before += moved;
        if (copy.after >= 0) copy.after += moved;
        segments.all.push_back(copy);
      }
      k = end;
    }
  }
}

}  // namespace

void check_crossings(const Sample& s, std::vector<std::string>& all) {
  Violations bad;
  Segments segments = segments_of(s);
  if (segments.all.empty()) return;
  if (s.periodic[0] || s.periodic[1]) add_copies(s, segments);
  for (const Crossing& crossing : find_crossings(segments.all)) {
    const OwnedSegment& a = segments.all[crossing.first];
    const OwnedSegment& b = segments.all[crossing.second];
    if (crossing.first >= static_cast<int>(segments.own)) continue;  // two copies: their originals are here
    if (a.owner == b.owner)
      bad.add("cell {} crosses itself near ({:g}, {:g})", a.owner, a.from.x(), a.from.y());
    else
      bad.add("cells {} and {} cross near ({:g}, {:g})", a.owner, b.owner, b.from.x(), b.from.y());
  }
  bad.append_to(all);
}

}  // namespace lamella
