// Whether something goes on round the box of a periodic sample: from a part of it to that part's own image.
#pragma once
#include <vector>

#include "generator/sample/sample.h"

namespace lamella {

/// Part b, displaced by the image, is joined to part a.
struct Joint {
  Index a = 0, b = 0;
  Image image{0, 0};
};

/// Whether parts [0, parts) and their joints make a way that ends at another image of where it began, along x (0) or y (1).
bool goes_round(Index parts, const std::vector<Joint>& joints, int axis);

}  // namespace lamella
