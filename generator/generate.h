// The generator's front door: a scene in, a sample out, and on request what the sample was made from.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "generator/packing/packing.h"
#include "generator/sample/sample.h"
#include "generator/sample/scene.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// Facts that the user should see: what was welded, hidden, dropped or merged, the shortest segment and what it costs.
using Notes = std::vector<std::string>;

/// What a sample was made from: for statistics and for other programs. Empty where a scene has no such thing.
struct Origin {
  Packing packing;  // the disks; of tissues and rings
  std::vector<Disk>
      sites;  // whose Laguerre tiles the tiles are, but for welding: with exact areas not the disks; maybe none
  std::vector<double> asked;  // in proportion, areas that [sample.areas] prescribes for each site; else empty
  Mosaic tiles;               // of which the walls were inset, tile k that of cell k; shapes have none
  Index hidden = 0;           // disks without a tile
  Index welded = 0;           // edges that were welded to a point
};

/// Makes the sample that the scene asks for; same scene and seed, same sample, bit for bit.
/// `progress(done, what)` is called with done in [0, 1]. `origin`: filled when given. Every sample that is returned has
/// passed check_sample, and its tiles check_tiles and, before welding, check_powers and check_disks. Throws SceneError where the scene cannot be met.
Sample generate(const Scene& scene, Notes& notes, const std::function<void(double, const std::string&)>& progress = {},
                Origin* origin = nullptr);

/// Invariants of a sample, as a list of violations (empty: all hold). Arrays fit together and indices are in range; cells
/// are closed and counter-clockwise, no smaller at rest than their tiles allow; rest data are finite and positive; walls
/// have two sides; links are sorted, unique, between the cells of their wall, face each other, are free of force and
/// stand for no more than their wall; no shell crosses itself or another, across periodic sides neither; tiles take no
/// more than the box. `filled`: area that the tiles must fill exactly [m2]; 0: not known.
std::vector<std::string> check_sample(const Sample& sample, double filled = 0);

}  // namespace lamella
