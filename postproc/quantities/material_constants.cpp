#include "postproc/quantities/material_constants.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "generator/sample/errors.h"
#include "postproc/quantities/cell_shape.h"
#include "postproc/quantities/energy_budget.h"

namespace lamella {
namespace {

constexpr double kElasticShare = 0.3;  // of the peak stress: the first part of the curve
constexpr double kFailureShare = 0.2;  // of the peak stress: failed

double number(const Provenance& provenance, const std::string& key) {
  const auto at = provenance.find(key);
  if (at == provenance.end()) throw DataError("trajectory: provenance key '" + key + "' is missing beside 'axis'");
  try {
    return std::stod(at->second);
  } catch (const std::exception&) {
    throw DataError("trajectory: provenance key '" + key + "' is '" + at->second + "', a number was expected");
  }
}

}  // namespace

std::optional<TestSetup> test_setup(const Provenance& provenance) {
  for (int stage = 0; stage < 1000; ++stage) {
    const std::string prefix = stage == 0 ? "" : "stage_" + std::to_string(stage) + "_";
    const auto axis = provenance.find(prefix + "axis");
    if (axis == provenance.end()) continue;
    TestSetup setup;
    setup.axis = axis->second == "x" ? 0 : 1;
    if (const auto kind = provenance.find(prefix + "kind"); kind != provenance.end()) setup.kind = kind->second;
    setup.gauge_length = number(provenance, prefix + "gauge_length");
    setup.width = number(provenance, prefix + "width");
    setup.depth = number(provenance, prefix + "depth");
    setup.stage = stage;
    return setup;
  }
  return std::nullopt;
}

LoadCurve load_curve(const Response& response, const TestSetup& setup) {
  const std::vector<double> time = response_column(response, "time"), stage = response_column(response, "stage"),
                            strain = response_column(response, "strain"), stress = response_column(response, "stress");
  LoadCurve curve;
  if (strain.empty() || stress.empty()) return curve;
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (!stage.empty() && static_cast<int>(stage[k]) != setup.stage) continue;
    curve.time.push_back(time[k]);
    curve.strain.push_back(setup.sign() * strain[k]);
    curve.stress.push_back(setup.sign() * stress[k]);
  }
  return curve;
}

LineFit fit_line(const std::vector<double>& x, const std::vector<double>& y, std::size_t begin, std::size_t end) {
  LineFit fit;
  fit.points = static_cast<int>(end - begin);
  if (fit.points < 2) return fit;
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t k = begin; k < end; ++k) mean_x += x[k] / fit.points, mean_y += y[k] / fit.points;
  for (std::size_t k = begin; k < end; ++k) {
    const double dx = x[k] - mean_x, dy = y[k] - mean_y;
    xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  if (!(xx > 0)) return fit;
  fit.slope = xy / xx;
  fit.intercept = mean_y - fit.slope * mean_x;
  fit.r_squared = yy > 0 ? xy * xy / (xx * yy) : 1;
  return fit;
}

MaterialConstants material_constants(const LoadCurve& curve, const TestSetup& setup, const std::vector<Event>& events,
                                     const std::vector<Vec2>& lateral) {
  MaterialConstants constants;
  const std::size_t rows = curve.strain.size();
  if (rows == 0) return constants;
  const auto peak =
      static_cast<std::size_t>(std::max_element(curve.stress.begin(), curve.stress.end()) - curve.stress.begin());
  constants.peak_stress = curve.stress[peak];
  constants.strain_at_peak = curve.strain[peak];
  constants.time_at_peak = curve.time[peak];

  double first_break = std::numeric_limits<double>::max();
  for (const Event& event : events)
    if (event.time >= curve.time.front()) first_break = std::min(first_break, event.time);
  std::size_t elastic = 0;
  while (elastic <= peak && curve.stress[elastic] <= kElasticShare * constants.peak_stress &&
         curve.time[elastic] < first_break)
    ++elastic;
  const LineFit fit = fit_line(curve.strain, curve.stress, 0, elastic);
  if (fit.points >= 3 && curve.strain[elastic - 1] > curve.strain[0]) {
    constants.modulus = fit.slope;
    constants.modulus_r_squared = fit.r_squared;
    constants.elastic_strain = curve.strain[elastic - 1];
  }

  // Poisson's ratio over the frames of the same part; where these are fewer than three, over those before the peak and
  // the first break.
  const auto frames_up_to = [&](double strain) {
    return static_cast<std::size_t>(
        std::count_if(lateral.begin(), lateral.end(), [&](const Vec2& p) { return p.x() <= strain * (1 + 1e-9); }));
  };
  if (setup.kind != "shear" && !lateral.empty()) {
    std::size_t frames = frames_up_to(constants.elastic_strain);
    if (frames < 3)
      frames = frames_up_to(std::min(constants.strain_at_peak, value_at(curve.time, curve.strain, first_break)));
    std::vector<double> along, across;
    for (const Vec2& p : lateral) along.push_back(p.x()), across.push_back(p.y());
    const LineFit slope = fit_line(along, across, 0, std::min(frames, lateral.size()));
    if (slope.points >= 2 && along[slope.points - 1] > along[0]) constants.poisson = -slope.slope;
  }

  std::size_t last = rows - 1;
  for (std::size_t k = peak; k < rows; ++k)
    if (constants.peak_stress > 0 && curve.stress[k] < kFailureShare * constants.peak_stress) {
      constants.strain_at_failure = curve.strain[k];
      constants.time_at_failure = curve.time[k];
      last = k;
      break;
    }
  for (std::size_t k = 0; k < last; ++k)
    constants.work_per_area += 0.5 * (curve.stress[k] + curve.stress[k + 1]) * (curve.strain[k + 1] - curve.strain[k]);
  constants.work_per_area *= setup.gauge_length;
  return constants;
}

void fail_at_separation(MaterialConstants& constants, const LoadCurve& curve) {
  if (constants.strain_at_failure || curve.strain.empty()) return;
  constants.strain_at_failure = curve.strain.back();
  constants.time_at_failure = curve.time.back();
}

double lateral_strain(const Sample& sample, const std::vector<Vec2>& x, int axis) {
  const int across = 1 - axis;
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const Vec2& p : sample.x) low = std::min(low, p[axis]), high = std::max(high, p[axis]);
  const double quarter = 0.25 * (high - low) * (1 + 1e-9);
  std::vector<double> middle_place, middle_move, all_place, all_move;
  for (Index c = 0; c < sample.cells(); ++c) {
    const Vec2 rest = cell_shape(sample, sample.x, c).centroid, now = cell_shape(sample, x, c).centroid;
    all_place.push_back(rest[across]), all_move.push_back(now[across] - rest[across]);
    if (std::abs(rest[axis] - 0.5 * (low + high)) > quarter) continue;
    middle_place.push_back(rest[across]), middle_move.push_back(now[across] - rest[across]);
  }
  const LineFit fit = fit_line(middle_place, middle_move, 0, middle_place.size());
  return fit.points >= 2 ? fit.slope : fit_line(all_place, all_move, 0, all_place.size()).slope;
}

double value_at(const std::vector<double>& times, const std::vector<double>& values, double time) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), time) - times.begin());
  if (at == 0) return values.front();
  if (at == times.size()) return values.back();
  const double share = times[at] > times[at - 1] ? (time - times[at - 1]) / (times[at] - times[at - 1]) : 1;
  return values[at - 1] + share * (values[at] - values[at - 1]);
}

double value_at_frame(const std::vector<double>& times, const std::vector<double>& values, double time) {
  const auto at = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  return at > 0 && times[at - 1] == time ? values[at - 1] : value_at(times, values, time);
}

}  // namespace lamella
