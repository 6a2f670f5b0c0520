// Times the search for weights that give every cell its area. Writes one `name value` a line.
//   area_speed random|packing box|torus CV CELLS SWEEPS
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "generator/packing/exact_areas.h"
#include "generator/packing/random_sites.h"
#include "generator/packing/sizes.h"
#include "pipelines/performance/timed.h"

namespace lamella {
namespace {

struct Case {
  bool packed;  // else random sites
  bool torus;   // else box
  double cv;    // of the disks' radii, or for random sites of the areas
  int count, sweeps;
};

/// Mean of 4 pi A / P^2, and the share of walls below 0.05 of the square root of the mean area.
void describe_tiles(const Tessellation& tiles) {
  double circularity = 0, walls = 0, short_walls = 0;
  const auto count = static_cast<double>(tiles.tiles.size());
  const double mean = std::sqrt(tiles.box.area() / count);
  for (const Tile& tile : tiles.tiles) {
    double perimeter = 0;
    for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
      const double length = edge_length(tiles, tile, k);
      perimeter += length;
      walls += 1, short_walls += length < 0.05 * mean;
    }
    circularity += 4 * std::numbers::pi * tile_area(tiles, tile) / (perimeter * perimeter) / count;
  }
  fmt::print("circularity {:.3f}\nshort_walls {:.1f}\n", circularity, 100 * short_walls / walls);
}

void time_case(const Case& c) {
  SizesScene sizes;
  sizes.cv = c.cv;
  if (c.cv == 0) sizes.distribution = "uniform";
  PackingScene scene;
  scene.count = c.count;
  scene.fraction = 0.5;
  if (c.torus) scene.boundary = "periodic";
  const std::vector<double> radii = draw_radii(sizes, c.count, 1, {});
  const PackingSpace square{1, 1, nullptr, {}};
  const Packing packing = c.packed ? pack(scene, radii, square, 1) : scattered(scene, radii, square, 1);
  std::vector<Vec2> centres;
  std::vector<double> start, shares;
  for (const Disk& disk : packing.disks) {
    centres.push_back(disk.centre);
    shares.push_back(c.packed ? disk.radius * disk.radius : disk.radius);
    start.push_back(c.packed ? shares.back() : 0);
  }
  AreaProblem problem = tile_problem(packing.box, {c.torus, c.torus}, centres, shares);
  Weights found;
  const double seconds = seconds_of([&] {
    problem.centres = centres;  // sweeps move them
    found = lloyd_sweeps(problem, start, c.sweeps, {.tolerance = 1e-9});
  });
  const auto [low, high] = std::minmax_element(shares.begin(), shares.end());
  fmt::print("seconds {:.4g}\nmegabytes {:.1f}\niterations {}\ndiagrams {}\nerror {:.1g}\nratio {:.2g}\n", seconds,
             peak_megabytes(), found.iterations, found.diagrams, found.error, *high / *low);
  describe_tiles(
      tessellate(problem.centres, found.weight, packing.box, {Duplicates::kRefuse, Hidden::kRefuse, problem.periodic}));
}

}  // namespace
}  // namespace lamella

int main(int count, char** arguments) {
  if (count != 6) {
    fmt::print(stderr, "area_speed: random|packing box|torus CV CELLS SWEEPS\n");
    return 2;
  }
  try {
    lamella::time_case({arguments[1] == std::string("packing"), arguments[2] == std::string("torus"),
                        std::stod(arguments[3]), std::stoi(arguments[4]), std::stoi(arguments[5])});
  } catch (const std::exception& e) {
    fmt::print(stderr, "area_speed: {}\n", e.what());
    return 2;
  }
}
