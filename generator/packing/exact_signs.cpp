#include "generator/packing/exact_signs.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <numeric>

namespace lamella {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Number = CGAL::Exact_rational;

/// Twice the signed area of (a, b, c).
Number twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (Number(b.x()) - Number(a.x())) * (Number(c.y()) - Number(a.y())) -
         (Number(b.y()) - Number(a.y())) * (Number(c.x()) - Number(a.x()));
}

}  // namespace

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto point = [](const Vec2& p) { return Kernel::Point_2(p.x(), p.y()); };
  return CGAL::orientation(point(a), point(b), point(c));
}

std::optional<CrossingOrder> order_along(const Vec2& a, const Vec2& b,
                                         const std::vector<std::pair<Vec2, Vec2>>& segments) {
  std::vector<Number> share;
  share.reserve(segments.size());
  for (const auto& [u, v] : segments) {
    const Number from_a = twice_area(u, v, a);
    share.push_back(from_a / (from_a - twice_area(u, v, b)));
  }
  CrossingOrder result;
  result.order.resize(segments.size());
  std::iota(result.order.begin(), result.order.end(), 0);
  std::sort(result.order.begin(), result.order.end(), [&](int i, int j) { return share[i] < share[j]; });
  for (std::size_t k = 1; k < result.order.size(); ++k)
    if (share[result.order[k - 1]] == share[result.order[k]]) return {};
  for (const Number& s : share) result.share.push_back(CGAL::to_double(s));
  return result;
}

}  // namespace lamella
