#include "postproc/quantities/energy_budget.h"

#include <algorithm>
#include <cmath>

namespace lamella {

std::vector<double> response_column(const Response& response, const std::string& name) {
  const auto at = std::find(response.columns.begin(), response.columns.end(), name);
  if (at == response.columns.end()) return {};
  const auto column = static_cast<std::size_t>(at - response.columns.begin());
  std::vector<double> values;
  values.reserve(response.rows.size());
  for (const auto& row : response.rows) values.push_back(row.at(column));
  return values;
}

EnergyBudget energy_budget(const Response& response) {
  EnergyBudget budget;
  budget.time = response_column(response, "time");
  budget.work = response_column(response, "work");
  budget.stored.assign(response.rows.size(), 0.0);
  const std::string prefix = "energy_";
  for (const std::string& column : response.columns) {
    if (column.rfind(prefix, 0) != 0) continue;
    budget.terms.push_back({column.substr(prefix.size()), response_column(response, column)});
    for (std::size_t k = 0; k < budget.stored.size(); ++k) budget.stored[k] += budget.terms.back().value[k];
  }
  for (const char* sink : {"kinetic", "damping", "friction", "plastic", "fracture", "released"}) {
    std::vector<double> values = response_column(response, sink);
    if (!values.empty()) budget.sinks.push_back({sink, std::move(values)});
  }
  for (double w : budget.work) budget.largest_work = std::max(budget.largest_work, std::abs(w));
  for (double r : response_column(response, "residual")) budget.residual = std::max(budget.residual, std::abs(r));
  return budget;
}

}  // namespace lamella
