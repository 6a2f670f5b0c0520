// Times Laguerre diagrams of the unit square, for comparison with other programs on the same sites.
//   diagram_speed sites COUNT CV box|torus SITES          writes x, y, r of each: disks apart that fill half of it
//   diagram_speed tiles SITES box|torus AREAS             tiles, and the area of each
//   diagram_speed measures SITES box|torus                areas, centroids and walls alone
//   diagram_speed compare AREAS OTHER                     largest relative difference
#include <algorithm>
#include <cmath>
#include <string>

#include "generator/packing/laguerre.h"
#include "generator/packing/sizes.h"
#include "pipelines/performance/timed.h"

namespace lamella {
namespace {

const Box kUnit{{0, 0}, {1, 1}};

void write_sites(int count, double cv, bool torus, const char* path) {
  SizesScene sizes;
  sizes.cv = cv;
  PackingScene scene;
  scene.fraction = 0.5;
  if (torus) scene.boundary = "periodic";
  std::vector<double> numbers;
  for (const Disk& disk : pack(scene, draw_radii(sizes, count, 1, {}), 1, 1, 1).disks) {
    // Across a periodic side the centre of a disk may lie anywhere; other programs want it in the square.
    for (const double x : {disk.centre.x(), disk.centre.y()}) numbers.push_back(torus ? x - std::floor(x) : x);
    numbers.push_back(disk.radius);
  }
  write_numbers(path, numbers);
}

std::vector<Disk> read_disks(const char* path) {
  const std::vector<double> numbers = read_numbers(path);
  std::vector<Disk> disks;
  for (std::size_t k = 0; k + 3 <= numbers.size(); k += 3)
    disks.push_back({{numbers[k], numbers[k + 1]}, numbers[k + 2]});
  return disks;
}

void time_tiles(const char* path, bool torus, const char* out) {
  const std::vector<Disk> disks = read_disks(path);
  std::vector<double> areas(disks.size(), 0);
  const double seconds = seconds_of([&] {
    const Tessellation t = tessellate(disks, kUnit, {.periodic = {torus, torus}});
    for (const Tile& tile : t.tiles) areas[tile.site] = tile_area(t, tile);
  });
  fmt::print("seconds {:.6g}\nmegabytes {:.1f}\n", seconds, peak_megabytes());
  write_numbers(out, areas);
}

void time_measures(const char* path, bool torus) {
  std::vector<Vec2> centres;
  std::vector<double> weights;
  for (const Disk& disk : read_disks(path)) {
    centres.push_back(disk.centre);
    weights.push_back(disk.radius * disk.radius);
  }
  const double seconds = seconds_of([&] { measure_tiles(centres, weights, kUnit, {torus, torus}); });
  fmt::print("seconds {:.6g}\nmegabytes {:.1f}\n", seconds, peak_megabytes());
}

void compare(const char* path, const char* other) {
  const std::vector<double> ours = read_numbers(path), theirs = read_numbers(other);
  if (ours.size() != theirs.size()) throw std::runtime_error("not the same number of areas");
  double largest = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) largest = std::max(largest, std::abs(theirs[i] / ours[i] - 1));
  fmt::print("{:.0e}\n", largest);
}

int run(int count, char** arguments) {
  const std::string what = count > 1 ? arguments[1] : "";
  const int needed = what == "sites" ? 6 : what == "tiles" ? 5 : what == "measures" || what == "compare" ? 4 : 0;
  if (count != needed) {
    fmt::print(stderr,
               "diagram_speed: sites COUNT CV box|torus SITES | tiles SITES box|torus AREAS | measures SITES "
               "box|torus | compare AREAS OTHER\n");
    return 2;
  }
  const bool torus = arguments[what == "sites" ? 4 : 3] == std::string("torus");
  if (what == "sites") write_sites(std::stoi(arguments[2]), std::stod(arguments[3]), torus, arguments[5]);
  if (what == "tiles") time_tiles(arguments[2], torus, arguments[4]);
  if (what == "measures") time_measures(arguments[2], torus);
  if (what == "compare") compare(arguments[2], arguments[3]);
  return 0;
}

}  // namespace
}  // namespace lamella

int main(int count, char** arguments) {
  try {
    return lamella::run(count, arguments);
  } catch (const std::exception& e) {
    fmt::print(stderr, "diagram_speed: {}\n", e.what());
    return 2;
  }
}
