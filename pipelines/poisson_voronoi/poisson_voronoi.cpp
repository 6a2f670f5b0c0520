// Tiles of points placed at random on the torus, against what is known of Poisson-Voronoi tilings, and the identities that hold for any tiling.
#include <fmt/format.h>

#include <cmath>

#include "generator/packing/laguerre.h"
#include "generator/packing/random.h"
#include "pipelines/poisson_voronoi/moments.h"
#include "pipelines/studies/study.h"

namespace lamella {
namespace {

const Box kUnit{{0, 0}, {1, 1}};

std::vector<Disk> random_points(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Disk> points(count);
  for (Disk& point : points) {
    const double x = random.unit(), y = random.unit();
    point.centre = {x, y};
  }
  return points;
}

void identities(StudyReport& report, const Tessellation& t) {
  report.section("What holds for every tiling of the torus");
  report.text(
      "Each wall has two sides with the same two vertices, V - E + F = 0, tiles are convex (`check_tessellation`); "
      "three "
      "walls at each vertex, so that V = 2 F and E = 3 F; and the sum rule of Weaire, <n m(n)> = 36 + mu2, which on "
      "the "
      "torus is a count: both sides are the sum of n squared.");
  const auto faults = check_tessellation(t);
  report.holds("all invariants", faults.empty(), faults.empty() ? "no fault" : faults.front());
  double area = 0;
  std::vector<long> sides(t.tiles.size(), 0);
  for (const Tile& tile : t.tiles) {
    area += tile_area(t, tile);
    sides[tile.site] = static_cast<long>(tile.vertex.size());
  }
  long walls = 0, neighbours = 0, squares = 0;
  for (const Tile& tile : t.tiles) {
    walls += sides[tile.site], squares += sides[tile.site] * sides[tile.site];
    for (const Index other : tile.neighbour) neighbours += sides[other];
  }
  const auto tiles = static_cast<double>(t.tiles.size());
  report.compare_absolute("sum of the areas over that of the torus", area, 1, 1e-12);
  report.compare("vertices for each tile", static_cast<double>(t.vertices.size()) / tiles, 2, 0);
  report.compare("sides of walls for each tile", static_cast<double>(walls) / tiles, 6, 0);
  report.compare("sum of n m(n) over sum of n squared", static_cast<double>(neighbours) / static_cast<double>(squares),
                 1, 0);
}

}  // namespace

void study_poisson_voronoi(StudyBench& bench) {
  StudyReport& report = bench.report;
  const std::size_t count = bench.small() ? 20000 : 1000000;
  bench.say(fmt::format("{} points on the torus", count));
  LaguerreOptions options;
  options.periodic = {true, true};
  const Tessellation t = tessellate(random_points(count, 2026), kUnit, options);
  identities(report, t);
  report.section("Moments of Poisson-Voronoi tilings");
  report.text(
      fmt::format("{} points. Lengths in units of the root of the mean area. Allowed are four standard deviations of "
                  "such a tiling, c / "
                  "sqrt(N) each. Var n = 1.7808 and var A = 0.2802 are Brakke's; mean numbers, perimeters (4) and "
                  "lengths (2/3) are "
                  "exact; the others are means over five tilings of 1e6 points by another program.",
                  count));
  for (const Moment& m : poisson_voronoi_moments(t))
    report.compare_absolute(m.name, m.found, m.expected, 4 * m.spread / std::sqrt(static_cast<double>(count)));
}

}  // namespace lamella
