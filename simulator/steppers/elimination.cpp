#include "simulator/steppers/elimination.h"

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <new>
#include <numeric>
#include <tuple>
#include <utility>

namespace lamella {
namespace {

/// Minimum degree, then children before parents. Returns the number of entries of each column of L.
std::vector<int> find_order(const std::vector<int>& column_begin, const std::vector<int>& rows,
                            std::vector<int>& order) {
  cholmod_common common{};
  cholmod_start(&common);
  common.print = 0;
  common.supernodal = CHOLMOD_SIMPLICIAL;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_AMD;
  common.postorder = 1;
  cholmod_sparse a{};  // a view: CHOLMOD reads the arrays and does not change them
  a.nrow = a.ncol = column_begin.size() - 1;
  a.nzmax = rows.size();
  a.p = const_cast<int*>(column_begin.data());
  a.i = const_cast<int*>(rows.data());
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_PATTERN;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  cholmod_factor* factor = cholmod_analyze(&a, &common);
  if (!factor) throw std::bad_alloc();
  const auto *perm = static_cast<const int*>(factor->Perm), *count = static_cast<const int*>(factor->ColCount);
  order.assign(perm, perm + a.nrow);
  std::vector<int> counts(count, count + a.nrow);
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  return counts;
}

/// For each row of L, the columns before it in which K has an entry, and the same by columns.
struct Permuted {
  std::vector<int> begin, at;
};
Permuted permuted(const std::vector<int>& column_begin, const std::vector<int>& rows, const std::vector<int>& place,
                  bool by_rows) {
  const int n = static_cast<int>(place.size());
  Permuted out{std::vector<int>(n + 1, 0), std::vector<int>(rows.size())};
  const auto for_each = [&](auto visit) {
    for (int j = 0; j < n; ++j)
      for (int k = column_begin[j]; k < column_begin[j + 1]; ++k) {
        const auto [column, row] = std::minmax(place[j], place[rows[k]]);
        by_rows ? visit(row, column) : visit(column, row);
      }
  };
  for_each([&](int key, int) { ++out.begin[key + 1]; });
  std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
  std::vector<int> next(out.begin.begin(), out.begin.end() - 1);
  for_each([&](int key, int value) { out.at[next[key]++] = value; });
  return out;
}

std::vector<int> elimination_tree(const Permuted& by_rows) {
  const int n = static_cast<int>(by_rows.begin.size()) - 1;
  std::vector<int> parent(n, -1), ancestor(n, -1);
  for (int row = 0; row < n; ++row)
    for (int k = by_rows.begin[row]; k < by_rows.begin[row + 1]; ++k)
      for (int i = by_rows.at[k]; i != -1 && i < row;) {
        const int next = ancestor[i];
        ancestor[i] = row;
        if (next == -1) parent[i] = row;
        i = next;
      }
  return parent;
}

struct Group {
  int first, end, size;
  double nonzero;
  double held() const {
    const double w = end - first;
    return w * size - 0.5 * w * (w - 1);
  }
};

// Zeros that are stored cost less than a small supernode does.
bool worth_merging(const Group& g) {
  const int width = g.end - g.first;
  const double zeros = 1 - g.nonzero / g.held();
  return width <= 4 || (width <= 16 && zeros < 0.4) || (width <= 48 && zeros < 0.1) || zeros < 0.05;
}

std::vector<Group> make_groups(const std::vector<int>& parent, const std::vector<int>& count) {
  std::vector<Group> out;
  const int n = static_cast<int>(parent.size());
  for (int first = 0; first < n;) {
    Group g{first, first + 1, count[first], static_cast<double>(count[first])};
    while (g.end < n && parent[g.end - 1] == g.end && count[g.end - 1] == count[g.end] + 1) g.nonzero += count[g.end++];
    first = g.end;
    // A child that comes just before can be taken in: its rows are among the parent's.
    while (!out.empty()) {
      const Group& child = out.back();
      if (parent[child.end - 1] < g.first || parent[child.end - 1] >= g.end) break;
      const Group both{child.first, g.end, g.size + child.end - child.first, g.nonzero + child.nonzero};
      if (!worth_merging(both)) break;
      g = both;
      out.pop_back();
    }
    out.push_back(g);
  }
  return out;
}

}  // namespace

void Elimination::analyze(const std::vector<int>& column_begin, const std::vector<int>& rows) {
  const std::vector<int> count = find_order(column_begin, rows, order);
  const int n = static_cast<int>(order.size());
  place.resize(n);
  for (int k = 0; k < n; ++k) place[order[k]] = k;
  const std::vector<int> parent = elimination_tree(permuted(column_begin, rows, place, true));
  const Permuted by_columns = permuted(column_begin, rows, place, false);

  supernodes.clear(), supernode_of.assign(n, 0), row_store_.clear(), values = 0, shares = 0, largest = 0;
  for (const Group& g : make_groups(parent, count)) {
    std::fill(supernode_of.begin() + g.first, supernode_of.begin() + g.end, static_cast<int>(supernodes.size()));
    Supernode s;
    s.first = g.first, s.end = g.end;
    supernodes.push_back(s);
  }
  const int many = static_cast<int>(supernodes.size());
  std::vector<std::vector<int>> children(many);
  std::vector<std::size_t> begin(many + 1, 0);
  std::vector<int> marked(n, -1);
  for (int k = 0; k < many; ++k) {
    Supernode& s = supernodes[k];
    const auto add = [&](int row) {
      if (row < s.end || marked[row] == k) return;
      marked[row] = k;
      row_store_.push_back(row);
    };
    for (int at = by_columns.begin[s.first]; at < by_columns.begin[s.end]; ++at) add(by_columns.at[at]);
    for (const int c : children[k])
      for (std::size_t at = begin[c]; at < begin[c + 1]; ++at) add(row_store_[at]);
    begin[k + 1] = row_store_.size();
    std::sort(row_store_.begin() + static_cast<std::ptrdiff_t>(begin[k]), row_store_.end());
    s.size = s.width() + static_cast<int>(begin[k + 1] - begin[k]);
    if (begin[k + 1] > begin[k]) {
      s.parent = supernode_of[row_store_[begin[k]]];
      children[s.parent].push_back(k);
    }
    s.share = shares;
    shares += static_cast<std::size_t>(s.below()) * (s.below() + 1) / 2;
    s.values = values;
    values += static_cast<std::size_t>(s.size) * s.width();
    largest = std::max(largest, s.size);
  }

  // Where rows and entries go.
  place_store_.assign(row_store_.size(), 0);
  std::vector<int> local(n, 0);
  const auto number_rows = [&](const Supernode& s, std::size_t from) {
    for (int j = s.first; j < s.end; ++j) local[j] = j - s.first;
    for (int j = 0; j < s.below(); ++j) local[row_store_[from + j]] = s.width() + j;
  };
  const std::size_t entries = rows.size();
  std::vector<int> column(entries), row(entries), next(many, 0);
  for (int j = 0; j < n; ++j)
    for (int k = column_begin[j]; k < column_begin[j + 1]; ++k) {
      std::tie(column[k], row[k]) = std::minmax(place[j], place[rows[k]]);
      ++next[supernode_of[column[k]]];
    }
  std::size_t at = 0;
  for (int k = 0; k < many; ++k) {
    supernodes[k].entries = at;
    at += next[k];
    supernodes[k].entries_end = at;
    next[k] = static_cast<int>(supernodes[k].entries);
  }
  source.resize(entries), target.resize(entries);
  for (std::size_t k = 0; k < entries; ++k) source[next[supernode_of[column[k]]]++] = static_cast<int>(k);
  for (int k = 0; k < many; ++k) {
    Supernode& s = supernodes[k];
    s.rows = row_store_.data() + begin[k], s.place_in_parent = place_store_.data() + begin[k];
    number_rows(s, begin[k]);
    for (std::size_t e = s.entries; e < s.entries_end; ++e)
      target[e] = (column[source[e]] - s.first) * s.size + local[row[source[e]]];
    for (const int c : children[k]) {
      for (std::size_t r = begin[c]; r < begin[c + 1]; ++r) place_store_[r] = local[row_store_[r]];
      supernodes[c].next_sibling = std::exchange(s.first_child, c);
    }
  }
}

}  // namespace lamella
