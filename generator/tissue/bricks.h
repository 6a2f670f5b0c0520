// Walls of bricks: rows of rectangles, every second one shifted.
#pragma once
#include "generator/sample/scene.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// `rows` rows of `columns` bricks, rows 1, 3, ... shifted by shift * width to the right, in a box that ends, or repeats, as sample.periodic
/// says. Where it repeats along x all bricks are whole; where it ends, shifted rows begin and end with parts of a brick. Where bricks meet the side of
/// another, three walls meet in one vertex. Edges on sides that do not repeat carry their bits. Throws SceneError where the
/// numbers make no wall, or an odd number of shifted rows is to repeat along y.
Mosaic make_bricks(const SampleScene& sample);

}  // namespace lamella
