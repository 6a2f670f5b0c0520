#include "postproc/quantities/crack_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "generator/sample/union_find.h"
#include "postproc/quantities/fragments.h"
#include "postproc/quantities/link_frame.h"
#include "postproc/quantities/loop_around.h"

namespace lamella {

/// Consecutive broken links of one wall: an edge of the crack graph. Its ends are junctions, or vertices of its own where
/// the crack stops within the wall.
struct CrackFinder::Run {
  Index first = 0, last = 0;  // links, inclusive
  Index from = 0, to = 0;     // vertices
  double length = 0;          // [m]
};

/// Where the crack passes each junction: the mean of the middles of the broken links that end there. The corner nodes themselves
/// would pull the line towards the side of the crack that has two of them.
struct CrackFinder::Places {
  std::vector<Vec2> now, rest;  // [m]
  std::vector<int> ends;        // of broken runs at each
};

namespace {

struct PathTree {
  std::vector<double> distance;  // from the source; infinite where it does not lead
  std::vector<Index> by;         // run by which a vertex is reached; -1 at the source
};

/// Dijkstra over the runs that are not yet used.
template <class Run>
PathTree shortest_paths(const std::vector<Run>& runs, const std::vector<std::vector<Index>>& at,
                        const std::vector<char>& used, Index source) {
  PathTree tree{std::vector<double>(at.size(), std::numeric_limits<double>::infinity()),
                std::vector<Index>(at.size(), -1)};
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  tree.distance[source] = 0;
  open.push({0.0, source});
  while (!open.empty()) {
    const auto [distance, v] = open.top();
    open.pop();
    if (distance > tree.distance[v]) continue;
    for (Index r : at[v]) {
      if (used[r]) continue;
      const Index w = runs[r].from == v ? runs[r].to : runs[r].from;
      if (distance + runs[r].length < tree.distance[w]) {
        tree.distance[w] = distance + runs[r].length;
        tree.by[w] = r;
        open.push({tree.distance[w], w});
      }
    }
  }
  return tree;
}

/// Runs from the source of the tree to `end`, in order.
template <class Run>
std::vector<Index> path_to(const PathTree& tree, const std::vector<Run>& runs, Index end) {
  std::vector<Index> path;
  for (Index v = end; tree.by[v] >= 0;) {
    const Run& run = runs[tree.by[v]];
    path.push_back(tree.by[v]);
    v = run.from == v ? run.to : run.from;
  }
  std::reverse(path.begin(), path.end());
  return path;
}

Index farthest(const PathTree& tree, Index source) {
  Index best = source;
  for (Index v = 0; v < static_cast<Index>(tree.distance.size()); ++v)
    if (std::isfinite(tree.distance[v]) && tree.distance[v] > tree.distance[best]) best = v;
  return best;
}

}  // namespace

/// Of a link, at home of its a, at rest and in a frame.
Vec2 CrackFinder::middle(Index link) const {
  return link_middle(sample_->links[link], sample_->x, link_displacement(*sample_, link));
}
Vec2 CrackFinder::middle(Index link, const FrameView& view) const {
  return link_middle(sample_->links[link], view.x, view.displaced(link));
}

namespace {

/// A way by whole boxes at rest, by as many as they are in the frame [m].
Vec2 in_frame(const Vec2& way, const FrameView& view) {
  if (!view.box_moves()) return way;
  return way.cwiseQuotient(view.sample.box.size()).cwiseProduct(view.box_size());
}

}  // namespace

/// What brings the nearest image of a place to another place [m].
Vec2 CrackFinder::towards(const Vec2& place, const Vec2& near) const {
  Vec2 way(0, 0);
  const Vec2 period = sample_->box.size();
  for (int axis = 0; axis < 2; ++axis)
    if (sample_->periodic[axis]) way[axis] = period[axis] * std::round((near[axis] - place[axis]) / period[axis]);
  return way;
}

/// How often the run goes around the box along the free axis, on its way from one of its ends to the other.
int CrackFinder::around(const Run& run, const Places& places) const {
  if (!sample_->periodic[free_axis_] || run.from >= junctions_ || run.to >= junctions_) return 0;
  Vec2 at = places.rest[run.from];
  for (Index l = run.first; l <= run.last; ++l) {
    const Vec2 next = middle(l);
    at = next + towards(next, at);
  }
  const Vec2 end = places.rest[run.to];
  return static_cast<int>(std::lround(towards(end, at)[free_axis_] / sample_->box.size()[free_axis_]));
}

CrackFinder::CrackFinder(const Sample& sample, int free_axis) : sample_(&sample), free_axis_(free_axis) {
  const auto walls = static_cast<Index>(sample.walls.size());
  wall_begin_.assign(walls + 1, 0);
  for (const Link& link : sample.links) ++wall_begin_[link.wall + 1];
  for (Index w = 0; w < walls; ++w) wall_begin_[w + 1] += wall_begin_[w];

  // Corner nodes: those of end links; the walls that end at each.
  std::map<Index, std::vector<Index>> ends;
  UnionFind nodes(sample.nodes());
  for (Index w = 0; w < walls; ++w) {
    if (wall_begin_[w] == wall_begin_[w + 1]) continue;
    for (Index l : {wall_begin_[w], wall_begin_[w + 1] - 1}) {
      const Link& link = sample.links[l];
      nodes.join(link.a, link.b);
      ends[link.a].push_back(w), ends[link.b].push_back(w);
    }
  }
  // A corner may be split in two neighbouring nodes of a cell, one for each wall: closer than a spacing, no wall in common.
  const std::vector<Index> cell_of = cell_of_node(sample);
  for (const auto& [i, walls_at_i] : ends) {
    const Index c = cell_of[i], j = sample.next(c, i);
    const auto other = ends.find(j);
    if (!sample.starts_segment(c, i) || other == ends.end()) continue;
    const bool common = std::any_of(walls_at_i.begin(), walls_at_i.end(), [&](Index w) {
      return std::find(other->second.begin(), other->second.end(), w) != other->second.end();
    });
    const double spacing = sample.links[wall_begin_[walls_at_i.front()]].spacing;
    if (!common && (sample.x[j] - sample.x[i]).norm() < 0.75 * spacing) nodes.join(i, j);
  }

  junction_of_.assign(sample.nodes(), -1);
  const SidePair free = sides_across(free_axis);
  std::map<Index, Index> number;
  for (const auto& [i, unused] : ends) {
    const auto [at, fresh] = number.try_emplace(nodes.root(i), junctions_);
    if (fresh) ++junctions_, junction_sides_.push_back(0);
    junction_of_[i] = at->second;
    if (sample.side[i] & free.low) junction_sides_[at->second] |= 1;
    if (sample.side[i] & free.high) junction_sides_[at->second] |= 2;
  }
}

std::vector<CrackFinder::Run> CrackFinder::broken_runs(const FrameView& view) const {
  std::vector<Run> runs;
  Index vertices = junctions_;
  for (std::size_t w = 0; w + 1 < wall_begin_.size(); ++w) {
    const Index begin = wall_begin_[w], end = wall_begin_[w + 1];
    for (Index l = begin; l < end; ++l) {
      if (view.intact(l)) continue;
      Run run;
      run.first = l;
      while (l < end && !view.intact(l)) run.length += sample_->links[l++].length;
      run.last = l - 1;
      run.from = run.first == begin ? junction_of_[sample_->links[begin].a] : vertices++;
      run.to = run.last == end - 1 ? junction_of_[sample_->links[end - 1].a] : vertices++;
      runs.push_back(run);
    }
  }
  return runs;
}

CrackFinder::Places CrackFinder::places_of_junctions(const FrameView& view, const std::vector<Run>& runs) const {
  Places places{std::vector<Vec2>(junctions_, Vec2::Zero()), std::vector<Vec2>(junctions_, Vec2::Zero()),
                std::vector<int>(junctions_, 0)};
  const auto take = [&](Index vertex, Index link) {
    if (vertex >= junctions_) return;
    const Vec2 rest = middle(link);
    const int ends = places.ends[vertex]++;
    const Vec2 way = ends > 0 ? towards(rest, places.rest[vertex] / ends) : Vec2(0, 0);
    places.now[vertex] += middle(link, view) + in_frame(way, view);
    places.rest[vertex] += rest + way;
  };
  for (const Run& run : runs) take(run.from, run.first), take(run.to, run.last);
  for (Index j = 0; j < junctions_; ++j)
    if (places.ends[j] > 0) places.now[j] /= places.ends[j], places.rest[j] /= places.ends[j];
  return places;
}

CrackLine CrackFinder::make_line(const FrameView& view, const std::vector<Run>& runs, const Places& places,
                                 const std::vector<Index>& path) const {
  CrackLine line;
  const std::vector<double>* break_time = view.doubles("link_break_time");
  const auto add_point = [&](const Vec2& now, const Vec2& rest) {
    const Vec2 way = line.reference.empty() ? Vec2(0, 0) : towards(rest, line.reference.back());
    line.points.push_back(now + in_frame(way, view));
    line.reference.push_back(rest + way);
  };
  const auto add_junction = [&](Index vertex) {
    if (vertex >= junctions_ || places.ends[vertex] < 2) return;  // the crack's tip is its last link
    add_point(places.now[vertex], places.rest[vertex]);
  };
  line.first_time = std::numeric_limits<double>::max();
  // The first run starts at the vertex that the second does not share.
  Index vertex = runs[path[0]].from;
  if (path.size() > 1) {
    const Run &one = runs[path[0]], &two = runs[path[1]];
    if (one.from == two.from || one.from == two.to) vertex = one.to;
    if ((one.to == two.from || one.to == two.to) && vertex == one.to) vertex = one.from;
  }
  add_junction(vertex);
  for (Index r : path) {
    const Run& run = runs[r];
    const bool forward = run.from == vertex;
    for (Index k = 0; k <= run.last - run.first; ++k) {
      const Index l = forward ? run.first + k : run.last - k;
      const Link& link = sample_->links[l];
      line.links.push_back(l);
      add_point(middle(l, view), middle(l));
      line.length += link.length;
      line.opening += link.length * link_opening(view.link(l), view.x, view.displaced(l));
      const double time = break_time ? (*break_time)[l] : view.frame.time;
      line.first_time = std::min(line.first_time, time), line.last_time = std::max(line.last_time, time);
    }
    vertex = forward ? run.to : run.from;
    add_junction(vertex);
  }
  if (line.length > 0) line.opening /= line.length;
  return line;
}

std::vector<Crack> CrackFinder::find(const FrameView& view) const {
  const std::vector<Run> runs = broken_runs(view);
  const Places places = places_of_junctions(view, runs);
  Index vertices = junctions_;
  for (const Run& run : runs) vertices = std::max({vertices, run.from + 1, run.to + 1});
  std::vector<std::vector<Index>> at(vertices);
  UnionFind pieces(vertices);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    at[runs[r].from].push_back(static_cast<Index>(r));
    if (runs[r].to != runs[r].from) at[runs[r].to].push_back(static_cast<Index>(r));
    pieces.join(runs[r].from, runs[r].to);
  }
  std::map<Index, std::vector<Index>> runs_of;  // by root of the piece
  for (std::size_t r = 0; r < runs.size(); ++r) runs_of[pieces.root(runs[r].from)].push_back(static_cast<Index>(r));

  std::vector<Crack> cracks;
  std::vector<char> used(runs.size(), 0);
  for (const auto& [root, members] : runs_of) {
    Crack crack;
    Index low = -1, high = -1;  // a vertex of the piece on each free side
    for (Index r : members)
      for (Index v : {runs[r].from, runs[r].to})
        if (v < junctions_) {
          if (junction_sides_[v] & 1) low = v;
          if (junction_sides_[v] & 2) high = v;
        }
    crack.from_side_to_side = low >= 0 && high >= 0;
    const auto add_line = [&](const std::vector<Index>& path) {
      for (Index r : path) used[r] = 1;
      crack.lines.push_back(make_line(view, runs, places, path));
    };
    if (sample_->periodic[free_axis_]) {
      std::vector<WoundEdge> edges;
      for (Index r : members) edges.push_back({runs[r].from, runs[r].to, runs[r].length, around(runs[r], places)});
      std::vector<Index> loop = shortest_loop_around(edges);
      for (Index& edge : loop) edge = members[edge];
      if (crack.from_side_to_side = !loop.empty(); crack.from_side_to_side) add_line(loop);
    } else if (crack.from_side_to_side && low != high)
      add_line(path_to(shortest_paths(runs, at, used, low), runs, high));
    // Then the longest shortest path of what is left, until nothing is.
    for (Index r : members) {
      while (!used[r]) {
        const Index start = farthest(shortest_paths(runs, at, used, runs[r].from), runs[r].from);
        const PathTree tree = shortest_paths(runs, at, used, start);
        const std::vector<Index> path = path_to(tree, runs, farthest(tree, start));
        add_line(path.empty() ? std::vector<Index>{r} : path);  // empty: a wall that ends where it begins
      }
    }
    crack.first_time = crack.lines.front().first_time;
    for (const CrackLine& line : crack.lines) {
      crack.length += line.length;
      crack.opening += line.length * line.opening;
      crack.first_time = std::min(crack.first_time, line.first_time);
      crack.links += static_cast<int>(line.links.size());
    }
    if (crack.length > 0) crack.opening /= crack.length;
    cracks.push_back(std::move(crack));
  }
  std::stable_sort(cracks.begin(), cracks.end(), [](const Crack& a, const Crack& b) { return a.length > b.length; });
  return cracks;
}

double roughness(const CrackLine& line) {
  // Each stretch between points weighs its length, at its middle: independent of how densely links stand.
  double weight = 0;
  Vec2 mean = Vec2::Zero();
  Eigen::Matrix2d moment = Eigen::Matrix2d::Zero();
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t k = 0; k + 1 < line.reference.size(); ++k) {
      const Vec2 p = line.reference[k], q = line.reference[k + 1];
      const double length = (q - p).norm();
      if (pass == 0) {
        weight += length, mean += length * 0.5 * (p + q);
      } else {  // exact second moment of a straight stretch: Simpson's rule
        const Vec2 a = p - mean, b = q - mean, m = 0.5 * (a + b);
        moment += length / 6 * (a * a.transpose() + 4 * m * m.transpose() + b * b.transpose());
      }
    }
    if (!(weight > 0)) return 0;
    if (pass == 0) mean /= weight;
  }
  moment /= weight;
  const double smallest = 0.5 * moment.trace() - std::hypot(0.5 * (moment(0, 0) - moment(1, 1)), moment(0, 1));
  return std::sqrt(std::max(0.0, smallest));
}

double tortuosity(const CrackLine& line) {
  double length = 0;
  for (std::size_t k = 0; k + 1 < line.reference.size(); ++k)
    length += (line.reference[k + 1] - line.reference[k]).norm();
  const double chord = line.reference.empty() ? 0 : (line.reference.back() - line.reference.front()).norm();
  return chord > 0 ? length / chord : 1;
}

}  // namespace lamella
