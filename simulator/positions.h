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

/// From points, and back. Shape (nodes).
inline Field field_of(const std::vector<Vec2>& points) {
  Field f(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) f.set(i, points[i]);
  return f;
}
inline std::vector<Vec2> points_of(const Field& f) {
  std::vector<Vec2> points(f.size());
  for (std::size_t i = 0; i < f.size(); ++i) points[i] = f.at(i);
  return points;
}
/// From rows of two numbers, as they stand in files, and back. Shape (nodes, 2), row by row.
inline Field field_from(const std::vector<double>& rows) {
  Field f(rows.size() / 2);
  for (std::size_t i = 0; i < f.size(); ++i) f.x[i] = rows[2 * i], f.y[i] = rows[2 * i + 1];
  return f;
}
inline std::vector<double> rows_from(const Field& f) {
  std::vector<double> rows(2 * f.size());
  for (std::size_t i = 0; i < f.size(); ++i) rows[2 * i] = f.x[i], rows[2 * i + 1] = f.y[i];
  return rows;
}

/// Asks for [begin, end) of an array before it is needed. Sweeps go through many arrays in bursts of a block, too short for the
/// hardware to foresee where the next burst begins.
template <class T>
void prefetch(const std::vector<T>& array, std::size_t begin, std::size_t end) {
  constexpr std::size_t line = 64 / sizeof(T);
  for (std::size_t i = begin; i < end; i += line) __builtin_prefetch(array.data() + i, 0, 2);
}

}  // namespace lamella
