// The frame and force of a cohesive link in the current geometry (definition: Link in generator/sample/sample.h).
#pragma once
#include <vector>

#include "generator/sample/sample.h"

namespace lamella {

struct LinkFrame {
  Vec2 n, t;  // unit normal from a to b, and unit tangent
};

// In a periodic sample b is displaced where it faces a: by link_displacement(sample, link), in a frame by FrameView::displaced.
LinkFrame link_frame(const Link& link, const std::vector<Vec2>& x, const Vec2& displaced = Vec2(0, 0));

/// Beside a.
inline Vec2 link_middle(const Link& link, const std::vector<Vec2>& x, const Vec2& displaced = Vec2(0, 0)) {
  return 0.5 * (x[link.a] + x[link.b] + displaced);
}

/// (x_b - x_a) . n beyond the distance at which the link is free of force [m].
double link_opening(const Link& link, const std::vector<Vec2>& x, const Vec2& displaced = Vec2(0, 0));

}  // namespace lamella
