// The studies of pipelines/ in small: each `expected.toml` there says with which settings, and which numbers must come out.
#include <gmock/gmock.h>

#include <toml++/toml.h>

#include <map>

#include "tests/regression/runs.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

namespace fs = std::filesystem;

const std::string kPipelines = LAMELLA_SOURCE_DIR "/pipelines/";

/// One folder of a study, its scenes run once for all tests.
class Study {
 public:
  explicit Study(const std::string& name) : expected_(toml::parse_file(kPipelines + name + "/expected.toml")) {
    std::string options;
    for (const auto& setting : *expected_["settings"].as_array())
      options += " --set '" + setting.value<std::string>().value() + "'";
    for (const auto& [scene, numbers] : expected_)
      if (numbers.is_table())
        run_scene(kPipelines + name + "/" + std::string(scene.str()) + ".toml", at(std::string(scene.str())), options);
  }

  fs::path at(const std::string& scene) const { return folder_ / scene; }

  void expect_numbers(const std::string& scene) const {
    const RunSummary summary(at(scene));
    for (const auto& [name, limits] : *expected_[scene].as_table()) {
      const toml::table& limit = *limits.as_table();
      const std::string key(name.str());
      const double found = summary(key);
      if (const auto value = limit["value"].value<double>()) {
        EXPECT_NEAR(found / *value, 1, limit["within"].value<double>().value())
            << scene << ": " << key << " = " << found;
      }
      if (const auto most = limit["at_most"].value<double>()) {
        EXPECT_LE(found, *most) << scene << ": " << key;
      }
      if (const auto least = limit["at_least"].value<double>()) {
        EXPECT_GE(found, *least) << scene << ": " << key;
      }
    }
  }

 private:
  toml::table expected_;
  TemporaryFolder folder_;
};

const Study& tensile_fracture() {
  static const Study study("tensile_fracture");
  return study;
}
const Study& polygons() {
  static const Study study("tensile_fracture_polygons");
  return study;
}

TEST(tensile_fracture, elastic_walls_give_the_numbers_expected) { tensile_fracture().expect_numbers("elastic"); }

TEST(tensile_fracture, plastic_walls_give_the_numbers_expected) { tensile_fracture().expect_numbers("plastic"); }

TEST(tensile_fracture, elastic_tissue_is_brittle_and_plastic_tissue_stretches_further) {
  const RunSummary elastic(tensile_fracture().at("elastic")), plastic(tensile_fracture().at("plastic"));
  EXPECT_LE(elastic("test.strain_at_failure"), 1.3 * elastic("test.strain_at_peak"));
  EXPECT_GT(plastic("test.strain_at_failure"), 1.3 * elastic("test.strain_at_failure"));
}

TEST(tensile_fracture, only_plastic_walls_have_plastic_arrays) {
  const fs::path elastic = tensile_fracture().at("elastic"), plastic = tensile_fracture().at("plastic");
  const Names walls = {"cell_id", "axial_force", "moment", "velocity", "load_force", "displacement"};
  Names plastic_walls = walls;
  plastic_walls.insert({"bar_plastic_length", "hinge_plastic_angle"});
  EXPECT_EQ(vtk_arrays(elastic, "walls"), walls);
  EXPECT_EQ(vtk_arrays(plastic, "walls"), plastic_walls);
}

TEST(tensile_fracture, both_show_the_arrays_of_links_contacts_and_cracks) {
  for (const char* scene : {"elastic", "plastic"}) {
    const fs::path run = tensile_fracture().at(scene);
    EXPECT_EQ(vtk_arrays(run, "cells"),
              Names({"cell_id", "group", "energy", "energy_stretch", "energy_bend", "link_share", "energy_over_w0",
                     "area", "outline_area", "aspect", "stress", "contacts", "fragment_id"}));
    EXPECT_EQ(vtk_arrays(run, "links"),
              Names({"link_id", "wall_id", "intact", "opening", "f_n", "f_t", "energy", "zeta", "break_time"}));
    EXPECT_EQ(vtk_arrays(run, "contacts"),
              Names({"node_id", "cell_a", "cell_b", "f_n", "f_t", "normal", "force", "position", "sliding"}));
    EXPECT_EQ(vtk_arrays(run, "cracks"), Names({"crack_id", "branch", "broken_links", "from_side_to_side", "length",
                                                "crack_length", "opening", "time", "last_time"}));
  }
}

TEST(tensile_fracture, runs_beside_each_other_make_one_table_and_one_chart) {
  const fs::path out = tensile_fracture().at("both");
  const Outcome outcome = lamella_program("compare " + tensile_fracture().at("elastic").string() + " " +
                                          tensile_fracture().at("plastic").string() + " -o " + out.string());
  ASSERT_EQ(outcome.status, 0) << outcome.said;
  EXPECT_THAT(read_file(out / "comparison.csv"),
              testing::StartsWith("quantity,unit,elastic,plastic\ntest.young_modulus,Pa,"));
  EXPECT_TRUE(fs::exists(out / "comparison.png"));
}

TEST(tensile_fracture_polygons, cells_from_a_file_give_the_numbers_expected) { polygons().expect_numbers("elastic"); }

}  // namespace
}  // namespace lamella
