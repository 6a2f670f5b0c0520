#include "generator/tissue/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "generator/packing/exact_signs.h"
#include "generator/packing/random.h"
#include "generator/sample/errors.h"
#include "generator/tissue/crossings.h"
#include "generator/tissue/mosaic.h"

namespace lamella {
namespace {

/// The boundary and a wall have more in common than a point that is no end of either.
struct Coincidence {};

/// One edge of the tessellation, from the lower vertex to the higher.
struct CutWall {
  Index low = 0, high = 0;
  Index left = -1, left_edge = 0;    // tile that has it from low to high, and which of its edges it is
  Index right = -1, right_edge = 0;  // tile that has it from high to low; -1: outside the box
  std::vector<Index> crossings;      // from low to high
};

/// The boundary crosses a wall.
struct BoundaryCrossing {
  Index wall = 0;
  Index from_tile = 0, to_tile = 0;  // along the boundary
  double share = 0;                  // of the way along the domain's edge
  Index rank = 0;                    // among the wall's crossings
  Index ahead = -1, behind = -1;     // pieces of the boundary that start and end here
};

/// A piece of the boundary between two points, in one tile.
struct BoundaryPiece {
  Index from = 0, to = 0;  // points
  Index tile = 0;
  Index boundary = 0;                // edge of the domain
  Index crossing_from = -1, crossing_to = -1;
  Index before = -1, after = -1;  // pieces of the same loop
};

std::vector<CutWall> walls_of(const Tessellation& tessellation) {
  struct Directed {
    Index low, high, tile, edge;
    bool rising;
  };
  std::vector<Directed> all;
  for (std::size_t t = 0; t < tessellation.tiles.size(); ++t) {
    const auto& vertex = tessellation.tiles[t].vertex;
    for (std::size_t k = 0; k < vertex.size(); ++k) {
      const Index u = vertex[k], v = vertex[(k + 1) % vertex.size()];
      all.push_back({std::min(u, v), std::max(u, v), static_cast<Index>(t), static_cast<Index>(k), u < v});
    }
  }
  std::sort(all.begin(), all.end(), [](const Directed& a, const Directed& b) {
    return std::tie(a.low, a.high, a.tile, a.edge) < std::tie(b.low, b.high, b.tile, b.edge);
  });
  std::vector<CutWall> walls;
  for (const Directed& d : all) {
    if (walls.empty() || walls.back().low != d.low || walls.back().high != d.high)
      walls.push_back({.low = d.low, .high = d.high, .crossings = {}});
    CutWall& wall = walls.back();
    (d.rising ? wall.left : wall.right) = d.tile;
    (d.rising ? wall.left_edge : wall.right_edge) = d.edge;
  }
  return walls;
}

class Overlayer {
 public:
  /// `moved` decides, `loops` says where the boundary is.
  Overlayer(const Tessellation& tessellation, const Loops& loops, const Loops& moved)
      : t_(tessellation), loops_(loops), moved_(moved), walls_(walls_of(tessellation)) {
    for (const auto& loop : loops) {
      first_boundary_.push_back(boundaries_);
      boundaries_ += static_cast<Index>(loop.size());
    }
  }

  Overlay make() {
    find_crossings();
    place_points();
    divide_boundary();
    make_tile_edges();
    join_boundary();
    trace();
    return inside_only();
  }

 private:
  const Vec2& vertex(Index v) const { return t_.vertices[v]; }
  Index corner_point(Index boundary) const { return first_corner_ + boundary; }

  void find_crossings() {
    Grid grid(t_.box, 0, walls_.size());
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const Vec2 &u = vertex(walls_[w].low), &v = vertex(walls_[w].high);
      grid.add(static_cast<int>(w), u.cwiseMin(v), u.cwiseMax(v));
    }
    const double step = std::sqrt(t_.box.area() / static_cast<double>(t_.tiles.size()));
    crossings_along_.resize(static_cast<std::size_t>(boundaries_));
    for (std::size_t l = 0; l < moved_.size(); ++l)
      for (std::size_t e = 0; e < moved_[l].size(); ++e) {
        const Vec2 &a = moved_[l][e], &b = moved_[l][(e + 1) % moved_[l].size()];
        std::set<int> near;
        const double length = (b - a).norm();
        const auto parts = static_cast<int>(std::min(1e6, length / step)) + 1;
        const Vec2 slack = Vec2::Constant(1e-9 * step);
        for (int k = 0; k < parts; ++k) {
          const Vec2 p = a + (b - a) * (static_cast<double>(k) / parts), q = a + (b - a) * ((k + 1.0) / parts);
          grid.visit(p.cwiseMin(q) - slack, p.cwiseMax(q) + slack, [&](int w) { near.insert(w); });
        }
        cross(first_boundary_[l] + static_cast<Index>(e), a, b, near);
      }
    for (CutWall& wall : walls_) order(wall);
  }

  /// Crossings of one edge of the domain, in its order.
  void cross(Index boundary, const Vec2& a, const Vec2& b, const std::set<int>& near) {
    std::vector<BoundaryCrossing> found;
    std::vector<std::pair<Vec2, Vec2>> segments;
    for (const int w : near) {
      const CutWall& wall = walls_[w];
      const Vec2 &u = vertex(wall.low), &v = vertex(wall.high);
      const int u_side = orientation(a, b, u), v_side = orientation(a, b, v);
      if (u_side * v_side > 0) continue;
      const int a_side = orientation(u, v, a), b_side = orientation(u, v, b);
      if (a_side * b_side > 0) continue;
      if (u_side * v_side == 0 || a_side * b_side == 0) {
        const bool apart = (a.cwiseMax(b).array() < u.cwiseMin(v).array()).any() ||
                           (u.cwiseMax(v).array() < a.cwiseMin(b).array()).any();
        if (apart) continue;  // on one line
        throw Coincidence();
      }
      if (wall.left < 0 || wall.right < 0) throw Coincidence();  // the box is larger than the domain
      BoundaryCrossing crossing;
      crossing.wall = static_cast<Index>(w);
      crossing.from_tile = a_side > 0 ? wall.left : wall.right;
      crossing.to_tile = a_side > 0 ? wall.right : wall.left;
      found.push_back(crossing);
      segments.emplace_back(u, v);
    }
    const auto along = order_along(a, b, segments);
    if (!along) throw Coincidence();
    for (const int k : along->order) {
      crossings_along_[boundary].push_back(static_cast<Index>(crossings_.size()));
      walls_[found[k].wall].crossings.push_back(static_cast<Index>(crossings_.size()));
      boundary_of_.push_back(boundary);
      found[k].share = along->share[k];
      crossings_.push_back(found[k]);
    }
  }

  void order(CutWall& wall) {
    if (wall.crossings.size() > 1) {
      std::vector<std::pair<Vec2, Vec2>> segments;
      for (const Index x : wall.crossings) segments.push_back(ends(boundary_of_[x], moved_));
      const auto along = order_along(vertex(wall.low), vertex(wall.high), segments);
      if (!along) throw Coincidence();
      std::vector<Index> sorted;
      for (const int k : along->order) sorted.push_back(wall.crossings[k]);
      wall.crossings = std::move(sorted);
    }
    for (std::size_t k = 0; k < wall.crossings.size(); ++k)
      crossings_[wall.crossings[k]].rank = static_cast<Index>(k);
  }

  std::pair<Vec2, Vec2> ends(Index boundary, const Loops& loops) const {
    const auto after = std::upper_bound(first_boundary_.begin(), first_boundary_.end(), boundary);
    const auto l = static_cast<std::size_t>(after - first_boundary_.begin()) - 1;
    const auto e = static_cast<std::size_t>(boundary - first_boundary_[l]);
    return {loops[l][e], loops[l][(e + 1) % loops[l].size()]};
  }

  void place_points() {
    result_.points = t_.vertices;
    result_.lies_on.assign(t_.vertices.size(), -1);
    first_crossing_ = static_cast<Index>(result_.points.size());
    for (std::size_t x = 0; x < crossings_.size(); ++x) {
      const auto [a, b] = ends(boundary_of_[x], loops_);
      result_.points.push_back(a + crossings_[x].share * (b - a));
      result_.lies_on.push_back(boundary_of_[x]);
    }
    first_corner_ = static_cast<Index>(result_.points.size());
    for (const auto& loop : loops_)
      for (const Vec2& p : loop) result_.points.push_back(p), result_.lies_on.push_back(-2);
  }

  /// Cuts the loops into pieces, each of which lies in one tile.
  void divide_boundary() {
    for (std::size_t l = 0; l < loops_.size(); ++l) {
      const auto count = static_cast<Index>(loops_[l].size());
      // All points of the loop: corners and crossings, from the first corner.
      std::vector<std::pair<Index, Index>> way;  // point, crossing or -1
      std::vector<Index> on;                     // edge that starts there
      for (Index e = 0; e < count; ++e) {
        const Index boundary = first_boundary_[l] + e;
        way.emplace_back(corner_point(boundary), -1);
        on.push_back(boundary);
        for (const Index x : crossings_along_[boundary]) {
          way.emplace_back(first_crossing_ + x, x);
          on.push_back(boundary);
        }
      }
      const auto start = std::find_if(way.begin(), way.end(), [](const auto& at) { return at.second >= 0; });
      Index tile = start == way.end() ? tile_around(moved_[l].front()) : crossings_[start->second].to_tile;
      const auto offset = start == way.end() ? 0 : start - way.begin();
      const auto first = static_cast<Index>(pieces_.size());
      const auto total = static_cast<Index>(way.size());
      for (Index k = 0; k < total; ++k) {
        const auto here = static_cast<std::size_t>(k + offset) % way.size();
        const auto there = (here + 1) % way.size();
        BoundaryPiece piece;
        piece.from = way[here].first, piece.to = way[there].first;
        piece.tile = tile;
        piece.boundary = on[here];
        piece.crossing_from = way[here].second, piece.crossing_to = way[there].second;
        piece.before = first + (k + total - 1) % total, piece.after = first + (k + 1) % total;
        if (const Index x = way[here].second; x >= 0) crossings_[x].ahead = static_cast<Index>(pieces_.size());
        if (const Index x = way[there].second; x >= 0) {
          crossings_[x].behind = static_cast<Index>(pieces_.size());
          if (crossings_[x].from_tile != tile) throw Coincidence();
          tile = crossings_[x].to_tile;
        }
        pieces_.push_back(piece);
      }
      if (start == way.end()) lone_.emplace_back(first, static_cast<Index>(l));
    }
  }

  Index tile_around(const Vec2& p) const {
    for (std::size_t t = 0; t < t_.tiles.size(); ++t) {
      const auto& around = t_.tiles[t].vertex;
      bool inside = true;
      for (std::size_t k = 0; k < around.size() && inside; ++k)
        inside = orientation(vertex(around[k]), vertex(around[(k + 1) % around.size()]), p) >= 0;
      if (inside) return static_cast<Index>(t);
    }
    throw Coincidence();
  }

  /// Edges of tiles, cut at the crossings: those of one tile's edge follow each other.
  void make_tile_edges() {
    start_.resize(t_.tiles.size());
    crossed_.resize(t_.tiles.size());
    for (std::size_t t = 0; t < t_.tiles.size(); ++t) {
      start_[t].resize(t_.tiles[t].vertex.size());
      crossed_[t].assign(t_.tiles[t].vertex.size(), -1);
    }
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const CutWall& wall = walls_[w];
      if (wall.left >= 0) crossed_[wall.left][wall.left_edge] = static_cast<Index>(w);
      if (wall.right >= 0) crossed_[wall.right][wall.right_edge] = static_cast<Index>(w);
    }
    for (std::size_t t = 0; t < t_.tiles.size(); ++t)
      for (std::size_t k = 0; k < start_[t].size(); ++k) {
        const CutWall& wall = walls_[crossed_[t][k]];
        const bool left = is_left(wall, t, k);
        start_[t][k] = static_cast<Index>(edges_.size());
        const auto count = static_cast<Index>(wall.crossings.size());
        for (Index j = 0; j <= count; ++j) {
          OverlayEdge edge;
          edge.from = j == 0 ? t_.tiles[t].vertex[k]
                             : first_crossing_ + wall.crossings[left ? j - 1 : count - j];
          tile_of_.push_back(static_cast<Index>(t));
          edges_.push_back(edge);
        }
      }
    for (const CutWall& wall : walls_) {
      if (wall.left < 0 || wall.right < 0) continue;
      const auto count = static_cast<Index>(wall.crossings.size());
      for (Index j = 0; j <= count; ++j) {
        const Index left = start_[wall.left][wall.left_edge] + j, right = start_[wall.right][wall.right_edge] + count - j;
        edges_[left].twin = right;
        edges_[right].twin = left;
      }
    }
  }

  bool is_left(const CutWall& wall, std::size_t tile, std::size_t edge) const {
    return wall.left == static_cast<Index>(tile) && wall.left_edge == static_cast<Index>(edge);
  }

  /// The edge of `tile` that starts at crossing x.
  Index tile_edge_from(Index x, Index tile) const {
    const CutWall& wall = walls_[crossings_[x].wall];
    const auto count = static_cast<Index>(wall.crossings.size());
    return wall.left == tile ? start_[tile][wall.left_edge] + crossings_[x].rank + 1
                             : start_[tile][wall.right_edge] + count - crossings_[x].rank;
  }

  Index forward(Index piece) const { return first_forward_ + 2 * piece; }
  Index backward(Index piece) const { return first_forward_ + 2 * piece + 1; }

  /// Both directions of every boundary piece, and what follows what.
  void join_boundary() {
    first_forward_ = static_cast<Index>(edges_.size());
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const BoundaryPiece& piece = pieces_[p];
      const auto same = static_cast<Index>(p);
      const Index ahead = piece.crossing_to >= 0 ? tile_edge_from(piece.crossing_to, piece.tile) : forward(piece.after);
      const Index back =
          piece.crossing_from >= 0 ? tile_edge_from(piece.crossing_from, piece.tile) : backward(piece.before);
      edges_.push_back({.from = piece.from, .next = ahead, .twin = backward(same), .boundary = piece.boundary});
      edges_.push_back({.from = piece.to, .next = back, .twin = forward(same), .boundary = piece.boundary});
      tile_of_.push_back(piece.tile);
      tile_of_.push_back(piece.tile);
    }
    for (std::size_t t = 0; t < t_.tiles.size(); ++t)
      for (std::size_t k = 0; k < start_[t].size(); ++k) {
        const CutWall& wall = walls_[crossed_[t][k]];
        const bool left = is_left(wall, t, k);
        const auto count = static_cast<Index>(wall.crossings.size());
        for (Index j = 0; j < count; ++j) {
          const BoundaryCrossing& x = crossings_[wall.crossings[left ? j : count - 1 - j]];
          edges_[start_[t][k] + j].next =
              x.to_tile == static_cast<Index>(t) ? forward(x.ahead) : backward(x.behind);
        }
        edges_[start_[t][k] + count].next = start_[t][(k + 1) % start_[t].size()];
      }
  }

  /// Finds the pieces and which of them lie inside.
  void trace() {
    std::vector<int> inside;  // per piece: 1, 0, or -1 while unknown
    for (std::size_t first = 0; first < edges_.size(); ++first) {
      if (edges_[first].piece >= 0) continue;
      const auto piece = static_cast<Index>(result_.pieces.size());
      result_.pieces.push_back({.tile = tile_of_[first], .first = static_cast<Index>(first)});
      inside.push_back(-1);
      auto e = static_cast<Index>(first);
      do {
        if (e < 0 || edges_[e].piece >= 0 || tile_of_[e] != tile_of_[first]) throw Coincidence();
        edges_[e].piece = piece;
        e = edges_[e].next;
      } while (e != static_cast<Index>(first));
    }
    std::vector<Index> queue;
    const auto set = [&](Index piece, int value) {
      if (inside[piece] == 1 - value) throw Coincidence();
      if (inside[piece] < 0) queue.push_back(piece);
      inside[piece] = value;
    };
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const bool on_boundary = static_cast<Index>(e) >= first_forward_;
      if (on_boundary) set(edges_[e].piece, (static_cast<Index>(e) - first_forward_) % 2 == 0);
      if (!on_boundary && edges_[e].twin < 0) set(edges_[e].piece, 0);
    }
    while (!queue.empty()) {
      const Index piece = queue.back();
      queue.pop_back();
      Index e = result_.pieces[piece].first;
      do {
        if (e < first_forward_ && edges_[e].twin >= 0) set(edges_[edges_[e].twin].piece, inside[piece]);
        e = edges_[e].next;
      } while (e != result_.pieces[piece].first);
    }
    for (const auto& [piece, loop] : lone_) result_.pieces[edges_[forward(piece)].piece].lone_loop = loop;
    inside_ = std::move(inside);
  }

  Overlay inside_only() {
    std::vector<Index> edge_id(edges_.size(), -1), piece_id(result_.pieces.size(), -1);
    std::vector<Piece> pieces;
    for (std::size_t p = 0; p < result_.pieces.size(); ++p) {
      if (inside_[p] != 1) continue;
      piece_id[p] = static_cast<Index>(pieces.size());
      pieces.push_back(result_.pieces[p]);
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (piece_id[edges_[e].piece] < 0) continue;
      edge_id[e] = static_cast<Index>(result_.edges.size());
      result_.edges.push_back(edges_[e]);
      result_.edges.back().piece = piece_id[edges_[e].piece];
    }
    for (OverlayEdge& edge : result_.edges) {
      edge.next = edge_id[edge.next];
      edge.twin = edge.twin < 0 ? -1 : edge_id[edge.twin];
    }
    for (Piece& piece : pieces) {
      piece.first = edge_id[piece.first];
      const auto polygon = polygon_of(result_, piece);
      piece.area = polygon_area(polygon.data(), static_cast<Index>(polygon.size()));
    }
    result_.pieces = std::move(pieces);
    return std::move(result_);
  }

  const Tessellation& t_;
  const Loops &loops_, &moved_;
  std::vector<CutWall> walls_;
  std::vector<Index> first_boundary_;  // per loop
  Index boundaries_ = 0;               // edges of all loops
  std::vector<BoundaryCrossing> crossings_;
  std::vector<Index> boundary_of_;                   // per crossing
  std::vector<std::vector<Index>> crossings_along_;  // per edge of the domain, in its order
  std::vector<BoundaryPiece> pieces_;
  std::vector<std::pair<Index, Index>> lone_;  // a boundary piece of each loop that crosses no wall, and the loop
  Index first_crossing_ = 0, first_corner_ = 0, first_forward_ = 0;
  std::vector<std::vector<Index>> start_, crossed_;  // per tile and edge: its first OverlayEdge, its wall
  std::vector<OverlayEdge> edges_;                   // of all pieces, inside or not
  std::vector<Index> tile_of_;                       // per edge
  std::vector<int> inside_;
  Overlay result_;
};

Loops displaced(const Loops& loops, double amplitude) {
  Random random(1);
  Loops moved = loops;
  for (auto& loop : moved)
    for (Vec2& p : loop) p += amplitude * Vec2(2 * random.unit() - 1, 2 * random.unit() - 1);
  return moved;
}

}  // namespace

Overlay overlay(const Tessellation& tessellation, const Loops& loops) {
  double area = 0;
  for (const auto& loop : loops) area += polygon_area(loop.data(), static_cast<Index>(loop.size()));
  const double size = std::sqrt(std::abs(area) / static_cast<double>(tessellation.tiles.size()));
  for (int attempt = 0; attempt < 8; ++attempt) {
    try {
      const Loops moved = attempt == 0 ? loops : displaced(loops, 1e-9 * size * std::pow(1.7, attempt - 1));
      Overlay result = Overlayer(tessellation, loops, moved).make();
      result.moved = attempt > 0;
      return result;
    } catch (const Coincidence&) {
    }
  }
  throw SceneError(
      "sample.domain: its boundary and the walls of the tissue coincide in a way that cannot be told apart; move the "
      "domain's corners a little, or choose another seed");
}

std::vector<Vec2> polygon_of(const Overlay& overlay, const Piece& piece) {
  std::vector<Vec2> points;
  Index e = piece.first;
  do {
    points.push_back(overlay.points[overlay.edges[e].from]);
    e = overlay.edges[e].next;
  } while (e != piece.first);
  return points;
}

}  // namespace lamella
