// Oracles for terms: finite differences, an assembled stiffness, and the whole path of a term in one call.
#pragma once
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "simulator/terms/term.h"

namespace lamella {

/// Positions of the sample, each node moved by up to `amplitude` in each direction.
inline Field shaken(const Sample& sample, double amplitude, unsigned seed = 1) {
  std::mt19937 random(seed);
  Field x = field_of(sample.x);
  const auto draw = [&] { return amplitude * (2.0 * random() / 4294967295.0 - 1.0); };
  for (std::size_t i = 0; i < x.size(); ++i) x.x[i] += draw(), x.y[i] += draw();
  return x;
}

inline double& coordinate(Field& x, int k) { return k % 2 == 0 ? x.x[k / 2] : x.y[k / 2]; }

/// Force vector (2 n) of a term.
inline Eigen::VectorXd force_of(const Term& term, const Field& x) {
  Field f(x.size());
  term.add_force(x, f);
  Eigen::VectorXd out(2 * x.size());
  for (int k = 0; k < out.size(); ++k) out[k] = coordinate(f, k);
  return out;
}

/// Assembles a dense stiffness (2 n x 2 n).
class DenseSink final : public StiffnessSink {
 public:
  explicit DenseSink(std::size_t nodes) : matrix(Eigen::MatrixXd::Zero(2 * nodes, 2 * nodes)) {}
  void add(Index i, Index j, const Eigen::Matrix2d& block) override { matrix.block<2, 2>(2 * i, 2 * j) += block; }
  Eigen::MatrixXd matrix;
};

inline Eigen::MatrixXd stiffness_of(const Term& term, const Field& x) {
  DenseSink sink(x.size());
  term.add_stiffness(x, sink);
  return sink.matrix;
}

/// Central differences over a step of `h`: the energy's for the force, the force's for the stiffness. Errors relative to the
/// largest entry.
inline void expect_consistent_derivatives(const Term& term, Field x, double h, double tolerance) {
  const Eigen::VectorXd force = force_of(term, x);
  const Eigen::MatrixXd stiffness = stiffness_of(term, x);
  Eigen::VectorXd difference(force.size());
  Eigen::MatrixXd stiffness_difference(force.size(), force.size());
  for (int k = 0; k < force.size(); ++k) {
    double& at = coordinate(x, k);
    const double here = at;
    at = here + h;
    const double plus = term.energy(x);
    const Eigen::VectorXd force_plus = force_of(term, x);
    at = here - h;
    difference[k] = -(plus - term.energy(x)) / (2 * h);
    stiffness_difference.col(k) = -(force_plus - force_of(term, x)) / (2 * h);
    at = here;
  }
  const double force_scale = force.cwiseAbs().maxCoeff(), stiffness_scale = stiffness.cwiseAbs().maxCoeff();
  ASSERT_GT(force_scale, 0) << term.name() << ": nothing to test";
  EXPECT_LT((force - difference).cwiseAbs().maxCoeff() / force_scale, tolerance) << term.name() << ": force";
  EXPECT_LT((stiffness - stiffness_difference).cwiseAbs().maxCoeff() / stiffness_scale, tolerance)
      << term.name() << ": stiffness";
  EXPECT_LT((stiffness - stiffness.transpose()).cwiseAbs().maxCoeff() / stiffness_scale, 1e-12)
      << term.name() << ": symmetry";
}

/// Net force and net torque about the origin, relative to the sum of magnitudes and the sample's extent.
inline void expect_balanced(const Term& term, const Field& x) {
  Field f(x.size());
  term.add_force(x, f);
  Vec2 net = Vec2::Zero();
  double torque = 0, scale = 0, lever = 0;
  for (std::size_t i = 0; i < x.size(); ++i) lever = std::max(lever, x.at(i).norm());
  for (std::size_t i = 0; i < x.size(); ++i) {
    net += f.at(i);
    torque += cross(x.at(i), f.at(i));
    scale += f.at(i).norm();
  }
  ASSERT_GT(scale, 0);
  EXPECT_LT(net.norm() / scale, 1e-13) << term.name() << ": net force";
  EXPECT_LT(std::abs(torque) / (scale * lever), 1e-13) << term.name() << ": net torque";
}

}  // namespace lamella
