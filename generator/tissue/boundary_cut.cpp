#include "generator/tissue/boundary_cut.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "generator/packing/exact_signs.h"
#include "generator/tissue/crossings.h"

namespace lamella {
namespace {

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

class Cutter {
 public:
  Cutter(const Tessellation& tessellation, const Loops& loops) : t_(tessellation), loops_(loops) {
    result_.walls = walls_of(tessellation);
    for (const auto& loop : loops) {
      first_boundary_.push_back(boundaries_);
      boundaries_ += static_cast<Index>(loop.size());
    }
  }

  BoundaryCut cut() {
    find_crossings();
    for (std::size_t l = 0; l < loops_.size(); ++l) divide(l);
    return std::move(result_);
  }

 private:
  const Vec2& vertex(Index v) const { return t_.vertices[v]; }

  void find_crossings() {
    Grid grid(t_.box, 0, result_.walls.size());
    for (std::size_t w = 0; w < result_.walls.size(); ++w) {
      const Vec2 &u = vertex(result_.walls[w].low), &v = vertex(result_.walls[w].high);
      grid.add(static_cast<int>(w), u.cwiseMin(v), u.cwiseMax(v));
    }
    const double step = std::sqrt(t_.box.area() / static_cast<double>(t_.tiles.size()));
    crossings_along_.resize(static_cast<std::size_t>(boundaries_));
    for (std::size_t l = 0; l < loops_.size(); ++l)
      for (std::size_t e = 0; e < loops_[l].size(); ++e) {
        const Vec2 &a = loops_[l][e], &b = loops_[l][(e + 1) % loops_[l].size()];
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
    for (CutWall& wall : result_.walls) order(wall);
  }

  /// Crossings of one edge of the domain, in its order.
  void cross(Index boundary, const Vec2& a, const Vec2& b, const std::set<int>& near) {
    std::vector<BoundaryCrossing> found;
    std::vector<std::pair<Vec2, Vec2>> segments;
    for (const int w : near) {
      const CutWall& wall = result_.walls[w];
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
      crossings_along_[boundary].push_back(static_cast<Index>(result_.crossings.size()));
      result_.walls[found[k].wall].crossings.push_back(static_cast<Index>(result_.crossings.size()));
      found[k].boundary = boundary;
      found[k].share = along->share[k];
      result_.crossings.push_back(found[k]);
    }
  }

  void order(CutWall& wall) {
    if (wall.crossings.size() > 1) {
      std::vector<std::pair<Vec2, Vec2>> segments;
      for (const Index x : wall.crossings) segments.push_back(ends(result_.crossings[x].boundary));
      const auto along = order_along(vertex(wall.low), vertex(wall.high), segments);
      if (!along) throw Coincidence();
      std::vector<Index> sorted;
      for (const int k : along->order) sorted.push_back(wall.crossings[k]);
      wall.crossings = std::move(sorted);
    }
    for (std::size_t k = 0; k < wall.crossings.size(); ++k)
      result_.crossings[wall.crossings[k]].rank = static_cast<Index>(k);
  }

  std::pair<Vec2, Vec2> ends(Index boundary) const {
    const auto after = std::upper_bound(first_boundary_.begin(), first_boundary_.end(), boundary);
    const auto l = static_cast<std::size_t>(after - first_boundary_.begin()) - 1;
    const auto e = static_cast<std::size_t>(boundary - first_boundary_[l]);
    return {loops_[l][e], loops_[l][(e + 1) % loops_[l].size()]};
  }

  /// Cuts a loop into pieces, each of which lies in one tile.
  void divide(std::size_t l) {
    // Where pieces start: corners and crossings, from the first corner.
    struct Start {
      Index boundary, crossing;  // -1: the corner
    };
    std::vector<Start> starts;
    for (Index e = 0; e < static_cast<Index>(loops_[l].size()); ++e) {
      const Index boundary = first_boundary_[l] + e;
      starts.push_back({boundary, -1});
      for (const Index x : crossings_along_[boundary]) starts.push_back({boundary, x});
    }
    auto& crossings = result_.crossings;
    const auto entry = std::find_if(starts.begin(), starts.end(), [](const Start& at) { return at.crossing >= 0; });
    const bool alone = entry == starts.end();
    if (!alone) std::rotate(starts.begin(), entry, starts.end());
    Index tile = alone ? tile_around(loops_[l].front()) : crossings[starts.front().crossing].to_tile;
    const auto first = static_cast<Index>(result_.pieces.size());
    const auto total = static_cast<Index>(starts.size());
    for (Index k = 0; k < total; ++k) {
      const Index from = starts[k].crossing, to = starts[(k + 1) % total].crossing;
      result_.pieces.push_back(
          {tile, starts[k].boundary, from, to, first + (k + total - 1) % total, first + (k + 1) % total});
      if (from >= 0) crossings[from].ahead = first + k;
      if (to < 0) continue;
      crossings[to].behind = first + k;
      if (crossings[to].from_tile != tile) throw Coincidence();
      tile = crossings[to].to_tile;
    }
    if (alone) result_.lone.emplace_back(first, static_cast<Index>(l));
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

  const Tessellation& t_;
  const Loops& loops_;
  std::vector<Index> first_boundary_;                // per loop
  Index boundaries_ = 0;                             // edges of all loops
  std::vector<std::vector<Index>> crossings_along_;  // per edge of the domain, in its order
  BoundaryCut result_;
};

}  // namespace

BoundaryCut cut_boundary(const Tessellation& tessellation, const Loops& loops) {
  return Cutter(tessellation, loops).cut();
}

}  // namespace lamella
