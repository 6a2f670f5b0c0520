#include "postproc/report.h"

#include <fmt/format.h>

#include <cmath>

#include "postproc/drawing/chart.h"

namespace lamella {

std::string readable(double value, const std::string& unit) {
  if (unit == "1") return fmt::format("{:.4g}", value);
  if (value == 0 || unit.find_first_of("/2") != std::string::npos)
    return fmt::format("{:.4g} {}", value, unit == "J/m2" ? "J/m\u00b2" : unit);
  const ScaledUnit scaled = scaled_unit(value, unit);
  return fmt::format("{:.4g} {}", value / scaled.factor, scaled.name);
}

std::string report_html(const std::string& title, const std::vector<ReportPicture>& pictures, const Summary& summary,
                        const Provenance& provenance, const std::string& ended) {
  std::string html;
  const auto fact = [&](const char* key) {
    const auto at = provenance.find(key);
    return at == provenance.end() ? std::string() : at->second;
  };
  std::string line = "lamella " + fact("version");
  if (!fact("scene_file").empty()) line += ", scene " + fact("scene_file");
  if (!fact("seed").empty()) line += ", seed " + fact("seed");
  html +=
      "<p class=\"quiet\">" + html_escaped(line) + (ended.empty() ? "" : ". Ended: " + html_escaped(ended)) + "</p>\n";
  for (const std::string& warning : summary.warnings)
    html += "<p class=\"warning\">Warning: " + html_escaped(warning) + "</p>\n";

  html += "<div class=\"tiles\">\n";
  for (const char* key :
       {"young_modulus", "shear_modulus", "poisson_ratio", "peak_stress", "strain_at_peak", "strain_at_failure",
        "work_of_fracture_per_area", "broken_links", "through_cracks", "ledger_residual"})
    if (const Quantity* q = summary.find(key))
      html += fmt::format("<div class=\"tile\"><b>{}</b><span>{}</span></div>\n",
                          html_escaped(readable(q->value, q->unit)), html_escaped(title_of(key)));
  html += "</div>\n";

  // The first picture takes the width of the page, the others go in pairs.
  if (!pictures.empty()) html += html_figure(pictures.front());
  if (pictures.size() > 1) {
    html += "<div class=\"pair\">\n";
    for (std::size_t k = 1; k < pictures.size(); ++k) html += html_figure(pictures[k]);
    html += "</div>\n";
  }

  for (const Summary::Group& group : summary.groups) {
    html += "<h2>" + html_escaped(title_of(group.name)) + "</h2>\n<table>\n";
    for (const Quantity& q : group.quantities)
      html += fmt::format("<tr><td>{}</td><td class=\"number\">{}</td><td class=\"what\">{}</td></tr>\n",
                          html_escaped(title_of(q.key)), html_escaped(readable(q.value, q.unit)),
                          html_escaped(q.definition));
    html += "</table>\n";
  }
  std::string rows;
  for (const auto& [key, value] : provenance) {
    if (key == "scene" || key == "summary") continue;
    if (value.find('\n') == std::string::npos && !value.empty())
      rows += fmt::format("<tr><td>{}</td><td class=\"what\">{}</td></tr>\n", html_escaped(key), html_escaped(value));
  }
  if (!fact("summary").empty()) html += "<h2>Model</h2>\n<pre>" + html_escaped(fact("summary")) + "</pre>\n";
  if (!rows.empty()) html += "<h2>Provenance</h2>\n<table>\n" + rows + "</table>\n";
  if (!fact("scene").empty()) html += "<h2>Scene</h2>\n<pre>" + html_escaped(fact("scene")) + "</pre>\n";
  return html_page(title, html);
}

}  // namespace lamella
