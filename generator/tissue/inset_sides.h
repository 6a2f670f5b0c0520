// The edges of all cells of a mosaic, each moved inwards by its cell's distance: what a wall is made of.
#pragma once
#include <vector>

#include "generator/generate.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// One edge of a cell, moved inwards, and the part of it that faces another cell. Positions along it are measured from
/// its first vertex.
struct InsetSide {
  Vec2 start = Vec2::Zero(), along = Vec2::Zero();
  double from = 0, to = 0;   // between the inset corners
  bool present = false;      // has not vanished
  double low = 0, high = 0;  // facing part; low > high: none
  Index first_pair = -1;     // of this edge, in the order of the cell of lower index
  Index pairs = 0;
  bool faces() const { return pairs > 0; }
};

using Sides = std::vector<std::vector<InsetSide>>;

/// Of every edge of every cell. Throws SceneError naming the cells that vanish or fall apart; notes the edges that vanish.
Sides inset_sides(const Mosaic& mosaic, const std::vector<double>& distances, Notes& notes);

/// Length of the whole edge `s`, whose other side `o` lies where it borders s when it is displaced.
double edge_length(const InsetSide& s, const InsetSide& o, const Vec2& displaced);

/// Facing part of an edge `s` of this length and of its other side `o`, in the positions of `s`.
void overlap(const InsetSide& s, const InsetSide& o, double length, double& low, double& high);

/// Mean length of the facing parts [m]; of the inset edges where nothing faces anything.
double mean_overlap(const Sides& sides, const std::vector<std::vector<EdgePlace>>& opposite, const Box& box);

/// A spacing in the wrong unit would ask for more mass points than indices or memory can hold.
void refuse_too_many(const Sides& sides, double spacing);

}  // namespace lamella
