// Tiles: the cells of a diagram of the plane, cut off at those sides of the box that are not periodic.
#pragma once
#include <array>
#include <unordered_map>
#include <vector>

#include "generator/packing/laguerre.h"
#include "generator/packing/plane_diagram.h"

namespace lamella {

class TileMaker {
 public:
  /// Appends to `vertices`, in the coordinates that the sites were given in.
  TileMaker(const PlaneDiagram& plane, std::vector<Vec2>& vertices);

  /// The tile of a site: without vertices when it has no part in the box. Its sites are numbered as in the diagram.
  void make(Index site, Tile& tile);

  /// The whole box, for the site that owns it when no site has a tile.
  bool make_whole_box(Tile& tile);

 private:
  /// An end of what the box leaves of an edge: a vertex of the diagram (side -1), or a point on a side (0 .. 3, ccw).
  struct EdgeEnd {
    Index vertex = -1;  // id in the result
    Image image{0, 0};
    int side = -1;
  };
  struct Cut {
    bool empty = true;
    EdgeEnd begin, end;
  };
  struct Side {
    EdgeEnd begin, end;
    Copy neighbour;
  };
  struct Axis;
  using Key = std::array<Index, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };

  bool make_uncut(Index site, Tile& tile);
  void make_cut(Index site, Tile& tile);
  void place(Tile& tile) const;
  Cut cut_edge(Index site, Index k);
  Cut cut_edge(const PowerSite& a, const PowerSite& b, const Copy& begin, const Copy& end);
  EdgeEnd crossing(const Axis& axis, bool at_exit);
  Index vertex(Index v);
  Vec2 position(const Copy& vertex) const;
  Index add_vertex(const Vec2& p);
  void add_boundary(Tile& tile, int side, int count);
  int corners_between(Index site, const EdgeEnd& from, const EdgeEnd& to, std::size_t gaps) const;
  bool owns(Index site, const Vec2& p) const;
  double power(Index site, const Vec2& p) const;
  Vec2 corner_position(int q) const;

  const PlaneDiagram& plane_;
  const PowerDiagram& d_;
  const bool periodic_;
  std::vector<Vec2>& vertices_;
  std::vector<Index> id_;  // of the diagram's vertices in the result; kUnused and kOutside
  std::array<Index, 4> corner_;
  std::unordered_map<Key, Cut, Hash> cuts_;  // edges with an end outside, cut once for both their tiles
  std::vector<Side> chain_;                  // of the tile at work
};

}  // namespace lamella
