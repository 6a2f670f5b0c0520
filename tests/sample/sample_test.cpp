#include "generator/sample/sample.h"

#include <gtest/gtest.h>

#include <numbers>

namespace lamella {
namespace {

TEST(Sample, turns_closed_cells_counter_clockwise) {
  Sample sample;
  add_cell(sample, {{0, 0}, {0, 2}, {3, 2}, {3, 0}}, true, 0.1, "cells");
  EXPECT_EQ(polygon_area(sample.x.data(), 4), 6);
  EXPECT_EQ(sample.rest_area[0], 6);
  EXPECT_EQ(sample.rest_length[0] + sample.rest_length[1], 5);
}

TEST(Sample, has_turning_angles_that_sum_to_one_turn) {
  Sample sample;
  add_cell(sample, {{0, 0}, {4, 1}, {3, 2}, {5, 5}, {0, 3}}, true, 0.1, "cells");
  double sum = 0;
  for (const double angle : sample.rest_angle) sum += angle;
  EXPECT_NEAR(sum, 2 * std::numbers::pi, 1e-14);
  double length = 0;
  double hinges = 0;
  for (Index k = 0; k < sample.nodes(); ++k) {
    length += sample.rest_length[k];
    hinges += sample.hinge_length[k];
  }
  EXPECT_NEAR(length, hinges, 1e-14);
}

TEST(Sample, has_no_hinge_at_the_ends_of_a_chain_and_no_segment_behind_its_last_node) {
  Sample sample;
  add_cell(sample, {{0, 0}, {1, 0}, {2, 0}}, true, 0.1, "cells");
  const Index chain = add_cell(sample, {{0, 0}, {1, 0}, {1, 3}}, false, 0.2, "beams");
  const Index first = sample.cell_begin[chain];
  EXPECT_EQ(sample.segments(chain), 2);
  EXPECT_EQ(sample.hinge_length[first], 0);
  EXPECT_EQ(sample.hinge_length[first + 1], 2);
  EXPECT_NEAR(sample.rest_angle[first + 1], std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(sample.hinge_length[first + 2], 0);
  EXPECT_EQ(sample.rest_length[first + 2], 0);
  EXPECT_EQ(sample.rest_area[chain], 0);
  EXPECT_EQ(sample.group_names, (std::vector<std::string>{"cells", "beams"}));
  EXPECT_EQ(sample.group, (std::vector<Index>{0, 1}));
  EXPECT_EQ(cell_of_node(sample), (std::vector<Index>{0, 0, 0, 1, 1, 1}));
}

TEST(Sample, keeps_the_area_of_a_small_cell_far_away) {
  const std::vector<Vec2> square{{1e6, 1e6}, {1e6 + 0.5, 1e6}, {1e6 + 0.5, 1e6 + 0.5}, {1e6, 1e6 + 0.5}};
  EXPECT_EQ(polygon_area(square.data(), 4), 0.25);
}

TEST(TurningAngle, is_positive_to_the_left_and_pi_when_it_turns_back) {
  EXPECT_NEAR(turning_angle({0, 0}, {1, 0}, {2, 1}), std::numbers::pi / 4, 1e-15);
  EXPECT_NEAR(turning_angle({0, 0}, {1, 0}, {2, -1}), -std::numbers::pi / 4, 1e-15);
  EXPECT_EQ(turning_angle({0, 0}, {1, 0}, {0, 0}), std::numbers::pi);
}

}  // namespace
}  // namespace lamella
