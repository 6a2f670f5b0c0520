// What ParaView shows of a frame: which geometry, and which arrays on it. docs/outputs.md lists them with their units.
#pragma once
#include "postproc/quantities/crack_path.h"
#include "postproc/vtk_writer.h"

namespace lamella {

/// Polygons of the centre lines of closed cells; open chains are in walls_mesh only.
Mesh cells_mesh(const FrameView& view, double depth);
/// Segments of all shells.
Mesh walls_mesh(const FrameView& view);
/// From node to node; only with links.
Mesh links_mesh(const FrameView& view);
/// Contacts, as lines from the node through the contact point; only with contact.
Mesh contacts_mesh(const FrameView& view);
/// One polyline per line of each crack.
Mesh cracks_mesh(const FrameView& view, const std::vector<Crack>& cracks);

}  // namespace lamella
