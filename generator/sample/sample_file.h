// The HDF5 format of a sample (docs/formats.md), versioned and validated on reading.
#pragma once
#include <filesystem>

#include "generator/sample/sample.h"

namespace lamella {
namespace h5 {
class Node;
}

/// Writes to a temporary name and renames, so that PATH is complete or as before. Throws DataError.
void write_sample(const std::filesystem::path& path, const Sample& sample);
/// Throws DataError with one sentence when the file is missing, truncated, of another version, or breaks an invariant that
/// the program relies on (index out of range, NaN, non-positive length).
Sample read_sample(const std::filesystem::path& path);

/// The same as a group of another file.
void write_sample(h5::Node& group, const Sample& sample);
Sample read_sample(const h5::Node& group);

}  // namespace lamella
