#include "generator/tissue/picture_walls.h"
#include "generator/sample/union_find.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "generator/image/lattice_lines.h"
#include "generator/tissue/crossings.h"

namespace lamella {
namespace {

/// Sides of the picture on which a corner lies, as bits; a vertex must stay on them.
int sides_at(const Lattice& p, const Boundaries& in) {
  return (p.x == 0 ? 1 : 0) | (p.x == in.width ? 2 : 0) | (p.y == in.height ? 4 : 0) | (p.y == 0 ? 8 : 0);
}

struct Edge {
  Lattice from, to;
  Index begin = 0, end = 0;  // vertices
  Index wall = 0;
};

bool is_on(const Lattice& p, const Edge& e) { return turn(e.from, e.to, p) == 0 && dot(p, e.from, e.to) <= 0; }

/// Whether x lies strictly within the angle at v that opens from a counter-clockwise to b, to the eye: y counts downwards.
bool is_between(const Lattice& v, const Lattice& a, const Lattice& b, const Lattice& x) {
  const std::int64_t angle = -turn(v, a, b);
  if (angle > 0) return -turn(v, a, x) > 0 && -turn(v, x, b) > 0;
  if (angle < 0) return -turn(v, b, x) < 0 || -turn(v, x, a) < 0;
  return -turn(v, a, x) > 0;
}

int sign(std::int64_t value) { return (value > 0) - (value < 0); }

/// Whether two edges have a point in common that they should not.
bool collide(const Edge& s, const Edge& t) {
  const int shared = (s.begin == t.begin || s.begin == t.end) + (s.end == t.begin || s.end == t.end);
  if (shared == 2) return true;
  if (shared == 1) {
    const bool at_begin = s.begin == t.begin || s.begin == t.end;
    const Lattice& other = at_begin ? s.to : s.from;
    const Lattice& far = t.begin == s.begin || t.begin == s.end ? t.to : t.from;
    return is_on(other, t) || is_on(far, s);
  }
  if (is_on(s.from, t) || is_on(s.to, t) || is_on(t.from, s) || is_on(t.to, s)) return true;
  return sign(turn(s.from, s.to, t.from)) * sign(turn(s.from, s.to, t.to)) < 0 &&
         sign(turn(t.from, t.to, s.from)) * sign(turn(t.from, t.to, s.to)) < 0;
}

/// Walls as edges, for the tolerances and welds as they are at the moment.
class Simplification {
 public:
  Simplification(const Boundaries& in, double tolerance, double weld)
      : in_(in), asked_(tolerance), tolerance_(in.walls.size(), tolerance), welded_(in.walls.size(), 0) {
    choose_welds(weld);
  }

  SimplifiedWalls run() {
    while (true) {
      place_nodes();
      make_edges();
      std::set<Index> faulty;
      find_collisions(faulty);
      find_edges_of_nodes();
      for (std::size_t c = 0; c < in_.outline.size(); ++c) check_cell(c, faulty);
      if (faulty.empty()) return result();
      refine(faulty);
    }
  }

 private:
  void choose_welds(double weld) {
    std::vector<double> length(in_.walls.size());
    double sum = 0;
    int count = 0;
    for (std::size_t w = 0; w < in_.walls.size(); ++w) {
      length[w] = length_of(simplified(in_.walls[w].corner, asked_));
      if (in_.walls[w].left < 0 || in_.walls[w].right < 0) continue;
      sum += length[w];
      ++count;
    }
    const double shortest = count > 0 ? weld * sum / count : 0;
    for (std::size_t w = 0; w < in_.walls.size(); ++w)
      welded_[w] = length[w] < shortest && in_.walls[w].begin != in_.walls[w].end;
  }

  /// Nodes that welded walls join lie at the middle of those with the most sides of the picture.
  void place_nodes() {
    while (true) {
      node_ = UnionFind(static_cast<Index>(in_.node.size()));
      for (std::size_t w = 0; w < welded_.size(); ++w)
        if (welded_[w]) node_.join(in_.walls[w].begin, in_.walls[w].end);
      std::map<Index, std::vector<Index>> group;
      for (Index n = 0; n < node_.size(); ++n)
        if (const Index top = node_.root(n); top != n) group[top].push_back(n);
      place_ = in_.node;
      std::set<Index> impossible;
      for (auto& [top, members] : group) {
        members.push_back(top);
        if (!place_group(top, members)) impossible.insert(top);
      }
      if (impossible.empty()) return;
      for (std::size_t w = 0; w < welded_.size(); ++w)
        if (impossible.contains(node_.root(in_.walls[w].begin))) welded_[w] = 0;
    }
  }

  bool place_group(Index top, const std::vector<Index>& members) {
    int all = 0;
    for (const Index n : members) all |= sides_at(in_.node[n], in_);
    std::int64_t x = 0, y = 0, count = 0;
    for (const Index n : members) {
      if (sides_at(in_.node[n], in_) != all) continue;
      x += in_.node[n].x;
      y += in_.node[n].y;
      ++count;
    }
    if (count == 0) return false;  // on two sides, and none at the corner between them
    place_[top] = {static_cast<int>((2 * x + count) / (2 * count)), static_cast<int>((2 * y + count) / (2 * count))};
    return true;
  }

  void make_edges() {
    vertices_ = place_;
    edges_.clear();
    first_edge_.assign(1, 0);
    for (std::size_t w = 0; w < in_.walls.size(); ++w) {
      if (!welded_[w]) add_edges(static_cast<Index>(w));
      first_edge_.push_back(edges_.size());
    }
  }

  void add_edges(Index w) {
    const BoundaryWall& wall = in_.walls[w];
    const Index begin = node_.root(wall.begin), end = node_.root(wall.end);
    auto corner = wall.corner;
    corner.front() = place_[begin];
    corner.back() = place_[end];
    const auto points = simplified(corner, tolerance_[w]);
    Index last = begin;
    for (std::size_t k = 1; k < points.size(); ++k) {
      Index next = end;
      if (k + 1 < points.size()) {
        next = static_cast<Index>(vertices_.size());
        vertices_.push_back(points[k]);
      }
      edges_.push_back({points[k - 1], points[k], last, next, w});
      last = next;
    }
  }

  void find_collisions(std::set<Index>& faulty) const {
    double length = 0;
    for (const Edge& e : edges_) length += distance(e.from, e.to);
    const Box box{Vec2::Zero(), Vec2(in_.width, in_.height)};
    Grid grid(box, length / static_cast<double>(edges_.size()), edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const Edge& e = edges_[i];
      if (e.from == e.to) faulty.insert(e.wall);
      const Vec2 lo(std::min(e.from.x, e.to.x), std::min(e.from.y, e.to.y));
      const Vec2 hi(std::max(e.from.x, e.to.x), std::max(e.from.y, e.to.y));
      grid.visit(lo, hi, [&](int other) {
        if (!collide(e, edges_[other])) return;
        faulty.insert(e.wall);
        faulty.insert(edges_[other].wall);
      });
      grid.add(static_cast<int>(i), lo, hi);
    }
  }

  SimplifiedWalls::Cell cell_of(std::size_t c) const {
    SimplifiedWalls::Cell cell;
    for (const WallUse& use : in_.outline[c]) {
      const BoundaryWall& wall = in_.walls[use.wall];
      const std::size_t first = first_edge_[use.wall], last = first_edge_[use.wall + 1];
      for (std::size_t k = 0; k < last - first; ++k) {
        const Edge& e = edges_[use.forward ? first + k : last - 1 - k];
        cell.vertex.push_back(use.forward ? e.begin : e.end);
        cell.beyond.push_back(use.forward ? wall.right : wall.left);
      }
    }
    return cell;
  }

  void find_edges_of_nodes() {
    at_node_.assign(in_.node.size(), {});
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (const Index v : {edges_[e].begin, edges_[e].end})
        if (v < static_cast<Index>(at_node_.size())) at_node_[v].push_back(static_cast<Index>(e));
  }

  /// Nothing may lie between the two edges of a cell at a node.
  void check_corner(Index before, Index at, Index after, std::set<Index>& faulty) const {
    if (at >= static_cast<Index>(at_node_.size())) return;
    for (const Index e : at_node_[at]) {
      const Index other = edges_[e].begin == at ? edges_[e].end : edges_[e].begin;
      if (other == before || other == after) continue;
      if (!is_between(vertices_[at], vertices_[after], vertices_[before], vertices_[other])) continue;
      for (const Index all : at_node_[at]) faulty.insert(edges_[all].wall);
    }
  }

  /// A cell must be a polygon that passes every vertex once and encloses an area on its left. That it does not cross
  /// itself, nor a neighbour, is known from its edges.
  void check_cell(std::size_t c, std::set<Index>& faulty) const {
    auto vertex = cell_of(c).vertex;
    std::int64_t twice = 0;  // y counts downwards: to the eye counter-clockwise is negative
    for (std::size_t k = 1; k + 1 < vertex.size(); ++k)
      twice += turn(vertices_[vertex[0]], vertices_[vertex[k]], vertices_[vertex[k + 1]]);
    for (std::size_t k = 0, n = vertex.size(); k < n; ++k)
      check_corner(vertex[(k + n - 1) % n], vertex[k], vertex[(k + 1) % n], faulty);
    std::sort(vertex.begin(), vertex.end());
    const bool repeats = std::adjacent_find(vertex.begin(), vertex.end()) != vertex.end();
    if (vertex.size() >= 3 && twice < 0 && !repeats) return;
    for (const WallUse& use : in_.outline[c]) faulty.insert(use.wall);
  }

  /// Halves the tolerances of walls, down to the pixels' own boundary; where that is reached the welds at their ends go.
  void refine(const std::set<Index>& faulty) {
    bool changed = false;
    for (const Index w : faulty) {
      if (tolerance_[w] <= 0) continue;
      tolerance_[w] = tolerance_[w] > 0.5 ? tolerance_[w] / 2 : 0;
      changed = true;
    }
    if (changed) return;
    std::set<Index> ends;
    for (const Index w : faulty) ends.insert({node_.root(in_.walls[w].begin), node_.root(in_.walls[w].end)});
    for (std::size_t w = 0; w < welded_.size(); ++w)
      if (welded_[w] && ends.contains(node_.root(in_.walls[w].begin))) {
        welded_[w] = 0;
        changed = true;
      }
    if (!changed) throw std::logic_error("the boundaries of a picture are not sound");
  }

  SimplifiedWalls result() const {
    SimplifiedWalls walls;
    walls.vertices = vertices_;
    for (std::size_t c = 0; c < in_.outline.size(); ++c) walls.cells.push_back(cell_of(c));
    walls.welded = static_cast<int>(std::count(welded_.begin(), welded_.end(), 1));
    walls.refined =
        static_cast<int>(std::count_if(tolerance_.begin(), tolerance_.end(), [&](double t) { return t < asked_; }));
    return walls;
  }

  const Boundaries& in_;
  double asked_;
  std::vector<double> tolerance_;  // per wall [pixels]
  std::vector<char> welded_;       // per wall
  UnionFind node_;                 // joined nodes
  std::vector<Lattice> place_;     // per node
  std::vector<Lattice> vertices_;
  std::vector<Edge> edges_;
  std::vector<std::size_t> first_edge_;      // walls + 1
  std::vector<std::vector<Index>> at_node_;  // edges that begin or end there
};

}  // namespace

SimplifiedWalls simplify_walls(const Boundaries& boundaries, double tolerance, double weld) {
  return Simplification(boundaries, tolerance, weld).run();
}

}  // namespace lamella
