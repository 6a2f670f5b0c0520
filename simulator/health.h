// What a model cannot mean anything beyond.
#pragma once
#include "simulator/model.h"

namespace lamella {

/// Looks for positions that are no numbers, collapsed segments, cells about to turn inside out, links pressed past zero distance and
/// nodes inside other cells. Throws SolverError with time [s] and object.
void check_health(const Model& model, const Field& x, double time);

}  // namespace lamella
