#include "generator/tissue/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/packing/random.h"
#include "generator/sample/errors.h"
#include "generator/sample/polygon.h"
#include "generator/tissue/boundary_cut.h"

namespace lamella {
namespace {

class Overlayer {
 public:
  /// `cut` decides, `loops` says where the boundary is.
  Overlayer(const Tessellation& tessellation, const Loops& loops, const BoundaryCut& cut)
      : t_(tessellation), walls_(cut.walls), crossings_(cut.crossings), pieces_(cut.pieces), lone_(cut.lone) {
    for (const auto& loop : loops)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        boundary_.emplace_back(loop[k], loop[(k + 1) % loop.size()]);
        next_boundary_.push_back(k + 1 < loop.size() ? static_cast<Index>(boundary_.size())
                                                     : static_cast<Index>(boundary_.size() - loop.size()));
      }
  }

  Overlay make() {
    place_points();
    make_tile_edges();
    join_boundary();
    trace();
    return inside_only();
  }

 private:
  /// The point where a piece of the boundary starts or ends.
  Index start_of(const BoundaryPiece& piece) const {
    return piece.crossing_from >= 0 ? first_crossing_ + piece.crossing_from : first_corner_ + piece.boundary;
  }
  Index end_of(const BoundaryPiece& piece) const {
    return piece.crossing_to >= 0 ? first_crossing_ + piece.crossing_to
                                  : first_corner_ + next_boundary_[piece.boundary];
  }

  void place_points() {
    result_.points = t_.vertices;
    result_.lies_on.assign(t_.vertices.size(), -1);
    first_crossing_ = static_cast<Index>(result_.points.size());
    for (const BoundaryCrossing& x : crossings_) {
      const auto& [a, b] = boundary_[x.boundary];
      result_.points.push_back(a + x.share * (b - a));
      result_.lies_on.push_back(x.boundary);
    }
    first_corner_ = static_cast<Index>(result_.points.size());
    for (const auto& [a, b] : boundary_) result_.points.push_back(a), result_.lies_on.push_back(-2);
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
          edge.from = j == 0 ? t_.tiles[t].vertex[k] : first_crossing_ + wall.crossings[left ? j - 1 : count - j];
          tile_of_.push_back(static_cast<Index>(t));
          edges_.push_back(edge);
        }
      }
    for (const CutWall& wall : walls_) {
      if (wall.left < 0 || wall.right < 0) continue;
      const auto count = static_cast<Index>(wall.crossings.size());
      for (Index j = 0; j <= count; ++j) {
        const Index left = start_[wall.left][wall.left_edge] + j,
                    right = start_[wall.right][wall.right_edge] + count - j;
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
      edges_.push_back({.from = start_of(piece), .next = ahead, .twin = backward(same), .boundary = piece.boundary});
      edges_.push_back({.from = end_of(piece), .next = back, .twin = forward(same), .boundary = piece.boundary});
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
          edges_[start_[t][k] + j].next = x.to_tile == static_cast<Index>(t) ? forward(x.ahead) : backward(x.behind);
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
      piece.area = polygon_area(polygon);
    }
    result_.pieces = std::move(pieces);
    return std::move(result_);
  }

  const Tessellation& t_;
  const std::vector<CutWall>& walls_;
  const std::vector<BoundaryCrossing>& crossings_;
  const std::vector<BoundaryPiece>& pieces_;
  const std::vector<std::pair<Index, Index>>& lone_;
  std::vector<std::pair<Vec2, Vec2>> boundary_;  // edges of all loops
  std::vector<Index> next_boundary_;             // the edge that follows each
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
  double area = 0, farthest = 0;
  for (const auto& loop : loops) {
    area += polygon_area(loop);
    for (const Vec2& p : loop) farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  }
  const double size = std::sqrt(std::abs(area) / static_cast<double>(tessellation.tiles.size()));
  const double amplitude = std::max(1e-9 * size, 1e-15 * farthest);  // no less than coordinates resolve
  for (int attempt = 0; attempt < 8; ++attempt) {
    try {
      const BoundaryCut cut =
          cut_boundary(tessellation, attempt == 0 ? loops : displaced(loops, amplitude * std::pow(1.7, attempt - 1)));
      Overlay result = Overlayer(tessellation, loops, cut).make();
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
