// Mosaics that need no packing: the Laguerre tessellation's tiles, and regular hexagons.
#pragma once
#include "generator/packing/laguerre.h"
#include "generator/sample/scene.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// In which directions the scene's sample repeats.
Periodic periodic_of(const SampleScene& sample);

/// Tiles as cells; edges on a side of the box carry its bit. Periodic if the tessellation is.
Mosaic mosaic_of(const Tessellation& tessellation);

/// columns x rows regular hexagons of side `side`; every second row (pointy) or column (flat) is shifted by half a
/// cell. The box encloses them, and its rough sides carry Side bits; along a periodic direction it is one period, and cells lie in it but
/// for halves that reach beyond its upper sides. Throws SceneError where the rows (pointy, along y) or columns (flat, along x) that
/// repeat are odd in number.
Mosaic make_honeycomb(const SampleScene& sample);

}  // namespace lamella
