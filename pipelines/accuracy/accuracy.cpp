#include "pipelines/accuracy/accuracy.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipelines/accuracy/measured.h"

namespace lamella {
namespace {

void judge_estimates(StudyReport& report, const std::vector<EstimatedError>& estimates, bool small) {
  report.section("Is the estimate of two paces right?");
  report.text(
      "`lamella run --accuracy` takes the difference of two runs, one at twice the pace, for the error of the slower "
      "one. Here it stands beside the true error against\n"
      "equilibrium of the same mass points, for damping as the program chooses it and around it.");
  ReportTable table{{"run", "estimated", "true", "ratio"}, {}};
  int near = 0;
  Chart chart{.title = "Estimated against true error", .x_label = "true error [%]", .y_label = "estimated error [%]"};
  chart.x_scale = chart.y_scale = Scale::kLogarithmic;
  std::vector<double> x, y;
  for (const EstimatedError& e : estimates) {
    const double ratio = e.estimated / e.truth;
    near += ratio > 1.0 / 3 && ratio < 3;
    table.rows.push_back({e.setting, fmt::format("{:.2g} %", 100 * e.estimated), fmt::format("{:.2g} %", 100 * e.truth),
                          fmt::format("{:.2f}", ratio)});
    x.push_back(100 * e.truth), y.push_back(100 * e.estimated);
  }
  report.table(table);
  report.at_least("share of estimates within a factor 3 of the true error",
                  static_cast<double>(near) / static_cast<double>(estimates.size()), 0.9);
  if (small) return;
  const double low = *std::min_element(x.begin(), x.end()), high = *std::max_element(x.begin(), x.end());
  chart.curves.push_back(dotted_curve(0, "runs", x, y));
  chart.curves.push_back(line_curve(4, "equal", {low, high}, {low, high}));
  chart.curves.push_back({{low, high}, {3 * low, 3 * high}, {kReferenceColour, 1, {3, 3}}, "factor 3"});
  chart.curves.push_back({{low, high}, {low / 3, high / 3}, {kReferenceColour, 1, {3, 3}}, ""});
  report.chart("estimates", "Errors that the program states, beside the true ones.", chart);
}

}  // namespace

void study_accuracy(StudyBench& bench) {
  std::vector<EstimatedError> estimates;
  accuracy_of_ring(bench, estimates);
  accuracy_of_plastic_ring(bench);
  accuracy_of_double_cantilever(bench, estimates);
  accuracy_of_tissue(bench);
  accuracy_of_slow_fracture(bench);
  judge_estimates(bench.report, estimates, bench.small());
}

}  // namespace lamella
