#include "postproc/postproc.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "generator/sample/errors.h"
#include "tests/postproc/hexagons.h"

namespace lamella {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Step {
  double time;
  fs::path file;
};

std::vector<Step> steps_of(const fs::path& pvd) {
  const std::string text = text_of(pvd);
  static const std::regex entry("timestep=\"([^\"]+)\" part=\"0\" file=\"([^\"]+)\"");
  std::vector<Step> steps;
  for (std::sregex_iterator at(text.begin(), text.end(), entry), end; at != end; ++at)
    steps.push_back({std::stod((*at)[1]), fs::path((*at)[2].str())});
  return steps;
}

vtkSmartPointer<vtkPolyData> read_mesh(const fs::path& path) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::vector<std::string> names_of(vtkFieldData* data) {
  std::vector<std::string> names;
  for (int k = 0; k < data->GetNumberOfArrays(); ++k) names.emplace_back(data->GetArrayName(k));
  return names;
}

/// One trajectory and its output for all tests that only look at it.
class Posted : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    // ctest runs each test in a process of its own, and several at once
    folder_ = fs::path(testing::TempDir()) / "lamella_postproc" / ("posted_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    trajectory_ = made_up_tensile_test(folder_, 6, 6, 13);
    result_ = post(trajectory_, folder_ / "out", {});
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }
  static inline fs::path folder_, trajectory_;
  static inline PostResult result_;
};

TEST_F(Posted, every_file_it_names_is_there) {
  for (const char* name : {"cells.pvd", "walls.pvd", "links.pvd", "cracks.pvd", "view.py", "response.csv", "events.csv",
                           "summary.json", "report.html", "snapshots.png", "snapshots.pdf", "stress_strain.png",
                           "crack_path.png", "final_state.png", "energy_ledger.png"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  for (const fs::path& file : result_.files) EXPECT_TRUE(fs::exists(file)) << file;
  EXPECT_FALSE(fs::exists(folder_ / "out" / "contacts.pvd")) << "the scene has no contact";
}

TEST_F(Posted, a_series_has_relative_paths_increasing_times_and_the_same_arrays_in_every_step) {
  TrajectoryReader reader(trajectory_);
  for (const char* name : {"cells", "walls", "links", "cracks"}) {
    const std::vector<Step> steps = steps_of(folder_ / "out" / (std::string(name) + ".pvd"));
    ASSERT_EQ(static_cast<int>(steps.size()), reader.frames()) << name;
    std::vector<std::string> cell_arrays, point_arrays;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      EXPECT_FALSE(steps[k].file.is_absolute());
      EXPECT_GT(steps[k].time, k > 0 ? steps[k - 1].time : -1.0);
      EXPECT_DOUBLE_EQ(steps[k].time, reader.frame(static_cast<int>(k)).time);
      const auto mesh = read_mesh(folder_ / "out" / steps[k].file);
      ASSERT_TRUE(mesh->GetFieldData()->GetArray("TimeValue")) << name;
      EXPECT_DOUBLE_EQ(mesh->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), steps[k].time);
      if (k == 0) cell_arrays = names_of(mesh->GetCellData()), point_arrays = names_of(mesh->GetPointData());
      EXPECT_EQ(names_of(mesh->GetCellData()), cell_arrays) << name << " step " << k;
      EXPECT_EQ(names_of(mesh->GetPointData()), point_arrays) << name << " step " << k;
      for (vtkFieldData* data :
           {static_cast<vtkFieldData*>(mesh->GetCellData()), static_cast<vtkFieldData*>(mesh->GetPointData())})
        for (int a = 0; a < data->GetNumberOfArrays(); ++a) {
          vtkDataArray* array = data->GetArray(a);
          for (vtkIdType i = 0; i < array->GetNumberOfTuples() * array->GetNumberOfComponents(); ++i)
            ASSERT_TRUE(std::isfinite(array->GetComponent(i / array->GetNumberOfComponents(),
                                                          static_cast<int>(i % array->GetNumberOfComponents()))))
                << name << "/" << array->GetName();
        }
    }
  }
}

TEST_F(Posted, cracks_are_empty_at_first_with_all_their_arrays) {
  const auto first = read_mesh(folder_ / "out" / "vtk" / "cracks_0000.vtp");
  EXPECT_EQ(first->GetNumberOfCells(), 0);
  EXPECT_THAT(names_of(first->GetCellData()), testing::IsSupersetOf({"length", "opening", "time", "crack_id"}));
  const auto last = read_mesh(folder_ / "out" / "vtk" / "cracks_0012.vtp");
  ASSERT_EQ(last->GetNumberOfCells(), 1);
  EXPECT_EQ(last->GetCellData()->GetArray("from_side_to_side")->GetTuple1(0), 1);
}

TEST_F(Posted, links_show_their_forces_and_where_they_soften_their_damage) {
  const auto mesh = read_mesh(folder_ / "out" / "vtk" / "links_0000.vtp");
  EXPECT_THAT(names_of(mesh->GetCellData()), testing::IsSupersetOf({"f_n", "f_t", "energy", "zeta", "damage"}));
  EXPECT_EQ(mesh->GetCellData()->GetArray("damage")->GetTuple1(0), 0.25);
}

TEST_F(Posted, cells_are_polygons_with_integer_ids_and_nine_components_of_stress) {
  TrajectoryReader reader(trajectory_);
  const auto mesh = read_mesh(folder_ / "out" / "vtk" / "cells_0012.vtp");
  EXPECT_EQ(mesh->GetNumberOfPolys(), reader.sample().cells());
  EXPECT_EQ(mesh->GetCellData()->GetArray("cell_id")->GetDataType(), VTK_INT);
  EXPECT_EQ(mesh->GetCellData()->GetArray("fragment_id")->GetRange()[1], 1);
  EXPECT_EQ(mesh->GetCellData()->GetArray("stress")->GetNumberOfComponents(), 9);
  EXPECT_FALSE(mesh->GetCellData()->GetArray("pressure")) << "no core, no pressure";
  EXPECT_FALSE(mesh->GetCellData()->GetArray("energy_bend")) << "no hinges, no bending";
}

TEST_F(Posted, the_summary_finds_what_the_test_was_made_of) {
  const auto value = [&](const char* key) {
    const Quantity* q = result_.summary.find(key);
    EXPECT_TRUE(q) << key;
    return q ? q->value : std::nan("");
  };
  EXPECT_NEAR(value("young_modulus"), 2e6, 2);
  EXPECT_NEAR(value("poisson_ratio"), 0.3, 1e-6);
  EXPECT_NEAR(value("strain_at_peak"), 0.04, 5e-4);
  EXPECT_NEAR(value("strain_at_failure"), 0.0432, 5e-4);
  EXPECT_EQ(value("through_cracks"), 1);
  EXPECT_EQ(value("fragments"), 2);
  EXPECT_EQ(value("ledger_residual"), 0);
  EXPECT_GT(value("path_roughness_in_cells"), 0.05);
}

TEST_F(Posted, every_number_of_the_json_has_a_unit_and_a_definition) {
  const auto json = nlohmann::json::parse(text_of(folder_ / "out" / "summary.json"));
  EXPECT_EQ(json["ended"], "made up");
  EXPECT_EQ(json["provenance"]["kind"], "tension");
  int numbers = 0;
  for (const char* group : {"test", "fracture", "accuracy", "sample", "run"})
    for (const auto& [key, q] : json[group].items()) {
      EXPECT_TRUE(q["value"].is_number()) << key;
      EXPECT_FALSE(q["unit"].get<std::string>().empty()) << key;
      EXPECT_GT(q["definition"].get<std::string>().size(), 5u) << key;
      ++numbers;
    }
  EXPECT_GT(numbers, 25);
}

TEST_F(Posted, the_report_needs_no_other_file_and_no_network) {
  const std::string html = text_of(folder_ / "out" / "report.html");
  EXPECT_EQ(html.find("http"), std::string::npos);
  EXPECT_EQ(html.find("href"), std::string::npos);
  EXPECT_EQ(html.find("file:"), std::string::npos);
  std::size_t pictures = 0;
  for (std::size_t at = html.find("src=\""); at != std::string::npos; at = html.find("src=\"", at + 1), ++pictures)
    EXPECT_EQ(html.compare(at, 27, "src=\"data:image/png;base64,"), 0);
  EXPECT_EQ(pictures, 5u);
  EXPECT_NE(html.find("&lt;of hexagons&gt;"), std::string::npos) << "text of the user's is escaped";
}

TEST_F(Posted, the_tables_have_units_in_their_heads_and_a_row_for_each_event) {
  const std::string response = text_of(folder_ / "out" / "response.csv"),
                    events = text_of(folder_ / "out" / "events.csv");
  EXPECT_EQ(response.rfind("time [s],stage [1],strain [1],stress [Pa]", 0), 0u);
  TrajectoryReader reader(trajectory_);
  EXPECT_EQ(static_cast<std::size_t>(std::count(events.begin(), events.end(), '\n')), reader.events().size() + 1);
}

TEST(Post, a_shorter_run_leaves_no_frames_of_a_longer_one) {
  const fs::path folder = fresh_folder();
  post(made_up_tensile_test(folder, 3, 2, 7), folder / "out", {.pictures = false, .progress = {}});
  EXPECT_TRUE(fs::exists(folder / "out" / "vtk" / "cells_0006.vtp"));
  post(made_up_tensile_test(folder, 3, 2, 5), folder / "out", {.pictures = false, .progress = {}});
  EXPECT_TRUE(fs::exists(folder / "out" / "vtk" / "cells_0004.vtp"));
  EXPECT_FALSE(fs::exists(folder / "out" / "vtk" / "cells_0005.vtp"));
  EXPECT_FALSE(fs::exists(folder / "out" / "vtk" / "cells_0006.vtp"));
}

TEST(Post, a_ring_without_links_or_loads_is_shown_too) {
  const fs::path folder = fresh_folder();
  Sample sample;
  sample.cell_begin = {0};
  std::vector<Vec2> ring;
  for (int k = 0; k < 40; ++k) ring.emplace_back(std::cos(M_PI * k / 20), std::sin(M_PI * k / 20));
  add_cell(sample, ring, true, 0.05, "cells");
  sample.side.assign(sample.nodes(), 0);
  sample.tile_area.resize(1);
  sample.box = {Vec2(-2, -2), Vec2(2, 2)};
  TrajectoryWriter writer(folder / "ring.h5", sample, {});
  for (int k = 0; k < 3; ++k) {
    Frame frame;
    frame.time = k;
    std::vector<double> flat;
    for (const Vec2& p : sample.x) flat.push_back(p.x() * (1 + 0.1 * k)), flat.push_back(p.y());
    frame.arrays.add({"x", "m", "node", 2, flat});
    frame.arrays.add({"hinge_energy", "J", "cell", 1, std::vector<double>{1e-3 * k}});
    // contacts appear with the second stage only
    frame.stage = k == 0 ? 0 : 1;
    if (k > 0) {
      frame.arrays.add({"contact_position", "m", "contact", 2, std::vector<double>{1, 0}});
      frame.arrays.add({"contact_normal", "1", "contact", 2, std::vector<double>{-1, 0}});
      frame.arrays.add({"contact_force", "N", "contact", 2, std::vector<double>{1, 0}});
      frame.arrays.add({"contact_node", "1", "contact", 1, std::vector<std::int32_t>{0}});
      frame.arrays.add({"contact_cell", "1", "contact", 1, std::vector<std::int32_t>{0}});
    }
    writer.write_frame(frame, {});
  }
  writer.finish("done");
  post(folder / "ring.h5", folder / "out", {});
  for (const char* name : {"cells.pvd", "walls.pvd", "contacts.pvd", "snapshots.png", "report.html", "summary.json"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  for (const char* name : {"links.pvd", "cracks.pvd", "crack_path.png", "stress_strain.png", "events.csv"})
    EXPECT_FALSE(fs::exists(folder / "out" / name)) << name;
  ASSERT_EQ(steps_of(folder / "out" / "contacts.pvd").size(), 3u);
  const auto first = read_mesh(folder / "out" / "vtk" / "contacts_0000.vtp");
  EXPECT_EQ(first->GetNumberOfCells(), 0);
  EXPECT_TRUE(first->GetCellData()->GetArray("f_n"));
  const auto second = read_mesh(folder / "out" / "vtk" / "contacts_0001.vtp");
  ASSERT_EQ(second->GetNumberOfCells(), 1);
  EXPECT_GT(second->GetLength(), 0) << "one contact alone has an extent";
}

TEST(Post, a_missing_trajectory_is_refused_and_nothing_is_made) {
  const fs::path folder = fresh_folder();
  EXPECT_THROW(post(folder / "none.h5", folder / "out", {}), DataError);
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(Post, a_folder_that_cannot_be_made_is_named) {
  const fs::path folder = fresh_folder();
  const fs::path trajectory = made_up_tensile_test(folder, 2, 2, 3);
  std::ofstream(folder / "blocked") << "a file";
  try {
    post(trajectory, folder / "blocked" / "out", {});
    FAIL() << "must be refused";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("blocked"), std::string::npos);
  }
}

TEST(Post, an_opened_cell_is_shown_as_the_bars_that_are_left) {
  const fs::path folder = fresh_folder();
  const Sample sample = hexagon_tissue(2, 1, 1, 3, 0.05);
  {
    TrajectoryWriter writer(folder / "burst.h5", sample, {});
    for (int k = 0; k < 3; ++k) {
      Frame frame = plain_frame(sample, sample.x, k);
      std::vector<std::int32_t> broken(sample.nodes(), 0);
      std::vector<double> time(sample.nodes(), -1.0);
      if (k > 0) broken[4] = 1, time[4] = 0.5;  // of the first cell
      if (k > 1) broken[20] = 1, time[20] = 1.5;
      frame.arrays.add({"bar_broken", "1", "segment", 1, broken});
      frame.arrays.add({"bar_break_time", "s", "segment", 1, time});
      if (k > 0) writer.add_event({.time = k - 0.5, .link = -1, .bar = k == 1 ? 4 : 20, .f_n = 2, .energy = 1e-9});
      writer.write_frame(frame, {});
    }
    writer.finish("done");
  }
  post(folder / "burst.h5", folder / "out", {});
  const auto cells = [&](const char* series, int frame) {
    return read_mesh(folder / "out" / "vtk" / fmt::format("{}_{:04}.vtp", series, frame))->GetNumberOfCells();
  };
  EXPECT_EQ(cells("cells", 0), 2);
  EXPECT_EQ(cells("cells", 1), 1);
  EXPECT_EQ(cells("cells", 2), 0);
  EXPECT_EQ(cells("walls", 0), 36);
  EXPECT_EQ(cells("walls", 1), 35);
  EXPECT_EQ(cells("walls", 2), 34);
  const std::string events = text_of(folder / "out" / "events.csv");
  EXPECT_NE(events.find("energy [J],bar [1]\n"), std::string::npos);
  EXPECT_NE(events.find(",4\n"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "out" / "crack_path.png"));
  const auto summary = nlohmann::json::parse(text_of(folder / "out" / "summary.json"));
  EXPECT_EQ(summary.at("fracture").at("broken_bars").at("value"), 2);
  EXPECT_EQ(summary.at("fracture").at("opened_cells").at("value"), 2);
}

}  // namespace
}  // namespace lamella
