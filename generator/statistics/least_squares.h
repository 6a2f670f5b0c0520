// Moments of numbers, and a line through points by least squares.
#pragma once
#include <vector>

namespace lamella {

struct Moments {
  long count = 0;
  double mean = 0, variance = 0, skew = 0;  // variance over count, skew = third central moment / variance^(3/2)
  double least = 0, largest = 0;
  double cv() const;          // standard deviation over mean
  double mean_error() const;  // standard error of the mean
};

/// All zero without values.
Moments moments(const std::vector<double>& values);

/// y = intercept + slope x. Errors are standard errors from the residuals; 0 with fewer than three points.
struct Line {
  double slope = 0, intercept = 0, slope_error = 0, intercept_error = 0;
  double correlation = 0, correlation_error = 0;  // Pearson's r and (1 - r^2) / sqrt(count - 2)
  long count = 0;
};

/// Slope 0 where all x are equal.
Line fit_line(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace lamella
