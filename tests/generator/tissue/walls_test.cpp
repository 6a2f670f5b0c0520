#include "generator/tissue/walls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "generator/sample/errors.h"
#include "generator/tissue/inset.h"
#include "generator/tissue/lattice.h"
#include "generator/tissue/notch.h"
#include "tests/generator/tissue/mosaics.h"

namespace lamella {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

WallsScene spaced(double spacing, double gap = 0) {
  WallsScene walls;
  walls.spacing = spacing;
  walls.gap = gap;
  return walls;
}

Sample make(const Mosaic& mosaic, const WallsScene& walls, double radius) {
  Notes notes;
  return make_tissue(mosaic, walls, radius, "cells", notes);
}

TEST(Walls, face_each_other_exactly_and_without_tangential_offset) {
  const Mosaic mosaic = voronoi(60, 1, 0.06);
  const double r = 0.004;
  Notes notes;
  const Bonding bonding = face_walls(mosaic, spaced(0.02, 0.001), r, notes);
  std::vector<Vec2> of_a(bonding.pairs.size()), of_b(bonding.pairs.size());
  std::vector<Index> owner(bonding.pairs.size(), -1);
  for (const FacingWall& wall : bonding.walls)
    for (Index p = wall.first; p < wall.first + wall.count; ++p) owner[p] = wall.cell_a;
  for (std::size_t c = 0; c < bonding.cells.size(); ++c)
    for (const OutlineNode& node : bonding.cells[c].nodes)
      if (node.pair >= 0) (owner[node.pair] == static_cast<Index>(c) ? of_a : of_b)[node.pair] = node.at;
  ASSERT_GT(bonding.walls.size(), 100u);
  for (const FacingWall& wall : bonding.walls)
    for (Index p = wall.first; p < wall.first + wall.count; ++p) {
      EXPECT_NEAR((of_b[p] - of_a[p]).dot(wall.direction), 0, 1e-12 * 0.02);
      EXPECT_NEAR((of_b[p] - of_a[p]).dot(right_of(wall.direction)), 2 * r + 0.001, 1e-12 * 0.02);
    }
}

TEST(Walls, of_cells_with_different_radii_face_each_other_at_the_sum_of_the_two) {
  Mosaic mosaic = voronoi(60, 1, 0.06);
  const double gap = 0.001;
  std::vector<double> radius;
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c) radius.push_back(0.001 * static_cast<double>(1 + c % 5));
  Notes notes;
  const Bonding bonding = face_walls(mosaic, spaced(0.02, gap), radius, notes);
  std::vector<Vec2> of_a(bonding.pairs.size()), of_b(bonding.pairs.size());
  std::vector<Index> owner(bonding.pairs.size(), -1);
  for (const FacingWall& wall : bonding.walls)
    for (Index p = wall.first; p < wall.first + wall.count; ++p) owner[p] = wall.cell_a;
  for (std::size_t c = 0; c < bonding.cells.size(); ++c)
    for (const OutlineNode& node : bonding.cells[c].nodes)
      if (node.pair >= 0) (owner[node.pair] == static_cast<Index>(c) ? of_a : of_b)[node.pair] = node.at;
  ASSERT_GT(bonding.walls.size(), 100u);
  std::set<double> distances;
  for (const FacingWall& wall : bonding.walls)
    for (Index p = wall.first; p < wall.first + wall.count; ++p) {
      const double apart = radius[wall.cell_a] + radius[wall.cell_b] + gap;
      EXPECT_NEAR((of_b[p] - of_a[p]).dot(wall.direction), 0, 1e-12 * 0.02);
      EXPECT_NEAR((of_b[p] - of_a[p]).dot(right_of(wall.direction)), apart, 1e-12 * 0.02);
      distances.insert(apart);
    }
  EXPECT_GT(distances.size(), 5u);
}

TEST(Walls, take_radius_and_group_from_their_cells_and_keep_factors_that_are_not_one) {
  Mosaic mosaic = squares(3, 1);
  mosaic.cells[0].group = mosaic.cells[2].group = "stiff";
  const auto radius_of = [](const std::string& group) { return group == "stiff" ? 0.1 : 0.05; };
  Notes notes;
  const Sample plain = make_tissue(mosaic, spaced(0.1), radius_of, notes);
  EXPECT_EQ(plain.group_names, (std::vector<std::string>{"stiff", "cells"}));
  EXPECT_EQ(plain.group, (std::vector<Index>{0, 1, 0}));
  EXPECT_EQ(plain.radius, (std::vector<double>{0.1, 0.05, 0.1}));
  EXPECT_TRUE(plain.cell_thickness.empty()) << "nothing varies: nothing is stored";
  for (const Link& link : plain.links) EXPECT_NEAR(link.offset_n, 0.15, 1e-14);
  mosaic.cells[1].thickness = 3;
  const Sample thick = make_tissue(mosaic, spaced(0.1), radius_of, notes);
  EXPECT_EQ(thick.cell_thickness, (std::vector<double>{1, 3, 1}));
  for (const Link& link : thick.links) EXPECT_NEAR(link.offset_n, 0.25, 1e-14);
  EXPECT_THAT(check_sample(thick), IsEmpty());
  EXPECT_NEAR(thick.rest_area[1], 0.7 * 0.7, 1e-14);
}

TEST(Walls, of_an_irregular_tissue_make_a_sound_sample) {
  for (const double spacing : {0.01, 0.03, 0.06}) {
    for (const double r : {0.0005, 0.003, 0.01}) {
      const Sample sample = make(voronoi(60, 2, 0.06), spaced(spacing), r);
      EXPECT_THAT(check_sample(sample), IsEmpty()) << "spacing " << spacing << " r " << r;
      EXPECT_EQ(sample.cells(), 60);
      double tiles = 0;
      for (const double a : sample.tile_area) tiles += a;
      EXPECT_NEAR(tiles, 1, 1e-8);
    }
  }
}

TEST(Walls, share_their_overlap_out_to_their_links) {
  const Mosaic mosaic = voronoi(60, 4, 0.06);
  Notes notes;
  const Bonding bonding = face_walls(mosaic, spaced(0.02), 0.004, notes);
  const Sample sample = make(mosaic, spaced(0.02), 0.004);
  std::vector<double> shared(sample.walls.size(), 0);
  for (const Link& link : sample.links) shared[link.wall] += link.length;
  for (std::size_t w = 0; w < sample.walls.size(); ++w) {
    EXPECT_LT(shared[w], sample.walls[w].length * (1 + 1e-12));
    double overlap = 0;
    for (Index p = bonding.walls[w].first; p < bonding.walls[w].first + bonding.walls[w].count; ++p)
      overlap += bonding.pairs[p].length;
    EXPECT_NEAR(shared[w], overlap, 1e-14);
  }
}

TEST(Walls, have_no_segment_shorter_than_a_quarter_of_the_spacing_beside_a_corner) {
  const Sample sample = make(voronoi(60, 6, 0.06), spaced(0.02), 0.004);
  for (Index k = 0; k < sample.nodes(); ++k) EXPECT_GT(sample.rest_length[k], 0.2 * 0.02);
}

TEST(Walls, take_only_segments_of_the_linked_wall_into_the_tangent) {
  const Mosaic mosaic = voronoi(60, 1, 0.06);
  Notes notes;
  const Bonding bonding = face_walls(mosaic, spaced(0.01), 0.003, notes);
  const Sample sample = make(mosaic, spaced(0.01), 0.003);
  int ends = 0;
  const double slack = 0.12;  // two corners that merge pull the end of a wall off its line, by an eighth of a spacing
  for (const Link& link : sample.links) {
    const Vec2 direction = bonding.walls[link.wall].direction;
    if (bonding.walls[link.wall].count < 3) continue;
    EXPECT_NEAR(cross((sample.x[link.a_next] - sample.x[link.a_prev]).normalized(), direction), 0, slack);
    EXPECT_NEAR(cross((sample.x[link.b_next] - sample.x[link.b_prev]).normalized(), direction), 0, slack);
    if (link.wall_end) {
      ++ends;
      EXPECT_TRUE(link.a_prev == link.a || link.a_next == link.a);
      EXPECT_TRUE(link.b_prev == link.b || link.b_next == link.b);
    } else {
      EXPECT_EQ(link.a_next, sample.next(sample.walls[link.wall].cell_a, link.a));
    }
  }
  EXPECT_GT(ends, 100);
}

TEST(Walls, of_two_squares_are_where_arithmetic_puts_them) {
  const Sample sample = make(squares(2, 1), spaced(0.4), 0.1);
  ASSERT_EQ(sample.walls.size(), 1u);
  ASSERT_EQ(sample.links.size(), 3u);  // 0.8 in two segments of 0.4
  EXPECT_EQ(sample.nodes(), 2 * 8);
  const double y[3] = {0.1, 0.5, 0.9};
  const double length[3] = {0.2, 0.4, 0.2};
  for (int k = 0; k < 3; ++k) {
    const Link& link = sample.links[k];
    EXPECT_NEAR((sample.x[link.a] - Vec2(0.9, y[k])).norm(), 0, 1e-15);
    EXPECT_NEAR((sample.x[link.b] - Vec2(1.1, y[k])).norm(), 0, 1e-15);
    EXPECT_NEAR(link.length, length[k], 1e-15);
    EXPECT_NEAR(link.spacing, 0.4, 1e-15);
    EXPECT_NEAR(link.offset_n, 0.2, 1e-15);
    EXPECT_NEAR(link.offset_t, 0, 1e-15);
    EXPECT_EQ(link.wall_end, k == 1 ? 0 : 1);
  }
  for (const double area : sample.rest_area) EXPECT_NEAR(area, 0.64, 1e-15);
  for (const double area : sample.tile_area) EXPECT_NEAR(area, 1, 1e-15);
  int bottom = 0;
  for (Index k = 0; k < sample.nodes(); ++k)
    if (sample.side[k] & kBottom) {
      ++bottom;
      EXPECT_NEAR(sample.x[k].y(), 0.1, 1e-15);
    }
  EXPECT_EQ(bottom, 6);  // all nodes of both bottom walls, corners included
}

TEST(Walls, are_linked_only_where_the_scene_asks) {
  WallsScene walls = spaced(0.2);
  walls.links = "ends";
  const Sample ends = make(squares(2, 1), walls, 0.1);
  ASSERT_EQ(ends.links.size(), 2u);
  EXPECT_NEAR(ends.links[0].length, 0.4, 1e-15);
  EXPECT_NEAR(ends.links[0].spacing, 0.8, 1e-15);
  EXPECT_EQ(ends.links[0].wall_end, 1);
  EXPECT_THAT(check_sample(ends), IsEmpty());
  walls.links = "none";
  EXPECT_TRUE(make(squares(2, 1), walls, 0.1).links.empty());
}

TEST(Walls, have_as_many_segments_on_a_mean_wall_as_asked) {
  for (const int segments : {1, 2, 5}) {
    WallsScene walls;
    walls.segments = segments;
    EXPECT_EQ(make(squares(2, 2), walls, 0.05).nodes(), 4 * 4 * segments);
  }
}

/// Two cells whose inset sides end `extra` apart along their wall: the right one is a trapezium.
Mosaic unequal(double slope) {
  Mosaic mosaic;
  mosaic.vertices = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, -slope}, {2, 1 + slope}};
  mosaic.box = {Vec2(0, -slope), Vec2(2, 1 + slope)};
  mosaic.cells = {{{0, 1, 2, 3}, {0, 0, 0, 0}, "left", {}}, {{1, 4, 5, 2}, {0, 0, 0, 0}, "right", {}}};
  return mosaic;
}

TEST(Walls, keep_a_corner_beyond_a_quarter_spacing_and_merge_a_nearer_one) {
  // Left side retreats by r at each end, the right one by r tan(turn/2), less by d at each end.
  const double r = 0.1;
  const double slope = 0.5;
  const double turn = std::atan(slope);
  const double right_retreat = r * std::tan((std::numbers::pi / 2 - turn) / 2);
  const double d = r - right_retreat;
  const double overlap = 1 - 2 * r;
  // One segment on the wall: a spacing for which d is 0.24 or 0.26 of it.
  for (const double fraction : {0.24, 0.26}) {
    const double spacing = d / fraction;
    const Sample sample = make(unequal(slope), spaced(spacing), r);
    EXPECT_THAT(check_sample(sample), IsEmpty());
    const bool merged = fraction < 0.25;
    const Link& first = sample.links.front();
    EXPECT_NEAR(first.offset_n, 2 * r, 1e-14);
    EXPECT_NEAR(first.offset_t, merged ? -d : 0, 1e-14) << "the pair is oblique when merged";
    const Link& last = sample.links.back();
    EXPECT_NEAR(last.offset_t, merged ? d : 0, 1e-14);
    double total = 0;
    for (const Link& link : sample.links) total += link.length;
    EXPECT_NEAR(total, overlap, 1e-14);
    const double corner_y = right_retreat;
    int at_corner = 0;
    for (const Vec2& x : sample.x) at_corner += (x - Vec2(1 + r, corner_y)).norm() < 1e-12 ? 1 : 0;
    EXPECT_EQ(at_corner, 1);
  }
}

TEST(Walls, of_concave_cells_do_not_cross_where_a_short_edge_beside_a_reflex_corner_is_merged) {
  // The first cell has a reflex corner at (23, 44) and a convex one 1 above: closer than a quarter of most spacings here, and far
  // apart beside the inset of 0.1. The second cell lies beyond the edge to (27, 38).
  Mosaic mosaic;
  mosaic.vertices = {{23, 44}, {23, 45}, {21, 44}, {5, 20}, {21, 4}, {27, 38}, {49, 25}, {78, 42}, {75, 48}};
  mosaic.box = {Vec2(0, 0), Vec2(80, 50)};
  mosaic.cells = {{{0, 1, 2, 3, 4, 5}, {0, 0, 0, 0, 0, 0}, "first", {}},
                  {{7, 8, 0, 5, 6}, {0, 0, 0, 0, 0}, "second", {}}};
  for (double spacing = 3.5; spacing < 12; spacing += 0.25) {
    const Sample sample = make(mosaic, spaced(spacing), 0.1);
    EXPECT_EQ(sample.walls.size(), 1u);
    EXPECT_THAT(check_sample(sample), IsEmpty()) << spacing;
  }
}

TEST(Walls, refuse_cells_that_vanish_and_name_them) {
  Notes notes;
  try {
    make_tissue(squares(2, 1), spaced(0.2), 0.5, "cells", notes);
    FAIL() << "no error";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("square 0,0"));
    EXPECT_THAT(error.what(), HasSubstr("vanish"));
  }
}

TEST(Walls, refuse_cells_whose_own_radius_is_too_large_and_say_what_would_do) {
  Mosaic mosaic = squares(3, 1);
  mosaic.cells[1].thickness = 6;
  Notes notes;
  try {
    make_tissue(
        mosaic, spaced(0.2), [](const std::string&) { return 0.1; }, notes);
    FAIL() << "no error";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("square 1,0 vanish when walls move in by radius + gap / 2 = 0.6 m; at most 0.5 m"));
  }
}

TEST(Walls, refuse_a_spacing_that_no_machine_can_hold) {
  Notes notes;
  EXPECT_THROW(make_tissue(squares(2, 1), spaced(1e-12), 0.1, "cells", notes), SceneError);
}

TEST(Walls, refuse_a_spacing_too_coarse_for_a_shell) {
  Notes notes;
  EXPECT_THROW(make_tissue(squares(2, 1), spaced(50), 0.1, "cells", notes), SceneError);
}

TEST(Walls, report_edges_that_vanish_and_walls_with_one_side) {
  Notes notes;
  const Sample sample = make_tissue(voronoi(60, 2, 0.06), spaced(0.02), 0.015, "cells", notes);
  EXPECT_THAT(notes, ::testing::Contains(HasSubstr("edges vanish by the inset: edge")));
  EXPECT_THAT(notes, ::testing::Contains(HasSubstr("shortest segment")));
  EXPECT_THAT(check_sample(sample), IsEmpty());
}

TEST(Walls, between_the_same_two_cells_over_a_bend_are_one_wall) {
  Mosaic mosaic;  // a common wall with a kink at (1.1, 0.5)
  mosaic.vertices = {{0, 0}, {1, 0}, {1.1, 0.5}, {1, 1}, {0, 1}, {2, 0}, {2, 1}};
  mosaic.box = {Vec2::Zero(), Vec2(2, 1)};
  mosaic.cells = {{{0, 1, 2, 3, 4}, {0, 0, 0, 0, 0}, "left", {}}, {{1, 5, 6, 3, 2}, {0, 0, 0, 0, 0}, "right", {}}};
  const Sample sample = make(mosaic, spaced(0.1), 0.02);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  ASSERT_EQ(sample.walls.size(), 1u);
  EXPECT_NEAR(sample.walls[0].length, 2 * std::hypot(0.1, 0.5), 1e-14);
  int ends = 0;
  for (const Link& link : sample.links) ends += link.wall_end;
  EXPECT_EQ(ends, 2);
  double total = 0;
  for (const Link& link : sample.links) total += link.length;
  EXPECT_GT(total, 0.93);
}

SampleScene hexagons(int columns, int rows, const std::string& orientation, int segments) {
  SampleScene scene;
  scene.kind = "honeycomb";
  scene.columns = columns;
  scene.rows = rows;
  scene.side = 2;
  scene.orientation = orientation;
  scene.walls.segments = segments;
  scene.walls.gap = 0.002;
  return scene;
}

TEST(Honeycomb, has_links_at_all_facing_nodes_three_at_each_inner_corner) {
  for (const char* orientation : {"pointy", "flat"}) {
    for (const int segments : {1, 2, 4}) {
      const SampleScene scene = hexagons(5, 4, orientation, segments);
      const Mosaic mosaic = make_honeycomb(scene);
      const Sample sample = make(mosaic, scene.walls, 0.05);
      EXPECT_THAT(check_sample(sample), IsEmpty());
      EXPECT_EQ(sample.cells(), 20);
      EXPECT_EQ(sample.nodes(), 20 * 6 * segments);
      // Euler: each row of 5 has 4 inner walls, each of the 3 pairs of rows 9.
      const int across = orientation == std::string("pointy") ? 4 * 4 + 3 * 9 : 5 * 3 + 4 * 7;
      ASSERT_EQ(sample.walls.size(), static_cast<std::size_t>(across));
      EXPECT_EQ(sample.links.size(), sample.walls.size() * static_cast<std::size_t>(segments + 1));
      const double inner = 2 - 2 * (0.05 + 0.001) / std::sqrt(3.0);  // side of the inset hexagon
      for (const Link& link : sample.links) {
        EXPECT_NEAR(link.offset_n, 0.102, 1e-13);
        EXPECT_NEAR(link.offset_t, 0, 1e-13);
        EXPECT_NEAR(link.spacing, inner / segments, 1e-13);
        EXPECT_NEAR(link.length, inner / segments / (link.wall_end ? 2 : 1), 1e-13);
      }
      for (const double l : sample.rest_length) EXPECT_NEAR(l, inner / segments, 1e-13);
      for (const double a : sample.tile_area) EXPECT_NEAR(a, 1.5 * std::sqrt(3.0) * 4, 1e-12);
      for (const double a : sample.rest_area) EXPECT_NEAR(a, 1.5 * std::sqrt(3.0) * inner * inner, 1e-12);
    }
  }
}

TEST(Honeycomb, marks_the_outer_walls_of_all_four_sides) {
  for (const char* orientation : {"pointy", "flat"}) {
    const SampleScene scene = hexagons(6, 6, orientation, 1);
    const Sample sample = make(make_honeycomb(scene), scene.walls, 0.05);
    const auto cell = cell_of_node(sample);
    for (const auto& [bit, cells] :
         std::vector<std::pair<int, int>>{{kLeft, 6}, {kRight, 6}, {kBottom, 6}, {kTop, 6}}) {
      std::set<Index> marked;
      for (Index k = 0; k < sample.nodes(); ++k)
        if (sample.side[k] & bit) marked.insert(cell[k]);
      EXPECT_EQ(static_cast<int>(marked.size()), cells) << orientation << " side " << bit;
    }
  }
}

TEST(Notch, line_parts_the_cells_on_its_two_sides) {
  Sample sample = make(squares(6, 4), spaced(0.25), 0.05);
  const std::size_t before = sample.links.size();
  Notes notes;
  cut_links({Vec2(-1, 2), Vec2(3, 2)}, sample, notes);  // between the second and third row, three cells long
  EXPECT_EQ(before - sample.links.size(), 3u * 5u);
  EXPECT_EQ(sample.walls.size(), 6u * 3u + 5u * 4u) << "walls stay";
  EXPECT_THAT(check_sample(sample), IsEmpty());
  EXPECT_THROW(cut_links({Vec2(10, 10), Vec2(11, 10)}, sample, notes), SceneError);
}

TEST(Notch, polygon_takes_cells_away_and_frees_their_neighbours) {
  Mosaic mosaic = squares(5, 5);
  EXPECT_EQ(remove_cells_inside(mosaic, {Vec2(-1, 2), Vec2(3, 2), Vec2(3, 3), Vec2(-1, 3)}), 3);
  const Sample sample = make(mosaic, spaced(0.25), 0.05);
  EXPECT_EQ(sample.cells(), 22);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  EXPECT_EQ(sample.walls.size(), 40u - 3u * 2u - 3u);
}

TEST(Order, of_cells_is_by_rows) {
  Mosaic mosaic = squares(4, 3);
  std::reverse(mosaic.cells.begin(), mosaic.cells.end());
  order_by_rows(mosaic);
  EXPECT_EQ(mosaic.cells[0].name, "square 0,0");
  EXPECT_EQ(mosaic.cells[5].name, "square 1,1");
  EXPECT_EQ(mosaic.cells[11].name, "square 3,2");
}

TEST(Overlap, of_two_cells_on_one_side_of_a_wall_is_named) {
  Mosaic mosaic = squares(2, 1);
  mosaic.cells.push_back(mosaic.cells[0]);
  mosaic.cells.back().name = "copy";
  EXPECT_THROW(opposite_edges(mosaic), SceneError);
}

}  // namespace
}  // namespace lamella
