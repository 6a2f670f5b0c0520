#include "simulator/steppers/stable_time_step.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "simulator/moving_box.h"

namespace lamella {
namespace {

double largest_eigenvalue(double a, double b, double d) {  // of [[a, b], [b, d]]
  return 0.5 * (a + d) + std::sqrt(0.25 * (a - d) * (a - d) + b * b);
}

double spectral_norm(const Eigen::Matrix2d& m) {
  const double a = m(0, 0) * m(0, 0) + m(1, 0) * m(1, 0), d = m(0, 1) * m(0, 1) + m(1, 1) * m(1, 1);
  return std::sqrt(largest_eigenvalue(a, m(0, 0) * m(0, 1) + m(1, 0) * m(1, 1), d));
}

/// Sums the diagonal blocks and the norms of the others. Elements are not merged: |a| + |b| >= |a + b|.
class RowSums final : public StiffnessSink {
 public:
  explicit RowSums(std::size_t nodes) : a(nodes), b(nodes), d(nodes), off(nodes) {}
  void add(Index i, Index j, const Eigen::Matrix2d& block) override {
    if (i == j)
      a[i] += block(0, 0), b[i] += 0.5 * (block(0, 1) + block(1, 0)), d[i] += block(1, 1);
    else
      off[i] += spectral_norm(block);
  }
  double sum(std::size_t i) const { return std::max(0.0, largest_eigenvalue(a[i], b[i], d[i])) + off[i]; }

  std::vector<double> a, b, d, off;
};

/// Row sum of one node, for the account of what limits the step.
class OneRow final : public StiffnessSink {
 public:
  explicit OneRow(Index node) : node_(node) {}
  void add(Index i, Index j, const Eigen::Matrix2d& block) override {
    if (i != node_) return;
    if (i == j)
      diagonal_ += block;
    else
      off_ += spectral_norm(block);
  }
  double sum() const {
    return std::max(0.0, largest_eigenvalue(diagonal_(0, 0), diagonal_(0, 1), diagonal_(1, 1))) + off_;
  }

 private:
  Index node_;
  Eigen::Matrix2d diagonal_ = Eigen::Matrix2d::Zero();
  double off_ = 0;
};

/// In relative coordinates (moving_box.h): passes blocks of nodes on, and sums what those add to the box's own row and, by node, what couples
/// it to the box. Elements do not change when all of the sample moves, so that a block K_ij couples i to the growth of the box by
/// K_ij d / L, with d the vector from i to j, through the nearest image, and its own stiffness is half of K_ij (d / L)^2.
class BesideBox final : public StiffnessSink {
 public:
  BesideBox(const Sample& sample, bool free, StiffnessSink& nodes)
      : coupling(sample.x.size(), 0.0), sample_(sample), free_(free), nodes_(nodes) {}
  void add(Index i, Index j, const Eigen::Matrix2d& block) override {
    const Index box = sample_.nodes();
    if (i == box || j == box) return;
    nodes_.add(i, j, block);
    if (i == j) return;
    double share = 0;
    for (int c = 0; c < 2; ++c) {
      const double part = (sample_.x[j][c] - sample_.x[i][c]) / sample_.box.size()[c];
      if (free_) share = std::max(share, std::abs(part - std::round(part)));
    }
    const double norm = spectral_norm(block);
    coupling[i] += norm * share;
    own += norm * (share + 0.5 * share * share);
  }

  std::vector<double> coupling;  // row sums [N/m]
  double own = 0;                // of the box's row [N/m]

 private:
  const Sample& sample_;
  bool free_;
  StiffnessSink& nodes_;
};

// A contact that is about to close counts as closed, and a damaged link as whole, as it is again when it is pressed: they cannot surprise
// the step.
void add_stiffness(const Model& model, const Term& term, const Field& x, StiffnessSink& sink) {
  if (&term == model.contacts.get())
    model.contacts->add_possible_stiffness(x, sink);
  else if (&term == model.links.get() && model.links->softens())
    model.links->add_undamaged_stiffness(x, sink);
  else
    term.add_stiffness(x, sink);
}

}  // namespace

StableStep stable_time_step(const Model& model, const Field& x, const std::vector<std::uint8_t>& held) {
  RowSums stiffness(x.size()), damping(model.dashpots || model.contact_damping > 0 ? x.size() : 0);
  const auto terms = model.terms();
  if (box_moves(model.sample, x)) {
    BesideBox beside(model.sample, held.back() == 0, stiffness);
    for (const Term* term : terms) add_stiffness(model, *term, x, beside);
    for (std::size_t i = 0; i < beside.coupling.size(); ++i) stiffness.off[i] += beside.coupling[i];
    stiffness.off.back() = beside.own;
  } else {
    for (const Term* term : terms) add_stiffness(model, *term, x, stiffness);
  }
  if (model.dashpots) model.dashpots->add_damping(x, damping);
  if (model.contact_damping > 0) model.contacts->add_possible_damping(x, damping);

  StableStep best;
  best.dt = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (held[i]) continue;
    const double k = stiffness.sum(i) * model.inverse_mass[i];
    const double c = damping.off.empty() ? 0.0 : damping.sum(i) * model.inverse_mass[i];
    if (k <= 0 && c <= 0) continue;
    const double dt = k > 0 ? (std::sqrt(c * c + 4 * k) - c) / k : 2 / c;
    if (dt < best.dt) best.dt = dt, best.node = static_cast<Index>(i);
  }
  if (!std::isfinite(best.dt)) return best;

  if (best.node == model.sample.nodes()) {
    best.limited_by = "the box";
    return best;
  }
  double total = 0;
  std::vector<double> share;
  for (const Term* term : terms) {
    OneRow row(best.node);
    add_stiffness(model, *term, x, row);
    share.push_back(row.sum());
    total += share.back();
  }
  for (std::size_t k = 0; k < terms.size(); ++k)
    if (share[k] > 0.005 * total)
      best.limited_by +=
          fmt::format("{}{} {:.0f} %", best.limited_by.empty() ? "" : ", ", terms[k]->name(), 100 * share[k] / total);
  return best;
}

}  // namespace lamella
