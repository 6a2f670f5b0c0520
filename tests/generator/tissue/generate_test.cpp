// The front door: whole scenes, each kind of sample, and that the same scene gives the same sample.
#include "generator/generate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>

#include "generator/sample/errors.h"
#include "generator/sample/parallel.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

Scene scene_of(const std::string& kind) {
  Scene scene;
  scene.sample.kind = kind;
  scene.stages.emplace_back();
  CellScene cells;
  cells.thickness = 0.02;
  scene.stages.front().cells["cells"] = cells;
  return scene;
}

Scene tissue(int count) {
  Scene scene = scene_of("tissue");
  scene.sample.packing.count = count;
  scene.sample.packing.fraction = 0.7;  // few disks between walls jam early
  scene.sample.sizes.cv = 0.15;
  scene.sample.walls.segments = 4;
  return scene;
}

bool bitwise_equal(const Sample& a, const Sample& b) {
  return a.x.size() == b.x.size() && std::memcmp(a.x.data(), b.x.data(), a.x.size() * sizeof(Vec2)) == 0 &&
         a.links.size() == b.links.size() && a.cell_begin == b.cell_begin && a.side == b.side;
}

TEST(Generate, gives_the_same_bits_on_one_two_and_three_threads) {
  for (const bool torus : {false, true}) {
    Scene scene = tissue(4000);
    scene.sample.sizes.cv = 0.4;
    if (torus) scene.sample.periodic = "xy", scene.sample.areas.emplace();
    std::vector<Sample> samples;
    std::vector<Notes> notes(3);
    for (const int threads : {1, 2, 3}) {
      use_threads(threads);
      samples.push_back(generate(scene, notes[threads - 1]));
    }
    use_threads(1);
    for (const std::size_t k : {1u, 2u}) {
      EXPECT_TRUE(bitwise_equal(samples[k], samples[0]));
      EXPECT_EQ(samples[k].rest_angle, samples[0].rest_angle);
      EXPECT_EQ(samples[k].tile_area, samples[0].tile_area);
      EXPECT_EQ(notes[k], notes[0]);
      for (std::size_t l = 0; l < samples[0].links.size(); ++l)
        ASSERT_EQ(samples[k].links[l].offset_n, samples[0].links[l].offset_n);
    }
  }
}

TEST(Generate, says_on_which_line_stands_what_cannot_be_made) {
  const auto fault_of = [](const std::string& sample) -> std::string {
    const std::string text = "[cells]\nthickness = 0.02\n[sample]\nkind = \"tissue\"\nwalls.segments = 4\n" + sample;
    try {
      Notes notes;
      generate(parse_scene(text, "s.toml"), notes);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(fault_of("packing.count = 30\npacking.fraction = 0.9\nsizes.mean = 1\n"),
              HasSubstr("s.toml:7: sample.packing.fraction = 0.9: 30 disks of these sizes jam at about"));
  EXPECT_THAT(fault_of("packing.count = 30\npacking.fraction = 0.7\n[sample.domain]\nkind = \"polygon\"\n"
                       "points = [[0, 0], [1, 0], [0, 1], [1, 1]]\n"),
              HasSubstr("s.toml:10: sample.domain.points: "));
  EXPECT_THAT(
      fault_of("packing.count = 30\npacking.fraction = 0.7\n[sample.sizes]\ndistribution = \"mixture\"\n"
               "[[sample.sizes.mixture]]\nmean = 1\nshare = 0.5\n[[sample.sizes.mixture]]\nmean = 2\nshare = 0.4\n"),
      HasSubstr("sample.sizes.mixture: the shares sum to 0.9"));
}

TEST(Tissue, that_repeats_covers_its_box_and_has_sides_only_where_it_does_not) {
  for (const char* periodic : {"x", "y", "xy"}) {
    for (const int count : {3, 40}) {
      Scene scene = tissue(count);
      scene.sample.periodic = periodic;
      scene.sample.packing.fraction = 0.5;
      Notes notes;
      const Sample sample = generate(scene, notes);
      EXPECT_THAT(check_sample(sample), IsEmpty()) << periodic << " " << count;
      EXPECT_EQ(sample.cells(), count);
      double tiles = 0;
      for (const double area : sample.tile_area) tiles += area;
      EXPECT_NEAR(tiles / sample.box.area(), 1, 1e-12);
      int bits = 0;
      for (const std::uint8_t side : sample.side) bits |= side;
      const bool x = std::string(periodic) != "y", y = std::string(periodic) != "x";
      EXPECT_EQ(bits, (x ? 0 : kLeft | kRight) | (y ? 0 : kBottom | kTop));
      if (x && y) {
        EXPECT_GE(sample.walls.size(), 2u * static_cast<unsigned>(count));  // three a cell, less what is welded
      }
      int across = 0;
      for (const Image& image : sample.link_image) across += image != Image{0, 0};
      EXPECT_GT(across, 0);
      Notes again;
      EXPECT_TRUE(bitwise_equal(sample, generate(scene, again)));
    }
  }
}

TEST(Tissue, edges_without_length_are_welded_even_where_no_welding_is_asked) {
  const TemporaryFolder folder;
  std::ofstream file(folder.path() / "square.csv");
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      file << 0.1 + 0.2 * i << ',' << 0.1 + 0.2 * j << ",0.09\n";  // four tiles meet at every vertex
  file.close();
  Scene scene = tissue(16);
  scene.sample.packing.file = (folder.path() / "square.csv").string();
  scene.sample.width = scene.sample.height = 0.8;
  scene.sample.walls.weld = 0;
  Notes notes;
  const Sample sample = generate(scene, notes);
  EXPECT_EQ(sample.walls.size(), 24u);  // and none of them without length
  EXPECT_THAT(check_sample(sample), IsEmpty());
}

TEST(Tissue, is_sound_fills_its_box_and_repeats_bit_for_bit) {
  Notes notes;
  const Sample sample = generate(tissue(100), notes);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  EXPECT_EQ(sample.cells(), 100);
  double tiles = 0;
  for (const double area : sample.tile_area) tiles += area;
  EXPECT_NEAR(tiles / sample.box.area(), 1, 1e-12);
  for (const Side side : {kLeft, kRight, kBottom, kTop}) {
    int nodes = 0;
    for (const auto bits : sample.side) nodes += (bits & side) != 0;
    EXPECT_GT(nodes, 30);
  }
  EXPECT_TRUE(bitwise_equal(sample, generate(tissue(100), notes)));
  Scene other = tissue(100);
  other.seed = 2;
  EXPECT_FALSE(bitwise_equal(sample, generate(other, notes)));
}

TEST(Tissue, has_neighbours_near_in_memory) {
  Notes notes;
  const Sample sample = generate(tissue(400), notes);
  double far = 0;
  for (const Wall& wall : sample.walls) far += wall.cell_b - wall.cell_a;
  EXPECT_LT(far / static_cast<double>(sample.walls.size()), 2 * std::sqrt(400.0));
}

TEST(Tissue, with_walls_too_thick_is_refused_by_name) {
  Scene scene = tissue(30);
  scene.stages.front().cells["cells"].thickness = 3;
  Notes notes;
  try {
    generate(scene, notes);
    FAIL() << "no error";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("vanish"));
  }
}

TEST(Tissue, loses_cells_or_links_to_a_notch) {
  Notes notes;
  const Sample whole = generate(tissue(100), notes);
  Scene scene = tissue(100);
  const double middle = whole.box.hi.y() / 2;
  scene.sample.notch = NotchScene{{Vec2(0, middle), Vec2(whole.box.hi.x() / 3, middle)}, {}};
  const Sample cut = generate(scene, notes);
  EXPECT_LT(cut.links.size(), whole.links.size());
  EXPECT_EQ(cut.nodes(), whole.nodes());
  scene.sample.notch =
      NotchScene{{}, {Vec2(0, middle - 1), Vec2(3, middle - 1), Vec2(3, middle + 1), Vec2(0, middle + 1)}};
  EXPECT_LT(generate(scene, notes).cells(), whole.cells());
}

TEST(Rings, lie_in_disks_that_do_not_overlap) {
  Scene scene = scene_of("rings");
  scene.sample.packing.count = 40;
  scene.sample.packing.fraction = 0.75;
  Notes notes;
  const Sample sample = generate(scene, notes);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  EXPECT_EQ(sample.cells(), 40);
  EXPECT_EQ(sample.nodes(), 40 * 40);
  EXPECT_TRUE(sample.links.empty());
  double outlines = 0;
  double tiles = 0;
  for (Index c = 0; c < sample.cells(); ++c) {
    const double vertex_radius = std::sqrt(sample.rest_area[c] / (20 * std::sin(2 * std::numbers::pi / 40)));
    outlines += std::numbers::pi * std::pow(vertex_radius + sample.radius[c], 2);
    tiles += sample.tile_area[c];
  }
  EXPECT_NEAR(outlines / sample.box.area(), 0.75, 1e-6);
  EXPECT_NEAR(tiles / sample.box.area(), 1, 1e-12);
}

TEST(Honeycomb, comes_through_the_front_door) {
  Scene scene = scene_of("honeycomb");
  scene.sample.columns = 30;
  scene.sample.rows = 20;
  scene.sample.side = 1;
  scene.sample.walls.segments = 3;
  Notes notes;
  const Sample sample = generate(scene, notes);
  EXPECT_EQ(sample.nodes(), 600 * 18);
  EXPECT_THAT(notes, IsEmpty()) << "nothing to report of a lattice";
}

TEST(Shapes, stand_alone_or_beside_a_tissue) {
  Scene scene = scene_of("shapes");
  Notes notes;
  EXPECT_THROW(generate(scene, notes), SceneError);
  ShapeScene ring;
  ring.kind = "ring";
  ring.size = 1;
  ring.segments = 40;
  ShapeScene plate;
  plate.kind = "plate";
  plate.group = "plate";
  plate.from = Vec2(-2, 1.02);
  plate.to = Vec2(2, 1.02);
  plate.segments = 8;
  scene.stages.front().cells["plate"] = scene.stages.front().cells["cells"];
  scene.sample.shapes = {ring, plate};
  const Sample sample = generate(scene, notes);
  EXPECT_EQ(sample.cells(), 2);
  EXPECT_EQ(sample.group_names, (std::vector<std::string>{"cells", "plate"}));
  EXPECT_NEAR(sample.box.hi.y(), 1.03, 1e-12);
  scene.sample.shapes[1].from.y() = scene.sample.shapes[1].to.y() = 0.5;
  EXPECT_THROW(generate(scene, notes), SceneError) << "the plate crosses the ring";
}

TEST(Honeycomb, has_links_that_face_each_other_at_the_stated_gap) {
  Scene scene = scene_of("honeycomb");
  scene.sample.columns = scene.sample.rows = 3;
  scene.sample.side = 1;
  scene.sample.walls.segments = 2;
  scene.sample.walls.gap = 0.03;
  Notes notes;
  Origin origin;
  const Sample sample = generate(scene, notes, {}, &origin);
  for (std::size_t l = 0; l < sample.links.size(); ++l) {
    EXPECT_NEAR(sample.links[l].offset_n, 2 * sample.radius[0] + 0.03, 1e-12);
    EXPECT_NEAR(sample.links[l].offset_t, 0, 1e-12);
  }
  // The tiles that the walls were inset from, one for each cell.
  ASSERT_EQ(origin.tiles.cells.size(), 9u);
  for (Index c = 0; c < sample.cells(); ++c) {
    const auto polygon = polygon_of(origin.tiles, origin.tiles.cells[c]);
    EXPECT_EQ(polygon_area(polygon.data(), static_cast<Index>(polygon.size())), sample.tile_area[c]);
  }
}

}  // namespace
}  // namespace lamella
