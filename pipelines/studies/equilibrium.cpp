#include "pipelines/studies/equilibrium.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "generator/sample/errors.h"
#include "simulator/assembly.h"

namespace lamella {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr int kIterations = 1000, kHalvings = 40, kLoadSteps = 100;
// Corrections over the extent of the sample. Below the first a solution is as good as positions are rounded; ill-conditioned ones stop falling
// earlier, and are accepted below the second.
constexpr double kRounding = 1e-14, kStalled = 1e-9;
// Of zeta, likewise.
constexpr double kCriterion = 1e-12, kCriterionStalled = 1e-5;

double& component(Field& f, int k) { return k % 2 == 0 ? f.x[k / 2] : f.y[k / 2]; }

/// A model under dead loads, seen by its free components alone.
class FreeSystem {
 public:
  FreeSystem(const Model& model, const std::vector<Load>& loads, double factor, std::size_t nodes)
      : model_(model), terms_(model.terms()), dead_(nodes), free_(nodes, loads) {
    add_pushes(
        loads, [&](const Load&) { return factor; }, dead_);
  }
  int size() const { return free_.size(); }

  double potential(const Field& x) const {
    double sum = model_.energy(x);
    for (std::size_t i = 0; i < x.size(); ++i) sum -= dead_.at(i).dot(x.at(i));
    return sum;
  }
  Eigen::VectorXd force(const Field& x) const {
    Field f = dead_;
    for (const Term* term : terms_) term->add_force(x, f);
    return free_.gathered(f);
  }
  Sparse stiffness(const Field& x) const { return assembled_stiffness(model_, free_, x); }
  Field moved(Field x, const Eigen::VectorXd& by) const {
    free_.add(by, 1, x);
    return x;
  }

 private:
  const Model& model_;
  std::vector<Term*> terms_;
  Field dead_;
  FreeComponents free_;
};

/// Solves K u = f, with K shifted until it is positive definite: then u points downhill.
Eigen::VectorXd downhill(const Sparse& k, const Eigen::VectorXd& f) {
  Eigen::SimplicialLDLT<Sparse> factor;
  factor.analyzePattern(k);
  double largest = 0;
  for (int d = 0; d < k.rows(); ++d) largest = std::max(largest, std::abs(k.coeff(d, d)));
  Sparse identity(k.rows(), k.cols());
  identity.setIdentity();
  for (double shift = 0; shift <= 1; shift = std::max(10 * shift, 1e-12)) {
    factor.factorize(shift > 0 ? Sparse(k + shift * largest * identity) : k);
    if (factor.info() == Eigen::Success && (factor.vectorD().array() > 0).all()) return factor.solve(f);
  }
  return f / std::max(largest, 1e-300);
}

double extent(const Field& x) {
  const auto [left, right] = std::minmax_element(x.x.begin(), x.x.end());
  const auto [low, high] = std::minmax_element(x.y.begin(), x.y.end());
  return std::max(*right - *left, *high - *low);
}

/// Largest zeta + 1 of the intact links, and whose it is.
std::pair<double, Index> most_loaded(const Model& model, const Field& x) {
  ArraySet arrays;
  model.links->add_output(x, arrays);
  const auto& zeta = arrays.doubles("link_zeta");
  const auto& intact = arrays.ints("link_intact");
  std::pair<double, Index> most{-1, -1};
  for (std::size_t l = 0; l < zeta.size(); ++l)
    if (intact[l] && zeta[l] + 1 > most.first) most = {zeta[l] + 1, static_cast<Index>(l)};
  return most;
}

}  // namespace

Equilibrium find_equilibrium(const Model& model, const std::vector<Load>& loads, double factor, Field x) {
  const FreeSystem system(model, loads, factor, x.size());
  const double size = extent(x);
  double before = 1e300;
  Eigen::VectorXd f = system.force(x);
  for (int iteration = 1; iteration <= kIterations && system.size() > 0; ++iteration) {
    Eigen::VectorXd step = downhill(system.stiffness(x), f);
    if (!step.allFinite()) break;
    const double correction = step.cwiseAbs().maxCoeff() / size;
    const double potential = system.potential(x);
    // Near the minimum the potential is lost in rounding; then a smaller force tells that a step is good.
    for (int halving = 0; halving < kHalvings; ++halving, step *= 0.5) {
      const Field there = system.moved(x, step);
      const Eigen::VectorXd left = system.force(there);
      if (left.norm() < f.norm() || system.potential(there) < potential) break;
    }
    x = system.moved(std::move(x), step);
    f = system.force(x);
    const bool stalled = correction < kStalled && correction > 0.2 * before;
    if (correction < kRounding || stalled) return {std::move(x), f.cwiseAbs().maxCoeff(), iteration};
    before = correction;
  }
  if (system.size() == 0) return {std::move(x), 0, 0};
  throw SolverError(
      fmt::format("no equilibrium found: the last correction was {:.3g} of the sample's extent, and a force of {:.3g} "
                  "N is left; hold the sample, load it less, or begin nearer",
                  before, f.cwiseAbs().maxCoeff()));
}

std::vector<LinkForce> link_forces(const Model& model, const Field& x) {
  ArraySet arrays;
  model.links->add_output(x, arrays);
  const auto& force = arrays.doubles("link_force");
  std::vector<LinkForce> out(force.size() / 2);
  for (std::size_t l = 0; l < out.size(); ++l) out[l] = {force[2 * l], force[2 * l + 1]};
  return out;
}

StaticBreak find_first_break(const Model& model, const std::vector<Load>& loads, const Field& rest, double guess) {
  if (!model.links || !model.links->breakable()) throw SolverError("no first break: the scene has no links that break");
  Field x = rest;
  double factor = guess, last_factor = 0, last = -1;  // of the criterion: -1 without load
  for (int iteration = 0; iteration < kLoadSteps; ++iteration) {
    // From the last solution, stretched in proportion.
    const double grown = last_factor > 0 ? factor / last_factor : 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) x.set(i, rest.at(i) + grown * (x.at(i) - rest.at(i)));
    for (const Load& load : loads)
      for (Index i : load.nodes)
        for (int c = 0; c < 2; ++c)
          if (load.holds[c]) component(x, 2 * i + c) = rest.at(i)[c] + factor * load.velocity[c];
    x = find_equilibrium(model, loads, factor, std::move(x)).x;
    const auto [criterion, link] = most_loaded(model, x);
    const double off = criterion - 1;
    const bool stalled = std::abs(off) < kCriterionStalled && std::abs(off) > 0.2 * std::abs(last);
    if (std::abs(off) < kCriterion || stalled) return {factor, link, link_forces(model, x)[link], std::move(x)};
    // Secant; no further than twice the load at once, so that a link which the load does not reach is noticed.
    const double slope = (off - last) / (factor - last_factor);
    last_factor = factor, last = off;
    const double next = slope > 0 ? factor - off / slope : 2 * factor;
    factor = std::clamp(next, 0.1 * factor, 2 * factor);
  }
  throw SolverError(fmt::format("no first break found up to {:.3g} times the loads", factor));
}

}  // namespace lamella
