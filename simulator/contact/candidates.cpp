#include "simulator/contact/candidates.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "simulator/contact/drift.h"
#include "simulator/contact/images.h"
#include "simulator/moving_box.h"

namespace lamella {
namespace {

/// Where a coordinate lies on a grid of n; a position that is no number lies anywhere.
Index slot(double v, double lo, double width, Index n) {
  const double s = (v - lo) / width;
  return s > 0 ? (s < n ? static_cast<Index>(s) : n - 1) : 0;
}

/// Segments by the squares of a grid which their boxes, grown by all that a node may be away, cover. So a node looks into one square.
class SegmentGrid {
 public:
  SegmentGrid(const CandidateRules& rules, const Field& x) {
    const Sample& sample = rules.sample;
    lo_ = {*std::min_element(x.x.begin(), x.x.end()), *std::min_element(x.y.begin(), x.y.end())};
    const Vec2 hi{*std::max_element(x.x.begin(), x.x.end()), *std::max_element(x.y.begin(), x.y.end())};
    const double largest = *std::max_element(sample.radius.begin(), sample.radius.end());

    double mean = 0;
    const Index nodes = sample.nodes();
    for (Index c = 0; c < sample.cells(); ++c)
      for (Index s = sample.cell_begin[c]; s < sample.cell_begin[c + 1]; ++s)
        if (sample.starts_segment(c, s) && !rules.gone(s))
          mean += (x.at(sample.next(c, s)) - x.at(s)).lpNorm<1>() + 2 * (sample.radius[c] + largest + rules.skin);
    // No more squares than a few per node, however far the pieces have flown apart.
    const Vec2 size = hi - lo_;
    const double most = 4.0 * nodes + 16;
    width_ = std::max({mean / nodes, std::sqrt(size.x() * size.y() / most), size.maxCoeff() / most});
    if (!(width_ > 0) || !std::isfinite(width_)) width_ = 1;
    nx_ = slot(hi.x(), lo_.x(), width_, nodes * 4 + 16) + 1;
    ny_ = slot(hi.y(), lo_.y(), width_, nodes * 4 + 16) + 1;

    begin_.assign(static_cast<std::size_t>(nx_) * ny_ + 1, 0);
    for_each_square(rules, x, largest, [&](std::size_t square, Index, Index) { ++begin_[square + 1]; });
    for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
    entries_.resize(begin_.back());
    std::vector<std::int64_t> at(begin_.begin(), begin_.end() - 1);
    for_each_square(rules, x, largest, [&](std::size_t square, Index cell, Index segment) {
      entries_[at[square]++] = {cell, segment};
    });
  }

  /// (cell, segment) of all that may be near p, sorted.
  std::span<const std::pair<Index, Index>> near(const Vec2& p) const {
    const std::size_t k = square(slot(p.x(), lo_.x(), width_, nx_), slot(p.y(), lo_.y(), width_, ny_));
    return {entries_.data() + begin_[k], static_cast<std::size_t>(begin_[k + 1] - begin_[k])};
  }

 private:
  std::size_t square(Index i, Index j) const { return static_cast<std::size_t>(j) * nx_ + i; }

  template <class Visit>
  void for_each_square(const CandidateRules& rules, const Field& x, double largest, Visit visit) const {
    const Sample& sample = rules.sample;
    for (Index c = 0; c < sample.cells(); ++c) {
      const double grow = sample.radius[c] + largest + rules.skin;
      for (Index s = sample.cell_begin[c]; s < sample.cell_begin[c + 1]; ++s) {
        if (!sample.starts_segment(c, s) || rules.gone(s)) continue;
        const Vec2 a = x.at(s), b = x.at(sample.next(c, s));
        const Vec2 lo = a.cwiseMin(b).array() - grow, hi = a.cwiseMax(b).array() + grow;
        const Index i1 = slot(hi.x(), lo_.x(), width_, nx_), j1 = slot(hi.y(), lo_.y(), width_, ny_);
        for (Index j = slot(lo.y(), lo_.y(), width_, ny_); j <= j1; ++j)
          for (Index i = slot(lo.x(), lo_.x(), width_, nx_); i <= i1; ++i) visit(square(i, j), c, s);
      }
    }
  }

  Vec2 lo_;
  double width_ = 1;  // of a square [m]
  Index nx_ = 1, ny_ = 1;
  std::vector<std::int64_t> begin_;
  std::vector<std::pair<Index, Index>> entries_;
};

}  // namespace

double squared_distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 e = b - a;
  const double t = std::clamp((p - a).dot(e) / e.squaredNorm(), 0.0, 1.0);
  return (p - a - t * e).squaredNorm();
}

SelfReach::SelfReach(const Sample& sample) : before_(sample.nodes(), 2), after_(sample.nodes(), 2) {
  for (Index c = 0; c < sample.cells(); ++c) {
    const double r = sample.radius[c], fold = std::numbers::pi * r, window = 8 * r;
    const Index size = sample.cell_size(c), segments = sample.segments(c);
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) {
      // forwards: `arc` is the length up to the start of segment s
      double arc = 0;
      Index s = i;
      for (Index k = 0; k < segments && arc < window && sample.starts_segment(c, s); ++k) {
        const Index next = sample.next(c, s);
        if (arc < fold || squared_distance(sample.x[i], sample.x[s], sample.x[next]) < 4 * r * r)
          after_[i] = std::max(after_[i], k + 1);
        arc += sample.rest_length[s];
        s = next;
      }
      arc = 0;
      s = i;
      for (Index k = 0; k < segments && arc < window; ++k) {
        if (!sample.closed[c] && s == sample.cell_begin[c]) break;
        const Index previous = sample.prev(c, s);
        if (arc < fold || squared_distance(sample.x[i], sample.x[previous], sample.x[s]) < 4 * r * r)
          before_[i] = std::max(before_[i], k + 1);
        arc += sample.rest_length[previous];
        s = previous;
      }
      before_[i] = std::min(before_[i], size), after_[i] = std::min(after_[i], size);
    }
  }
}

bool SelfReach::ignores(const Sample& sample, const BrokenBars* broken, Index cell, Index node, Index segment) const {
  const Index size = sample.cell_size(cell);
  Index ahead = segment - node, behind = node - segment - 1;  // whole segments between the two
  if (sample.closed[cell]) {
    if (ahead < 0) ahead += size;
    if (behind < 0) behind += size;
  }
  const bool near_ahead = ahead >= 0 && ahead < after_[node], near_behind = behind >= 0 && behind < before_[node];
  if ((!near_ahead && !near_behind) || !broken || !broken->opened(cell)) return near_ahead || near_behind;
  const auto joined = [&](Index from, Index to) {  // by the bars from node `from` on to node `to`
    for (; from != to; from = sample.next(cell, from))
      if (broken->gone(from)) return false;
    return true;
  };
  const Index next = sample.next(cell, segment);
  if ((near_ahead && joined(node, segment)) || (near_behind && joined(next, node))) return true;
  const double reach = 2 * sample.radius[cell];
  return squared_distance(sample.x[node], sample.x[segment], sample.x[next]) < reach * reach;
}

LinkedNodes::LinkedNodes(const Sample& sample, const std::vector<Index>& cell_of)
    : begin_(sample.nodes() + 1, 0), partners_(2 * sample.links.size()), intact_(sample.links.size(), 0) {
  for (const Link& link : sample.links) ++begin_[link.a + 1], ++begin_[link.b + 1];
  for (Index i = 0; i < sample.nodes(); ++i) begin_[i + 1] += begin_[i];
  std::vector<Index> at(begin_.begin(), begin_.end() - 1);
  for (Index l = 0; l < static_cast<Index>(sample.links.size()); ++l) {
    const Link& link = sample.links[l];
    const Image image = sample.link_image.empty() ? Image{0, 0} : sample.link_image[l];  // of b, seen from a
    partners_[at[link.a]++] = {l, link.b, cell_of[link.b], opposite(image)};
    partners_[at[link.b]++] = {l, link.a, cell_of[link.a], image};
  }
}

bool LinkedNodes::ignores(const Sample& sample, Index node, Index cell, const Image& image, Index segment) const {
  for (const Partner& partner : of(node))
    if (partner.cell == cell && partner.image == image && intact_[partner.link] &&
        (segment == partner.node || sample.next(cell, segment) == partner.node))
      return true;
  return false;
}

std::size_t LinkedNodes::bytes() const {
  return begin_.size() * sizeof(Index) + partners_.size() * sizeof(Partner) + intact_.size();
}

bool CandidateRules::candidates(const Field& x, Index node, Index cell, Index segment, const Image& image) const {
  if (gone(segment)) return false;
  const Index own = cell_of[node];
  const double reach = sample.radius[own] + sample.radius[cell] + skin;
  const bool here = image == Image{0, 0};
  Vec2 p = x.at(node);
  if (!here) p += displacement(image, box_size(sample, x));
  const Vec2 a = x.at(segment), b = x.at(sample.next(cell, segment));
  // most of the pairs of a square of the grid are farther apart than this, and it needs no division
  if (std::min(a.x(), b.x()) - p.x() >= reach || p.x() - std::max(a.x(), b.x()) >= reach ||
      std::min(a.y(), b.y()) - p.y() >= reach || p.y() - std::max(a.y(), b.y()) >= reach)
    return false;
  const bool itself = own == cell && here;
  if (itself && self_reach.ignores(sample, broken, cell, node, segment)) return false;
  if (!(squared_distance(p, a, b) < reach * reach)) return false;
  return itself || !linked.ignores(sample, node, cell, image, segment);
}

namespace {

/// The search of a periodic sample: segments of cells at home, looked at from every image of a node that comes near them.
CandidateList find_among_images(const CandidateRules& rules, const Field& x) {
  const Sample& sample = rules.sample;
  const Homes homes(sample, box_size(sample, x), bounding_boxes(sample, x));
  const Field at_home = brought_home(sample, homes, x);
  const SegmentGrid grid(rules, at_home);
  const double grow = 2 * *std::max_element(sample.radius.begin(), sample.radius.end()) + rules.skin;
  CandidateList list;
  std::vector<std::tuple<Index, Image, Index>> found;  // cell, image, segment
  for (Index node = 0; node < sample.nodes(); ++node) {
    const Index own = rules.cell_of[node];
    if (rules.bare[own]) continue;
    found.clear();
    homes.for_each_copy({x.at(node), x.at(node)}, own, grow, [&](const Steps& steps) {
      for (const auto& [c, s] : grid.near(x.at(node) + homes.displacement(steps))) {
        const Image image = image_between(steps, homes.home(c));
        if (rules.candidates(x, node, c, s, image)) found.emplace_back(c, image, s);
      }
    });
    std::sort(found.begin(), found.end());
    for (const auto& [c, image, s] : found) {
      const bool more = !list.pairs.empty() && list.pairs.back().node == node && list.pairs.back().cell == c &&
                        list.pairs.back().image == image;
      if (!more) list.pairs.push_back({node, c, static_cast<Index>(list.segments.size()), 0, image});
      list.segments.push_back(s);
      ++list.pairs.back().count;
    }
  }
  return list;
}

}  // namespace

CandidateList find_candidates(const CandidateRules& rules, const Field& x) {
  if (is_periodic(rules.sample) && rules.sample.nodes() > 0) return find_among_images(rules, x);
  CandidateList list;
  if (rules.sample.nodes() == 0) return list;
  const SegmentGrid grid(rules, x);
  for (Index node = 0; node < rules.sample.nodes(); ++node) {
    if (rules.bare[rules.cell_of[node]]) continue;
    Index cell = -1;
    for (const auto& [c, s] : grid.near(x.at(node))) {
      if (!rules.candidates(x, node, c, s)) continue;
      if (c != cell) list.pairs.push_back({node, c, static_cast<Index>(list.segments.size()), 0});
      cell = c;
      list.segments.push_back(s);
      ++list.pairs.back().count;
    }
  }
  return list;
}

}  // namespace lamella
