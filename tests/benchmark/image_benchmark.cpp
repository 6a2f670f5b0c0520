// Time from a picture of 2000 x 2000 pixels and 5041 cells to polygons, by stages; for docs/performance_generator.md, not a
// test.
#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "generator/image/boundaries.h"
#include "generator/image/labels.h"
#include "generator/image/laguerre_fit.h"
#include "generator/image/segment.h"
#include "generator/tissue/image_tissue.h"
#include "generator/tissue/picture_walls.h"

namespace lamella {
namespace {

constexpr int kSide = 2000, kCells = 71;  // pixels, cells along a side

/// Voronoi cells of a disturbed grid, with boundaries that wander by 1.5 pixels.
const Picture& labels_picture() {
  static const Picture picture = [] {
    Picture made;
    made.width = made.height = kSide;
    made.white = 65535;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> within(0.1, 0.9);
    const double step = static_cast<double>(kSide) / kCells;
    std::vector<Vec2> site;
    for (int k = 0; k < kCells * kCells; ++k) {
      const double u = within(random);
      site.emplace_back(step * (k % kCells + u), step * (k / kCells + within(random)));
    }
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const Vec2 p(x + 0.5 + 1.5 * std::sin(0.31 * y), y + 0.5 + 1.5 * std::sin(0.37 * x));
        const int column = static_cast<int>(p.x() / step), row = static_cast<int>(p.y() / step);
        std::uint32_t best = 0;
        double least = 1e9;
        for (int r = std::max(0, row - 2); r <= std::min(kCells - 1, row + 2); ++r)
          for (int c = std::max(0, column - 2); c <= std::min(kCells - 1, column + 2); ++c)
            if (const double d = (p - site[r * kCells + c]).squaredNorm(); d < least) {
              least = d;
              best = static_cast<std::uint32_t>(r * kCells + c + 1);
            }
        made.value.push_back(best);
      }
    return made;
  }();
  return picture;
}

/// The same as a micrograph: walls of two pixels.
Picture grey_picture() {
  Picture picture = labels_picture();
  const Picture& labels = labels_picture();
  picture.white = 255;
  for (std::size_t k = 0; k < picture.value.size(); ++k) {
    const std::size_t right = k % kSide + 1 < kSide ? k + 1 : k,
                      below = k + kSide < picture.value.size() ? k + kSide : k;
    picture.value[k] = labels.value[k] == labels.value[right] && labels.value[k] == labels.value[below] ? 220 : 40;
  }
  return picture;
}

LabelImage labels_of_picture() {
  bool pieces = false;
  return labels_of(labels_picture(), 0, pieces);
}

LabelImage clean() {
  LabelImage labels = labels_of_picture();
  clean_labels(labels, 20);
  return labels;
}

void number_cells(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(labels_of_picture());
}

void clean_cells(benchmark::State& state) {
  const LabelImage labels = labels_of_picture();
  for (auto _ : state) {
    LabelImage copy = labels;
    benchmark::DoNotOptimize(clean_labels(copy, 20));
  }
}

void trace(benchmark::State& state) {
  const LabelImage labels = clean();
  for (auto _ : state) benchmark::DoNotOptimize(trace_boundaries(labels));
}

void simplify(benchmark::State& state) {
  const Boundaries boundaries = trace_boundaries(clean());
  for (auto _ : state) benchmark::DoNotOptimize(simplify_walls(boundaries, 1, 0.05));
}

void find_in_grey(benchmark::State& state) {
  const Picture picture = grey_picture();
  for (auto _ : state) benchmark::DoNotOptimize(segment(picture, {}));
}

void fit_tessellation(benchmark::State& state) {
  const LabelImage labels = clean();
  for (auto _ : state) benchmark::DoNotOptimize(fit_laguerre(labels));
}

/// A file that is gone with the program: binary PGM, two bytes a pixel where one is not enough.
class File {
 public:
  explicit File(const Picture& picture) {
    std::ofstream out(path_, std::ios::binary);
    out << "P5\n" << picture.width << " " << picture.height << "\n" << picture.white << "\n";
    for (const std::uint32_t value : picture.value) {
      if (picture.white > 255) out.put(static_cast<char>(value >> 8));
      out.put(static_cast<char>(value & 255));
    }
  }
  ~File() { std::filesystem::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_ = std::filesystem::temp_directory_path() / "lamella_image_benchmark.pgm";
};

void make_mosaic(benchmark::State& state, const Picture& picture, const char* kind, const char* cells) {
  const File file(picture);
  Scene scene;
  scene.sample.kind = "image";
  scene.sample.image.emplace().file = file.path().string();
  scene.sample.image->pixel = 1e-6;
  scene.sample.image->kind = kind;
  scene.sample.image->cells = cells;
  scene.stages.emplace_back();
  for (auto _ : state) {
    Notes notes;
    Origin origin;
    benchmark::DoNotOptimize(make_image_mosaic(scene, notes, origin));
  }
}

void labels_to_mosaic(benchmark::State& state) { make_mosaic(state, labels_picture(), "labels", "outlines"); }
void micrograph_to_mosaic(benchmark::State& state) { make_mosaic(state, grey_picture(), "grey", "outlines"); }
void labels_to_laguerre_cells(benchmark::State& state) { make_mosaic(state, labels_picture(), "labels", "laguerre"); }

BENCHMARK(labels_to_mosaic)->Unit(benchmark::kMillisecond);
BENCHMARK(micrograph_to_mosaic)->Unit(benchmark::kMillisecond);
BENCHMARK(labels_to_laguerre_cells)->Unit(benchmark::kMillisecond);
BENCHMARK(number_cells)->Unit(benchmark::kMillisecond);
BENCHMARK(clean_cells)->Unit(benchmark::kMillisecond);
BENCHMARK(trace)->Unit(benchmark::kMillisecond);
BENCHMARK(simplify)->Unit(benchmark::kMillisecond);
BENCHMARK(find_in_grey)->Unit(benchmark::kMillisecond);
BENCHMARK(fit_tessellation)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lamella
