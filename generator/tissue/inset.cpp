#include "generator/tissue/inset.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "generator/sample/polygon.h"

namespace lamella {
namespace {

/// One corner of the shrinking polygon, between an edge and its successor among those left. Along both edges it
/// moves linearly with the distance s: at end0 - s tan(turn/2) on the first, at begin0 + s tan(turn/2) on the second.
struct Corner {
  double turn = 0;  // from the first edge to the second [rad]
  double end0 = 0, begin0 = 0;
  double speed() const { return std::tan(turn / 2); }
};

/// The polygon while it shrinks. Convex polygons have edge events only, so this is their exact straight skeleton.
class Shrinking {
 public:
  explicit Shrinking(const std::vector<Vec2>& polygon) : start_(polygon) {
    const std::size_t count = polygon.size();
    for (std::size_t k = 0; k < count; ++k) {
      const Vec2 along = polygon[(k + 1) % count] - polygon[k];
      direction_.push_back(along.normalized());
      left_.push_back(static_cast<Index>(k));
      corners_.push_back({0, along.norm(), 0});
    }
    for (std::size_t k = 0; k < count; ++k) {
      const Vec2& in = direction_[k];
      const Vec2& out = direction_[(k + 1) % count];
      corners_[k].turn = std::atan2(cross(in, out), in.dot(out));
    }
  }

  /// Shrinks up to `distance`; false when the polygon vanishes on the way.
  bool shrink_to(double distance) {
    while (true) {
      if (left_.size() < 3) return false;
      std::size_t first = 0;
      double soonest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < left_.size(); ++i) {
        const Corner& before = corners_[(i + left_.size() - 1) % left_.size()];
        const Corner& after = corners_[i];
        const double closing = before.speed() + after.speed();
        if (closing <= 0) continue;
        const double event = (after.end0 - before.begin0) / closing;
        if (event < soonest) {
          soonest = event;
          first = i;
        }
      }
      // What shrinks to nothing just there counts as gone.
      if (std::isinf(soonest) || soonest > distance * (1 + 1e-12)) return true;
      last_ = std::max(last_, soonest);
      if (!remove(first)) return false;
    }
  }

  /// Distance of the last event [m].
  double last() const { return last_; }

  std::vector<InsetEdge> edges(double distance) const {
    std::vector<InsetEdge> result;
    for (std::size_t i = 0; i < left_.size(); ++i) {
      const Corner& before = corners_[(i + left_.size() - 1) % left_.size()];
      const Corner& after = corners_[i];
      result.push_back({left_[i], before.begin0 + distance * before.speed(), after.end0 - distance * after.speed()});
    }
    return result;
  }

  bool has_reflex_corner() const {
    return std::any_of(corners_.begin(), corners_.end(), [](const Corner& c) { return c.turn < -1e-9; });
  }

 private:
  /// Takes edge `i` of those left out and joins its neighbours. False when they no longer meet ahead.
  bool remove(std::size_t i) {
    const std::size_t count = left_.size();
    const std::size_t before = (i + count - 1) % count;
    const std::size_t after = (i + 1) % count;
    Corner joined;
    joined.turn = corners_[before].turn + corners_[i].turn;
    if (count <= 3 || joined.turn >= std::numbers::pi - 1e-12) return false;
    const Index a = left_[before];
    const Index b = left_[after];
    const double sine = cross(direction_[a], direction_[b]);
    if (std::abs(sine) < 1e-14) return false;
    const Vec2 between = start_[a] - start_[b];
    joined.end0 = left_of(direction_[b]).dot(between) / sine;
    joined.begin0 = (between + joined.end0 * direction_[a]).dot(direction_[b]);
    corners_[before] = joined;
    corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(i));
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
    return true;
  }

  const std::vector<Vec2>& start_;
  std::vector<Vec2> direction_;
  std::vector<Index> left_;      // edges not yet vanished, in order
  std::vector<Corner> corners_;  // at the end of left_[i]
  double last_ = 0;
};

bool cross_properly(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

/// A shrunk concave polygon is right when its corners keep their distance from the original and it does not cross
/// itself.
bool is_sound(const std::vector<Vec2>& polygon, const std::vector<InsetEdge>& edges, double distance) {
  std::vector<Vec2> corner;
  const std::size_t count = polygon.size();
  for (const InsetEdge& e : edges) {
    const Vec2& a = polygon[e.edge];
    const Vec2 along = (polygon[(e.edge + 1) % count] - a).normalized();
    corner.push_back(a + e.from * along + distance * left_of(along));
  }
  for (std::size_t i = 0; i < corner.size(); ++i) {
    for (std::size_t k = 0; k < count; ++k)
      if (distance_to_segment(corner[i], polygon[k], polygon[(k + 1) % count]) < distance * (1 - 1e-9)) return false;
    for (std::size_t j = 0; j < corner.size(); ++j) {
      const std::size_t end = (j + 1) % corner.size();
      if (i == j || i == end) continue;
      // Edges of pictures and bricks meet along their length, which is no crossing.
      if (distance_to_segment(corner[i], corner[j], corner[end]) < distance * 1e-9) return false;
      if (j > i + 1 && cross_properly(corner[i], corner[i + 1], corner[j], corner[end])) return false;
    }
  }
  return polygon_area(corner) > 0;
}

}  // namespace

Inset inset_polygon(const std::vector<Vec2>& polygon, double distance) {
  Shrinking shrinking(polygon);
  const bool concave = shrinking.has_reflex_corner();
  Inset inset;
  if (!shrinking.shrink_to(distance)) {
    inset.outcome = Inset::Outcome::vanished;
    return inset;
  }
  inset.edges = shrinking.edges(distance);
  if (concave && !is_sound(polygon, inset.edges, distance)) inset.outcome = Inset::Outcome::split;
  return inset;
}

double vanishing_distance(const std::vector<Vec2>& polygon) {
  Shrinking shrinking(polygon);
  shrinking.shrink_to(std::numeric_limits<double>::infinity());
  return shrinking.last();
}

}  // namespace lamella
