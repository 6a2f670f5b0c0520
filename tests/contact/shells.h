// Shells to bring into contact, and the derivatives of a term by central differences.
#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <random>

#include "simulator/contact/contacts.h"

namespace lamella {

inline Field positions(const Sample& sample) {
  Field x(sample.x.size());
  for (std::size_t i = 0; i < sample.x.size(); ++i) x.set(i, sample.x[i]);
  return x;
}

inline Index add_ring(Sample& sample, const Vec2& centre, double size, int nodes, double radius, double turn = 0) {
  std::vector<Vec2> points;
  for (int k = 0; k < nodes; ++k) {
    const double a = turn + 2 * std::numbers::pi * k / nodes;
    points.emplace_back(centre + size * Vec2(std::cos(a), std::sin(a)));
  }
  return add_cell(sample, points, true, radius, "cells");
}

/// A chain of two nodes: its first node is the probe, the second stays out of everything's reach.
inline Index add_probe(Sample& sample, const Vec2& at, double radius, const Vec2& away = {0, 40}) {
  return add_cell(sample, {at, at + away}, false, radius, "cells");
}

inline ContactParameters stiff(const Sample& sample, double k = 1) {
  ContactParameters p;
  p.node_stiffness.assign(sample.x.size(), k);
  p.node_mass.assign(sample.x.size(), 1.0);
  return p;
}

inline double& component(Field& x, Index dof) { return dof % 2 == 0 ? x.x[dof / 2] : x.y[dof / 2]; }
inline double component(const Field& x, Index dof) { return dof % 2 == 0 ? x.x[dof / 2] : x.y[dof / 2]; }

inline Field force_of(const Term& term, const Field& x) {
  Field f(x.size());
  term.add_force(x, f);
  return f;
}

/// Fourth-order central difference of the energy: minus the force.
inline double energy_slope(const Term& term, Field x, Index dof, double h) {
  const double at = component(x, dof);
  const auto energy = [&](double shift) {
    component(x, dof) = at + shift;
    return term.energy(x);
  };
  return (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
}

class DenseSink final : public StiffnessSink {
 public:
  explicit DenseSink(std::size_t nodes) : k(Eigen::MatrixXd::Zero(2 * nodes, 2 * nodes)) {}
  void add(Index i, Index j, const Eigen::Matrix2d& block) override { k.block<2, 2>(2 * i, 2 * j) += block; }
  Eigen::MatrixXd k;
};

/// Largest difference between the stiffness and central differences of the force, over the stiffness's largest entry.
inline double stiffness_error(const Term& term, const Field& x, double h) {
  DenseSink sink(x.size());
  term.add_stiffness(x, sink);
  double worst = 0;
  for (Index d = 0; d < static_cast<Index>(2 * x.size()); ++d) {
    std::array<Field, 4> f;
    const std::array<double, 4> shift{-2 * h, -h, h, 2 * h};
    for (int k = 0; k < 4; ++k) {
      Field moved = x;
      component(moved, d) += shift[k];
      f[k] = force_of(term, moved);
    }
    for (Index e = 0; e < static_cast<Index>(2 * x.size()); ++e) {
      const double slope =
          (8 * (component(f[2], e) - component(f[1], e)) - (component(f[3], e) - component(f[0], e))) / (12 * h);
      worst = std::max(worst, std::abs(sink.k(e, d) + slope));
    }
  }
  return worst / sink.k.cwiseAbs().maxCoeff();
}

/// Largest difference between the force and the slope of the energy, over the largest force.
inline double force_error(const Term& term, const Field& x, double h) {
  const Field f = force_of(term, x);
  double worst = 0, largest = 0;
  for (Index d = 0; d < static_cast<Index>(2 * x.size()); ++d) {
    worst = std::max(worst, std::abs(component(f, d) + energy_slope(term, x, d, h)));
    largest = std::max(largest, std::abs(component(f, d)));
  }
  return worst / largest;
}

inline Vec2 total(const Field& f) {
  Vec2 sum(0, 0);
  for (std::size_t i = 0; i < f.size(); ++i) sum += f.at(i);
  return sum;
}

inline double torque(const Field& x, const Field& f) {
  double sum = 0;
  for (std::size_t i = 0; i < f.size(); ++i) sum += cross(x.at(i), f.at(i));
  return sum;
}

/// A pile of rings and an open chain, pressed into each other here and there.
inline Sample pile(unsigned seed, int rings = 9) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Sample sample;
  for (int k = 0; k < rings; ++k) {
    const Vec2 centre(2.02 * (k % 3) + 0.05 * uniform(random), 2.02 * (k / 3) + 0.05 * uniform(random));
    add_ring(sample, centre, 1 + 0.05 * uniform(random), 14 + k, 0.06 + 0.02 * uniform(random), uniform(random));
  }
  std::vector<Vec2> points;
  for (int k = 0; k <= 9; ++k) points.emplace_back(-1 + 0.7 * k, -1.05 + 0.01 * uniform(random));
  add_cell(sample, points, false, 0.05, "cells");
  return sample;
}

}  // namespace lamella
