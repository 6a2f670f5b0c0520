// The order in which points are best inserted into a triangulation.
#pragma once
#include <vector>

#include "generator/packing/power_diagram.h"

namespace lamella {

/// Biased randomised insertion order (Amenta, Choi and Rote 2003): rounds of which each is four times as large as the one
/// before, points drawn into them by a hash of their index, in each along a Hilbert curve.
std::vector<Index> insertion_order(const std::vector<PowerSite>& sites);

}  // namespace lamella
