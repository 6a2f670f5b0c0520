// Times the search for weights that give every cell its area: the table of docs/generation.md, in Markdown.
//   area_speed [LARGEST_NUMBER_OF_CELLS [SMALLEST]]
#include <fmt/core.h>
#include <time.h>

#include <cstdlib>
#include <numbers>

#include "generator/packing/exact_areas.h"
#include "generator/packing/random_sites.h"
#include "generator/packing/sizes.h"

namespace lamella {
namespace {

/// Processor time: what the wall clock shows on one thread of an idle machine [s].
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Case {
  bool packed;  // else random sites
  double cv;    // of the disks' radii, or for random sites of the areas
  bool torus;   // else box
  int sweeps;
};

void time_case(const Case& c, int count) {
  SizesScene sizes;
  sizes.cv = c.cv;
  if (c.cv == 0) sizes.distribution = "uniform";
  PackingScene scene;
  scene.count = count;
  scene.fraction = 0.5;
  if (c.torus) scene.boundary = "periodic";
  const std::vector<double> radii = draw_radii(sizes, count, 1, {});
  const Packing packing = c.packed ? pack(scene, radii, 1, 1, 1) : scattered(scene, radii, 1, 1, 1);
  std::vector<Vec2> centres;
  std::vector<double> start, shares;
  for (const Disk& disk : packing.disks) {
    centres.push_back(disk.centre);
    shares.push_back(c.packed ? disk.radius * disk.radius : disk.radius);
    start.push_back(c.packed ? shares.back() : 0);
  }
  AreaProblem problem = tile_problem(packing.box, {c.torus, c.torus}, centres, shares);
  const double before = processor_seconds();
  const Weights found = lloyd_sweeps(problem, start, c.sweeps, {.tolerance = 1e-9});
  const double seconds = processor_seconds() - before;
  const auto [low, high] = std::minmax_element(shares.begin(), shares.end());
  double circularity = 0, walls = 0, short_walls = 0;
  const Tessellation tiles =
      tessellate(problem.centres, found.weight, packing.box, {Duplicates::kRefuse, Hidden::kRefuse, problem.periodic});
  const double mean = std::sqrt(packing.box.area() / count);
  for (const Tile& tile : tiles.tiles) {
    double perimeter = 0;
    for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
      const double length = edge_length(tiles, tile, k);
      perimeter += length;
      walls += 1, short_walls += length < 0.05 * mean;
    }
    circularity += 4 * std::numbers::pi * tile_area(tiles, tile) / (perimeter * perimeter) / count;
  }
  fmt::print("| {} | {} | {} | {} | {:.2g} | {} | {} / {} | {:.2f} | {:.1g} | {:.3f} | {:.1f} |\n",
             c.packed ? "packing" : "random", c.torus ? "torus" : "box", c.cv, count, *high / *low, c.sweeps,
             found.iterations, found.diagrams, seconds, found.error, circularity, 100 * short_walls / walls);
  std::fflush(stdout);
}

}  // namespace
}  // namespace lamella

int main(int argc, char** argv) {
  const int most = argc > 1 ? std::atoi(argv[1]) : 100000, least = argc > 2 ? std::atoi(argv[2]) : 100;
  fmt::print(
      "| sites | domain | CV | cells | largest / smallest area | sweeps | iterations / diagrams | time [s] | largest "
      "error "
      "| circularity | walls < 0.05 h [%] |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const double cv : {0.0, 0.6, 1.0})
    for (const int sweeps : {0, 1, 5, 20})
      if (least <= 10000) lamella::time_case({false, cv, true, sweeps}, std::min(most, 10000));
  for (int count = least; count <= most; count *= 10)
    for (const bool packed : {false, true})
      for (const bool torus : {false, true})
        for (const double cv : {0.0, 0.6, 1.0}) lamella::time_case({packed, cv, torus, 0}, count);
}
