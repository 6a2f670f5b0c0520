// Small mosaics and random ones for the tests of the generator.
#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "generator/tissue/mosaic.h"

namespace lamella {

/// Columns x rows unit squares; edges on the box's sides carry their bits.
inline Mosaic squares(int columns, int rows) {
  Mosaic mosaic;
  mosaic.box = {Vec2::Zero(), Vec2(columns, rows)};
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) mosaic.vertices.emplace_back(i, j);
  const auto at = [&](int i, int j) { return static_cast<Index>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      MosaicCell cell;
      cell.vertex = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      cell.side = {static_cast<std::uint8_t>(j == 0 ? kBottom : 0),
                   static_cast<std::uint8_t>(i + 1 == columns ? kRight : 0),
                   static_cast<std::uint8_t>(j + 1 == rows ? kTop : 0), static_cast<std::uint8_t>(i == 0 ? kLeft : 0)};
      cell.name = "square " + std::to_string(i) + "," + std::to_string(j);
      mosaic.cells.push_back(cell);
    }
  return mosaic;
}

/// Voronoi cells of random points in the unit square, by cutting the square with every bisector: an irregular
/// tissue. Vertices are joined by rounding, good enough for a test.
inline Mosaic voronoi(int count, unsigned seed, double least_distance) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<Vec2> sites;
  while (static_cast<int>(sites.size()) < count) {
    const Vec2 p(uniform(), uniform());
    if (std::all_of(sites.begin(), sites.end(), [&](const Vec2& q) { return (p - q).norm() > least_distance; }))
      sites.push_back(p);
  }
  Mosaic mosaic;
  mosaic.box = {Vec2::Zero(), Vec2::Ones()};
  std::map<std::pair<long, long>, Index> known;
  const auto id = [&](const Vec2& p) {
    const auto key = std::pair{std::lround(p.x() * 1e9), std::lround(p.y() * 1e9)};
    for (long dx = -1; dx <= 1; ++dx)
      for (long dy = -1; dy <= 1; ++dy)
        if (const auto found = known.find({key.first + dx, key.second + dy}); found != known.end())
          return found->second;
    known[key] = static_cast<Index>(mosaic.vertices.size());
    mosaic.vertices.push_back(p);
    return known[key];
  };
  for (int i = 0; i < count; ++i) {
    std::vector<Vec2> polygon{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int j = 0; j < count; ++j) {
      if (j == i) continue;
      const Vec2 normal = sites[j] - sites[i];
      const double level = normal.dot(sites[i] + sites[j]) / 2;
      std::vector<Vec2> left;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2& a = polygon[k];
        const Vec2& b = polygon[(k + 1) % polygon.size()];
        const double da = normal.dot(a) - level;
        const double db = normal.dot(b) - level;
        if (da <= 0) left.push_back(a);
        if (da * db < 0) left.push_back(a + (b - a) * da / (da - db));
      }
      polygon = left;
    }
    MosaicCell cell;
    for (const Vec2& p : polygon) {
      const Index v = id(p);
      if (cell.vertex.empty() || (cell.vertex.back() != v && cell.vertex.front() != v)) cell.vertex.push_back(v);
    }
    for (std::size_t k = 0; k < cell.vertex.size(); ++k) {
      const Vec2& a = mosaic.vertices[cell.vertex[k]];
      const Vec2& b = mosaic.vertices[cell.vertex[(k + 1) % cell.vertex.size()]];
      std::uint8_t bits = 0;
      if (a.x() < 1e-12 && b.x() < 1e-12) bits |= kLeft;
      if (a.x() > 1 - 1e-12 && b.x() > 1 - 1e-12) bits |= kRight;
      if (a.y() < 1e-12 && b.y() < 1e-12) bits |= kBottom;
      if (a.y() > 1 - 1e-12 && b.y() > 1 - 1e-12) bits |= kTop;
      cell.side.push_back(bits);
    }
    cell.name = "site " + std::to_string(i);
    mosaic.cells.push_back(cell);
  }
  return mosaic;
}

}  // namespace lamella
