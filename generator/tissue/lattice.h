// Mosaics that need no packing: the Laguerre tessellation's tiles, and regular hexagons.
#pragma once
#include "generator/packing/laguerre.h"
#include "generator/sample/scene.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// Tiles as cells; edges on a side of the box carry its bit.
Mosaic mosaic_of(const Tessellation& tessellation);

/// columns x rows regular hexagons of side `side`; every second row (pointy) or column (flat) is shifted by half a
/// cell. The box encloses them, and its rough sides carry Side bits.
Mosaic make_honeycomb(const SampleScene& sample);

}  // namespace lamella
