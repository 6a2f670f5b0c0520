// Ranges of parameters that many rows share.
#pragma once
#include "generator/sample/scene_rows.h"

namespace lamella {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Range kPositive{0, kInfinity, true};
inline constexpr Range kNotNegative{0, kInfinity};
inline constexpr Range kFraction{0, 1};
inline constexpr Range kPositiveFraction{0, 1, true};
inline constexpr Range kInsideFraction{0, 1, true, true};

inline Range at_least(double low) { return {low, kInfinity}; }
inline Range between(double low, double high) { return {low, high}; }

}  // namespace lamella
