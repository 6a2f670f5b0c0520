#include "generator/packing/weld.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <set>
#include <tuple>

namespace lamella {
namespace {

Image minus(const Image& a, const Image& b) {
  return {static_cast<std::int8_t>(a[0] - b[0]), static_cast<std::int8_t>(a[1] - b[1])};
}

class Welder {
 public:
  explicit Welder(Tessellation& t)
      : t_(t),
        periodic_(t.periodic[0] || t.periodic[1]),
        tiles_of_(t.vertices.size()),
        sides_(t.vertices.size(), 0),
        version_(t.vertices.size(), 0) {
    const double area = t.box.area() / static_cast<double>(std::max<std::size_t>(1, t.tiles.size()));
    tolerance_ = 1e-12 * area;
    for (Index k = 0; k < static_cast<Index>(t.tiles.size()); ++k) {
      const Tile& tile = t.tiles[k];
      for (std::size_t e = 0; e < tile.vertex.size(); ++e) {
        const Index a = tile.vertex[e], b = tile.vertex[(e + 1) % tile.vertex.size()];
        tiles_of_[a].push_back(k);
        if (tile.neighbour[e] < 0) sides_[a] |= bit(tile.neighbour[e]), sides_[b] |= bit(tile.neighbour[e]);
      }
    }
  }

  int weld(double threshold) {
    for (const Tile& tile : t_.tiles) queue_edges(tile, threshold);
    int welded = 0;
    while (!short_edges_.empty()) {
      const Candidate edge = short_edges_.top();
      short_edges_.pop();
      if (edge.version != version(edge.a, edge.b) || !joined(edge)) continue;
      if (!collapse(edge)) {
        left_.push_back(edge);
        continue;
      }
      ++welded;
      for (const Index k : tiles_of_[edge.a]) queue_edges(t_.tiles[k], threshold);
    }
    find_remaining();
    drop_unused_vertices();
    return welded;
  }

  /// Short edges that remain, each once, shortest first; made before the numbers of vertices change.
  const std::vector<ShortEdge>& left_over() const { return remaining_; }

 private:
  /// An edge from vertex a to vertex b as displaced by `image`.
  struct Edge {
    Index a, b;
    Image image;
  };
  struct Candidate : Edge {
    double length;
    long version;
    bool operator<(const Candidate& other) const {  // the queue's top is its largest: shortest first, then by vertex
      return std::tie(length, a, b, image) > std::tie(other.length, other.a, other.b, other.image);
    }
  };

  static std::uint8_t bit(Index side) { return static_cast<std::uint8_t>(1 << (-1 - side)); }
  long version(Index a, Index b) const { return version_[a] + version_[b]; }

  /// The e-th edge of a tile, from its vertex of lower index.
  Edge edge_of(const Tile& tile, std::size_t e) const {
    const std::size_t f = next(tile, e);
    Edge edge{tile.vertex[e], tile.vertex[f], {0, 0}};
    if (periodic_) edge.image = minus(tile.image[f], tile.image[e]);
    if (edge.a > edge.b) edge = {edge.b, edge.a, minus({0, 0}, edge.image)};
    return edge;
  }

  Vec2 end_of(const Edge& edge) const { return t_.vertices[edge.b] + displacement(edge.image, t_.box); }

  void queue_edges(const Tile& tile, double threshold) {
    for (std::size_t e = 0; e < tile.vertex.size(); ++e) {
      const Edge edge = edge_of(tile, e);
      const double length = (end_of(edge) - t_.vertices[edge.a]).norm();
      // An edge from a vertex to its own image goes round the box.
      if (length <= threshold && edge.a != edge.b) short_edges_.push({edge, length, version(edge.a, edge.b)});
    }
  }

  static std::size_t next(const Tile& tile, std::size_t e) { return (e + 1) % tile.vertex.size(); }

  bool joined(const Edge& edge) const {
    return std::any_of(tiles_of_[edge.a].begin(), tiles_of_[edge.a].end(), [&](Index k) {
      const Tile& tile = t_.tiles[k];
      for (std::size_t e = 0; e < tile.vertex.size(); ++e) {
        const Edge here = edge_of(tile, e);
        if (here.a == edge.a && here.b == edge.b && here.image == edge.image) return true;
      }
      return false;
    });
  }

  /// Where the welded point may lie, best first: in the middle, or, if that bends a tile, elsewhere on the edge. On the
  /// boundary of the box only what keeps to it.
  std::vector<Vec2> places(const Edge& edge) const {
    const Index a = edge.a, b = edge.b;
    const Vec2 p = t_.vertices[a], q = end_of(edge);
    std::vector<Vec2> result;
    for (const double s : {0.5, 0.4, 0.6, 0.25, 0.75, 0.0, 1.0}) result.push_back(p + s * (q - p));
    const auto both = static_cast<std::uint8_t>(sides_[a] | sides_[b]);
    for (Vec2& at : result) {
      if (both & bit(kLeftSide)) at.x() = t_.box.lo.x();
      if (both & bit(kRightSide)) at.x() = t_.box.hi.x();
      if (both & bit(kBottomSide)) at.y() = t_.box.lo.y();
      if (both & bit(kTopSide)) at.y() = t_.box.hi.y();
    }
    const bool to_a = sides_[a] && !sides_[b], to_b = sides_[b] && !sides_[a];
    if (to_a) result.insert(result.begin(), p);  // an inner vertex goes to one on the boundary, rather than both
    if (to_b) result.insert(result.begin(), q);
    return result;
  }

  /// Two vertices on different sides can only meet in their corner, and only if one of them is the corner.
  bool sides_allow(Index a, Index b) const {
    const std::uint8_t both = sides_[a] | sides_[b];
    return both == sides_[a] || both == sides_[b];
  }

  bool collapse(const Edge& edge) {
    const Index a = edge.a, b = edge.b;
    if (!sides_allow(a, b)) return false;
    std::vector<Index> touched = tiles_of_[a];
    touched.insert(touched.end(), tiles_of_[b].begin(), tiles_of_[b].end());
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    std::vector<Tile> after;
    for (const Index k : touched) {
      Tile tile = t_.tiles[k];
      if (!merge(tile, edge)) return false;
      after.push_back(std::move(tile));
    }
    const Vec2 before = t_.vertices[a];
    for (const Vec2& at : places(edge)) {
      t_.vertices[a] = at;
      if (!std::all_of(after.begin(), after.end(), [&](const Tile& tile) { return convex(tile); })) continue;
      for (std::size_t i = 0; i < touched.size(); ++i) t_.tiles[touched[i]] = std::move(after[i]);
      sides_[a] |= sides_[b];
      tiles_of_[a] = std::move(touched);
      tiles_of_[b].clear();
      version_[a] += version_[b] + 1;
      return true;
    }
    t_.vertices[a] = before;
    return false;
  }

  /// b, as displaced by the edge's image, becomes a. False when the tile would lose its area, or touch itself.
  bool merge(Tile& tile, const Edge& edge) const {
    for (std::size_t e = 0; e < tile.vertex.size(); ++e) {
      if (tile.vertex[e] != edge.b) continue;
      tile.vertex[e] = edge.a;
      if (periodic_) tile.image[e] = minus(tile.image[e], edge.image);
    }
    for (std::size_t e = 0; e < tile.vertex.size() && tile.vertex.size() >= 3;) {
      if (tile.vertex[e] == edge.a && same_corner(tile, e, next(tile, e)))
        erase(tile, e);
      else
        ++e;
    }
    if (tile.vertex.size() < 3) return false;
    for (std::size_t e = 0; e < tile.vertex.size(); ++e)
      for (std::size_t f = 0; f < e; ++f)
        if (tile.vertex[e] == edge.a && same_corner(tile, e, f)) return false;
    return true;
  }

  bool same_corner(const Tile& tile, std::size_t e, std::size_t f) const {
    return tile.vertex[e] == tile.vertex[f] && (!periodic_ || tile.image[e] == tile.image[f]);
  }

  void erase(Tile& tile, std::size_t e) const {
    const auto at = static_cast<std::ptrdiff_t>(e);
    tile.vertex.erase(tile.vertex.begin() + at);
    tile.neighbour.erase(tile.neighbour.begin() + at);
    if (!periodic_) return;
    tile.image.erase(tile.image.begin() + at);
    tile.across.erase(tile.across.begin() + at);
  }

  bool convex(const Tile& tile) const {
    for (std::size_t e = 0; e < tile.vertex.size(); ++e) {
      const Vec2 p = corner(t_, tile, e), q = corner(t_, tile, next(tile, e)),
                 r = corner(t_, tile, (e + 2) % tile.vertex.size());
      if (cross(q - p, r - q) < -tolerance_) return false;
    }
    return tile_area(t_, tile) > tolerance_;
  }

  /// Edges were refused as often as something beside them changed, and by both their tiles.
  void find_remaining() {
    std::set<std::tuple<Index, Index, Image>> seen;
    for (const Candidate& edge : left_)
      if (edge.version == version(edge.a, edge.b) && joined(edge) && seen.insert({edge.a, edge.b, edge.image}).second)
        remaining_.push_back({t_.vertices[edge.a], edge.length});
  }

  void drop_unused_vertices() {
    std::vector<Index> id(t_.vertices.size(), -1);
    std::vector<Vec2> kept;
    for (std::size_t v = 0; v < t_.vertices.size(); ++v) {
      if (tiles_of_[v].empty()) continue;
      id[v] = static_cast<Index>(kept.size());
      kept.push_back(t_.vertices[v]);
    }
    t_.vertices = std::move(kept);
    for (Tile& tile : t_.tiles)
      for (Index& v : tile.vertex) v = id[v];
  }

  Tessellation& t_;
  const bool periodic_;
  std::vector<std::vector<Index>> tiles_of_;  // by position in Tessellation::tiles
  std::vector<std::uint8_t> sides_;           // of the box that a vertex lies on
  std::vector<long> version_;                 // grows whenever a vertex moves
  std::priority_queue<Candidate> short_edges_;
  std::vector<Candidate> left_;
  std::vector<ShortEdge> remaining_;
  double tolerance_;  // of a cross product [m2]
};

}  // namespace

void note_short_edges(std::vector<ShortEdge> left, const std::string& reason, std::vector<std::string>& notes) {
  if (left.empty()) return;
  std::stable_sort(left.begin(), left.end(),
                   [](const ShortEdge& a, const ShortEdge& b) { return a.length < b.length; });
  constexpr std::size_t kShown = 5;
  std::string places;
  for (std::size_t k = 0; k < std::min(kShown, left.size()); ++k)
    places += fmt::format("{}({:.6g}, {:.6g})", k > 0 ? ", " : "", left[k].at.x(), left[k].at.y());
  if (left.size() > kShown) places += fmt::format(" and {} more", left.size() - kShown);
  notes.push_back(fmt::format("{} short edge{}, from {:.3g} m on, as welding would {}: at {}", left.size(),
                              left.size() > 1 ? "s stay" : " stays", left.front().length, reason, places));
}

int weld_short_edges(Tessellation& tessellation, double threshold, std::vector<std::string>* notes) {
  Welder welder(tessellation);
  const int welded = welder.weld(threshold);
  if (notes && welded > 0)
    notes->push_back(fmt::format("{} edges of at most {:.3g} m welded to a point", welded, threshold));
  if (notes) note_short_edges(welder.left_over(), "bend or remove a tile", *notes);
  return welded;
}

}  // namespace lamella
