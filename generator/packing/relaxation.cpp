#include "generator/packing/relaxation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "generator/packing/domain.h"
#include "generator/packing/pair_shares.h"
#include "generator/sample/parallel.h"
#include "generator/sample/team.h"

namespace lamella {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

// Loops over disks and pairs go by blocks that stay in the nearest cache, each a few loops without branches.
constexpr Index kBlock = 256;
using Block = Eigen::Array<double, Eigen::Dynamic, 1, 0, kBlock, 1>;

constexpr double kLargestStep = 0.45;  // of time; stable up to 2 / sqrt(2 x 6 contacts) = 0.57
constexpr double kLongestMove =
    0.2;                       // in mean radii: disks that start on top of each other are not shot across the box
constexpr double kSkin = 0.8;  // in mean radii
constexpr int kFewestShared =
    20000;  // disks; steps of fewer are so short that threads wait for each other longer than they work
constexpr double kTiny = 1e-150;  // added to lengths that are divided by

bool crosses(const StraightWall& wall, const Vec2& from, const Vec2& to) {
  const Vec2 d = wall.b - wall.a;
  const double side = cross(d, from - wall.a), other_side = cross(d, to - wall.a);
  if ((side > 0) == (other_side > 0)) return false;
  return (cross(to - from, wall.a - from) > 0) != (cross(to - from, wall.b - from) > 0);
}

class Fire {
 public:
  Fire(SoftDisks& disks, const RelaxationGoal& goal)
      : disks_(disks),
        goal_(goal),
        n_(static_cast<Index>(disks.x.size())),
        team_(n_ < kFewestShared ? 1 : threads_in_use()),
        id_(n_) {
    std::iota(id_.begin(), id_.end(), 0);
    for (ArrayXd* a : {&x_, &y_, &vx_, &vy_, &fx_, &fy_, &radius_, &mass_}) a->setZero(n_);
    for (Index i = 0; i < n_; ++i) x_[i] = disks.x[i].x(), y_[i] = disks.x[i].y(), radius_[i] = disks.radius[i];
    mean_radius_ = radius_.mean();
    // A large disk among small ones has contacts in proportion to its radius, and needs mass in proportion to be stable.
    mass_ = (radius_ / mean_radius_).max(1.0);
    radius_ *= 1 + goal.clearance;
    list_neighbours();
  }

  Relaxation run(const std::function<void(const Relaxation&)>& progress) {
    double dt = 0.1, mixing = 0.1;
    int downhill = 0;
    Relaxation state;
    for (state.steps = 0; state.steps < goal_.steps; ++state.steps) {
      compute_forces(state);
      if (progress && state.steps % 256 == 0) progress(state);
      if (state.end != RelaxationEnd::kOutOfSteps) break;
      const auto& [power, v2, a2, largest_force2] = motion_;
      if (power > 0) {
        if (++downhill > 5) dt = std::min(1.1 * dt, kLargestStep), mixing *= 0.99;
      } else {
        downhill = 0, dt *= 0.5, mixing = 0.1;
      }
      move(dt, power > 0 ? 1 - mixing : 0, power > 0 && a2 > 0 ? mixing * std::sqrt(v2 / a2) : 0);
    }
    wrap_into_box();
    for (Index i = 0; i < n_; ++i) disks_.x[id_[i]] = {x_[i], y_[i]};
    return state;
  }

  std::vector<double> overlaps() const {
    std::vector<double> largest(n_);
    const auto add = [&](Index i, double overlap) {
      const Index own = i < n_ ? i : list_.ghosts[i - n_].owner;
      double& so_far = largest[id_[own]];
      so_far = std::max(so_far, overlap / radius_[own]);
    };
    for (std::size_t k = 0; k < list_.first.size(); ++k) {
      const std::int32_t i = list_.first[k], j = list_.second[k];
      const Vec2 shift = j < n_ ? Vec2(0, 0) : list_.ghosts[j - n_].shift;
      const Index own = j < n_ ? j : list_.ghosts[j - n_].owner;
      const double overlap = radius_[i] + radius_[own] - (Vec2(x_[own], y_[own]) + shift - Vec2(x_[i], y_[i])).norm();
      add(i, overlap), add(j, overlap);
    }
    for (const auto& [i, w] : list_.at_wall)
      add(i, radius_[i] - distance_to_segment({x_[i], y_[i]}, disks_.walls[w].a, disks_.walls[w].b));
    return largest;
  }

 private:
  /// v = keep v + (steer + dt) a; x += dt v.
  void move(double dt, double keep, double steer) {
    const double limit = kLongestMove * mean_radius_;
    remember_at_walls();
    for_blocks([&](Index begin, Index m) {
      auto x = x_.segment(begin, m), y = y_.segment(begin, m), vx = vx_.segment(begin, m), vy = vy_.segment(begin, m);
      const Block gain = (steer + dt) / mass_.segment(begin, m);
      vx = keep * vx + gain * fx_.segment(begin, m);
      vy = keep * vy + gain * fy_.segment(begin, m);
      const Block slow = (limit / (dt * (vx * vx + vy * vy).sqrt() + kTiny)).min(1.0);
      vx *= slow, vy *= slow;
      x += dt * vx, y += dt * vy;
      farthest2_[begin / kBlock] =
          ((x - x_listed_.segment(begin, m)).square() + (y - y_listed_.segment(begin, m)).square()).maxCoeff();
    });
    stop_at_walls();
    if (*std::max_element(farthest2_.begin(), farthest2_.end()) > std::pow(kSkin * mean_radius_ / 2, 2))
      list_neighbours();
  }

  void remember_at_walls() {
    before_.clear();
    for (const auto& [i, w] : list_.at_wall) before_.emplace_back(x_[i], y_[i]);
  }

  /// Takes back the steps that cross a wall.
  void stop_at_walls() {
    for (std::size_t k = 0; k < list_.at_wall.size(); ++k) {
      const auto [i, w] = list_.at_wall[k];
      if (crosses(disks_.walls[w], before_[k], {x_[i], y_[i]}))
        x_[i] = before_[k].x(), y_[i] = before_[k].y(), vx_[i] = vy_[i] = 0;
    }
  }

  struct Sums {
    double virial = 0, overlap = 0, largest = 0;
    Index contacts = 0;

    void operator+=(const Sums& other) {
      virial += other.virial, overlap += other.overlap, contacts += other.contacts;
      largest = std::max(largest, other.largest);
    }
  };
  struct Motion {
    double power = 0, speed2 = 0, acceleration2 = 0, largest_force2 = 0;
  };

  /// Calls work(begin, count) for all blocks of disks, shared among the threads.
  template <class Work>
  void for_blocks(const Work& work) {
    const Index blocks = (n_ + kBlock - 1) / kBlock, team = team_.size();
    team_.run([&](int thread) {
      for (Index b = blocks * thread / team; b < blocks * (thread + 1) / team; ++b)
        work(b * kBlock, std::min(kBlock, n_ - b * kBlock));
    });
  }

  void compute_forces(Relaxation& state) {
    const auto ghosts = static_cast<Index>(list_.ghosts.size());
    for (Index g = 0; g < ghosts; ++g) {
      const Ghost& ghost = list_.ghosts[g];
      x_[n_ + g] = x_[ghost.owner] + ghost.shift.x();
      y_[n_ + g] = y_[ghost.owner] + ghost.shift.y();
    }
    team_.run([&](int thread) { add_pairs(shares_[thread]); });
    // Summed in the order of the blocks, whoever computed them.
    Sums sums;
    for (const Sums& block : pair_sums_) sums += block;
    for (Index g = 0; g < ghosts; ++g) {
      fx_[list_.ghosts[g].owner] += fx_[n_ + g];
      fy_[list_.ghosts[g].owner] += fy_[n_ + g];
    }
    if (!disks_.periodic[0]) add_sides(x_, fx_, disks_.size.x(), sums);
    if (!disks_.periodic[1]) add_sides(y_, fy_, disks_.size.y(), sums);
    add_walls(sums);
    measure_motion();

    state.pressure = sums.virial / (2 * disks_.area);
    state.overlap = sums.largest;
    // 5 % of the clearance are left for rounding.
    if (sums.largest <= 0.95 * goal_.clearance / (1 + goal_.clearance))
      state.end = RelaxationEnd::kSeparated;
    else if (std::sqrt(motion_.largest_force2) < goal_.balance * sums.overlap / static_cast<double>(sums.contacts))
      state.end = RelaxationEnd::kBalanced;
  }

  void measure_motion() {
    for_blocks([&](Index begin, Index m) {
      const auto vx = vx_.segment(begin, m), vy = vy_.segment(begin, m);
      const auto fx = fx_.segment(begin, m), fy = fy_.segment(begin, m);
      const Block f2 = fx * fx + fy * fy;
      motions_[begin / kBlock] = {(fx * vx + fy * vy).sum(), (vx * vx + vy * vy).sum(),
                                  (f2 / mass_.segment(begin, m).square()).sum(), f2.maxCoeff()};
    });
    motion_ = {};
    for (const Motion& block : motions_) {
      motion_.power += block.power, motion_.speed2 += block.speed2, motion_.acceleration2 += block.acceleration2;
      motion_.largest_force2 = std::max(motion_.largest_force2, block.largest_force2);
    }
  }

  /// Forces of the share's disks, from nothing.
  void add_pairs(const PairShare& share) {
    for (ArrayXd* f : {&fx_, &fy_}) {
      f->segment(share.disk_begin, share.disk_end - share.disk_begin).setZero();
      f->segment(share.ghost_begin, share.ghost_end - share.ghost_begin).setZero();
    }
    Block dx(kBlock), dy(kBlock), reach(kBlock), distance, overlap, factor;
    for (const PairShare::Block& block : share.blocks) {
      const Index m = block.count;
      const std::int32_t *first = list_.first.data() + block.begin, *second = list_.second.data() + block.begin;
      dx.resize(m), dy.resize(m), reach.resize(m);
      for (Index k = 0; k < m; ++k) {
        const std::int32_t i = first[k], j = second[k];
        dx[k] = x_[j] - x_[i], dy[k] = y_[j] - y_[i], reach[k] = radius_[i] + radius_[j];
      }
      distance = (dx * dx + dy * dy).sqrt();
      overlap = (reach - distance).max(0.0);
      factor = overlap / (distance + kTiny);
      dx *= factor, dy *= factor;
      if (block.first)
        pair_sums_[block.begin / kBlock] = {(overlap * distance).sum(), overlap.sum(), (overlap / reach).maxCoeff(),
                                            (overlap > 0).count()};
      for (Index k = 0; k < m; ++k) {
        const std::int32_t i = first[k], j = second[k];
        if (block.whole || share.owns(i)) fx_[i] -= dx[k], fy_[i] -= dy[k];
        if (block.whole || share.owns(j)) fx_[j] += dx[k], fy_[j] += dy[k];
      }
    }
  }

  /// The two sides of the box that bound one coordinate.
  void add_sides(const ArrayXd& x, ArrayXd& f, double length, Sums& sums) {
    for_blocks([&](Index begin, Index m) {
      const auto r = radius_.segment(begin, m);
      const auto at = x.segment(begin, m);
      const Block low = (r - at).max(0.0), high = (at + r - length).max(0.0), both = low + high;
      f.segment(begin, m) += low - high;
      side_sums_[begin / kBlock] = {(both * r).sum(), both.sum(), (both / r).maxCoeff(), (both > 0).count()};
    });
    for (const Sums& block : side_sums_) sums += block;
  }

  void add_walls(Sums& sums) {
    for (const auto& [i, w] : list_.at_wall) {
      const StraightWall& wall = disks_.walls[w];
      const Vec2 along = wall.b - wall.a, from = Vec2(x_[i], y_[i]) - wall.a;
      const Vec2 d = from - std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
      const double distance = d.norm(), overlap = radius_[i] - distance;
      if (overlap <= 0 || distance == 0) continue;
      fx_[i] += overlap / distance * d.x(), fy_[i] += overlap / distance * d.y();
      sums.virial += overlap * radius_[i];
      sums.overlap += overlap;
      sums.largest = std::max(sums.largest, overlap / radius_[i]);
      ++sums.contacts;
    }
  }

  void wrap_into_box() {
    if (disks_.periodic[0]) x_ -= (x_ / disks_.size.x()).floor() * disks_.size.x();
    if (disks_.periodic[1]) y_ -= (y_ / disks_.size.y()).floor() * disks_.size.y();
  }

  /// Pairs that can touch before one of their disks has moved by half the skin.
  void list_neighbours() {
    wrap_into_box();
    const double skin = kSkin * mean_radius_;
    NeighbourGrid grid(disks_.size, disks_.periodic, 2 * mean_radius_ + skin);
    const DiskArrays arrays{x_, y_, radius_, n_};
    const std::vector<std::int32_t> place = grid.order(arrays);
    const auto permute = [&](auto& values) {
      auto sorted = values;
      for (Index i = 0; i < n_; ++i) sorted[place[i]] = values[i];
      values = std::move(sorted);
    };
    permute(id_);
    for (ArrayXd* a : {&x_, &y_, &vx_, &vy_, &fx_, &fy_, &radius_, &mass_}) permute(*a);
    x_listed_ = x_.head(n_), y_listed_ = y_.head(n_);
    list_ = grid.list(arrays, disks_.walls, skin);
    const auto ghosts = static_cast<Index>(list_.ghosts.size());
    for (ArrayXd* a : {&x_, &y_, &fx_, &fy_, &radius_}) a->conservativeResize(n_ + ghosts);
    for (Index g = 0; g < ghosts; ++g) radius_[n_ + g] = radius_[list_.ghosts[g].owner];
    shares_ = share_pairs(list_, static_cast<std::int32_t>(n_), team_.size(), kBlock);
    pair_sums_.resize((list_.first.size() + kBlock - 1) / kBlock);
    const Index blocks = (n_ + kBlock - 1) / kBlock;
    side_sums_.resize(blocks), motions_.resize(blocks), farthest2_.resize(blocks);
  }

  SoftDisks& disks_;
  const RelaxationGoal& goal_;
  Index n_;
  Team team_;
  std::vector<std::int32_t> id_;                       // of the caller
  ArrayXd x_, y_, vx_, vy_, fx_, fy_, radius_, mass_;  // where pairs look things up, ghosts follow the disks
  ArrayXd x_listed_, y_listed_;
  double mean_radius_ = 0;
  Neighbours list_;
  std::vector<PairShare> shares_;  // per thread
  std::vector<Sums> pair_sums_;    // per block of pairs
  std::vector<Sums> side_sums_;    // per block of disks
  std::vector<Motion> motions_;
  std::vector<double> farthest2_;  // that a disk has moved since they were listed
  Motion motion_;                  // of all
  std::vector<Vec2> before_;       // where the disks of list_.at_wall were before a step
};

}  // namespace

Relaxation relax(SoftDisks& disks, const RelaxationGoal& goal, const std::function<void(const Relaxation&)>& progress) {
  return Fire(disks, goal).run(progress);
}

std::vector<double> overlaps(SoftDisks disks) { return Fire(disks, {}).overlaps(); }

}  // namespace lamella
