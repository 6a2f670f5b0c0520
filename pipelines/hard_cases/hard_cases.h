// The hard cases of explicit soft-particle dynamics, a function each: what is expected stands with the numbers in the report.
#pragma once
#include "pipelines/studies/study.h"

namespace lamella::hard_cases {

// geometry_cases.cpp: what the generator makes of awkward input, and what the search and the time step make of that
void tiny_edges(StudyBench& bench);
void four_valent_junctions(StudyBench& bench);
void high_polydispersity(StudyBench& bench);

// invariant_cases.cpp: what must hold in any configuration
void internal_forces(StudyBench& bench);
void rigid_motion(StudyBench& bench);
void fold_over(StudyBench& bench);

// rupture_cases.cpp: links break
void snap_back(StudyBench& bench);
void contact_after_rupture(StudyBench& bench);
void rupture_under_compression(StudyBench& bench);
void many_breaks_in_one_step(StudyBench& bench);
void missing_links(StudyBench& bench);

// contact_cases.cpp: cells meet
void fast_impact(StudyBench& bench);
void self_contact_and_pass_through(StudyBench& bench);
void friction(StudyBench& bench);

// ring_cases.cpp: a ring between plates, to the end
void crushed_ring(StudyBench& bench);  // collapse of elements, inverted area, flat contact
void soft_wall(StudyBench& bench);
void stiff_core(StudyBench& bench);
void plastic_ring(StudyBench& bench);

}  // namespace lamella::hard_cases
