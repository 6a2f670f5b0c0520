// Time to pack disks on a torus, one thread; for docs/performance_generator.md, not a test.
#include <benchmark/benchmark.h>

#include "generator/packing/packing.h"
#include "generator/packing/sizes.h"

namespace lamella {
namespace {

/// Arguments: number of disks, coefficient of variation of the radii and fraction, both in percent.
void pack_lognormal(benchmark::State& state) {
  SizesScene sizes;
  sizes.cv = static_cast<double>(state.range(1)) / 100;
  PackingScene scene;
  scene.boundary = "periodic";
  scene.fraction = static_cast<double>(state.range(2)) / 100;
  const auto radii = draw_radii(sizes, static_cast<int>(state.range(0)), 1, {});
  std::uint64_t seed = 0;
  for (auto _ : state) benchmark::DoNotOptimize(pack(scene, radii, 0, 0, ++seed));
  state.counters["disks/s"] =
      benchmark::Counter(static_cast<double>(state.iterations() * state.range(0)), benchmark::Counter::kIsRate);
}
BENCHMARK(pack_lognormal)
    ->ArgNames({"disks", "cv", "fraction"})
    ->ArgsProduct({{100, 1000, 10000}, {0, 30, 60, 100}, {70, 80, 83}})
    ->ArgsProduct({{10000}, {0, 30, 60, 100}, {84}})
    ->ArgsProduct({{100000}, {0, 30, 60, 100}, {70, 83}})
    ->Unit(benchmark::kMillisecond);

/// The same, compressed until jammed: 1.4:1, half of each.
void jam_bidisperse(benchmark::State& state) {
  SizesScene sizes;
  sizes.distribution = "bidisperse";
  PackingScene scene;
  scene.boundary = "periodic";
  scene.jammed = true;
  const auto radii = draw_radii(sizes, static_cast<int>(state.range(0)), 1, {});
  std::uint64_t seed = 0;
  for (auto _ : state) benchmark::DoNotOptimize(pack(scene, radii, 0, 0, ++seed));
}
BENCHMARK(jam_bidisperse)->ArgName("disks")->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lamella
