// Laguerre diagrams of disks that do not overlap, in a box and on the torus: tiles, and the measures of tiles alone.
#include <benchmark/benchmark.h>

#include "generator/packing/laguerre.h"
#include "tests/generator/packing/random_disks.h"

namespace lamella {
namespace {

const Box kUnit{{0, 0}, {1, 1}};

/// Number of disks, coefficient of variation of their radii in tenths, whether on the torus.
std::vector<Disk> disks_of(const benchmark::State& state) {
  return apart_disks(static_cast<int>(state.range(0)), 0.1 * static_cast<double>(state.range(1)), 0.5,
                     state.range(2) != 0, 1);
}

Periodic periodic_of(const benchmark::State& state) { return {state.range(2) != 0, state.range(2) != 0}; }

void tiles(benchmark::State& state) {
  const auto disks = disks_of(state);
  for (auto _ : state) benchmark::DoNotOptimize(tessellate(disks, kUnit, {.periodic = periodic_of(state)}));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void measures_of_tiles(benchmark::State& state) {
  std::vector<Vec2> centres;
  std::vector<double> weights;
  for (const Disk& disk : disks_of(state)) {
    centres.push_back(disk.centre);
    weights.push_back(disk.radius * disk.radius);
  }
  for (auto _ : state) benchmark::DoNotOptimize(measure_tiles(centres, weights, kUnit, periodic_of(state)));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"disks", "variation_in_tenths", "torus"});
  for (const int torus : {0, 1})
    for (const int variation : {3, 10})
      for (const int count : {100, 1000, 10000, 100000, 1000000}) benchmark->Args({count, variation, torus});
  benchmark->Unit(benchmark::kMillisecond);
}

BENCHMARK(tiles)->Apply(sizes);
BENCHMARK(measures_of_tiles)->Apply(sizes);

}  // namespace
}  // namespace lamella
