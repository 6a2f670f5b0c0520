#include "simulator/steppers/equilibrium.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "simulator/moving_box.h"

namespace lamella {
namespace {

constexpr int kMostIterations = 400, kMostHalvings = 30;
// So many iterations in a row that go no further than this [mean segments] lead nowhere where links soften: forces jump there.
constexpr int kMostStalls = 3;
constexpr double kStalled = 1e-10;
constexpr std::size_t kPairs = 12;  // of limited-memory BFGS
// A factor is made anew where the rate of convergence so far asks for more iterations than this.
constexpr double kPatience = 7;
// Where an iteration leaves more than this part of the residual, cells that have turned get a new factor.
constexpr double kSlow = 0.1;
// When, and for how long, Newton's method is tried with whole steps.
constexpr std::array<int, 3> kRushes = {25, 100, 250};
constexpr int kRushIterations = 25;
// Of the potential and of a force times a mean segment: by less than this it may rise, as it is rounded.
constexpr double kNoise = 1e-11;
// How often, and how far [mean segments], a rest that is no minimum is left.
constexpr double kLeaveSaddle = 1e-3;
constexpr int kMostSaddles = 20, kInverseIterations = 10;
// No node goes further in one iteration, in mean segments.
constexpr double kFarthest = 0.5;

}  // namespace

EquilibriumSolver::EquilibriumSolver(Model& model, const std::vector<Load>& loads)
    : model_(model),
      shell_terms_(model.shell_terms()),
      free_(model.mass.size(), loads),
      stiffness_(free_, model.sample.cells()),
      scratch_(model.layout),
      dead_(model.mass.size()),
      f_(model.mass.size()),
      cell_of_(cell_of_node(model.sample)),
      dropped_(model.sample.cells(), 0) {
  loose_ = Eigen::VectorXd::Zero(free_.size());
  for (Term* term : model.terms())
    if (std::find(shell_terms_.begin(), shell_terms_.end(), term) == shell_terms_.end()) other_terms_.push_back(term);
  Index count = 0;
  for (double l : model.sample.rest_length)
    if (l > 0) length_ += l, ++count;
  length_ /= std::max<Index>(1, count);
  barriers_ = model.links && model.links->softens();
}

void EquilibriumSolver::forget() {
  stiffness_ = StiffnessMatrix(free_, model_.sample.cells());
  analyzed_ = factored_ = false;
  loose_.setZero(), shift_ = 0, rounding_ = 0;
}

void EquilibriumSolver::set_dead_forces(const Field& f) {
  dead_ = f;
  largest_dead_ = 0;
  for (std::size_t i = 0; i < f.size(); ++i) largest_dead_ = std::max(largest_dead_, f.at(i).squaredNorm());
}

void EquilibriumSolver::set_anchors(std::vector<double> stiffness, Field positions) {
  if (stiffness.size() != anchor_stiffness_.size()) factored_ = false;
  anchor_stiffness_ = std::move(stiffness);
  anchor_ = std::move(positions);
}

// A list of contacts that no longer covers x would be searched for anew in every evaluation.
void EquilibriumSolver::follow_contacts(const Field& x) {
  if (model_.contacts && !model_.contacts->covers(x)) model_.contacts->rebuild(x);
}

void EquilibriumSolver::evaluate(const Field& x, Eigen::VectorXd& free) {
  follow_contacts(x);
  ++cost_.forces;
  f_ = dead_;
  double largest = largest_dead_;
  const Sample& sample = model_.sample;
  for (const CellBlock& block : model_.layout.blocks()) {
    scratch_.load(sample, block, x);
    for (const ShellTerm* term : shell_terms_) term->add_to_block(scratch_, f_);
    scratch_.add_section_forces(sample, f_);
    for (Index c = block.cell_begin; c < block.cell_end; ++c) {
      const Index at = ShellLayout::slot(c, sample.cell_begin[c]) - block.slot_begin;
      for (Index k = at; k < at + sample.cell_size(c); ++k)
        largest = std::max(largest, scratch_.sx[k] * scratch_.sx[k] + scratch_.sy[k] * scratch_.sy[k]);
    }
  }
  for (const Term* term : other_terms_) term->add_force(x, f_);
  scale_ = std::sqrt(largest);
  free = free_.gathered(f_);
}

void EquilibriumSolver::evaluate_all(const Field& x, Eigen::VectorXd& free) {
  evaluate(x, free);
  if (anchor_stiffness_.empty()) return;
  const Sample& sample = model_.sample;
  const bool box = box_moves(sample, x);
  for (std::size_t i = 0; i < anchor_stiffness_.size(); ++i) {
    const Vec2 pull = -anchor_stiffness_[i] * from_anchor(x, i);
    scale_ = std::max(scale_, pull.norm());
    f_.add(i, pull);
    if (box && i < sample.x.size()) f_.add(sample.x.size(), -carried_share(sample, i).cwiseProduct(pull));
  }
  free = free_.gathered(f_);
}

/// x - a of this node; less what the growing box has carried it along by [m].
Vec2 EquilibriumSolver::from_anchor(const Field& x, std::size_t i) const {
  const Sample& sample = model_.sample;
  const Vec2 away = x.at(i) - anchor_.at(i);
  if (!box_moves(sample, x) || i >= sample.x.size()) return away;
  return away - carried_share(sample, i).cwiseProduct(box_growth(sample, x));
}

double EquilibriumSolver::potential(const Field& x) const {
  double sum = model_.energy(x);
  for (std::size_t i = 0; i < x.size(); ++i) sum -= dead_.at(i).dot(x.at(i));
  for (std::size_t i = 0; i < anchor_stiffness_.size(); ++i)
    sum += 0.5 * anchor_stiffness_[i] * from_anchor(x, i).squaredNorm();
  return sum;
}

double EquilibriumSolver::noise(double height) const { return kNoise * (std::abs(height) + scale_ * length_); }

double EquilibriumSolver::measure(const Eigen::VectorXd& f) {
  if (f.size() == 0) return residual_ = 0;
  if (!f.allFinite()) return residual_ = std::numeric_limits<double>::infinity();  // which no maximum tells
  Eigen::Index at = 0;
  const double left = f.cwiseAbs().maxCoeff(&at);
  worst_node_ = free_.node_of(static_cast<int>(at));
  return residual_ = left > rounding_ ? left / (left + scale_) : 0.0;
}

Eigen::VectorXd EquilibriumSolver::direction(const Eigen::VectorXd& f) {
  Eigen::VectorXd q = f;
  std::vector<double> alpha(pairs_.size());
  for (std::size_t k = pairs_.size(); k-- > 0;) {
    alpha[k] = pairs_[k].rho * pairs_[k].s.dot(q);
    q -= alpha[k] * pairs_[k].y;
  }
  ++cost_.solves;
  q = factor_.solve(q);
  for (std::size_t k = 0; k < pairs_.size(); ++k) q += (alpha[k] - pairs_[k].rho * pairs_[k].y.dot(q)) * pairs_[k].s;
  return q;
}

const Eigen::VectorXd& EquilibriumSolver::response(const Field& x, const Eigen::VectorXd& f) {
  static const Eigen::VectorXd nothing;
  if (free_.size() == 0) return nothing;
  if (!factored_) refactor(x);
  ++cost_.solves;
  return factor_.solve(f);
}

double EquilibriumSolver::allowed_share(const Field& x, const Eigen::VectorXd& step) {
  const double share = std::min(1.0, kFarthest * length_ / step.cwiseAbs().maxCoeff());
  if (!model_.contacts) return share;
  Field way(x.size());
  free_.add(step, share, way);
  return share * model_.contacts->safe_share(x, way);
}

// Newton's method as it stands in books: a new tangent and a whole step each time, uphill too. Where something is stiff (a core that keeps its
// area, walls that keep their length while they turn far) every straight step strains it, and a search that may only go downhill creeps;
// here the next step takes that strain back.
bool EquilibriumSolver::rush(Field& x, double tolerance) {
  Eigen::VectorXd f;
  evaluate_all(x, f);
  for (int iteration = 0; iteration < kRushIterations; ++iteration) {
    if (!std::isfinite(measure(f))) return false;
    const bool there = residual_ <= tolerance;
    refactor(x);
    if (!factored_) return false;
    // A minimum, and not just any rest.
    if (there) return is_minimum();
    ++cost_.iterations;
    const Eigen::VectorXd step = tangent_solution(f);
    if (!step.allFinite()) return false;
    free_.add(step, allowed_share(x, step), x);
    evaluate_all(x, f);
  }
  return false;
}

// Whole rows of links that soften may be at rest together where one alone would rather go on: such rest is no minimum. Inverse iteration finds
// the direction of negative curvature.
bool EquilibriumSolver::leave_saddle(Field& x, double height) {
  if (free_.size() == 0) return false;
  shift_ = 0;
  loose_.setZero();
  refactor(x);
  if (!factored_ || is_minimum()) return false;
  Eigen::VectorXd v(free_.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = std::sin(1.0 + 0.7 * static_cast<double>(i * i % 1009));
  for (int k = 0; k < kInverseIterations; ++k) {
    v = factor_.solve(v);
    v /= v.cwiseAbs().maxCoeff();
    ++cost_.solves;
  }
  for (double way = kLeaveSaddle * length_; way > 1e-6 * kLeaveSaddle * length_; way *= 0.1)
    for (const double sign : {1.0, -1.0}) {
      Field there = x;
      free_.add(v, sign * way, there);
      if (potential(there) < height - noise(height)) {
        x = std::move(there);
        return true;
      }
    }
  return false;
}

bool EquilibriumSolver::relax(Field& x, double tolerance) {
  ++cost_.searches;
  pairs_.clear();
  failure_.clear();
  const Field start = x;
  Field there;
  Eigen::VectorXd f, next;
  evaluate_all(x, f);
  double first = measure(f), before = first;
  // Where links soften, a step may end beyond a barrier although the slope along it is small there.
  double height = barriers_ ? potential(x) : 0.0, height_there = 0;
  int since_factor = 0, saddles = 0, stalled = 0;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    if (!std::isfinite(residual_)) break;
    if (residual_ <= tolerance) {
      if (!barriers_ || ++saddles > kMostSaddles || !leave_saddle(x, height)) return true;
      evaluate_all(x, f), measure(f);
      height = potential(x);
      since_factor = 0, first = before = residual_;
    }
    if (std::find(kRushes.begin(), kRushes.end(), iteration) != kRushes.end()) {
      Field rushed = x;
      if (rush(rushed, tolerance) && (!barriers_ || potential(rushed) <= height + noise(height))) {
        x = std::move(rushed);
        return true;
      }
      factored_ = false;
      evaluate_all(x, f);
      measure(f);
    }
    ++cost_.iterations;
    if (!factored_) {
      refactor(x), since_factor = 0, first = before;
      if (!factored_ || measure(f) <= tolerance) break;
    }
    Eigen::VectorXd step = direction(f);
    double slope = step.dot(f);
    if (!(slope > 0)) {
      pairs_.clear();
      step = direction(f);
      slope = step.dot(f);
    }
    if (holds_lost(step)) continue;
    double alpha = allowed_share(x, step);
    bool found = false;
    for (int halving = 0; halving < kMostHalvings; ++halving) {
      there = x;
      free_.add(step, alpha, there);
      evaluate_all(there, next);
      const double slope_there = step.dot(next);
      if (std::isfinite(slope_there) && slope_there >= -0.7 * slope) {
        if (barriers_) height_there = potential(there);
        found = !barriers_ || height_there <= height + noise(height);
        if (found) break;
        alpha *= 0.3;
        continue;
      }
      const double secant = std::isfinite(slope_there) ? slope / (slope - slope_there) : 0.1;
      alpha *= std::clamp(secant, 0.1, 0.7);
    }
    if (!found) {
      failure_ = "the line search found no way down";
      if (since_factor > 0) {
        factored_ = false;
        evaluate_all(x, f);
        continue;
      }
      break;
    }
    stalled = alpha * step.cwiseAbs().maxCoeff() < kStalled * length_ ? stalled + 1 : 0;
    if (barriers_ && stalled > kMostStalls) {
      failure_ = "the search stands still";
      break;
    }
    Pair pair{alpha * step, f - next, 0};
    const double sy = pair.s.dot(pair.y);
    if (sy > 1e-12 * pair.s.norm() * pair.y.norm()) {
      pair.rho = 1 / sy;
      pairs_.push_back(std::move(pair));
      if (pairs_.size() > kPairs) pairs_.pop_front();
    }
    std::swap(x, there);
    std::swap(f, next);
    height = height_there;
    before = residual_;
    measure(f);
    ++since_factor;
    if (residual_ > tolerance && residual_ > kSlow * before && refactor_turned(x)) {
      since_factor = 0, first = residual_;
      continue;
    }
    // The rate so far, and what it promises.
    const double rate = std::log(std::max(first, 1e-300) / std::max(residual_, 1e-300)) / since_factor;
    const double left = std::log(std::max(residual_, 1e-300) / tolerance);
    if (since_factor >= 4 && left > 0 && (rate <= 0 || left / rate > kPatience)) {
      factored_ = false;
      first = residual_;
    }
  }
  if (residual_ <= tolerance) return true;
  if (failure_.empty()) failure_ = fmt::format("no convergence in {} iterations", kMostIterations);
  reached_ = std::exchange(x, start);
  return false;
}

}  // namespace lamella
