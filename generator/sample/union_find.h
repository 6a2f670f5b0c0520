// Disjoint sets with path halving; the root of a set is its lowest member, so that results do not depend on the order of joins.
#pragma once
#include <numeric>
#include <vector>

#include "generator/sample/sample.h"

namespace lamella {

class UnionFind {
 public:
  explicit UnionFind(Index size = 0) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }

  Index size() const { return static_cast<Index>(parent_.size()); }
  /// One more set, of one member, which it returns.
  Index add() {
    parent_.push_back(size());
    return parent_.back();
  }
  Index root(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index i, Index j) {
    i = root(i), j = root(j);
    if (i < j)
      parent_[j] = i;
    else
      parent_[i] = j;
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace lamella
