// The smallest samples that can show an effect. Lengths in metres, about one.
#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "generator/sample/sample.h"

namespace lamella {

/// An open chain of n segments along x, from the origin to (length, 0).
inline Sample chain_sample(int segments, double length = 1, double radius = 0.05) {
  Sample sample;
  std::vector<Vec2> points;
  for (int i = 0; i <= segments; ++i) points.emplace_back(length * i / segments, 0);
  add_cell(sample, points, false, radius, "cells");
  sample.box = {{-radius, -radius}, {length + radius, radius}};
  return sample;
}

/// A regular polygon of n nodes on a circle about the origin.
inline Sample ring_sample(int nodes, double size = 1, double radius = 0.05) {
  Sample sample;
  std::vector<Vec2> points;
  for (int i = 0; i < nodes; ++i) {
    const double angle = 2 * std::numbers::pi * i / nodes;
    points.emplace_back(size * std::cos(angle), size * std::sin(angle));
  }
  add_cell(sample, points, true, radius, "cells");
  sample.tile_area = sample.rest_area;
  const double half = size + radius;
  sample.box = {{-half, -half}, {half, half}};
  return sample;
}

/// Two squares of side 1, n segments a side, the second 2 r above the first, whose facing sides are linked node to node.
/// The lowest nodes are on the bottom of the box, the highest on its top.
inline Sample two_bonded_squares(int segments = 4, double radius = 0.05) {
  Sample sample;
  const double gap = 2 * radius;
  const double spacing = 1.0 / segments;
  for (int cell = 0; cell < 2; ++cell) {
    const Vec2 lo{0, cell * (1 + gap)};
    std::vector<Vec2> points;
    for (int i = 0; i < segments; ++i) points.push_back(lo + Vec2{i * spacing, 0});
    for (int i = 0; i < segments; ++i) points.push_back(lo + Vec2{1, i * spacing});
    for (int i = 0; i < segments; ++i) points.push_back(lo + Vec2{1 - i * spacing, 1});
    for (int i = 0; i < segments; ++i) points.push_back(lo + Vec2{0, 1 - i * spacing});
    add_cell(sample, points, true, radius, "cells");
  }
  sample.box = {{-radius, -radius}, {1 + radius, 2 + gap + radius}};
  sample.tile_area.assign(2, sample.box.area() / 2);
  for (int i = 0; i <= segments; ++i) {
    sample.side[i] = kBottom;
    sample.side[4 * segments + 2 * segments + i] = kTop;
  }
  sample.walls.push_back({0, 1, 1.0});
  // The first cell's upper side runs from right to left, so the second's lower side is passed backwards.
  for (int i = 0; i <= segments; ++i) {
    const bool first = i == 0, last = i == segments;
    Link link;
    link.a = 2 * segments + i;
    link.b = 4 * segments + segments - i;
    link.a_prev = first ? link.a : link.a - 1;
    link.a_next = last ? link.a : link.a + 1;
    link.b_prev = last ? link.b : link.b - 1;
    link.b_next = first ? link.b : link.b + 1;
    link.wall_end = first || last ? 1 : 0;
    link.length = first || last ? spacing / 2 : spacing;
    link.spacing = spacing;
    link.offset_n = gap;
    sample.links.push_back(link);
  }
  return sample;
}

}  // namespace lamella
