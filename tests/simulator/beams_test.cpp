// Beams against the closed forms of the discrete model: deflection over that of the continuous beam.
#include <Eigen/Dense>

#include "simulator/terms/bars.h"
#include "simulator/terms/hinges.h"
#include "tests/simulator/oracles.h"
#include "tests/support/samples.h"

namespace lamella {
namespace {

/// A cantilever of n segments on (0, 1) with a ghost segment before it; the clamp's hinge has half a segment, or a full one.
Sample cantilever(int n, double clamp_share) {
  Sample s = chain_sample(n + 1, (n + 1.0) / n);
  for (auto& p : s.x) p.x() -= 1.0 / n;
  s.hinge_length[1] = clamp_share / n;
  return s;
}

/// Small displacements under nodal forces with some coordinates (2 node + component) held.
Eigen::VectorXd deflection(const Sample& s, const Eigen::VectorXd& load, const std::vector<int>& held) {
  const ShellLayout layout(s);
  const Field x = field_of(s.x);
  Eigen::MatrixXd k = stiffness_of(Bars(layout, {1e3}, {}), x) + stiffness_of(Hinges(layout, {1.0}, {}), x);
  Eigen::VectorXd f = load;
  for (int h : held) {
    k.row(h).setZero(), k.col(h).setZero();
    k(h, h) = 1;
    f[h] = 0;
  }
  return k.ldlt().solve(f);
}

TEST(Beams, a_cantilever_deflects_by_one_plus_one_over_two_n_squared) {
  for (int n : {8, 16, 20, 32, 64, 100}) {
    const Sample s = cantilever(n, 0.5);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * s.nodes());
    load[2 * (n + 1) + 1] = 1;
    const double tip = deflection(s, load, {0, 1, 2, 3})[2 * (n + 1) + 1];
    EXPECT_NEAR(tip / (1.0 / 3), 1 + 1 / (2.0 * n * n), 1e-6) << n;  // F L^3 / 3 EI
  }
}

TEST(Beams, the_naive_clamp_is_only_first_order) {
  for (int n : {8, 32, 100}) {
    const Sample s = cantilever(n, 1.0);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * s.nodes());
    load[2 * (n + 1) + 1] = 1;
    const double tip = deflection(s, load, {0, 1, 2, 3})[2 * (n + 1) + 1];
    EXPECT_NEAR(tip * 3, 1 + 3 / (2.0 * n) + 1 / (2.0 * n * n), 1e-6) << n;
  }
}

TEST(Beams, a_simply_supported_beam_deflects_by_one_plus_two_over_n_squared_at_its_centre) {
  for (int n : {8, 16, 32, 64}) {
    const Sample s = chain_sample(n);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * s.nodes());
    load[n + 1] = 1;  // node n / 2, y
    const double centre = deflection(s, load, {0, 1, 2 * n + 1})[n + 1];
    EXPECT_NEAR(centre * 48, 1 + 2.0 / (n * n), 1e-6) << n;
  }
}

TEST(Beams, a_uniform_load_deflects_by_one_plus_four_over_five_n_squared) {
  for (int n : {8, 16, 32, 64}) {
    const Sample s = chain_sample(n);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * s.nodes());
    for (int i = 1; i < n; ++i) load[2 * i + 1] = 1.0 / n;
    const double centre = deflection(s, load, {0, 1, 2 * n + 1})[n + 1];
    EXPECT_NEAR(centre * 384 / 5, 1 + 4.0 / (5 * n * n), 1e-6) << n;
  }
}

}  // namespace
}  // namespace lamella
