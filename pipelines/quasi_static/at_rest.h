// The parts of the study of runs at rest, in the order of its page.
#pragma once
#include "pipelines/studies/study.h"

namespace lamella::at_rest {

inline constexpr const char* kStepper = "run.stepper=\"quasi_static\"";

// oracles_at_rest.cpp: what is known exactly
void rings(StudyBench& bench);
void cores(StudyBench& bench);
void lap_joints_and_blocks(StudyBench& bench);
void beams(StudyBench& bench);
void honeycombs(StudyBench& bench);

// tearing_at_rest.cpp: what happens behind the first break
void snap_back(StudyBench& bench);
void softening(StudyBench& bench);

// spacing_at_rest.cpp
void spacing(StudyBench& bench);

// hard_cases_at_rest.cpp
void hard_cases(StudyBench& bench);

}  // namespace lamella::at_rest
