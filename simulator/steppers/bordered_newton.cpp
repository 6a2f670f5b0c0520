// Equilibrium under a load that is itself unknown, where something else is prescribed: Newton's method on the bordered system
//
//   [ K  -f_t ] [ dx ]   [ f               ]
//   [ c    0  ] [ dt ] = [ goal - c.(x - x0) ]
//
// which is regular at limit points, where K is not, and which finds equilibria that are no minima.
#include <Eigen/SparseLU>

#include "simulator/steppers/equilibrium.h"

namespace lamella {

bool EquilibriumSolver::bordered_step(const Field& x, const Eigen::VectorXd& f, const Eigen::VectorXd& f_t,
                                      const Eigen::VectorXd& c, double c_left, Eigen::VectorXd& dx, double& dt) {
  const int n = free_.size();
  const Eigen::SparseMatrix<double> k = assembled_stiffness(model_, free_, x);
  // The border is scaled to the rest, so that pivots mean something.
  const double stiff = k.diagonal().cwiseAbs().maxCoeff(), load = f_t.cwiseAbs().maxCoeff();
  if (!(stiff > 0) || !(load > 0)) return false;
  const double row_scale = stiff, column_scale = stiff / load;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(k.nonZeros()) + 2 * static_cast<std::size_t>(n));
  for (int j = 0; j < n; ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator e(k, j); e; ++e)
      entries.emplace_back(static_cast<int>(e.row()), j, e.value());
  for (int i = 0; i < n; ++i) {
    if (f_t[i] != 0) entries.emplace_back(i, n, -column_scale * f_t[i]);
    if (c[i] != 0) entries.emplace_back(n, i, row_scale * c[i]);
  }
  Eigen::SparseMatrix<double> bordered(n + 1, n + 1);
  bordered.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(bordered);
  if (lu.info() != Eigen::Success) return false;
  Eigen::VectorXd right(n + 1);
  right << f, row_scale * c_left;
  const Eigen::VectorXd solution = lu.solve(right);
  ++cost_.factorizations, ++cost_.solves;
  if (!solution.allFinite()) return false;
  dx = solution.head(n);
  dt = column_scale * solution[n];
  return true;
}

bool EquilibriumSolver::holds_at(const Field& x) {
  shift_ = 0;
  loose_.setZero();
  refactor(x);
  const bool stable = factored_ && is_minimum();
  factored_ = false;
  return stable;
}

}  // namespace lamella
