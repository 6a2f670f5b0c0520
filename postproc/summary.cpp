#include "postproc/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace lamella {

void Summary::add(const std::string& group, Quantity quantity) {
  auto at = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.name == group; });
  if (at == groups.end()) at = groups.insert(groups.end(), {group, {}});
  at->quantities.push_back(std::move(quantity));
}

const Quantity* Summary::find(const std::string& key) const {
  for (const Group& group : groups)
    for (const Quantity& quantity : group.quantities)
      if (quantity.key == key) return &quantity;
  return nullptr;
}

std::string summary_json(const Summary& summary, const Provenance& provenance, const std::string& ended,
                         const std::vector<std::string>& files) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["ended"] = ended;
  for (const Summary::Group& group : summary.groups)
    for (const Quantity& q : group.quantities)
      json[group.name][q.key] = {{"value", q.value}, {"unit", q.unit}, {"definition", q.definition}};
  json["warnings"] = summary.warnings;
  json["files"] = files;
  json["provenance"] = provenance;
  // Text that is not UTF-8 (a title in another encoding) is replaced, never fatal.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string response_csv(const Response& response) {
  std::string text;
  for (std::size_t k = 0; k < response.columns.size(); ++k)
    text += fmt::format("{}{} [{}]", k ? "," : "", response.columns[k], response.units[k]);
  text += "\n";
  for (const auto& row : response.rows) {
    for (std::size_t k = 0; k < row.size(); ++k) text += fmt::format("{}{:.10g}", k ? "," : "", row[k]);
    text += "\n";
  }
  return text;
}

std::string events_csv(const std::vector<Event>& events, Breaks breaks) {
  const bool bars = breaks == Breaks::kLinksAndBars;
  const bool at_rest = std::any_of(events.begin(), events.end(), [](const Event& e) { return e.avalanche >= 0; });
  std::string text = fmt::format(
      "time [s],step [1],stage [1],strain [1],link [1],x [m],y [m],f_n [N],f_t [N],mode_mix [rad],energy [J]{}{}\n",
      bars ? ",bar [1]" : "", at_rest ? ",avalanche [1],place [1],released [J]" : "");
  for (const Event& e : events) {
    text += fmt::format("{:.10g},{},{},{:.10g},{},{:.10g},{:.10g},{:.10g},{:.10g},{:.6g},{:.10g}", e.time, e.step,
                        e.stage, e.strain, e.link, e.position.x(), e.position.y(), e.f_n, e.f_t, e.mode_mix, e.energy);
    if (bars) text += fmt::format(",{}", e.bar);
    if (at_rest) text += fmt::format(",{},{},{:.10g}", e.avalanche, e.place, e.released);
    text += "\n";
  }
  return text;
}

}  // namespace lamella
