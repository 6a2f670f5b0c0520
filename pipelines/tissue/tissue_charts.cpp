#include "pipelines/tissue/tissue_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "postproc/drawing/chart.h"

namespace lamella {
namespace {

const Colour kBars{0.58, 0.76, 0.88}, kDots{0.13, 0.30, 0.58}, kFit{0.82, 0.30, 0.20}, kErrors{0.35, 0.42, 0.52};

ChartFiles draw(const std::filesystem::path& stem, const Chart& chart) {
  const Vec2 size(460, 330);
  return draw_page(stem, size, [&](Canvas& canvas) { draw_chart(canvas, {{0, 0}, size}, chart); });
}

/// One line for each error: from y - e to y + e.
void add_errors(Chart& chart, double x, double y, double error) {
  if (error > 0) chart.curves.push_back({{x, x}, {y - error, y + error}, {kErrors, 1.1, {}}, ""});
}

/// The fit, a little beyond what it was fitted to, `at` being where its own x is 0.
Curve fitted(const Line& line, double low, double high, double at, const std::string& label) {
  const auto y = [&](double x) { return line.intercept + line.slope * (x - at); };
  low -= 0.4, high += 0.4;
  return {{low, high}, {y(low), y(high)}, {kFit, 1.8, {}}, label};
}

/// The outline of bars as one line.
Curve steps(const Histogram& h, const Colour& colour, const std::string& label) {
  Curve curve{{}, {}, {colour, 1.6, {}}, label};
  for (std::size_t k = 0; k < h.density.size(); ++k)
    for (const double edge : {0.0, 1.0}) {
      curve.x.push_back(h.low + (static_cast<double>(k) + edge) * h.width);
      curve.y.push_back(h.density[k]);
    }
  return curve;
}

}  // namespace

ChartFiles draw_areas(const std::filesystem::path& stem, const MosaicStatistics& s, const std::vector<double>& asked,
                      const std::string& what) {
  const Histogram& h = s.area_histogram;
  Chart chart{.title = "Areas", .x_label = "area over mean area", .y_label = "density of probability"};
  Curve tiles{{}, {}, {kBars, 1, {}}, fmt::format("{} tiles", s.cells), CurveKind::kBars};
  for (std::size_t k = 0; k < h.density.size(); ++k) {
    tiles.x.push_back(h.low + (static_cast<double>(k) + 0.5) * h.width);
    tiles.y.push_back(h.density[k]);
  }
  chart.curves.push_back(tiles);
  if (!asked.empty()) {
    const double mean = std::accumulate(asked.begin(), asked.end(), 0.0) / static_cast<double>(asked.size());
    std::vector<double> relative;
    for (const double area : asked) relative.push_back(area / mean);
    const Histogram of_asked = histogram(relative, h.low, h.low + h.width * static_cast<double>(h.density.size()),
                                         static_cast<int>(h.density.size()));
    chart.curves.push_back(steps(of_asked, kFit, what));
  }
  return draw(stem, chart);
}

ChartFiles draw_neighbour_counts(const std::filesystem::path& stem, const MosaicStatistics& s) {
  Chart chart{.title = "Neighbours", .x_label = "number of neighbours n", .y_label = "share of cells"};
  if (s.by_neighbours.empty()) return draw(stem, chart);
  const Index low = std::min<Index>(3, s.by_neighbours.begin()->first);
  const Index high = std::max<Index>(9, s.by_neighbours.rbegin()->first);
  Curve bars{{}, {}, {kBars, 1, {}}, fmt::format("{} cells", s.counted), CurveKind::kBars};
  for (Index n = low; n <= high; ++n) {
    const auto found = s.by_neighbours.find(n);
    bars.x.push_back(n);
    bars.y.push_back(found == s.by_neighbours.end() ? 0 : found->second.share);
  }
  chart.curves.push_back(bars);
  for (const auto& [n, of] : s.by_neighbours)
    add_errors(chart, n, of.share, std::sqrt(of.share * (1 - of.share) / s.counted));
  return draw(stem, chart);
}

ChartFiles draw_lewis(const std::filesystem::path& stem, const MosaicStatistics& s) {
  Chart chart{.title = "Lewis", .x_label = "number of neighbours n", .y_label = "mean area over mean of all"};
  Curve dots{{}, {}, {kDots, 1, {}}, "mean of cells with n", CurveKind::kDots};
  for (const auto& [n, of] : s.by_neighbours) {
    if (of.count == 0) continue;
    dots.x.push_back(n);
    dots.y.push_back(of.area);
    add_errors(chart, n, of.area, of.area_error);
  }
  if (dots.x.size() > 1)
    chart.curves.push_back(fitted(s.lewis, dots.x.front(), dots.x.back(), 6,
                                  fmt::format("slope {:.3f} \u00b1 {:.3f}", s.lewis.slope, s.lewis.slope_error)));
  chart.curves.push_back(dots);
  return draw(stem, chart);
}

ChartFiles draw_aboav(const std::filesystem::path& stem, const MosaicStatistics& s) {
  Chart chart{.title = "Aboav\u2013Weaire", .x_label = "number of neighbours n", .y_label = "n m(n)"};
  Curve dots{{}, {}, {kDots, 1, {}}, "mean", CurveKind::kDots};
  for (const auto& [n, of] : s.by_neighbours) {
    if (of.surrounded == 0) continue;
    dots.x.push_back(n);
    dots.y.push_back(n * of.neighbours);
    add_errors(chart, n, n * of.neighbours, n * of.neighbours_error);
  }
  if (dots.x.size() > 1)
    chart.curves.push_back(fitted(s.aboav, dots.x.front(), dots.x.back(), 0,
                                  fmt::format("a = {:.2f} \u00b1 {:.2f}", s.aboav_a, s.aboav.slope_error)));
  chart.curves.push_back(dots);
  return draw(stem, chart);
}

}  // namespace lamella
