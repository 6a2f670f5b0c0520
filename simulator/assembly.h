// From the terms' 2 x 2 blocks to a sparse matrix over the components of positions that no load holds.
#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <utility>
#include <vector>

#include "simulator/loads.h"
#include "simulator/model.h"

namespace lamella {

/// The components of positions that no load holds, numbered node by node, x before y.
class FreeComponents {
 public:
  FreeComponents(std::size_t nodes, const std::vector<Load>& loads);
  /// Of `all`, those of these nodes; the others count as held.
  FreeComponents(const FreeComponents& all, const std::vector<Index>& nodes);

  int size() const { return static_cast<int>(component_.size()); }
  std::size_t nodes() const { return row_.size() / 2; }
  bool moves(Index node) const { return row(node, 0) >= 0 || row(node, 1) >= 0; }
  /// Number of component c of a node; -1: held.
  int row(Index node, int c) const { return row_[2 * static_cast<std::size_t>(node) + c]; }
  Index node_of(int row) const { return component_[row] / 2; }
  /// The free components of a field. Shape (size()).
  Eigen::VectorXd gathered(const Field& field) const;
  /// field += factor * step, on free components.
  void add(const Eigen::VectorXd& step, double factor, Field& field) const;

 private:
  std::vector<int> row_;          // of component 2 * node + c
  std::vector<Index> component_;  // of each row: 2 * node + c
};

/// Symmetric stiffness over the free components, as compressed columns of its lower triangle. The pattern is found once and kept; a block
/// outside it is remembered and widens it.
class StiffnessMatrix final : public StiffnessSink {
 public:
  /// `cells`: so many can be assembled anew one by one (`reassemble`), for which what each adds is remembered; 0: only all at once.
  explicit StiffnessMatrix(const FreeComponents& free, Index cells = 0) : free_(&free), added_(cells) {}

  /// Sums what `visit` adds, in place of what was there. Returns true if the pattern is another one than before.
  bool assemble(const std::function<void(StiffnessSink&)>& visit);
  /// The same for the elements of some cells (not 0); what others have added stays, and what belongs to none, added before all of them. Returns false where the pattern has no room for it: then
  /// all must be assembled.
  bool reassemble(const std::vector<std::uint8_t>& cells, const std::function<void(StiffnessSink&)>& visit);
  void add(Index i, Index j, const Eigen::Matrix2d& block) override;
  bool begin_elements(Index cell) override;
  /// What is added to the diagonal stays until all is assembled.
  void add_to_diagonal(int row, double value) { values_[column_begin_[row]] += value; }
  /// Rows in which the last `reassemble` may have changed something, the diagonal included; some of them more than once.
  const std::vector<int>& changed_rows() const { return changed_; }

  int size() const { return free_->size(); }
  const std::vector<int>& column_begin() const { return column_begin_; }
  const std::vector<int>& rows() const { return rows_; }
  const std::vector<double>& values() const { return values_; }
  double largest_diagonal() const;
  /// The same as a matrix of Eigen's: its lower triangle, or all of it.
  Eigen::SparseMatrix<double> lower() const;
  Eigen::SparseMatrix<double> full() const { return lower().selfadjointView<Eigen::Lower>(); }

 private:
  void make_pattern(std::vector<std::pair<Index, Index>> pairs);
  void put(int entry, double value) {
    values_[entry] += value;
    if (record_) record_->entry.push_back(entry), record_->value.push_back(value);
  }

  const FreeComponents* free_;
  // per node j: the nodes i > j that it has blocks with, ascending, and how many free components come before each
  std::vector<Index> pair_begin_, pair_node_;
  std::vector<int> before_;
  std::vector<int> column_begin_, rows_;
  std::vector<double> values_;
  std::vector<std::pair<Index, Index>> missing_;  // (column node, row node) outside the pattern
  struct Added {
    std::vector<int> entry;  // of values_
    std::vector<double> value;
  };
  std::vector<Added> added_;                           // by the elements of each cell
  Added* record_ = nullptr;                            // of the present elements' cell
  const std::vector<std::uint8_t>* wanted_ = nullptr;  // of `reassemble`
  std::vector<int> changed_;
};

/// d2W / dx2 of all terms together over the free components [N/m].
Eigen::SparseMatrix<double> assembled_stiffness(const Model& model, const FreeComponents& free, const Field& x);

}  // namespace lamella
