#include "pipelines/tissue/tissue_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "generator/statistics/packing_contacts.h"
#include "pipelines/tissue/export.h"
#include "pipelines/tissue/tissue_charts.h"
#include "pipelines/tissue/tissue_pictures.h"
#include "postproc/html.h"
#include "postproc/output_file.h"
#include "postproc/report.h"

namespace lamella {
namespace {

namespace fs = std::filesystem;

void add_moments(Summary& summary, const std::string& group, const std::string& key, const Moments& m,
                 const std::string& unit, const std::string& what) {
  summary.add(group, {"mean_" + key, m.mean, unit, "mean " + what});
  summary.add(group, {"cv_" + key, m.cv(), "1", "standard deviation over mean"});
}

void add_sample(Summary& summary, const Sample& sample, const Origin& origin) {
  const auto add = [&](const char* key, double value, const char* what) {
    summary.add("sample", {key, value, "1", what});
  };
  add("cells", sample.cells(), "shells and chains");
  add("nodes", sample.nodes(), "mass points");
  add("walls", static_cast<double>(sample.walls.size()), "contact lines of two cells");
  add("links", static_cast<double>(sample.links.size()), "between facing mass points");
  add("hidden_disks", origin.hidden, "disks whose tile is empty");
  add("welded_edges", origin.welded, "short edges of the tessellation that were welded to a point");
  const Vec2 size = sample.box.size();
  summary.add("sample", {"box_width", size.x(), "m", "of the domain"});
  summary.add("sample", {"box_height", size.y(), "m", "of the domain"});
  double tiles = 0;
  for (const double area : sample.tile_area) tiles += area;
  add("tiles_over_box", tiles / sample.box.area(), "area of all tiles over area of the box");
}

void add_packing(Summary& summary, const Packing& packing) {
  const PackingContacts contacts = contacts_of(packing);
  const auto add = [&](const char* key, double value, const std::string& what) {
    summary.add("packing", {key, value, "1", what});
  };
  add("disks", contacts.disks, "in the packing");
  add("packing_fraction", contacts.fraction, "area of the disks over area of the box");
  add("contacts", contacts.contacts,
      fmt::format("pairs with a gap below {:g} of the sum of their radii, rattlers left out", contacts.tolerance));
  add("coordination", contacts.coordination, "contacts with other disks, per disk that is no rattler");
  add("rattlers", contacts.rattlers, "disks with fewer than three contacts");
  std::vector<double> radii;
  for (const Disk& disk : packing.disks) radii.push_back(disk.radius);
  add_moments(summary, "packing", "radius", moments(radii), "m", "radius of a disk");
}

/// What areas were asked for, in proportion: by [sample.areas], or by disks.
std::vector<double> asked_of(const Origin& origin) {
  std::vector<double> asked = origin.asked;
  if (asked.empty())
    for (const Disk& disk : origin.packing.disks) asked.push_back(disk.radius * disk.radius);
  return asked;
}

void add_shapes(Summary& summary, const MosaicStatistics& s) {
  add_moments(summary, "sizes and shapes", "area", s.all_areas, "m2", "area of a tile, those at the boundary too");
  summary.add("sizes and shapes", {"skew_area", s.all_areas.skew, "1", "third central moment over variance^(3/2)"});
  summary.add("sizes and shapes", {"least_area", s.all_areas.least, "m2", "smallest tile"});
  summary.add("sizes and shapes", {"largest_area", s.all_areas.largest, "m2", "largest tile"});
  if (s.counted == 0) return;
  add_moments(summary, "sizes and shapes", "perimeter", s.perimeters, "m", "perimeter of a counted tile");
  summary.add("sizes and shapes",
              {"circularity", s.circularities.mean, "1", "mean 4 pi A / P^2 of counted tiles; 1 for a disk"});
  summary.add("sizes and shapes", {"elongation", s.elongations.mean, "1",
                                   "mean length over width of the ellipse with a counted tile's second moments"});
  add_moments(summary, "sizes and shapes", "wall_length", s.walls, "m", "length of walls between counted tiles");
}

void add_topology(Summary& summary, const MosaicStatistics& s) {
  const auto add = [&](const char* key, double value, const char* what) {
    summary.add("neighbours", {key, value, "1", what});
  };
  add("counted_cells", s.counted, "without a free edge; only these enter what follows");
  add("mean_neighbours", s.neighbours.mean, "mean number n of neighbours");
  add("mu2", s.mu2, "variance of n");
  add("correlation_n_area", s.lewis.correlation, "Pearson's correlation of n and area");
  add("lewis_slope", s.lewis.slope, "lambda in <A|n> / <A> = 1 + lambda (n - 6), every cell weighing the same");
  add("lewis_slope_error", s.lewis.slope_error, "its standard error");
  add("lewis_at_six", s.lewis.intercept, "the fitted line at n = 6");
  add("aboav_a", s.aboav_a, "a in n m(n) = (6 - a) n + 6 a + mu2, every cell weighing the same");
  add("aboav_a_error", s.aboav.slope_error, "its standard error");
  add("weaire_sum", s.weaire_sum, "mean of n m(n) where all neighbours count; <n^2> if there is no boundary");
  add("mean_square_neighbours", s.square_mean, "<n^2>");
}

std::string neighbour_table(const MosaicStatistics& s) {
  std::string text = "n,cells,share,mean_area_over_mean,error,cells_surrounded,neighbours_of_neighbours,error\n";
  for (const auto& [n, of] : s.by_neighbours)
    text += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{},{:.9g},{:.9g}\n", n, of.count, of.share, of.area, of.area_error,
                        of.surrounded, of.neighbours, of.neighbours_error);
  return text;
}

std::string json_of(const Summary& summary, const Scene& scene, const MosaicStatistics& s, const Notes& notes) {
  nlohmann::ordered_json json;
  json["scene"] = scene.path.filename().string();
  json["seed"] = scene.seed;
  for (const auto& group : summary.groups)
    for (const Quantity& q : group.quantities)
      json[group.name][q.key] = {{"value", q.value}, {"unit", q.unit}, {"definition", q.definition}};
  if (s.cells > 0) {
    const Histogram& h = s.area_histogram;
    json["area_histogram"] = {
        {"of", "area over mean area"}, {"low", h.low}, {"width", h.width}, {"density", h.density}};
    for (const auto& [n, of] : s.by_neighbours)
      json["by_neighbours"].push_back({{"n", n},
                                       {"cells", of.count},
                                       {"share", of.share},
                                       {"area", of.area},
                                       {"area_error", of.area_error},
                                       {"surrounded", of.surrounded},
                                       {"neighbours", of.neighbours},
                                       {"neighbours_error", of.neighbours_error}});
  }
  json["notes"] = notes;
  return json.dump(2) + "\n";
}

std::string page(const Scene& scene, const Summary& summary, const std::vector<ReportPicture>& pictures,
                 const Notes& notes) {
  std::string body = fmt::format("<p class=\"quiet\">{} of scene {}, seed {}</p>\n", html_escaped(scene.sample.kind),
                                 html_escaped(scene.path.filename().string()), scene.seed);
  for (const std::string& note : notes) body += "<p class=\"warning\">" + html_escaped(note) + "</p>\n";
  body += "<div class=\"tiles\">\n";
  for (const char* key : {"cells", "links", "packing_fraction", "cv_area", "circularity", "mean_neighbours", "mu2",
                          "lewis_slope", "aboav_a", "correlation_n_area"})
    if (const Quantity* q = summary.find(key))
      body += fmt::format("<div class=\"tile\"><b>{}</b><span>{}</span></div>\n", readable(q->value, q->unit),
                          html_escaped(title_of(key)));
  body += "</div>\n";
  if (!pictures.empty()) body += html_figure(pictures.front());
  if (pictures.size() > 1) {
    body += "<div class=\"pair\">\n";
    for (std::size_t k = 1; k < pictures.size(); ++k) body += html_figure(pictures[k]);
    body += "</div>\n";
  }
  for (const auto& group : summary.groups) {
    body += "<h2>" + html_escaped(title_of(group.name)) + "</h2>\n<table>\n";
    for (const Quantity& q : group.quantities)
      body += fmt::format("<tr><td>{}</td><td class=\"number\">{}</td><td class=\"what\">{}</td></tr>\n",
                          html_escaped(title_of(q.key)), readable(q.value, q.unit), html_escaped(q.definition));
    body += "</table>\n";
  }
  if (!scene.text.empty()) body += "<h2>Scene</h2>\n<pre>" + html_escaped(scene.text) + "</pre>\n";
  const std::string title = "Tissue: " + scene.path.stem().string();
  return html_page(title, body);
}

}  // namespace

std::vector<fs::path> write_tissue_report(const fs::path& folder, const Scene& scene, const Sample& sample,
                                          const Origin& origin, const Notes& notes) {
  std::vector<fs::path> files;
  std::vector<ReportPicture> pictures;
  const auto add_picture = [&](const std::vector<fs::path>& drawn, const std::string& caption) {
    files.insert(files.end(), drawn.begin(), drawn.end());
    pictures.push_back({drawn.front(), caption});
  };
  Summary summary;
  add_sample(summary, sample, origin);
  MosaicStatistics s;
  if (!origin.tiles.cells.empty()) {
    const MosaicMeasures measures = measure(origin.tiles);
    s = statistics(measures);
    add_shapes(summary, s);
    const std::vector<double> asked = asked_of(origin);
    if (!asked.empty())
      summary.add("sizes and shapes", {"cv_area_asked", moments(asked).cv(), "1",
                                       "standard deviation over mean of the areas of the disks, or of those that "
                                       "sample.areas prescribes"});
    if (s.counted > 0) add_topology(summary, s);
    add_picture(draw_neighbours_and_areas(folder / "tissue", origin.tiles, measures),
                "The tiles, before walls are inset: how many neighbours each has, and how large it is.");
    add_picture(draw_areas(folder / "areas", s, asked, origin.asked.empty() ? "disks" : "asked"),
                origin.asked.empty()
                    ? "Areas of all tiles over their mean, and of the disks that the tiles were made from."
                    : "Areas of all tiles over their mean, and those that sample.areas prescribes.");
    if (s.counted > 0) {
      add_picture(
          draw_neighbour_counts(folder / "neighbours", s),
          "Shares of cells by number of neighbours, with standard errors. Cells with a free edge do not count.");
      add_picture(draw_lewis(folder / "lewis", s), "Cells with more neighbours are larger: the law of Lewis.");
      add_picture(draw_aboav(folder / "aboav_weaire", s),
                  "Cells with many neighbours have neighbours with few: the law of Aboav and Weaire.");
    }
  } else if (sample.cells() > 0) {
    draw_sample(folder / "sample.png", sample);
    add_picture({folder / "sample.png"}, "The sample.");
  }
  if (!origin.packing.disks.empty()) add_packing(summary, origin.packing);
  const auto write = [&](const char* name, const std::string& text) {
    files.push_back(folder / name);
    write_text_file(files.back(), text);
  };
  write("statistics.json", json_of(summary, scene, s, notes));
  if (s.counted > 0) write("statistics.csv", neighbour_table(s));
  write("report.html", page(scene, summary, pictures, notes));
  return files;
}

}  // namespace lamella
