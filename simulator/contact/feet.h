// Where a node is nearest to a shell. Geometry only: no stiffness, no friction, no links.
//
// A *foot* is a local minimum of the distance from the node along the shell: inside a segment, or a vertex that is the closest
// point of both its segments. So a convex corner counts once, a flat wall counts once, and in a concave corner there are two.
#pragma once
#include <Eigen/Core>
#include <array>
#include <span>

#include "generator/sample/broken_bars.h"
#include "simulator/positions.h"

namespace lamella {

struct Foot {
  Index segment = 0;    // its first node
  Index next = 0;       // its second node
  double t = 0;         // place along it; exactly 0 or 1 at a vertex
  double distance = 0;  // from the node [m]
  Vec2 n{0, 0};         // unit normal, from the foot to the node

  bool at_vertex() const { return t == 0 || t == 1; }
};

/// Feet that act at once; where there are more, the nearest.
inline constexpr int kMaxFeet = 3;

struct Feet {
  std::array<Foot, kMaxFeet> foot;
  int count = 0;
};

/// Feet of `node` on those `segments` of `cell` that are nearer than `reach`, in the order of the segments. A bar that is broken is no
/// segment, and its nodes are ends; none is with nullptr. In a periodic sample the node is an image of itself, displaced by `shift` [m].
Feet find_feet(const Sample& sample, const Field& x, Index node, Index cell, std::span<const Index> segments,
               double reach, const BrokenBars* broken = nullptr, const Vec2& shift = Vec2(0, 0));

/// Components of the node, of the segment's first node and of its second.
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// How the distance and the direction phi of the normal change as the three nodes move.
struct FootDerivatives {
  Vector6 distance, direction;
  Matrix6 distance2, direction2;
};
FootDerivatives differentiate(const Foot& foot, const Field& x);

/// (1, t - 1, -t): x_node - (1 - t) x_segment - t x_next is the sum of the positions with these weights.
inline Eigen::Vector3d foot_weights(double t) { return {1, t - 1, -t}; }

/// Vectors w_k v, one below the other.
inline Vector6 stacked(const Eigen::Vector3d& w, const Vec2& v) {
  Vector6 out;
  out << w[0] * v, w[1] * v, w[2] * v;
  return out;
}

/// Second derivative of the direction of a vector whose nodes have weights w.
inline Matrix6 direction2(const Eigen::Vector3d& w, const Vec2& unit, double length) {
  const Vector6 along = stacked(w, unit), across = stacked(w, left_of(unit));
  return -(along * across.transpose() + across * along.transpose()) / (length * length);
}

}  // namespace lamella
