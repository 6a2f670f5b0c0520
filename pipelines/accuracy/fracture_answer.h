// What a run says about fracture, and how far two runs agree on it.
#pragma once
#include <set>

#include "pipelines/studies/study.h"

namespace lamella {

struct FractureAnswer {
  double peak_stress = 0;         // [Pa]
  double strain_at_peak = 0;      // [1]
  double work = 0;                // of the grips, up to where the run ends [J]
  double first_break_strain = 0;  // [1]; NaN without breaks
  double first_break_stress = 0;  // of the last row before it [Pa]; NaN without breaks
  int first_link = -1;
  std::set<int> links;  // that broke
  std::set<int> walls;  // with at least one of these
};

/// Of a run with a [loading] and links. Throws DataError where its response lacks a column.
FractureAnswer fracture_answer_of(const StudyRun& run);

/// Jaccard's index: what both sets have over what either has; 1 where both are empty.
double overlap(const std::set<int>& a, const std::set<int>& b);

}  // namespace lamella
