#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "generator/sample/errors.h"
#include "generator/tissue/bricks.h"
#include "generator/tissue/lattice.h"
#include "generator/tissue/notch.h"
#include "generator/tissue/walls.h"

namespace lamella {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

SampleScene asked(int columns, int rows, const char* periodic, const char* orientation = "pointy") {
  SampleScene scene;
  scene.kind = "honeycomb";
  scene.columns = columns, scene.rows = rows;
  scene.side = 1;
  scene.orientation = orientation;
  scene.periodic = periodic;
  return scene;
}

Sample made(const Mosaic& mosaic, double spacing = 0.2, double radius = 0.05) {
  Notes notes;
  WallsScene walls;
  walls.spacing = spacing;
  return make_tissue(mosaic, walls, radius, "cells", notes);
}

/// Another choice of home for some of the cells.
Mosaic rehomed(Mosaic mosaic) {
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c)
    for (Image& image : mosaic.cells[c].image) {
      if (mosaic.periodic[0]) image[0] = static_cast<std::int8_t>(image[0] + static_cast<int>(c % 3) - 1);
      if (mosaic.periodic[1]) image[1] = static_cast<std::int8_t>(image[1] + static_cast<int>(c % 5) - 2);
    }
  return mosaic;
}

std::vector<SampleScene> lattices() {
  std::vector<SampleScene> all;
  for (const char* orientation : {"pointy", "flat"})
    for (const int columns : {1, 2, 3, 4})
      for (const int rows : {1, 2, 3, 4})
        for (const char* periodic : {"x", "y", "xy"}) {
          const int lines = std::string(orientation) == "flat" ? columns : rows;
          const bool across = std::string(periodic).find(orientation[0] == 'f' ? 'x' : 'y') != std::string::npos;
          if (across && lines % 2 != 0) continue;
          all.push_back(asked(columns, rows, periodic, orientation));
        }
  return all;
}

TEST(PeriodicMosaic, of_hexagons_shares_every_wall_but_those_on_sides_that_do_not_repeat) {
  for (const SampleScene& scene : lattices()) {
    SCOPED_TRACE(scene.orientation + " " + scene.periodic + " " + std::to_string(scene.columns) + " x " +
                 std::to_string(scene.rows));
    const Mosaic mosaic = make_honeycomb(scene);
    const auto opposite = opposite_edges(mosaic);
    double shared = 0, free = 0;
    for (std::size_t c = 0; c < mosaic.cells.size(); ++c)
      for (std::size_t k = 0; k < 6; ++k) {
        const EdgePlace there = opposite[c][k];
        if (there.cell < 0) {
          ++free;
          continue;
        }
        ++shared;
        const MosaicCell &cell = mosaic.cells[c], &other = mosaic.cells[there.cell];
        const Vec2 off = displacement(there.image, mosaic.box);
        // The same edge the other way round, in place.
        EXPECT_LT((corner_of(mosaic, cell, k) - corner_of(mosaic, other, (there.edge + 1) % 6) - off).norm(), 1e-12);
        EXPECT_LT((corner_of(mosaic, cell, (k + 1) % 6) - corner_of(mosaic, other, there.edge) - off).norm(), 1e-12);
        const EdgePlace back = opposite[there.cell][there.edge];
        EXPECT_EQ(back.cell, static_cast<Index>(c));
        EXPECT_EQ(back.edge, static_cast<Index>(k));
        EXPECT_EQ(back.image + there.image, (Image{0, 0}));
        EXPECT_NE(comes_first(static_cast<Index>(c), there), comes_first(there.cell, back));
      }
    if (scene.periodic == "xy") {
      EXPECT_EQ(free, 0);
      // Euler on the torus: V - E + F = 0, and three edges meet at each vertex
      EXPECT_EQ(mosaic.vertices.size(), 2 * mosaic.cells.size());
      EXPECT_NEAR(mosaic.box.area(), 1.5 * std::sqrt(3.0) * static_cast<double>(mosaic.cells.size()), 1e-12);
    } else {
      EXPECT_GT(free, 0);
    }
    EXPECT_EQ(shared + free, 6.0 * static_cast<double>(mosaic.cells.size()));
  }
}

TEST(PeriodicMosaic, makes_a_sound_sample_wherever_its_cells_are_at_home) {
  for (const SampleScene& scene : lattices()) {
    SCOPED_TRACE(scene.orientation + " " + scene.periodic + " " + std::to_string(scene.columns) + " x " +
                 std::to_string(scene.rows));
    const Mosaic mosaic = make_honeycomb(scene);
    const Sample sample = made(mosaic), elsewhere = made(rehomed(mosaic));
    EXPECT_THAT(check_sample(sample), IsEmpty());
    EXPECT_THAT(check_sample(elsewhere), IsEmpty());
    ASSERT_EQ(sample.links.size(), elsewhere.links.size());
    EXPECT_EQ(sample.walls.size(), elsewhere.walls.size());
    double length = 0, length_elsewhere = 0;
    for (std::size_t l = 0; l < sample.links.size(); ++l) {
      length += sample.links[l].length, length_elsewhere += elsewhere.links[l].length;
      EXPECT_NEAR(sample.links[l].offset_n, 0.1, 1e-12);
      EXPECT_NEAR(elsewhere.links[l].offset_n, 0.1, 1e-12);
      EXPECT_NEAR(elsewhere.links[l].offset_t, 0, 1e-12);
    }
    EXPECT_NEAR(length, length_elsewhere, 1e-10);
    const double walls = static_cast<double>(sample.walls.size());
    EXPECT_NEAR(length, walls * (1 - 0.1 / std::sqrt(3.0)), 1e-10);  // each side of 1, less the inset at both ends
    if (scene.periodic == "xy") {
      EXPECT_EQ(walls, 3.0 * static_cast<double>(sample.cells()));
    }
  }
}

TEST(PeriodicMosaic, of_one_column_makes_every_cell_its_own_neighbour_and_the_next_row_twice) {
  const Sample sample = made(make_honeycomb(asked(1, 2, "xy")));
  std::map<std::pair<Index, Index>, std::set<Image>> images;
  for (std::size_t l = 0; l < sample.links.size(); ++l) {
    const Wall& wall = sample.walls[sample.links[l].wall];
    images[{wall.cell_a, wall.cell_b}].insert(sample.link_image[l]);
  }
  EXPECT_EQ(images.size(), 3u);
  EXPECT_EQ((images[{0, 0}]), (std::set<Image>{{1, 0}}));
  EXPECT_EQ((images[{1, 1}]), (std::set<Image>{{1, 0}}));
  EXPECT_EQ((images[{0, 1}].size()), 4u);  // two to the row above, two to that below
}

TEST(PeriodicMosaic, has_the_walls_of_a_larger_one_that_does_not_repeat) {
  const Sample periodic = made(make_honeycomb(asked(3, 4, "x")));
  const Sample plain = made(make_honeycomb(asked(9, 4, "none")));
  // Three periods beside each other have the columns' walls thrice, but for those that the two ends lack.
  int lost = 0;
  for (int row = 0; row < 4; ++row) ++lost;  // the wall between the last and the first cell of each row
  for (int row = 0; row < 3; ++row) ++lost;  // and a slanted one between two rows
  EXPECT_EQ(3 * periodic.walls.size(), plain.walls.size() + static_cast<std::size_t>(lost));
  // Cell for cell the shells are the same, displaced by whole pitches.
  const Index nodes = periodic.cell_size(0);
  for (Index row = 0; row < 4; ++row)
    for (Index k = 0; k < 3; ++k) {
      const Index a = 3 * row + k, b = 9 * row + 3 + k;
      ASSERT_EQ(periodic.cell_size(a), nodes);
      for (Index i = 0; i < nodes; ++i) {
        const Vec2 off = plain.x[plain.cell_begin[b] + i] - periodic.x[periodic.cell_begin[a] + i];
        EXPECT_NEAR((off - Vec2(3 * std::sqrt(3.0), 0)).norm(), 0, 1e-12);
      }
    }
}

TEST(PeriodicMosaic, has_sides_only_where_it_does_not_repeat) {
  const auto bits_of = [](const char* periodic) {
    int bits = 0;
    for (const std::uint8_t side : made(make_honeycomb(asked(4, 4, periodic))).side) bits |= side;
    return bits;
  };
  EXPECT_EQ(bits_of("none"), kLeft | kRight | kBottom | kTop);
  EXPECT_EQ(bits_of("x"), kBottom | kTop);
  EXPECT_EQ(bits_of("y"), kLeft | kRight);
  EXPECT_EQ(bits_of("xy"), 0);
}

TEST(PeriodicMosaic, asks_for_an_even_number_of_shifted_lines) {
  const auto message = [](const SampleScene& scene) {
    try {
      make_honeycomb(scene);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(message(asked(4, 3, "y")), HasSubstr("sample.rows: 3 hexagons"));
  EXPECT_THAT(message(asked(4, 3, "xy")), HasSubstr("such as 4"));
  EXPECT_EQ(message(asked(3, 3, "x")), "none");
  EXPECT_THAT(message(asked(3, 4, "x", "flat")), HasSubstr("sample.columns: 3 hexagons"));
  EXPECT_EQ(message(asked(4, 3, "y", "flat")), "none");
}

TEST(PeriodicMosaic, with_two_cells_on_the_same_side_of_a_wall_is_refused) {
  Mosaic mosaic = make_honeycomb(asked(2, 2, "xy"));
  mosaic.cells.push_back(mosaic.cells[0]);
  mosaic.cells.back().name = "intruder";
  for (Image& image : mosaic.cells.back().image) image[0] = static_cast<std::int8_t>(image[0] + 1);
  try {
    opposite_edges(mosaic);
    FAIL() << "not refused";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("they overlap"));
  }
}

SampleScene bricks(int columns, int rows, const char* periodic, double shift) {
  SampleScene scene;
  scene.kind = "bricks";
  scene.columns = columns, scene.rows = rows;
  scene.brick = {1.5, 0.5};
  scene.shift = shift;
  scene.periodic = periodic;
  return scene;
}

TEST(PeriodicBricks, fill_their_box_and_share_all_walls_but_those_on_sides_that_do_not_repeat) {
  for (const char* periodic : {"x", "y", "xy"})
    for (const double shift : {0.0, 0.5, 0.3})
      for (const int columns : {1, 2, 5})
        for (const int rows : {2, 4}) {
          SCOPED_TRACE(std::string(periodic) + " " + std::to_string(shift) + " " + std::to_string(columns) + " x " +
                       std::to_string(rows));
          const Mosaic mosaic = make_bricks(bricks(columns, rows, periodic, shift));
          double area = 0, free = 0, marked = 0;
          const auto opposite = opposite_edges(mosaic);
          for (std::size_t c = 0; c < mosaic.cells.size(); ++c) {
            const auto polygon = polygon_of(mosaic, mosaic.cells[c]);
            area += polygon_area(polygon.data(), static_cast<Index>(polygon.size()));
            for (std::size_t k = 0; k < polygon.size(); ++k) {
              const double length = (polygon[(k + 1) % polygon.size()] - polygon[k]).norm();
              EXPECT_GT(length, 0);
              if (opposite[c][k].cell < 0) free += length;
              if (mosaic.cells[c].side[k] != 0) marked += length;
            }
          }
          EXPECT_NEAR(area, mosaic.box.area(), 1e-12 * area);
          double open = 0;
          if (!mosaic.periodic[0]) open += 2 * mosaic.box.size().y();
          if (!mosaic.periodic[1]) open += 2 * mosaic.box.size().x();
          EXPECT_NEAR(free, open, 1e-12);
          EXPECT_NEAR(marked, open, 1e-12);
          EXPECT_THAT(check_sample(made(mosaic, 0.1, 0.02)), IsEmpty());
          EXPECT_THAT(check_sample(made(rehomed(mosaic), 0.1, 0.02)), IsEmpty());
          if (mosaic.periodic[0]) {
            EXPECT_EQ(mosaic.cells.size(), static_cast<std::size_t>(columns * rows));
          }
          // In brickwork three walls meet in each vertex: V = 2 F on the torus; in a grid four: V = F.
          if (mosaic.periodic[0] && mosaic.periodic[1]) {
            EXPECT_EQ(mosaic.vertices.size(), (shift > 0 ? 2u : 1u) * mosaic.cells.size());
          }
        }
}

TEST(PeriodicBricks, of_an_odd_number_of_shifted_rows_do_not_repeat_along_y) {
  EXPECT_THROW(make_bricks(bricks(2, 3, "y", 0.5)), SceneError);
  EXPECT_NO_THROW(make_bricks(bricks(2, 3, "y", 0.0)));
  EXPECT_NO_THROW(make_bricks(bricks(2, 3, "x", 0.5)));
  EXPECT_THROW(make_bricks(bricks(2, 2, "x", 1.5)), SceneError);
}

TEST(PeriodicNotch, cuts_the_same_wherever_the_box_begins) {
  const Mosaic mosaic = make_honeycomb(asked(6, 6, "x"));
  const double width = mosaic.box.size().x();
  const auto left_after = [&](const Mosaic& of, double shift) {
    Sample sample = made(of);
    Notes notes;
    cut_links({Vec2(-0.7 + shift, 4.8), Vec2(2.4 + shift, 4.8)}, sample, notes);
    EXPECT_EQ(sample.link_image.size(), sample.links.size());
    EXPECT_THAT(check_sample(sample), IsEmpty());
    return sample.links.size();
  };
  const std::size_t links = left_after(mosaic, 0);
  EXPECT_LT(links, made(mosaic).links.size());
  EXPECT_EQ(links, left_after(mosaic, width));
  EXPECT_EQ(links, left_after(rehomed(mosaic), 0));
}

TEST(PeriodicNotch, removes_the_same_cells_from_either_end_of_the_box) {
  const auto removed = [](double shift) {
    Mosaic mosaic = make_honeycomb(asked(6, 6, "x"));
    const double x = shift * mosaic.box.size().x();
    remove_cells_inside(mosaic, {{x - 1, 3}, {x + 2, 3}, {x + 2, 6}, {x - 1, 6}});
    std::set<std::string> names;
    for (const MosaicCell& cell : mosaic.cells) names.insert(cell.name);
    return names;
  };
  EXPECT_LT(removed(0).size(), 36u);
  EXPECT_EQ(removed(0), removed(1));
}

TEST(PeriodicSample, is_not_sound_with_a_wrong_image_or_one_missing) {
  const Sample sound = made(make_honeycomb(asked(3, 4, "x")));
  const auto fault = [&](const std::function<void(Sample&)>& spoil) {
    Sample sample = sound;
    spoil(sample);
    std::string all;
    for (const auto& violation : check_sample(sample)) all += violation + "\n";
    return all;
  };
  const auto crossing =
      std::find_if(sound.link_image.begin(), sound.link_image.end(), [](const Image& image) { return image[0] != 0; }) -
      sound.link_image.begin();
  EXPECT_THAT(fault([&](Sample& s) { s.link_image[crossing] = {0, 0}; }), HasSubstr("not free of force"));
  EXPECT_THAT(fault([&](Sample& s) { s.link_image[crossing][1] = 1; }), HasSubstr("where nothing repeats"));
  EXPECT_THAT(fault([&](Sample& s) { s.link_image.pop_back(); }), HasSubstr("links have images"));
  EXPECT_THAT(fault([&](Sample& s) { s.periodic = {false, false}; }), HasSubstr("links have images"));
  // One cell pushed half across the neighbour beyond the side of the box.
  EXPECT_THAT(fault([&](Sample& s) {
                s.links.clear(), s.link_image.clear();
                for (Index k = s.cell_begin[0]; k < s.cell_begin[1]; ++k) s.x[k].x() -= 0.5;
              }),
              HasSubstr("cross near"));
}

}  // namespace
}  // namespace lamella
