#include "pipelines/program/compare.h"

#include <fmt/format.h>

#include "pipelines/program/writable.h"
#include "postproc/comparison.h"
#include "postproc/output_file.h"

namespace lamella {

void compare_command(const std::vector<std::filesystem::path>& runs, const std::filesystem::path& out,
                     Verbosity verbosity) {
  require_writable_folder(out);
  const ComparisonTable table = comparison_table(runs);
  make_folder(out);
  const std::filesystem::path csv = out / "comparison.csv";
  write_text_file(csv, comparison_csv(table));
  std::vector<std::filesystem::path> files = draw_comparison(out / "comparison", runs, table);
  files.push_back(csv);

  Progress progress(verbosity);
  std::string head = fmt::format("{:<44}", "");
  for (const std::string& run : table.runs) head += fmt::format(" {:>14}", run);
  progress.say(head);
  for (const ComparedQuantity& q : table.quantities) {
    std::string line = fmt::format("{:<44}", q.name);
    for (int k = 0; k < static_cast<int>(table.runs.size()); ++k)
      line += q.values.count(k) ? fmt::format(" {:>14.5g}", q.values.at(k)) : fmt::format(" {:>14}", "-");
    progress.say(line + "  " + q.unit);
  }
  for (const auto& file : files) progress.say("  " + file.string());
}

}  // namespace lamella
