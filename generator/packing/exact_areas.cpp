#include "generator/packing/exact_areas.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// In extended precision: a hundred thousand equal areas would otherwise all round the same way, and sum to 1 - 2e-12.
double sum(const std::vector<double>& values) {
  return static_cast<double>(std::accumulate(values.begin(), values.end(), 0.0L));
}

/// What each cell shall have of the areas there are. The sum is constant for whole tiles, and varies for what is left of them.
std::vector<double> targets_of(const std::vector<double>& shares, const std::vector<double>& areas) {
  const double scale = sum(areas) / sum(shares);
  std::vector<double> targets(shares);
  for (double& target : targets) target *= scale;
  return targets;
}

Vector residual(const std::vector<double>& targets, const std::vector<double>& areas) {
  return Vector::Map(targets.data(), static_cast<Index>(targets.size())) -
         Vector::Map(areas.data(), static_cast<Index>(areas.size()));
}

void refuse_bad_problem(const AreaProblem& problem) {
  assert(problem.centres.size() == problem.shares.size());
  std::vector<std::string> faults;
  const auto count = static_cast<Index>(problem.centres.size());
  if (count == 0) faults.push_back("sample.areas: there are no sites; at least one is needed");
  std::vector<Index> order(problem.centres.size());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](Index i) { return std::array{problem.centres[i].x(), problem.centres[i].y()}; };
  for (Index i = 0; i < count; ++i) {
    if (!(problem.shares[i] > 0) || !std::isfinite(problem.shares[i]))
      faults.push_back(fmt::format("sample.areas: site {} shall have the area {}; areas must be positive and finite", i,
                                   problem.shares[i]));
    if (!problem.centres[i].allFinite())
      faults.push_back(fmt::format("sample.areas: site {} lies at ({}, {}); coordinates must be finite", i,
                                   problem.centres[i].x(), problem.centres[i].y()));
  }
  if (faults.empty()) {
    std::sort(order.begin(), order.end(),
              [&](Index i, Index j) { return place(i) != place(j) ? place(i) < place(j) : i < j; });
    for (Index k = 1; k < count; ++k)
      if (place(order[k - 1]) == place(order[k]))
        faults.push_back(fmt::format(
            "sample.areas: sites {} and {} lie at one place, ({:.9g}, {:.9g}): no weights can share an area between "
            "them; move or remove one",
            order[k - 1], order[k], place(order[k])[0], place(order[k])[1]));
  }
  constexpr std::size_t kShown = 20;
  if (faults.size() > kShown) {
    const std::size_t more = faults.size() - kShown;
    faults.resize(kShown);
    faults.push_back(fmt::format("sample.areas: and {} more of this kind", more));
  }
  if (!faults.empty()) throw SceneError(faults);
}

/// Newton's step: H step = residual with H = dA/dw, the Laplacian of the graph of neighbours with conductances length / (2 distance).
/// Its kernel is the common shift, so the first weight stays.
Vector newton_step(const AreaProblem& problem, const TileMeasures& cells, const Vector& residual) {
  const Index count = static_cast<Index>(problem.centres.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(cells.walls.size() + problem.centres.size());
  std::vector<double> diagonal(problem.centres.size(), 0);
  for (const TileWall& wall : cells.walls) {
    if (wall.a == wall.b) continue;  // with an image of its own: moves with it
    const Vec2 away = problem.centres[wall.b] + displacement(wall.image, problem.box) - problem.centres[wall.a];
    const double conductance = wall.length / (2 * away.norm());
    diagonal[wall.a] += conductance;
    diagonal[wall.b] += conductance;
    const auto [low, high] = std::minmax(wall.a, wall.b);
    if (low > 0) entries.emplace_back(high - 1, low - 1, -conductance);
  }
  for (Index i = 1; i < count; ++i) entries.emplace_back(i - 1, i - 1, diagonal[i]);
  Matrix hessian(count - 1, count - 1);
  hessian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Matrix> factor(hessian);
  Vector step = Vector::Zero(count);
  if (factor.info() == Eigen::Success) step.tail(count - 1) = factor.solve(residual.tail(count - 1));
  return step;
}

/// The image of p inside the box.
Vec2 wrapped(Vec2 p, const Box& box, const Periodic& periodic) {
  for (const int axis : {0, 1}) {
    if (!periodic[axis]) continue;
    const double length = box.size()[axis];
    p[axis] -= length * std::floor((p[axis] - box.lo[axis]) / length);
    p[axis] = std::clamp(p[axis], box.lo[axis], box.hi[axis]);  // rounding
  }
  return p;
}

class WeightSearch {
 public:
  WeightSearch(const AreaProblem& problem, const WeightOptions& options, std::vector<double> start)
      : problem_(problem), measure_(problem.measure), options_(options) {
    found_.weight = std::move(start);
    for (int trial = 0;; ++trial) {
      found_.cells = measure(found_.weight);
      const auto empty =
          std::find_if(found_.cells.area.begin(), found_.cells.area.end(), [](double area) { return !(area > 0); });
      if (empty == found_.cells.area.end()) break;
      if (trial == kTrials)
        throw SceneError(fmt::format(
            "sample.areas: site {} has no cell even where all weights are equal; its centre must lie in the domain",
            empty - found_.cells.area.begin()));
      // Without weights every site lies in its own tile.
      for (double& weight : found_.weight) weight *= trial + 1 == kTrials ? 0 : 0.5;
    }
    const auto targets = targets_of(problem.shares, found_.cells.area);
    least_ = std::min(*std::min_element(targets.begin(), targets.end()),
                      *std::min_element(found_.cells.area.begin(), found_.cells.area.end())) /
             2;
  }

  Weights run() {
    best_ = found_.error = largest_error(found_.cells.area, problem_.shares);
    while (found_.error > options_.tolerance) {
      if (found_.iterations == options_.iterations || !improve()) give_up();
      ++found_.iterations;
      best_ = std::min(best_, found_.error);
      if (options_.progress) options_.progress(found_.error);
    }
    return std::move(found_);
  }

 private:
  static constexpr int kTrials = 4;  // the start, its half, its quarter, nothing

  TileMeasures measure(const std::vector<double>& weights) {
    ++found_.diagrams;
    return measure_(problem_.centres, weights);
  }

  /// One damped step: as long as no cell falls below half the least area, given or asked for, and the residual falls by half of what
  /// the linear model promises. From there on convergence is linear at worst, and quadratic in the end.
  bool improve() {
    const Vector missing = residual(targets_of(problem_.shares, found_.cells.area), found_.cells.area);
    const Vector step = newton_step(problem_, found_.cells, missing);
    // The step before says how far this one will come: a diagram costs more than a second, longer step.
    for (damping_ = std::min(1.0, 2 * damping_); damping_ > kLeastDamping; damping_ /= 2) {
      std::vector<double> weights = found_.weight;
      for (std::size_t i = 0; i < weights.size(); ++i) weights[i] += damping_ * step[static_cast<Index>(i)];
      TileMeasures cells = measure(weights);
      if (*std::min_element(cells.area.begin(), cells.area.end()) < least_) continue;
      const double error = largest_error(cells.area, problem_.shares);
      const double norm = residual(targets_of(problem_.shares, cells.area), cells.area).norm();
      // In the end the norm is that of the rounding of large areas, while small ones still improve.
      if (!(norm <= (1 - damping_ / 2) * missing.norm()) && error > options_.tolerance) continue;
      found_.weight = std::move(weights);
      found_.cells = std::move(cells);
      found_.error = error;
      return true;
    }
    return false;
  }

  [[noreturn]] void give_up() const {
    const auto targets = targets_of(problem_.shares, found_.cells.area);
    std::size_t worst = 0;
    for (std::size_t i = 1; i < targets.size(); ++i)
      if (std::abs(found_.cells.area[i] / targets[i] - 1) > std::abs(found_.cells.area[worst] / targets[worst] - 1))
        worst = i;
    throw SceneError(fmt::format(
        "sample.areas: the areas come to within {:.3g} of those asked for, not to within the tolerance {:.3g}, in {} "
        "iterations; the worst is site {} with {:.6g} instead of {:.6g} m2. Ask for a larger tolerance or for sizes "
        "that differ less",
        best_, options_.tolerance, found_.iterations, worst, found_.cells.area[worst], targets[worst]));
  }

  static constexpr double kLeastDamping = 1e-9;

  const AreaProblem& problem_;
  MeasureCells measure_;  // a copy: what it learns in one search must not change the last bits of another
  const WeightOptions& options_;
  Weights found_;
  double least_ = 0;    // area that every cell keeps [m2]
  double damping_ = 1;  // of the last step [1]
  double best_ = 0;     // error reached so far [1]
};

}  // namespace

AreaProblem tile_problem(const Box& box, const Periodic& periodic, std::vector<Vec2> centres,
                         std::vector<double> shares) {
  return {box, periodic,
          [box, periodic, reach = 0.0](const std::vector<Vec2>& x, const std::vector<double>& weights) mutable {
            return measure_tiles(x, weights, box, periodic, &reach);
          },
          std::move(centres), std::move(shares)};
}

double largest_error(const std::vector<double>& areas, const std::vector<double>& shares) {
  const std::vector<double> targets = targets_of(shares, areas);
  double largest = 0;
  for (std::size_t i = 0; i < areas.size(); ++i) largest = std::max(largest, std::abs(areas[i] / targets[i] - 1));
  return largest;
}

Weights solve_weights(const AreaProblem& problem, std::vector<double> start, const WeightOptions& options) {
  refuse_bad_problem(problem);
  return WeightSearch(problem, options, std::move(start)).run();
}

Weights lloyd_sweeps(AreaProblem& problem, std::vector<double> start, int sweeps, const WeightOptions& options) {
  WeightOptions loose = options;
  loose.tolerance = std::max(0.01, options.tolerance);
  int iterations = 0, diagrams = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const Weights found = solve_weights(problem, std::move(start), loose);
    iterations += found.iterations;
    diagrams += found.diagrams;
    start = found.weight;
    for (std::size_t i = 0; i < start.size(); ++i) {
      const Vec2 to = found.cells.centroid[i];
      // The power of the centroid stays, and with it, to first order, the cell.
      start[i] -= (to - problem.centres[i]).squaredNorm();
      problem.centres[i] = wrapped(to, problem.box, problem.periodic);
    }
  }
  Weights found = solve_weights(problem, std::move(start), options);
  found.iterations += iterations;
  found.diagrams += diagrams;
  return found;
}

}  // namespace lamella
