// Moments of tiles, beside those of Poisson-Voronoi tilings of unit intensity.
#pragma once
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "generator/packing/laguerre.h"

namespace lamella {

/// A moment of N tiles. Its standard deviation, from one tiling to another, is spread / sqrt(N).
struct Moment {
  std::string name;
  double found = 0, expected = 0, spread = 0;
};

/// Of a tiling of the torus, in units of the mean area of its tiles. Expected values: var n and var A of the literature
/// (Brakke: 1.7808, 0.2802), mean n, P and L exact, the others measured on five tilings of 1e6 tiles by another program.
inline std::vector<Moment> poisson_voronoi_moments(const Tessellation& t) {
  const double count = static_cast<double>(t.tiles.size()), unit = std::sqrt(t.box.area() / count);
  std::vector<double> sides(t.tiles.empty() ? 0 : static_cast<std::size_t>(t.tiles.back().site) + 1, 0);
  for (const Tile& tile : t.tiles) sides[tile.site] = static_cast<double>(tile.vertex.size());
  double n1 = 0, n2 = 0, a2 = 0, a3 = 0, p1 = 0, p2 = 0, l1 = 0, l2 = 0, n_a = 0, around = 0;
  std::array<double, 16> share{}, area_of{};
  for (const Tile& tile : t.tiles) {
    const double n = sides[tile.site], a = tile_area(t, tile) / (unit * unit);
    double perimeter = 0, neighbours = 0;
    for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
      const double length = edge_length(t, tile, k) / unit;
      perimeter += length;
      l1 += length / (6 * count), l2 += length * length / (6 * count);
      neighbours += sides[tile.neighbour[k]];
    }
    n1 += n, n2 += (n - 6) * (n - 6) / count;
    a2 += (a - 1) * (a - 1) / count, a3 += std::pow(a - 1, 3) / count;
    p1 += perimeter / count, p2 += (perimeter - 4) * (perimeter - 4) / count;
    n_a += (n - 6) * (a - 1) / count, around += (n - 6) * neighbours / count;
    const auto kind = std::min<std::size_t>(tile.vertex.size(), share.size() - 1);
    share[kind] += 1 / count, area_of[kind] += a;
  }
  std::vector<Moment> moments{{"mean number of sides", n1 / count, 6, 0},
                              {"variance of the number of sides", n2, 1.7808, 2.0},
                              {"variance of the area", a2, 0.2802, 0.75},
                              {"skewness of the area", a3 / std::pow(a2, 1.5), 1.031, 5},
                              {"mean perimeter", p1, 4, 0.47},
                              {"variance of the perimeter", p2 - (p1 - 4) * (p1 - 4), 0.9452, 2.1},
                              {"mean length of a wall", l1, 2.0 / 3, 0.08},
                              {"mean square of the length of a wall", l2, 0.63022, 0.28},
                              {"Lewis: slope of the mean area over the number of sides", n_a / n2, 0.2251, 0.35},
                              // n m(n) = (6 - a) n + 6 a + mu2 by least squares over all tiles
                              {"Aboav and Weaire: a", 6 - around / n2, 0.647, 2.6},
                              {"correlation of area and number of sides", n_a / std::sqrt(n2 * a2), 0.5677, 0.6}};
  const std::array<double, 7> shares{.01123, .10684, .25964, .29464, .19858, .09011, .02974},
      spreads{.10, .27, .40, .45, .35, .25, .17};
  for (std::size_t k = 0; k < shares.size(); ++k)
    moments.push_back({fmt::format("share of tiles with {} sides", k + 3), share[k + 3], shares[k], spreads[k]});
  const std::array<double, 3> areas{.7742, .9955, 1.2230}, of_areas{.7, .7, 1.1};
  for (std::size_t k = 0; k < areas.size(); ++k)
    moments.push_back({fmt::format("mean area of tiles with {} sides", k + 5), area_of[k + 5] / (share[k + 5] * count),
                       areas[k], of_areas[k]});
  return moments;
}

}  // namespace lamella
