// Contact across the sides of a periodic box.
#include "simulator/contact/images.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "generator/sample/errors.h"
#include "tests/contact/shells.h"

namespace lamella {
namespace {

/// Rings that cover a box of three by two sizes, pressed into each other here and there, some across its sides.
Sample ring_box(const Periodic& periodic, unsigned seed = 2) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Sample sample;
  for (int k = 0; k < 6; ++k)
    add_ring(sample, Vec2(1 + 2.0 * (k % 3), 1 + 2.0 * (k / 3)) + 0.06 * Vec2(uniform(random), uniform(random)),
             0.98 + 0.03 * uniform(random), 13 + k, 0.05, uniform(random));
  sample.box = {Vec2(0, 0), Vec2(6, 4)};
  sample.periodic = periodic;
  return sample;
}

std::vector<Periodic> directions() { return {{true, false}, {false, true}, {true, true}}; }

Vec2 some_shift(const Sample& s, Index cell) {
  return {s.periodic[0] ? (cell * 5 % 7 - 3) * s.box.size().x() : 0.0,
          s.periodic[1] ? (cell * 3 % 4 - 1) * s.box.size().y() : 0.0};
}

Field rehomed(const Sample& s, Field x) {
  for (Index c = 0; c < s.cells(); ++c)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) x.add(i, some_shift(s, c));
  return x;
}

/// Every image within a few boxes of every node against every segment.
std::set<std::tuple<Index, Index, Image, Index>> by_brute_force(const CandidateRules& rules, const Field& x, int far) {
  const Sample& s = rules.sample;
  std::set<std::tuple<Index, Index, Image, Index>> found;
  for (int i = s.periodic[0] ? -far : 0; i <= (s.periodic[0] ? far : 0); ++i)
    for (int j = s.periodic[1] ? -far : 0; j <= (s.periodic[1] ? far : 0); ++j)
      for (Index node = 0; node < s.nodes(); ++node)
        for (Index c = 0; c < s.cells(); ++c)
          for (Index k = s.cell_begin[c]; k < s.cell_begin[c + 1]; ++k) {
            const Image image{static_cast<std::int8_t>(i), static_cast<std::int8_t>(j)};
            if (s.starts_segment(c, k) && rules.candidates(x, node, c, k, image)) found.emplace(node, c, image, k);
          }
  return found;
}

TEST(Images, of_candidates_are_those_of_brute_force_wherever_cells_have_wandered) {
  for (const Periodic& periodic : directions()) {
    const Sample s = ring_box(periodic);
    const std::vector<Index> cell_of = cell_of_node(s);
    const std::vector<std::uint8_t> bare(s.cells(), 0);
    const SelfReach self(s);
    const LinkedNodes linked(s, cell_of);
    const CandidateRules rules{s, cell_of, bare, self, linked, 0.08};
    for (const Field& x : {positions(s), rehomed(s, positions(s))}) {
      const CandidateList list = find_candidates(rules, x);
      std::set<std::tuple<Index, Index, Image, Index>> found;
      std::tuple<Index, Index, Image> last{-1, 0, {0, 0}};
      for (const Pair& pair : list.pairs) {
        const std::tuple<Index, Index, Image> at{pair.node, pair.cell, pair.image};
        EXPECT_LT(last, at);
        last = at;
        for (const Index segment : list.of(pair)) found.emplace(pair.node, pair.cell, pair.image, segment);
      }
      EXPECT_EQ(found, by_brute_force(rules, x, 8));
      int across = 0;
      for (const auto& one : found) across += std::get<2>(one) != Image{0, 0};
      EXPECT_GE(across, 10);
    }
  }
}

TEST(Images, push_by_the_slope_of_their_energy) {
  for (const Periodic& periodic : directions()) {
    const Sample s = ring_box(periodic);
    const Contacts contacts(s, stiff(s), positions(s));
    EXPECT_LT(force_error(contacts, positions(s), 1e-5), 1e-7);
    EXPECT_LT(stiffness_error(contacts, positions(s), 1e-5), 1e-6);
    EXPECT_LT(total(force_of(contacts, positions(s))).norm(), 1e-14);
  }
}

/// A box of three copies of the sample beside each other that does not repeat.
Sample thrice(const Sample& s, const Vec2& step) {
  Sample out;
  for (const int copy : {-1, 0, 1})
    for (Index c = 0; c < s.cells(); ++c) {
      std::vector<Vec2> points(s.x.begin() + s.cell_begin[c], s.x.begin() + s.cell_begin[c + 1]);
      for (Vec2& p : points) p += copy * step;
      add_cell(out, points, true, s.radius[c], "cells");
    }
  return out;
}

TEST(Images, act_as_copies_of_the_cells_beside_the_box) {
  for (const int axis : {0, 1}) {
    const Sample s = ring_box({axis == 0, axis == 1});
    Vec2 step(0, 0);
    step[axis] = s.box.size()[axis];
    const Sample copies = thrice(s, step);
    const Contacts contacts(s, stiff(s), positions(s)), plain(copies, stiff(copies), positions(copies));
    const Field f = force_of(contacts, positions(s)), g = force_of(plain, positions(copies));
    double most = 0, off = 0;
    for (Index i = 0; i < s.nodes(); ++i) {
      most = std::max(most, f.at(i).norm());
      off = std::max(off, (f.at(i) - g.at(s.nodes() + i)).norm());
    }
    EXPECT_GT(most, 0);
    EXPECT_LT(off, 1e-12 * most);
  }
}

TEST(Images, touch_a_cell_that_fills_the_box_from_both_sides) {
  Sample s;
  add_ring(s, {1, 1}, 0.98, 16, 0.05);
  s.box = {Vec2(0, 0), Vec2(2, 2)};
  s.periodic = {true, true};
  const Contacts contacts(s, stiff(s), positions(s));
  const Field f = force_of(contacts, positions(s));
  EXPECT_NEAR(f.x[0], -f.x[8], 1e-14);  // squeezed between its own images
  EXPECT_LT(f.x[0], -1e-3);
  EXPECT_NEAR(f.y[4], f.x[0], 1e-14);
  EXPECT_LT(force_error(contacts, positions(s), 1e-5), 1e-7);
}

/// Rows that slide over each other, with friction: positions, velocities given. Returns forces and what friction takes.
std::pair<Field, double> after_sliding(const Sample& s, bool wandered) {
  ContactParameters p = stiff(s);
  p.friction = 0.4;
  const auto at = [&](double way) {
    Field x = positions(s);
    for (Index i = s.cell_begin[3]; i < s.nodes(); ++i) x.x[i] += way, x.y[i] -= 0.03;
    return wandered ? rehomed(s, x) : x;
  };
  Contacts contacts(s, p, at(0));
  contacts.commit(at(0));
  for (int step = 1; step <= 400; ++step) contacts.commit(at(0.02 * step));  // beyond one side of the box
  ArraySet restart;
  contacts.save(restart);
  Contacts again(s, p, at(8));
  again.restore(restart);
  EXPECT_NEAR(again.energy(at(8)), contacts.energy(at(8)), 1e-12 * contacts.energy(at(8)));
  EXPECT_GT(contacts.stored_in_friction(), 0);
  return {force_of(again, at(8)), contacts.friction_dissipated()};
}

TEST(Images, rub_alike_wherever_cells_have_wandered_and_after_a_restart) {
  const Sample s = ring_box({true, false});
  const auto [f, dissipated] = after_sliding(s, false);
  const auto [g, dissipated_there] = after_sliding(s, true);
  EXPECT_GT(dissipated, 0);
  EXPECT_NEAR(dissipated_there / dissipated, 1, 1e-9);
  for (Index i = 0; i < s.nodes(); ++i) EXPECT_LT((f.at(i) - g.at(i)).norm(), 1e-9);
}

TEST(Images, of_a_node_inside_a_cell_are_a_fault) {
  const Sample s = ring_box({true, false});
  const Contacts contacts(s, stiff(s), positions(s));
  EXPECT_FALSE(contacts.fault(positions(s)));
  Field x = positions(s);
  for (Index i = 0; i < s.cell_begin[1]; ++i)
    x.x[i] -= 0.9;  // the first ring into the last of its row, around the side
  ASSERT_TRUE(contacts.fault(x));
  EXPECT_NE(contacts.fault(x)->find("inside cell"), std::string::npos);
  EXPECT_EQ(contacts.fault(rehomed(s, x)).has_value(), true);
}

TEST(Images, are_covered_by_the_list_until_neighbours_have_moved_by_the_skin) {
  const Sample s = ring_box({true, false});
  Contacts contacts(s, stiff(s), positions(s));
  Field all = positions(s), one = positions(s);
  for (Index i = 0; i < s.nodes(); ++i) all.x[i] += 0.7;
  EXPECT_TRUE(contacts.covers(all));  // together, they are where they were
  for (Index i = 0; i < s.cell_begin[1]; ++i) one.x[i] -= 2.1 * contacts.skin();
  EXPECT_FALSE(contacts.covers(one));  // towards the last ring, beyond the side, and away from the second
}

TEST(Images, are_refused_where_a_cell_reaches_over_too_many_boxes) {
  Sample s = ring_box({true, false});
  s.box.hi.x() = 0.1;
  EXPECT_THROW(Contacts(s, stiff(s), positions(s)), SolverError);
}

}  // namespace
}  // namespace lamella
