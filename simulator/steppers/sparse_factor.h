// A sparse Cholesky factor, P K P^T = L D L^T, that can be kept while the matrix changes by a few rank-one terms. CHOLMOD (of
// SuiteSparse) stands behind this header.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

namespace lamella {

class SparseFactor {
 public:
  SparseFactor();
  ~SparseFactor();
  SparseFactor(const SparseFactor&) = delete;

  /// Finds the order of elimination for a symmetric matrix of which the lower triangle has this pattern (compressed columns).
  void analyze(const std::vector<int>& column_begin, const std::vector<int>& rows);
  /// Factors K + shift I. Returns whether that is positive definite; if not, the factor is of no use.
  bool factorize(const std::vector<int>& column_begin, const std::vector<int>& rows, const std::vector<double>& values,
                 double shift);
  /// K^-1 b. Shape (n).
  const Eigen::VectorXd& solve(const Eigen::VectorXd& b);
  /// K += sign * C C^T, where row k of C belongs to row rows[k] of K. Returns whether the result is positive definite.
  bool update(const std::vector<int>& rows, const Eigen::MatrixXd& c, int sign);
  /// Entries of L.
  double entries() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lamella
