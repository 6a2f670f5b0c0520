// The slowest way in which a sample swings: what "slow" and "damped" mean for a test of it.
#pragma once
#include <optional>
#include <vector>

#include "simulator/loads.h"
#include "simulator/model.h"

namespace lamella {

/// Lowest natural frequency [rad/s] of the model, linearised at x with what the loads hold held fast; motions without stiffness (of a
/// shell that is free) do not count. By subspace iteration on the assembled stiffness. Empty where nothing swings, or where so many
/// shells are free that the first vectors see nothing else.
std::optional<double> lowest_frequency(const Model& model, const std::vector<Load>& loads, const Field& x);

}  // namespace lamella
