// Packings from elsewhere: text, `x,y,r` or `x,y,r,target_area` a line.
#pragma once
#include <filesystem>
#include <string>

#include "generator/packing/packing.h"

namespace lamella {

/// Reads `x,y,r` a line [m], or `x,y,r,target_area` on all of them [m, m2], separated by commas, semicolons, blanks or tabs; `#` starts a comment; the first line may be a
/// header. `box`: where all centres must lie; null: the box that encloses the disks. Two disks of one centre and radius are
/// a fault, or with duplicates "keep_first" the later ones are left out and noted.
/// A file *.tess gives its seeds instead: read_tess_seeds.
/// Throws SceneError with every fault as `file:line: ...`; DataError when the file cannot be read.
Packing read_packing(const std::filesystem::path& path, const Box* box = nullptr,
                     const std::string& duplicates = "error");

/// Of disks that lie at one place, on a torus up to its lengths, leaves the first, and a note. For a packing as read.
void keep_first_at_each_place(Packing& packing);

/// Writes a packing so that read_packing returns the same disks, bit for bit. Throws DataError.
void write_packing(const std::filesystem::path& path, const Packing& packing);

}  // namespace lamella
