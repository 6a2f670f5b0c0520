#include "simulator/lowest_frequency.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <random>

namespace lamella {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr int kVectors = 8;          // three of them may be motions of a free shell
constexpr int kIterations = 60;      // at most
constexpr double kConverged = 1e-4;  // relative change of the frequency
// Over the largest eigenvalue of the system. The shift keeps the matrix regular where shells are free.
constexpr double kShift = 1e-10, kRigid = 1e-9;

/// Collects the blocks whose coordinates are free, scaled to unit masses: M^(-1/2) K M^(-1/2).
class FreeBlocks final : public StiffnessSink {
 public:
  FreeBlocks(const std::vector<int>& place, const std::vector<double>& inverse_mass)
      : place_(place), inverse_mass_(inverse_mass) {}
  void add(Index i, Index j, const Eigen::Matrix2d& block) override {
    const double scale = std::sqrt(inverse_mass_[i] * inverse_mass_[j]);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) {
        const int row = place_[2 * i + a], column = place_[2 * j + b];
        if (row >= 0 && column >= 0) entries.emplace_back(row, column, scale * block(a, b));
      }
  }
  std::vector<Eigen::Triplet<double>> entries;

 private:
  const std::vector<int>& place_;
  const std::vector<double>& inverse_mass_;
};

}  // namespace

std::optional<double> lowest_frequency(const Model& model, const std::vector<Load>& loads, const Field& x) {
  std::vector<int> place(2 * x.size(), 0);
  for (const Load& load : loads)
    for (Index i : load.nodes)
      for (int c = 0; c < 2; ++c)
        if (load.holds[c]) place[2 * i + c] = -1;
  int size = 0;
  for (int& p : place)
    if (p == 0) p = size++;
  const int vectors = std::min(kVectors, size);
  if (vectors == 0) return std::nullopt;

  FreeBlocks blocks(place, model.inverse_mass);
  for (const Term* term : model.terms()) term->add_stiffness(x, blocks);
  Sparse k(size, size);
  k.setFromTriplets(blocks.entries.begin(), blocks.entries.end());
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
