// What the spacing of links does to the strength of a tissue, and the order in which that settles where links soften.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipelines/quasi_static/at_rest.h"

namespace lamella::at_rest {
namespace {

using Numbers = std::vector<double>;

double mean(const Numbers& v) { return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size()); }

/// Standard error of a mean.
double scatter(const Numbers& v) {
  const double middle = mean(v);
  double square = 0;
  for (const double x : v) square += (x - middle) * (x - middle);
  const auto n = static_cast<double>(v.size());
  return std::sqrt(square / (n * (n - 1)));
}

/// Peaks of the samples, for each number of segments on a wall.
struct Refinement {
  std::vector<int> segments;
  std::vector<Numbers> peaks;  // [segments][sample]

  const Numbers& at(int m) const { return peaks[std::find(segments.begin(), segments.end(), m) - segments.begin()]; }
};

/// Richardson on the means of three refinements by 2: P(m) = P + C m^-p.
struct Richardson {
  double order = 0, limit = 0;
};

Richardson richardson(double coarse, double middle, double fine) {
  const double ratio = (middle - coarse) / (fine - middle);
  if (!(ratio > 0)) return {std::nan(""), std::nan("")};
  return {std::log2(ratio), fine + (fine - middle) / (ratio - 1)};
}

/// Of the means, with the jackknife's standard errors over the samples.
struct ObservedOrder {
  Richardson found, error;
};

ObservedOrder observed_order(const Refinement& r, int m) {
  const std::size_t n = r.at(m).size();
  const auto without = [&](std::size_t left_out) {
    const auto mean_at = [&](int segments) {
      double sum = 0, count = 0;
      for (std::size_t k = 0; k < n; ++k)
        if (k != left_out) sum += r.at(segments)[k], ++count;
      return sum / count;
    };
    return richardson(mean_at(m), mean_at(2 * m), mean_at(4 * m));
  };
  ObservedOrder out{without(n), {}};
  Numbers order, limit;
  for (std::size_t k = 0; k < n; ++k) order.push_back(without(k).order), limit.push_back(without(k).limit);
  const auto jackknife = [&](const Numbers& v) { return static_cast<double>(n - 1) * scatter(v); };
  out.error = {jackknife(order), jackknife(limit)};
  return out;
}

std::string with_error(double value, double error, const char* digits) {
  return std::isfinite(value)
             ? fmt::format(fmt::runtime(std::string("{:") + digits + "f} +- {:" + digits + "f}"), value, error)
             : "none: differences of both signs";
}

}  // namespace

void spacing(StudyBench& bench) {
  StudyReport& report = bench.report;
  const std::size_t samples = bench.small() ? 2 : 12;
  const std::vector<int> all = bench.small() ? std::vector<int>{4, 8, 12} : std::vector<int>{3, 4, 6, 8, 12, 16, 24};
  report.section("A tissue: the spacing of the links");
  report.text(
      fmt::format("{} tissues of thirty-six cells (`tissue.toml`), m segments a wall, strengths per length of wall: "
                  "means of their peak stresses, and the standard error of each mean. Whatever the links, the same "
                  "tissues are refined. The peak of brittle links falls as they come closer to the corners; that of "
                  "links that soften (toughness 0.0256: over 0.4 of a wall) settles. Where k_n = 2000: three of the "
                  "tissues.",
                  samples));
  struct Links {
    std::string name;
    bool softens;
    double k_n;
    std::size_t samples;
  };
  std::vector<Links> kinds{{"brittle, k_n = 200", false, 200, samples}, {"softening, k_n = 200", true, 200, samples}};
  if (!bench.small()) kinds.push_back({"brittle, k_n = 2000", false, 2000, 3});
  if (!bench.small()) kinds.push_back({"softening, k_n = 2000", true, 2000, 3});
  std::vector<Refinement> found;
  for (const Links& links : kinds) {
    Refinement r{all, {}};
    for (const int m : all) {
      r.peaks.emplace_back();
      for (std::size_t k = 0; k < links.samples; ++k) {
        std::vector<std::string> settings{fmt::format("seed={}", k + 1),
                                          fmt::format("sample.walls.segments={}", m),
                                          fmt::format("links.normal_stiffness={}", links.k_n),
                                          fmt::format("links.tangential_stiffness={}", 0.3 * links.k_n),
                                          "stop.stress_drop=0.7",
                                          fmt::format("run.load_steps={}", links.softens ? 1200 : 600)};
        if (links.softens) settings.insert(settings.end(), {"links.law=\"cohesive_zone\"", "links.toughness=0.0256"});
        const StudyRun run = bench.attempt(fmt::format("spacing_{}_{:g}_{}_{}", links.softens, links.k_n, m, k + 1),
                                           "tissue.toml", settings);
        const auto stress = run.column("stress");
        r.peaks.back().push_back(*std::max_element(stress.begin(), stress.end()));
        if (!run.error.empty())
          report.holds(fmt::format("{}, m = {}, sample {}: found its way", links.name, m, k + 1), false, run.error);
      }
    }
    found.push_back(std::move(r));
  }

  ReportTable peaks{{"m"}, {}}, orders{{"links", "from m", "observed order", "peak without limit of m"}, {}};
  Chart chart{
      .title = "Strength of a tissue", .x_label = "segments a wall m", .y_label = "peak stress / f_n0 per length"};
  Chart errors{.title = "Peak stress off its limit", .x_label = "segments a wall m", .y_label = "relative difference"};
  chart.x_scale = errors.x_scale = errors.y_scale = Scale::kLogarithmic;
  for (const int m : all) peaks.rows.push_back({fmt::format("{}", m)});
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const Refinement& r = found[i];
    const std::string& name = kinds[i].name;
    const int colour = static_cast<int>(i);
    peaks.head.push_back(name);
    Numbers x, y;
    for (std::size_t k = 0; k < all.size(); ++k) {
      x.push_back(all[k]), y.push_back(mean(r.peaks[k]));
      peaks.rows[k].push_back(fmt::format("{:.4f} +- {:.4f}", y.back(), scatter(r.peaks[k])));
    }
    chart.curves.push_back(line_curve(colour, name, x, y)), chart.curves.push_back(dotted_curve(colour, "", x, y));
    // Off the finest, sample by sample: which links break where scatters more than what the spacing does.
    const auto off = [&](int m) {
      Numbers ratio;
      for (std::size_t k = 0; k < kinds[i].samples; ++k) ratio.push_back(r.at(m)[k] / r.at(all.back())[k] - 1);
      return ratio;
    };
    if (kinds[i].softens) {
      for (const int m : all)
        if (m >= 8 && m < all.back())
          report.compare(fmt::format("{}: mean peak at m = {} over that at m = {}", name, m, all.back()),
                         1 + mean(off(m)), 1,
                         kinds[i].samples < samples ? 5e-2
                         : bench.small()            ? 3e-2
                                                    : 2e-2);
    } else {
      const int from = bench.small() ? 4 : 8;
      report.at_least(fmt::format("{}: mean peak at m = {} over that at m = {}", name, from, all.back()),
                      mean(r.at(from)) / mean(r.at(all.back())), 1.08);
    }
    Numbers at, difference;
    for (const int m : all)
      if (m < all.back()) at.push_back(m), difference.push_back(std::abs(mean(off(m))));
    errors.curves.push_back(line_curve(colour, name, at, difference));
    errors.curves.push_back(dotted_curve(colour, "", at, difference));
    if (bench.small() || kinds[i].samples < samples) continue;
    for (const int m : {3, 4, 6}) {
      const ObservedOrder order = observed_order(r, m);
      if (m == 6 && kinds[i].softens)
        report.at_least(name + ": observed order from m = 6, 12, 24", order.found.order, 1);
      if (m == 6 && !kinds[i].softens)
        report.at_least(name + ": mean peak at m = 12 over that at m = 24, which still falls", 1 + mean(off(12)), 1.03);
      orders.rows.push_back({name, fmt::format("{}, {}, {}", m, 2 * m, 4 * m),
                             with_error(order.found.order, order.error.order, ".2"),
                             with_error(order.found.limit, order.error.limit, ".4")});
    }
  }
  report.table(peaks);
  if (!bench.small()) {
    report.text(
        "The order p by Richardson on the means, P(m) = P + C m^-p through three refinements by 2 each, and the limit "
        "P that "
        "it promises, with the jackknife's standard errors over the samples:");
    report.table(orders);
  }
  report.chart("spacing", "Mean peak stress by the spacing of the links, at rest.", chart);
  report.chart("spacing_error", "Mean peak stress of the same samples, off that of the finest spacing.", errors);
}

}  // namespace lamella::at_rest
