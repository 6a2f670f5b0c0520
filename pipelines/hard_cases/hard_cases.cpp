// Cases in which codes of this kind fail: bad geometry, events, large deformation, wrong parameters. Each with what must hold, measured.
#include "pipelines/hard_cases/hard_cases.h"

namespace lamella {

void study_hard_cases(StudyBench& bench) {
  using namespace hard_cases;
  tiny_edges(bench);
  four_valent_junctions(bench);
  high_polydispersity(bench);
  internal_forces(bench);
  rigid_motion(bench);
  fold_over(bench);
  snap_back(bench);
  contact_after_rupture(bench);
  rupture_under_compression(bench);
  many_breaks_in_one_step(bench);
  missing_links(bench);
  fast_impact(bench);
  self_contact_and_pass_through(bench);
  friction(bench);
  crushed_ring(bench);
  soft_wall(bench);
  stiff_core(bench);
  plastic_ring(bench);
}

}  // namespace lamella
