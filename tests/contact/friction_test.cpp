#include <gtest/gtest.h>

#include "tests/contact/shells.h"
#include "tests/support/samples.h"

namespace lamella {
namespace {

/// A block of two feet on a plate of nodes that do not move, with weight and a pull, by leapfrog.
struct Sled {
  explicit Sled(double mu, double weight_, double spacing = 0.37) : weight(weight_) {
    std::vector<Vec2> plate;
    for (int k = -2; k < 40; ++k) plate.emplace_back(spacing * k, 0);
    add_cell(sample, plate, false, 0.05, "cells");
    node = static_cast<Index>(plate.size());
    add_probe(sample, {0, 0.1 - weight / stiffness}, 0.05);
    x = positions(sample), v = Field(x.size());
    ContactParameters p = stiff(sample, stiffness);
    p.friction = mu;
    p.bare = {1, 0};
    contacts.emplace(sample, p, x);
    contacts->commit(x);
  }

  Vec2 step(double dt, double pull) {
    contacts->update_candidates(x);
    contacts->evaluate(x, v, 0, contacts->active());
    Field f(x.size()), none;
    contacts->scatter(f, none);
    contacts->advance();
    v.add(node, dt * (f.at(node) + Vec2(pull, -weight)));
    x.add(node, dt * v.at(node));
    return f.at(node);
  }

  static constexpr double stiffness = 1e4;
  double weight;
  Sample sample;
  Index node = 0;
  Field x, v;
  std::optional<Contacts> contacts;
};

TEST(Friction, stops_a_block_after_v2_over_2_mu_g) {
  const double mu = 0.3, g = 2, v0 = 3;  // crosses twenty nodes of the plate
  Sled sled(mu, g);
  sled.v.x[sled.node] = v0;
  const double dt = 2e-4;
  double farthest = 0;
  for (int step = 0; step < 60000; ++step) sled.step(dt, 0), farthest = std::max(farthest, sled.x.x[sled.node]);
  const double expected = v0 * v0 / (2 * mu * g), elastic = mu * g / (0.1 * Sled::stiffness);
  EXPECT_NEAR(farthest / expected, 1, 1e-3);
  EXPECT_NEAR(sled.x.x[sled.node], farthest - elastic, 1.1 * elastic);  // swings about where the spring is free
  EXPECT_NEAR(sled.contacts->friction_dissipated() / (0.5 * v0 * v0), 1, 1e-3);
}

TEST(Friction, sticks_below_the_limit_and_springs_back) {
  const double mu = 0.3, weight = 10;
  Sled sled(mu, weight);
  const double dt = 2e-4, pull = 0.9 * mu * weight;
  const auto relax = [&](double force) {
    for (int step = 0; step < 30000; ++step) {
      sled.step(dt, force * std::min(1.0, step / 10000.0) - 5 * sled.v.x[sled.node]);
    }
  };
  relax(pull);
  EXPECT_NEAR(sled.x.x[sled.node], pull / (0.1 * Sled::stiffness), 1e-3 * pull / (0.1 * Sled::stiffness));
  for (int step = 0; step < 30000; ++step) sled.step(dt, -5 * sled.v.x[sled.node]);
  EXPECT_NEAR(sled.x.x[sled.node], 0, 1e-8);
  EXPECT_EQ(sled.contacts->friction_dissipated(), 0);
}

/// Largest change of kinetic, contact and dissipated energy and weight while a block bounces and slides, over the kinetic energy.
double ledger_residual(double dt) {
  Sled sled(0.3, 10);
  sled.v.set(sled.node, {2, 0.05});
  double first = 0, worst = 0;
  for (int step = 0; step * dt < 1; ++step) {
    const Vec2 v = sled.v.at(sled.node);
    const Field x = sled.x;
    const double dissipated = sled.contacts->friction_dissipated(), stored = sled.contacts->energy(x);
    sled.step(dt, 0);
    const double energy = 0.5 * v.dot(sled.v.at(sled.node)) + stored + dissipated + sled.weight * x.y[sled.node];
    if (step == 0) first = energy;
    worst = std::max(worst, std::abs(energy - first));
  }
  EXPECT_GT(sled.contacts->friction_dissipated(), 0.3);
  return worst / (0.5 * 2 * 2);
}

TEST(Friction, keeps_the_ledger_of_energy_to_second_order) {
  const double coarse = ledger_residual(4e-4), fine = ledger_residual(2e-4);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, 0.35 * coarse);
}

TEST(Friction, does_not_jump_while_sliding_over_nodes) {
  Sled sled(0.3, 10);
  sled.v.x[sled.node] = 1;
  double worst = 0;
  Vec2 before(0, 0);
  for (int step = 0; step < 20000; ++step) {
    sled.v.x[sled.node] = 1;
    const Vec2 f = sled.step(1e-4, 0);
    if (step > 100) worst = std::max(worst, (f - before).norm());
    before = f;
  }
  EXPECT_NEAR(before.x(), -3, 1e-9);
  EXPECT_LT(worst, 1e-9);
}

TEST(Friction, is_the_gradient_of_its_incremental_potential_and_turns_nothing) {
  for (const double mu : {0.02, 5.0}) {  // most slide; most stick
    const Sample sample = pile(11);
    Field x = positions(sample);
    ContactParameters p = stiff(sample);
    p.friction = mu;
    Contacts contacts(sample, p, x);
    contacts.commit(x);
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int round = 0; round < 2; ++round) {
      for (std::size_t i = 0; i < x.size(); ++i) x.add(i, 3e-3 * Vec2(uniform(random), uniform(random)));
      EXPECT_LT(force_error(contacts, x, 1e-6), 1e-7);
      EXPECT_LT(stiffness_error(contacts, x, 1e-6), 1e-6);
      const Field f = force_of(contacts, x);
      EXPECT_LT(total(f).norm(), 1e-13);
      EXPECT_LT(std::abs(torque(x, f)), 1e-13);
      contacts.commit(x);
    }
    EXPECT_GT(mu > 1 ? contacts.stored_in_friction() : contacts.friction_dissipated(), 0);
  }
}

TEST(Friction, turns_with_the_bodies) {
  Sample sample = pile(12);
  Field x = positions(sample);
  ContactParameters p = stiff(sample);
  p.friction = 5;
  Contacts contacts(sample, p, x);
  contacts.commit(x);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (std::size_t i = 0; i < x.size(); ++i) x.add(i, 3e-3 * Vec2(uniform(random), uniform(random)));
  contacts.commit(x);
  const double stored = contacts.stored_in_friction();
  ASSERT_GT(stored, 0);
  const Field start = x;
  for (int step = 1; step <= 90; ++step) {
    const Eigen::Rotation2Dd turn(step * std::numbers::pi / 180);
    for (std::size_t i = 0; i < x.size(); ++i) x.set(i, turn * start.at(i));
    contacts.commit(x);
  }
  EXPECT_NEAR(contacts.stored_in_friction() / stored, 1, 1e-9);
}

TEST(Friction, starts_where_a_broken_link_left_off) {
  const Sample sample = two_bonded_squares(4, 0.05);
  Field x = positions(sample);
  const double press = 0.01, k_n = 3.7, mu = 0.5;
  for (Index i = sample.cell_begin[1]; i < sample.cell_begin[2]; ++i) x.y[i] -= press;
  ContactParameters p = stiff(sample, 100);
  p.friction = mu;
  Contacts contacts(sample, p, x);
  for (Index l = 0; l < 5; ++l) contacts.set_pair_stiffness(l, k_n), contacts.set_intact(l);
  contacts.update_candidates(x);
  const double f_t = 0.6 * mu * k_n * press;
  contacts.release(2, x, f_t);
  Field f = force_of(contacts, x);
  // t runs along a's wall (to the left): the link drags a, the lower square, that way, and so does friction
  Vec2 lower(0, 0);
  for (Index i = 0; i < sample.cell_begin[1]; ++i) lower += f.at(i);
  EXPECT_NEAR(lower.x(), -f_t, 1e-14);
  EXPECT_NEAR(contacts.stored_in_friction(), 0.5 * f_t * f_t / (0.1 * k_n), 1e-15);
  EXPECT_EQ(contacts.friction_dissipated(), 0);

  contacts.release(3, x, 2 * mu * k_n * press);  // more than it can hold
  f = force_of(contacts, x);
  lower.setZero();
  for (Index i = 0; i < sample.cell_begin[1]; ++i) lower += f.at(i);
  EXPECT_NEAR(lower.x(), -f_t - mu * k_n * press, 1e-14);
}

}  // namespace
}  // namespace lamella
