// Which nodes can touch which shells before anything has moved by half a skin: a Verlet list over a uniform grid of segments.
//
// The list is in a canonical order (by node, then cell, then image, then segment) and pairs out of reach add nothing to any sum, so that when
// the list was made cannot change a result.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "generator/sample/broken_bars.h"
#include "simulator/positions.h"

namespace lamella {

/// A node, or in a periodic sample an image of it, and the segments of one cell that it may touch.
struct Pair {
  Index node = 0, cell = 0;
  Index first = 0, count = 0;  // into CandidateList::segments
  Image image{0, 0};           // seen from the cell, the node lies at x[node] + displacement(image)
};

struct CandidateList {
  std::vector<Pair> pairs;      // sorted by node, then cell, then image
  std::vector<Index> segments;  // of each pair in increasing order

  std::span<const Index> of(const Pair& pair) const {
    return {segments.data() + pair.first, static_cast<std::size_t>(pair.count)};
  }
};

/// How much of its own shell a node ignores on either side: two segments, the length pi r within which a wall cannot fold back on itself,
/// and what lies nearer than 2 r around a sharp corner of the shape at rest.
class SelfReach {
 public:
  explicit SelfReach(const Sample& sample);
  /// `broken` may be null. What lies beyond a broken bar is no neighbour any more, unless it lay nearer than 2 r at rest.
  bool ignores(const Sample& sample, const BrokenBars* broken, Index cell, Index node, Index segment) const;
  std::size_t bytes() const { return (before_.size() + after_.size()) * sizeof(Index); }

 private:
  std::vector<Index> before_, after_;  // segments, per node
};

/// Nodes that are or were linked: while a link is intact, its nodes ignore the segments that meet at each other.
class LinkedNodes {
 public:
  LinkedNodes(const Sample& sample, const std::vector<Index>& cell_of);
  struct Partner {
    Index link = 0, node = 0, cell = 0;
    Image image{0, 0};  // of the node whose partner this is, seen from the partner's cell
  };
  std::span<const Partner> of(Index node) const {
    return {partners_.data() + begin_[node], static_cast<std::size_t>(begin_[node + 1] - begin_[node])};
  }
  bool ignores(const Sample& sample, Index node, Index cell, const Image& image, Index segment) const;
  bool intact(Index link) const { return intact_[link] != 0; }
  void set_intact(Index link, std::uint8_t intact) { intact_[link] = intact; }
  std::size_t bytes() const;

 private:
  std::vector<Index> begin_;
  std::vector<Partner> partners_;
  std::vector<std::uint8_t> intact_;  // per link
};

/// Who may touch whom.
struct CandidateRules {
  const Sample& sample;
  const std::vector<Index>& cell_of;
  const std::vector<std::uint8_t>& bare;  // per cell
  const SelfReach& self_reach;
  const LinkedNodes& linked;
  double skin = 0;                     // [m]
  const BrokenBars* broken = nullptr;  // null: all bars stand

  bool gone(Index segment) const { return broken && broken->gone(segment); }
  /// Whether the list must name this node, or this image of it, and segment when the nodes are at x.
  bool candidates(const Field& x, Index node, Index cell, Index segment, const Image& image = {0, 0}) const;
};

CandidateList find_candidates(const CandidateRules& rules, const Field& x);

/// Squared distance of p from the segment (a, b).
double squared_distance(const Vec2& p, const Vec2& a, const Vec2& b);

}  // namespace lamella
