#include "generator/tissue/polygons.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "generator/sample/errors.h"
#include "generator/tissue/crossings.h"

namespace lamella {
namespace {

constexpr double kSamePoint = 1e-4;  // of the mean cell size
constexpr double kOnAnEdge = 1e-9;   // the same, where vertices are numbered and only T-junctions go by place

double mean_size(const std::vector<ImportedCell>& cells) {
  double area = 0;
  for (const auto& cell : cells) area += polygon_area(cell.points);
  return std::sqrt(area / static_cast<double>(cells.size()));
}

Box enclosing(const std::vector<Vec2>& points) {
  Box box{points.front(), points.front()};
  for (const Vec2& p : points) {
    box.lo = box.lo.cwiseMin(p);
    box.hi = box.hi.cwiseMax(p);
  }
  return box;
}

double distance_to_outline(const Vec2& p, const std::vector<Vec2>& outline) {
  double nearest = 1e300;
  for (std::size_t k = 0; k < outline.size(); ++k)
    nearest = std::min(nearest, distance_to_segment(p, outline[k], outline[(k + 1) % outline.size()]));
  return nearest;
}

std::string name_of(const ImportedCell& cell) { return fmt::format("cell {}", cell.label); }

/// Gives every point the id of a vertex: points within the tolerance share one.
std::vector<std::vector<Index>> weld_points(const std::vector<ImportedCell>& cells, double tolerance, const Box& box,
                                            std::vector<Vec2>& vertices) {
  std::size_t count = 0;
  for (const auto& cell : cells) count += cell.points.size();
  Grid grid(box, 0, count);
  std::vector<std::vector<Index>> ids(cells.size());
  const Vec2 reach = Vec2::Constant(tolerance);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (const Vec2& p : cells[c].points) {
      Index nearest = -1;
      double least = tolerance;
      grid.visit(p - reach, p + reach, [&](int v) {
        const double distance = (vertices[v] - p).norm();
        if (distance < least || (distance == least && v < nearest)) {
          least = distance;
          nearest = v;
        }
      });
      if (nearest < 0) {
        nearest = static_cast<Index>(vertices.size());
        vertices.push_back(p);
        grid.add(nearest, p, p);
      }
      if (ids[c].empty() || ids[c].back() != nearest) ids[c].push_back(nearest);
    }
    if (ids[c].size() > 1 && ids[c].front() == ids[c].back()) ids[c].pop_back();
  }
  return ids;
}

/// Vertices of a file that numbers them, those that cells use, in its order.
std::vector<std::vector<Index>> numbered_points(const std::vector<ImportedCell>& cells, std::vector<Vec2>& vertices) {
  std::map<Index, Vec2> used;
  for (const auto& cell : cells)
    for (std::size_t k = 0; k < cell.vertex.size(); ++k) used.emplace(cell.vertex[k], cell.points[k]);
  std::map<Index, Index> place;
  for (const auto& [number, point] : used) {
    place.emplace(number, static_cast<Index>(vertices.size()));
    vertices.push_back(point);
  }
  std::vector<std::vector<Index>> ids(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const Index number : cells[c].vertex) ids[c].push_back(place.at(number));
  return ids;
}

/// Divides edges at the vertices of other cells that lie on them.
std::vector<Index> divided(const std::vector<Index>& vertex, const std::vector<Vec2>& vertices, const Grid& grid,
                           double tolerance) {
  std::vector<Index> result;
  for (std::size_t k = 0; k < vertex.size(); ++k) {
    const Index from = vertex[k];
    const Index to = vertex[(k + 1) % vertex.size()];
    const Vec2& a = vertices[from];
    const Vec2& b = vertices[to];
    std::set<std::pair<double, Index>> between;
    const Vec2 reach = Vec2::Constant(tolerance);
    grid.visit(a.cwiseMin(b) - reach, a.cwiseMax(b) + reach, [&](int v) {
      if (v == from || v == to) return;
      const Vec2 along = b - a;
      const double t = (vertices[v] - a).dot(along) / along.squaredNorm();
      if (t > 0 && t < 1 && distance_to_segment(vertices[v], a, b) <= tolerance) between.emplace(t, v);
    });
    result.push_back(from);
    for (const auto& [t, v] : between) result.push_back(v);
  }
  return result;
}

}  // namespace

Box box_of(const std::vector<ImportedCell>& cells, const SampleScene& scene, double margin) {
  std::vector<Vec2> all;
  for (const auto& cell : cells) all.insert(all.end(), cell.points.begin(), cell.points.end());
  Box box = enclosing(all);
  box.lo -= Vec2::Constant(margin);
  box.hi += Vec2::Constant(margin);
  const Vec2 middle = (box.lo + box.hi) / 2;
  const Vec2 size(scene.width > 0 ? scene.width : box.size().x(), scene.height > 0 ? scene.height : box.size().y());
  return {middle - size / 2, middle + size / 2};
}

void refuse_overlaps(const std::vector<ImportedCell>& cells, const std::string& file, double tolerance) {
  std::vector<OwnedSegment> segments;
  std::vector<int> line;
  std::vector<Vec2> all;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto& p = cells[c].points;
    const auto base = static_cast<int>(segments.size());
    const auto count = static_cast<int>(p.size());
    for (int k = 0; k < count; ++k) {
      segments.push_back(
          {p[k], p[(k + 1) % count], static_cast<int>(c), base + (k + count - 1) % count, base + (k + 1) % count});
      line.push_back(cells[c].lines[k]);
      all.push_back(p[k]);
    }
  }
  std::set<std::pair<int, int>> named;
  std::vector<std::string> faults;
  const auto deep = [&](const Vec2& p, const ImportedCell& other) {
    return is_inside(other.points, p) && distance_to_outline(p, other.points) > tolerance;
  };
  for (const Crossing& crossing : find_crossings(segments, 100000)) {
    const OwnedSegment& s = segments[crossing.first];
    const OwnedSegment& t = segments[crossing.second];
    if (s.owner == t.owner) continue;
    // Walls that coincide cross by the rounding of the file: only what reaches deeper counts.
    const Vec2 d = (s.to - s.from).normalized();
    const Vec2 e = (t.to - t.from).normalized();
    const double sine = std::abs(cross(d, e));
    const double at_ends =
        std::min({distance_to_segment(s.from, t.from, t.to), distance_to_segment(s.to, t.from, t.to),
                  distance_to_segment(t.from, s.from, s.to), distance_to_segment(t.to, s.from, s.to)});
    if (at_ends <= tolerance || sine < 1e-9) continue;
    if (!named.emplace(std::min(s.owner, t.owner), std::max(s.owner, t.owner)).second) continue;
    faults.push_back(fmt::format("{}:{}: {} overlaps {}: the side from here crosses the one from line {}", file,
                                 line[crossing.second], name_of(cells[t.owner]), name_of(cells[s.owner]),
                                 line[crossing.first]));
  }
  Grid grid(enclosing(all), 0, cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Box box = enclosing(cells[c].points);
    grid.add(static_cast<int>(c), box.lo, box.hi);
  }
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t i = 0; i < 2 * cells[c].points.size(); ++i) {
      // Corners and middles of sides: all corners of an inscribed cell lie on the outline.
      const std::size_t k = i / 2;
      const Vec2& corner = cells[c].points[k];
      const Vec2 p = i % 2 == 0 ? corner : (corner + cells[c].points[(k + 1) % cells[c].points.size()]) / 2;
      std::set<int> holders;
      grid.visit(p, p, [&](int other) {
        if (other != static_cast<int>(c)) holders.insert(other);
      });
      for (const int other : holders) {
        const auto pair =
            std::pair(std::min<int>(static_cast<int>(c), other), std::max<int>(static_cast<int>(c), other));
        if (named.contains(pair) || !deep(p, cells[other])) continue;
        named.insert(pair);
        faults.push_back(fmt::format("{}:{}: {} overlaps {}: here it lies inside", file, cells[c].lines[k],
                                     name_of(cells[c]), name_of(cells[other])));
      }
    }
  if (!faults.empty()) throw SceneError(faults);
}

Mosaic share_walls(const std::vector<ImportedCell>& cells, const SampleScene& scene, const std::string& file) {
  const double tolerance = kSamePoint * mean_size(cells);
  refuse_overlaps(cells, file, tolerance);
  Mosaic mosaic;
  mosaic.box = box_of(cells, scene, 0);
  const Box around = box_of(cells, {}, 0);
  const bool numbered = !cells.front().vertex.empty();
  const auto ids =
      numbered ? numbered_points(cells, mosaic.vertices) : weld_points(cells, tolerance, around, mosaic.vertices);
  const double on_edge = numbered ? kOnAnEdge / kSamePoint * tolerance : tolerance;
  Grid grid(around, 0, mosaic.vertices.size());
  for (std::size_t v = 0; v < mosaic.vertices.size(); ++v)
    grid.add(static_cast<int>(v), mosaic.vertices[v], mosaic.vertices[v]);
  std::vector<std::string> faults;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    MosaicCell cell;
    cell.vertex = divided(ids[c], mosaic.vertices, grid, on_edge);
    auto sorted = cell.vertex;
    std::sort(sorted.begin(), sorted.end());
    if (cell.vertex.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      faults.push_back(
          fmt::format("{}:{}: {} touches itself within {:.3g} m; its outline must not return to where it was", file,
                      cells[c].lines.front(), name_of(cells[c]), tolerance));
    cell.side.assign(cell.vertex.size(), 0);
    cell.name = fmt::format("{} ({}:{})", name_of(cells[c]), file,
                            *std::min_element(cells[c].lines.begin(), cells[c].lines.end()));
    const std::string& label = cells[c].label;
    if (const auto end = label.data() + label.size();
        std::from_chars(label.data(), end, cell.number).ptr != end || cell.number < 0)
      cell.number = -1;  // a word
    mosaic.cells.push_back(std::move(cell));
  }
  if (!faults.empty()) throw SceneError(faults);
  mark_rough_sides(mosaic);  // also refuses cells that coincide
  return mosaic;
}

}  // namespace lamella
