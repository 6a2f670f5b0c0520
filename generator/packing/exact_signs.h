// Signs and orders that rounding must not decide, for points whose coordinates are taken as they are. Its source sees CGAL.
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "generator/sample/vec.h"

namespace lamella {

/// 1 when c lies to the left of the way from a to b, -1 to the right, 0 on the line.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// Where segments cross the segment from a to b, in their order from a.
struct CrossingOrder {
  std::vector<int> order;     // the segments, into `segments`
  std::vector<double> share;  // per segment: of the way from a to b, rounded from its exact value
};

/// Every segment crosses (a, b) properly. Nothing when two of them cross it at the same point.
std::optional<CrossingOrder> order_along(const Vec2& a, const Vec2& b,
                                         const std::vector<std::pair<Vec2, Vec2>>& segments);

}  // namespace lamella
