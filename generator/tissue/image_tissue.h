// A tissue from a picture: cells as the picture shows them, or the Laguerre tessellation closest to them.
#pragma once
#include "generator/generate.h"
#include "generator/sample/scene.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

using ImageProgress = std::function<void(double done, const std::string& what)>;

/// The mosaic of sample.image. The box is the picture, from the origin, `pixel` metres for a pixel: column 0 is on the left
/// and row 0 at the top, so y = (height - row) pixel. Walls on the sides of the picture carry their bits; a side that no
/// cell touches goes to the free walls that look at it, as for any rough tissue. Short walls are welded as walls.weld says, and counted in
/// origin.welded. Throws DataError (the file) or SceneError (no cells, cells that are none).
Mosaic make_image_mosaic(const Scene& scene, Notes& notes, Origin& origin, const ImageProgress& progress = {});

/// Whether a cell is narrower somewhere than twice its wall's outline and half the gap, so that it has no inset.
bool has_narrow_cells(const Mosaic& mosaic, const Scene& scene);

/// What helps where cells of a picture are too narrow for their walls.
inline constexpr const char* kNarrowCellsOfPictures =
    "sample.image: cells of a picture may be narrow anywhere; a larger simplify makes them smoother, a larger "
    "least_area "
    "joins the smallest, cells = \"laguerre\" makes all of them convex";

}  // namespace lamella
