#include "generator/packing/spatial_order.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>

namespace lamella {
namespace {

constexpr int kBits = 20;  // per coordinate

/// Place of a point of the grid along the Hilbert curve.
std::uint64_t hilbert_place(std::uint32_t x, std::uint32_t y) {
  std::uint64_t place = 0;
  for (std::uint32_t s = 1u << (kBits - 1); s > 0; s >>= 1) {
    const std::uint32_t right = (x & s) ? 1 : 0, upper = (y & s) ? 1 : 0;
    place = (place << 2) | ((3 * right) ^ upper);
    if (upper) continue;
    if (right) x = ~x, y = ~y;
    std::swap(x, y);
  }
  return place;
}

/// A bijection that leaves no pattern (the finaliser of MurmurHash3).
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdu;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53u;
  return x ^ (x >> 33);
}

}  // namespace

std::vector<Index> insertion_order(const std::vector<PowerSite>& sites) {
  Vec2 lo = Vec2::Constant(std::numeric_limits<double>::infinity()), hi = -lo;
  for (const PowerSite& site : sites) lo = lo.cwiseMin(site.centre), hi = hi.cwiseMax(site.centre);
  const double cells = (1u << kBits) - 1, extent = (hi - lo).maxCoeff();
  const double scale = extent > 0 ? cells / extent : 0;
  const int rounds = std::max(0, static_cast<int>(std::bit_width(sites.size())) - 6) / 2;

  std::vector<std::pair<std::uint64_t, Index>> keys(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Vec2 at = (sites[i].centre - lo) * scale;
    const int round = std::min(rounds, std::countr_zero(mixed(i)) / 2);  // 3 of 4 in the last, 0
    keys[i] = {(static_cast<std::uint64_t>(rounds - round) << (2 * kBits)) |
                   hilbert_place(static_cast<std::uint32_t>(at.x()), static_cast<std::uint32_t>(at.y())),
               static_cast<Index>(i)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Index> order(sites.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
  return order;
}

}  // namespace lamella
