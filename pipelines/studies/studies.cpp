#include "pipelines/studies/study.h"

namespace lamella {

void study_beams(StudyBench& bench);
void study_ring_between_plates(StudyBench& bench);
void study_ring_core(StudyBench& bench);
void study_ring_plastic(StudyBench& bench);
void study_inflation(StudyBench& bench);
void study_compaction(StudyBench& bench);
void study_links(StudyBench& bench);
void study_double_cantilever(StudyBench& bench);
void study_cohesive_zone(StudyBench& bench);
void study_honeycomb(StudyBench& bench);
void study_quasi_static(StudyBench& bench);
void study_friction(StudyBench& bench);
void study_breakable_walls(StudyBench& bench);
void study_free_vibration(StudyBench& bench);
void study_hard_cases(StudyBench& bench);
void study_poisson_voronoi(StudyBench& bench);

const std::vector<Study>& studies() {
  static const std::vector<Study> all{
      {"beams", "Do chains of hinges bend as beams do, small and large, and how fast does the error fall?",
       study_beams},
      {"ring_between_plates", "Does a ring between rigid plates deform as the elastica does, there and back?",
       study_ring_between_plates},
      {"ring_core", "What does a core of any stiffness do to a ring between plates?", study_ring_core},
      {"ring_plastic", "How does a plastic ring collapse between plates, with and without a core, and what stays?",
       study_ring_plastic},
      {"inflation", "How stiff is a polygon against pressure, drained and undrained, and when do its bars yield?",
       study_inflation},
      {"compaction", "How do soft rings fill space when a lid compacts them, by their core and by yield?",
       study_compaction},
      {"links", "When does a link break under opening, shear and pressure, and what do several hold together?",
       study_links},
      {"double_cantilever",
       "At which load and opening does a glued double cantilever tear, and how tough does that make it?",
       study_double_cantilever},
      {"cohesive_zone",
       "What does a link that softens take, how tough does it make a crack, and does the spacing still matter?",
       study_cohesive_zone},
      {"honeycomb", "How stiff is a honeycomb of linked cells, and under which stress does its first link break?",
       study_honeycomb},
      {"quasi_static",
       "Does the stepper at rest meet the oracles, follow snap-back, settle under refinement, and give up in good "
       "order?",
       study_quasi_static},
      {"friction", "Does friction stick, slide, stop and keep angular momentum as Coulomb's law says?", study_friction},
      {"breakable_walls",
       "When do walls break, where does the energy go, and do cracks run through cells or between them?",
       study_breakable_walls},
      {"free_vibration", "Do free rings swing, spin and buckle as they should, and does motion keep what it must keep?",
       study_free_vibration},
      {"hard_cases", "Does each of the cases in which such codes fail come out right, or stop and say why?",
       study_hard_cases},
      {"poisson_voronoi", "Do the tiles of a million random points have the moments that are known of such tilings?",
       study_poisson_voronoi},
  };
  return all;
}

}  // namespace lamella
