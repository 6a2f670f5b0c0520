// Every term against its own energy, and against the motions that must cost nothing.
#include <cmath>
#include <limits>
#include <numbers>

#include "simulator/laws/cohesive.h"
#include "simulator/measures/angle.h"
#include "simulator/terms/bars.h"
#include "simulator/terms/cohesive_links.h"
#include "simulator/terms/core.h"
#include "simulator/terms/gravity.h"
#include "simulator/terms/hinges.h"
#include "tests/simulator/oracles.h"
#include "tests/support/samples.h"

namespace lamella {
namespace {

constexpr double kFiniteDifference = 1e-7;  // central differences over 1e-5 are good to 1e-9; the issue asks for 1e-7

LinkParameters link_parameters(const Sample& s, double k_n, double k_t) {
  LinkParameters p;
  p.normal_stiffness.assign(s.links.size(), k_n);
  p.tangential_stiffness.assign(s.links.size(), k_t);
  return p;
}

void make_breakable(LinkParameters& p, double f_n0, double f_t0) {
  p.normal_strength.assign(p.normal_stiffness.size(), f_n0);
  p.tangential_strength.assign(p.normal_stiffness.size(), f_t0);
  p.full_energy.assign(p.normal_stiffness.size(), f_n0 * f_n0 / (2 * p.normal_stiffness[0]));
}

TEST(Angle, agrees_with_the_c_library_to_rounding) {
  double worst = 0;
  for (int k = 0; k <= 20000; ++k) {
    const double a = std::numbers::pi * (2.0 * k / 20000 - 1);
    for (const double r : {1e-9, 1.0, 1e7}) {
      const double y = r * std::sin(a), x = r * std::cos(a);
      worst = std::max(worst, std::abs(angle_of(y, x) - std::atan2(y, x)));
    }
  }
  EXPECT_LT(worst, 9e-16);
  EXPECT_EQ(angle_of(0, 0), 0);
}

TEST(Angle, follows_the_last_one_through_full_turns) {
  EXPECT_NEAR(unwrapped(-3.0, 3.2), -3.0 + 2 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(unwrapped(0.1, 6 * std::numbers::pi), 0.1 + 6 * std::numbers::pi, 1e-14);
}

TEST(Bars, force_and_stiffness_are_derivatives_of_the_energy) {
  for (const Sample& s : {ring_sample(7), chain_sample(5), two_bonded_squares(2)}) {
    const ShellLayout layout(s);
    expect_consistent_derivatives(Bars(layout, std::vector<double>(s.cells(), 3.0), {}), shaken(s, 0.05), 1e-5,
                                  kFiniteDifference);
  }
}

TEST(Bars, plastic_force_is_the_derivative_of_the_incremental_potential) {
  const Sample s = ring_sample(7);
  const ShellLayout layout(s);
  expect_consistent_derivatives(Bars(layout, {3.0}, {0.05}), shaken(s, 0.05), 1e-6, 1e-6);
}

TEST(Bars, a_bar_pulled_past_yield_keeps_the_yield_force_and_the_plastic_length) {
  const Sample s = chain_sample(1);
  const ShellLayout layout(s);
  Bars bars(layout, {2.0}, {0.1});  // yields at elongation 0.05
  Field x = field_of(s.x);
  x.x[1] += 0.15;
  EXPECT_NEAR(force_of(bars, x)[0], 0.1, 1e-15);
  bars.commit(x);
  EXPECT_NEAR(bars.dissipated(), 0.1 * 0.10, 1e-15);
  x.x[1] -= 0.05;  // back by the elastic part: free of force
  EXPECT_NEAR(force_of(bars, x)[0], 0, 1e-15);
}

TEST(Hinges, force_and_stiffness_are_derivatives_of_the_energy) {
  for (const Sample& s : {ring_sample(7), chain_sample(5), two_bonded_squares(2)}) {
    const ShellLayout layout(s);
    expect_consistent_derivatives(Hinges(layout, std::vector<double>(s.cells(), 3.0), {}), shaken(s, 0.05), 1e-5,
                                  kFiniteDifference);
  }
}

TEST(Hinges, plastic_moment_is_the_derivative_of_the_incremental_potential) {
  const Sample s = ring_sample(7);
  const ShellLayout layout(s);
  expect_consistent_derivatives(Hinges(layout, {3.0}, {0.1}), shaken(s, 0.05), 1e-6, 1e-6);
}

TEST(Hinges, moment_is_continuous_and_returns_to_zero_over_three_turns) {
  const Sample s = chain_sample(2);
  const ShellLayout layout(s);
  Hinges hinges(layout, {1.0}, {});
  Field x = field_of(s.x);
  const int steps = 300;
  double last = 0;
  for (int direction : {1, -1})
    for (int k = 1; k <= steps; ++k) {
      const double turn = 6 * std::numbers::pi * (direction > 0 ? k : steps - k) / steps;
      x.set(2, x.at(1) + 0.5 * Vec2(std::cos(turn), std::sin(turn)));
      const double moment = std::sqrt(2 * hinges.energy(x) * 1.0 / 0.5);  // W = M^2 / 2 k_b, k_b = EI / lt = 2
      EXPECT_LT(std::abs(moment - last), 1.01 * 2.0 * 6 * std::numbers::pi / steps + 1e-12);
      expect_balanced(hinges, [&] {
        Field y = x;
        y.y[0] -= 1e-9;
        return y;
      }());
      hinges.commit(x);
      last = moment;
    }
  EXPECT_LT(hinges.energy(x), 1e-24);
}

TEST(Core, force_and_stiffness_are_derivatives_of_the_energy) {
  const Sample s = two_bonded_squares(2);
  const ShellLayout layout(s);
  expect_consistent_derivatives(Core(layout, {{5.0, 0.0}, {0.3, 0.7}, {1.0, 2.0}}), shaken(s, 0.05), 1e-5,
                                kFiniteDifference);
}

TEST(Core, pressure_pushes_each_edge_with_p_s_l) {
  const Sample s = ring_sample(6);
  const ShellLayout layout(s);
  const Eigen::VectorXd f = force_of(Core(layout, {{0.0}, {2.0}, {3.0}}), field_of(s.x));
  const double edge = s.rest_length[0];  // force on a node: p s l cos(pi / N), outwards
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(f.segment<2>(2 * i).dot(s.x[i]), 2.0 * 3.0 * edge * std::cos(std::numbers::pi / 6), 1e-12);
}

TEST(Links, force_and_stiffness_are_derivatives_of_the_energy) {
  for (const int segments : {1, 2, 3}) {
    const Sample s = two_bonded_squares(segments);
    const ShellLayout layout(s);
    expect_consistent_derivatives(CohesiveLinks(layout, link_parameters(s, 4.0, 0.7)), shaken(s, 0.02), 1e-6,
                                  kFiniteDifference);
  }
}

TEST(Links, force_and_stiffness_hold_where_only_the_ends_are_linked_and_the_tangent_reaches_beyond_them) {
  Sample s = two_bonded_squares(4);
  auto& links = s.links;
  Link middle = links[2];  // two-sided tangent without linked neighbours
  links = {links.front(), middle, links.back()};
  const ShellLayout layout(s);
  const CohesiveLinks term(layout, link_parameters(s, 4.0, 0.7));
  expect_consistent_derivatives(term, shaken(s, 0.02), 1e-6, kFiniteDifference);
  expect_balanced(term, shaken(s, 0.02));
}

TEST(Links, balance_forces_and_torques_at_finite_gap) {
  const Sample s = two_bonded_squares(3, 0.2);
  const ShellLayout layout(s);
  expect_balanced(CohesiveLinks(layout, link_parameters(s, 4.0, 0.7)), shaken(s, 0.05));
}

TEST(Terms, a_rigid_rotation_costs_nothing) {
  const Sample s = two_bonded_squares(3, 0.2);
  const ShellLayout layout(s);
  Field x(s.nodes());
  for (Index i = 0; i < s.nodes(); ++i) x.set(i, left_of(s.x[i]) + Vec2(5, -3));  // 90 degrees
  const std::vector<double> one(s.cells(), 1.0);
  for (const Term* term : std::initializer_list<const Term*>{new Bars(layout, one, {}), new Hinges(layout, one, {}),
                                                             new Core(layout, {one, {0, 0}, one}),
                                                             new CohesiveLinks(layout, link_parameters(s, 1.0, 1.0))}) {
    EXPECT_LT(force_of(*term, x).cwiseAbs().maxCoeff(), 1e-12) << term->name();
    EXPECT_LT(term->energy(x), 1e-24) << term->name();
    delete term;
  }
}

TEST(Terms, a_force_scaled_by_one_percent_fails_the_finite_difference) {
  const Sample s = ring_sample(7);
  const ShellLayout layout(s);
  const Bars bars(layout, {3.0}, {});
  const Field x = shaken(s, 0.05);
  const Eigen::VectorXd f = force_of(bars, x);
  Field y = x;
  y.x[0] += 1e-6;
  const double plus = bars.energy(y);
  y.x[0] -= 2e-6;
  const double slope = -(plus - bars.energy(y)) / 2e-6;
  EXPECT_LT(std::abs(f[0] - slope), 1e-7 * f.cwiseAbs().maxCoeff());
  EXPECT_GT(std::abs(1.01 * f[0] - slope), 1e-7 * f.cwiseAbs().maxCoeff());
}

// physics 2d: u_c = 2 / (A + sqrt(A^2 + 4 B^2)) along (u cos phi, u sin phi).
TEST(Links, a_single_link_breaks_where_the_closed_form_says_over_all_mode_mixes) {
  Sample s = two_bonded_squares(1);
  s.links.resize(1);
  const double degree = std::numbers::pi / 180;
  const double table[][2] = {{0, 1},         {15, 1.032320}, {30, 1.139702},  {45, 1.361763},  {60, 1.804604},
                             {75, 2.762940}, {90, 5},        {100, 7.786631}, {120, 18.471271}};
  for (const auto& [phi, expected] : table) {
    const auto breaks_at = [&](double u) {
      const ShellLayout layout(s);
      LinkParameters p = link_parameters(s, 1.0, 0.1);
      make_breakable(p, 1.0, 0.5);
      CohesiveLinks links(layout, p);
      Field x = field_of(s.x);
      const Vec2 n = Vec2(0, 1), t = Vec2(-1, 0);  // the lower square's upper side runs towards -x
      for (Index i = 4; i < 8; ++i) x.add(i, u * (std::cos(phi * degree) * n + std::sin(phi * degree) * t));
      links.commit(x);
      return links.broken() == 1;
    };
    EXPECT_TRUE(breaks_at(expected * (1 + 1e-6))) << phi;
    EXPECT_FALSE(breaks_at(expected * (1 - 1e-6))) << phi;
  }
}

TEST(Links, a_broken_link_holds_no_energy_and_no_force) {
  const Sample s = two_bonded_squares(2);
  const ShellLayout layout(s);
  LinkParameters p = link_parameters(s, 1.0, 0.1);
  make_breakable(p, 1e-3, 1e-3);
  CohesiveLinks links(layout, p);
  Field x = field_of(s.x);
  for (Index i = 8; i < 16; ++i) x.y[i] += 0.01;
  const double stored = links.energy(x);
  links.commit(x);
  EXPECT_EQ(links.broken(), 3);
  EXPECT_EQ(links.energy(x), 0);
  EXPECT_EQ(force_of(links, x).cwiseAbs().maxCoeff(), 0);
  double booked = 0;
  for (const Break& b : links.breaks()) booked += b.energy;
  EXPECT_NEAR(booked, stored, 1e-15 * stored);
}

TEST(Links, the_same_links_break_whatever_their_order) {
  Sample s = two_bonded_squares(6);
  const Field x = [&] {
    Field y = shaken(s, 0.004, 3);
    for (Index i = 24; i < 48; ++i) y.y[i] += 0.003;
    return y;
  }();
  const auto broken_nodes = [&](const Sample& sample) {
    const ShellLayout layout(sample);
    LinkParameters p = link_parameters(sample, 1.0, 0.1);
    make_breakable(p, 4e-3, 4e-3);
    CohesiveLinks links(layout, p);
    links.commit(x);
    std::vector<Index> nodes;
    for (const Break& b : links.breaks()) nodes.push_back(sample.links[b.link].a);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  const auto forward = broken_nodes(s);
  std::reverse(s.links.begin(), s.links.end());
  EXPECT_EQ(forward, broken_nodes(s));
  EXPECT_GT(forward.size(), 0u);
  EXPECT_LT(forward.size(), s.links.size());
}

TEST(Gravity, work_is_weight_times_height) {
  const std::vector<double> mass = {1.0, 2.0};
  const Gravity gravity(mass, Vec2(0, -9.81));
  Field x(2);
  const double before = gravity.energy(x);
  x.y[1] = 3;
  EXPECT_NEAR(gravity.energy(x) - before, 2.0 * 9.81 * 3, 1e-12);
}

}  // namespace
}  // namespace lamella
