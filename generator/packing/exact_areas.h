// Cells of prescribed areas: the weights with which the Laguerre tiles of given sites have them. This is semi-discrete optimal
// transport, solved by the damped Newton iteration of Kitagawa, Merigot and Thibert (J. Eur. Math. Soc. 21, 2019, 2603).
// Knows a tessellation only by what a function measures of it: tiles in a box or on a torus, or what is left of them.
#pragma once
#include <functional>
#include <vector>

#include "generator/packing/laguerre.h"

namespace lamella {

/// Measures the cells of sites [m] with weights [m2]. A cell without area is absent. `length` of a wall makes the derivative right:
/// dA_a/dw_b = -length / (2 |x_b - x_a|), and rows sum to zero, as a common shift of all weights changes nothing.
using MeasureCells = std::function<TileMeasures(const std::vector<Vec2>& centres, const std::vector<double>& weights)>;

/// Which cells shall have which areas.
struct AreaProblem {
  Box box;
  Periodic periodic{false, false};
  MeasureCells measure;
  std::vector<Vec2> centres;   // of the sites, in the box [m]
  std::vector<double> shares;  // of the cells in the sum of their areas; in any unit, as only ratios matter
};

/// The problem for whole tiles.
AreaProblem tile_problem(const Box& box, const Periodic& periodic, std::vector<Vec2> centres,
                         std::vector<double> shares);

struct WeightOptions {
  double tolerance = 1e-9;  // largest relative error of an area [1]
  int iterations = 100;     // of Newton's, at most
  std::function<void(double error)> progress = {};
};

struct Weights {
  std::vector<double> weight;  // per site [m2]
  TileMeasures cells;          // with these weights
  double error = 0;            // largest relative error of an area [1]
  int iterations = 0;          // of Newton's
  int diagrams = 0;            // that were measured
};

/// Solves for the weights, from `start` on; where that leaves a cell empty, from a fraction of it. Throws SceneError for
/// what no weights can do: shares that are not positive and finite, two sites at one place, a cell that is empty
/// even without weights; and, with the best error reached, when the iteration ends before the tolerance.
Weights solve_weights(const AreaProblem& problem, std::vector<double> start, const WeightOptions& options = {});

/// Lloyd's sweeps with areas kept: every site moves to the centroid of its cell, and the weights are solved for again, to a
/// hundredth; the last time to options.tolerance. Cells become round. Moves problem.centres; iterations and diagrams of all sweeps are summed.
Weights lloyd_sweeps(AreaProblem& problem, std::vector<double> start, int sweeps, const WeightOptions& options = {});

/// Largest relative error of an area among cells that shall have these shares of the sum [1].
double largest_error(const std::vector<double>& areas, const std::vector<double>& shares);

}  // namespace lamella
