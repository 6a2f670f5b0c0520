#include "postproc/quantities/link_frame.h"

namespace lamella {

LinkFrame link_frame(const Link& link, const std::vector<Vec2>& x, const Vec2& displaced) {
  const Vec2 tau = (x[link.a_next] - x[link.a_prev]) - (x[link.b_next] - x[link.b_prev]);
  if (tau.norm() > 0) {
    const Vec2 t = tau.normalized();
    return {right_of(t), t};
  }
  // A wall without a segment of its own: the link itself is the normal.
  const Vec2 d = x[link.b] + displaced - x[link.a];
  const Vec2 n = d.norm() > 0 ? Vec2(d.normalized()) : Vec2(1, 0);
  return {n, left_of(n)};
}

double link_opening(const Link& link, const std::vector<Vec2>& x, const Vec2& displaced) {
  return (x[link.b] + displaced - x[link.a]).dot(link_frame(link, x, displaced).n) - link.offset_n;
}

}  // namespace lamella
