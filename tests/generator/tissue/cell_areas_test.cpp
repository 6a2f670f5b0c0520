// Tissues whose cells, or their insides, have prescribed areas.
#include "generator/tissue/cell_areas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "generator/packing/random_sites.h"
#include "generator/packing/sizes.h"
#include "generator/packing/weld.h"
#include "generator/sample/errors.h"
#include "generator/tissue/inset_areas.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Scene tissue(int count, double cv = 0.3) {
  Scene scene;
  scene.stages.emplace_back();
  CellScene cells;
  cells.thickness = 0.1;  // r = 0.05, disks have a radius of about 1
  scene.stages.front().cells["cells"] = cells;
  scene.sample.packing.count = count;
  scene.sample.packing.fraction = 0.7;
  scene.sample.sizes.cv = cv;
  scene.sample.walls.segments = 3;
  scene.sample.areas = AreasScene{};
  return scene;
}

/// Largest relative difference of areas from what squared radii say, in the order of their sizes: cells are ordered anew.
double error_by_size(std::vector<double> areas, const Scene& scene) {
  std::vector<double> radii = draw_radii(scene.sample.sizes, scene.sample.packing.count, scene.seed, scene);
  std::sort(areas.begin(), areas.end());
  std::sort(radii.begin(), radii.end());
  double area = 0, square = 0, error = 0;
  for (const double a : areas) area += a;
  for (const double r : radii) square += r * r;
  for (std::size_t i = 0; i < areas.size(); ++i)
    error = std::max(error, std::abs(areas[i] / (radii[i] * radii[i] * area / square) - 1));
  return error;
}

std::vector<Vec2> polygon_of(const Tessellation& t, const Tile& tile) {
  std::vector<Vec2> polygon;
  for (std::size_t k = 0; k < tile.vertex.size(); ++k) polygon.push_back(corner(t, tile, k));
  return polygon;
}

std::string message_of(const Packing& packing, const AreasScene& areas, double distance) {
  Notes notes;
  try {
    tessellate_with_areas(packing, areas, {}, std::vector<double>(packing.disks.size(), distance), notes);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(InsetArea, is_that_of_the_tile_less_its_perimeter_and_corners_while_no_edge_vanishes) {
  // A(s) = A - s P + s^2 sum of tan(turn / 2): an equal-sided triangle, a rectangle, a regular pentagon.
  const std::vector<Vec2> rectangle = {{0, 0}, {3, 0}, {3, 1}, {0, 1}};
  EXPECT_NEAR(inset_area(rectangle, 0.2), 2.6 * 0.6, 1e-15);
  EXPECT_EQ(inset_area(rectangle, 0.5), 0);
  std::vector<Vec2> pentagon;
  for (int k = 0; k < 5; ++k) pentagon.emplace_back(std::cos(0.4 * M_PI * k), std::sin(0.4 * M_PI * k));
  const double area = 2.5 * std::sin(0.4 * M_PI), perimeter = 10 * std::sin(0.2 * M_PI), s = 0.3;
  EXPECT_NEAR(inset_area(pentagon, s), area - s * perimeter + s * s * 5 * std::tan(0.2 * M_PI), 1e-14);
}

TEST(InsetArea, changes_with_weights_as_what_the_inset_leaves_of_walls) {
  const std::vector<double> distance(40, 0.012);
  Packing packing;
  packing.box.hi = {1, 1};
  packing.disks.resize(40);
  scatter(packing, 5);
  std::vector<Vec2> sites;
  for (const Disk& disk : packing.disks) sites.push_back(disk.centre);
  const AreaProblem problem =
      inset_problem(tile_problem(packing.box, {true, true}, sites, std::vector<double>(40, 1.0)), distance);
  const std::vector<double> w(40, 0.0);
  const TileMeasures cells = problem.measure(sites, w);
  std::vector<std::vector<double>> slope(40, std::vector<double>(40, 0));
  for (const TileWall& wall : cells.walls) {  // each tile tells half of its own side
    const Vec2 away = sites[wall.b] + displacement(wall.image, packing.box) - sites[wall.a];
    slope[wall.a][wall.b] -= 2 * wall.length / (2 * away.norm());
    slope[wall.a][wall.a] += 2 * wall.length / (2 * away.norm());
  }
  for (std::size_t j = 0; j < 40; ++j) {
    std::vector<double> up = w, down = w;
    up[j] += 1e-7, down[j] -= 1e-7;
    const TileMeasures more = problem.measure(sites, up), less = problem.measure(sites, down);
    for (std::size_t i = 0; i < 40; ++i) {
      if (cells.area[i] == 0) continue;  // thinner than its walls
      EXPECT_NEAR((more.area[i] - less.area[i]) / 2e-7, slope[i][j], 1e-5) << i << " " << j;
    }
  }
}

TEST(CellAreas, are_those_of_the_sample) {
  for (const char* sites : {"packing", "random"}) {
    SCOPED_TRACE(sites);
    Scene scene = tissue(150);
    scene.sample.areas->sites = sites;
    scene.sample.areas->sweeps = 5;
    scene.sample.walls.weld = 0;
    Notes notes;
    const Sample sample = generate(scene, notes);
    EXPECT_LE(error_by_size(sample.tile_area, scene), 1e-9);
    EXPECT_THAT(check_sample(sample), IsEmpty());
    EXPECT_THAT(notes, Contains(HasSubstr("150 tiles as prescribed")));
    EXPECT_THAT(notes, Contains(HasSubstr("5 sweeps")));
  }
}

TEST(CellAreas, without_the_section_are_those_of_the_disks_tiles) {
  Scene scene = tissue(60);
  scene.sample.areas.reset();
  Notes notes;
  EXPECT_GT(error_by_size(generate(scene, notes).tile_area, scene), 0.01);
}

TEST(CellAreas, of_insets_are_those_inside_the_walls) {
  for (const double cv : {1e-9, 0.3})
    for (const char* sites : {"packing", "random"}) {
      SCOPED_TRACE(testing::Message() << sites << ", CV " << cv);
      Scene scene = tissue(150, cv);
      scene.sample.areas->of = "inset";
      scene.sample.areas->sites = sites;
      scene.sample.areas->sweeps = 10;
      Notes notes;
      const Packing packing = make_packing(scene);
      const CellAreas made =
          tessellate_with_areas(packing, *scene.sample.areas, {}, std::vector<double>(150, 0.08), notes);
      std::vector<double> insets;
      double tiles = 0;
      for (const Tile& tile : made.tessellation.tiles) {
        insets.push_back(inset_area(polygon_of(made.tessellation, tile), 0.08));
        tiles += tile_area(made.tessellation, tile);
      }
      EXPECT_LE(error_by_size(insets, scene), 1e-9);
      EXPECT_NEAR(tiles / packing.box.area(), 1, 1e-12);  // tiles still fill the box
      EXPECT_THAT(notes, Contains(HasSubstr("150 insets as prescribed")));
    }
}

TEST(CellAreas, of_insets_are_enclosed_by_mass_points_the_better_the_more_there_are) {
  Scene scene = tissue(100);
  scene.sample.areas->of = "inset";
  scene.sample.walls.weld = 0;
  scene.sample.walls.gap = 0.06;
  double before =
      0.02;  // what cuts off corners is a quarter of a spacing, so that four times as many leave a sixteenth
  for (const int segments : {4, 16, 64}) {
    scene.sample.walls.segments = segments;
    Notes notes;
    const double error = error_by_size(generate(scene, notes).rest_area, scene);
    EXPECT_LT(error, before);
    EXPECT_GT(error, 0);
    before = error / 3;
    EXPECT_THAT(notes, Contains(HasSubstr("mass points enclose the areas of the insets to within")));
  }
}

TEST(CellAreas, of_insets_by_nothing_are_those_of_tiles) {
  Packing packing;
  packing.box.hi = {2, 1};
  for (int i = 0; i < 50; ++i) packing.disks.push_back({{}, 0.05 + 0.002 * (i % 9)});
  scatter(packing, 3);
  AreasScene areas;
  areas.of = "inset";
  areas.sites = "random";
  Notes notes;
  const CellAreas inset = tessellate_with_areas(packing, areas, {}, std::vector<double>(50, 0.0), notes);
  for (const Tile& tile : inset.tessellation.tiles)
    EXPECT_NEAR(tile_area(inset.tessellation, tile),
                2 * inset.shares[tile.site] / std::accumulate(inset.shares.begin(), inset.shares.end(), 0.0), 1e-10);
}

TEST(CellAreas, of_insets_on_a_torus_with_walls_of_different_thickness) {
  Packing packing;
  packing.box.hi = {1, 1};
  std::vector<double> distance;
  for (int i = 0; i < 80; ++i) {
    packing.disks.push_back({{}, 0.05});
    distance.push_back(i % 2 == 0 ? 0.002 : 0.006);
  }
  scatter(packing, 3);
  AreasScene areas;
  areas.of = "inset";
  areas.sites = "random";
  areas.sweeps = 5;
  Notes notes;
  const CellAreas made = tessellate_with_areas(packing, areas, {true, true}, distance, notes);
  std::vector<double> insets;
  for (const Tile& tile : made.tessellation.tiles)
    insets.push_back(inset_area(polygon_of(made.tessellation, tile), distance[tile.site]));
  EXPECT_LE(*std::max_element(insets.begin(), insets.end()) / *std::min_element(insets.begin(), insets.end()),
            1 + 2e-9);
}

TEST(CellAreas, of_a_mixture_by_area_sum_to_the_shares_of_its_parts) {
  // Two parts of one group, so that parts are told apart by more than their groups. Few large cells: their number alone is off by much.
  for (const char* of : {"tile", "inset"}) {
    SCOPED_TRACE(of);
    Scene scene = tissue(200);
    scene.stages.front().cells["vessels"] = scene.stages.front().cells["cells"];
    scene.sample.walls.weld = 0;
    scene.sample.areas->of = of;
    scene.sample.areas->sweeps = 2;
    scene.sample.sizes.distribution = "mixture";
    const std::vector<double> shares{0.4, 0.25, 0.35}, means{1, 1.5, 4}, cvs{0.3, 0.1, 0.3};
    for (std::size_t k = 0; k < 3; ++k) {
      MixtureScene part;
      part.mean = means[k];
      part.cv = cvs[k];
      part.area_share = shares[k];
      part.group = k == 2 ? "vessels" : "cells";
      scene.sample.sizes.mixture.push_back(part);
    }
    Notes notes;
    Origin origin;
    const Sample sample = generate(scene, notes, {}, &origin);
    std::vector<double> area(3, 0), ratio(3, 0);
    double all = 0, spread = 0;
    for (Index c = 0; c < sample.cells(); ++c) {
      const auto site = std::stoul(origin.tiles.cells[c].name.substr(5));
      const int part = origin.packing.part[site];
      EXPECT_EQ(origin.tiles.cells[c].group == "vessels", part == 2);
      const double own = std::string(of) == "tile"
                             ? sample.tile_area[c]
                             : inset_area(polygon_of(origin.tiles, origin.tiles.cells[c]), sample.radius[c]);
      area[part] += own, all += own;
      const double radius = origin.packing.disks[site].radius, found = own / (radius * radius);
      if (ratio[part] == 0) ratio[part] = found;
      spread = std::max(spread, std::abs(found / ratio[part] - 1));
    }
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(area[k] / all, shares[k], 1e-9) << k;
    EXPECT_LT(spread, 3e-9);  // within a part, in proportion to the disks
    EXPECT_GT(std::abs(ratio[2] / ratio[0] - 1), 1e-4);
  }
}

TEST(CellAreas, that_a_file_states_take_the_place_of_the_disks) {
  Packing packing;
  packing.box.hi = {1, 1};
  for (int i = 0; i < 40; ++i) {
    packing.disks.push_back({{}, 0.05});
    packing.target_area.push_back(0.01 * (1 + i % 3));
  }
  scatter(packing, 3);
  Notes notes;
  const CellAreas made = tessellate_with_areas(packing, {}, {}, std::vector<double>(40, 0.0), notes);
  const double sum = std::accumulate(packing.target_area.begin(), packing.target_area.end(), 0.0);
  for (const Tile& tile : made.tessellation.tiles)
    EXPECT_NEAR(tile_area(made.tessellation, tile) / (packing.target_area[tile.site] / sum), 1, 1e-9);
  EXPECT_THAT(notes, Contains(AllOf(HasSubstr("the stated areas sum to 0.79"), HasSubstr("in proportion"))));
  packing.target_area[7] = 1.5;
  EXPECT_THAT(message_of(packing, {}, 0), HasSubstr("disk 7 shall have a cell of 1.5 m2, there are 1 m2 in all"));
  packing.target_area[7] = -1;
  EXPECT_THAT(message_of(packing, {}, 0), HasSubstr("site 7 shall have the area -1"));
}

TEST(CellAreas, of_sites_at_one_place_are_refused_or_the_first_has_the_area) {
  const TemporaryFolder folder;
  std::ofstream(folder / "disks.csv") << "0.3,0.3,0.1\n0.7,0.3,0.2\n0.3,0.7,0.1\n0.7,0.7,0.1\n0.3,0.3,0.2\n";
  Scene scene = tissue(5);
  scene.sample.kind = "tissue";
  scene.stages.front().cells["cells"].thickness = 0.01;
  scene.sample.packing.file = (folder / "disks.csv").string();
  scene.sample.width = scene.sample.height = 1;
  Notes notes;
  EXPECT_THROW(generate(scene, notes), SceneError);
  scene.sample.packing.duplicates = "keep_first";
  std::vector<double> areas = generate(scene, notes).tile_area;
  std::sort(areas.begin(), areas.end());
  ASSERT_EQ(areas.size(), 4u);
  EXPECT_NEAR(areas[0], 1.0 / 7, 1e-9);
  EXPECT_NEAR(areas[3], 4.0 / 7, 1e-9);
  EXPECT_THAT(notes, Contains(HasSubstr("1 disks left out that lie where an earlier one lies")));
}

TEST(CellAreas, say_what_welding_has_done_to_them) {
  Scene scene = tissue(200);
  scene.sample.areas->sites = "random";
  scene.sample.walls.weld = 0.2;
  Notes notes;
  const Sample sample = generate(scene, notes);
  EXPECT_GT(error_by_size(sample.tile_area, scene), 1e-6);
  EXPECT_THAT(notes, Contains(AllOf(HasSubstr("welding"), HasSubstr("changes"), HasSubstr("mean square"))));

  // The numbers, by hand: two squares of 1 that become 0.9 and 1.1 make 10 % and, over all four, 7.1 % in the mean square.
  CellAreas exact;
  exact.tessellation.box.hi = {4, 1};
  exact.shares.assign(4, 1);
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j < 2; ++j) exact.tessellation.vertices.emplace_back(i, j);
  for (Index i = 0; i < 4; ++i)
    exact.tessellation.tiles.push_back({i, {2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1}, {-3, -2, -4, -1}, {}, {}});
  Tessellation welded = exact.tessellation;
  welded.vertices[2].x() = welded.vertices[3].x() = 0.9;
  notes.clear();
  note_welded_areas(exact, welded, 3, notes);
  EXPECT_THAT(notes, Contains(HasSubstr("welding 3 short walls changes 2 of 4 areas, by at most 0.1 and 0.071 in")));
}

TEST(CellAreas, whose_walls_need_more_room_than_there_is_are_refused) {
  Packing packing;
  packing.box.hi = {1, 1};
  for (int i = 0; i < 50; ++i) packing.disks.push_back({{}, 0.05});
  scatter(packing, 3);
  AreasScene areas;
  areas.of = "inset";
  areas.sites = "random";
  EXPECT_THAT(message_of(packing, areas, 0.2), HasSubstr("walls of this thickness need at least"));
  EXPECT_THAT(message_of(packing, areas, 0.06), HasSubstr("leaves nothing of"));
  areas.of = "tile";
  EXPECT_THAT(message_of(packing, areas, 0.2), HasSubstr("no error"));
}

TEST(CellAreas, read_from_a_scene_repeat_bit_for_bit) {
  Scene scene = tissue(100);
  scene.sample.areas->sites = "random";
  scene.sample.areas->sweeps = 3;
  Notes notes;
  const Sample one = generate(scene, notes), two = generate(scene, notes);
  EXPECT_EQ(one.tile_area, two.tile_area);
  EXPECT_EQ(one.rest_area, two.rest_area);
}

}  // namespace
}  // namespace lamella
