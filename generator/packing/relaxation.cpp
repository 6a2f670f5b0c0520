#include "generator/packing/relaxation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace lamella {
namespace {

/// A disk that may come to touch, at an image of the periodic box.
struct Neighbour {
  std::int32_t disk;
  std::int16_t image_x, image_y;
};

/// Uniform grid over the box; the disks of cell c are [begin[c], begin[c + 1]) once sorted.
struct Grid {
  Vec2 size;
  int columns = 1, rows = 1;
  std::vector<std::int32_t> begin;

  Grid(const Vec2& box, double cell)
      : size(box),
        columns(count(box.x(), cell)),
        rows(count(box.y(), cell)),
        begin(static_cast<std::size_t>(columns) * rows + 1) {}
  int column(double x) const { return static_cast<int>(std::floor(x / size.x() * columns)); }
  int row(double y) const { return static_cast<int>(std::floor(y / size.y() * rows)); }
  std::size_t cell(const Vec2& p) const {
    return static_cast<std::size_t>(std::clamp(row(p.y()), 0, rows - 1)) * columns +
           std::clamp(column(p.x()), 0, columns - 1);
  }

 private:
  static int count(double length, double cell) { return static_cast<int>(std::clamp(length / cell, 1.0, 8192.0)); }
};

class Fire {
 public:
  Fire(SoftDisks& disks, const RelaxationGoal& goal)
      : disks_(disks),
        goal_(goal),
        n_(disks.x.size()),
        id_(n_),
        x_(disks.x),
        x_listed_(n_),
        v_(n_, Vec2::Zero()),
        f_(n_, Vec2::Zero()),
        radius_(disks.radius),
        mass_(n_),
        mean_radius_(std::accumulate(radius_.begin(), radius_.end(), 0.0) / static_cast<double>(n_)),
        skin_(0.3 * mean_radius_) {
    std::iota(id_.begin(), id_.end(), 0);
    for (std::size_t i = 0; i < n_; ++i) {
      // A large disk among small ones has contacts in proportion to its radius, and needs mass in proportion to be stable.
      mass_[i] = std::max(1.0, radius_[i] / mean_radius_);
      radius_[i] *= 1 + 1.5 * goal.clearance;  // half the clearance more than asked: reached in finite time
    }
    list_neighbours();
  }

  Relaxation run(const std::function<void(const Relaxation&)>& progress) {
    constexpr double kLargestStep = 0.4;  // stable up to 2 / sqrt(2 x 6 contacts) = 0.57
    double dt = 0.1, mixing = 0.1;
    int downhill = 0;
    Relaxation state;
    for (state.steps = 0; state.steps < goal_.steps; ++state.steps) {
      compute_forces(state);
      if (progress && state.steps % 256 == 0) progress(state);
      if (state.end != RelaxationEnd::kOutOfSteps) break;

      double power = 0, v2 = 0, a2 = 0;
      for (std::size_t i = 0; i < n_; ++i) {
        power += f_[i].dot(v_[i]);
        v2 += v_[i].squaredNorm();
        a2 += f_[i].squaredNorm() / (mass_[i] * mass_[i]);
      }
      if (power > 0) {
        if (++downhill > 5) dt = std::min(1.1 * dt, kLargestStep), mixing *= 0.99;
      } else {
        downhill = 0, dt *= 0.5, mixing = 0.1;
      }
      const double keep = power > 0 ? 1 - mixing : 0, steer = power > 0 && a2 > 0 ? mixing * std::sqrt(v2 / a2) : 0;
      move(dt, keep, steer);
    }
    wrap_into_box();
    for (std::size_t i = 0; i < n_; ++i) disks_.x[id_[i]] = x_[i];
    return state;
  }

 private:
  void move(double dt, double keep, double steer) {
    const double limit = 0.2 * mean_radius_;  // disks that start on top of each other are not shot across the box
    double farthest2 = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      const Vec2 a = f_[i] / mass_[i];
      v_[i] = keep * v_[i] + (steer + dt) * a;
      Vec2 step = dt * v_[i];
      const double length2 = step.squaredNorm();
      if (length2 > limit * limit) {
        const double scale = limit / std::sqrt(length2);
        step *= scale, v_[i] *= scale;
      }
      x_[i] += step;
      farthest2 = std::max(farthest2, (x_[i] - x_listed_[i]).squaredNorm());
    }
    if (farthest2 > skin_ * skin_ / 4) list_neighbours();
  }

  void compute_forces(Relaxation& state) {
    for (Vec2& f : f_) f.setZero();
    const double width = disks_.size.x(), height = disks_.size.y();
    double virial = 0, sum = 0, largest = 0;
    long contacts = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      const Vec2 xi = x_[i];
      const double ri = radius_[i];
      Vec2 fi = Vec2::Zero();
      for (auto k = list_begin_[i]; k < list_begin_[i + 1]; ++k) {
        const Neighbour& neighbour = list_[k];
        const Vec2 d = x_[neighbour.disk] + Vec2(neighbour.image_x * width, neighbour.image_y * height) - xi;
        const double reach = ri + radius_[neighbour.disk], d2 = d.squaredNorm();
        if (d2 >= reach * reach || d2 == 0) continue;
        const double distance = std::sqrt(d2), overlap = reach - distance;
        const Vec2 f = (overlap / distance) * d;
        fi -= f;
        f_[neighbour.disk] += f;
        virial += overlap * distance;
        sum += overlap;
        ++contacts;
        largest = std::max(largest, overlap / reach);
      }
      f_[i] += fi;
    }
    for (int axis = 0; axis < 2; ++axis) {
      if (!disks_.periodic[axis]) {
        for (std::size_t i = 0; i < n_; ++i) {
          const double low = radius_[i] - x_[i][axis], high = x_[i][axis] + radius_[i] - disks_.size[axis];
          for (const auto& [overlap, direction] : {std::pair{low, 1.0}, std::pair{high, -1.0}}) {
            if (overlap <= 0) continue;
            f_[i][axis] += overlap * direction;
            virial += overlap * radius_[i];
            sum += overlap;
            ++contacts;
            largest = std::max(largest, overlap / radius_[i]);
          }
        }
      }
    }
    state.pressure = virial / (2 * width * height);
    state.overlap = largest;
    double f2 = 0;
    for (const Vec2& f : f_) f2 = std::max(f2, f.squaredNorm());
    // 1 + 1.5 c less a third of that excess is 1 + c; walls the same, by the radius alone.
    if (largest <= 0.4 * goal_.clearance)
      state.end = RelaxationEnd::kSeparated;
    else if (std::sqrt(f2) < goal_.balance * sum / static_cast<double>(contacts))
      state.end = RelaxationEnd::kBalanced;
  }

  void wrap_into_box() {
    for (const int axis : {0, 1})
      if (disks_.periodic[axis])
        for (Vec2& x : x_) x[axis] -= std::floor(x[axis] / disks_.size[axis]) * disks_.size[axis];
  }

  /// Pairs that can touch before one of them has moved by half the skin. Disks are put in the order of the grid's cells on
  /// the way, so that neighbours are near in memory.
  void list_neighbours() {
    wrap_into_box();
    Grid grid(disks_.size, 2 * mean_radius_ + skin_);
    sort_by_cell(grid);
    x_listed_ = x_;
    list_.clear();
    list_begin_.assign(1, 0);
    for (std::size_t i = 0; i < n_; ++i) {
      // Every pair is found from its larger disk, so that small disks need not look as far as the largest reaches.
      const Vec2 far = Vec2::Constant(2 * radius_[i] + skin_);
      const Vec2 lo = x_[i] - far, hi = x_[i] + far;
      for (int row = grid.row(lo.y()); row <= grid.row(hi.y()); ++row)
        for (int column = grid.column(lo.x()); column <= grid.column(hi.x()); ++column)
          add_neighbours(grid, i, column, row);
      list_begin_.push_back(list_.size());
    }
  }

  void add_neighbours(const Grid& grid, std::size_t i, int column, int row) {
    const auto wrap = [](int at, int count) { return at >= 0 ? at / count : -((count - 1 - at) / count); };
    const int image_x = wrap(column, grid.columns), image_y = wrap(row, grid.rows);
    if ((image_x != 0 && !disks_.periodic[0]) || (image_y != 0 && !disks_.periodic[1])) return;
    const std::size_t cell =
        static_cast<std::size_t>(row - image_y * grid.rows) * grid.columns + (column - image_x * grid.columns);
    const Vec2 from = x_[i] - Vec2(image_x * disks_.size.x(), image_y * disks_.size.y());
    for (auto j = static_cast<std::size_t>(grid.begin[cell]); j < static_cast<std::size_t>(grid.begin[cell + 1]); ++j) {
      if (j == i || radius_[j] > radius_[i] || (radius_[j] == radius_[i] && j > i)) continue;
      const double reach = radius_[i] + radius_[j] + skin_;
      if ((x_[j] - from).squaredNorm() < reach * reach)
        list_.push_back(
            {static_cast<std::int32_t>(j), static_cast<std::int16_t>(image_x), static_cast<std::int16_t>(image_y)});
    }
  }

  void sort_by_cell(Grid& grid) {
    std::vector<std::size_t> cell(n_);
    for (std::size_t i = 0; i < n_; ++i) ++grid.begin[(cell[i] = grid.cell(x_[i])) + 1];
    std::partial_sum(grid.begin.begin(), grid.begin.end(), grid.begin.begin());
    std::vector<std::int32_t> next(grid.begin.begin(), grid.begin.end() - 1);
    std::vector<std::int32_t> place(n_);
    for (std::size_t i = 0; i < n_; ++i) place[i] = next[cell[i]]++;
    const auto permute = [&](auto& values) {
      auto sorted = values;
      for (std::size_t i = 0; i < n_; ++i) sorted[place[i]] = values[i];
      values = std::move(sorted);
    };
    permute(id_), permute(x_), permute(v_), permute(radius_), permute(mass_);
  }

  SoftDisks& disks_;
  const RelaxationGoal& goal_;
  std::size_t n_;
  std::vector<std::int32_t> id_;  // of the caller
  std::vector<Vec2> x_, x_listed_, v_, f_;
  std::vector<double> radius_, mass_;
  double mean_radius_, skin_;
  std::vector<Neighbour> list_;  // of disk i: [list_begin_[i], list_begin_[i + 1])
  std::vector<std::size_t> list_begin_;
};

}  // namespace

Relaxation relax(SoftDisks& disks, const RelaxationGoal& goal, const std::function<void(const Relaxation&)>& progress) {
  return Fire(disks, goal).run(progress);
}

}  // namespace lamella
