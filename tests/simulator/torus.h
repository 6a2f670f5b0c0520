// Honeycombs that repeat both ways, and a scene that pulls their box.
#pragma once
#include <random>
#include <string>
#include <vector>

#include "tests/simulator/tissues.h"

namespace lamella {

inline Sample torus(int rows = 2, int columns = 2, int segments = 2) {
  return hexagons(rows, columns, segments, 0.1, {true, true});
}

/// Strengths that differ from link to link, the same for a link and its twins in a box of more periods.
inline Sample varied(Sample s, unsigned seed = 1) {
  std::mt19937 random(seed);
  for (std::size_t l = 0; l < s.links.size(); ++l) s.link_strength.push_back(0.5 + random() / 4294967296.0);
  return s;
}

inline Scene scene_of(const std::vector<std::string>& settings = {}) {
  return parse_scene(R"(
[sample]
kind = "honeycomb"
columns = 4
rows = 4
side = 1
periodic = "xy"
walls = { segments = 2 }
[cells]
axial_rigidity = 400
bending_rigidity = 0.5
mass_per_length = 1
radius = 0.05
[links]
normal_stiffness = 800
tangential_stiffness = 300
normal_strength = 6
tangential_strength = 6
[contact]
friction = 0.3
[loading]
strain_rate = 1
strain = 0.4
normal_only = true
[stop]
separated = true
[run]
stepper = "quasi_static"
[output]
frames = 20
response = 100
)",
                     "torus", settings);
}

}  // namespace lamella
