// Cells of a picture as tiles of the Laguerre tessellation closest to them.
#pragma once
#include "generator/generate.h"
#include "generator/image/labels.h"
#include "generator/packing/laguerre.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// Background is tessellated too, in pieces as large as cells, and left out afterwards. Short walls are welded (`weld`: of the
/// mean wall), and counted in origin.welded. Notes say how many pixels lie in the tile of their cell, and which cells have none.
Mosaic make_laguerre_mosaic(LabelImage labels, double pixel, double weld, Notes& notes, Origin& origin,
                            const std::function<void(double)>& progress = {});

/// Share of the pixels whose centre lies in the tile of their cell. The box is the picture in pixels, y upwards; sites from
/// `cells` on are background, whatever their labels.
double agreement(const Tessellation& tessellation, const LabelImage& labels, Index cells);

}  // namespace lamella
