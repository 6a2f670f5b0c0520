// Implicit steps: order, ledger, momentum, the limit of long steps, and breaks.
#include <cmath>

#include "generator/sample/errors.h"
#include "simulator/steppers/backward_euler.h"
#include "simulator/steppers/generalised_alpha.h"
#include "tests/simulator/tissues.h"
#include "tests/support/samples.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

constexpr double kResidual = 1e-11;

/// A model with its loads and an implicit stepper, at rest at time 0.
template <class Scheme, class... More>
struct ImplicitRig {
  ImplicitRig(const Sample& sample, const Stage& stage, std::vector<Load> with, const Field& velocity, More... more)
      : state{field_of(sample.x), velocity, 0, 0},
        model(build_model(sample, stage, state.x)),
        loads(std::move(with)),
        stepper(*model, loads, state, kResidual, more...) {}
  double energy() const { return model->energy(state.x); }
  double kinetic() const {
    double sum = 0;
    for (std::size_t i = 0; i < model->mass.size(); ++i) sum += 0.5 * model->mass[i] * state.v.at(i).squaredNorm();
    return sum;
  }
  State state;
  std::unique_ptr<Model> model;
  std::vector<Load> loads;
  Scheme stepper;
};

/// One bar, one end held, the other swings along it: x = A sin(omega t), omega^2 = k / m.
struct Swing {
  Swing() : chain(chain_sample(1)) {
    stage.cells["cells"] = cell_scene(4.0, 0.0, 2.0);
    hold.nodes = {0};
    hold.holds[0] = hold.holds[1] = true;
  }
  Field velocity(double v) const {
    Field out(2);
    out.set(1, v * (chain.x[1] - chain.x[0]).normalized());
    return out;
  }
  double omega() const {
    const double l = chain.rest_length[0];
    return std::sqrt(4.0 / l / (2.0 * l / 2));
  }
  double elongation(const Field& x) const { return (x.at(1) - x.at(0)).norm() - chain.rest_length[0]; }
  Sample chain;
  Stage stage;
  Load hold;
};

template <class Scheme, class... More>
double swing_error(int steps, More... more) {
  const Swing swing;
  const double v = 1e-3, omega = swing.omega(), end = 2.0 / omega;
  ImplicitRig<Scheme, More...> rig(swing.chain, swing.stage, {swing.hold}, swing.velocity(v), more...);
  for (int n = 0; n < steps; ++n) rig.stepper.step(end / steps, 0);
  return std::abs(swing.elongation(rig.state.x) - v / omega * std::sin(omega * end)) / (v / omega);
}

TEST(Implicit, backward_euler_is_of_first_order) {
  const double coarse = swing_error<BackwardEuler>(100), fine = swing_error<BackwardEuler>(200);
  EXPECT_LT(coarse, 0.03);
  EXPECT_NEAR(std::log2(coarse / fine), 1, 0.05);
}

TEST(Implicit, generalised_alpha_is_of_second_order) {
  for (const double radius : {1.0, 0.8, 0.0}) {
    const double coarse = swing_error<GeneralisedAlpha>(400, radius), fine = swing_error<GeneralisedAlpha>(800, radius);
    EXPECT_LT(coarse, 2e-3) << radius;
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1) << radius;
  }
}

TEST(Implicit, generalised_alpha_keeps_energy_as_its_radius_says) {
  const Swing swing;
  for (const double radius : {1.0, 0.5}) {
    ImplicitRig<GeneralisedAlpha, double> rig(swing.chain, swing.stage, {swing.hold}, swing.velocity(1e-3), radius);
    const double before = rig.kinetic();
    for (int n = 0; n < 200; ++n) rig.stepper.step(1 / swing.omega(), 0);
    const double left = (rig.kinetic() + rig.energy()) / before;
    if (radius == 1.0)
      EXPECT_NEAR(left, 1, 1e-2);
    else
      EXPECT_LT(left, 0.2);
  }
}

/// A ring without any load, thrown and spinning.
template <class Scheme, class... More>
void expect_momentum_to_stay(double tolerance_of_spin, More... more) {
  const Sample ring = ring_sample(12);
  Stage stage;
  stage.cells["cells"] = cell_scene(400.0, 1.0, 1.0);
  Field v(ring.nodes());
  for (Index i = 0; i < ring.nodes(); ++i) v.set(i, Vec2(0.3, -0.1) + 0.5 * left_of(ring.x[i]));
  ImplicitRig<Scheme, More...> rig(ring, stage, {}, v, more...);
  const auto momentum = [&] {
    Vec2 p(0, 0);
    for (Index i = 0; i < ring.nodes(); ++i) p += rig.model->mass[i] * rig.state.v.at(i);
    return p;
  };
  const Vec2 before = momentum();
  for (int n = 0; n < 50; ++n) rig.stepper.step(0.05, 0);
  EXPECT_LT((momentum() - before).norm(), 1e-8 * before.norm());
  double spin = 0, spin_before = 0;
  Vec2 centre(0, 0);
  for (Index i = 0; i < ring.nodes(); ++i) centre += rig.state.x.at(i) / ring.nodes();
  for (Index i = 0; i < ring.nodes(); ++i) {
    spin += rig.model->mass[i] * cross(rig.state.x.at(i) - centre, rig.state.v.at(i));
    spin_before += rig.model->mass[i] * cross(ring.x[i], v.at(i));
  }
  EXPECT_NEAR(spin / spin_before, 1, tolerance_of_spin);
}

TEST(Implicit, keeps_momentum) {
  expect_momentum_to_stay<GeneralisedAlpha>(2e-2, 1.0);
  expect_momentum_to_stay<BackwardEuler>(0.8);  // its spin dies away
}

/// The way of the ledger: work in = energy, kinetic energy, damping, fracture.
template <class Scheme, class... More>
double ledger_residual(double dt, double strength, More... more) {
  const Sample sample = hexagons(3, 3, 2, 0.05);
  Stage stage;
  stage.cells["cells"] = cell_scene(400.0, 0.5, 1.0);
  stage.links["links"] = link_scene("length", 800.0, 300.0, strength);
  stage.drag = DragScene{.rate = 2};
  std::vector<Load> loads{moving_cells(sample, {0, 1, 2}, Vec2(0, 0)), moving_cells(sample, {6, 7, 8}, Vec2(0, 0.5))};
  ImplicitRig<Scheme, More...> rig(sample, stage, loads, Field(sample.nodes()), more...);
  Measurement m;
  double worst = 0;
  while (rig.state.time < 1.5) {
    const double energy = rig.energy();
    m = rig.stepper.measured_step(dt, dt, nullptr);
    worst = std::max(worst, std::abs(m.works.loads - energy - m.kinetic - m.works.damping - m.works.fracture));
  }
  if (strength < 1e3) {
    EXPECT_GT(m.works.fracture, 0);
    EXPECT_EQ(static_cast<Index>(rig.stepper.take_breaks().size()), rig.model->links->broken());
  }
  return worst / m.works.loads;
}

TEST(Implicit, backward_euler_accounts_for_all_that_it_dissipates) {
  EXPECT_LT(ledger_residual<BackwardEuler>(0.02, 1e9), 1e-8);
  EXPECT_LT(ledger_residual<BackwardEuler>(0.02, 6), 1e-8);
}

TEST(Implicit, the_ledger_of_generalised_alpha_closes_with_the_step) {
  const double coarse = ledger_residual<GeneralisedAlpha>(0.01, 1e9, 1.0),
               fine = ledger_residual<GeneralisedAlpha>(0.0025, 1e9, 1.0);
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, 0.3 * coarse);
}

TEST(Implicit, one_long_step_of_backward_euler_is_equilibrium) {
  const Sample sample = hexagons(3, 3, 2, 0.05);
  Stage stage;
  stage.cells["cells"] = cell_scene(400.0, 0.5, 1.0);
  stage.links["links"] = link_scene("length", 800.0, 300.0);
  const double dt = 1e6;
  std::vector<Load> loads{moving_cells(sample, {0, 1, 2}, Vec2(0, 0)),
                          moving_cells(sample, {6, 7, 8}, Vec2(0, 0.2 / dt))};
  ImplicitRig<BackwardEuler> rig(sample, stage, loads, Field(sample.nodes()));
  rig.stepper.step(dt, dt);
  EquilibriumSolver fresh(*rig.model, loads);
  Field x = field_of(sample.x);
  for (Index i : loads[1].nodes) x.y[i] += 0.2;
  ASSERT_TRUE(fresh.relax(x, kResidual));
  double apart = 0;
  for (std::size_t i = 0; i < x.size(); ++i) apart = std::max(apart, (x.at(i) - rig.state.x.at(i)).norm());
  EXPECT_LT(apart, 1e-7);
}

TEST(Implicit, short_steps_agree_with_the_explicit_scheme) {
  const Swing swing;
  const double dt = 0.02 / swing.omega();
  ImplicitRig<GeneralisedAlpha, double> rig(swing.chain, swing.stage, {swing.hold}, swing.velocity(0.2), 1.0);
  Rig verlet(swing.chain, swing.stage, {swing.hold});
  verlet.state.v = swing.velocity(0.2);  // half a step before: the same to first order, and force-free there
  for (int n = 0; n < 400; ++n) {
    rig.stepper.step(dt, dt);
    verlet.stepper.step(dt, dt);
  }
  EXPECT_LT((rig.state.x.at(1) - verlet.state.x.at(1)).norm(), 2e-3);
}

TEST(Implicit, refuses_what_it_has_not) {
  const Swing swing;
  Stage stage = swing.stage;
  stage.cells["cells"].bar_dashpot = 1;
  EXPECT_THROW(ImplicitRig<BackwardEuler>(swing.chain, stage, {swing.hold}, Field(2)), SceneError);
  stage = swing.stage;
  stage.cells["cells"].break_force = 1;
  EXPECT_THROW(ImplicitRig<BackwardEuler>(swing.chain, stage, {swing.hold}, Field(2)), SceneError);
}

}  // namespace
}  // namespace lamella
