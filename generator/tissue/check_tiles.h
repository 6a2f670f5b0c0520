// The invariants of the tiles of a tissue: what walls were inset from.
#pragma once
#include <string>
#include <vector>

#include "generator/sample/scene.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// What tiles must fill without a gap.
struct Filled {
  bool known = false;  // else nothing is asked of what follows
  int euler = 1;       // V - E + F: 1 less a hole each; 0 where something repeats
  double area = 0;     // [m2]; 0: not known
  double around = 0;   // length of its boundary, which does not repeat [m]; asked for where the area is
};

/// What the tiles of a scene must fill: a box, a domain, or, of a honeycomb that does not repeat, a patch without holes. Not known of pictures
/// and polygons, which may leave out what they like, nor where a notch takes cells away.
Filled filled_by(const SampleScene& scene, const Box& box);

/// Every violated invariant in words (empty: all hold). A tile has at least three corners and a positive area; every wall has exactly two
/// sides, and where the mosaic repeats both ways there is nothing else; V - E + F is what it must be; areas sum to what they must fill and free edges to
/// its boundary, to 1e-12; on a torus the sum rule of Weaire, as a count. O(edges log(edges)).
std::vector<std::string> check_tiles(const Mosaic& tiles, const Filled& filled);

}  // namespace lamella
