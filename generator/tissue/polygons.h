// Imported polygons as a tissue: with walls that coincide (inset like tiles), or as centre lines of their own.
#pragma once
#include <string>
#include <vector>

#include "generator/generate.h"
#include "generator/sample/sample.h"
#include "generator/sample/scene.h"
#include "generator/tissue/mosaic.h"
#include "generator/tissue/polygon_file.h"

namespace lamella {

/// Polygons whose walls coincide. Points nearer than 1e-4 mean cell sizes are one vertex, and a vertex that near to
/// another cell's edge divides it (T-junctions). The box encloses the cells, or has the scene's width and height
/// about their middle; its rough sides carry Side bits. Throws SceneError naming `file` and lines where cells overlap.
Mosaic share_walls(const std::vector<ImportedCell>& cells, const SampleScene& scene, const std::string& file);

/// Polygons that are centre lines: mass points are placed anew at the asked spacing, and where two outlines are each
/// other's nearest within facing_tolerance (0: 2.2 radius) they face each other in pairs, which are linked.
Sample make_separate_tissue(const std::vector<ImportedCell>& cells, const SampleScene& scene, const std::string& file,
                            double radius, const std::string& group, Notes& notes);

/// Box of imported cells: see share_walls. `margin` is added around them [m].
Box box_of(const std::vector<ImportedCell>& cells, const SampleScene& scene, double margin);

/// Throws SceneError naming file and lines of pairs of cells that overlap: sides that cross, or one cell inside
/// another. Points of one cell that lie within `tolerance` of another's outline do not count.
void refuse_overlaps(const std::vector<ImportedCell>& cells, const std::string& file, double tolerance);

}  // namespace lamella
