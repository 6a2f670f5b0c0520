#include "postproc/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "generator/sample/errors.h"
#include "postproc/drawing/chart.h"
#include "postproc/output_file.h"
#include "postproc/quantities/material_constants.h"

namespace lamella {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string name_of(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

std::vector<std::string> labels(const std::vector<fs::path>& folders) {
  std::vector<std::string> names, paths;
  for (const fs::path& folder : folders) names.push_back(name_of(folder)), paths.push_back(folder.string());
  return std::set<std::string>(names.begin(), names.end()).size() == names.size() ? names : paths;
}

/// Groups of { key: { value, unit, definition } }, as summary_json writes them.
void add_summary(const fs::path& file, int run, std::vector<ComparedQuantity>& quantities) {
  if (!fs::exists(file))
    throw DataError(fmt::format("{}: is missing; compare takes folders that `lamella run` wrote", file.string()));
  const Json summary = Json::parse(read_binary_file(file), nullptr, false);
  if (!summary.is_object()) throw DataError(fmt::format("{}: is not a summary; run this scene again", file.string()));
  for (const auto& [group, members] : summary.items()) {
    if (!members.is_object()) continue;
    for (const auto& [key, quantity] : members.items()) {
      if (!quantity.is_object() || !quantity.contains("value") || !quantity["value"].is_number()) continue;
      const std::string name = group + "." + key;
      auto at = std::find_if(quantities.begin(), quantities.end(), [&](const auto& q) { return q.name == name; });
      if (at == quantities.end()) at = quantities.insert(quantities.end(), {name, quantity.value("unit", ""), {}});
      at->values[run] = quantity["value"].get<double>();
    }
  }
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace

ComparisonTable comparison_table(const std::vector<fs::path>& folders) {
  ComparisonTable table{labels(folders), {}};
  for (std::size_t k = 0; k < folders.size(); ++k)
    add_summary(folders[k] / "summary.json", static_cast<int>(k), table.quantities);
  return table;
}

std::string comparison_csv(const ComparisonTable& table) {
  std::string text = "quantity,unit";
  for (const std::string& run : table.runs) text += "," + csv_field(run);
  text += "\n";
  for (const ComparedQuantity& q : table.quantities) {
    text += q.name + "," + q.unit;
    for (int k = 0; k < static_cast<int>(table.runs.size()); ++k)
      text += q.values.count(k) ? fmt::format(",{:.10g}", q.values.at(k)) : ",";
    text += "\n";
  }
  return text;
}

std::vector<fs::path> draw_comparison(const fs::path& stem, const std::vector<fs::path>& folders,
                                      const ComparisonTable& table) {
  Chart chart;
  chart.x_label = "strain \u03b5 [%]";
  chart.y_label = "stress over its peak \u03c3 / \u03c3_max";
  for (std::size_t k = 0; k < folders.size(); ++k) {
    const TrajectoryReader reader(folders[k] / "trajectory.h5");
    const auto setup = test_setup(reader.provenance());
    if (!setup) continue;
    const LoadCurve load = load_curve(reader.response(), *setup);
    if (load.stress.empty()) continue;
    const double peak = *std::max_element(load.stress.begin(), load.stress.end());
    if (!(peak > 0)) continue;
    const double shade =
        folders.size() > 1 ? 0.85 * static_cast<double>(k) / static_cast<double>(folders.size() - 1) : 0;
    Curve curve{.x = {}, .y = {}, .style = {viridis(shade), 1.4, {}}, .label = table.runs[k]};
    for (std::size_t row = 0; row < load.strain.size(); ++row)
      curve.x.push_back(100 * load.strain[row]), curve.y.push_back(load.stress[row] / peak);
    chart.curves.push_back(std::move(curve));
  }
  if (chart.curves.empty()) return {};
  const Vec2 size(560, 380);
  return draw_page(stem, size, [&](Canvas& canvas) { draw_chart(canvas, {Vec2(0, 8), size}, chart); });
}

}  // namespace lamella
