#include "pipelines/accuracy/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace lamella {

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

void sweep_table(StudyReport& report, const std::vector<Measured>& sweep) {
  ReportTable table{{"setting", "error", "node-steps", "seconds", "energy ledger"}, {}};
  for (const Measured& m : sweep)
    table.rows.push_back({m.setting, fmt::format("{:.2g} %", 100 * m.error), fmt::format("{:.2g}", m.node_steps),
                          fmt::format("{:.2g}", m.seconds), fmt::format("{:.1g}", m.ledger)});
  report.table(table);
}

void work_precision(StudyReport& report, const std::string& name, const std::string& title,
                    const std::vector<Measured>& all) {
  std::map<std::string, std::vector<Measured>> groups;
  std::vector<std::string> order;
  for (const Measured& m : all) {
    if (!groups.count(m.group)) order.push_back(m.group);
    groups[m.group].push_back(m);
  }
  const auto draw = [&](const std::string& suffix, const std::string& label, double Measured::*cost) {
    Chart chart{.title = title, .x_label = label, .y_label = "error [%]"};
    chart.x_scale = chart.y_scale = Scale::kLogarithmic;
    int colour = 0;
    for (const auto& group : order) {
      auto list = groups[group];
      std::sort(list.begin(), list.end(), [&](const auto& a, const auto& b) { return a.*cost < b.*cost; });
      std::vector<double> x, y;
      for (const Measured& m : list) x.push_back(m.*cost), y.push_back(100 * m.error);
      chart.curves.push_back(line_curve(colour, group, x, y));
      chart.curves.push_back(dotted_curve(colour++, "", x, y));
    }
    report.chart(name + suffix, title + ": error against " + label + ", one curve a method.", chart);
  };
  draw("_steps", "node-steps", &Measured::node_steps);
  draw("_seconds", "seconds of stepping", &Measured::seconds);
}

void recommend(StudyReport& report, const std::string& what, const std::vector<Measured>& all) {
  ReportTable table{{"accepted error of the " + what, "cheapest setting", "error", "node-steps", "seconds"}, {}};
  for (const double accepted : {0.05, 0.01, 0.001}) {
    const Measured* best = nullptr;
    const Measured* nearest = &all.front();
    for (const Measured& m : all) {
      if (m.error < nearest->error) nearest = &m;
      if (m.error <= accepted && (!best || m.node_steps < best->node_steps)) best = &m;
    }
    const Measured& shown = best ? *best : *nearest;
    table.rows.push_back({fmt::format("{:g} %", 100 * accepted),
                          best ? shown.setting : "not reachable this way; best: " + shown.setting,
                          fmt::format("{:.2g} %", 100 * shown.error), fmt::format("{:.2g}", shown.node_steps),
                          fmt::format("{:.2g}", shown.seconds)});
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
