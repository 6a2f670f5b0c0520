// Stages and regular tissues for tests of the stepper: no scene file, no generator.
#pragma once
#include <cmath>
#include <numbers>

#include "generator/sample/scene.h"
#include "simulator/model.h"
#include "simulator/steppers/velocity_verlet.h"
#include "tests/simulator/oracles.h"

namespace lamella {

inline CellScene cell_scene(double axial, double bending, double mass_per_length) {
  CellScene cell;
  cell.thickness = 0.02;
  cell.axial_rigidity = axial;
  cell.bending_rigidity = bending;
  cell.mass_per_length = mass_per_length;
  return cell;
}

inline LinkScene link_scene(const char* per, double k_n, double k_t, std::optional<double> strength = {}) {
  LinkScene links;
  links.per = per;
  links.normal_stiffness = k_n;
  links.tangential_stiffness = k_t;
  links.normal_strength = links.tangential_strength = strength;
  return links;
}

/// Links that hold or break, contact, and drag.
inline Stage stage_of(std::optional<double> strength = {}, double friction = 0) {
  Stage stage;
  stage.cells["cells"] = cell_scene(400, 0.5, 1);
  stage.links["links"] = link_scene("length", 800, 300, strength);
  stage.contact = ContactScene{};
  stage.contact->friction = friction;
  stage.drag = DragScene{0.5};
  return stage;
}

/// Regular hexagons of side 1 (of the tiles), `segments` a side, facing centre lines at `gap`, links at all facing pairs. Two walls of each
/// cell are along y. Cell (row, column) has index row * columns + column; wall k faces the direction 120 + 60 k degrees. Along y only an
/// even number of rows repeats.
inline Sample hexagons(int rows, int columns, int segments, double gap, const Periodic& periodic = {false, false}) {
  Sample s;
  const double pi = std::numbers::pi, pitch = std::sqrt(3.0), side = 1 - gap / std::sqrt(3.0);
  const int n = 6 * segments;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const Vec2 centre((c + 0.5 * (r % 2)) * pitch, 1.5 * r);
      std::vector<Vec2> points;
      for (int k = 0; k < 6; ++k) {
        const auto corner = [&](int j) {
          return Vec2(centre + side * Vec2(std::cos(pi / 2 + j * pi / 3), std::sin(pi / 2 + j * pi / 3)));
        };
        for (int j = 0; j < segments; ++j) points.push_back(corner(k) + (corner(k + 1) - corner(k)) * j / segments);
      }
      add_cell(s, points, true, gap / 2, "cells");
    }
  s.tile_area.assign(s.cells(), 1.5 * pitch);
  struct Neighbour {
    Index cell = -1;
    Image image{0, 0};
  };
  const auto index = [&](int r, int c) -> Neighbour {
    const int right = c < 0 ? -1 : c / columns, up = r < 0 ? -1 : r / rows;  // at most one step beyond the sides
    if ((right != 0 && !periodic[0]) || (up != 0 && !periodic[1])) return {};
    return {(r - up * rows) * columns + c - right * columns,
            {static_cast<std::int8_t>(right), static_cast<std::int8_t>(up)}};
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const int odd = r % 2, me = r * columns + c;
      const Neighbour neighbours[6] = {index(r + 1, c - 1 + odd), index(r, c - 1), index(r - 1, c - 1 + odd),
                                       index(r - 1, c + odd),     index(r, c + 1), index(r + 1, c + odd)};
      for (int k = 0; k < 6; ++k) {
        const auto& [neighbour, image] = neighbours[k];
        if (neighbour < me || (neighbour == me && !(image > Image{0, 0}))) continue;
        s.walls.push_back({me, neighbour, side});
        for (int j = 0; j <= segments; ++j) {
          const auto of_a = [&](int i) { return s.cell_begin[me] + (k * segments + i) % n; };
          const Index first_b = s.cell_begin[neighbour];
          const auto of_b = [&](int i) { return first_b + ((k + 3) % 6 * segments + segments - i) % n; };
          const bool first = j == 0, last = j == segments;
          Link link;
          link.a = of_a(j), link.b = of_b(j);
          link.a_prev = of_a(first ? j : j - 1), link.a_next = of_a(last ? j : j + 1);
          link.b_next = of_b(first ? j : j - 1), link.b_prev = of_b(last ? j : j + 1);
          link.wall = static_cast<Index>(s.walls.size()) - 1;
          link.wall_end = first || last;
          link.spacing = side / segments;
          link.length = first || last ? link.spacing / 2 : link.spacing;
          link.offset_n = gap;
          s.links.push_back(link);
          if (periodic[0] || periodic[1]) s.link_image.push_back(image);
        }
      }
    }
  s.box = {{-pitch / 2, -1}, {(columns - 0.5) * pitch, 1.5 * rows - (periodic[1] ? 1 : 0.5)}};
  s.periodic = periodic;
  return s;
}

/// A model with its loads and stepper, at rest at time 0.
struct Rig {
  Rig(const Sample& sample, const Stage& stage, std::vector<Load> with = {}, int threads = 1)
      : state{field_of(sample.x), Field(sample.nodes()), 0, 0},
        model(build_model(sample, stage, state.x)),
        loads(std::move(with)),
        stepper(*model, loads, state, threads) {}

  double energy() const { return model->energy(state.x); }

  State state;
  std::unique_ptr<Model> model;
  std::vector<Load> loads;
  VelocityVerlet stepper;
};

/// Holds whole cells and moves them at a constant velocity.
inline Load moving_cells(const Sample& s, const std::vector<Index>& cells, const Vec2& velocity) {
  Load load;
  load.holds[0] = load.holds[1] = true;
  load.velocity = velocity;
  for (Index c : cells)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) load.nodes.push_back(i);
  return load;
}

}  // namespace lamella
