// From the file to the sample, as a scene asks for it.
#include "generator/tissue/image_tissue.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "generator/sample/errors.h"
#include "tests/generator/image/pictures.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

class ImageTissue : public ::testing::Test {
 protected:
  TemporaryFolder folder;
  Notes notes;

  /// A pixel is a micrometre.
  Scene scene_of(const Picture& picture, const std::string& keys = "", double thickness = 1e-6) {
    write(folder / "picture.pgm", pgm(picture, false));
    write(folder / "scene.toml", fmt::format(R"([sample]
kind = "image"
image.file = "picture.pgm"
image.pixel = "1 um"
walls.spacing = "4 um"
{}
[cells]
thickness = {}
young = "100 MPa"
density = 1000
[links]
normal_stiffness = "1e12 N/m2"
tangential_stiffness = "1e11 N/m2"
[loading]
strain_rate = 1
strain = 0.01
)",
                                             keys, thickness));
    return read_scene(folder / "scene.toml");
  }

  Sample sample_of(const Picture& picture, const std::string& keys = "", double thickness = 1e-6) {
    const Scene scene = scene_of(picture, keys, thickness);
    notes.clear();
    return generate(scene, notes);  // which also checks every invariant
  }

  std::string fault_of(const Picture& picture, const std::string& keys = "", double thickness = 1e-6) {
    try {
      sample_of(picture, keys, thickness);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "no fault";
  }
};

double total_tile_area(const Sample& sample) {
  return std::accumulate(sample.tile_area.begin(), sample.tile_area.end(), 0.0);
}

Picture tissue_picture() { return tessellated(150, 120, random_disks(24, 150, 120, 14, 8)); }

TEST_F(ImageTissue, fills_the_picture_with_the_top_row_on_top) {
  const Sample sample = sample_of(picture_of(60, 40, [](int x, int y) { return y < 10 ? 1u : x < 20 ? 2u : 3u; }));
  EXPECT_NEAR(sample.box.size().x(), 60e-6, 1e-18);
  EXPECT_NEAR(sample.box.size().y(), 40e-6, 1e-18);
  ASSERT_EQ(sample.cells(), 3);
  // By rows from below: 2, 3, 1.
  EXPECT_NEAR(sample.tile_area[0], 600e-12, 1e-20);
  EXPECT_NEAR(sample.tile_area[1], 1200e-12, 1e-20);
  EXPECT_NEAR(sample.tile_area[2], 600e-12, 1e-20);
  for (Index k = sample.cell_begin[2]; k < sample.cell_begin[3]; ++k) EXPECT_GT(sample.x[k].y(), 29e-6);
  EXPECT_EQ(sample.walls.size(), 3u);
  EXPECT_GT(sample.links.size(), 15u);
}

TEST_F(ImageTissue, has_nodes_on_all_four_sides) {
  const Sample sample = sample_of(tissue_picture(), "image.least_area = 60");
  EXPECT_NEAR(total_tile_area(sample), sample.box.area(), 1e-12 * sample.box.area());
  for (const Side side : {kLeft, kRight, kBottom, kTop}) {
    const double wanted = side == kLeft     ? sample.box.lo.x()
                          : side == kRight  ? sample.box.hi.x()
                          : side == kBottom ? sample.box.lo.y()
                                            : sample.box.hi.y();
    int nodes = 0;
    for (Index k = 0; k < sample.nodes(); ++k) {
      if (!(sample.side[k] & side)) continue;
      ++nodes;
      const double at = side == kLeft || side == kRight ? sample.x[k].x() : sample.x[k].y();
      EXPECT_NEAR(at, wanted, 0.6e-6);  // the wall's radius, and rounding
    }
    EXPECT_GT(nodes, 10);
  }
}

TEST_F(ImageTissue, that_does_not_reach_the_sides_is_held_by_what_looks_at_them) {
  const Picture inner = tissue_picture();
  const Picture picture = picture_of(250, 220, [&](int x, int y) -> std::uint32_t {
    x -= 50, y -= 50;
    return x < 0 || y < 0 || x >= inner.width || y >= inner.height ? 0 : inner.value[y * inner.width + x];
  });
  const Sample sample = sample_of(picture, "image.least_area = 60");
  EXPECT_NEAR(sample.box.size().x(), 250e-6, 1e-15);
  for (const Side side : {kLeft, kRight, kBottom, kTop})
    EXPECT_GT(std::count_if(sample.side.begin(), sample.side.end(), [&](auto bits) { return bits & side; }), 10);
}

TEST_F(ImageTissue, is_the_same_from_cells_that_lines_of_background_part) {
  const Picture whole = tissue_picture();
  const Picture parted = picture_of(whole.width, whole.height, [&](int x, int y) {
    const auto at = [&](int u, int v) { return whole.value[std::min(v, 119) * whole.width + std::min(u, 149)]; };
    return at(x, y) == at(x + 1, y) && at(x, y) == at(x, y + 1) ? at(x, y) : 0u;
  });
  const Sample one = sample_of(whole, "image.least_area = 60");
  const Sample other = sample_of(parted, "image.least_area = 60");
  EXPECT_THAT(notes, Contains(HasSubstr("are given to the nearest cells")));
  EXPECT_EQ(one.cells(), other.cells());
  EXPECT_NEAR(total_tile_area(other), other.box.area(), 1e-12 * other.box.area());
  EXPECT_NEAR(static_cast<double>(one.walls.size()), static_cast<double>(other.walls.size()), 3);
  // A skeleton says where cells are, not which.
  const Picture mask = picture_of(whole.width, whole.height,
                                  [&](int x, int y) { return parted.value[y * whole.width + x] == 0 ? 0u : 255u; });
  const Sample skeleton = sample_of(mask, "image.least_area = 60");
  EXPECT_THAT(notes, Contains(HasSubstr("connected pieces is a cell")));
  EXPECT_EQ(skeleton.cells(), other.cells());
}

TEST_F(ImageTissue, keeps_real_holes) {
  const Picture picture = picture_of(90, 90, [](int x, int y) {
    if (std::hypot(x - 45, y - 45) < 20) return 0u;
    return static_cast<unsigned>(1 + x / 30 + 3 * (y / 30));
  });
  const Sample sample = sample_of(picture, "image.background = 0");
  EXPECT_EQ(sample.cells(), 8);  // the middle one is four corners, the largest of which go to its neighbours
  EXPECT_NEAR(total_tile_area(sample), 8100e-12 - std::numbers::pi * 400e-12, 60e-12);
}

TEST_F(ImageTissue, of_a_micrograph_says_how_thick_walls_are) {
  const Picture picture = picture_of(200, 160, [](int x, int y) {
    const int row = y / 32, u = (x + row % 2 * 20) % 40, v = y % 32;
    return u < 4 || v < 4 ? 30u : 220u;
  });
  const Sample sample = sample_of(picture, "image.kind = \"grey\"");
  EXPECT_THAT(notes, Contains(HasSubstr("Otsu's threshold")));
  EXPECT_THAT(notes, Contains(::testing::ContainsRegex("walls are (3\\.[5-9]|4\\.[0-5]).* pixels thick")));
  EXPECT_EQ(sample.cells(), 27);
}

TEST_F(ImageTissue, as_a_laguerre_tessellation_is_convex_and_close) {
  const Sample sample = sample_of(tissue_picture(), "image.least_area = 60\nimage.cells = \"laguerre\"");
  EXPECT_NEAR(total_tile_area(sample), sample.box.area(), 1e-9 * sample.box.area());
  EXPECT_THAT(notes, Contains(::testing::ContainsRegex("closest Laguerre tessellation: (99\\.|100)")));
  for (Index c = 0; c < sample.cells(); ++c)
    for (Index k = sample.cell_begin[c]; k < sample.cell_begin[c + 1]; ++k) EXPECT_GE(sample.rest_angle[k], -1e-9);
}

TEST_F(ImageTissue, says_how_many_walls_were_welded_however_its_cells_are_made) {
  for (const char* cells : {"outlines", "laguerre"}) {
    const std::string keys = fmt::format("image.least_area = 60\nimage.cells = \"{}\"\nwalls.weld = 0.3", cells);
    Origin origin;
    notes.clear();
    generate(scene_of(tissue_picture(), keys, 1e-6), notes, {}, &origin);
    EXPECT_GT(origin.welded, 0) << cells;
    EXPECT_THAT(notes, Contains(::testing::AllOf(HasSubstr("welded to a point"),
                                                 HasSubstr(fmt::format("{} ", origin.welded)))));
  }
}

TEST_F(ImageTissue, as_a_laguerre_tessellation_is_welded_in_metres) {
  sample_of(tissue_picture(), "image.least_area = 60\nimage.cells = \"laguerre\"\nwalls.weld = 0.3");
  EXPECT_THAT(notes, Contains(::testing::ContainsRegex("edges of at most [0-9.]+e-06 m welded")));
}

TEST_F(ImageTissue, as_a_laguerre_tessellation_leaves_out_the_background) {
  const auto disks = random_disks(40, 160, 160, 10, 3);
  const Picture picture = picture_of(160, 160, [&](int x, int y) {
    const Vec2 p(x + 0.5, 160 - y - 0.5);
    return (p - Vec2(80, 80)).norm() > 70 ? 0u : static_cast<unsigned>(nearest(disks, p)) + 1;
  });
  const Sample sample = sample_of(picture, "image.least_area = 60\nimage.cells = \"laguerre\"");
  EXPECT_NEAR(total_tile_area(sample), std::numbers::pi * 4900e-12, 0.05 * std::numbers::pi * 4900e-12);
}

TEST_F(ImageTissue, same_picture_same_sample) {
  for (const char* cells : {"outlines", "laguerre"}) {
    const std::string keys = fmt::format("image.least_area = 60\nimage.cells = \"{}\"", cells);
    const Sample one = sample_of(tissue_picture(), keys);
    const Sample other = sample_of(tissue_picture(), keys);
    EXPECT_EQ(one.x, other.x);
  }
}

TEST_F(ImageTissue, names_cells_that_are_too_narrow_and_says_what_helps) {
  // 2 is a dumb-bell, 3 is thinner than the walls.
  const Picture picture = picture_of(80, 80, [](int x, int y) {
    if (y >= 50) return y < 53 ? 3u : 4u;
    if (y > 10 && y < 40 && (std::abs(x - 40) > 12 || std::abs(y - 25) < 3)) return 2u;
    return y < 25 ? 1u : 5u;
  });
  const std::string fault = fault_of(picture, "image.simplify = 0.5", 8e-6);
  EXPECT_THAT(fault, HasSubstr("label 3 (about pixel 40, 51) vanish"));
  EXPECT_THAT(fault, HasSubstr("label 2 (about pixel 39, 25): concave"));
  EXPECT_THAT(fault, HasSubstr("cells = \"laguerre\" makes all of them convex"));
}

TEST_F(ImageTissue, without_cells_is_refused) {
  EXPECT_THAT(fault_of(picture_of(9, 9, [](int, int) { return 0u; })), HasSubstr("no cells: all pixels are 0"));
  EXPECT_THAT(fault_of(picture_of(9, 9, [](int x, int y) { return x == 4 && y == 4 ? 1u : 0u; })),
              HasSubstr("no cells are left that have at least sample.image.least_area = 20 pixels"));
  EXPECT_THAT(fault_of(picture_of(9, 9, [](int, int) { return 0u; }), "image.kind = \"grey\""), HasSubstr("no cells"));
}

TEST_F(ImageTissue, refuses_a_micrograph_as_labels) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::uint32_t> value(0, 40);
  EXPECT_THAT(fault_of(picture_of(40, 40, [&](int, int) { return value(random); })),
              HasSubstr("these are no cells; for a micrograph give sample.image.kind = \"grey\""));
}

TEST_F(ImageTissue, refuses_keys_that_belong_elsewhere) {
  const Picture picture = tissue_picture();
  EXPECT_THAT(fault_of(picture, "image.threshold = 0.5"), HasSubstr("belongs to kind = \"grey\", not to \"labels\""));
  EXPECT_THAT(fault_of(picture, "image.kind = \"grey\"\nimage.background = 1"),
              HasSubstr("belongs to kind = \"labels\""));
  EXPECT_THAT(fault_of(picture, "image.cells = \"laguerre\"\nimage.simplify = 1"),
              HasSubstr("belongs to cells = \"outlines\""));
  EXPECT_THAT(fault_of(picture, "width = 1\nheight = 1"), HasSubstr("contradicts the picture"));
}

TEST_F(ImageTissue, a_missing_picture_is_named) {
  const Scene scene = scene_of(tissue_picture());
  std::filesystem::remove(folder / "picture.pgm");
  EXPECT_THAT(message_of([&] { generate(scene, notes); }), HasSubstr((folder / "picture.pgm").string()));
}

}  // namespace
}  // namespace lamella
