#include "simulator/steppers/quasi_static.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/sample/errors.h"
#include "simulator/stop_conditions.h"

namespace lamella {
namespace {

constexpr int kMostTries = 60;        // of one increment
constexpr int kMostSearches = 20000;  // on the way through it
// Less than this part of the longest increment in so many searches is no way through it.
constexpr int kPatientSearches = 500;
constexpr double kLeastProgress = 1e-2;
constexpr double kShortest = 1e-12;  // increment, over the longest: below, a jump of the criterion is a jump
constexpr double kFall = 1e-2;  // increment, over the longest: where it still leads to another branch, the sample falls
constexpr double kWild = 0.1;   // share of a first-order motion that contacts allow: below, it is not used
constexpr double kProbe = 1e-4;  // way of a grip from which its tangent is found, in mean segments

}  // namespace

QuasiStatic::QuasiStatic(Model& model, const std::vector<Load>& loads, const LoadPath& path, Field x, double start_time,
                         const QuasiStaticSettings& settings)
    : model_(model),
      loads_(loads),
      path_(path),
      settings_(settings),
      solver_(model, loads),
      x_(std::move(x)),
      dead_(x_.size()),
      wall_work_(model.layout),
      start_time_(start_time) {
  for (std::size_t l = 0; l < loads.size(); ++l)
    for (Index i : loads[l].nodes)
      for (int c = 0; c < 2; ++c)
        if (loads[l].holds[c]) held_.push_back({i, c, l, x_.at(i)[c]});
  reaction_.assign(held_.size(), 0.0);
  trusted_ = settings.longest;
  softens_ = model.links && model.links->softens();
  if (softens_) works_.fracture = -model.links->dissipated();
  dissipates_ = model.friction > 0 || model.yields();
}

Field QuasiStatic::pushes(double time) const {
  Field dead(x_.size());
  add_pushes(
      loads_, [&](const Load& load) { return path_.force_factor(load, time); }, dead);
  return dead;
}

/// Puts what is held where it is at that time, and sets forces and pressures.
void QuasiStatic::prescribe(double time, Field& x) {
  std::vector<Vec2> way;
  for (const Load& load : loads_) way.push_back(path_.way(load, time));
  for (const Held& h : held_) (h.component == 0 ? x.x : x.y)[h.node] = h.origin + way[h.load][h.component];
  solver_.set_dead_forces(pushes(time));
  for (const PressureHistory& history : model_.pressure_histories)
    if (model_.core->present(history.cell)) model_.core->set_pressure(history.cell, history.at(time));
}

double QuasiStatic::criterion(const Field& x) {
  const double links = model_.links ? model_.links->most_loaded(x, link_work_).zeta : -1.0;
  return model_.rupture ? std::max(links, model_.rupture->most_loaded(x, wall_work_).zeta) : links;
}

// History moves in all terms but brittle links: those break in `fall`, one after the other.
void QuasiStatic::commit() {
  for (Term* term : model_.terms())
    if (term != model_.links.get() || model_.links->softens()) term->commit(x_);
}

/// Links that have lost their last hold in this commit. Returns whether there are any.
bool QuasiStatic::hand_over_softened() {
  if (!softens_) return false;
  const std::int64_t first = static_cast<std::int64_t>(breaks_.size());
  for (const Break& softened : model_.links->breaks()) {
    const std::int64_t place = static_cast<std::int64_t>(breaks_.size()) - first;
    BreakAtRest event;
    event.link = softened;
    model_.hand_over(event.link, x_, start_time_ + time_);
    works_.fracture += event.link.energy;
    record(event, place);
  }
  if (model_.links->breaks().empty()) return false;
  ++avalanches_;
  return true;
}

/// Commits the present configuration, and finds rest anew while links let go in that.
void QuasiStatic::bring_to_rest() {
  commit();
  while (hand_over_softened()) {
    Field x = x_;
    if (!try_at(time_, x)) {
      if (fall_to_rest(time_, x_)) return;
      return give_up("no equilibrium after a break at this load", time_);
    }
    double turnover = 0;
    works_.released += surplus_at(time_, x, turnover);
    accept(time_, std::move(x));
    commit();
  }
}

StaticWorks QuasiStatic::works() const {
  StaticWorks w = works_;
  if (softens_) w.fracture += model_.links->dissipated();
  return w;
}

namespace {

/// Along a direction that repeats, and in which nothing is held or pushed, the whole sample is at rest anywhere, and rounding would carry
/// it off: it stays where it was.
void keep_in_place(const Sample& sample, const std::vector<Load>& loads, const Field& before, Field& x) {
  for (int c = 0; c < 2; ++c) {
    const bool loose = std::none_of(loads.begin(), loads.end(), [&](const Load& load) {
      return !load.box && (load.holds[c] || load.pushes_along[c]);
    });
    if (!sample.periodic[static_cast<std::size_t>(c)] || !loose || x.size() == 0) continue;
    const std::vector<double>& from = c == 0 ? before.x : before.y;
    std::vector<double>& to = c == 0 ? x.x : x.y;
    double way = 0;
    const std::size_t nodes = sample.x.size();
    for (std::size_t i = 0; i < nodes; ++i) way += (to[i] - from[i]) / static_cast<double>(nodes);
    for (std::size_t i = 0; i < nodes; ++i) to[i] -= way;
  }
}

}  // namespace

/// The configuration at which the solver has just arrived becomes the present one.
void QuasiStatic::accept(double time, Field x) {
  keep_in_place(model_.sample, loads_, x_, x);
  StepWork work = work_to(time, x);
  works_.loads += work.loads, works_.pressure += work.pressure;
  lever_ = std::move(work.levers);
  for (std::size_t k = 0; k < held_.size(); ++k) reaction_[k] = -solver_.force().at(held_[k].node)[held_[k].component];
  dead_ = pushes(time);
  x_ = std::move(x);
  time_ = time;
}

/// A sample in two under a dead force is an answer; all else is an error.
void QuasiStatic::give_up(const std::string& what, double time) {
  if (const auto load = unheld_load(model_, loads_)) {
    over_ = fmt::format("nothing holds load '{}' any more", *load);
    critical_ = false;
    return;
  }
  const Index node = solver_.worst_node();
  throw SolverError(fmt::format(
      "t = {:.6g} s (strain {:.6g}): {}: {}; {:.3g} of the largest internal force {:.3g} N is left, most on node {} at "
      "({:.4g}, {:.4g}) m. Nothing may hold the sample any more under its loads, or walls and contacts are too stiff "
      "or too "
      "soft; prescribe motion instead of force, or go on with an explicit stepper",
      start_time_ + time, path_.strain(time), what, solver_.failure(), solver_.residual(), solver_.internal_force(),
      node, x_.x[node], x_.y[node]));
}

void QuasiStatic::settle() {
  Field x = x_;
  prescribe(time_, x);
  dead_ = Field(x.size());
  if (!solver_.relax(x, settings_.residual)) give_up("no equilibrium to start from", time_);
  accept(time_, std::move(x));
  works_ = {.loads = 0, .pressure = 0, .fracture = works_.fracture, .released = 0};
  bring_to_rest();
  critical_ = criterion(x_) >= -settings_.load_tolerance;
}

bool QuasiStatic::try_at(double time, Field& x) {
  prescribe(time, x);
  return solver_.relax(x, settings_.residual);
}

/// Motion of the free components to first order, from the force that a small part of this increment of time adds. What the last search has
/// left is no part of it: in proportion to so small a motion it would be large.
Eigen::VectorXd QuasiStatic::first_motion(double increment) {
  double farthest = 0;
  for (const Load& load : loads_)
    farthest = std::max(farthest, (path_.way(load, time_ + increment) - path_.way(load, time_)).norm());
  const double probe = std::min(1.0, farthest > 0 ? kProbe * solver_.mean_segment() / farthest : 1e-3);
  Field moved = x_;
  Eigen::VectorXd left;
  prescribe(time_, moved);
  solver_.evaluate(moved, left);
  prescribe(time_ + probe * increment, moved);
  solver_.evaluate(moved, work_);
  work_ -= left;
  return solver_.response(x_, work_) / probe;
}

void QuasiStatic::load_towards(double end, const std::function<bool()>& go_on) {
  const double target = end - time_ < 1.001 * settings_.longest ? end : time_ + settings_.longest;
  const double began = time_;
  if (following_ && follow_branch(end)) return;
  int searches = 0;
  double patient_since = time_;
  while (time_ < target && !critical_ && over_.empty() && go_on()) {
    // Where searches have failed, the next one goes no further than twice the last that did not.
    const double h = std::min(target - time_, trusted_);
    const Eigen::VectorXd motion = first_motion(h);
    const auto predicted = [&](double step) {
      Field x = x_;
      solver_.free().add(motion, step / h, x);
      return x;
    };
    // How far it can go before a link reaches its criterion, by that motion.
    const double before = criterion(x_);
    double step = h, low = 0, high = h, z_low = before, z_high = criterion(predicted(h));
    if (z_high > 0) {
      for (int k = 0; k < 40 && high - low > 1e-6 * h; ++k) {
        step = std::clamp(low - z_low * (high - low) / (z_high - z_low), low + 0.05 * (high - low),
                          high - 0.05 * (high - low));
        const double z = criterion(predicted(step));
        if (std::abs(z) < 0.3 * settings_.load_tolerance) break;
        (z > 0 ? high : low) = step, (z > 0 ? z_high : z_low) = z;
      }
    }
    // There, and as far back or on as it takes.
    low = 0, z_low = before, high = 0, z_high = 0;
    bool wild = false;
    const auto start = [&] { return wild ? x_ : lower_start(time_ + step, predicted(step)); };
    Field there = start();
    if (model_.contacts) {
      const auto share_of = [&](Field way) {
        prescribe(time_ + step, way);
        for (std::size_t i = 0; i < way.size(); ++i) way.set(i, way.at(i) - x_.at(i));
        return model_.contacts->safe_share(x_, way);
      };
      double share = share_of(there);
      // Just before a contact closes or opens the tangent may promise far too much: then what is free stays where it is.
      wild = share < kWild;
      if (wild) share = share_of(x_);
      step *= share;
      there = start();
    }
    const double shortest_leap = kFall * settings_.longest, shortest_onset = 1e-2 * shortest_leap;
    // Here the branch ends: the way on is along it, with less load, or down, once it has been told where it ended.
    const auto leave_branch = [&](double time, Field fallen) {
      if (settings_.follow && follow_branch(end)) return;
      if (time_ == began) fall_or_give_up(time, std::move(fallen));
    };
    const auto shorten = [&](double by) {
      step *= by, trusted_ = step, high = 0;
      there = start();
    };
    for (int tries = 0;; ++tries) {
      const bool creeps = ++searches % kPatientSearches == 0 &&
                          time_ - std::exchange(patient_since, time_) < kLeastProgress * settings_.longest;
      if (creeps || searches > kMostSearches)
        return give_up("no equilibrium under a little more load, in many small steps", time_ + step);
      if (!try_at(time_ + step, there)) {
        if ((softens_ || settings_.follow) && step <= shortest_leap) return leave_branch(time_ + step, x_);
        shorten(0.3);
        if (tries > kMostTries || step < kShortest * h)
          return give_up("no equilibrium under a little more load", time_ + step);
        continue;
      }
      const double z = criterion(there);
      const bool at_last = high > 0 && high - low < kShortest * h;
      if (z <= settings_.load_tolerance || at_last || tries > kMostTries) {
        if (step > shortest_onset && tries <= kMostTries && begins_too_far(there)) {
          shorten(0.5);
          continue;
        }
        if (leaps(time_ + step, there)) {
          if (step <= shortest_leap || tries > kMostTries) return leave_branch(time_ + step, std::move(there));
          shorten(0.4);
          continue;
        }
        remember();
        accept(step == h && h == target - time_ ? target : time_ + step, std::move(there));
        trusted_ = std::max(trusted_, 2 * step);
        bring_to_rest();
        critical_ = z >= -settings_.load_tolerance;
        break;
      }
      high = step, z_high = z;
      const double next = std::clamp(low - z_low * (high - low) / (z_high - z_low), low + 0.1 * (high - low),
                                     high - 1e-3 * (high - low));
      for (std::size_t i = 0; i < there.size(); ++i) there.set(i, x_.at(i) + next / step * (there.at(i) - x_.at(i)));
      step = next;
    }
  }
}

// From a link beyond its criterion back to where the most loaded one is at it.
void QuasiStatic::take_back() {
  double beyond = criterion(x_);
  while (beyond > settings_.load_tolerance && time_ > 0) {
    const double h = -std::min(time_, settings_.longest);
    const Eigen::VectorXd motion = first_motion(h);
    double step = h, low = 0, z_low = beyond;  // low: where a link is still beyond
    Field there;
    for (int tries = 0;; ++tries) {
      there = x_;
      solver_.free().add(motion, step / h, there);
      const bool found = try_at(time_ + step, there);
      const double z = found ? criterion(there) : 1.0;
      if (tries > kMostTries) return give_up("no equilibrium under a little less load", time_ + step);
      if (!found) {
        step *= 0.3;
      } else if (z < -settings_.load_tolerance) {  // too far
        step = low + std::clamp(z_low / (z_low - z), 0.05, 0.95) * (step - low);
      } else {
        beyond = z;
        break;
      }
    }
    accept(time_ + step, std::move(there));
    commit();
  }
}

void QuasiStatic::record(BreakAtRest event, std::int64_t place) {
  event.avalanche = avalanches_, event.place = place, event.time = time_;
  breaks_.push_back(event);
}

void QuasiStatic::break_most_loaded(std::int64_t place) {
  const auto link = model_.links ? model_.links->most_loaded(x_, link_work_) : CohesiveLinks::Loaded{};
  const auto bar = model_.rupture ? model_.rupture->most_loaded(x_, wall_work_) : WallRupture::Loaded{};
  if (bar.zeta > link.zeta)
    break_wall(bar, place);
  else
    break_link(link.link, place);
}

// The bar, the hinges at its ends and the core of its cell end; links beside it get another frame, or none; contact loses a segment, and
// ends meet what they ignored. What all of them held, and hold no more, is the energy of the break.
void QuasiStatic::break_wall(const WallRupture::Loaded& bar, std::int64_t place) {
  solver_.drop_factor();
  const double before = model_.energy(x_);
  const double now = start_time_ + time_;
  BreakAtRest event;
  event.link.link = -1;
  event.wall = model_.rupture->broken_at(bar, x_, wall_work_);
  model_.rupture->end(bar.cell, bar.bar, now);
  double of_links = 0;
  std::vector<BreakAtRest> without_frame;
  if (CohesiveLinks* const links = model_.links.get()) {
    for (const Index l : links->without_tangent(model_.rupture->broken())) {
      BreakAtRest cut;
      const double spent = links->dissipated(l);  // by damage: no part of what was held
      cut.link = links->cut(l, x_, x_);
      links->set_break_time(l, now);
      if (model_.contacts) model_.contacts->release(l, x_, cut.link.friction_force);
      of_links += cut.link.energy - spent;
      works_.fracture += spent;
      without_frame.push_back(cut);
    }
    links->follow(model_.rupture->broken());
  }
  if (model_.contacts) model_.contacts->lose(bar.bar, x_);
  const double lost = before - model_.energy(x_);
  potential_ -= lost;
  event.wall.energy = lost + event.wall.pressure_work - of_links;
  works_.fracture += event.wall.energy + of_links;
  works_.pressure += event.wall.pressure_work;
  record(event, place);
  for (const BreakAtRest& cut : without_frame) record(cut, place);
}

void QuasiStatic::break_link(Index link, std::int64_t place) {
  solver_.drop_link(link);
  BreakAtRest event;
  event.link = model_.links->break_at_rest(link, x_);
  model_.hand_over(event.link, x_, start_time_ + time_);
  works_.fracture += event.link.energy;
  potential_ -= event.link.energy;
  record(event, place);
}

void QuasiStatic::fall(const std::function<bool()>& go_on) {
  std::int64_t place = 0;
  behind_ = {};
  potential_ = solver_.potential(x_);
  while (critical_ && go_on()) {
    const std::size_t first = breaks_.size();
    do {
      break_most_loaded(place++);
    } while (settings_.all_at_once && criterion(x_) > 0);
    Field x = x_;
    if (!try_at(time_, x)) {
      // Where the sample has far to go, links break on the way and not at its end.
      x = solver_.reached();
      if (unheld_load(model_, loads_) || !(criterion(x) > 0)) {
        ++avalanches_;
        return give_up("no equilibrium after a break at this load", time_);
      }
      solver_.evaluate(x, work_);
    }
    const double before = potential_;
    accept(time_, std::move(x));
    potential_ = solver_.potential(x_);
    const double released = before - potential_;
    works_.released += released;
    for (std::size_t k = first; k < breaks_.size(); ++k)
      breaks_[k].released = released / static_cast<double>(breaks_.size() - first);
    commit();
    if (dissipates_) potential_ = solver_.potential(x_);
    critical_ = criterion(x_) > 0;
    if (settings_.follow) {
      if (critical_) take_back();
      break;
    }
  }
  ++avalanches_;
}

// How far a search may go at once depends on which contacts are listed.
void QuasiStatic::forget() {
  solver_.forget();
  trusted_ = settings_.longest;
  if (model_.contacts) model_.contacts->rebuild(x_);
}

std::vector<Vec2> QuasiStatic::load_forces() const {
  std::vector<Vec2> sum(loads_.size(), Vec2::Zero());
  for (std::size_t k = 0; k < held_.size(); ++k) sum[held_[k].load][held_[k].component] += reaction_[k];
  for (std::size_t l = 0; l < loads_.size(); ++l)
    if (loads_[l].pushes)
      for (const Vec2& f : loads_[l].force) sum[l] += path_.force_factor(loads_[l], time_) * f;
  return sum;
}

Field QuasiStatic::load_force_on_nodes() const {
  Field f = dead_;
  for (std::size_t k = 0; k < held_.size(); ++k) (held_[k].component == 0 ? f.x : f.y)[held_[k].node] += reaction_[k];
  return f;
}

void QuasiStatic::save(ArraySet& restart) const {
  restart.add({"static_driver", "1", "model", 1,
               std::vector<double>{time_, works_.loads, works_.pressure, works_.fracture, works_.released,
                                   static_cast<double>(avalanches_), critical_ ? 1.0 : 0.0, largest_turnover_,
                                   static_cast<double>(falls_)}});
  std::vector<double> origin;
  for (const Held& h : held_) origin.push_back(h.origin);
  restart.add({"static_origin", "m", "model", 1, std::move(origin)});
  if (behind_.x.size() > 0) save_behind(restart);
  restart.add({"static_reaction", "N", "model", 1, reaction_});
}

void QuasiStatic::restore(const ArraySet& restart) {
  const auto& driver = restart.doubles("static_driver");
  time_ = driver.at(0);
  const auto& origin = restart.doubles("static_origin");
  for (std::size_t k = 0; k < held_.size(); ++k) held_[k].origin = origin.at(k);
  Field x = x_;
  prescribe(time_, x);
  solver_.evaluate(x, work_);
  accept(time_, std::move(x));
  // As they were found: a sample that is kept in its place has moved since, by rounding.
  if (restart.find("static_reaction")) reaction_ = restart.doubles("static_reaction");
  works_ = {driver.at(1), driver.at(2), driver.at(3), driver.at(4)};
  avalanches_ = static_cast<std::int64_t>(driver.at(5));
  critical_ = driver.at(6) != 0;
  largest_turnover_ = driver.at(7), falls_ = static_cast<std::int64_t>(driver.at(8));
  restore_behind(restart);
}

}  // namespace lamella
