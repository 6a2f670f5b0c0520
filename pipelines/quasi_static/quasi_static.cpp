// Runs at rest: the scenes of other studies again, by equilibrium instead of slow motion; tearing; the cases in which such solvers fail.
#include "pipelines/quasi_static/at_rest.h"

namespace lamella {

void study_quasi_static(StudyBench& bench) {
  using namespace at_rest;
  rings(bench);
  cores(bench);
  lap_joints_and_blocks(bench);
  beams(bench);
  honeycombs(bench);
  snap_back(bench);
  softening(bench);
  spacing(bench);
  hard_cases(bench);
}

}  // namespace lamella
