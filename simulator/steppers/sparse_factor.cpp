#include "simulator/steppers/sparse_factor.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

constexpr int kPanel = 8;

/// The columns [k, k + width) of a front, lower triangle, once all columns before have been subtracted from them.
bool factor_panel(double* f, int size, int k, int width) {
  for (int j = k; j < k + width; ++j) {
    double* const c = f + static_cast<std::size_t>(j) * size;
    for (int p = k; p < j; ++p) {
      const double* const b = f + static_cast<std::size_t>(p) * size;
      const double factor = b[j];
#pragma omp simd
      for (int i = j; i < size; ++i) c[i] -= factor * b[i];
    }
    if (!(c[j] > 0)) return false;
    const double inverse = 1 / std::sqrt(c[j]);
#pragma omp simd
    for (int i = j; i < size; ++i) c[i] *= inverse;
  }
  return true;
}

/// Subtracts a full panel from all columns behind it, two at a time: each of the panel's values is read once for both.
void subtract_panel(double* f, int size, int k) {
  const double* b[kPanel];
  for (int p = 0; p < kPanel; ++p) b[p] = f + static_cast<std::size_t>(k + p) * size;
  const double *b0 = b[0], *b1 = b[1], *b2 = b[2], *b3 = b[3], *b4 = b[4], *b5 = b[5], *b6 = b[6], *b7 = b[7];
  int j = k + kPanel;
  for (; j + 1 < size; j += 2) {
    double *c = f + static_cast<std::size_t>(j) * size, *d = c + size;
    double u[kPanel], v[kPanel];
    for (int p = 0; p < kPanel; ++p) u[p] = b[p][j], v[p] = b[p][j + 1];
#pragma omp simd
    for (int i = j; i < size; ++i) {
      c[i] -= u[0] * b0[i] + u[1] * b1[i] + u[2] * b2[i] + u[3] * b3[i] + u[4] * b4[i] + u[5] * b5[i] + u[6] * b6[i] +
              u[7] * b7[i];
      d[i] -= v[0] * b0[i] + v[1] * b1[i] + v[2] * b2[i] + v[3] * b3[i] + v[4] * b4[i] + v[5] * b5[i] + v[6] * b6[i] +
              v[7] * b7[i];
    }
  }
  for (; j < size; ++j) {
    double* const c = f + static_cast<std::size_t>(j) * size;
    for (int p = 0; p < kPanel; ++p)
      for (int i = j; i < size; ++i) c[i] -= b[p][j] * b[p][i];
  }
}

/// The same of a panel that is not full.
void subtract_columns(double* f, int size, int k, int width) {
  for (int j = k + width; j < size; ++j) {
    double* const c = f + static_cast<std::size_t>(j) * size;
    for (int p = k; p < k + width; ++p) {
      const double* const b = f + static_cast<std::size_t>(p) * size;
      const double factor = b[j];
#pragma omp simd
      for (int i = j; i < size; ++i) c[i] -= factor * b[i];
    }
  }
}

/// Eliminates the first `width` columns of a front; what is left of it is the others' share in what follows.
bool eliminate(double* f, int size, int width) {
  int k = 0;
  for (; k + kPanel <= width; k += kPanel) {
    if (!factor_panel(f, size, k, kPanel)) return false;
    subtract_panel(f, size, k);
  }
  if (k == width) return true;
  if (!factor_panel(f, size, k, width - k)) return false;
  subtract_columns(f, size, k, width - k);
  return true;
}

// Solutions go through a supernode four columns at a time, so that x is read and written once for four.

/// x := L^-1 x in the supernode's own rows; below, what that takes from the others is subtracted.
void forward(const float* l, const double* inverse_diagonal, int width, int size, double* x) {
  int j = 0;
  for (; j + 4 <= width; j += 4) {
    const float *a = l + static_cast<std::size_t>(j) * size, *b = a + size, *c = b + size, *d = c + size;
    const double p = x[j] * inverse_diagonal[j];
    const double q = (x[j + 1] - a[j + 1] * p) * inverse_diagonal[j + 1];
    const double r = (x[j + 2] - a[j + 2] * p - b[j + 2] * q) * inverse_diagonal[j + 2];
    const double u = (x[j + 3] - a[j + 3] * p - b[j + 3] * q - c[j + 3] * r) * inverse_diagonal[j + 3];
    x[j] = p, x[j + 1] = q, x[j + 2] = r, x[j + 3] = u;
#pragma omp simd
    for (int i = j + 4; i < size; ++i) x[i] -= p * a[i] + q * b[i] + r * c[i] + u * d[i];
  }
  for (; j < width; ++j) {
    const float* const a = l + static_cast<std::size_t>(j) * size;
    const double p = x[j] *= inverse_diagonal[j];
#pragma omp simd
    for (int i = j + 1; i < size; ++i) x[i] -= p * a[i];
  }
}

/// x := L^-T x in the supernode's own rows, from what is known below.
void backward(const float* l, const double* inverse_diagonal, int width, int size, double* x) {
  int j = width;
  for (; j % 4 != 0; --j) {
    const float* const a = l + static_cast<std::size_t>(j - 1) * size;
    double p = 0;
#pragma omp simd reduction(+ : p)
    for (int i = j; i < size; ++i) p += x[i] * a[i];
    x[j - 1] = (x[j - 1] - p) * inverse_diagonal[j - 1];
  }
  for (j -= 4; j >= 0; j -= 4) {
    const float *a = l + static_cast<std::size_t>(j) * size, *b = a + size, *c = b + size, *d = c + size;
    double p = 0, q = 0, r = 0, u = 0;
#pragma omp simd reduction(+ : p, q, r, u)
    for (int i = j + 4; i < size; ++i) p += x[i] * a[i], q += x[i] * b[i], r += x[i] * c[i], u += x[i] * d[i];
    u = x[j + 3] = (x[j + 3] - u) * inverse_diagonal[j + 3];
    r = x[j + 2] = (x[j + 2] - r - c[j + 3] * u) * inverse_diagonal[j + 2];
    q = x[j + 1] = (x[j + 1] - q - b[j + 2] * r - b[j + 3] * u) * inverse_diagonal[j + 1];
    x[j] = (x[j] - p - a[j + 1] * q - a[j + 2] * r - a[j + 3] * u) * inverse_diagonal[j];
  }
}

}  // namespace

bool SparseFactor::factorize(const std::vector<double>& values, double shift) {
  l_.resize(plan_.values), inverse_diagonal_.resize(plan_.size()), work_.assign(plan_.size(), 0.0);
  local_.resize(plan_.largest);
  front_.resize(static_cast<std::size_t>(plan_.largest) * plan_.largest), share_.resize(plan_.shares);
  stale_.assign(plan_.supernodes.size(), 0);
  for (std::size_t k = 0; k < plan_.supernodes.size(); ++k)
    if (!eliminate_supernode(static_cast<int>(k), values, shift)) return false;
  return true;
}

bool SparseFactor::refactorize(const std::vector<double>& values, double shift, const std::vector<int>& rows) {
  for (const int row : rows) mark_stale(plan_.supernode_of[plan_.place[row]]);
  for (std::size_t k = 0; k < plan_.supernodes.size(); ++k)
    if (stale_[k] && !eliminate_supernode(static_cast<int>(k), values, shift)) return false;
  return true;
}

/// This supernode, and all that depend on it.
void SparseFactor::mark_stale(int supernode) {
  for (int k = supernode; k >= 0 && !stale_[k]; k = plan_.supernodes[k].parent) stale_[k] = 1;
}

/// Makes its columns of L, and its share in its parent.
bool SparseFactor::eliminate_supernode(int k, const std::vector<double>& values, double shift) {
  const Supernode& s = plan_.supernodes[k];
  double* const f = front_.data();
  const int size = s.size, width = s.width();
  for (int j = 0; j < size; ++j) std::fill_n(f + static_cast<std::size_t>(j) * size + j, size - j, 0.0);
  for (std::size_t e = s.entries; e < s.entries_end; ++e) f[plan_.target[e]] += values[plan_.source[e]];
  for (int j = 0; j < width; ++j) f[static_cast<std::size_t>(j) * size + j] += shift;
  for (int c = s.first_child; c >= 0; c = plan_.supernodes[c].next_sibling) {
    const Supernode& child = plan_.supernodes[c];
    const int n = child.below();
    const int* const to = child.place_in_parent;
    const double* u = share_.data() + child.share;
    for (int j = 0; j < n; u += n - j, ++j) {
      double* const column = f + static_cast<std::size_t>(to[j]) * size;
      for (int i = j; i < n; ++i) column[to[i]] += u[i - j];
    }
  }
  if (!eliminate(f, size, width)) return false;
  float* const l = l_.data() + s.values;
  for (int j = 0; j < width; ++j) {
    const double* const c = f + static_cast<std::size_t>(j) * size;
    inverse_diagonal_[s.first + j] = 1 / c[j];
    for (int i = j; i < size; ++i) l[static_cast<std::size_t>(j) * size + i] = static_cast<float>(c[i]);
  }
  double* u = share_.data() + s.share;
  for (int j = width; j < size; ++j) u = std::copy_n(f + static_cast<std::size_t>(j) * size + j, size - j, u);
  stale_[k] = 0;
  return true;
}

const Eigen::VectorXd& SparseFactor::solve(const Eigen::VectorXd& b) {
  const int n = plan_.size();
  permuted_.resize(n), solution_.resize(n);
  double *const y = permuted_.data(), *const x = local_.data();  // x: at the supernode's rows
  for (int k = 0; k < n; ++k) y[k] = b[plan_.order[k]];
  for (const Supernode& s : plan_.supernodes) {
    const int width = s.width(), below = s.below();
    std::copy_n(y + s.first, width, x);
    std::fill_n(x + width, below, 0.0);
    forward(l_.data() + s.values, inverse_diagonal_.data() + s.first, width, s.size, x);
    std::copy_n(x, width, y + s.first);
    for (int i = 0; i < below; ++i) y[s.rows[i]] += x[width + i];
  }
  for (auto s = plan_.supernodes.rbegin(); s != plan_.supernodes.rend(); ++s) {
    const int width = s->width(), below = s->below();
    std::copy_n(y + s->first, width, x);
    for (int i = 0; i < below; ++i) x[width + i] = y[s->rows[i]];
    backward(l_.data() + s->values, inverse_diagonal_.data() + s->first, width, s->size, x);
    std::copy_n(x, width, y + s->first);
  }
  for (int k = 0; k < n; ++k) solution_[plan_.order[k]] = y[k];
  return solution_;
}

/// By the vector in work_, whose first entry is in this column; leaves work_ zero.
bool SparseFactor::update_by(int first_column, int sign) {
  bool positive = true;
  for (int k = plan_.supernode_of[first_column]; k >= 0; k = plan_.supernodes[k].parent) {
    const Supernode& s = plan_.supernodes[k];
    const int size = s.size, width = s.width(), below = s.below();
    double* const w = local_.data();
    std::copy_n(work_.data() + s.first, width, w);
    std::fill_n(work_.data() + s.first, width, 0.0);
    for (int i = 0; i < below; ++i) w[width + i] = work_[s.rows[i]];
    for (int j = 0; j < width && positive; ++j) {
      if (w[j] == 0) continue;
      float* const c = l_.data() + s.values + static_cast<std::size_t>(j) * size;
      const double was = 1 / inverse_diagonal_[s.first + j], square = was * was + sign * w[j] * w[j];
      if (!(square > 0)) {
        positive = false;
        break;
      }
      const double now = std::sqrt(square), cosine = now / was, sine = w[j] / was, inverse = 1 / cosine;
      inverse_diagonal_[s.first + j] = 1 / now;
      c[j] = static_cast<float>(now);
#pragma omp simd
      for (int i = j + 1; i < size; ++i) {
        const double l = (c[i] + sign * sine * w[i]) * inverse;
        w[i] = cosine * w[i] - sine * l;
        c[i] = static_cast<float>(l);
      }
    }
    for (int i = 0; i < below; ++i) work_[s.rows[i]] = w[width + i];
  }
  return positive;
}

bool SparseFactor::update(const std::vector<int>& rows, const Eigen::MatrixXd& c, int sign) {
  // L has room for the result where it has all these rows in the column of the first.
  int head = plan_.size();
  for (const int row : rows) head = std::min(head, plan_.place[row]);
  const Supernode& s = plan_.supernodes[plan_.supernode_of[head]];
  mark_stale(plan_.supernode_of[head]);  // their shares are not updated
  for (const int row : rows)
    if (const int at = plan_.place[row]; at >= s.end && !std::binary_search(s.rows, s.rows + s.below(), at))
      return false;
  for (Eigen::Index column = 0; column < c.cols(); ++column) {
    int first = plan_.size();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const int at = plan_.place[rows[k]];
      work_[at] = c(static_cast<Eigen::Index>(k), column);
      first = std::min(first, at);
    }
    if (!update_by(first, sign)) return false;
  }
  return true;
}

}  // namespace lamella
