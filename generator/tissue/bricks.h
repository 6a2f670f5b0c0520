// A wall of bricks: rows of rectangles, every second one shifted.
#pragma once
#include "generator/sample/scene.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// `rows` rows of `columns` bricks. Rows 1, 3, ... are shifted by shift * width to the right, and begin and end with parts of a brick, so
/// that the box is filled. Where bricks meet the side of another, three walls meet in one vertex. Edges on the box's sides
/// carry their bits. Throws SceneError where the numbers make no wall.
Mosaic make_bricks(const SampleScene& sample);

}  // namespace lamella
