// Times voro++ on the same sites: a slab whose cells are prisms over the Laguerre tiles.
//   voro_speed SITES box|torus AREAS
#include <cmath>
#include <string>
#include <voro++/voro++.hh>

#include "pipelines/performance/timed.h"

namespace lamella {
namespace {

void run(const char* path, bool torus, const char* out) {
  const std::vector<double> numbers = read_numbers(path);
  const int count = static_cast<int>(numbers.size() / 3);
  // As many blocks as hold some five sites each, as its manual advises; one of them is as thick as it is wide.
  const int blocks = std::max(1, static_cast<int>(std::sqrt(count / 5.0)));
  const double thickness = 1.0 / blocks;
  std::vector<double> areas(count, 0);
  const double seconds = seconds_of([&] {
    voro::container_poly container(0, 1, 0, 1, -thickness / 2, thickness / 2, blocks, blocks, 1, torus, torus, false,
                                   8);
    for (int i = 0; i < count; ++i) container.put(i, numbers[3 * i], numbers[3 * i + 1], 0, numbers[3 * i + 2]);
    voro::c_loop_all loop(container);
    voro::voronoicell cell;
    if (loop.start()) do {
        if (container.compute_cell(cell, loop)) areas[loop.pid()] = cell.volume() / thickness;
      } while (loop.inc());
  });
  fmt::print("seconds {:.6g}\nmegabytes {:.1f}\n", seconds, peak_megabytes());
  write_numbers(out, areas);
}

}  // namespace
}  // namespace lamella

int main(int count, char** arguments) {
  if (count != 4) {
    fmt::print(stderr, "voro_speed: SITES box|torus AREAS\n");
    return 2;
  }
  try {
    lamella::run(arguments[1], arguments[2] == std::string("torus"), arguments[3]);
  } catch (const std::exception& e) {
    fmt::print(stderr, "voro_speed: {}\n", e.what());
    return 2;
  }
}
