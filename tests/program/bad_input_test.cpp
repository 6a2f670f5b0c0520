// Whatever is wrong with the input, the program says what and what would be right, ends with the status that says whose
// fault it is, and leaves existing output as it was.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/program/program.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using testing::AllOf;
using testing::HasSubstr;

MATCHER_P2(ends_with, status, what, "") {
  *result_listener << "status " << arg.status << ", said:\n" << arg.said;
  return arg.status == status && arg.said.find(what) != std::string::npos;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

class bad_input : public testing::Test {
 protected:
  TemporaryFolder folder;

  Outcome check(const std::string& text) { return lamella_program("check " + write_file(folder / "scene.toml", text)); }
  Outcome run(const std::string& text, const std::string& more = "") {
    return lamella_program("run " + write_file(folder / "scene.toml", text) + " -o " + (folder / "out").string() + " " +
                           more);
  }
};

TEST_F(bad_input, arguments_that_are_not_understood_exit_2) {
  EXPECT_THAT(lamella_program(""), ends_with(2, "subcommand"));
  EXPECT_THAT(lamella_program("fracture"), ends_with(2, "subcommand is required"));
  EXPECT_THAT(lamella_program("run --frobnicate"), ends_with(2, "SCENE is required"));
  EXPECT_THAT(lamella_program("describe --frobnicate"), ends_with(2, "frobnicate"));
  EXPECT_THAT(lamella_program("run x.toml"), ends_with(2, "--output is required"));
  EXPECT_THAT(lamella_program("run x.toml -o y --seeds 1-3 --seed 1"), ends_with(2, "excludes"));
  EXPECT_THAT(lamella_program("run x.toml -o y --jobs 2"), ends_with(2, "--seeds"));
  EXPECT_THAT(run(kHoneycomb, "--seeds 3"), ends_with(2, "for instance --seeds 1-10"));
  EXPECT_THAT(run(kHoneycomb, "--seeds 3-1"), ends_with(2, "not a range"));
  EXPECT_THAT(run(kHoneycomb, "--seed -1"), ends_with(2, "--seed"));
  EXPECT_THAT(run(kHoneycomb, "--threads 0"), ends_with(2, "run.threads: 0 is out of range"));
  EXPECT_THAT(lamella_program("generate x.toml -o y --threads 0"), ends_with(2, "--threads"));
}

TEST_F(bad_input, folders_that_are_no_studies_are_named_all_at_once) {
  const std::string out = " -o " + (folder / "out").string();
  const Outcome outcome = lamella_program("study pipelines/program nowhere/beams" + out);
  EXPECT_THAT(outcome, ends_with(2, "pipelines/program: is no study; studies are beams"));
  EXPECT_THAT(outcome, ends_with(2, "nowhere/beams: is not there"));
  const std::string beams = LAMELLA_SOURCE_DIR "/pipelines/beams";
  EXPECT_THAT(lamella_program("study " + beams + " " + beams + "/" + out), ends_with(2, "is given twice"));
  EXPECT_THAT(lamella_program("study " + beams), ends_with(2, "--output is required"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_F(bad_input, a_file_that_is_not_there_or_no_file_exits_4) {
  const std::string absent = (folder / "absent").string(), out = (folder / "out").string();
  EXPECT_THAT(lamella_program("check " + absent), ends_with(4, "absent: no such file"));
  EXPECT_THAT(lamella_program("check " + folder.path().string()),
              ends_with(4, "is a folder; give the path of a scene"));
  const std::string scene = write_file(folder / "scene.toml", kHoneycomb);
  EXPECT_THAT(lamella_program("simulate " + scene + " --sample " + absent + " -o " + out), ends_with(4, "absent"));
  EXPECT_THAT(lamella_program("post " + absent + " -o " + out), ends_with(4, "absent"));
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(bad_input, frames_that_are_not_there_exit_2) {
  const std::string scene = write_file(folder / "scene.toml", kHoneycomb), out = (folder / "out.h5").string();
  ASSERT_EQ(lamella_program("run " + scene + " -q --set output.frames=2 -o " + (folder / "all").string()).status, 0);
  const std::string extract = "extract " + (folder / "all/trajectory.h5").string() + " -o " + out;
  EXPECT_THAT(lamella_program(extract + " --frame 4"),
              ends_with(2, "frame 4: the trajectory has 4 frames; give 0 to 3"));
  EXPECT_THAT(lamella_program(extract + " --frame -5"), ends_with(2, "frame -5"));
  EXPECT_THAT(lamella_program(extract + " --frame two"), ends_with(2, "--frame"));
  EXPECT_THAT(lamella_program("extract " + (folder / "all/sample.h5").string() + " -o " + out),
              ends_with(4, "sample.h5"));
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(bad_input, truncated_and_foreign_binary_files_exit_4) {
  const std::string scene = write_file(folder / "scene.toml", kHoneycomb), out = (folder / "out").string();
  ASSERT_EQ(lamella_program("generate " + scene + " -q -o " + (folder / "sample.h5").string()).status, 0);
  const std::string whole = read_file(folder / "sample.h5");
  for (const std::string& text : {std::string("not HDF5"), std::string(), whole.substr(0, whole.size() / 2)}) {
    const std::string broken = write_file(folder / "broken.h5", text);
    EXPECT_THAT(lamella_program("simulate " + scene + " --sample " + broken + " -o " + out), ends_with(4, "broken.h5"));
    EXPECT_THAT(lamella_program("post " + broken + " -o " + out), ends_with(4, "broken.h5"));
  }
  EXPECT_THAT(lamella_program("post " + (folder / "sample.h5").string() + " -o " + out), ends_with(4, "sample.h5"));
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(bad_input, every_fault_of_a_scene_is_said_at_once_with_its_line) {
  const Outcome outcome = check(replaced(replaced(kHoneycomb, "young = \"100 MPa\"", "yuong = \"100 MPa\""),
                                         "strain = 0.02", "strain = \"1 m\""));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.said, AllOf(HasSubstr("scene.toml:10: cells.yuong: unknown key; did you mean \"young\"?"),
                                  HasSubstr("scene.toml:8: cells.young: missing"),
                                  HasSubstr("scene.toml:19: loading.strain: \"1 m\" is of another dimension")));
}

TEST_F(bad_input, values_that_cannot_be_exit_2) {
  EXPECT_THAT(check("[cells"), ends_with(2, "scene.toml:1: not TOML"));
  EXPECT_THAT(check("\xff\xfe"), ends_with(2, "scene.toml:1: not TOML"));
  EXPECT_THAT(check(""), ends_with(2, "scene.toml:1: cells: missing"));
  EXPECT_THAT(check(kHoneycomb + std::string("[stop]\nvoid_ratio = 0\n")),
              ends_with(2, "stop.void_ratio: 0 is out of range"));
  EXPECT_THAT(check(kHoneycomb + std::string("[stop]\ncompaction = 1\n")),
              ends_with(2, "stop.compaction: 1 is out of range"));
  EXPECT_THAT(check(kHoneycomb + std::string("[stop]\ncompaction = 0.1\n")),
              ends_with(2, "stop.compaction: needs closed cells between walls on all four sides"));
  EXPECT_THAT(check(replaced(kHoneycomb, "density = 1000", "density = 0")),
              ends_with(2, "cells.density: 0 is out of range"));
  EXPECT_THAT(check(replaced(kHoneycomb, "density = 1000", "density = nan")),
              ends_with(2, "cells.density: nan is not finite"));
  EXPECT_THAT(check(replaced(kHoneycomb, "density = 1000", "density = -1")),
              ends_with(2, "cells.density: -1 is out of range"));
  EXPECT_THAT(check(replaced(kHoneycomb, "strain = 0.02", "speed = 1")),
              ends_with(2, "loading.speed: contradicts strain_rate"));
  EXPECT_THAT(check(replaced(kHoneycomb, "kind = \"honeycomb\"", "kind = \"blocks\"")),
              ends_with(2, "\"blocks\" is not known"));
  EXPECT_THAT(run(kHoneycomb, "--set loading.strain=-1"),
              ends_with(2, "--set loading.strain=-1: loading.strain: -1 is out of range"));
  EXPECT_THAT(check(replaced(kHoneycomb, "[sample]", "[sample]\nwidth = 1")), ends_with(2, "sample.height: missing"));
}

TEST_F(bad_input, links_that_cannot_soften_exit_2_with_the_least_toughness_that_works) {
  // 20 N/m: 200 pJ/m in opening, 2 nJ/m in shear.
  const std::string zone =
      replaced(kHoneycomb, "[loading]", "law = \"cohesive_zone\"\ntoughness = \"1 nJ/m\"\n[loading]");
  EXPECT_THAT(check(zone), ends_with(2, "scene.toml:12: links.toughness: 1e-09 J/m is too little"));
  EXPECT_THAT(check(zone), ends_with(2, "give at least toughness = 2.002e-09 J/m"));
  EXPECT_EQ(check(replaced(zone, "1 nJ/m", "2.01 nJ/m")).status, 0);
  EXPECT_THAT(check(replaced(zone, "1 nJ/m", "-1 nJ/m")), ends_with(2, "scene.toml:18: links.toughness: "));
  EXPECT_THAT(check(replaced(zone, "law = \"cohesive_zone\"\n", "")),
              ends_with(2, "scene.toml:17: links.toughness: is used with law = \"cohesive_zone\" only"));
}

TEST_F(bad_input, a_time_step_above_the_stable_limit_ends_the_run) {
  EXPECT_THAT(run(kHoneycomb, "--set run.time_step=1"), ends_with(3, "exceeds the stable limit"));
}

TEST_F(bad_input, loads_that_would_share_a_column_are_refused) {
  EXPECT_THAT(check(kHoneycomb + std::string("[[loads]]\nname = \"the weight\"\nnodes.cells = [0]\nforce_x = 1\n"
                                             "[[loads]]\nname = \"the-weight\"\nnodes.cells = [0]\nforce_x = 1\n"
                                             "[[loads]]\nname = \"the_weight\"\nnodes.cells = [0]\nforce_x = 1\n")),
              ends_with(2, "'the weight' and 'the_weight' would share columns of the response"));
}

TEST_F(bad_input, packings_from_elsewhere_are_checked_line_by_line) {
  const std::string scene =
      "[sample]\nkind = \"rings\"\nwidth = 10\nheight = 10\npacking.file = \"disks.csv\"\n[cells]\nthickness = "
      "0.1\nyoung = 1e6\n"
      "density = 1000\n[stop]\ntime = 1\n";
  EXPECT_THAT(check(scene), ends_with(4, "disks.csv"));
  for (const auto& [text, what] : {std::pair{"x,y,r\n2,2,nan\n", "disks.csv:2"},
                                   {"x,y,r\n2,2,-1\n", "disks.csv:2"},
                                   {"x,y,r\n2,2\n", "disks.csv:2"},
                                   {"x,y,r\n2,two,1\n", "disks.csv:2"},
                                   {"x,y,r\n2,2,1\n2.5,2,1\n", "cells 0 and 1 cross"}}) {
    write_file(folder / "disks.csv", text);
    EXPECT_THAT(check(scene), ends_with(2, what)) << text;
  }
}

TEST_F(bad_input, polygons_from_elsewhere_are_checked_cell_by_cell) {
  const std::string scene =
      "[sample]\nkind = \"polygons\"\nfile = \"cells.txt\"\nwalls.spacing = 0.3\n[cells]\nthickness = 0.01\nyoung = "
      "1e6\n"
      "density = 1000\n[stop]\ntime = 1\n";
  EXPECT_THAT(check(scene), ends_with(4, "cells.txt"));
  for (const auto& [text, what] : {std::pair{"0 0 1\n1 0 1\n", "cells.txt"},
                                   {"0 0 1\n3 0 1\n3 2 1\n1 -1 1\n", "cross"},
                                   {"0 0 1\n1 nan 1\n1 1 1\n", "cells.txt:2"},
                                   {"0 0 1\n1 0\n1 1 1\n", "cells.txt:2"},
                                   {"0 0 1\n2 0 1\n2 2 1\n0 2 1\n1 1 2\n3 1 2\n3 3 2\n1 3 2\n", "overlap"}}) {
    write_file(folder / "cells.txt", text);
    EXPECT_THAT(check(scene), ends_with(2, what)) << text;
  }
  write_file(folder / "cells.txt", "0 0 1\n1 0 1\n1 1 1\n0 1 1\n");
  EXPECT_EQ(check(scene).status, 0) << check(scene).said;
}

TEST_F(bad_input, output_that_cannot_be_written_exits_4_before_anything_is_computed) {
  const std::string scene = write_file(folder / "scene.toml", kHoneycomb), file = write_file(folder / "file", "mine");
  EXPECT_THAT(lamella_program("run " + scene + " -o " + file), ends_with(4, "is not a folder"));
  EXPECT_THAT(lamella_program("run " + scene + " -o " + file + "/deeper"), ends_with(4, "is not a folder"));
  EXPECT_THAT(lamella_program("run " + scene + " -o /proc/lamella"), ends_with(4, "/proc"));
  EXPECT_THAT(lamella_program("generate " + scene + " -o " + folder.path().string()),
              ends_with(4, "is a folder; give the name of a file"));
  EXPECT_THAT(lamella_program("generate " + scene + " -o /proc/sample.h5"), ends_with(4, "/proc"));
  EXPECT_EQ(read_file(file), "mine");
}

TEST_F(bad_input, existing_output_stays_as_it_was) {
  std::filesystem::create_directories(folder / "out");
  for (const char* name : {"sample.h5", "trajectory.h5", "summary.json"}) write_file(folder / "out" / name, "precious");
  EXPECT_EQ(run(replaced(kHoneycomb, "density = 1000", "density = -1")).status, 2);
  EXPECT_EQ(run(replaced(kHoneycomb, "normal_stiffness", "normal_stifness")).status, 2);
  for (const char* name : {"sample.h5", "trajectory.h5", "summary.json"})
    EXPECT_EQ(read_file(folder / "out" / name), "precious");
  const auto files =
      std::distance(std::filesystem::directory_iterator(folder / "out"), std::filesystem::directory_iterator());
  EXPECT_EQ(files, 3);
}

TEST_F(bad_input, a_scene_without_geometry_or_end_is_told_so) {
  const std::string cells = "[cells]\nthickness = 1\nyoung = 1\ndensity = 1\n";
  EXPECT_THAT(run(cells + "[stop]\ntime = 1\n"), ends_with(2, "sample: missing"));
  EXPECT_THAT(run(cells), ends_with(2, "nothing ends the run"));
}

}  // namespace
}  // namespace lamella
