// Runs a scene through the whole program and reads what it left.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "simulator/trajectory/trajectory.h"
#include "tests/program/program.h"

namespace lamella {

inline std::string scene_path(const std::string& name) { return LAMELLA_SOURCE_DIR "/tests/regression/scenes/" + name; }

/// `lamella run SCENE -o folder`, quietly; what it said is shown when it does not end as it should.
inline void run_scene(const std::string& scene, const std::filesystem::path& folder, const std::string& options = "",
                      int status = 0) {
  const Outcome outcome = lamella_program("run '" + scene + "' -q -o '" + folder.string() + "' " + options);
  ASSERT_EQ(outcome.status, status) << outcome.said;
}

/// The numbers of summary.json. Quantities are found by "group.key".
class RunSummary {
 public:
  explicit RunSummary(const std::filesystem::path& folder)
      : json_(nlohmann::json::parse(read_file(folder / "summary.json"))) {}
  double operator()(const std::string& name) const {
    const auto dot = name.find('.');
    return json_.at(name.substr(0, dot)).at(name.substr(dot + 1)).at("value").get<double>();
  }

 private:
  nlohmann::json json_;
};

/// The values of one column of the response curve.
inline std::vector<double> response_values(const TrajectoryReader& reader, const std::string& column) {
  const Response& response = reader.response();
  for (std::size_t k = 0; k < response.columns.size(); ++k) {
    if (response.columns[k] != column) continue;
    std::vector<double> values;
    for (const auto& row : response.rows) values.push_back(row[k]);
    return values;
  }
  ADD_FAILURE() << "the response has no column " << column;
  return {};
}

using Names = std::set<std::string>;

/// Arrays of the first step of a ParaView series; empty where the run has no such series.
inline Names vtk_arrays(const std::filesystem::path& folder, const std::string& series) {
  if (!std::filesystem::exists(folder / (series + ".pvd"))) return {};
  const std::string text = read_file(folder / "vtk" / (series + "_0000.vtp"));
  static const std::regex name("<DataArray[^>]*Name=\"([^\"]*)\"");
  Names names;
  for (std::sregex_iterator at(text.begin(), text.end(), name), end; at != end; ++at) names.insert((*at)[1]);
  for (const char* geometry : {"TimeValue", "Points", "connectivity", "offsets"}) names.erase(geometry);
  return names;
}

/// Fails where two runs differ in any bit of any frame, row or event.
inline void expect_same_bits(const std::filesystem::path& a, const std::filesystem::path& b) {
  const TrajectoryReader p(a), q(b);
  EXPECT_EQ(p.response().columns, q.response().columns);
  EXPECT_TRUE(p.response().rows == q.response().rows) << "response curves differ";
  ASSERT_EQ(p.events().size(), q.events().size());
  for (std::size_t k = 0; k < p.events().size(); ++k) {
    EXPECT_EQ(p.events()[k].link, q.events()[k].link) << "event " << k;
    EXPECT_EQ(p.events()[k].time, q.events()[k].time) << "event " << k;
    EXPECT_EQ(p.events()[k].energy, q.events()[k].energy) << "event " << k;
  }
  ASSERT_EQ(p.frames(), q.frames());
  for (int k = 0; k < p.frames(); ++k) {
    const Frame f = p.frame(k), g = q.frame(k);
    EXPECT_EQ(f.time, g.time);
    EXPECT_EQ(f.step, g.step);
    ASSERT_EQ(f.arrays.all().size(), g.arrays.all().size());
    for (const NamedArray& array : f.arrays.all()) {
      const NamedArray* other = g.arrays.find(array.name);
      ASSERT_TRUE(other) << array.name;
      EXPECT_TRUE(array.data == other->data) << array.name << " differs in frame " << k;
    }
  }
}

}  // namespace lamella
