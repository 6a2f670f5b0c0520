#include "simulator/contact/overlap.h"

#include <Eigen/LU>
#include <algorithm>

namespace lamella {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

/// G on the feet of `mask`, the unit matrix elsewhere.
Matrix3d gram(const Feet& feet, unsigned mask) {
  Matrix3d g = Matrix3d::Identity();
  for (int a = 0; a < feet.count; ++a)
    for (int b = a + 1; b < feet.count; ++b)
      if ((mask >> a & 1) && (mask >> b & 1)) g(a, b) = g(b, a) = std::max(0.0, feet.foot[a].n.dot(feet.foot[b].n));
  return g;
}

// Below this the normals of two feet are parallel to rounding, and the deeper one speaks for both.
constexpr double kParallel = 1e-12;

}  // namespace

Overlap overlap(const Feet& feet, double reach) {
  Overlap best;
  if (feet.count == 1) {
    const double delta = reach - feet.foot[0].distance;
    best.energy = 0.5 * delta * delta;
    best.lambda[0] = delta;
    return best;
  }
  // The maximum is attained on one of at most seven sets of feet that push, and no other set gives more.
  for (unsigned mask = 1; mask < 1U << feet.count; ++mask) {
    Vector3d delta = Vector3d::Zero();
    for (int f = 0; f < feet.count; ++f)
      if (mask >> f & 1) delta[f] = reach - feet.foot[f].distance;
    const Matrix3d g = gram(feet, mask);
    if (g.determinant() < kParallel) continue;
    const Vector3d lambda = g.inverse() * delta;
    const double energy = 0.5 * lambda.dot(delta);
    if (lambda.minCoeff() < 0 || energy <= best.energy) continue;
    best.energy = energy;
    best.lambda = lambda;
  }
  for (int a = 0; a < feet.count; ++a)
    for (int b = a + 1; b < feet.count; ++b) {
      const Vec2 &m = feet.foot[a].n, &n = feet.foot[b].n;
      if (m.dot(n) <= 0) continue;
      const double couple = best.lambda[a] * best.lambda[b] * cross(m, n);
      best.turn[a] -= couple, best.turn[b] += couple;
    }
  return best;
}

// With P the inverse of G on the feet that push and G_f = dG/dphi_f: dlambda/ddelta = P, dlambda/dphi_f = -P G_f lambda,
// d2W/dphi_f dphi_g = lambda G_f P G_g lambda - 1/2 lambda (dG_f/dphi_g) lambda.
Matrix6 overlap_stiffness(const Feet& feet, const Overlap& o) {
  Matrix6 h = Matrix6::Zero();
  unsigned mask = 0;
  for (int f = 0; f < feet.count; ++f)
    if (o.lambda[f] > 0) mask |= 1U << f;
  Matrix3d p = gram(feet, mask).inverse();
  for (int f = 0; f < kMaxFeet; ++f)
    if (!(mask >> f & 1)) p(f, f) = 0;

  Matrix3d moved = Matrix3d::Zero();  // column f: G_f lambda
  for (int a = 0; a < feet.count; ++a)
    for (int b = a + 1; b < feet.count; ++b) {
      const double c = feet.foot[a].n.dot(feet.foot[b].n);
      if (c <= 0 || !(mask >> a & 1) || !(mask >> b & 1)) continue;
      const double s = cross(feet.foot[a].n, feet.foot[b].n), both = o.lambda[a] * o.lambda[b] * c;
      moved(a, b) -= s * o.lambda[b], moved(b, b) -= s * o.lambda[a];
      moved(a, a) += s * o.lambda[b], moved(b, a) += s * o.lambda[a];
      h(3 + a, 3 + a) += both, h(3 + b, 3 + b) += both;
      h(3 + a, 3 + b) -= both, h(3 + b, 3 + a) -= both;
    }
  h.topLeftCorner<3, 3>() = p;
  h.topRightCorner<3, 3>() = -p * moved;
  h.bottomLeftCorner<3, 3>() = h.topRightCorner<3, 3>().transpose();
  h.bottomRightCorner<3, 3>() += moved.transpose() * p * moved;
  return h;
}

int heaviest(const Feet& feet, const Overlap& o) {
  int best = -1;
  for (int f = 0; f < feet.count; ++f)
    if (o.lambda[f] > 0 && (best < 0 || o.lambda[f] > o.lambda[best])) best = f;
  return best;
}

double pressing(const Feet& feet, const Overlap& o, int foot) {
  double sum = 0;
  for (int f = 0; f < feet.count; ++f)
    if (o.lambda[f] > 0) sum += o.lambda[f] * std::max(0.0, feet.foot[f].n.dot(feet.foot[foot].n));
  return sum;
}

}  // namespace lamella
