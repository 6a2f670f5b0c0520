// Mean Cauchy stress of each cell (Love and Weber): the forces that act on it from outside, times where they act.
#pragma once
#include <vector>

#include "postproc/frame_view.h"
#include "postproc/quantities/cell_shape.h"

namespace lamella {

/// Symmetric, tension positive [Pa].
struct Stress {
  double xx = 0, yy = 0, xy = 0;
};

/// sigma = 1 / (A s) sum F (x) X over the forces F on the cell: its links (at their middles, so that the two cells' shares
/// of a link cancel in the mean over the tissue), its contacts, and what loads and grips exert on its nodes. A is
/// the current tile area, s the depth [m]. Exact at rest; in motion, inertia is missing. Open chains have none.
std::vector<Stress> cell_stress(const FrameView& view, const std::vector<CellShape>& shapes, double depth);

/// Mean over cells, weighted by their tiles' areas.
Stress mean_stress(const Sample& sample, const std::vector<CellShape>& shapes, const std::vector<Stress>& stresses);

}  // namespace lamella
