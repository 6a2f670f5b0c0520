#include "simulator/contact/feet.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

/// Place of the point of segment (a, b) nearest to p, not clamped: below 0 before a, above 1 behind b.
double projection(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 e = b - a;
  return (p - a).dot(e) / e.squaredNorm();
}

void keep(Feet& feet, const Foot& foot) {
  if (feet.count < kMaxFeet) {
    feet.foot[feet.count++] = foot;
    return;
  }
  int farthest = 0;
  for (int f = 1; f < kMaxFeet; ++f)
    if (feet.foot[f].distance > feet.foot[farthest].distance) farthest = f;
  if (foot.distance >= feet.foot[farthest].distance) return;
  std::move(feet.foot.begin() + farthest + 1, feet.foot.end(), feet.foot.begin() + farthest);
  feet.foot.back() = foot;
}

}  // namespace

Feet find_feet(const Sample& sample, const Field& x, Index node, Index cell, std::span<const Index> segments,
               double reach, const BrokenBars* broken, const Vec2& shift) {
  const auto stands = [&](Index segment) { return !broken || !broken->gone(segment); };
  Feet feet;
  const Vec2 p = x.at(node) + shift;
  const double reach2 = reach * reach;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const Index s = segments[k], next = sample.next(cell, s);
    const Vec2 a = x.at(s), b = x.at(next);
    double t = projection(p, a, b);
    Vec2 q;
    if (t > 0 && t < 1) {
      q = p - a - t * (b - a);
    } else if (t <= 0) {
      q = p - a, t = 0;
    } else {
      q = p - b, t = 1;
    }
    const double d2 = q.squaredNorm();
    if (!(d2 < reach2)) continue;
    if (t == 0) {  // the vertex belongs to the segment that starts there
      const bool first = !sample.closed[cell] && s == sample.cell_begin[cell];
      if (!first && stands(sample.prev(cell, s)) && projection(p, x.at(sample.prev(cell, s)), a) < 1) continue;
    } else if (t == 1) {  // unless that one does not exist, or is not looked at
      if (sample.starts_segment(cell, next) && stands(next)) {
        const bool looked_at = (k + 1 < segments.size() && segments[k + 1] == next) || segments[0] == next;
        if (looked_at || projection(p, b, x.at(sample.next(cell, next))) > 0) continue;
      }
    }
    const double d = std::sqrt(d2);
    keep(feet, {s, next, t, d, q / d});
  }
  return feet;
}

FootDerivatives differentiate(const Foot& foot, const Field& x) {
  FootDerivatives out;
  const double d = foot.distance;
  const Vec2 n = foot.n;
  const Eigen::Vector3d w = foot_weights(foot.t);
  out.distance = stacked(w, n);  // the foot's own motion along the shell drops out: it is the closest point
  if (foot.at_vertex()) {
    const Vector6 across = stacked(w, left_of(n));
    out.direction = across / d;
    out.distance2 = across * across.transpose() / d;
    out.direction2 = direction2(w, n, d);
    return out;
  }
  // d2(distance) at a fixed place along the segment, less what the place gains by moving:
  // (1/L) sym(w tau, v n) - (d / L^2) (v n)(v n), with v = (0, 1, -1) and tau the segment's direction.
  const Vec2 e = x.at(foot.next) - x.at(foot.segment);
  const double length = e.norm();
  const Vec2 tau = e / length;
  const Eigen::Vector3d v(0, 1, -1);
  const Vector6 along = stacked(w, tau), turn = stacked(v, n);
  out.distance2 =
      (along * turn.transpose() + turn * along.transpose()) / length - d / (length * length) * turn * turn.transpose();
  out.direction = stacked(-v, left_of(tau)) / length;
  out.direction2 = direction2(-v, tau, length);
  return out;
}

}  // namespace lamella
