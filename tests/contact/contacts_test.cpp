#include <gtest/gtest.h>

#include <cstring>

#include "tests/contact/shells.h"
#include "tests/support/samples.h"

namespace lamella {
namespace {

/// A wall that turns by `turn` at each vertex, and a probe.
struct Walk {
  Sample sample;
  Index probe = 0;
};

Walk polygon(double turn, int segments, double reach) {
  Walk w;
  std::vector<Vec2> points{{0, 0}};
  double angle = -0.5 * turn * (segments - 1);
  for (int k = 0; k < segments; ++k, angle += turn)
    points.emplace_back(points.back() + Vec2(std::cos(angle), std::sin(angle)));
  add_cell(w.sample, points, false, 0.5 * reach, "cells");
  w.probe = static_cast<Index>(points.size());
  add_probe(w.sample, {0, 0}, 0.5 * reach);
  return w;
}

ContactParameters on_bare_wall(const Sample& sample) {
  ContactParameters p = stiff(sample);
  p.bare.assign(sample.cells(), 0);
  p.bare[0] = 1;
  return p;
}

/// Points at a height above the wall, segment by segment; at a concave vertex as far as half the reach from the next one.
std::vector<Vec2> path_above(const Sample& sample, double turn, double height, double reach, int steps) {
  std::vector<Vec2> path;
  const Index count = sample.cell_size(0);
  const double short_of = turn > 0.01 ? std::max(0.0, (0.52 * reach - height * std::cos(turn)) / std::sin(turn)) : 0.0;
  for (Index s = 0; s + 1 < count; ++s) {
    const Vec2 e = sample.x[s + 1] - sample.x[s], n = left_of(e).normalized();
    for (int k = 0; k < steps; ++k)
      path.emplace_back(sample.x[s] + height * n + e * (short_of + (1 - 2 * short_of) * k / (steps - 1)));
  }
  return path;
}

class ConcavePolygon : public testing::TestWithParam<double> {};

TEST_P(ConcavePolygon, pushes_with_the_slope_of_a_continuous_energy) {
  const double reach = 0.2;
  const double turn = GetParam() * std::numbers::pi / 180;
  Walk w = polygon(turn, 4, reach);
  Contacts contacts(w.sample, on_bare_wall(w.sample), positions(w.sample));
  Field x = positions(w.sample);
  double work = 0, before = 0, largest = 0;
  Vec2 from(0, 0), force_before(0, 0);
  bool first = true;
  for (const double height : {0.19, 0.15, 0.12}) {
    first = true;
    for (const Vec2& target : path_above(w.sample, turn, height, reach, 40)) {
      // small steps between the points, so that a jump of energy cannot hide in the error of the sum
      const int parts = first ? 1 : 200;
      for (int k = 1; k <= parts; ++k) {
        const Vec2 p = first ? target : Vec2(from + (target - from) * k / parts);
        x.set(w.probe, p);
        const double energy = contacts.energy(x);
        const Vec2 force = force_of(contacts, x).at(w.probe);
        if (!first) {
          const Vec2 previous = from + (target - from) * (k - 1) / parts;
          work -= 0.5 * (force + force_before).dot(p - previous);
          largest = std::max(largest, std::abs(energy - before - work));
        } else {
          work = 0, before = energy;
        }
        force_before = force;
        first = false;
      }
      from = target;
    }
  }
  // energies are up to 3e-3; a kink of the force costs the trapezoidal sum about k h^2 / 8 each
  EXPECT_LT(largest, 4e-7);
}

TEST_P(ConcavePolygon, has_exact_forces_and_stiffness) {
  const double turn = GetParam() * std::numbers::pi / 180 * (1 - 1e-3);  // at right angles the slope jumps
  Walk w = polygon(turn, 4, 0.2);
  Contacts contacts(w.sample, on_bare_wall(w.sample), positions(w.sample));
  Field x = positions(w.sample);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  int touching = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto path = path_above(w.sample, turn, 0.11 + 0.08 * uniform(random), 0.2, 97);
    Vec2 p = path[static_cast<std::size_t>(uniform(random) * static_cast<double>(path.size()))];
    if (trial % 2 == 0) p = w.sample.x[2] + 0.15 * Vec2(0.2 * (uniform(random) - 0.5), 1);  // around a vertex
    x.set(w.probe, p);
    if (contacts.energy(x) == 0) continue;
    ++touching;
    EXPECT_LT(force_error(contacts, x, 1e-6), 1e-7) << p.transpose();
    EXPECT_LT(stiffness_error(contacts, x, 1e-6), 1e-6) << p.transpose();
  }
  EXPECT_GT(touching, 30);
}

INSTANTIATE_TEST_SUITE_P(Turns, ConcavePolygon,
                         testing::Values(-90.0, -45.0, -10.0, 0.0, 1.0, 5.0, 15.0, 45.0, 89.0, 90.0));

TEST(Contacts, do_no_work_around_a_closed_path) {
  for (const double turn : {-60.0, 0.0, 10.0, 45.0}) {
    Walk w = polygon(turn * std::numbers::pi / 180, 4, 0.2);
    Contacts contacts(w.sample, on_bare_wall(w.sample), positions(w.sample));
    Field x = positions(w.sample);
    const Vec2 centre = w.sample.x[2] + Vec2(0, 0.2);
    double work = 0, largest = 0;
    Vec2 from = centre + Vec2(0.085, 0), f_from(0, 0);
    const int steps = 40000;
    for (int k = 0; k <= steps; ++k) {
      const double a = 2 * std::numbers::pi * k / steps;
      const Vec2 p = centre + 0.085 * Vec2(std::cos(a), std::sin(a));
      x.set(w.probe, p);
      const Vec2 f = force_of(contacts, x).at(w.probe);
      if (k > 0) work += 0.5 * (f + f_from).dot(p - from);
      largest = std::max(largest, contacts.energy(x));
      from = p, f_from = f;
    }
    EXPECT_GT(largest, 1e-4) << turn;
    EXPECT_LT(std::abs(work), 1e-6 * largest) << turn;
  }
}

TEST(Contacts, push_from_both_walls_of_a_box_corner) {
  Sample sample;
  add_cell(sample, {{0, 2}, {0, 0}, {2, 0}}, false, 0.1, "cells");
  add_probe(sample, {0.15, 0.17}, 0.1, {40, 40});
  Contacts contacts(sample, on_bare_wall(sample), positions(sample));
  const Vec2 f = force_of(contacts, positions(sample)).at(3);
  EXPECT_NEAR(f.x(), 0.05, 1e-14);
  EXPECT_NEAR(f.y(), 0.03, 1e-14);
}

TEST(Contacts, of_three_walls_push_from_all_of_them) {
  Sample sample;
  add_cell(sample, {{0, 2}, {0, 0}, {0.3, 0}, {0.3, 2}}, false, 0.1, "cells");
  add_probe(sample, {0.16, 0.17}, 0.1);
  Contacts contacts(sample, on_bare_wall(sample), positions(sample));
  const Field x = positions(sample);
  const Vec2 f = force_of(contacts, x).at(4);
  EXPECT_NEAR(f.x(), 0.04 - 0.06, 1e-14);
  EXPECT_NEAR(f.y(), 0.03, 1e-14);
  for (const double splay : {-0.1, 0.1}) {  // the second derivative jumps at right angles
    Field y = x;
    y.x[0] -= splay, y.x[3] += splay;
    EXPECT_LT(force_error(contacts, y, 1e-6), 1e-7);
    EXPECT_LT(stiffness_error(contacts, y, 1e-6), 1e-7);
  }
}

TEST(Contacts, of_flat_walls_hold_the_same_energy_whether_nodes_face_each_other_or_not) {
  const auto energy = [](double shift) {
    Sample sample;
    std::vector<Vec2> lower, upper;
    for (int k = 0; k <= 10; ++k) lower.emplace_back(k, 0), upper.emplace_back(k + shift, 0.18);
    add_cell(sample, lower, false, 0.1, "cells");
    add_cell(sample, upper, false, 0.1, "cells");
    Contacts contacts(sample, stiff(sample), positions(sample));
    return contacts.energy(positions(sample));
  };
  const double aligned = energy(0);
  EXPECT_NEAR(aligned, 11 * 0.5 * 0.02 * 0.02, 1e-15);
  EXPECT_NEAR(energy(1e-9) / aligned, 1, 1e-8);
  EXPECT_NEAR(energy(-1e-9) / aligned, 1, 1e-8);
  EXPECT_NEAR(energy(0.3) / aligned, 1, 0.1);  // two end nodes have left their opposite wall, and swing around its end
}

TEST(Contacts, count_a_convex_corner_once) {
  Sample sample;
  add_ring(sample, {0, 0}, 1, 4, 0.1);
  add_probe(sample, {1.15, 0}, 0.1);
  ContactParameters p = stiff(sample);
  p.bare.assign(2, 0), p.bare[0] = 1;
  Contacts contacts(sample, p, positions(sample));
  EXPECT_NEAR(force_of(contacts, positions(sample)).at(4).x(), 0.05, 1e-14);
}

TEST(Contacts, of_a_pile_of_shells_have_exact_forces_and_stiffness_and_turn_nothing) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Sample sample = pile(seed);
    const Field x = positions(sample);
    Contacts contacts(sample, stiff(sample), x);
    ASSERT_GT(contacts.energy(x), 0);
    EXPECT_LT(force_error(contacts, x, 1e-6), 1e-7);
    EXPECT_LT(stiffness_error(contacts, x, 1e-6), 1e-7);
    const Field f = force_of(contacts, x);
    EXPECT_LT(total(f).norm(), 1e-14);
    EXPECT_LT(std::abs(torque(x, f)), 1e-14);
  }
}

/// Forces by the stepper's path, in `parts`.
Field evaluated(Contacts& contacts, const Field& x, const Field& v, int parts, Field& damped) {
  for (int k = parts - 1; k >= 0; --k)
    contacts.evaluate(x, v, contacts.active() * k / parts, contacts.active() * (k + 1) / parts);
  Field f(x.size());
  damped = Field(x.size());
  contacts.scatter(f, damped);
  return f;
}

bool same_bits(const Field& a, const Field& b) {
  return std::memcmp(a.x.data(), b.x.data(), a.size() * sizeof(double)) == 0 &&
         std::memcmp(a.y.data(), b.y.data(), a.size() * sizeof(double)) == 0;
}

Field random_velocity(std::size_t nodes, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Field v(nodes);
  for (std::size_t i = 0; i < nodes; ++i) v.set(i, {uniform(random), uniform(random)});
  return v;
}

ContactParameters rough(const Sample& sample) {
  ContactParameters p = stiff(sample);
  p.friction = 0.4, p.damping = 0.3;
  return p;
}

TEST(Contacts, are_the_same_bit_for_bit_in_any_number_of_parts_and_with_any_list) {
  const Sample sample = pile(7);
  const Field x0 = positions(sample), v = random_velocity(x0.size(), 3);
  ContactParameters p = rough(sample);
  p.skin = 0.05;
  Contacts whole(sample, p, x0);
  p.skin = 0.4;
  Contacts wide(sample, p, x0);
  Field x = x0;
  for (int step = 0; step < 30; ++step) {
    Field damped, damped_too;
    const Field f = evaluated(whole, x, v, 1, damped), g = evaluated(wide, x, v, 1 + step % 5, damped_too);
    EXPECT_TRUE(same_bits(f, g)) << step;
    EXPECT_TRUE(same_bits(damped, damped_too)) << step;
    whole.advance(), wide.advance();
    EXPECT_EQ(whole.friction_dissipated(), wide.friction_dissipated());
    for (std::size_t i = 0; i < x.size(); ++i) x.add(i, 1e-3 * v.at(i));
    if (step % 3 == 0) whole.update_candidates(x);
    if (step % 11 == 10) wide.update_candidates(x);
  }
  EXPECT_GT(whole.friction_dissipated(), 0);
}

TEST(Contacts, miss_nothing_while_the_list_is_renewed_only_when_neighbours_part) {
  const Sample sample = pile(7);
  Field x = positions(sample), v = random_velocity(x.size(), 9);
  for (std::size_t i = 0; i < x.size();
       ++i) {  // stretched, sheared and turned as a whole; each cell on its own way; noise
    const Index cell = cell_of_node(sample)[i];
    const Vec2 own(std::cos(7.0 * cell), std::sin(5.0 * cell));
    v.set(i, Vec2(0.4 * x.x[i] - 0.3 * x.y[i], 0.5 * x.x[i] - 0.3 * x.y[i]) + 0.4 * own + 0.1 * v.at(i));
  }
  ContactParameters p = rough(sample);
  Contacts contacts(sample, p, x);
  double moved = 0, fastest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) fastest = std::max(fastest, v.at(i).norm());
  const double dt = 2e-3;
  int calls = 0;
  for (int step = 0; step < 400; ++step) {
    if (2 * moved > contacts.skin()) contacts.update_candidates(x), moved = 0, ++calls;
    Contacts fresh(sample, p, x);
    Field damped, damped_too;
    evaluated(fresh, x, v, 1, damped_too);
    evaluated(contacts, x, v, 1, damped);
    EXPECT_TRUE(same_bits(damped, damped_too)) << step;  // of all that touch; friction springs are older here
    for (std::size_t i = 0; i < x.size(); ++i) x.add(i, dt * v.at(i));
    moved += dt * fastest;
  }
  EXPECT_GT(calls, 5);
}

TEST(Contacts, give_the_stepper_the_forces_of_the_term) {
  const Sample sample = pile(8);
  Field x = positions(sample);
  const Field v = random_velocity(x.size(), 4);
  Contacts contacts(sample, rough(sample), x);
  contacts.commit(x);
  for (std::size_t i = 0; i < x.size(); ++i) x.add(i, 2e-3 * v.at(i));
  Field damped;
  const Field f = evaluated(contacts, x, v, 1, damped), g = force_of(contacts, x);
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, (f.at(i) - g.at(i)).norm());
  EXPECT_LT(largest, 1e-15);
  EXPECT_LT(total(f).norm() + total(damped).norm(), 1e-13);
  EXPECT_LT(std::abs(torque(x, f)) + std::abs(torque(x, damped)), 1e-13);
}

TEST(Contacts, of_several_feet_give_the_stepper_the_forces_of_the_term) {
  const auto compare = [](const Sample& sample, const Field& x) {
    Contacts contacts(sample, on_bare_wall(sample), x);
    Field damped;
    const Field f = evaluated(contacts, x, Field(x.size()), 1, damped), g = force_of(contacts, x);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT((f.at(i) - g.at(i)).norm(), 1e-15) << i;
    EXPECT_LT(force_error(contacts, x, 1e-6), 1e-7);
    EXPECT_LT(stiffness_error(contacts, x, 1e-6), 1e-6);
    ArraySet frame;
    contacts.add_output(x, frame);
    EXPECT_EQ(frame.ints("contact_node").size(), 2u);
  };
  Walk crease = polygon(0.8, 4, 0.2);  // two segments
  Field x = positions(crease.sample);
  x.set(crease.probe, crease.sample.x[2] + Vec2(0.01, 0.15));
  compare(crease.sample, x);

  Sample hook;  // a segment, and the end of the same chain
  add_cell(hook, {{-2, 0}, {2, 0}, {2, 2}, {-1, 2}, {-1, 0.4}, {-0.12, 0.09}}, false, 0.1, "cells");
  add_probe(hook, {0, 0.15}, 0.1, {40, 40});
  compare(hook, positions(hook));
}

TEST(Contacts, continue_bit_for_bit_from_a_restart) {
  const Sample sample = pile(9);
  Field x = positions(sample);
  const Field v = random_velocity(x.size(), 5);
  Contacts first(sample, rough(sample), x);
  const auto step = [&](Contacts& contacts, Field& at) {
    contacts.update_candidates(at);
    Field damped;
    const Field f = evaluated(contacts, at, v, 1, damped);
    contacts.advance();
    for (std::size_t i = 0; i < at.size(); ++i) at.add(i, 1e-3 * v.at(i) + 1e-3 * f.at(i));
  };
  for (int k = 0; k < 20; ++k) step(first, x);
  ArraySet restart;
  first.save(restart);
  Contacts second(sample, rough(sample), x);
  second.restore(restart);
  Field y = x;
  for (int k = 0; k < 20; ++k) step(first, x), step(second, y);
  EXPECT_TRUE(same_bits(x, y));
  EXPECT_EQ(first.friction_dissipated(), second.friction_dissipated());
  EXPECT_EQ(first.stored_in_friction(), second.stored_in_friction());
}

TEST(Contacts, ignore_each_others_node_while_its_link_is_intact) {
  const Sample sample = two_bonded_squares(4, 0.05);
  Field x = positions(sample);
  for (Index i = sample.cell_begin[1]; i < sample.cell_begin[2]; ++i) x.y[i] -= 0.01;
  Contacts contacts(sample, stiff(sample), x);
  EXPECT_GT(contacts.energy(x), 0);
  for (Index l = 0; l < 5; ++l) contacts.set_intact(l);
  contacts.update_candidates(x);
  EXPECT_EQ(contacts.energy(x), 0);
}

TEST(Contacts, of_a_broken_facing_pair_press_as_its_link_did) {
  const Sample sample = two_bonded_squares(4, 0.05);
  Field x = positions(sample);
  const double press = 0.01, k_n = 3.7;
  for (Index i = sample.cell_begin[1]; i < sample.cell_begin[2]; ++i) x.y[i] -= press, x.x[i] += 0.03;
  Contacts contacts(sample, stiff(sample, 100), x);
  for (Index l = 0; l < 5; ++l) contacts.set_pair_stiffness(l, k_n), contacts.set_intact(l);
  contacts.update_candidates(x);
  contacts.release(2, x, 0);
  EXPECT_NEAR(contacts.energy(x), 0.5 * k_n * press * press, 1e-15);
  const Field f = force_of(contacts, x);
  double up = 0;
  for (Index i = sample.cell_begin[1]; i < sample.cell_begin[2]; ++i) up += f.y[i];
  EXPECT_NEAR(up, k_n * press, 1e-14);
}

TEST(Contacts, of_an_unloaded_pair_start_without_a_force) {
  const Sample sample = two_bonded_squares(4, 0.05);
  const Field x = positions(sample);
  Contacts contacts(sample, rough(sample), x);
  for (Index l = 0; l < 5; ++l) contacts.set_intact(l);
  contacts.update_candidates(x);
  for (Index l = 0; l < 5; ++l) contacts.release(l, x, 0);
  EXPECT_LT(contacts.energy(x), 1e-30);
}

TEST(Contacts, keep_a_crushed_ring_from_crossing_itself) {
  Sample sample;
  add_ring(sample, {0, 0}, 1, 40, 0.05);
  Field x = positions(sample), v(40);
  Contacts contacts(sample, stiff(sample, 4000), x);
  // A loose chain of masses squeezed flat by its own inertia: upper half down, lower half up.
  for (int i = 0; i < 40; ++i) v.y[i] = -x.y[i];
  const double dt = 0.002;
  for (int step = 0; step < 2000; ++step) {
    contacts.update_candidates(x);
    Field damped;
    const Field f = evaluated(contacts, x, v, 1, damped);
    for (int i = 0; i < 40; ++i) {
      Vec2 force = f.at(i);
      for (const int j : {(i + 1) % 40, (i + 39) % 40}) {
        const Vec2 d = x.at(j) - x.at(i);
        force += 400 * (d.norm() - sample.rest_length[0]) * d.normalized();
      }
      v.add(i, dt * force);
    }
    for (int i = 0; i < 40; ++i) x.add(i, dt * v.at(i));
    for (int i = 0; i < 40; ++i)
      for (int j = i + 2; j < 40; ++j) {
        if ((j + 1) % 40 == i) continue;
        const Vec2 a = x.at(i), b = x.at((i + 1) % 40), c = x.at(j), d = x.at((j + 1) % 40);
        ASSERT_FALSE(cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0)
            << "segments " << i << " and " << j << " in step " << step;
      }
  }
}

TEST(Contacts, name_a_node_that_has_got_inside_another_cell) {
  Sample sample;
  add_ring(sample, {0, 0}, 1, 20, 0.05);
  add_ring(sample, {2.2, 0}, 1, 20, 0.05, 0.1);
  Field x = positions(sample);
  Contacts contacts(sample, stiff(sample), x);
  EXPECT_FALSE(contacts.fault(x));
  x.set(30, {0.95, -0.08});
  const auto fault = contacts.fault(x);
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->find("node 30 of cell 1 is inside cell 0, at (0.95, -0.08) m"), std::string::npos) << *fault;
}

TEST(Contacts, accept_what_was_inside_from_the_beginning) {
  Sample sample;
  add_ring(sample, {0, 0}, 5, 40, 0.05);
  add_ring(sample, {1, 0}, 1, 20, 0.05);
  Field x = positions(sample);
  Contacts contacts(sample, stiff(sample), x);
  EXPECT_FALSE(contacts.fault(x));
}

TEST(Contacts, name_a_wall_that_has_gone_through_a_plate) {
  Sample sample;
  add_cell(sample, {{-2, -1.1}, {2, -1.1}}, false, 0.05, "cells");
  add_ring(sample, {0, 0}, 1, 20, 0.05);
  Field x = positions(sample);
  Contacts contacts(sample, stiff(sample), x);
  EXPECT_FALSE(contacts.fault(x));
  for (std::size_t i = 2; i < x.size(); ++i) x.y[i] -= 0.3;
  const auto fault = contacts.fault(x);
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->find("of cell 1"), std::string::npos) << *fault;
}

TEST(Contacts, report_each_contact_with_its_normal_force) {
  Sample sample;
  add_cell(sample, {{-2, 0}, {2, 0}}, false, 0.1, "cells");
  add_probe(sample, {0.5, 0.25}, 0.2);
  Contacts contacts(sample, on_bare_wall(sample), positions(sample));
  ArraySet frame;
  contacts.add_output(positions(sample), frame);
  EXPECT_EQ(frame.ints("contact_node"), (std::vector<std::int32_t>{2}));
  EXPECT_EQ(frame.ints("contact_cell"), (std::vector<std::int32_t>{0}));
  EXPECT_NEAR(frame.doubles("contact_force")[0], 0.05, 1e-15);
  EXPECT_NEAR(frame.doubles("contact_normal")[1], 1, 1e-15);
  EXPECT_NEAR(frame.doubles("contact_position")[1], 0.25 / 3, 1e-15);
  EXPECT_EQ(frame.find("contact_sliding"), nullptr);
}

TEST(Contacts, bound_the_step_by_contacts_that_are_about_to_close) {
  Sample sample;
  add_cell(sample, {{-2, 0}, {2, 0}}, false, 0.1, "cells");
  add_probe(sample, {0.5, 0.31}, 0.2);
  ContactParameters p = on_bare_wall(sample);
  p.skin = 0.05, p.damping = 0.5;
  const Field x = positions(sample);
  Contacts contacts(sample, p, x);
  DenseSink now(4), possible(4), dashpots(4);
  contacts.add_stiffness(x, now);
  contacts.add_possible_stiffness(x, possible);
  contacts.add_possible_damping(x, dashpots);
  EXPECT_EQ(now.k.cwiseAbs().maxCoeff(), 0);
  EXPECT_NEAR(possible.k(5, 5), 1, 1e-15);
  EXPECT_NEAR(dashpots.k(5, 5), 1, 1e-15);  // 2 zeta sqrt(k m)
}

TEST(Contacts, damped_critically_do_not_bounce_and_never_pull) {
  Sample sample;
  add_cell(sample, {{-2, 0}, {2, 0}}, false, 0.1, "cells");
  add_probe(sample, {0.5, 0.3}, 0.2);
  ContactParameters p = on_bare_wall(sample);
  p.damping = 1;
  Field x = positions(sample), v(4);
  Contacts contacts(sample, p, x);
  v.y[2] = -0.05;
  const double dt = 1e-3;
  double lowest = 1;
  for (int step = 0; step < 20000; ++step) {
    Field damped;
    const Field f = evaluated(contacts, x, v, 1, damped);
    lowest = std::min(lowest, f.y[2] + damped.y[2]);
    v.y[2] += dt * (f.y[2] + damped.y[2]);
    x.y[2] += dt * v.y[2];
  }
  EXPECT_GE(lowest, 0);
  EXPECT_LT(v.y[2], 0.05 * 0.15);  // the clip lets go of the last seventh
}

}  // namespace
}  // namespace lamella
