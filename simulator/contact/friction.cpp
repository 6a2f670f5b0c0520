#include "simulator/contact/friction.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

const Eigen::Vector3d kTurn(0, -1, 1);  // the segment's vector from its nodes

Vec2 arm(const FrictionSpring& spring, const Field& x, Index node, const Vec2& shift) {
  return x.at(node) + shift - (1 - spring.t) * x.at(spring.segment) - spring.t * x.at(spring.next);
}

}  // namespace

Slip slip_of(const FrictionSpring& spring, const Field& x, Index node, const Vec2& shift) {
  const Vec2 e = x.at(spring.next) - x.at(spring.segment), p = arm(spring, x, node, shift);
  const double length = e.norm();
  const Vec2 tau = e / length, m = left_of(tau);
  Slip slip;
  slip.tangent = spring.along * tau + spring.across * m;
  slip.value = slip.tangent.dot(p);
  slip.couple = left_of(slip.tangent).dot(p) / length * m;  // T turns with the segment: dT = left_of(T) dphi
  return slip;
}

Vector6 slip_gradient(const FrictionSpring& spring, const Slip& slip) {
  return stacked(foot_weights(spring.t), slip.tangent) + stacked(kTurn, slip.couple);
}

Matrix6 slip_stiffness(const FrictionSpring& spring, const Field& x, Index node, const Vec2& shift) {
  const Vec2 e = x.at(spring.next) - x.at(spring.segment), p = arm(spring, x, node, shift);
  const double length = e.norm();
  const Vec2 tau = e / length, m = left_of(tau), tangent = spring.along * tau + spring.across * m;
  const Vector6 moved = stacked(foot_weights(spring.t), left_of(tangent)), turned = stacked(kTurn, m) / length;
  return moved * turned.transpose() + turned * moved.transpose() - tangent.dot(p) * turned * turned.transpose() +
         left_of(tangent).dot(p) * direction2(kTurn, tau, length);
}

FrictionSpring anchored_at(const Foot& foot, const Field& x) {
  const Vec2 tau = (x.at(foot.next) - x.at(foot.segment)).normalized(), tangent = left_of(foot.n);
  FrictionSpring spring;
  spring.segment = foot.segment, spring.next = foot.next, spring.t = foot.t;
  spring.along = tangent.dot(tau);
  spring.across = tangent.dot(left_of(tau));
  return spring;
}

Sliding slide(double stretch, double limit, double k_t) {
  Sliding out;
  const double most = limit / k_t;
  out.stretch = std::clamp(stretch, -most, most);
  out.slipped = std::abs(stretch - out.stretch);
  out.force = k_t * out.stretch;
  out.potential = 0.5 * k_t * out.stretch * out.stretch + limit * out.slipped;
  return out;
}

}  // namespace lamella
