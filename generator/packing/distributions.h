// Distributions of radii, as quantile functions: a radius for each probability in (0, 1).
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "generator/sample/vec.h"

namespace lamella {

using Quantile = std::function<double(double probability)>;

/// uniform, normal (cut off at 0, with mean and cv after that), lognormal, gamma or weibull; of this mean and coefficient of
/// variation, at most largest_cv.
Quantile quantile_of(const std::string& distribution, double mean, double cv);

/// Up to which coefficient of variation a distribution is offered.
double largest_cv(const std::string& distribution);

/// Of a density that is linear between the points (radius, density): rising radii, no density negative, some positive.
Quantile quantile_of_table(const std::vector<Vec2>& table);

}  // namespace lamella
