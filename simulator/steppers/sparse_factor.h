// A sparse Cholesky factor, P K P^T = L L^T, that can be kept while the matrix changes by a few rank-one terms.
//
// Made for a tangent that is used many times before it is made anew: fronts are eliminated in double precision, one supernode after the
// other, but L is kept in single precision. What a solution costs is reading L, and the rounding of L changes K^-1 b by 1e-7, which an
// iteration that measures its own residual never notices.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "simulator/steppers/elimination.h"

namespace lamella {

class SparseFactor {
 public:
  /// Finds the order of elimination for a symmetric matrix of which the lower triangle has this pattern (compressed columns).
  void analyze(const std::vector<int>& column_begin, const std::vector<int>& rows) {
    plan_.analyze(column_begin, rows);
  }
  /// Factors K + shift I, of which `values` are the lower triangle in the pattern of `analyze`. Returns whether that is positive definite; if
  /// not, the factor is of no use.
  bool factorize(const std::vector<double>& values, double shift);
  /// The same where only these rows (and columns) of K, and the rows of updates, have changed since the factor was made: what does not depend on
  /// them stays. As long as `shift` is the same, the result is that of `factorize`.
  bool refactorize(const std::vector<double>& values, double shift, const std::vector<int>& rows);
  /// K^-1 b. Shape (n).
  const Eigen::VectorXd& solve(const Eigen::VectorXd& b);
  /// K += sign * C C^T, where row k of C belongs to row rows[k] of K. Returns false where L has no room for the result, or that is not
  /// positive definite; then the factor is of no use.
  bool update(const std::vector<int>& rows, const Eigen::MatrixXd& c, int sign);
  /// Entries of L, with the zeros that are kept.
  double entries() const { return static_cast<double>(plan_.values); }

 private:
  void mark_stale(int supernode);
  bool eliminate_supernode(int k, const std::vector<double>& values, double shift);
  bool update_by(int first_column, int sign);

  Elimination plan_;
  std::vector<float> l_;
  std::vector<double> inverse_diagonal_;  // of L
  std::vector<double> share_;             // of each supernode in its parent
  std::vector<std::uint8_t> stale_;       // per supernode: its share, or what it depends on, is of another K
  std::vector<double> front_;             // scratch
  std::vector<double> work_, local_;      // scratch; work_ is zero between calls
  Eigen::VectorXd permuted_, solution_;
};

}  // namespace lamella
