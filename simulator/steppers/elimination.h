// The symbolic half of a sparse Cholesky factor: the order of elimination, and columns of L with (nearly) the same rows gathered into
// *supernodes*, so that the numbers can be worked on as small dense matrices. Found once per pattern.
#pragma once
#include <vector>

namespace lamella {

struct Supernode {
  int first = 0, end = 0;                   // columns of L
  int parent = -1;                          // supernode of the first row below; -1: a root
  int size = 0;                             // rows of L: its own columns, and `rows` below them
  const int* rows = nullptr;                // below, ascending. Shape (below())
  const int* place_in_parent = nullptr;     // of each of these rows among the parent's rows. Shape (below())
  int first_child = -1, next_sibling = -1;  // supernodes; -1: none
  std::size_t share = 0;   // where starts what it subtracts from its parent: a lower triangle, shape (below(), below())
  std::size_t values = 0;  // where its block of L starts; shape (width(), size), column by column
  std::size_t entries = 0, entries_end = 0;  // of K that are assembled here: range of `source` and `target`

  int width() const { return end - first; }
  int below() const { return size - width(); }
};

struct Elimination {
  Elimination() = default;
  Elimination(const Elimination&) = delete;

  /// For a symmetric matrix whose lower triangle has this pattern (compressed columns).
  void analyze(const std::vector<int>& column_begin, const std::vector<int>& rows);

  int size() const { return static_cast<int>(place.size()); }

  std::vector<int> order, place;      // row of K that is eliminated k-th, and the inverse
  std::vector<Supernode> supernodes;  // children before parents
  std::vector<int> supernode_of;      // of each column of L
  std::vector<int> source,
      target;  // of each entry of K: its index, and where it goes in its supernode's front, column by column
  std::size_t values = 0;  // entries of L
  std::size_t shares = 0;  // values of all shares
  int largest = 0;         // supernode's size

 private:
  std::vector<int> row_store_, place_store_;
};

}  // namespace lamella
