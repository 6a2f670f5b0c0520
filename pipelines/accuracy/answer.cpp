#include "pipelines/accuracy/answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

/// Index of a column, or -1.
int column(const Response& response, const std::string& name) {
  const auto at = std::find(response.columns.begin(), response.columns.end(), name);
  return at == response.columns.end() ? -1 : static_cast<int>(at - response.columns.begin());
}

std::vector<double> values_of(const Response& response, int k) {
  std::vector<double> values;
  for (const auto& row : response.rows) values.push_back(row[static_cast<std::size_t>(k)]);
  return values;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (double v : values) most = std::max(most, std::abs(v));
  return most;
}

/// The [[loads]] that push most; -1 without.
int strongest_load(const Response& response) {
  int best = -1;
  double most = 0;
  for (std::size_t k = 0; k < response.columns.size(); ++k) {
    const std::string& name = response.columns[k];
    if (!name.starts_with("force_x_") && !name.starts_with("force_y_")) continue;
    const double size = largest(values_of(response, static_cast<int>(k)));
    if (size > most) most = size, best = static_cast<int>(k);
  }
  return best;
}

}  // namespace

std::size_t Answer::peak() const {
  return static_cast<std::size_t>(std::max_element(load.begin(), load.end()) - load.begin());
}

double Answer::at(double place) const {
  const auto above = std::lower_bound(progress.begin(), progress.end(), place);
  if (above == progress.begin()) return load.front();
  if (above == progress.end()) return load.back();
  const auto k = static_cast<std::size_t>(above - progress.begin());
  const double u = (place - progress[k - 1]) / (progress[k] - progress[k - 1]);
  return (1 - u) * load[k - 1] + u * load[k];
}

Answer answer_of(const TrajectoryReader& run, double slowdown, const Answer* like) {
  const Response& response = run.response();
  if (response.rows.size() < 2) throw DataError("accuracy: the run has no response curve; give output.response");
  Answer answer;
  const std::vector<double> time = values_of(response, column(response, "time"));
  std::vector<double> progress;
  int load = like ? column(response, like->name == "nominal stress" ? "stress" : like->name) : -1;
  if (!like) load = column(response, "stress") >= 0 ? column(response, "stress") : strongest_load(response);
  if (load >= 0) {
    answer.name = response.columns[static_cast<std::size_t>(load)];
    answer.unit = response.units[static_cast<std::size_t>(load)];
    answer.load = values_of(response, load);
  } else {
    answer.name = "elastic energy", answer.unit = "J";
    answer.load.assign(time.size(), 0.0);
    for (std::size_t k = 0; k < response.columns.size(); ++k)
      if (response.columns[k].starts_with("energy_"))
        for (std::size_t row = 0; row < time.size(); ++row) answer.load[row] += response.rows[row][k];
  }
  for (double& value : answer.load) value = std::abs(value);
  if (largest(answer.load) == 0)
    throw DataError("accuracy: nothing loads the sample, so there is no largest load; give [loading] or [[loads]]");
  if (answer.name == "stress") {
    answer.name = "nominal stress";
    for (double strain : values_of(response, column(response, "strain"))) progress.push_back(std::abs(strain));
  } else {
    for (double t : time) progress.push_back(t / slowdown);
  }
  // Up to the largest load, and only where progress grows: a hold adds rows at one strain.
  std::vector<double> load_on_the_way;
  const std::size_t peak = answer.peak();
  for (std::size_t k = 0; k <= peak; ++k) {
    if (!answer.progress.empty() && progress[k] <= answer.progress.back()) {
      load_on_the_way.back() = answer.load[k];
      continue;
    }
    answer.progress.push_back(progress[k]), load_on_the_way.push_back(answer.load[k]);
  }
  answer.load = std::move(load_on_the_way);
  return answer;
}

std::vector<double> compared_places(const Answer& a, const Answer& b, int count) {
  const double end = std::min(a.progress.back(), b.progress.back());
  std::vector<double> places;
  for (int k = 1; k <= count; ++k) places.push_back(end * k / count);
  return places;
}

ErrorEstimate distance(const Answer& found, const Answer& exact, const std::vector<double>& places) {
  ErrorEstimate error;
  const double peak = *std::max_element(exact.load.begin(), exact.load.end());
  error.peak = std::abs(*std::max_element(found.load.begin(), found.load.end()) / peak - 1);
  double off = 0, size = 0;
  for (double place : places) {
    const double e = exact.at(place), d = found.at(place) - e;
    off += d * d, size += e * e;
  }
  error.curve = size > 0 ? std::sqrt(off / size) : 0;
  return error;
}

ErrorEstimate error_of_slower(const Answer& slow, const Answer& fast, double ratio) {
  ErrorEstimate error = distance(fast, slow, compared_places(slow, fast));
  error.peak /= ratio - 1, error.curve /= ratio - 1;
  return error;
}

}  // namespace lamella
