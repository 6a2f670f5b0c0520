// Short edges of a clipped tissue, welded to a point. Differs from the welding of tiles in what must be kept: cells may be concave, and the
// boundary is no box.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "generator/packing/weld.h"
#include "generator/tissue/domain_tissue.h"

namespace lamella {
namespace {

constexpr Index kInside = -1, kCorner = -2;

bool cross_properly(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

bool is_simple(const std::vector<Vec2>& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j)
      if (!(i == 0 && j + 1 == n) && cross_properly(p[i], p[i + 1], p[j], p[(j + 1) % n])) return false;
  return polygon_area(p.data(), static_cast<Index>(n)) > 0;
}

class Welder {
 public:
  explicit Welder(DomainTissue& tissue)
      : t_(tissue), cells_of_(tissue.mosaic.vertices.size()), changed_(tissue.mosaic.vertices.size()) {
    for (std::size_t c = 0; c < t_.mosaic.cells.size(); ++c)
      for (const Index v : t_.mosaic.cells[c].vertex) cells_of_[v].push_back(static_cast<Index>(c));
  }

  int weld(double threshold) {
    int welded = 0;
    for (bool any = true; any;) {
      any = false;
      std::fill(changed_.begin(), changed_.end(), 0);
      for (const Short& edge : short_edges(threshold)) {
        if (changed_[edge.a] || changed_[edge.b] || !collapse(edge.a, edge.b, edge.boundary)) continue;
        any = true;
        ++welded;
      }
    }
    left_ = short_edges(threshold);
    return welded;
  }

  void note_left(std::vector<std::string>& notes) const {
    std::vector<ShortEdge> left;
    for (const Short& edge : left_)
      if (edge.boundary < 0 || t_.lies_on[edge.a] != kCorner || t_.lies_on[edge.b] != kCorner)
        left.push_back({t_.mosaic.vertices[edge.a], edge.length});
    note_short_edges(std::move(left), "move a corner of the domain, fold or remove a cell", notes);
  }

 private:
  struct Short {
    double length;
    Index a, b;
    Index boundary;
  };

  std::vector<Short> short_edges(double threshold) const {
    std::vector<Short> found;
    for (std::size_t c = 0; c < t_.mosaic.cells.size(); ++c) {
      const auto& vertex = t_.mosaic.cells[c].vertex;
      for (std::size_t k = 0; k < vertex.size(); ++k) {
        const Index a = vertex[k], b = vertex[(k + 1) % vertex.size()];
        const double length = (t_.mosaic.vertices[a] - t_.mosaic.vertices[b]).norm();
        if (length <= threshold) found.push_back({length, std::min(a, b), std::max(a, b), t_.boundary[c][k]});
      }
    }
    const auto key = [](const Short& s) { return std::tie(s.length, s.a, s.b); };
    std::sort(found.begin(), found.end(), [&](const Short& s, const Short& t) { return key(s) < key(t); });
    found.erase(std::unique(found.begin(), found.end(),
                            [](const Short& s, const Short& t) { return s.a == t.a && s.b == t.b; }),
                found.end());
    return found;
  }

  /// Where the welded vertex lies and on what; false when the boundary would move.
  bool place(Index a, Index b, Index boundary, Vec2& at, Index& on) const {
    const Vec2 &p = t_.mosaic.vertices[a], &q = t_.mosaic.vertices[b];
    on = t_.lies_on[a] == kInside ? t_.lies_on[b] : t_.lies_on[a];
    at = (p + q) / 2;
    if (t_.lies_on[a] == kInside && t_.lies_on[b] == kInside) return true;
    if (t_.lies_on[a] == kInside || t_.lies_on[b] == kInside) {
      at = t_.lies_on[a] == kInside ? q : p;
      return true;
    }
    if (boundary < 0) return false;  // a wall from side to side
    if (t_.lies_on[a] == kCorner && t_.lies_on[b] == kCorner) return false;
    if (t_.lies_on[a] == kCorner) at = p;
    if (t_.lies_on[b] == kCorner) at = q;
    if (t_.lies_on[a] == kCorner || t_.lies_on[b] == kCorner) on = kCorner;
    return true;
  }

  bool collapse(Index a, Index b, Index boundary) {
    Vec2 at;
    Index on;
    if (!place(a, b, boundary, at, on)) return false;
    std::vector<Index> touched = cells_of_[a];
    touched.insert(touched.end(), cells_of_[b].begin(), cells_of_[b].end());
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    std::vector<std::pair<std::vector<Index>, std::vector<Index>>> after;  // vertices and boundaries of each
    const Vec2 before = t_.mosaic.vertices[a];
    t_.mosaic.vertices[a] = at;
    for (const Index c : touched) {
      auto vertex = t_.mosaic.cells[c].vertex;
      auto side = t_.boundary[c];
      if (!merge(vertex, side, a, b)) return t_.mosaic.vertices[a] = before, false;
      std::vector<Vec2> points;
      for (const Index v : vertex) points.push_back(t_.mosaic.vertices[v]);
      if (!is_simple(points)) return t_.mosaic.vertices[a] = before, false;
      after.emplace_back(std::move(vertex), std::move(side));
    }
    for (std::size_t i = 0; i < touched.size(); ++i) {
      MosaicCell& cell = t_.mosaic.cells[touched[i]];
      std::tie(cell.vertex, t_.boundary[touched[i]]) = std::move(after[i]);
      cell.side.assign(cell.vertex.size(), 0);
      for (const Index v : cell.vertex) changed_[v] = 1;
    }
    t_.lies_on[a] = on;
    cells_of_[a] = std::move(touched);
    cells_of_[b].clear();
    return true;
  }

  /// b becomes a. False when the cell would be left with two corners, or touch itself.
  static bool merge(std::vector<Index>& vertex, std::vector<Index>& side, Index a, Index b) {
    std::replace(vertex.begin(), vertex.end(), b, a);
    for (std::size_t k = 0; k < vertex.size(); ++k) {
      if (vertex[k] != a || vertex[(k + 1) % vertex.size()] != a) continue;
      vertex.erase(vertex.begin() + static_cast<std::ptrdiff_t>(k));
      side.erase(side.begin() + static_cast<std::ptrdiff_t>(k));
      break;
    }
    return vertex.size() >= 3 && std::count(vertex.begin(), vertex.end(), a) == 1;
  }

  DomainTissue& t_;
  std::vector<std::vector<Index>> cells_of_;
  std::vector<char> changed_;  // in this round: other short edges there are no longer what they were
  std::vector<Short> left_;
};

}  // namespace

int weld_short_edges(DomainTissue& tissue, double threshold, std::vector<std::string>& notes) {
  Welder welder(tissue);
  const int welded = welder.weld(threshold);
  if (welded > 0)
    notes.push_back(fmt::format("{} edges of at most {:.3g} m at the boundary welded to a point", welded, threshold));
  welder.note_left(notes);
  return welded;
}

}  // namespace lamella
