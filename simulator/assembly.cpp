#include "simulator/assembly.h"

#include <algorithm>

namespace lamella {

FreeComponents::FreeComponents(std::size_t nodes, const std::vector<Load>& loads) : row_(2 * nodes, 0) {
  for (const Load& load : loads)
    for (Index i : load.nodes)
      for (int c = 0; c < 2; ++c)
        if (load.holds[c] && static_cast<std::size_t>(i) < nodes)  // a box without an entry stays as it is
          row_[2 * static_cast<std::size_t>(i) + c] = -1;
  for (std::size_t k = 0; k < row_.size(); ++k)
    if (row_[k] == 0) row_[k] = static_cast<int>(component_.size()), component_.push_back(static_cast<Index>(k));
}

FreeComponents::FreeComponents(const FreeComponents& all, const std::vector<Index>& nodes) : row_(all.row_.size(), -1) {
  for (const Index i : nodes)
    for (int c = 0; c < 2; ++c)
      if (all.row(i, c) >= 0) {
        row_[2 * static_cast<std::size_t>(i) + c] = static_cast<int>(component_.size());
        component_.push_back(2 * i + c);
      }
}

Eigen::VectorXd FreeComponents::gathered(const Field& field) const {
  Eigen::VectorXd out(size());
  for (int r = 0; r < size(); ++r) {
    const Index k = component_[r];
    out[r] = k % 2 == 0 ? field.x[k / 2] : field.y[k / 2];
  }
  return out;
}

void FreeComponents::add(const Eigen::VectorXd& step, double factor, Field& field) const {
  for (int r = 0; r < size(); ++r) {
    const Index k = component_[r];
    (k % 2 == 0 ? field.x[k / 2] : field.y[k / 2]) += factor * step[r];
  }
}

bool StiffnessMatrix::assemble(const std::function<void(StiffnessSink&)>& visit) {
  bool changed = false;
  while (true) {
    std::fill(values_.begin(), values_.end(), 0.0);
    for (Added& added : added_) added.entry.clear(), added.value.clear();
    visit(*this);
    record_ = nullptr;
    if (missing_.empty() && !column_begin_.empty()) break;
    auto pairs = std::exchange(missing_, {});
    for (std::size_t j = 0; j + 1 < pair_begin_.size(); ++j)
      for (Index k = pair_begin_[j]; k < pair_begin_[j + 1]; ++k)
        pairs.emplace_back(static_cast<Index>(j), pair_node_[k]);
    make_pattern(std::move(pairs));
    changed = true;
  }
  if (changed)
    for (Added& added : added_) added.entry.shrink_to_fit(), added.value.shrink_to_fit();
  return changed;
}

bool StiffnessMatrix::reassemble(const std::vector<std::uint8_t>& cells,
                                 const std::function<void(StiffnessSink&)>& visit) {
  changed_.clear();
  // Every element adds to the diagonal of all of its rows.
  const auto note = [&](const Added& added) {
    for (const int entry : added.entry)
      if (changed_.empty() || changed_.back() != rows_[entry]) changed_.push_back(rows_[entry]);
  };
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (!cells[c]) continue;
    Added& added = added_[c];
    note(added);
    for (std::size_t k = 0; k < added.entry.size(); ++k) values_[added.entry[k]] -= added.value[k];
    added.entry.clear(), added.value.clear();
  }
  wanted_ = &cells;
  visit(*this);
  wanted_ = nullptr, record_ = nullptr;
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (cells[c]) note(added_[c]);
  return missing_.empty();
}

bool StiffnessMatrix::begin_elements(Index cell) {
  if (wanted_ && !(*wanted_)[cell]) return false;
  if (!added_.empty()) record_ = &added_[cell];
  return true;
}

void StiffnessMatrix::make_pattern(std::vector<std::pair<Index, Index>> pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  const Index nodes = static_cast<Index>(free_->nodes());
  const auto free_of = [&](Index i) { return (free_->row(i, 0) >= 0) + (free_->row(i, 1) >= 0); };
  pair_begin_.assign(1, 0), pair_node_.clear(), before_.clear();
  column_begin_.assign(1, 0), rows_.clear();
  std::size_t at = 0;
  for (Index j = 0; j < nodes; ++j) {
    const std::size_t first = at;
    int before = 0;
    for (; at < pairs.size() && pairs[at].first == j; ++at) {
      pair_node_.push_back(pairs[at].second), before_.push_back(before);
      before += free_of(pairs[at].second);
    }
    pair_begin_.push_back(static_cast<Index>(pair_node_.size()));
    for (int c = 0; c < 2; ++c) {
      if (free_->row(j, c) < 0) continue;
      for (int a = c; a < 2; ++a)
        if (free_->row(j, a) >= 0) rows_.push_back(free_->row(j, a));
      for (std::size_t k = first; k < at; ++k)
        for (int a = 0; a < 2; ++a)
          if (free_->row(pairs[k].second, a) >= 0) rows_.push_back(free_->row(pairs[k].second, a));
      column_begin_.push_back(static_cast<int>(rows_.size()));
    }
  }
  values_.assign(rows_.size(), 0.0);
}

void StiffnessMatrix::add(Index i, Index j, const Eigen::Matrix2d& block) {
  if (i < j || !free_->moves(i) || !free_->moves(j)) return;  // the lower triangle; its mirror image comes too
  if (i == j) {
    if (column_begin_.empty()) return;
    const int x = free_->row(j, 0), y = free_->row(j, 1);
    if (x >= 0) {
      const int at = column_begin_[x];
      put(at, block(0, 0));
      if (y >= 0) put(at + 1, block(1, 0));
    }
    if (y >= 0) put(column_begin_[y], block(1, 1));
    return;
  }
  if (pair_begin_.empty()) {
    missing_.emplace_back(j, i);
    return;
  }
  const auto first = pair_node_.begin() + pair_begin_[j], last = pair_node_.begin() + pair_begin_[j + 1];
  const auto found = std::lower_bound(first, last, i);
  if (found == last || *found != i) {
    missing_.emplace_back(j, i);
    return;
  }
  const int before = before_[found - pair_node_.begin()];
  for (int c = 0; c < 2; ++c) {
    const int column = free_->row(j, c);
    if (column < 0) continue;
    const int own = c == 0 && free_->row(j, 1) >= 0 ? 2 : 1;
    int at = column_begin_[column] + own + before;
    if (free_->row(i, 0) >= 0) put(at++, block(0, c));
    if (free_->row(i, 1) >= 0) put(at, block(1, c));
  }
}

double StiffnessMatrix::largest_diagonal() const {
  double largest = 0;
  for (int c = 0; c < size(); ++c) largest = std::max(largest, std::abs(values_[column_begin_[c]]));
  return largest;
}

Eigen::SparseMatrix<double> assembled_stiffness(const Model& model, const FreeComponents& free, const Field& x) {
  StiffnessMatrix k(free);
  k.assemble([&](StiffnessSink& sink) { model.add_stiffness(x, sink); });
  return k.full();
}

Eigen::SparseMatrix<double> StiffnessMatrix::lower() const {
  return Eigen::Map<const Eigen::SparseMatrix<double>>(size(), size(), static_cast<Eigen::Index>(rows_.size()),
                                                       column_begin_.data(), rows_.data(), values_.data());
}

}  // namespace lamella
