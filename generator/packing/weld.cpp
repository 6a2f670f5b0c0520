#include "generator/packing/weld.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace lamella {
namespace {

class Welder {
 public:
  explicit Welder(Tessellation& t)
      : t_(t), tiles_of_(t.vertices.size()), sides_(t.vertices.size(), 0), version_(t.vertices.size(), 0) {
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
    for (const Tile& tile : t_.tiles)
      for (std::size_t e = 0; e < tile.vertex.size(); ++e)
        queue(tile.vertex[e], tile.vertex[(e + 1) % tile.vertex.size()], threshold);
    int welded = 0;
    while (!short_edges_.empty()) {
      const Candidate edge = short_edges_.top();
      short_edges_.pop();
      if (edge.version != version(edge.a, edge.b) || !joined(edge.a, edge.b)) continue;
      if (!collapse(edge.a, edge.b)) {
        left_.push_back(edge);
        continue;
      }
      ++welded;
      for (const Index k : tiles_of_[edge.a]) {
        const auto& vertex = t_.tiles[k].vertex;
        for (std::size_t e = 0; e < vertex.size(); ++e) queue(vertex[e], vertex[(e + 1) % vertex.size()], threshold);
      }
    }
    drop_unused_vertices();
    return welded;
  }

  /// Short edges that remain.
  std::vector<std::string> left_over() const { return left_notes_; }

 private:
  struct Candidate {
    double length;
    Index a, b;
    long version;
    bool operator<(const Candidate& other) const {  // the queue's top is its largest: shortest first, then by vertex
      return std::array{length, double(a), double(b)} > std::array{other.length, double(other.a), double(other.b)};
    }
  };

  static std::uint8_t bit(Index side) { return static_cast<std::uint8_t>(1 << (-1 - side)); }
  long version(Index a, Index b) const { return version_[a] + version_[b]; }

  void queue(Index a, Index b, double threshold) {
    if (a > b) std::swap(a, b);
    const double length = (t_.vertices[a] - t_.vertices[b]).norm();
    if (length <= threshold) short_edges_.push({length, a, b, version(a, b)});
  }

  static std::size_t next(const Tile& tile, std::size_t e) { return (e + 1) % tile.vertex.size(); }

  bool joined(Index a, Index b) const {
    return std::any_of(tiles_of_[a].begin(), tiles_of_[a].end(), [&](Index k) {
      const Tile& tile = t_.tiles[k];
      for (std::size_t e = 0; e < tile.vertex.size(); ++e)
        if ((tile.vertex[e] == a && tile.vertex[next(tile, e)] == b) ||
            (tile.vertex[e] == b && tile.vertex[next(tile, e)] == a))
          return true;
      return false;
    });
  }

  /// Where the welded point may lie, best first: in the middle, or, if that bends a tile, elsewhere on the edge. On the
  /// boundary of the box only what keeps to it.
  std::vector<Vec2> places(Index a, Index b) const {
    const Vec2 p = t_.vertices[a], q = t_.vertices[b];
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

  bool collapse(Index a, Index b) {
    if (!sides_allow(a, b)) return false;
    std::vector<Index> touched = tiles_of_[a];
    touched.insert(touched.end(), tiles_of_[b].begin(), tiles_of_[b].end());
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    std::vector<Tile> after;
    for (const Index k : touched) {
      Tile tile = t_.tiles[k];
      if (!merge(tile, a, b)) return false;
      after.push_back(std::move(tile));
    }
    const Vec2 before = t_.vertices[a];
    for (const Vec2& at : places(a, b)) {
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

  /// b becomes a. False when the tile would lose its area, or touch itself.
  static bool merge(Tile& tile, Index a, Index b) {
    std::replace(tile.vertex.begin(), tile.vertex.end(), b, a);
    for (std::size_t e = 0; e < tile.vertex.size(); ++e) {
      if (tile.vertex[e] != a || tile.vertex[next(tile, e)] != a) continue;
      tile.vertex.erase(tile.vertex.begin() + static_cast<std::ptrdiff_t>(e));
      tile.neighbour.erase(tile.neighbour.begin() + static_cast<std::ptrdiff_t>(e));
      break;
    }
    return tile.vertex.size() >= 3 && std::count(tile.vertex.begin(), tile.vertex.end(), a) == 1;
  }

  bool convex(const Tile& tile) const {
    const auto& x = t_.vertices;
    for (std::size_t e = 0; e < tile.vertex.size(); ++e) {
      const Vec2 &p = x[tile.vertex[e]], &q = x[tile.vertex[next(tile, e)]],
                 &r = x[tile.vertex[(e + 2) % tile.vertex.size()]];
      if (cross(q - p, r - q) < -tolerance_) return false;
    }
    return tile_area(t_, tile) > tolerance_;
  }

  void drop_unused_vertices() {
    for (const Candidate& edge : left_) {
      if (edge.version != version(edge.a, edge.b) || !joined(edge.a, edge.b)) continue;
      const Vec2 at = t_.vertices[edge.a];
      left_notes_.push_back(
          fmt::format("the edge at ({:.6g}, {:.6g}), {:.3g} m long, stays: welding it would bend or remove a tile",
                      at.x(), at.y(), edge.length));
    }
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
  std::vector<std::vector<Index>> tiles_of_;  // by position in Tessellation::tiles
  std::vector<std::uint8_t> sides_;           // of the box that a vertex lies on
  std::vector<long> version_;                 // grows whenever a vertex moves
  std::priority_queue<Candidate> short_edges_;
  std::vector<Candidate> left_;
  std::vector<std::string> left_notes_;
  double tolerance_;  // of a cross product [m2]
};

}  // namespace

int weld_short_edges(Tessellation& tessellation, double threshold, std::vector<std::string>* notes) {
  Welder welder(tessellation);
  const int welded = welder.weld(threshold);
  if (notes && welded > 0)
    notes->push_back(fmt::format("{} edges of at most {:.3g} m welded to a point", welded, threshold));
  if (notes)
    for (const std::string& note : welder.left_over()) notes->push_back(note);
  return welded;
}

}  // namespace lamella
