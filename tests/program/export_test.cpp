// Cells for other programs and the report of a sample, as a user asks for them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/program/program.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class exporting : public testing::Test {
 protected:
  TemporaryFolder folder;
  std::string scene = write_file(folder / "scene.toml", kHoneycomb);
  std::string at(const std::string& name) const { return (folder / name).string(); }
  std::string text(const std::string& name) const { return read_file(folder / name); }
};

TEST_F(exporting, writes_each_format_by_its_ending) {
  std::string command = "generate " + scene + " -q -o " + at("sample.h5");
  for (const char* ending : {"csv", "tess", "off", "txt", "vtp", "svg", "png", "pdf"})
    command += " --export " + at(std::string("made.") + ending);
  const Outcome made = lamella_program(command);
  ASSERT_EQ(made.status, 0) << made.said;
  EXPECT_EQ(made.said, "");
  EXPECT_THAT(text("made_cells.csv"), AllOf(StartsWith("cell,group,x [m]"), HasSubstr(",number\n")));
  EXPECT_THAT(text("made_walls.csv"), StartsWith("cell_a,cell_b"));
  EXPECT_THAT(text("made_vertices.csv"), StartsWith("vertex,x [m]"));
  EXPECT_THAT(text("made.tess"), StartsWith("***tess\n **format\n   3.4"));
  EXPECT_THAT(text("made.off"), StartsWith("OFF\n"));
  EXPECT_THAT(text("made.txt"), StartsWith("x y cell\n"));
  EXPECT_THAT(text("made.vtp"), AllOf(HasSubstr("VTKFile"), HasSubstr("neighbours")));
  EXPECT_THAT(text("made.svg"), HasSubstr("<svg"));
  EXPECT_THAT(text("made.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(text("made.pdf"), StartsWith("%PDF"));
  // From the sample's file, which keeps the tiles: the same.
  for (const char* name : {"off", "tess", "txt", "svg"}) {
    ASSERT_EQ(lamella_program("export " + at("sample.h5") + " -q -o " + at(std::string("again.") + name)).said, "");
    EXPECT_EQ(text(std::string("again.") + name), text(std::string("made.") + name)) << name;
  }
}

TEST_F(exporting, and_reading_again_is_the_same_tissue) {
  ASSERT_EQ(lamella_program("generate " + scene + " -q -o " + at("a.h5") + " --export " + at("a.tess")).said, "");
  std::string imported = kHoneycomb;
  imported.replace(imported.find("kind = \"honeycomb\""), 18, "kind = \"polygons\"\nfile = \"a.tess\"");
  for (const char* line : {"columns = 3\n", "rows = 3\n", "side = \"20 um\"\n"})
    imported.erase(imported.find(line), std::string(line).size());
  write_file(folder / "again.toml", imported);
  const Outcome again =
      lamella_program("generate " + at("again.toml") + " -q -o " + at("b.h5") + " --export " + at("b.tess"));
  ASSERT_EQ(again.status, 0) << again.said;
  EXPECT_EQ(text("b.tess"), text("a.tess"));
  ASSERT_EQ(lamella_program("export " + at("a.h5") + " --of outlines -q -o " + at("a.off")).said, "");
  ASSERT_EQ(lamella_program("export " + at("b.h5") + " --of outlines -q -o " + at("b.off")).said, "");
  EXPECT_EQ(text("b.off"), text("a.off")) << "the same shells, to the last bit";
}

/// The last column of a table.
std::vector<long> last_column(const std::string& table) {
  std::vector<long> column;
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) column.push_back(std::stol(line.substr(line.rfind(',') + 1)));
  return column;
}

TEST_F(exporting, names_cells_by_the_disks_they_are_made_of_though_some_are_left_out) {
  // Disks from right to left: cells are ordered the other way. The second is there twice, the fifth is hidden by the fourth.
  write_file(folder / "disks.csv",
             "x,y,r\n0.9,0.5,0.1\n0.7,0.5,0.1\n0.7,0.5,0.1\n0.4,0.5,0.1\n0.41,0.5,0.01\n0.1,0.5,0.1\n");
  write_file(folder / "disks.toml",
             "[sample]\nkind = \"tissue\"\nwidth = 1\nheight = 1\nwalls.segments = 4\n"
             "packing = { file = \"disks.csv\", duplicates = \"keep_first\" }\n[cells]\nthickness = 1e-3\n");
  const Outcome made = lamella_program("generate " + at("disks.toml") + " -o " + at("s.h5") + " --export " +
                                       at("made.csv") + " --export " + at("made.tess"));
  ASSERT_EQ(made.status, 0) << made.said;
  EXPECT_THAT(made.said, AllOf(HasSubstr("occur earlier in the file: 2 (line 4)"), HasSubstr("have no cell: site 4")));
  EXPECT_THAT(last_column(text("made_cells.csv")), testing::ElementsAre(5, 3, 1, 0));
  ASSERT_EQ(lamella_program("export " + at("s.h5") + " -q -o " + at("again.csv")).said, "");
  EXPECT_EQ(text("again_cells.csv"), text("made_cells.csv"));
  EXPECT_THAT(text("made.tess"), HasSubstr("*seed\n   1 0.1 0.5 0 0.1\n   2 0.4 0.5 0 0.1\n"));
}

TEST_F(exporting, seeds_of_cells_with_exact_areas_have_these_areas) {
  const std::string cells = "walls = { segments = 6, weld = 0 }\n[cells]\nthickness = 1e-4\n";
  for (const std::string periodic : {"none", "xy"}) {
    write_file(folder / "exact.toml", "[sample]\nkind = \"tissue\"\nwidth = 1\nheight = 1\nperiodic = \"" + periodic +
                                          "\"\npacking = { count = 60, fraction = 0.7 }\nareas = { sweeps = 3 }\n" +
                                          cells);
    write_file(folder / "again.toml", "[sample]\nkind = \"tissue\"\nwidth = 1\nheight = 1\nperiodic = \"" + periodic +
                                          "\"\npacking.file = \"exact.tess\"\n" + cells);
    ASSERT_EQ(lamella_program("generate " + at("exact.toml") + " -q -o " + at("exact.h5") + " --export " +
                              at("exact.tess") + " --export " + at("exact.csv"))
                  .said,
              "");
    ASSERT_EQ(
        lamella_program("generate " + at("again.toml") + " -q -o " + at("again.h5") + " --export " + at("again.csv"))
            .said,
        "");
    const auto area = [&](const std::string& name) {
      std::vector<double> column;
      std::istringstream lines(text(name));
      std::string line, cell;
      std::getline(lines, line);
      while (std::getline(lines, line)) {
        std::istringstream row(line);
        for (int k = 0; k < 5; ++k) std::getline(row, cell, ',');
        column.push_back(std::stod(cell));
      }
      return column;
    };
    const auto exact = area("exact_cells.csv"), again = area("again_cells.csv");
    ASSERT_EQ(exact.size(), 60u);
    ASSERT_EQ(again.size(), 60u);
    for (std::size_t k = 0; k < 60; ++k) EXPECT_NEAR(again[k] / exact[k], 1, 1e-11) << periodic << " " << k;
  }
}

TEST_F(exporting, refuses_what_it_cannot_write_before_any_work) {
  const Outcome unknown = lamella_program("generate " + scene + " -o " + at("s.h5") + " --export " + at("cells.stl"));
  EXPECT_EQ(unknown.status, 4);
  EXPECT_THAT(unknown.said, HasSubstr("cells.stl: unknown format \".stl\"; must end in .csv, .tess, .off"));
  EXPECT_FALSE(std::filesystem::exists(folder / "s.h5"));
  EXPECT_EQ(lamella_program("export " + at("absent.h5") + " -o " + at("a.off")).status, 4);
  write_file(folder / "no.h5", "text");
  EXPECT_THAT(lamella_program("export " + at("no.h5") + " -o " + at("a.off")).said, HasSubstr("is not an HDF5 file"));
}

TEST_F(exporting, of_a_frame_gives_its_outlines) {
  ASSERT_EQ(lamella_program("run " + scene + " -q -o " + at("all")).status, 0);
  const std::string trajectory = at("all/trajectory.h5");
  ASSERT_EQ(lamella_program("export " + trajectory + " -q --frame 0 -o " + at("first.off")).said, "");
  ASSERT_EQ(lamella_program("export " + trajectory + " -q -o " + at("last.off")).said, "");
  EXPECT_NE(text("first.off"), text("last.off"));
  EXPECT_THAT(lamella_program("export " + trajectory + " -o " + at("a.tess")).said, HasSubstr("outlines are no tess"));
  EXPECT_THAT(lamella_program("export " + trajectory + " --of tiles -o " + at("a.off")).said, HasSubstr("no tiles"));
}

TEST_F(exporting, report_has_numbers_tables_and_pictures) {
  const Outcome made = lamella_program("generate " + scene + " -o " + at("s.h5") + " --report " + at("report") +
                                       " --set sample.columns=6 --set sample.rows=6");
  ASSERT_EQ(made.status, 0) << made.said;
  const auto json = nlohmann::json::parse(text("report/statistics.json"));
  EXPECT_EQ(json["sample"]["cells"]["value"], 36);
  EXPECT_EQ(json["neighbours"]["counted_cells"]["value"], 16);
  EXPECT_EQ(json["neighbours"]["mean_neighbours"]["value"], 6);
  EXPECT_EQ(json["by_neighbours"][0]["n"], 6);
  EXPECT_NEAR(json["sizes and shapes"]["circularity"]["value"].get<double>(), 0.9069, 1e-4);
  EXPECT_THAT(text("report/statistics.csv"), HasSubstr("\n6,16,1,1,0,4,6,0\n"));
  EXPECT_THAT(text("report/report.html"), AllOf(HasSubstr("data:image/png;base64"), HasSubstr("Mean neighbours")));
  for (const char* name : {"tissue.png", "tissue.pdf", "areas.png", "neighbours.png", "lewis.png", "aboav_weaire.pdf"})
    EXPECT_TRUE(std::filesystem::exists(folder / "report" / name)) << name;
}

TEST_F(exporting, report_of_a_sample_without_tiles_shows_what_there_is) {
  write_file(folder / "ring.toml",
             "[sample]\nkind = \"shapes\"\n[[sample.shapes]]\nkind = \"ring\"\nsize = 1e-3\nsegments = 40\n"
             "[cells]\nthickness = \"10 um\"\nyoung = \"1 MPa\"\ndensity = 1000\n");
  const Outcome made =
      lamella_program("generate " + at("ring.toml") + " -o " + at("s.h5") + " --report " + at("report"));
  ASSERT_EQ(made.status, 0) << made.said;
  EXPECT_THAT(text("report/report.html"), HasSubstr("The sample."));
  EXPECT_FALSE(std::filesystem::exists(folder / "report" / "statistics.csv"));
  EXPECT_EQ(lamella_program("export " + at("s.h5") + " -q -o " + at("ring.txt")).status, 0);
}

}  // namespace
}  // namespace lamella
