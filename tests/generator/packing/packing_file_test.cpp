#include "generator/packing/packing_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "generator/sample/errors.h"
#include "random_disks.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// One folder for all tests of this process: other processes run other tests at the same time.
std::filesystem::path file_of(const std::string& text) {
  static const TemporaryFolder folder;
  const auto path = folder / "packing.csv";
  std::ofstream(path) << text;
  return path;
}

std::vector<std::string> faults_of(const std::string& text, const Box* box = nullptr) {
  try {
    read_packing(file_of(text), box);
  } catch (const SceneError& error) {
    return error.faults();
  }
  return {};
}

TEST(packing_file, reads_what_was_written_bit_for_bit) {
  Packing packing;
  packing.box = {{0, 0}, {1, 1}};
  packing.disks = random_disks(100, 0.1, 1);
  const auto path = file_of("");
  write_packing(path, packing);
  const Packing read = read_packing(path, &packing.box);
  ASSERT_THAT(read.disks, SizeIs(100));
  for (std::size_t k = 0; k < 100; ++k) {
    EXPECT_EQ(read.disks[k].centre, packing.disks[k].centre);
    EXPECT_EQ(read.disks[k].radius, packing.disks[k].radius);
  }
}

TEST(packing_file, of_disks_at_one_place_the_first_may_be_kept) {
  Packing packing;
  packing.box = {{0, 0}, {4, 2}};
  packing.disks = {{{1, 1}, 0.1}, {{4, 1}, 0.2}, {{1, 1}, 0.3}, {{0, 1}, 0.4}, {{1, 2}, 0.5}, {{1, 0}, 0.6}};
  packing.target_area = {1, 2, 3, 4, 5, 6};
  Packing torus = packing;
  torus.periodic = {true, true};
  keep_first_at_each_place(packing);
  EXPECT_THAT(packing.target_area, ElementsAre(1, 2, 4, 5, 6));
  EXPECT_THAT(packing.notes, ElementsAre(HasSubstr("1 disks left out that lie where an earlier one lies")));
  keep_first_at_each_place(torus);
  EXPECT_THAT(torus.target_area, ElementsAre(1, 2, 5));
  ASSERT_THAT(torus.disks, SizeIs(3));
  EXPECT_EQ(torus.disks[2].radius, 0.5);
  EXPECT_THAT(torus.notes, ElementsAre(HasSubstr(": 2 as 0, 3 as 1, 5 as 4")));
  EXPECT_THAT(torus.number, ElementsAre(0, 1, 4));  // those that stay keep theirs
  const std::size_t notes = torus.notes.size();
  keep_first_at_each_place(torus);
  EXPECT_EQ(torus.notes.size(), notes);
}

TEST(packing_file, a_header_comments_blank_lines_and_other_separators_are_understood) {
  for (const char* text :
       {"x,y,r\n1,2,0.5\n3, 2,0.5\n", "# two disks\n\n1 2 0.5 # first\n3\t2\t5e-1\n", "1;2;0.5\r\n3;2;0.5\r\n"}) {
    const Packing packing = read_packing(file_of(text));
    ASSERT_THAT(packing.disks, SizeIs(2));
    EXPECT_EQ(packing.disks[1].centre, Vec2(3, 2));
    EXPECT_EQ(packing.box.lo, Vec2(0.5, 1.5));
    EXPECT_EQ(packing.box.hi, Vec2(3.5, 2.5));
  }
}

TEST(packing_file, every_fault_is_named_with_its_line) {
  const Box box{{0, 0}, {10, 10}};
  EXPECT_THAT(
      faults_of(
          "x,y,r\n1,2,0.5\n1,2\n1,2,3,4,5\nnan,2,1\n1,inf,1\n1,2,-1\n1,2,0\n1,two,1\n1e300,2,1\n1,2,0.5\n20,2,1\n",
          &box),
      ElementsAre(HasSubstr("packing.csv:3: 2 columns"), HasSubstr(":4: 5 columns"), HasSubstr(":5: x = nan"),
                  HasSubstr(":6: y = inf"), HasSubstr(":7: r = -1"), HasSubstr(":8: r = 0"),
                  HasSubstr(":9: y = \"two\""), HasSubstr(":10: x = 1e300"),
                  HasSubstr(":11: the same disk as in line 2"), HasSubstr(":12: the centre (20, 2)")));
  EXPECT_THAT(faults_of("1,two,1\n"), ElementsAre(HasSubstr("packing.csv:1: ")));  // a broken line is no header
  EXPECT_THAT(faults_of(""), ElementsAre(HasSubstr("holds no disk")));
  EXPECT_THAT(faults_of("x,y,r\n"), ElementsAre(HasSubstr("holds no disk")));
}

TEST(packing_file, a_fourth_column_is_the_area_of_each_cell) {
  const Packing packing = read_packing(file_of("x,y,r,target_area\n1,2,0.5,3\n3,2,0.5,0.25\n"));
  EXPECT_THAT(packing.target_area, ElementsAre(3, 0.25));
  const auto path = file_of("");
  write_packing(path, packing);
  EXPECT_EQ(read_packing(path).target_area, packing.target_area);
  EXPECT_THAT(read_packing(file_of("1,2,0.5\n3,2,0.5\n")).target_area, IsEmpty());
  const Packing fewer = read_packing(file_of("1,2,0.5,3\n1,2,0.5,4\n3,2,0.5,5\n"), nullptr, "keep_first");
  EXPECT_THAT(fewer.target_area, ElementsAre(3, 5));  // stays beside its disk

  EXPECT_THAT(faults_of("1,2,0.5,3\n3,2,0.5\n"), ElementsAre(HasSubstr("packing.csv:2: no target_area")));
  EXPECT_THAT(faults_of("1,2,0.5\n3,2,0.5,3\n"),
              ElementsAre(HasSubstr("packing.csv:2: a target_area, line 1 has none")));
  EXPECT_THAT(faults_of("1,2,0.5,0\n1,2,0.5,-3\n1,2,0.5,nan\n1,2,0.5,big\n1,2,0.5,\n"),
              ElementsAre(HasSubstr(":1: target_area = 0"), HasSubstr(":2: target_area = -3"),
                          HasSubstr(":3: target_area = nan"), HasSubstr(":4: target_area = \"big\""),
                          HasSubstr(":5: target_area = \"\"")));
}

TEST(packing_file, a_file_of_another_kind_is_not_listed_line_by_line) {
  std::string text;
  for (int k = 0; k < 1000; ++k) text += "1,2\n";
  EXPECT_THAT(faults_of(text), SizeIs(51));
}

TEST(packing_file, later_duplicates_are_left_out_on_request_and_noted) {
  Packing packing = read_packing(file_of("x,y,r\n1,2,0.5\n1,2,0.5\n3,2,0.5\n3,2,0.4\n"), nullptr, "keep_first");
  EXPECT_THAT(packing.disks, SizeIs(3));
  EXPECT_THAT(packing.notes, ElementsAre(HasSubstr("1 disks left out that occur earlier in the file: 1 (line 3); ")));
  EXPECT_THAT(packing.number, ElementsAre(0, 2, 3));  // those that stay keep theirs
  keep_first_at_each_place(packing);
  EXPECT_THAT(packing.notes.back(), HasSubstr(": 3 as 2"));
  EXPECT_THAT(packing.number, ElementsAre(0, 2));
  EXPECT_THAT(read_packing(file_of("1,2,0.5\n3,2,0.5\n")).number, IsEmpty());
}

TEST(packing_file, a_file_that_cannot_be_read_or_written_is_a_data_error) {
  EXPECT_THROW(read_packing("/nonexistent/packing.csv"), DataError);
  EXPECT_THROW(read_packing(testing::TempDir()), DataError);
  EXPECT_THROW(write_packing("/nonexistent/packing.csv", {}), DataError);
}

}  // namespace
}  // namespace lamella
