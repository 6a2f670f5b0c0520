// Radii of the disks: drawn from a distribution, or read from a file.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "generator/sample/scene.h"

namespace lamella {

struct Sizes {
  std::vector<double> radius;      // of each disk [m]
  std::vector<std::string> group;  // of each disk's cell, from a mixture; empty: "cells"
  std::vector<int> part;           // of each disk, of a mixture by area; else empty
  std::vector<double> area_share;  // of each such part
};

/// `count` radii in random order. They are stratified: one draw from each of `count` equally probable classes (of a mixture:
/// of each part's), so that mean and coefficient of variation are those asked for to about 1 / count, not to
/// 1 / sqrt(count). Parts of a mixture have their share of the disks to one disk; by area, that number of disks whose
/// expected area is the share. Same seed, same radii, on every machine. `for_paths` resolves sizes.file. Throws SceneError
/// for what the distribution cannot give.
Sizes draw_sizes(const SizesScene& sizes, int count, std::uint64_t seed, const Scene& for_paths);
/// The radii alone.
std::vector<double> draw_radii(const SizesScene& sizes, int count, std::uint64_t seed, const Scene& for_paths);

/// Radii of a file, one a line, `#` starts a comment. Throws SceneError with all faults, DataError if it cannot be read.
std::vector<double> read_radii(const std::filesystem::path& path);

}  // namespace lamella
