// Flaws of a tissue: links that are absent from the start.
#pragma once
#include <cstdint>

#include "generator/generate.h"
#include "generator/sample/sample.h"

namespace lamella {

/// Removes the share `missing` of all links, rounded to a whole number, each set of so many being as likely as any other. One seed
/// puts all links into one order, so that a larger share lacks what a smaller one lacks, and more. Walls stay. Throws SceneError where there is no link.
void drop_links(double missing, std::uint64_t seed, Sample& sample, Notes& notes);

}  // namespace lamella
