// Cases in which codes of this kind fail: bad geometry, events, large deformation, wrong parameters. Each with what must hold, measured.
#include "pipelines/hard_cases/hard_cases.h"

namespace lamella {

void study_hard_cases(StudyBench& bench) {
  using namespace hard_cases;
  snap_back(bench);
  rupture_under_compression(bench);
  fast_impact(bench);
  self_contact_and_pass_through(bench);
  friction(bench);
}

}  // namespace lamella
