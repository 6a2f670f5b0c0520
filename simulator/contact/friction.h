// Coulomb friction between a node and a shell: a tangential spring with a return mapping.
//
// At each commit the spring is anchored at the material point of the shell that the node touches. Its slip since then is
//   s(x) = T(x) . (x_node - anchor(x)),
// with T the tangent, which turns with the anchor's segment. s depends on the mutual positions of three nodes only and does not change in
// a rigid motion, so its gradient carries neither force nor couple: what f_t exerts at the wall's thickness goes to the segment's
// two nodes. The stretch outlives the anchor: it is a number in the turning frame, kept from segment to vertex to segment.
// Friction has no energy of its own; the incremental potential holds the limit mu f_n of the last commit.
#pragma once
#include "simulator/contact/feet.h"

namespace lamella {

struct FrictionSpring {
  Index segment = 0, next = 0;   // of the anchor
  double t = 0;                  // place of the anchor along it
  double along = 1, across = 0;  // T = along tau + across left_of(tau), tau the direction of the segment
  double stretch = 0;            // at the last commit [m]; pulls the node along -T
  double limit = 0;              // mu f_n at the last commit [N]; 0: no spring
  double force = 0;              // that acted at the last commit [N]: the limit was still that of the commit before

  bool acts() const { return limit > 0; }
};

/// Slip since the last commit [m] with its derivatives by the node, the segment's first node and its second.
struct Slip {
  double value = 0;
  Vec2 tangent{0, 0};
  Vec2 couple{0, 0};  // of the gradient: on `next`, and its opposite on `segment`
};
/// `shift` displaces the node, where it is an image that touches [m].
Slip slip_of(const FrictionSpring& spring, const Field& x, Index node, const Vec2& shift = Vec2(0, 0));
Vector6 slip_gradient(const FrictionSpring& spring, const Slip& slip);
Matrix6 slip_stiffness(const FrictionSpring& spring, const Field& x, Index node, const Vec2& shift = Vec2(0, 0));

/// The spring anchored at `foot`, not stretched.
FrictionSpring anchored_at(const Foot& foot, const Field& x);

/// What the spring of stiffness k_t becomes when it has been drawn to `stretch`.
struct Sliding {
  double force = 0;      // k_t stretch, clipped to the limit [N]
  double stretch = 0;    // that is left [m]
  double slipped = 0;    // the rest [m], positive
  double potential = 0;  // stored and, at the limit, dissipated since the last commit [J]
};
Sliding slide(double stretch, double limit, double k_t);

}  // namespace lamella
