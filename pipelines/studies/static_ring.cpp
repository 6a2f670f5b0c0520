#include "pipelines/studies/static_ring.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSubstep = 0.0025;  // of strain: short enough for Newton's method to follow every node's touching
constexpr int kNewton = 60, kRounds = 100;

/// One quarter of the ring, nodes 0 (on the x axis) to q (on the y axis); the rest are its mirror images. Unknowns: x and y of the
/// quarter's nodes, then the pressure, so that a core of any stiffness, up to an incompressible one, is equally well conditioned.
class QuarterRing {
 public:
  explicit QuarterRing(const StaticRingModel& model)
      : model_(model), q_(model.nodes / 4), image_(model.nodes), mirror_(model.nodes) {
    const double step = 2 * std::numbers::pi / model.nodes;
    l0_ = 2 * std::sin(step / 2), theta0_ = step, area0_ = model.nodes * std::sin(step) / 2;
    u_ = VectorXd::Zero(2 * (q_ + 1) + 1);
    for (int k = 0; k < model.nodes; ++k) {
      const int turn = k % (2 * q_);
      image_[k] = turn <= q_ ? turn : 2 * q_ - turn;
      mirror_[k] = {k <= q_ || k >= 3 * q_ ? 1.0 : -1.0, k <= 2 * q_ ? 1.0 : -1.0};
    }
    for (int k = 0; k <= q_; ++k) u_.segment<2>(2 * k) = Vec2(std::cos(step * k), std::sin(step * k));
    touches_.assign(static_cast<std::size_t>(q_) + 1, 0);
    touches_.back() = 1;
  }

  void squeeze(double strain) {
    const double wall = 1 - strain;
    for (int round = 0; round < kRounds; ++round) {
      for (int k = 0; k <= q_; ++k)
        if (touches_[k]) u_(2 * k + 1) = wall;
      relax(strain);
      const VectorXd r = residual(u_);
      // the node that is furthest beyond the plate joins, else the one that is pulled most leaves; one at a time
      int join = -1, leave = -1;
      for (int k = 0; k <= q_; ++k) {
        const double beyond = u_(2 * k + 1) - wall, pull = r(2 * k + 1);
        if (!touches_[k] && beyond > 1e-12 && (join < 0 || beyond > u_(2 * join + 1) - wall)) join = k;
        if (touches_[k] && pull > 1e-8 && (leave < 0 || pull > r(2 * leave + 1))) leave = k;
      }
      if (join >= 0)
        touches_[join] = 1;
      else if (leave >= 0)
        touches_[leave] = 0;
      else
        return;
    }
    throw SolverError(fmt::format("static ring: no set of touching nodes at strain {}", strain));
  }

  StaticRing state(double strain) const {
    StaticRing s;
    s.strain = strain;
    const VectorXd r = residual(u_);
    const std::vector<Vec2> x = nodes(u_);
    s.x = x;
    s.pressure = u_(u_.size() - 1);
    s.width = u_(0);
    s.push.assign(x.size(), 0.0);
    for (int k = 0; k < model_.nodes; ++k) {
      const int i = image_[k];
      if (!touches_[i]) continue;
      const double push = -r(2 * i + 1) / (i == q_ ? 2 : 4);  // the unknown moves that many nodes
      s.push[k] = push;
      s.force += push / 2, s.moment += push / 2 * std::abs(x[k].x());
    }
    s.moment /= s.force;
    double area = 0;
    for (int k = 0; k < model_.nodes; ++k) {
      const Vec2 &a = at(x, k - 1), &b = x[k], &c = at(x, k + 1);
      const double stretch = (c - b).norm() - l0_, turn = turning(a, b, c) - theta0_;
      s.bars += model_.axial / l0_ * stretch * stretch / 2, s.hinges += turn * turn / l0_ / 2;
      area += (b.x() * c.y() - b.y() * c.x()) / 2;
    }
    s.area = area / area0_;
    s.shrinkage = model_.core > 0 ? s.pressure / model_.core : 1 - s.area;
    return s;
  }

 private:
  const Vec2& at(const std::vector<Vec2>& x, int k) const {
    return x[static_cast<std::size_t>((k + model_.nodes) % model_.nodes)];
  }
  static double turning(const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 e = b - a, f = c - b;
    return std::atan2(e.x() * f.y() - e.y() * f.x(), e.dot(f));
  }
  std::vector<Vec2> nodes(const VectorXd& u) const {
    std::vector<Vec2> x;
    for (int k = 0; k < model_.nodes; ++k)
      x.emplace_back(mirror_[k].cwiseProduct(Vec2(u.segment<2>(2 * static_cast<Eigen::Index>(image_[k])))));
    return x;
  }

  /// Gradient of W_bars + W_hinges - p (A - A0) in the quarter's positions; last, what ties p to the area.
  VectorXd residual(const VectorXd& u) const {
    const std::vector<Vec2> x = nodes(u);
    const double p = u(u.size() - 1);
    std::vector<Vec2> gradient(x.size(), Vec2::Zero());
    const auto add = [&](int k, const Vec2& g) {
      gradient[static_cast<std::size_t>((k + model_.nodes) % model_.nodes)] += g;
    };
    double area = 0;
    for (int k = 0; k < model_.nodes; ++k) {
      const Vec2 &a = at(x, k - 1), &b = x[k], &c = at(x, k + 1);
      const Vec2 e = b - a, f = c - b;
      const Vec2 pull = model_.axial / l0_ * (f.norm() - l0_) * f.normalized();
      add(k, -pull), add(k + 1, pull);
      const double moment = (turning(a, b, c) - theta0_) / l0_;
      const Vec2 before = moment * Vec2(-e.y(), e.x()) / e.squaredNorm();
      const Vec2 behind = moment * Vec2(-f.y(), f.x()) / f.squaredNorm();
      add(k - 1, before), add(k, -before - behind), add(k + 1, behind);
      add(k, -p / 2 * Vec2(c.y() - a.y(), a.x() - c.x()));
      area += (b.x() * c.y() - b.y() * c.x()) / 2;
    }
    VectorXd r = VectorXd::Zero(u.size());
    for (int k = 0; k < model_.nodes; ++k)
      r.segment<2>(2 * static_cast<Eigen::Index>(image_[k])) += mirror_[k].cwiseProduct(gradient[k]);
    r(r.size() - 1) = model_.core > 0 ? p * area0_ / model_.core + area - area0_ : p;
    return r;
  }

  /// Newton's method over what is free; the derivative by central differences.
  void relax(double strain) {
    std::vector<Eigen::Index> free;
    for (int k = 0; k <= q_; ++k) {
      if (k < q_) free.push_back(2 * k);
      if (k > 0 && !touches_[k]) free.push_back(2 * k + 1);
    }
    free.push_back(u_.size() - 1);
    const auto count = static_cast<Eigen::Index>(free.size());
    for (int iteration = 0; iteration < kNewton; ++iteration) {
      const VectorXd r = residual(u_);
      MatrixXd slope(count, count);
      for (Eigen::Index c = 0; c < count; ++c) {
        const double h = 1e-6;
        VectorXd plus = u_, minus = u_;
        plus(free[c]) += h, minus(free[c]) -= h;
        const VectorXd difference = (residual(plus) - residual(minus)) / (2 * h);
        for (Eigen::Index i = 0; i < count; ++i) slope(i, c) = difference(free[i]);
      }
      VectorXd right(count);
      for (Eigen::Index i = 0; i < count; ++i) right(i) = -r(free[i]);
      const VectorXd move = slope.partialPivLu().solve(right);
      const double largest = move.head(count - 1).cwiseAbs().maxCoeff();
      const double part = std::min(1.0, 0.02 / largest);
      for (Eigen::Index i = 0; i < count; ++i) u_(free[i]) += part * move(i);
      if (largest < 1e-9) return;
    }
    throw SolverError(fmt::format("static ring: Newton's method does not converge at strain {}", strain));
  }

  StaticRingModel model_;
  int q_;
  double l0_ = 0, theta0_ = 0, area0_ = 0;
  std::vector<int> image_;    // node of the quarter that it mirrors
  std::vector<Vec2> mirror_;  // and with which signs
  VectorXd u_;
  std::vector<char> touches_;
};

}  // namespace

std::vector<StaticRing> static_ring(const StaticRingModel& model, const std::vector<double>& strains) {
  QuarterRing ring(model);
  std::vector<StaticRing> all;
  double now = 0;
  for (double strain : strains) {
    const int steps = std::max(1, static_cast<int>(std::ceil((strain - now) / kSubstep - 1e-9)));
    for (int k = 1; k <= steps; ++k) ring.squeeze(now + (strain - now) * k / steps);
    now = strain;
    all.push_back(ring.state(strain));
  }
  return all;
}

}  // namespace lamella
