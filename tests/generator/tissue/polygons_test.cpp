#include "generator/tissue/polygons.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "generator/sample/errors.h"
#include "generator/tissue/inset.h"
#include "generator/tissue/walls.h"
#include "tests/generator/tissue/mosaics.h"

namespace lamella {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A file of its own for each test, gone with it.
class PolygonFile {
 public:
  explicit PolygonFile(const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("lamella_polygons_{}_{}.txt", ::getpid(),
                          ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::ofstream(path_) << text;
  }
  ~PolygonFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string fault_of(const std::string& text, const std::string& outlines = "shared") {
  const PolygonFile file(text);
  Notes notes;
  try {
    const auto cells = read_polygons(file.path(), 1, notes);
    SampleScene scene;
    scene.walls.spacing = 0.25;
    if (outlines == "shared")
      share_walls(cells, scene, file.path().string());
    else
      make_separate_tissue(cells, scene, file.path().string(), 0.01, "cells", notes);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no fault";
}

std::string text_of(const Mosaic& mosaic) {
  std::string text;
  for (const auto& cell : mosaic.cells)
    for (const Index v : cell.vertex)
      text += fmt::format("{:.7f} {:.7f} {}\n", mosaic.vertices[v].x(), mosaic.vertices[v].y(), cell.name.substr(5));
  return text;
}

Sample shared(const std::string& text, double spacing, double radius, Notes& notes) {
  const PolygonFile file(text);
  SampleScene scene;
  scene.walls.spacing = spacing;
  return make_tissue(share_walls(read_polygons(file.path(), 1, notes), scene, file.path().string()), scene.walls,
                     radius, "cells", notes);
}

const std::string kTwoSquares = "0 0 a\n1 0 a\n1 1 a\n0 1 a\n# the second runs clockwise\n1 0 b\n1 1 b\n2 1 b\n2 0 b\n";

TEST(PolygonFiles, are_read_in_either_orientation_with_comments_and_scale) {
  const PolygonFile file("x y cell\n0,0,a # corner\n\n2;0;a\n2 2 a\n0\t2 a\n0 0 a\n3 3 b\n3 4 b\n4 3 b\n");
  Notes notes;
  const auto cells = read_polygons(file.path(), 0.5, notes);
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_EQ(cells[0].points, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(cells[0].lines, (std::vector<int>{2, 4, 5, 6}));
  EXPECT_GT(polygon_area(cells[1].points.data(), 3), 0);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], HasSubstr("repeat their first point"));
}

TEST(PolygonFiles, that_are_wrong_are_refused_with_every_line) {
  EXPECT_THAT(fault_of("0 0 a\n1 0\n1 nan a\ninf 1 a\n0 x a\n1 2 3 4\n"),
              AllOf(HasSubstr(".txt:2: 2 columns"), HasSubstr(".txt:3: y is nan"), HasSubstr(".txt:4: x is inf"),
                    HasSubstr(".txt:5: y is \"x\""), HasSubstr(".txt:6: 4 columns")));
  EXPECT_THAT(fault_of("0 0 a\n1 0 a\n0 2 b\n1 2 b\n0 3 b\n"), HasSubstr(":1: cell a has 2 points"));
  EXPECT_THAT(fault_of("0 0 a\n1 0 a\n1 0 a\n0 1 a\n"), HasSubstr(":3: cell a has the point of line 2 again"));
  EXPECT_THAT(fault_of("0 0 a\n1 0 a\n2 0 a\n"), HasSubstr("no area"));
  EXPECT_THAT(fault_of("0 0 a\n2 2 a\n2 0 a\n0 1 a\n"), HasSubstr("crosses itself"));
  EXPECT_THAT(fault_of("0 0 a\n1 0 a\n1 1 a\n2 0 b\n3 0 b\n3 1 b\n0 1 a\n"), HasSubstr(":7: cell a began at line 1"));
  EXPECT_THAT(fault_of("# nothing\n"), HasSubstr("no cells"));
  EXPECT_THAT(fault_of("\x1b[31m 0 a\n"), HasSubstr("?[31m"));
}

TEST(PolygonFiles, that_are_missing_or_folders_are_named) {
  Notes notes;
  EXPECT_THROW(read_polygons("/nowhere/cells.txt", 1, notes), DataError);
  EXPECT_THROW(read_polygons(std::filesystem::temp_directory_path(), 1, notes), DataError);
}

TEST(PolygonFiles, with_overlapping_cells_are_refused_with_both_lines) {
  const std::string square = "0 0 a\n1 0 a\n1 1 a\n0 1 a\n";
  for (const char* outlines : {"shared", "separate"}) {
    EXPECT_THAT(fault_of(square + ".5 .5 b\n2 .5 b\n2 2 b\n.5 2 b\n", outlines), HasSubstr("overlaps cell a"))
        << outlines;
    EXPECT_THAT(fault_of(square + ".2 .2 b\n.8 .2 b\n.8 .8 b\n.2 .8 b\n", outlines), HasSubstr("lies inside"));
    EXPECT_THAT(fault_of(square + ".5 0 b\n1 .5 b\n.5 1 b\n0 .5 b\n", outlines), HasSubstr("lies inside"));
  }
  EXPECT_THAT(fault_of(square + "0 0 b\n1 0 b\n1 1 b\n0 1 b\n"), HasSubstr("overlap"));
  EXPECT_THAT(fault_of(square + ".5 0 b\n1.5 0 b\n1.5 1 b\n.5 1 b\n"), HasSubstr("overlap"));
}

TEST(SharedWalls, of_a_tessellation_written_as_text_make_the_same_tissue) {
  const Mosaic mosaic = voronoi(60, 2, 0.06);
  Notes notes;
  WallsScene walls;
  walls.spacing = 0.02;
  Mosaic ordered = mosaic;
  order_by_rows(ordered);
  const Sample expected = make_tissue(ordered, walls, 0.003, "cells", notes);
  const Sample sample = shared(text_of(ordered), 0.02, 0.003, notes);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  ASSERT_EQ(sample.nodes(), expected.nodes());
  EXPECT_EQ(sample.links.size(), expected.links.size());
  for (Index k = 0; k < sample.nodes(); ++k) {
    EXPECT_NEAR((sample.x[k] - expected.x[k]).norm(), 0, 1e-5);
    EXPECT_EQ(sample.side[k] & expected.side[k], expected.side[k]);
  }
}

TEST(SharedWalls, are_found_whatever_the_orientation) {
  Notes notes;
  const Sample sample = shared(kTwoSquares, 0.4, 0.1, notes);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  EXPECT_EQ(sample.links.size(), 3u);
  EXPECT_EQ(sample.box.hi, Vec2(2, 1));
  int left = 0;
  for (const auto side : sample.side) left += (side & kLeft) != 0;
  EXPECT_EQ(left, 3);
}

TEST(SharedWalls, are_divided_where_a_third_cell_ends_on_them) {
  Notes notes;  // a below b and c; their common corner lies on a's upper side, to the digits of the file
  const Sample sample = shared(
      "0 0 a\n2 0 a\n2 1 a\n0 1 a\n0 1 b\n1 1.00001 b\n1 2 b\n0 2 b\n1 1 c\n2 1 c\n2 2 c\n1 2 c\n", 0.2, 0.02, notes);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  EXPECT_EQ(sample.walls.size(), 3u);
  for (const Wall& wall : sample.walls) EXPECT_NEAR(wall.length, 1, 1e-4);
}

TEST(SharedWalls, of_concave_cells_are_offset_right_or_refused_by_name) {
  const std::string corner = "0 0 L\n2 0 L\n2 1 L\n1 1 L\n1 2 L\n0 2 L\n1 1 s\n2 1 s\n2 2 s\n1 2 s\n";
  Notes notes;
  const Sample sample = shared(corner, 0.2, 0.05, notes);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  EXPECT_EQ(sample.walls.size(), 1u) << "round the corner, one wall";
  EXPECT_THROW(shared("0 0 w\n1 .45 w\n2 0 w\n2 1 w\n1 .55 w\n0 1 w\n", 0.2, 0.1, notes), SceneError);
}

/// The cells of a tessellation, each inset: centre lines as someone else would draw them.
std::string inset_text(const Mosaic& mosaic, double distance) {
  std::string text;
  for (const auto& cell : mosaic.cells) {
    const auto polygon = polygon_of(mosaic, cell);
    for (const InsetEdge& e : inset_polygon(polygon, distance).edges) {
      const Vec2 along = (polygon[(e.edge + 1) % polygon.size()] - polygon[e.edge]).normalized();
      const Vec2 p = polygon[e.edge] + e.from * along + distance * left_of(along);
      text += fmt::format("{:.9f} {:.9f} {}\n", p.x(), p.y(), cell.name.substr(5));
    }
  }
  return text;
}

TEST(SeparateOutlines, are_linked_where_they_face_each_other) {
  const double r = 0.004;
  const Mosaic mosaic = voronoi(60, 2, 0.06);
  const PolygonFile file(inset_text(mosaic, r));
  Notes notes;
  SampleScene scene;
  scene.walls.spacing = 0.02;
  const Sample sample =
      make_separate_tissue(read_polygons(file.path(), 1, notes), scene, file.path().string(), r, "cells", notes);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  WallsScene walls;
  walls.spacing = 0.02;
  const Sample tiles = make_tissue(mosaic, walls, r, "cells", notes);
  EXPECT_EQ(sample.cells(), 60);
  double linked = 0;
  double expected = 0;
  for (const Link& link : sample.links) linked += link.length;
  for (const Link& link : tiles.links) expected += link.length;
  EXPECT_NEAR(linked / expected, 1, 0.05);
  int facing = 0;
  for (const Link& link : sample.links) facing += std::abs(link.offset_n - 2 * r) < 1e-6 ? 1 : 0;
  EXPECT_GT(facing, static_cast<int>(sample.links.size() * 6 / 10)) << "but for merged corners they are 2 r apart";
  double area = 0;
  for (const double a : sample.rest_area) area += a;
  EXPECT_NEAR(area, 0.85, 0.05);
}

TEST(SeparateOutlines, beyond_the_tolerance_are_not_linked) {
  const PolygonFile file("0 0 a\n1 0 a\n1 1 a\n0 1 a\n1.1 0 b\n2 0 b\n2 1 b\n1.1 1 b\n");
  Notes notes;
  SampleScene scene;
  scene.walls.spacing = 0.2;
  const auto cells = read_polygons(file.path(), 1, notes);
  EXPECT_TRUE(make_separate_tissue(cells, scene, "f", 0.04, "cells", notes).links.empty());
  EXPECT_THAT(notes, ::testing::Contains(HasSubstr("no two cells face each other")));
  scene.facing_tolerance = 0.11;
  const Sample sample = make_separate_tissue(cells, scene, "f", 0.04, "cells", notes);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  EXPECT_EQ(sample.links.size(), 6u);
  for (const Link& link : sample.links) {
    EXPECT_NEAR(link.offset_n, 0.1, 1e-9);
    EXPECT_NEAR(link.offset_t, 0, 1e-9);
  }
}

}  // namespace
}  // namespace lamella
