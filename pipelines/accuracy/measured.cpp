#include "pipelines/accuracy/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace lamella {
namespace {

/// Error over a cost, one colour a group.
void error_chart(StudyReport& report, const std::string& name, const std::string& title,
                 const std::vector<Measured>& all, const std::string& label, double Measured::*cost,
                 const std::vector<Curve>& besides = {}) {
  std::map<std::string, std::vector<Measured>> groups;
  std::vector<std::string> order;
  for (const Measured& m : all) {
    if (!groups.count(m.group)) order.push_back(m.group);
    groups[m.group].push_back(m);
  }
  Chart chart{.title = title, .x_label = label, .y_label = "error [%]"};
  chart.x_scale = chart.y_scale = Scale::kLogarithmic;
  int colour = 0;
  for (const auto& group : order) {
    auto list = groups[group];
    std::sort(list.begin(), list.end(), [&](const auto& a, const auto& b) { return a.*cost < b.*cost; });
    std::vector<double> x, y;
    for (const Measured& m : list) x.push_back(m.*cost), y.push_back(100 * m.error);
    const bool joined = list.front().joined;
    if (joined) chart.curves.push_back(line_curve(colour, group, x, y));
    chart.curves.push_back(dotted_curve(colour++, joined ? "" : group, x, y));
  }
  chart.curves.insert(chart.curves.end(), besides.begin(), besides.end());
  report.chart(name, title + ": error against " + label + ", one colour a method.", chart);
}

}  // namespace

Measured measured(const StudyRun& run, const std::string& setting, const std::string& group, double knob,
                  double error) {
  return {setting,
          group,
          knob,
          error,
          static_cast<double>(run.facts.steps) * run.reader.sample().nodes(),
          run.facts.seconds,
          run.facts.residual};
}

std::string error_text(double error) { return std::isnan(error) ? "no answer" : fmt::format("{:.2g} %", 100 * error); }

void sweep_table(StudyReport& report, const std::vector<Measured>& sweep) {
  ReportTable table{{"setting", "error", "node-steps", "seconds", "energy ledger"}, {}};
  for (const Measured& m : sweep)
    table.rows.push_back({m.setting, error_text(m.error), fmt::format("{:.2g}", m.node_steps),
                          fmt::format("{:.2g}", m.seconds), fmt::format("{:.1g}", m.ledger)});
  report.table(table);
}

void precision_over_seconds(StudyReport& report, const std::string& name, const std::string& title,
                            const std::vector<Measured>& all, const std::vector<Curve>& besides) {
  error_chart(report, name, title, all, "CPU seconds", &Measured::seconds, besides);
}

void work_precision(StudyReport& report, const std::string& name, const std::string& title,
                    const std::vector<Measured>& all) {
  error_chart(report, name + "_steps", title, all, "node-steps", &Measured::node_steps);
  error_chart(report, name + "_seconds", title, all, "seconds of stepping", &Measured::seconds);
}

void recommend(StudyReport& report, const std::string& what, const std::vector<Measured>& all) {
  ReportTable table{{"accepted error of the " + what, "cheapest setting", "error", "node-steps", "seconds"}, {}};
  for (const double accepted : {0.05, 0.01, 0.001}) {
    const Measured* best = nullptr;
    const Measured* nearest = &all.front();
    for (const Measured& m : all) {
      if (m.error < nearest->error || std::isnan(nearest->error)) nearest = &m;
      if (m.error <= accepted && (!best || m.node_steps < best->node_steps)) best = &m;
    }
    const Measured& shown = best ? *best : *nearest;
    table.rows.push_back(
        {fmt::format("{:g} %", 100 * accepted), best ? shown.setting : "not reachable this way; best: " + shown.setting,
         error_text(shown.error), fmt::format("{:.2g}", shown.node_steps), fmt::format("{:.2g}", shown.seconds)});
  }
  report.table(table);
}

std::string order_text(const std::vector<Measured>& sweep) {
  std::vector<double> knob, error;
  for (const Measured& m : sweep) knob.push_back(1 / m.knob), error.push_back(m.error);
  const Order order = observed_order(knob, error);
  return fmt::format("{:.2f} +- {:.2f}", order.order, order.half_width);
}

}  // namespace lamella
