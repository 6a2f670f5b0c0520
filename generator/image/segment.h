// From a micrograph to labels: blur, threshold, and the watershed of the distance to the walls.
#pragma once
#include <optional>

#include "generator/image/labels.h"

namespace lamella {

struct Segmenting {
  bool dark_walls = true;
  std::optional<double> threshold = std::nullopt;  // 0 to 1; absent: Otsu's
  double smoothing = 1;                            // standard deviation of the blur [pixels]
  int least_area = 20;  // smaller specks, of walls in cells or the other way round, are none [pixels]
};

struct Segmentation {
  LabelImage labels;     // numbers from 1, in the order of their first pixels
  double threshold = 0;  // that was used [1]
  // Thickness of the walls between two cells, by the threshold, before the blur [pixels]: mean and standard deviation.
  int walls = 0;  // measured; 0: none
  double thickness = 0, deviation = 0;
};

/// Cells are what is brighter (or darker) than the threshold. Where a wall has a hole, the constriction still parts two
/// cells if it is narrower than three quarters of the narrower one. Walls go to the nearest cell; darker places wider than
/// three mean walls (and 4 pixels) are background.
Segmentation segment(const Picture& picture, const Segmenting& how);

/// Otsu's threshold of values between 0 and 1: it parts them into two classes of least variance within.
double otsu_threshold(const std::vector<float>& value);

}  // namespace lamella
