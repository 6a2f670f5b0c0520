// A mosaic as text that other programs read: Neper's .tess, .off, and the polygons that kind = "polygons" reads. Numbers
// have as many digits as it takes to read the same bits back.
#pragma once
#include <string>
#include <vector>

#include "generator/packing/packing.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// Cells in one piece each, as polygons over numbered corners. Of a periodic mosaic a cell that reaches across a side has
/// corners of its own there, which no other cell shares; unused vertices are left out. Otherwise vertices keep their order.
struct PlainMosaic {
  std::vector<Vec2> vertices;             // [m]
  std::vector<std::vector<Index>> cells;  // counter-clockwise, into vertices
};
PlainMosaic in_one_piece(const Mosaic& mosaic);

/// Neper's tessellation file, version 3.4, of dimension 2; the domain is written where the cells fill their box. `seeds`:
/// of every cell, in the mosaic's order, their radii being the weights; empty: none.
std::string tess_text(const Mosaic& mosaic, const std::vector<Disk>& seeds = {});
/// Polygons in the plane z = 0.
std::string off_text(const Mosaic& mosaic);
/// `x y cell` a line, cells numbered from 0.
std::string polygons_text(const Mosaic& mosaic);

}  // namespace lamella
