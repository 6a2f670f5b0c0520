#include "generator/statistics/least_squares.h"

#include <algorithm>
#include <cmath>

namespace lamella {

double Moments::cv() const { return mean != 0 ? std::sqrt(variance) / std::abs(mean) : 0; }

double Moments::mean_error() const { return count > 1 ? std::sqrt(variance / static_cast<double>(count - 1)) : 0; }

Moments moments(const std::vector<double>& values) {
  Moments m;
  if (values.empty()) return m;
  m.count = static_cast<long>(values.size());
  const auto count = static_cast<double>(values.size());
  for (const double v : values) m.mean += v;
  m.mean /= count;
  double third = 0;
  for (const double v : values) {
    const double d = v - m.mean;
    m.variance += d * d / count;
    third += d * d * d / count;
  }
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  m.least = *least, m.largest = *largest;
  // What rounding leaves of equal numbers has no shape.
  if (m.variance <= 1e-24 * m.mean * m.mean) m.variance = 0;
  m.skew = m.variance > 0 ? third / std::pow(m.variance, 1.5) : 0;
  return m;
}

Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  Line line;
  line.count = static_cast<long>(x.size());
  if (x.empty()) return line;
  const Moments mx = moments(x), my = moments(y);
  const auto count = static_cast<double>(x.size());
  double xy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) xy += (x[k] - mx.mean) * (y[k] - my.mean) / count;
  line.intercept = my.mean;
  if (mx.variance == 0) return line;
  line.slope = xy / mx.variance;
  line.intercept = my.mean - line.slope * mx.mean;
  if (my.variance > 0) line.correlation = std::clamp(xy / std::sqrt(mx.variance * my.variance), -1.0, 1.0);
  if (x.size() < 3) return line;
  const double left = std::max(0.0, my.variance - line.slope * xy) * count / (count - 2);
  line.slope_error = std::sqrt(left / (count * mx.variance));
  line.intercept_error = line.slope_error * std::sqrt(mx.variance + mx.mean * mx.mean);
  line.correlation_error = (1 - line.correlation * line.correlation) / std::sqrt(count - 2);
  return line;
}

}  // namespace lamella
