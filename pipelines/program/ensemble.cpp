#include "pipelines/program/ensemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "generator/sample/errors.h"
#include "pipelines/program/exit_status.h"
#include "pipelines/program/interrupt.h"
#include "pipelines/program/workers.h"
#include "pipelines/program/writable.h"
#include "postproc/output_file.h"

namespace lamella {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path seed_folder(const fs::path& folder, std::uint64_t seed) { return folder / fmt::format("seed_{}", seed); }

/// One quantity over all runs.
struct Column {
  std::string name, unit;  // "test.peak_stress", "Pa"
  std::map<std::uint64_t, double> values;

  double mean() const {
    double sum = 0;
    for (const auto& [seed, value] : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
  /// Of the sample: over n - 1. 0 for a single run.
  double deviation() const {
    double sum = 0;
    for (const auto& [seed, value] : values) sum += (value - mean()) * (value - mean());
    return values.size() > 1 ? std::sqrt(sum / static_cast<double>(values.size() - 1)) : 0.0;
  }
};

/// Adds the numbers of one summary.json: groups of { value, unit, definition }.
void collect(const fs::path& file, std::uint64_t seed, std::vector<Column>& columns) {
  std::ifstream in(file);
  const Json summary = Json::parse(in, nullptr, false);
  if (!summary.is_object())
    throw DataError(fmt::format("{}: is missing or not JSON; run this seed again", file.string()));
  for (const auto& [group, quantities] : summary.items()) {
    if (!quantities.is_object()) continue;
    for (const auto& [key, quantity] : quantities.items()) {
      if (!quantity.is_object() || !quantity.contains("value") || !quantity["value"].is_number()) continue;
      const std::string name = group + "." + key;
      auto column = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
      if (column == columns.end()) column = columns.insert(columns.end(), {name, quantity.value("unit", ""), {}});
      column->values[seed] = quantity["value"].get<double>();
    }
  }
}

void write_statistics(const std::vector<Column>& columns, const std::set<std::uint64_t>& seeds, const fs::path& folder,
                      Progress& progress) {
  Json json;
  json["seeds"] = seeds;
  std::string csv = "seed";
  for (const Column& c : columns) csv += fmt::format(",{} [{}]", c.name, c.unit);
  for (const std::uint64_t seed : seeds) {
    csv += fmt::format("\n{}", seed);
    for (const Column& c : columns) csv += c.values.count(seed) ? fmt::format(",{:.10g}", c.values.at(seed)) : ",";
  }
  progress.say(fmt::format("{:<44} {:>12} {:>12}  {:<8} over {} runs", "", "mean", "deviation", "", seeds.size()));
  for (const Column& c : columns) {
    json["quantities"][c.name] = {
        {"mean", c.mean()}, {"deviation", c.deviation()}, {"runs", c.values.size()}, {"unit", c.unit}};
    progress.say(fmt::format("{:<44} {:>12.5g} {:>12.3g}  {}", c.name, c.mean(), c.deviation(), c.unit));
  }
  write_text_file(folder / "ensemble.json", json.dump(2) + "\n");
  write_text_file(folder / "ensemble.csv", csv + "\n");
}

}  // namespace

SeedRange parse_seeds(const std::string& text) {
  SeedRange seeds;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, seeds.first);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == '-') {
    const auto last = std::from_chars(first.ptr + 1, end, seeds.last);
    if (last.ec == std::errc() && last.ptr == end && seeds.first <= seeds.last && seeds.last - seeds.first < 100000)
      return seeds;
  }
  throw SceneError(fmt::format("--seeds {}: not a range of seeds; for instance --seeds 1-10", text));
}

int ensemble_command(const SceneArguments& arguments, const SeedRange& seeds, int jobs, const fs::path& folder,
                     Beginning beginning, Verbosity verbosity) {
  SceneArguments own = arguments;
  own.seed = seeds.first;
  load_scene(own);  // one message instead of one from every seed
  require_writable_folder(folder);
  Progress progress(verbosity);
  progress.start("ensemble");
  Workers workers;
  std::set<std::uint64_t> good;
  int failed = 0;
  const double total = static_cast<double>(seeds.last - seeds.first + 1);
  double done = 0;
  const auto reap = [&] {
    const auto [seed, status] = workers.wait();
    done += 1;
    if (status == 0)
      good.insert(seed);
    else if (failed == 0)
      failed = status;
    progress.say(
        fmt::format("seed {} {}", seed, status == 0 ? "done" : fmt::format("failed with exit status {}", status)));
    progress.show(done / total, fmt::format("{:.0f} of {:.0f} seeds", done, total));
  };
  for (std::uint64_t seed = seeds.first; seed <= seeds.last && !interrupted(); ++seed) {
    if (workers.count() >= static_cast<std::size_t>(jobs)) reap();
    own.seed = seed;
    workers.start(seed, [&] {
      return exit_status_of(fmt::format("seed {}", seed),
                            [&] { run_command(own, seed_folder(folder, seed), beginning, Verbosity::quiet); });
    });
  }
  while (workers.count() > 0) reap();
  stop_if_interrupted();
  progress.finish();
  if (good.empty()) return failed;
  std::vector<Column> columns;
  for (const std::uint64_t seed : good) collect(seed_folder(folder, seed) / "summary.json", seed, columns);
  write_statistics(columns, good, folder, progress);
  return failed;
}

}  // namespace lamella
