// What an increment of load does, and what it sets free: the difference between the work that has gone into the sample and the energy that it
// has gained. On a branch of equilibria it vanishes with the third power of the increment; where the branch ends, or a search has left
// it, it does not.
#include <algorithm>
#include <cmath>

#include "simulator/steppers/quasi_static.h"

namespace lamella {
namespace {

constexpr int kMostLegs = 50;   // of one fall
constexpr double kOnset = 0.1;  // zeta
// Work that may differ from the energy gained, over that of the increment: where links soften, and where nothing does; and over that of the
// largest increment so far.
constexpr double kUnexplained = 4e-3, kUnexplainedStiff = 0.2, kUnseen = 1e-3;

}  // namespace

/// To x, at which the solver has just arrived.
QuasiStatic::StepWork QuasiStatic::work_to(double time, const Field& x) const {
  StepWork work;
  const auto add = [&](double before, double now, double way, double& sum) {
    sum += 0.5 * (before + now) * way;
    work.turnover += 0.5 * (std::abs(before) + std::abs(now)) * std::abs(way);
  };
  const Field& f = solver_.force();
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const Held& h = held_[k];
    add(reaction_[k], -f.at(h.node)[h.component], x.at(h.node)[h.component] - x_.at(h.node)[h.component], work.loads);
  }
  const Field dead = pushes(time);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int c = 0; c < 2; ++c) add(dead_.at(i)[c], dead.at(i)[c], x.at(i)[c] - x_.at(i)[c], work.loads);
  for (std::size_t k = 0; k < model_.pressure_histories.size(); ++k) {
    const PressureHistory& history = model_.pressure_histories[k];
    work.levers.push_back(model_.core->energy_per_pressure(history.cell, x));
    if (!lever_.empty()) add(lever_[k], work.levers[k], history.at(time) - history.at(time_), work.pressure);
  }
  return work;
}

/// What is done on the sample on its way to x beyond what it gains [J].
double QuasiStatic::surplus_at(double time, const Field& x, double& turnover) const {
  const StepWork work = work_to(time, x);
  turnover = work.turnover;
  double gained = model_.energy(x) - model_.energy(x_);  // both under the pressures of that time
  for (std::size_t k = 0; k < lever_.size(); ++k) {
    const PressureHistory& history = model_.pressure_histories[k];
    gained += lever_[k] * (history.at(time) - history.at(time_));
  }
  return work.loads + work.pressure - gained;
}

/// Where a search starts: at the first-order prediction, unless that lies higher than to stay does.
Field QuasiStatic::lower_start(double time, Field predicted) {
  if (!softens_) return predicted;
  Field stays = x_;
  prescribe(time, stays), prescribe(time, predicted);
  return solver_.potential(predicted) <= solver_.potential(stays) ? std::move(predicted) : std::move(stays);
}

/// From x to rest, however far. Where a search ends on its way down, what has softened up to there stays so. Books what is released. Returns
/// whether there is rest.
bool QuasiStatic::fall_to_rest(double time, Field x) {
  ++falls_;
  behind_ = {};
  const std::size_t first = breaks_.size();
  const double before = works_.released;
  const auto arrive = [&](Field at) {
    double turnover = 0;
    works_.released += surplus_at(time, at, turnover);
    accept(time, std::move(at));
  };
  for (int leg = 0; leg < kMostLegs; ++leg) {
    if (try_at(time, x)) {
      arrive(std::move(x));
      bring_to_rest();
      for (std::size_t k = first; k < breaks_.size(); ++k)
        breaks_[k].released = (works_.released - before) / static_cast<double>(breaks_.size() - first);
      return true;
    }
    Field lower = solver_.reached();
    if (!softens_ || !(solver_.potential(lower) < solver_.potential(x))) return false;
    solver_.evaluate(lower, work_);
    arrive(std::move(lower));
    commit();
    hand_over_softened();
    x = x_;
  }
  return false;
}

/// Whether this increment has led to another branch.
bool QuasiStatic::leaps(double time, const Field& x) {
  double turnover = 0;
  const double surplus = surplus_at(time, x, turnover);
  largest_turnover_ = std::max(largest_turnover_, turnover);
  double farthest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) farthest = std::max(farthest, (x.at(i) - x_.at(i)).norm());
  const double unbalanced = settings_.residual * solver_.internal_force() * farthest;
  return std::abs(surplus) >
         (softens_ ? kUnexplained : kUnexplainedStiff) * turnover + kUnseen * largest_turnover_ + unbalanced;
}

/// Whether damage begins in a link only far beyond its criterion: there its mode mix, which stays, would be that of a later moment.
bool QuasiStatic::begins_too_far(const Field& x) const { return softens_ && model_.links->begins_beyond(x, kOnset); }

void QuasiStatic::fall_or_give_up(double time, Field x) {
  if (!fall_to_rest(time, std::move(x))) return give_up("no equilibrium under a little more load", time);
  critical_ = criterion(x_) >= -settings_.load_tolerance;
}

}  // namespace lamella
