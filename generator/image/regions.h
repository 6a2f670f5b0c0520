// Connected regions of a picture.
#pragma once
#include <vector>

#include "generator/image/labels.h"
#include "generator/sample/union_find.h"

namespace lamella {

/// Pixels of one label that are connected through their sides, numbered in the order of their first pixel.
struct Regions {
  std::vector<Index> of;    // per pixel
  std::vector<Index> cell;  // per region: its label
  std::vector<Index> area;  // per region [pixels]
};

Regions regions_of(const LabelImage& labels);

}  // namespace lamella
