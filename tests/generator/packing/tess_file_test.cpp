// Neper's tessellation files: what they say is what is read, and what is wrong with them is said with its line.
#include "generator/packing/tess_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "generator/packing/laguerre.h"
#include "generator/packing/packing_file.h"
#include "generator/sample/errors.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using ::testing::HasSubstr;

/// Two rectangles in [0, 2] x [0, 1], as Neper lays its files out. Line numbers are counted from here.
const std::string kTwo = R"(***tess
 **format
   3.4
 **general
   2 standard
 **cell
  2
  *id
   7 9
  *crysym
   triclinic
  *seed
   1 0.5 0.5 0 0.25
   2 1.5 0.5 0 0.25
  *ori
   rodrigues:passive
   0.1 0.2 0.3
   0.1 0.2 0.3
 **vertex
 6
   1 0 0 0 0
   2 1 0 0 0
   3 2 0 0 0
   4 2 1 0 0
   5 1 1 0 0
   6 0 1 0 0
 **edge
 7
   1 1 2 0
   2 2 3 0
   3 3 4 0
   4 4 5 0
   5 5 6 0
   6 6 1 0
   7 2 5 0
 **face
 2
   1 4 1 2 5 6
     4 1 7 5 6
     0 0 0 1
     0 -1 0 0 0
   2 4 2 3 4 5
     4 2 3 4 -7
     0 0 0 1
     0 -1 0 0 0
***end
)";

class TessFiles : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    const auto path = folder / "two.tess";
    std::ofstream(path) << text;
    return path;
  }
  /// What reading says of the file with `from` replaced by `to`.
  std::string fault(const std::string& from, const std::string& to) const {
    std::string text = kTwo;
    text.replace(text.find(from), from.size(), to);
    try {
      read_tess(write(text));
    } catch (const SceneError& error) {
      return error.what();
    }
    return "no fault";
  }
  TemporaryFolder folder;
};

TEST_F(TessFiles, give_ids_seeds_vertices_and_faces) {
  const TessFile tess = read_tess(write(kTwo));
  EXPECT_EQ(tess.id, (std::vector<int>{7, 9}));
  ASSERT_EQ(tess.seeds.size(), 2u);
  EXPECT_EQ(tess.seeds[1].at, Vec2(1.5, 0.5));
  EXPECT_EQ(tess.seeds[1].weight, 0.25);
  ASSERT_EQ(tess.vertices.size(), 6u);
  EXPECT_EQ(tess.vertices[3], Vec2(2, 1));
  EXPECT_EQ(tess.faces[0].vertex, (std::vector<Index>{0, 1, 4, 5}));
  EXPECT_EQ(tess.faces[1].vertex, (std::vector<Index>{1, 2, 3, 4}));
  EXPECT_FALSE(tess.periodic);
}

TEST_F(TessFiles, say_line_and_remedy_of_what_is_wrong) {
  EXPECT_THAT(fault("***tess", "OFF"), HasSubstr("two.tess:1: no tessellation"));
  EXPECT_THAT(fault("2 standard", "3 standard"), HasSubstr("two.tess:5: a tessellation of dimension 3; must be 2"));
  EXPECT_THAT(fault("   3.4", "   1.10"), HasSubstr("two.tess:3: the format is \"1.10\""));
  EXPECT_THAT(fault("   7 9", "   7 7"), HasSubstr("two.tess:9: cell 7 is there twice"));
  EXPECT_THAT(fault("   7 9", "   7 -9"), HasSubstr("two.tess:9: a cell's id is -9"));
  EXPECT_THAT(fault("2 1.5 0.5 0 0.25", "2 1.5 0.5 0 -1"), HasSubstr("two.tess:14: the weight of seed 2 is -1"));
  EXPECT_THAT(fault("3 2 0 0 0", "3 nan 0 0 0"), HasSubstr("two.tess:23: x of vertex 3 is nan; must be finite"));
  EXPECT_THAT(fault("3 2 0 0 0", "3 two 0 0 0"), HasSubstr("two.tess:23: x of vertex 3 is \"two\""));
  EXPECT_THAT(fault("3 2 0 0 0", "3 1e300 0 0 0"), HasSubstr("at most 1e100"));
  EXPECT_THAT(fault("3 2 0 0 0", "3 2 0 1 0"), HasSubstr("must be 0 in two dimensions"));
  EXPECT_THAT(fault("3 2 0 0 0", "4 2 0 0 0"), HasSubstr("two.tess:23: vertices must be in order: 3 follows"));
  EXPECT_THAT(fault("7 2 5 0", "7 2 8 0"), HasSubstr("two.tess:35: an edge's vertex is 8; must be from 1 to 6"));
  EXPECT_THAT(fault("1 4 1 2 5 6", "1 4 1 2 5 0"), HasSubstr("two.tess:38: a face's vertex is 0"));
  EXPECT_THAT(fault("1 4 1 2 5 6", "1 4 1 2 5 5"), HasSubstr("face 1 has vertex 5 twice"));
  EXPECT_THAT(fault("1 4 1 2 5 6", "1 4 1 2 6 5"), HasSubstr("are not those between its vertices"));
  EXPECT_THAT(fault("4 1 7 5 6", "3 1 7 5"), HasSubstr("face 1 has 4 vertices and 3 edges"));
  EXPECT_THAT(fault("4 1 7 5 6", "4 1 99 5 6"), HasSubstr("a face's edge is 99"));
  EXPECT_THAT(fault(" **face\n 2", " **face\n 1"), HasSubstr("1 faces for 2 cells"));
}

TEST_F(TessFiles, refuse_counts_that_they_cannot_hold_before_making_room_for_them) {
  EXPECT_THAT(fault(" **cell\n  2", " **cell\n  2000000000"), HasSubstr("the rest of the file can hold"));
  EXPECT_THAT(fault(" **vertex\n 6", " **vertex\n 99999999999"), HasSubstr("must be from 0 to"));
  EXPECT_THAT(fault(" **edge\n 7", " **edge\n -7"), HasSubstr("must be from 0 to"));
}

TEST_F(TessFiles, that_end_anywhere_are_refused_with_a_line) {
  for (std::size_t length = 0; length + 8 < kTwo.size(); length += 3) {
    const auto path = write(kTwo.substr(0, length));
    try {
      read_tess(path);
      FAIL() << "no fault at " << length;
    } catch (const SceneError& error) {
      EXPECT_THAT(error.what(), HasSubstr("two.tess:"));
    }
  }
  EXPECT_THROW(read_tess(folder / "absent.tess"), DataError);
  EXPECT_THROW(read_tess(folder.path()), DataError);
}

TEST_F(TessFiles, give_their_seeds_as_disks_whose_radii_are_the_weights) {
  const Packing packing = read_packing(write(kTwo));
  ASSERT_EQ(packing.disks.size(), 2u);
  EXPECT_EQ(packing.disks[0].centre, Vec2(0.5, 0.5));
  EXPECT_EQ(packing.disks[0].radius, 0.25);
  EXPECT_EQ(packing.box.lo, Vec2(0, 0));
  EXPECT_EQ(packing.box.hi, Vec2(2, 1));
}

TEST_F(TessFiles, with_weights_of_zero_give_the_same_tiles) {
  // Between (0.5, w = 0) and (1.5, w = 0.5) the bisector of powers is x = 1 + (0 - 0.25) / 2 = 0.875.
  std::string text = kTwo;
  text.replace(text.find("0 0.25"), 6, "0 0");
  text.replace(text.find("0 0.25"), 6, "0 0.5");
  const Packing packing = read_packing(write(text));
  EXPECT_GT(packing.disks[0].radius, 0);
  EXPECT_EQ(packing.notes.size(), 1u);
  const Tessellation tiles = tessellate(packing.disks, packing.box);
  EXPECT_NEAR(tile_area(tiles, tiles.tiles[0]), 0.875, 1e-12);
}

TEST_F(TessFiles, without_seeds_or_with_seeds_out_of_place_are_no_packing) {
  const auto message = [&](const std::string& text) {
    try {
      read_packing(write(text));
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("no fault");
  };
  std::string none = kTwo;
  none.erase(none.find("  *seed"), none.find("  *ori") - none.find("  *seed"));
  EXPECT_THAT(message(none), HasSubstr("has no *seed"));
  std::string outside = kTwo;
  outside.replace(outside.find("2 1.5 0.5"), 9, "2 2.5 0.5");
  EXPECT_THAT(message(outside), HasSubstr("two.tess:14: the seed (2.5, 0.5) lies outside the box"));
  std::string twice = kTwo;
  twice.replace(twice.find("2 1.5 0.5"), 9, "2 0.5 0.5");
  EXPECT_THAT(message(twice), HasSubstr("two.tess:14: a seed at the place of the one in line 13"));
}

}  // namespace
}  // namespace lamella
