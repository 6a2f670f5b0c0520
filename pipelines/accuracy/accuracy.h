// `lamella accuracy`: error against cost of everything that a user can turn.
#pragma once
#include "pipelines/studies/study.h"

namespace lamella {

/// Runs all cases; the report holds tables, work-precision charts, recommended settings, and the estimate of `lamella run --accuracy` beside true
/// errors.
void study_accuracy(StudyBench& bench);

}  // namespace lamella
