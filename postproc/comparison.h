// Several runs side by side: their numbers in one table, their curves in one chart.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lamella {

/// One number of the runs' summaries. Runs that do not have it are absent from `values`.
struct ComparedQuantity {
  std::string name, unit;        // "test.peak_stress", "Pa"
  std::map<int, double> values;  // by index of the run
};

struct ComparisonTable {
  std::vector<std::string> runs;             // names of their folders; whole paths where names repeat
  std::vector<ComparedQuantity> quantities;  // in the order of the summaries
};

/// Reads summary.json in each folder. Throws DataError.
ComparisonTable comparison_table(const std::vector<std::filesystem::path>& folders);

/// One row a quantity: name, unit, then a column a run; empty where a run does not have it.
std::string comparison_csv(const ComparisonTable& table);

/// Stress over its peak against strain, one curve a run, from trajectory.h5 in each folder. Writes STEM.png and STEM.pdf and
/// returns both; nothing when no run has a loading.
std::vector<std::filesystem::path> draw_comparison(const std::filesystem::path& stem,
                                                   const std::vector<std::filesystem::path>& folders,
                                                   const ComparisonTable& table);

}  // namespace lamella
