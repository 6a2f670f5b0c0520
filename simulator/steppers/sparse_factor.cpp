#include "simulator/steppers/sparse_factor.h"

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>

namespace lamella {

struct SparseFactor::Impl {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;  // solution and workspaces, kept between solves
  std::vector<int> place;                                  // of each row in the order of elimination
  Eigen::VectorXd solution;

  Impl() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SIMPLICIAL;  // what can be updated; and its solves are faster
    common.final_ll = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    common.postorder = 1;
  }
  ~Impl() {
    cholmod_free_factor(&factor, &common);
    cholmod_free_dense(&x, &common), cholmod_free_dense(&y, &common), cholmod_free_dense(&e, &common);
    cholmod_finish(&common);
  }
  bool positive() const {
    const auto* begin = static_cast<const int*>(factor->p);
    const auto* values = static_cast<const double*>(factor->x);
    for (std::size_t k = 0; k < factor->n; ++k)
      if (!(values[begin[k]] > 0)) return false;
    return true;
  }
};

namespace {

/// A view: CHOLMOD reads the arrays and does not change them.
cholmod_sparse lower_triangle(const std::vector<int>& column_begin, const std::vector<int>& rows,
                              const std::vector<double>* values) {
  cholmod_sparse a{};
  a.nrow = a.ncol = column_begin.size() - 1;
  a.nzmax = rows.size();
  a.p = const_cast<int*>(column_begin.data());
  a.i = const_cast<int*>(rows.data());
  a.x = values ? const_cast<double*>(values->data()) : nullptr;
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = 1;
  a.packed = 1;
  return a;
}

}  // namespace

SparseFactor::SparseFactor() : impl_(std::make_unique<Impl>()) {}
SparseFactor::~SparseFactor() = default;

void SparseFactor::analyze(const std::vector<int>& column_begin, const std::vector<int>& rows) {
  cholmod_free_factor(&impl_->factor, &impl_->common);
  cholmod_sparse a = lower_triangle(column_begin, rows, nullptr);
  impl_->factor = cholmod_analyze(&a, &impl_->common);
  if (!impl_->factor) throw std::bad_alloc();
  const auto* order = static_cast<const int*>(impl_->factor->Perm);
  impl_->place.resize(impl_->factor->n);
  for (std::size_t k = 0; k < impl_->factor->n; ++k) impl_->place[order[k]] = static_cast<int>(k);
}

bool SparseFactor::factorize(const std::vector<int>& column_begin, const std::vector<int>& rows,
                             const std::vector<double>& values, double shift) {
  cholmod_sparse a = lower_triangle(column_begin, rows, &values);
  double beta[2] = {shift, 0};
  cholmod_factorize_p(&a, beta, nullptr, 0, impl_->factor, &impl_->common);
  if (impl_->common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  return impl_->common.status == CHOLMOD_OK && impl_->positive();
}

const Eigen::VectorXd& SparseFactor::solve(const Eigen::VectorXd& b) {
  cholmod_dense right{};
  right.nrow = right.d = right.nzmax = static_cast<std::size_t>(b.size());
  right.ncol = 1;
  right.x = const_cast<double*>(b.data());
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  if (!cholmod_solve2(CHOLMOD_A, impl_->factor, &right, nullptr, &impl_->x, nullptr, &impl_->y, &impl_->e,
                      &impl_->common))
    throw std::bad_alloc();
  impl_->solution = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(impl_->x->x), b.size());
  return impl_->solution;
}

bool SparseFactor::update(const std::vector<int>& rows, const Eigen::MatrixXd& c, int sign) {
  // CHOLMOD wants C in the order of elimination.
  const std::vector<int>& place = impl_->place;
  std::vector<std::size_t> by_place(rows.size());
  std::iota(by_place.begin(), by_place.end(), 0);
  std::sort(by_place.begin(), by_place.end(), [&](auto a, auto b) { return place[rows[a]] < place[rows[b]]; });
  std::vector<int> begin{0}, at;
  std::vector<double> values;
  for (Eigen::Index column = 0; column < c.cols(); ++column) {
    for (const auto k : by_place)
      at.push_back(place[rows[k]]), values.push_back(c(static_cast<Eigen::Index>(k), column));
    begin.push_back(static_cast<int>(at.size()));
  }
  cholmod_sparse a = lower_triangle(begin, at, &values);
  a.nrow = impl_->factor->n;
  a.stype = 0;
  cholmod_updown(sign > 0, &a, impl_->factor, &impl_->common);
  if (impl_->common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  return impl_->common.status == CHOLMOD_OK && impl_->positive();
}

double SparseFactor::entries() const { return impl_->common.lnz; }

}  // namespace lamella
