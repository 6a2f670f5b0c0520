// A tessellation and the boundary of a domain, laid over each other: the pieces of the tiles that lie inside. Where the
// boundary crosses walls, and in which order, is decided exactly, and everything else follows from that without looking
// at coordinates: a crossing is one point for both tiles, and a piece never overlaps its neighbours.
#pragma once
#include <vector>

#include "generator/packing/laguerre.h"

namespace lamella {

/// Closed polygons [m]: the domain lies to the left of their edges.
using Loops = std::vector<std::vector<Vec2>>;

/// An edge of a piece, which lies on its left.
struct OverlayEdge {
  Index from = 0;   // into Overlay::points
  Index next = -1;  // edge of the same piece, counter-clockwise
  Index twin = -1;  // the same edge seen from the other piece; -1 on the boundary of the domain
  Index piece = -1;
  Index boundary = -1;  // edge of the domain that it lies on, counted through all loops; -1: a wall
};

/// A part of a tile inside the domain. A loop that lies in one tile alone is a piece of its own, which for a hole has
/// negative area and runs clockwise: sums over the pieces of a tile are right.
struct Piece {
  Index tile = 0;        // into Tessellation::tiles
  Index first = -1;      // one of its edges
  Index lone_loop = -1;  // the loop that it is, if it is one
  double area = 0;       // [m2]
};

struct Overlay {
  std::vector<Vec2> points;    // [m]
  std::vector<Index> lies_on;  // per point: edge of the domain, counted through all loops; -1 inside, -2 a corner
  std::vector<OverlayEdge> edges;
  std::vector<Piece> pieces;
  bool moved = false;  // see `overlay`
};

/// The domain must lie inside the tessellation's box. Where its boundary passes through a vertex or along a wall, topology is that of a domain
/// whose corners lie elsewhere by 1e-9 mean cell sizes, always the same way; its points still lie on the boundary as
/// given. Throws SceneError when that does not help.
Overlay overlay(const Tessellation& tessellation, const Loops& loops);

/// Corners of a piece [m].
std::vector<Vec2> polygon_of(const Overlay& overlay, const Piece& piece);

}  // namespace lamella
