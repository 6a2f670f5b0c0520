#include "generator/image/boundaries.h"

#include <array>
#include <cassert>
#include <unordered_map>

namespace lamella {
namespace {

/// Directions on the lattice, clockwise to the eye: east, south, west, north.
constexpr std::array<Lattice, 4> kStep{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
constexpr int opposite(int direction) { return (direction + 2) % 4; }

/// The regions on both sides of a side of a pixel, as seen along it.
struct Sides {
  Index left = 0, right = 0;
  bool is_boundary() const { return left != right && (left >= 0 || right >= 0); }
};

class Tracing {
 public:
  explicit Tracing(const LabelImage& labels) : labels_(labels) {
    done_.assign(static_cast<std::size_t>(labels.width + 1) * (labels.height + 1), 0);
  }

  Boundaries run() {
    result_.width = labels_.width;
    result_.height = labels_.height;
    visit_corners([&](const Lattice& at) {
      if (is_node(at)) {
        node_of_.emplace(key(at), static_cast<Index>(result_.node.size()));
        result_.node.push_back(at);
      }
    });
    for (Index n = 0, count = static_cast<Index>(result_.node.size()); n < count; ++n) trace_from(n);
    // What is left has no junction: closed walls, each begun at its first corner.
    visit_corners([&](const Lattice& at) {
      if (!is_open(at, 0) || is_done(at, 0)) return;
      node_of_.emplace(key(at), static_cast<Index>(result_.node.size()));
      result_.node.push_back(at);
      trace_from(static_cast<Index>(result_.node.size()) - 1);
    });
    assemble_outlines();
    return std::move(result_);
  }

 private:
  std::size_t key(const Lattice& at) const { return static_cast<std::size_t>(at.y) * (labels_.width + 1) + at.x; }

  Index region(int x, int y) const {
    if (x < 0) return kBeyondLeft;
    if (x >= labels_.width) return kBeyondRight;
    if (y < 0) return kBeyondTop;
    if (y >= labels_.height) return kBeyondBottom;
    return labels_.cell[labels_.at(x, y)];
  }

  Sides sides(const Lattice& at, int direction) const {
    const Index ne = region(at.x, at.y - 1), se = region(at.x, at.y);
    const Index nw = region(at.x - 1, at.y - 1), sw = region(at.x - 1, at.y);
    switch (direction) {
      case 0:
        return {ne, se};
      case 1:
        return {se, sw};
      case 2:
        return {sw, nw};
      default:
        return {nw, ne};
    }
  }

  bool is_open(const Lattice& at, int direction) const { return sides(at, direction).is_boundary(); }

  bool is_node(const Lattice& at) const {
    int count = 0;
    std::array<Sides, 4> met;
    for (int d = 0; d < 4; ++d) {
      const Sides s = sides(at, d);
      if (s.is_boundary()) met[static_cast<std::size_t>(count++)] = s;
    }
    // One goes out, the other comes in: what is on the left of one is on the right of the other.
    return count > 2 || (count == 2 && (met[0].left != met[1].right || met[0].right != met[1].left));
  }

  /// All corners with a boundary, row by row.
  template <class See>
  void visit_corners(See&& see) const {
    const int w = labels_.width;
    for (int y = 0; y <= labels_.height; ++y)
      for (int x = 0; x <= w; ++x) {
        if (x > 0 && y > 0 && x < w && y < labels_.height) {
          const Index* here = labels_.cell.data() + labels_.at(x, y);
          if (here[0] == here[-1] && here[0] == here[-w] && here[0] == here[-w - 1]) continue;
        }
        see(Lattice{x, y});
      }
  }

  bool is_done(const Lattice& at, int direction) const { return done_[key(at)] >> direction & 1; }

  void trace_from(Index node) {
    for (int d = 0; d < 4; ++d)
      if (is_open(result_.node[node], d) && !is_done(result_.node[node], d)) trace(node, d);
  }

  void trace(Index node, int direction) {
    BoundaryWall wall;
    const Sides s = sides(result_.node[node], direction);
    wall.left = s.left;
    wall.right = s.right;
    wall.begin = node;
    Lattice at = result_.node[node];
    wall.corner.push_back(at);
    while (true) {
      done_[key(at)] |= static_cast<char>(1 << direction);
      at = {at.x + kStep[direction].x, at.y + kStep[direction].y};
      done_[key(at)] |= static_cast<char>(1 << opposite(direction));
      if (const auto end = node_of_.find(key(at)); end != node_of_.end()) {
        wall.end = end->second;
        break;
      }
      for (const int turn : {0, 1, 3}) {
        const int next = (direction + turn) % 4;
        if (!is_open(at, next)) continue;
        if (turn != 0) wall.corner.push_back(at);
        direction = next;
        break;
      }
    }
    wall.corner.push_back(at);
    result_.walls.push_back(std::move(wall));
  }

  void assemble_outlines() {
    std::vector<std::vector<WallUse>> uses(labels_.number.size());
    for (std::size_t w = 0; w < result_.walls.size(); ++w) {
      const BoundaryWall& wall = result_.walls[w];
      if (wall.left >= 0) uses[wall.left].push_back({static_cast<Index>(w), true});
      if (wall.right >= 0) uses[wall.right].push_back({static_cast<Index>(w), false});
    }
    for (auto& of_cell : uses) {
      std::unordered_map<Index, WallUse> from;  // by the node that it begins at
      for (const WallUse& use : of_cell) {
        const BoundaryWall& wall = result_.walls[use.wall];
        from.emplace(use.forward ? wall.begin : wall.end, use);
      }
      assert(from.size() == of_cell.size());
      std::vector<WallUse> outline;
      for (WallUse use = of_cell.front(); outline.size() < of_cell.size();) {
        outline.push_back(use);
        const BoundaryWall& wall = result_.walls[use.wall];
        use = from.at(use.forward ? wall.end : wall.begin);
      }
      result_.outline.push_back(std::move(outline));
    }
  }

  const LabelImage& labels_;
  Boundaries result_;
  std::vector<char> done_;  // per corner: directions that are traced, as bits
  std::unordered_map<std::size_t, Index> node_of_;
};

}  // namespace

Boundaries trace_boundaries(const LabelImage& labels) { return Tracing(labels).run(); }

}  // namespace lamella
