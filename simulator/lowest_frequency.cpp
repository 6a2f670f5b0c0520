#include "simulator/lowest_frequency.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <random>

#include "simulator/assembly.h"
#include "simulator/moving_box.h"

namespace lamella {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr int kVectors = 8;          // three of them may be motions of a free shell
constexpr int kIterations = 60;      // at most
constexpr double kConverged = 1e-4;  // relative change of the frequency
// Over the largest eigenvalue of the system. The shift keeps the matrix regular where shells are free.
constexpr double kShift = 1e-10, kRigid = 1e-9;

/// Where a box moves masses are those of relative coordinates (moving_box.h), and so has the stiffness to be.
Sparse relative_stiffness(const Model& model, const FreeComponents& free, const Field& x) {
  const Sparse k = assembled_stiffness(model, free, x);
  if (!box_moves(model.sample, x) || !free.moves(model.sample.nodes())) return k;
  Sparse to_x(free.size(), free.size());
  to_x.setIdentity();
  for (int c = 0; c < 2; ++c)
    if (const int box = free.row(model.sample.nodes(), c); box >= 0)
      for (Index i = 0; i < model.sample.nodes(); ++i)
        to_x.coeffRef(free.row(i, c), box) = carried_share(model.sample, i)[c];
  return to_x.transpose() * k * to_x;
}

}  // namespace

std::optional<double> lowest_frequency(const Model& model, const std::vector<Load>& loads, const Field& x) {
  const FreeComponents free(x.size(), loads);
  const int size = free.size();
  const int vectors = std::min(kVectors, size);
  if (vectors == 0) return std::nullopt;

  Eigen::VectorXd to_unit_mass(size);
  for (int row = 0; row < size; ++row) to_unit_mass[row] = std::sqrt(model.inverse_mass[free.node_of(row)]);
  const Sparse k = to_unit_mass.asDiagonal() * relative_stiffness(model, free, x) * to_unit_mass.asDiagonal();
  Eigen::VectorXd row_sums = Eigen::VectorXd::Zero(size);
  for (int column = 0; column < size; ++column)
    for (Sparse::InnerIterator it(k, column); it; ++it) row_sums[it.row()] += std::abs(it.value());
  const double largest = row_sums.maxCoeff();
  if (!(largest > 0)) return std::nullopt;

  Sparse shifted = k;
  for (int d = 0; d < size; ++d) shifted.coeffRef(d, d) += kShift * largest;
  const Eigen::SimplicialLDLT<Sparse> factor(shifted);
  if (factor.info() != Eigen::Success) return std::nullopt;

  std::mt19937 random(1);
  Eigen::MatrixXd q(size, vectors);
  for (int c = 0; c < vectors; ++c)
    for (int r = 0; r < size; ++r) q(r, c) = random() / 4294967295.0 - 0.5;
  double before = 0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    q = factor.solve(q);
    q = Eigen::HouseholderQR<Eigen::MatrixXd>(q).householderQ() * Eigen::MatrixXd::Identity(size, vectors);
    const Eigen::MatrixXd projected = q.transpose() * (k * q);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(projected);
    q = q * ritz.eigenvectors();
    double lowest = 0;
    for (int c = 0; c < vectors && lowest == 0; ++c)
      if (ritz.eigenvalues()[c] > kRigid * largest) lowest = ritz.eigenvalues()[c];
    if (lowest > 0 && std::abs(lowest - before) < kConverged * lowest) return std::sqrt(lowest);
    before = lowest;
  }
  return before > 0 ? std::optional(std::sqrt(before)) : std::nullopt;
}

}  // namespace lamella
