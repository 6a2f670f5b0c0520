// Beyond a limit point: where a branch of equilibria turns back, the load follows it. What grows there is prescribed instead of the load: the
// openings of the links that soften, each weighted by how much it opened in the increment before; where none does, the way of all nodes
// along that increment. Damage cannot grow back, so the branch is not confused with that of unloading.
#include <algorithm>
#include <cmath>

#include "simulator/steppers/quasi_static.h"

namespace lamella {
namespace {

constexpr int kMostNewton = 15, kMostFruitless = 10;
constexpr int kMostShortenings = 14;
constexpr double kLongestNewton = 0.5;  // way of a node in one iteration, in mean segments
constexpr double kAhead = 0.05;         // over the last increment: there the next one is asked whether it is stable
constexpr double kUnspent = 1e-3;       // of the largest turnover of an increment: by less damage no branch has led on
constexpr double kPrescribedLeft = 1e-6;  // of what is prescribed

}  // namespace

std::vector<double> QuasiStatic::fronts() const {
  return softens_ ? model_.links->damage_fronts() : std::vector<double>{};
}

/// Keeps what the next increment needs to know of the one that is about to be accepted; `commit` comes in between.
void QuasiStatic::remember() {
  if (!settings_.follow) return;
  behind_ = {x_, time_, fronts(), 0, behind_.spent_at_start, behind_.fruitless};
}

/// c: what grows along the last increment is c . (x - x_).
Eigen::VectorXd QuasiStatic::control() const {
  const FreeComponents& free = solver_.free();
  Field way(x_.size());
  const auto moved = [&](Index i) -> Vec2 { return x_.at(i) - behind_.x.at(i); };
  const std::vector<double> front = fronts();
  bool softened = false;
  for (std::size_t l = 0; l < front.size(); ++l) {
    if (!(front[l] > behind_.front[l])) continue;
    softened = true;
    const Link& link = model_.sample.links[l];
    const Vec2 opened = moved(link.b) - moved(link.a);
    way.add(link.b, opened), way.add(link.a, -opened);
  }
  if (!softened)
    for (Index i = 0; i < static_cast<Index>(x_.size()); ++i) way.set(i, moved(i));
  Eigen::VectorXd c = free.gathered(way);
  const double norm = c.norm();
  return norm > 0 ? Eigen::VectorXd(c / norm) : c;
}

/// Equilibrium at x and `time`, both unknown, where c . (x - x_) = length.
bool QuasiStatic::meet(const Eigen::VectorXd& c, double length, Field& x, double& time) {
  const FreeComponents& free = solver_.free();
  const Eigen::VectorXd from = free.gathered(x_);
  const double probe = 1e-6 * settings_.longest;
  Eigen::VectorXd f, probed, dx;
  for (int iteration = 0; iteration < kMostNewton; ++iteration) {
    prescribe(time, x);
    solver_.evaluate(x, f);
    const double left = length - c.dot(free.gathered(x) - from);
    const double residual = solver_.measure(f);
    if (!std::isfinite(residual)) return false;
    if (residual <= settings_.residual && std::abs(left) <= kPrescribedLeft * length) return true;
    Field moved = x;
    prescribe(time + probe, moved);
    solver_.evaluate(moved, probed);
    prescribe(time, x);
    double dt = 0;
    if (!solver_.bordered_step(x, f, (probed - f) / probe, c, left, dx, dt)) return false;
    const double share = std::min(1.0, kLongestNewton * solver_.mean_segment() / dx.cwiseAbs().maxCoeff());
    free.add(dx, share, x);
    time += share * dt;
  }
  return false;
}

/// Whether damage grows on the way to x.
bool QuasiStatic::softens_at(const Field& x) {
  const CohesiveLinks& links = *model_.links;
  return links.evaluate(x, links.begin(0), links.end(static_cast<Index>(model_.layout.blocks().size()) - 1),
                        link_work_);
}

/// One increment along the branch. Returns false where it cannot be followed any more.
bool QuasiStatic::follow_branch(double end) {
  const bool starts = !following_;
  following_ = false;
  if (behind_.x.size() != x_.size()) return false;
  if (starts && softens_) {
    // A branch that has led back to itself would do so for ever.
    const double spent = works().fracture;
    if (spent - behind_.spent_at_start > kUnspent * largest_turnover_)
      behind_.spent_at_start = spent, behind_.fruitless = 0;
    else if (++behind_.fruitless > kMostFruitless)
      return false;
  }
  const FreeComponents& free = solver_.free();
  const Eigen::VectorXd c = control(), way = free.gathered(x_) - free.gathered(behind_.x);
  const double last = c.size() > 0 ? c.dot(way) : 0.0;
  if (!(last > 0)) return false;
  double length = behind_.length > 0 ? behind_.length : last;
  for (int tries = 0; tries < kMostShortenings; ++tries, length *= 0.4) {
    Field x = x_;
    double time = time_ + length / last * (time_ - behind_.time);
    free.add(way, length / last, x);
    if (!meet(c, length, x, time)) continue;
    if (time < 0 || time > end || std::abs(time - time_) > settings_.longest) continue;
    if (softens_ && time < time_ && !softens_at(x)) continue;  // the way back that nothing breaks on
    if (criterion(x) > settings_.load_tolerance || begins_too_far(x) || leaps(time, x)) continue;
    remember();
    behind_.length = tries == 0 ? 2 * length : length;
    accept(time, std::move(x));
    commit();
    hand_over_softened();
    critical_ = criterion(x_) >= -settings_.load_tolerance;
    Field ahead = x_;
    for (std::size_t i = 0; i < ahead.size(); ++i) ahead.add(i, kAhead * (x_.at(i) - behind_.x.at(i)));
    following_ = time_ < behind_.time || !solver_.holds_at(ahead);
    return true;
  }
  return false;
}

void QuasiStatic::save_behind(ArraySet& restart) const {
  restart.add({"static_behind", "m", "model", 1, rows_from(behind_.x)});  // a box that moves has an entry
  restart.add({"static_branch", "1", "model", 1,
               std::vector<double>{behind_.time, behind_.length, following_ ? 1.0 : 0.0, behind_.spent_at_start,
                                   static_cast<double>(behind_.fruitless)}});
  if (!behind_.front.empty()) restart.add({"static_front", "J^(1/2)", "link", 1, behind_.front});
}

void QuasiStatic::restore_behind(const ArraySet& restart) {
  if (!settings_.follow || !restart.find("static_behind")) return;
  const auto& branch = restart.doubles("static_branch");
  behind_ = {field_from(restart.doubles("static_behind")),
             branch.at(0),
             {},
             branch.at(1),
             branch.at(3),
             static_cast<int>(branch.at(4))};
  if (restart.find("static_front")) behind_.front = restart.doubles("static_front");
  following_ = branch.at(2) != 0;
}

}  // namespace lamella
