// Node fields of the simulator: structure of arrays, so that inner loops vectorise.
#pragma once
#include <vector>

#include "generator/sample/vec.h"

namespace lamella {

/// One vector per node, components apart. Shape (nodes) each.
struct Field {
  std::vector<double> x, y;

  Field() = default;
  explicit Field(std::size_t nodes) : x(nodes, 0.0), y(nodes, 0.0) {}
  std::size_t size() const { return x.size(); }
  Vec2 at(std::size_t node) const { return {x[node], y[node]}; }
  void set(std::size_t node, const Vec2& v) { x[node] = v.x(), y[node] = v.y(); }
  void add(std::size_t node, const Vec2& v) { x[node] += v.x(), y[node] += v.y(); }
};

/// Asks for [begin, end) of an array before it is needed. Sweeps go through many arrays in bursts of a block, too short for the
/// hardware to foresee where the next burst begins.
template <class T>
void prefetch(const std::vector<T>& array, std::size_t begin, std::size_t end) {
  constexpr std::size_t line = 64 / sizeof(T);
  for (std::size_t i = begin; i < end; i += line) __builtin_prefetch(array.data() + i, 0, 2);
}

}  // namespace lamella
