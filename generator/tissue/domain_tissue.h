// The Laguerre tissue of a domain: tiles clipped by its boundary, as cells that share walls. Tiles that the boundary cuts
// into several pieces keep the largest; every other piece goes to a neighbour, so that areas sum to that of the domain.
#pragma once
#include <string>
#include <vector>

#include "generator/packing/laguerre.h"
#include "generator/tissue/mosaic.h"
#include "generator/tissue/overlay.h"

namespace lamella {

/// A mosaic and where it meets the boundary of its domain.
struct DomainTissue {
  Mosaic mosaic;
  std::vector<std::vector<Index>>
      boundary;                // per cell and edge: edge of the domain, counted through all loops; -1: a wall
  std::vector<Index> site;     // per cell
  std::vector<Index> lies_on;  // per vertex: edge of the domain; -1 inside, -2 a corner of it, which stays where it is
  Index outer_edges = 0;       // the edges of the domain below this are those of its outer loop
};

/// A box around the domain and the centres of the disks, wide enough that no side of it lies on the boundary.
Box box_around(const Loops& loops, const std::vector<Disk>& disks);

/// Clips the tiles, which cover the domain. The box of the mosaic encloses the outer loop, loops[0]. Pieces of at most
/// 1e-7 mean cell areas are no cells. Throws SceneError: a site whose tile has no part in the domain, a hole that lies
/// within one tile, by its name in `keys`. Notes say which pieces went where, and whether coincidences had to be decided.
DomainTissue clip_tiles(const Tessellation& tessellation, const Loops& loops, const LaguerreOptions& options,
                        std::vector<std::string>& notes, const std::vector<std::string>& keys = {});

/// Collapses edges not longer than `threshold` [m], shortest first, to one vertex that all their cells share; corners of the domain
/// stay, vertices on its boundary stay on it, and areas still sum to the domain's. What cannot be welded under these
/// conditions is left and noted. Returns the number welded.
int weld_short_edges(DomainTissue& tissue, double threshold, std::vector<std::string>& notes);

/// Mean length of the walls between two cells [m]; 0 when there are none.
double mean_wall_length(const DomainTissue& tissue);

/// Side bits of the edges on the outer loop that look at a side of the mosaic's box: see mark_rough_sides.
void mark_outer_sides(DomainTissue& tissue);

/// Every violated invariant in words (empty: all hold): areas sum to `area`, every edge is a wall with two sides or lies on
/// the boundary, cells are counter-clockwise and do not touch themselves, V - E + F = 1 - holes, boundary edges lie on their edge of `loops`.
std::vector<std::string> check_domain_tissue(const DomainTissue& tissue, const Loops& loops);

}  // namespace lamella
