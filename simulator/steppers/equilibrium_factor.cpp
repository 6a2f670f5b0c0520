// The stiffness behind a search for equilibrium, and its factor: made at some x, without the links that have broken since, and made anew where
// that is no use any more; if it can be, of the cells alone that have turned or stretched meanwhile.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "simulator/moving_box.h"
#include "simulator/steppers/equilibrium.h"

namespace lamella {
namespace {

// Over the largest diagonal. Loose fragments make the stiffness singular; this keeps it regular, and moves nothing: the forces say when
// equilibrium is reached.
constexpr double kLeastShift = 1e-12, kMostShift = 1;
// What goes further in one iteration [mean segments] is held by next to nothing, such as a cell on its last link: it gets this, over the
// largest diagonal, and more where that does not do.
constexpr double kLost = 50, kLoose = 1e-8, kMostLoose = 1e-7;
constexpr double kWithIt = 0.1;  // of that way: what goes so far goes with it
// Over stiffness times extent: positions are rounded, and with them forces.
constexpr double kRounding = 64 * 2.2e-16;
// A wall's segment that has turned or stretched by this part of its length makes the factor one of another cell; up to which part of all
// nodes that are made anew alone.
constexpr double kTurned = 6e-3, kMostTurned = 0.3;
// Iterations of conjugate gradients at most, and what they may leave.
constexpr int kGradients = 60;
constexpr double kSolved = 1e-5;

}  // namespace

// Of 1/2 d (x - s growth - a)^2 all but d by x twice, which stands on the diagonal of each node.
void EquilibriumSolver::couple_anchors(StiffnessSink& sink) const {
  const Sample& sample = model_.sample;
  const Index box = sample.nodes();
  if (anchor_stiffness_.empty() || box == static_cast<Index>(model_.mass.size()) || !free_.moves(box)) return;
  Vec2 own = Vec2::Zero();
  for (Index i = 0; i < box; ++i) {
    const Vec2 share = carried_share(sample, i), coupling = -anchor_stiffness_[i] * share;
    sink.add(box, i, coupling.asDiagonal());
    own -= share.cwiseProduct(coupling);
  }
  sink.add(box, box, own.asDiagonal());
}

void EquilibriumSolver::assemble(const Field& x) {
  const bool changed = stiffness_.assemble([&](StiffnessSink& sink) {
    couple_anchors(sink);  // before all elements: it belongs to none
    model_.add_stiffness(x, sink);
  });
  largest_ = stiffness_.largest_diagonal();
  for (Index i = 0; i < static_cast<Index>(anchor_stiffness_.size()); ++i)
    for (int c = 0; c < 2; ++c)
      if (const int row = free_.row(i, c); row >= 0) stiffness_.add_to_diagonal(row, anchor_stiffness_[i]);
  for (const double d : anchor_stiffness_) largest_ = std::max(largest_, d);
  for (int row = 0; row < free_.size(); ++row)
    if (loose_[row] > 0) stiffness_.add_to_diagonal(row, loose_[row] * largest_);
  if (changed || !analyzed_) factor_.analyze(stiffness_.column_begin(), stiffness_.rows());
  analyzed_ = true;
}

void EquilibriumSolver::refactor(const Field& x) {
  assemble(x);
  const auto [left, right] = std::minmax_element(x.x.begin(), x.x.end());
  const auto [low, high] = std::minmax_element(x.y.begin(), x.y.end());
  rounding_ = kRounding * largest_ * std::max(*right - *left, *high - *low);
  // A shift that was needed a moment ago is tried a little smaller; most of the time none is.
  for (shift_ = std::max(kLeastShift, 1e-3 * shift_); shift_ <= kMostShift; shift_ *= 30) {
    ++cost_.factorizations;
    factored_ = factor_.factorize(stiffness_.values(), shift_ * largest_);
    if (factored_) break;
  }
  factor_x_ = x;
  dropped_.assign(model_.sample.cells(), 0);
  pairs_.clear();
}

/// Cells of which a segment has turned or stretched since they were assembled, or a link has been taken out; and those that own links to such
/// cells, so that all elements of these are of one configuration.
std::vector<std::uint8_t> EquilibriumSolver::turned_cells(const Field& x) const {
  const Sample& sample = model_.sample;
  std::vector<std::uint8_t> turned = dropped_;
  for (Index c = 0; c < sample.cells(); ++c)
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1] && !turned[c]; ++i) {
      const Index j = sample.next(c, i);
      const Vec2 before = factor_x_.at(j) - factor_x_.at(i), now = x.at(j) - x.at(i);
      turned[c] = (now - before).squaredNorm() > kTurned * kTurned * before.squaredNorm();
    }
  std::vector<std::uint8_t> near = turned;
  for (const Link& link : sample.links)
    if (turned[cell_of_[link.b]]) near[cell_of_[link.a]] = 1;
  return near;
}

bool EquilibriumSolver::refactor_turned(const Field& x) {
  if (!is_minimum()) return false;  // the shift may be less now, and is everybody's
  const Sample& sample = model_.sample;
  const std::vector<std::uint8_t> turned = turned_cells(x);
  Index nodes = 0;
  for (Index c = 0; c < sample.cells(); ++c)
    if (turned[c]) nodes += sample.cell_size(c);
  if (nodes == 0 || nodes > kMostTurned * sample.nodes()) return false;
  factored_ = stiffness_.reassemble(turned, [&](StiffnessSink& sink) { model_.add_stiffness(x, sink); });
  if (!factored_) return false;
  ++cost_.partial_factorizations;
  factored_ = factor_.refactorize(stiffness_.values(), shift_ * largest_, stiffness_.changed_rows());
  for (Index c = 0; c < sample.cells(); ++c)
    if (turned[c])
      for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) factor_x_.set(i, x.at(i));
  dropped_.assign(sample.cells(), 0);
  pairs_.clear();
  return factored_;
}

/// Holds what goes too far in this step, and will go less far with the next factor. Returns whether there is any.
bool EquilibriumSolver::holds_lost(const Eigen::VectorXd& step) {
  const double farthest = step.cwiseAbs().maxCoeff();
  if (!(farthest > kLost * length_) || loose_.maxCoeff() >= kMostLoose) return false;
  for (Eigen::Index k = 0; k < step.size(); ++k)
    if (std::abs(step[k]) > kWithIt * farthest) loose_[k] = std::max(kLoose, 100 * loose_[k]);
  factored_ = false;
  return true;
}

// The factor is kept in single precision: where soft and stiff lie far apart, conjugate gradients bring the digits that it lacks.
Eigen::VectorXd EquilibriumSolver::tangent_solution(const Eigen::VectorXd& f) {
  const int n = stiffness_.size();
  const Eigen::Map<const Eigen::SparseMatrix<double>> lower(n, n, static_cast<Eigen::Index>(stiffness_.values().size()),
                                                            stiffness_.column_begin().data(), stiffness_.rows().data(),
                                                            stiffness_.values().data());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n), left = f, z = factor_.solve(left), p = z;
  double energy = left.dot(z);
  ++cost_.solves;
  for (int k = 0; k < kGradients && left.norm() > kSolved * f.norm(); ++k) {
    const Eigen::VectorXd kp = lower.selfadjointView<Eigen::Lower>() * p;
    const double stiff = p.dot(kp);
    if (!(stiff > 0)) break;
    const double alpha = energy / stiff;
    x += alpha * p, left -= alpha * kp;
    z = factor_.solve(left);
    ++cost_.solves;
    const double next = left.dot(z);
    p = z + next / energy * p;
    energy = next;
  }
  return x;
}

void EquilibriumSolver::drop_link(Index link) {
  if (!factored_) return;
  // Its stiffness as the factor holds it.
  std::vector<int> rows;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(14, 14);  // six nodes, and the box where it moves
  struct Local final : StiffnessSink {
    Local(const FreeComponents& f, std::vector<int>& r, Eigen::MatrixXd& m) : free(f), rows(r), k(m) {}
    int place(int row) {
      const auto at = std::find(rows.begin(), rows.end(), row);
      if (at != rows.end()) return static_cast<int>(at - rows.begin());
      rows.push_back(row);
      return static_cast<int>(rows.size()) - 1;
    }
    void add(Index i, Index j, const Eigen::Matrix2d& block) override {
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) {
          const int row = free.row(i, a), column = free.row(j, b);
          if (row >= 0 && column >= 0) k(place(row), place(column)) += block(a, b);
        }
    }
    const FreeComponents& free;
    std::vector<int>& rows;
    Eigen::MatrixXd& k;
  } local(free_, rows, k);
  model_.links->add_stiffness_of(link, factor_x_, local);
  dropped_[cell_of_[model_.sample.links[link].a]] = 1;
  const Eigen::Index n = static_cast<Eigen::Index>(rows.size());
  if (n == 0) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(k.topLeftCorner(n, n));
  const double largest = modes.eigenvalues().cwiseAbs().maxCoeff();
  // What has held the walls apart first, then what has held them together.
  for (const int sign : {+1, -1}) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index m = 0; m < n; ++m)
      if (-sign * modes.eigenvalues()[m] > 1e-10 * largest) kept.push_back(m);
    if (kept.empty()) continue;
    Eigen::MatrixXd c(n, static_cast<Eigen::Index>(kept.size()));
    for (std::size_t m = 0; m < kept.size(); ++m)
      c.col(static_cast<Eigen::Index>(m)) =
          std::sqrt(std::abs(modes.eigenvalues()[kept[m]])) * modes.eigenvectors().col(kept[m]);
    if (!factor_.update(rows, c, sign)) {
      factored_ = false;
      return;
    }
  }
  ++cost_.updates;
}

}  // namespace lamella
