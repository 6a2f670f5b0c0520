// Neper's tessellation files (.tess), those of two dimensions: seeds, vertices and faces as they stand there.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "generator/packing/packing.h"
#include "generator/sample/sample.h"
#include "generator/sample/vec.h"

namespace lamella {

struct TessSeed {
  Vec2 at = Vec2::Zero();
  double weight = 0;  // a radius: Neper measures powers |p - x|^2 - weight^2
  int line = 0;
};

/// A face is a cell in two dimensions.
struct TessFace {
  std::vector<Index> vertex;  // into TessFile::vertices, in the file's order
  int line = 0;
};

struct TessFile {
  std::vector<int> id;          // of the cells, by which the file knows them
  std::vector<TessSeed> seeds;  // one per cell, or none
  std::vector<Vec2> vertices;   // numbered from 1 in the file, from 0 here
  std::vector<int> vertex_line;
  std::vector<TessFace> faces;  // one per cell
  bool periodic = false;
};

/// Sections that say nothing about geometry (orientations, scales) are passed over. Throws SceneError `file:line: ...` at
/// the first fault: no .tess, of another dimension, counts that the file does not hold, numbers that are not finite, ids
/// that are missing, repeated or out of range, a face whose edges are not those between its vertices. DataError when the
/// file cannot be read.
TessFile read_tess(const std::filesystem::path& path);

/// The seeds as disks. Weights are radii; where some are 0 the same is added to the square of all, which leaves the
/// tessellation as it is. `box`: where the centres must lie; null: what the file's vertices span, which is the domain
/// of a tessellation that fills a rectangle. Throws as read_tess does, and for a file without seeds.
Packing read_tess_seeds(const std::filesystem::path& path, const Box* box = nullptr);

}  // namespace lamella
