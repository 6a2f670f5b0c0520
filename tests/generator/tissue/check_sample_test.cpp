// Every invariant of a sample, broken on purpose: the check must say so, in words that name what is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "generator/generate.h"
#include "generator/tissue/crossings.h"
#include "tests/support/samples.h"

namespace lamella {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Break {
  const char* says;
  std::function<void(Sample&)> change;
};

const std::vector<Break> kBreaks{
    {"cell_begin does not divide", [](Sample& s) { s.cell_begin[1] = 100; }},
    {"an array per node does not have 32 entries", [](Sample& s) { s.rest_angle.pop_back(); }},
    {"an array per cell does not have 2 entries", [](Sample& s) { s.radius.push_back(1); }},
    {"link_image has 2 entries for 5 links", [](Sample& s) { s.link_image.resize(2); }},
    {"link_strength has 4 entries for 5 links", [](Sample& s) { s.link_strength.assign(4, 1); }},
    {"cell_thickness has 1 entries for 2 cells", [](Sample& s) { s.cell_thickness.assign(1, 1); }},
    {"the box runs from", [](Sample& s) { std::swap(s.box.lo, s.box.hi); }},
    {"cell 1: group 1 does not exist", [](Sample& s) { s.group[1] = 1; }},
    {"cell 1: radius -1", [](Sample& s) { s.radius[1] = -1; }},
    {"cell 1: a factor 0 on its wall's thickness",
     [](Sample& s) {
       s.cell_thickness = {1, 0};
     }},
    {"cell 0: its nodes do not run counter-clockwise", [](Sample& s) { std::reverse(s.x.begin(), s.x.begin() + 16); }},
    {"cell 0: rest area 0", [](Sample& s) { s.rest_area[0] = 0; }},
    {"cell 0: its tile 0.5 m2 is smaller than its rest area", [](Sample& s) { s.tile_area[0] = 0.5; }},
    {"more than the box", [](Sample& s) { s.tile_area[0] = s.tile_area[1] = 1.3; }},
    {"node 3 of cell 0: position not finite", [](Sample& s) { s.x[3].y() = NAN; }},
    {"segment 3 of cell 0: rest length 0", [](Sample& s) { s.rest_length[3] = 0; }},
    {"segment 1 of cell 0 has no length", [](Sample& s) { s.x[2] = s.x[1]; }},
    {"node 2 of cell 0: rest angle inf", [](Sample& s) { s.rest_angle[2] = INFINITY; }},
    {"node 2 of cell 0: hinge length -1", [](Sample& s) { s.hinge_length[2] = -1; }},
    {"wall 0: is between cells 0 and 2", [](Sample& s) { s.walls[0].cell_b = 2; }},
    {"wall 0: is between cells 1 and 0; a wall has two sides",
     [](Sample& s) {
       s.walls[0] = {1, 0, 1};
     }},
    {"wall 0: is between cells 0 and 0", [](Sample& s) { s.walls[0].cell_b = 0; }},
    {"wall 0: length nan m", [](Sample& s) { s.walls[0].length = NAN; }},
    {"wall 0: its links stand for 1 m, more than its length 0.9 m", [](Sample& s) { s.walls[0].length = 0.9; }},
    {"link 2: names a node or wall that does not exist", [](Sample& s) { s.links[2].b = 32; }},
    {"link 2: names a node or wall that does not exist", [](Sample& s) { s.links[2].wall = -1; }},
    {"link 3: links are not sorted by wall",
     [](Sample& s) {
       s.walls.push_back(s.walls[0]);
       s.links[2].wall = 1;
     }},
    {"link 2: joins cells 1 and 0", [](Sample& s) { std::swap(s.links[2].a, s.links[2].b); }},
    {"link 2: its tangent leaves its cells", [](Sample& s) { s.links[2].a_next = 20; }},
    {"link 2: tributary length -0.25 m", [](Sample& s) { s.links[2].length = -0.25; }},
    {"link 2: tributary length 0.25 m, spacing 0 m", [](Sample& s) { s.links[2].spacing = 0; }},
    {"link 2: its tangent has no direction",
     [](Sample& s) {
       s.links[2].a_prev = s.links[2].a_next = s.links[2].a;
       s.links[2].b_prev = s.links[2].b_next = s.links[2].b;
     }},
    {"link 2: its normal does not point from a to b",
     [](Sample& s) {
       std::swap(s.links[2].a_prev, s.links[2].a_next);
       std::swap(s.links[2].b_prev, s.links[2].b_next);
     }},
    {"link 2: not free of force where it is", [](Sample& s) { s.links[2].offset_t = 1e-6; }},
    {"link 2: not free of force where it is", [](Sample& s) { s.links[2].offset_n *= 1 + 1e-6; }},
    {"link 2: not free of force where it is",
     [](Sample& s) {
       s.periodic = {true, false};
       s.link_image.assign(5, {0, 0});
       s.link_image[2] = {1, 0};
     }},
    {"link 2: reaches an image along y, where nothing repeats",
     [](Sample& s) {
       s.periodic = {true, false};
       s.link_image.assign(5, {0, 0});
       s.link_image[2] = {0, 1};
     }},
    {"link 2: a factor 0 on its strength",
     [](Sample& s) {
       s.link_strength = {1, 1, 0, 1, 1};
     }},
    {"link 5: a second link between nodes", [](Sample& s) { s.links.push_back(s.links[4]); }},
    {"cell 0 crosses itself",
     [](Sample& s) {
       s.x[2].y() = 1.5;
       s.links.clear();
     }},
    {"cells 0 and 1 cross",
     [](Sample& s) {
       s.links.clear();
       for (int k = 16; k < 32; ++k) s.x[k] -= Vec2(0.02, 0.2);
     }},
};

TEST(CheckSample, finds_nothing_wrong_with_a_sound_sample) {
  EXPECT_THAT(check_sample(two_bonded_squares()), IsEmpty());
  EXPECT_THAT(check_sample(ring_sample(12)), IsEmpty());
}

TEST(CheckSample, says_what_is_broken) {
  for (const Break& broken : kBreaks) {
    Sample sample = two_bonded_squares();
    broken.change(sample);
    EXPECT_THAT(check_sample(sample), Contains(HasSubstr(broken.says)));
  }
}

TEST(CheckSample, says_when_tiles_do_not_fill_what_they_should) {
  Sample sample = two_bonded_squares();
  EXPECT_THAT(check_sample(sample, sample.box.area()), IsEmpty());
  sample.tile_area[0] *= 1 - 1e-6;
  EXPECT_THAT(check_sample(sample), IsEmpty()) << "less than the box may be meant";
  EXPECT_THAT(check_sample(sample, sample.box.area()), Contains(HasSubstr("they must fill 2.42 m2")));
}

TEST(CheckSample, lists_the_first_of_many_and_counts_the_rest) {
  Sample sample = ring_sample(60);
  for (double& length : sample.rest_length) length = -1;
  const auto found = check_sample(sample);
  EXPECT_EQ(found.size(), 21u);
  EXPECT_EQ(found.back(), "... and 40 more like it");
}

TEST(CheckSample, of_a_periodic_sample_looks_across_its_sides) {
  // Two squares of side 1 beside each other in a box that repeats after 2.2 m: room for both. After 1.9 m: none.
  Sample sample;
  sample.box = {{0, 0}, {2.2, 2}};
  sample.periodic = {true, false};
  for (const double left : {0.0, 1.1})
    add_cell(sample, {{left, 0.5}, {left + 1, 0.4}, {left + 1, 1.5}, {left, 1.4}}, true, 0.01, "cells");
  EXPECT_THAT(check_sample(sample), IsEmpty());
  sample.box.hi.x() = 1.9;
  EXPECT_THAT(check_sample(sample), Contains(HasSubstr("cells 1 and 0 cross")));
  // Moved by whole boxes a cell stands for the same.
  sample.box.hi.x() = 2.2;
  for (int k = 4; k < 8; ++k) sample.x[k].x() -= 2.2;
  EXPECT_THAT(check_sample(sample), IsEmpty());
}

TEST(FindCrossings, are_those_of_brute_force) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<OwnedSegment> segments;
  for (int k = 0; k < 400; ++k) {
    const Vec2 from(uniform(random), uniform(random));
    const double length = k % 20 == 0 ? 0.8 : 0.12;  // some long ones among many short
    segments.push_back({from, from + length * Vec2(uniform(random) - 0.5, uniform(random) - 0.5), k, -1, -1});
  }
  const auto left = [](const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a) > 0; };
  std::vector<std::pair<int, int>> expected, found;
  for (int j = 0; j < 400; ++j)
    for (int i = 0; i < j; ++i) {
      const OwnedSegment &s = segments[i], &t = segments[j];
      if (left(s.from, s.to, t.from) != left(s.from, s.to, t.to) &&
          left(t.from, t.to, s.from) != left(t.from, t.to, s.to))
        expected.emplace_back(i, j);
    }
  for (const Crossing& crossing : find_crossings(segments)) found.emplace_back(crossing.first, crossing.second);
  EXPECT_GT(expected.size(), 50u);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(find_crossings(segments, 7).size(), 7u) << "no more than asked for";
}

TEST(FindCrossings, do_not_depend_on_how_large_the_plane_is) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    const std::vector<OwnedSegment> cross_of{{{0, 0}, {scale, scale}, 0, -1, -1}, {{0, scale}, {scale, 0}, 1, -1, -1}};
    EXPECT_EQ(find_crossings(cross_of).size(), 1u);
  }
  const std::vector<OwnedSegment> flat{{{0, 0}, {1, 0}, 0, -1, -1}, {{2, 0}, {3, 0}, 1, -1, -1}};
  EXPECT_TRUE(find_crossings(flat).empty());
}

}  // namespace
}  // namespace lamella
