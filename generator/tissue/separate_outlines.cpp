// Imported centre lines: where they face each other, and mass points placed anew along them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "generator/sample/errors.h"
#include "generator/sample/polygon.h"
#include "generator/tissue/crossings.h"
#include "generator/tissue/outlines.h"
#include "generator/tissue/polygons.h"

namespace lamella {
namespace {

constexpr int kSamplesPerSpacing = 20;  // to find where a facing part begins and ends
constexpr double kLeastFacing = 0.25;   // of the spacing: shorter facing parts get no link

/// A closed polyline by its arc length.
class ClosedLine {
 public:
  explicit ClosedLine(const std::vector<Vec2>& points) : points_(points) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      start_.push_back(length_);
      length_ += (points[(k + 1) % points.size()] - points[k]).norm();
    }
  }
  double length() const { return length_; }
  double start(std::size_t k) const { return start_[k]; }
  const Vec2& point(std::size_t k) const { return points_[k]; }
  const Vec2& point_after(std::size_t k) const { return points_[(k + 1) % points_.size()]; }
  std::size_t segments() const { return points_.size(); }
  double wrapped(double s) const { return s - length_ * std::floor(s / length_); }
  Vec2 at(double s) const {
    s = wrapped(s);
    const auto k = static_cast<std::size_t>(std::upper_bound(start_.begin(), start_.end(), s) - start_.begin()) - 1;
    return point(k) + (s - start_[k]) * (point_after(k) - point(k)).normalized();
  }

 private:
  std::vector<Vec2> points_;
  std::vector<double> start_;
  double length_ = 0;
};

struct Foot {
  Index cell = -1;
  double s = 0;  // along the cell
  double distance = 0;
};

/// Finds the nearest point of other cells' outlines.
class Neighbourhood {
 public:
  Neighbourhood(const std::vector<ClosedLine>& lines, const Box& box, double reach)
      : lines_(lines), grid_(box, reach, 4 * lines.size()), reach_(reach) {
    for (std::size_t c = 0; c < lines.size(); ++c)
      for (std::size_t k = 0; k < lines[c].segments(); ++k) {
        const Vec2& a = lines[c].point(k);
        const Vec2& b = lines[c].point_after(k);
        grid_.add(static_cast<int>(segments_.size()), a.cwiseMin(b), a.cwiseMax(b));
        segments_.push_back({static_cast<Index>(c), k});
      }
  }

  /// cell == -1: nothing within reach.
  Foot nearest(const Vec2& p, Index of_cell) const {
    Foot foot;
    foot.distance = reach_;
    grid_.visit(p - Vec2::Constant(reach_), p + Vec2::Constant(reach_), [&](int i) {
      const auto& [cell, k] = segments_[i];
      if (cell == of_cell) return;
      const ClosedLine& line = lines_[cell];
      const Vec2 along = line.point_after(k) - line.point(k);
      const double t = std::clamp((p - line.point(k)).dot(along) / along.squaredNorm(), 0.0, 1.0);
      const double distance = (line.point(k) + t * along - p).norm();
      if (distance < foot.distance || (distance == foot.distance && foot.cell >= 0 && cell < foot.cell))
        foot = {cell, line.start(k) + t * along.norm(), distance};
    });
    return foot;
  }

 private:
  const std::vector<ClosedLine>& lines_;
  Grid grid_;
  double reach_;
  std::vector<std::pair<Index, std::size_t>> segments_;
};

/// A part of cell a that faces cell b.
struct Facing {
  Index a = 0, b = 0;
  double from = 0, to = 0;  // along a; `to` may exceed its length
};

/// The facing part of each cell with cells of higher index, found by sampling. Facing is mutual: each is the
/// other's nearest.
std::vector<Facing> find_facing(const std::vector<ClosedLine>& lines, const Neighbourhood& around, double spacing) {
  std::vector<Facing> all;
  for (std::size_t c = 0; c < lines.size(); ++c) {
    const auto cell = static_cast<Index>(c);
    const ClosedLine& line = lines[c];
    const auto count =
        static_cast<std::size_t>(std::max(12.0, std::ceil(kSamplesPerSpacing * line.length() / spacing)));
    const double step = line.length() / static_cast<double>(count);
    std::vector<Index> faces(count, -1);
    for (std::size_t i = 0; i < count; ++i) {
      const Foot there = around.nearest(line.at(static_cast<double>(i) * step), cell);
      if (there.cell < 0) continue;
      const Foot back = around.nearest(lines[there.cell].at(there.s), there.cell);
      if (back.cell != cell) continue;
      // The two runs meet head on where they face: a foot far along the outline belongs to another part.
      const double off =
          std::abs(line.wrapped(back.s - static_cast<double>(i) * step + line.length() / 2) - line.length() / 2);
      if (off < spacing) faces[i] = there.cell;
    }
    std::size_t start = 0;
    while (start < count && faces[start] == faces[(start + count - 1) % count]) ++start;
    if (start == count) start = 0;
    for (std::size_t i = 0; i < count;) {
      const Index other = faces[(start + i) % count];
      std::size_t end = i;
      while (end + 1 < count && faces[(start + end + 1) % count] == other) ++end;
      if (other > cell)
        all.push_back({cell, other, static_cast<double>(start + i) * step, static_cast<double>(start + end) * step});
      i = end + 1;
    }
  }
  return all;
}

struct Placed {
  double s = 0;
  OutlineNode node;
};

/// Pairs of one facing part, evenly along a, each with the nearest point of b. Those that would run backwards along
/// b are left out.
void add_pairs(const Facing& facing, const std::vector<ClosedLine>& lines, const Neighbourhood& around, double spacing,
               std::vector<std::vector<Placed>>& placed, Bonding& bonding) {
  const double length = facing.to - facing.from;
  const auto segments = std::max<Index>(1, static_cast<Index>(std::lround(length / spacing)));
  const double step = length / segments;
  const auto first = static_cast<Index>(bonding.pairs.size());
  double last = 0;
  for (Index k = 0; k <= segments; ++k) {
    const double s = facing.from + k * step;
    const Vec2 at = lines[facing.a].at(s);
    const Foot foot = around.nearest(at, facing.a);
    if (foot.cell != facing.b) continue;
    const ClosedLine& b = lines[facing.b];
    if (k > 0 && static_cast<Index>(bonding.pairs.size()) > first) {
      const double back = b.wrapped(last - foot.s + b.length() / 2) - b.length() / 2;
      if (back < kMergeFraction * spacing) continue;
    }
    last = foot.s;
    const auto pair = static_cast<Index>(bonding.pairs.size());
    bonding.pairs.push_back({k == 0 || k == segments ? step / 2 : step, step, true});
    placed[facing.a].push_back({lines[facing.a].wrapped(s), {at, OutlineNode::Kind::matched, pair, 0}});
    placed[facing.b].push_back({foot.s, {b.at(foot.s), OutlineNode::Kind::matched, pair, 0}});
  }
  const auto count = static_cast<Index>(bonding.pairs.size()) - first;
  if (count == 0) return;
  const Vec2 direction = (lines[facing.a].at(facing.to) - lines[facing.a].at(facing.from)).normalized();
  bonding.walls.push_back({facing.a, facing.b, length, direction, first, count});
}

/// Free stretches get points of their own: real corners (30 degrees between sides longer than half a spacing), and
/// fill.
void fill_free_parts(const ClosedLine& line, double spacing, std::vector<Placed>& placed) {
  for (std::size_t k = 0; k < line.segments(); ++k) {
    const std::size_t before = (k + line.segments() - 1) % line.segments();
    const double turn = turning_angle(line.point(before), line.point(k), line.point_after(k));
    const double shorter =
        std::min((line.point(k) - line.point(before)).norm(), (line.point_after(k) - line.point(k)).norm());
    if (std::abs(turn) > std::numbers::pi / 6 && shorter > spacing / 2)
      placed.push_back({line.start(k), {line.point(k), OutlineNode::Kind::fill, -1, 0}});
  }
  if (placed.empty()) placed.push_back({0, {line.at(0), OutlineNode::Kind::fill, -1, 0}});
  std::stable_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.s < b.s; });
  std::vector<Placed> filled;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    filled.push_back(placed[i]);
    const double from = placed[i].s;
    const double to = i + 1 < placed.size() ? placed[i + 1].s : placed[0].s + line.length();
    const auto segments = std::lround((to - from) / spacing);
    for (long k = 1; k < segments; ++k) {
      const double s = from + (to - from) * static_cast<double>(k) / static_cast<double>(segments);
      filled.push_back({s, {line.at(s), OutlineNode::Kind::fill, -1, 0}});
    }
  }
  placed = std::move(filled);
}

/// Side bits of free points that look at a side of the box from within 0.6 cell diameters.
void mark_sides(const Box& box, double reach, Outline& outline) {
  const std::size_t count = outline.nodes.size();
  for (std::size_t k = 0; k < count; ++k) {
    OutlineNode& node = outline.nodes[k];
    if (node.kind == OutlineNode::Kind::matched) continue;
    const Vec2 along = outline.nodes[(k + 1) % count].at - outline.nodes[(k + count - 1) % count].at;
    const Vec2 outward = right_of(along).normalized();
    const double facing = 0.5 - 1e-9;
    if (-outward.x() > facing && node.at.x() - box.lo.x() < reach) node.side |= kLeft;
    if (outward.x() > facing && box.hi.x() - node.at.x() < reach) node.side |= kRight;
    if (-outward.y() > facing && node.at.y() - box.lo.y() < reach) node.side |= kBottom;
    if (outward.y() > facing && box.hi.y() - node.at.y() < reach) node.side |= kTop;
  }
}

void choose_links(const std::string& links, Bonding& bonding) {
  if (links == "all") return;
  for (const FacingWall& wall : bonding.walls)
    for (Index p = wall.first; p < wall.first + wall.count; ++p) {
      const bool end = p == wall.first || p + 1 == wall.first + wall.count;
      bonding.pairs[p].linked = links == "ends" && end;
      if (end)
        bonding.pairs[p] = {wall.count > 1 ? wall.length / 2 : wall.length, wall.length, bonding.pairs[p].linked};
    }
}

}  // namespace

Sample make_separate_tissue(const std::vector<ImportedCell>& imported, const SampleScene& scene,
                            const std::string& file, double radius, const std::string& group, Notes& notes) {
  const double tolerance = scene.facing_tolerance > 0 ? scene.facing_tolerance : 2.2 * radius;
  if (!(tolerance > 0))
    throw SceneError(
        "sample.facing_tolerance: separate outlines need a positive tolerance, or cells a positive radius");
  refuse_overlaps(imported, file, 0);
  Sample sample;
  sample.box = box_of(imported, scene, radius);

  std::vector<ImportedCell> cells = imported;
  double area = 0;
  double perimeter = 0;
  for (const auto& cell : cells) {
    area += polygon_area(cell.points);
    perimeter += ClosedLine(cell.points).length();
  }
  const double mean_area = area / static_cast<double>(cells.size());
  Mosaic order;  // only to number the cells by rows
  order.box = sample.box;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    MosaicCell cell;
    for (const Vec2& p : cells[c].points) {
      cell.vertex.push_back(static_cast<Index>(order.vertices.size()));
      order.vertices.push_back(p);
    }
    cell.name = cells[c].label;
    order.cells.push_back(std::move(cell));
  }
  order_by_rows(order);

  Bonding bonding;
  // A wall of mean length: six walls to a cell.
  bonding.spacing = scene.walls.spacing > 0
                        ? scene.walls.spacing
                        : perimeter / static_cast<double>(cells.size()) / 6 / std::max(1, scene.walls.segments);
  std::vector<ClosedLine> lines;
  for (const MosaicCell& cell : order.cells) lines.emplace_back(polygon_of(order, cell));
  const Box around = box_of(imported, {}, radius);
  const Neighbourhood neighbourhood(lines, around, tolerance);
  std::vector<std::vector<Placed>> placed(lines.size());
  Index unlinked = 0;
  for (const Facing& facing : find_facing(lines, neighbourhood, bonding.spacing)) {
    if (facing.to - facing.from < kLeastFacing * bonding.spacing) {
      ++unlinked;
      continue;
    }
    add_pairs(facing, lines, neighbourhood, bonding.spacing, placed, bonding);
  }
  if (unlinked > 0)
    notes.push_back(fmt::format("{} places where cells face each other over less than {} spacings get no link",
                                unlinked, kLeastFacing));
  if (bonding.walls.empty())
    notes.push_back(
        fmt::format("no two cells face each other within {:.4g} m: there are no links; a larger "
                    "sample.facing_tolerance would find walls further apart",
                    tolerance));
  choose_links(scene.walls.links, bonding);
  const double reach = 1.2 * std::sqrt(mean_area / std::numbers::pi);
  for (std::size_t c = 0; c < lines.size(); ++c) {
    fill_free_parts(lines[c], bonding.spacing, placed[c]);
    Outline outline;
    outline.name = "cell " + order.cells[c].name;
    for (const Placed& p : placed[c]) outline.nodes.push_back(p.node);
    // Gaps are shared out as half the distance of facing centre lines: the area of the rounded outline.
    const auto polygon = polygon_of(order, order.cells[c]);
    outline.tile_area = polygon_area(polygon) + radius * lines[c].length() + std::numbers::pi * radius * radius;
    mark_sides(sample.box, reach, outline);
    bonding.cells.push_back(std::move(outline));
  }
  add_bonded_cells(bonding, radius, group, sample, notes);
  return sample;
}

}  // namespace lamella
