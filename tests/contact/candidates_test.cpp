#include <gtest/gtest.h>

#include "simulator/contact/candidates.h"
#include "tests/contact/shells.h"
#include "tests/support/samples.h"

namespace lamella {
namespace {

struct Rules {
  explicit Rules(const Sample& s, double skin)
      : cell_of(cell_of_node(s)), bare(s.cells(), 0), self(s), linked(s, cell_of), rules{s,    cell_of, bare,
                                                                                         self, linked,  skin} {}
  std::vector<Index> cell_of;
  std::vector<std::uint8_t> bare;
  SelfReach self;
  LinkedNodes linked;
  CandidateRules rules;
};

/// Every node against every segment: the oracle of the grid.
CandidateList brute_force(const CandidateRules& rules, const Field& x) {
  CandidateList list;
  const Sample& s = rules.sample;
  for (Index node = 0; node < s.nodes(); ++node) {
    if (rules.bare[rules.cell_of[node]]) continue;
    for (Index c = 0; c < s.cells(); ++c) {
      Pair pair{node, c, static_cast<Index>(list.segments.size()), 0};
      for (Index k = s.cell_begin[c]; k < s.cell_begin[c + 1]; ++k)
        if (s.starts_segment(c, k) && rules.candidates(x, node, c, k)) list.segments.push_back(k), ++pair.count;
      if (pair.count > 0) list.pairs.push_back(pair);
    }
  }
  return list;
}

void expect_equal(const CandidateList& a, const CandidateList& b) {
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  EXPECT_EQ(a.segments, b.segments);
  for (std::size_t k = 0; k < a.pairs.size(); ++k) {
    EXPECT_EQ(a.pairs[k].node, b.pairs[k].node);
    EXPECT_EQ(a.pairs[k].cell, b.pairs[k].cell);
    EXPECT_EQ(a.pairs[k].first, b.pairs[k].first);
    EXPECT_EQ(a.pairs[k].count, b.pairs[k].count);
  }
}

TEST(Candidates, of_two_hundred_cells_of_all_sizes_are_those_of_brute_force) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  Sample sample;
  for (int k = 0; k < 200; ++k) {
    const double size = std::pow(10, -uniform(random));  // 10:1
    add_ring(sample, {25 * uniform(random), 10 * uniform(random)}, size, 5 + k % 20,
             size * (0.02 + 0.1 * uniform(random)), uniform(random));
  }
  add_cell(sample, {{-1, -1}, {26, -1.2}}, false, 0.3, "cells");  // a long oblique plate
  Rules rules(sample, 0.07);
  rules.bare.back() = 1;
  const Field x = positions(sample);
  const CandidateList found = find_candidates(rules.rules, x);
  EXPECT_GT(found.pairs.size(), 500u);
  expect_equal(found, brute_force(rules.rules, x));
}

TEST(Candidates, are_found_when_the_pieces_have_flown_far_apart) {
  Sample sample = pile(3);
  Rules rules(sample, 0.1);
  Field x = positions(sample);
  for (Index i = sample.cell_begin[4]; i < sample.cell_begin[5]; ++i) x.x[i] += 1e7, x.y[i] -= 3e9;
  expect_equal(find_candidates(rules.rules, x), brute_force(rules.rules, x));
}

TEST(Candidates, of_a_bonded_tissue_are_none_while_its_links_are_intact) {
  const Sample sample = two_bonded_squares(8, 0.05);
  Rules rules(sample, 0.25 / 8);
  EXPECT_FALSE(find_candidates(rules.rules, positions(sample)).pairs.empty());
  for (Index l = 0; l < 9; ++l) rules.linked.set_intact(l, 1);
  EXPECT_TRUE(find_candidates(rules.rules, positions(sample)).pairs.empty());
}

TEST(Candidates, of_a_shell_with_itself_are_none_at_rest_even_where_it_is_thick_or_sharp) {
  Sample sample;
  add_ring(sample, {0, 0}, 1, 60, 0.3);
  add_cell(sample, {{3, 0}, {4, 0}, {5, 0}, {6, 0}, {5.4, 0.2}, {4.8, 0.4}, {4.2, 0.6}, {3.6, 0.8}}, true, 0.1,
           "cells");
  Rules rules(sample, 1e-9);
  EXPECT_TRUE(find_candidates(rules.rules, positions(sample)).pairs.empty());
}

}  // namespace
}  // namespace lamella
