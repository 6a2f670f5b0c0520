#include "postproc/drawing/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lamella {
namespace {

const Colour kInk{0.13, 0.14, 0.17}, kGrid{0.90, 0.91, 0.93}, kFrame{0.45, 0.47, 0.52};

struct Range {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();

  void take(const std::vector<double>& values) {
    for (double v : values) low = std::min(low, v), high = std::max(high, v);
  }
  /// The outer halves of the outermost bars too.
  void take_bars(const Curve& c) {
    if (c.drawn != CurveKind::kBars || c.x.size() < 2) return;
    const double half = 0.5 * (c.x[1] - c.x[0]);
    take({c.x.front() - half, c.x.back() + half});
  }
  /// From zero where all is on one side of it, with some air at the far end.
  void round_up() {
    if (low > high) low = 0, high = 1;
    if (low > 0) low = 0;
    if (high < 0) high = 0;
    if (high == low) high = low + 1;
    const double air = 0.06 * (high - low);
    if (high > 0) high += air;
    if (low < 0) low -= air;
  }
  /// Some air at both ends, of a logarithmic axis.
  void widen() {
    if (low > high) low = 0, high = 1;
    if (high - low < 0.3) low -= 0.15, high += 0.15;
    const double air = 0.05 * (high - low);
    low -= air, high += air;
  }
};

/// The chart as it is drawn: on a logarithmic axis, logarithms of what is positive.
Chart scaled(Chart chart) {
  const auto scale = [&](std::vector<Curve>& curves) {
    for (Curve& c : curves) {
      std::vector<double> x, y;
      for (std::size_t k = 0; k < c.x.size(); ++k) {
        if (chart.x_scale == Scale::kLogarithmic && !(c.x[k] > 0)) continue;
        if (chart.y_scale == Scale::kLogarithmic && !(c.y[k] > 0)) continue;
        x.push_back(chart.x_scale == Scale::kLogarithmic ? std::log10(c.x[k]) : c.x[k]);
        y.push_back(chart.y_scale == Scale::kLogarithmic ? std::log10(c.y[k]) : c.y[k]);
      }
      c.x = std::move(x), c.y = std::move(y);
    }
  };
  scale(chart.curves), scale(chart.right_curves);
  return chart;
}

/// Decades, or 1, 2 and 5 in each where there are few of them; as logarithms.
std::vector<double> decade_ticks(double low, double high) {
  std::vector<double> ticks;
  const bool few = high - low < 2.5;
  const int every = std::max(1, static_cast<int>((high - low) / 8));
  for (int decade = static_cast<int>(std::floor(low)); decade <= high; decade += few ? 1 : every)
    for (double lead : {1.0, 2.0, 5.0}) {
      if (!few && lead > 1) continue;
      const double at = decade + std::log10(lead);
      if (at >= low - 1e-9 && at <= high + 1e-9) ticks.push_back(at);
    }
  return ticks;
}

std::string decade_label(double at) {
  const double value = std::pow(10.0, at);
  return value >= 0.01 && value < 99999 ? fmt::format("{:.3g}", value) : fmt::format("{:.0e}", value);
}

constexpr double kLegendRow = 14, kLegendLine = 16, kLegendGap = 5, kLegendSpace = 12;
const TextStyle kLegendText{.size = 9.5, .anchor = Anchor::kRight};

/// The curves that have a name, in as many rows as their names need within `width`; the first row leaves room for the title.
std::vector<std::vector<const Curve*>> legend_rows(Canvas& canvas, const Chart& chart, double width) {
  std::vector<std::vector<const Curve*>> rows;
  double left = 0;
  for (const auto* curves : {&chart.curves, &chart.right_curves})
    for (const Curve& c : *curves) {
      if (c.label.empty()) continue;
      const double needed = canvas.text_width(c.label, kLegendText) + kLegendGap + kLegendLine + kLegendSpace;
      if (rows.empty() || needed > left) {
        rows.emplace_back();
        left = width;
        if (rows.size() == 1) left -= canvas.text_width(chart.title, {.size = 12, .weight = Weight::kBold});
      }
      rows.back().push_back(&c);
      left -= needed;
    }
  return rows;
}

}  // namespace

std::vector<double> round_ticks(double low, double high, int count) {
  const double raw = (high - low) / std::max(1, count);
  if (!(raw > 0) || !std::isfinite(raw)) return {low};
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double lead = raw / power;
  const double step = power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
  std::vector<double> ticks;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    ticks.push_back(k == 0 ? 0 : k * step);
  return ticks;
}

std::string tick_label(double value, const std::vector<double>& ticks) {
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : std::max(std::abs(value), 1.0);
  const double largest = ticks.empty() ? step : std::max(std::abs(ticks.front()), std::abs(ticks.back()));
  if (largest >= 1e5 || largest < 1e-3) return value == 0 ? "0" : fmt::format("{:.3g}", value);
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  std::string text = fmt::format("{:.{}f}", value, decimals);
  return text[0] == '-' ? "\u2212" + text.substr(1) : text;
}

ScaledUnit scaled_unit(double largest, const std::string& unit) {
  static constexpr const char* kPrefixes[] = {"f", "p", "n", "\u00b5", "m", "", "k", "M", "G", "T"};
  const double size = std::abs(largest);
  if (!(size > 0) || unit == "1") return {1, unit == "1" ? "" : unit};
  const int power = std::clamp(static_cast<int>(std::floor(std::log10(size) / 3 + 1e-12)), -5, 4);
  return {std::pow(10.0, 3 * power), kPrefixes[power + 5] + unit};
}

void draw_chart(Canvas& canvas, const Box& page, const Chart& given) {
  const Chart chart = scaled(given);
  const bool log_x = chart.x_scale == Scale::kLogarithmic, log_y = chart.y_scale == Scale::kLogarithmic;
  const bool two_axes = !chart.right_curves.empty();
  const double right_margin = two_axes ? 60 : 16;
  const auto legend = legend_rows(canvas, chart, page.size().x() - 58 - right_margin);
  const double top = 34 + kLegendRow * static_cast<double>(std::max<std::size_t>(1, legend.size()) - 1);
  const Box plot{page.lo + Vec2(58, top), page.hi - Vec2(right_margin, 44)};
  Range x, y, right;
  for (const Curve& c : chart.curves) x.take(c.x), x.take_bars(c), y.take(c.y);
  for (const Curve& c : chart.right_curves) x.take(c.x), right.take(c.y);
  log_y ? y.widen() : y.round_up();
  right.round_up();
  if (x.low > x.high) x.low = 0, x.high = 1;
  if (log_x) x.widen();
  const bool bars =
      std::any_of(chart.curves.begin(), chart.curves.end(), [](const Curve& c) { return c.drawn == CurveKind::kBars; });
  if (!log_x && !bars && x.low > 0 && x.low < 0.3 * x.high) x.low = 0;
  if (x.low == x.high) x.high = x.low + 1;
  const Vec2 span = plot.size();
  const auto to_page = [&](double at_x, double at_y, const Range& axis) {
    return Vec2(plot.lo.x() + (at_x - x.low) / (x.high - x.low) * span.x(),
                plot.hi.y() - (at_y - axis.low) / (axis.high - axis.low) * span.y());
  };

  const TextStyle tick{.size = 9.5};
  const std::vector<double> x_ticks = log_x ? decade_ticks(x.low, x.high) : round_ticks(x.low, x.high, 7);
  const std::vector<double> y_ticks = log_y ? decade_ticks(y.low, y.high) : round_ticks(y.low, y.high, 6);
  for (double v : y_ticks) {
    const Vec2 at = to_page(x.low, v, y);
    canvas.line({at, {plot.hi.x(), at.y()}}, {v == 0 && y.low < 0 && !log_y ? kFrame : kGrid, 0.8, {}});
    canvas.text(at + Vec2(-7, 3.4), log_y ? decade_label(v) : tick_label(v, y_ticks),
                {.size = tick.size, .anchor = Anchor::kRight});
  }
  for (double v : x_ticks) {
    const Vec2 at = to_page(v, y.low, y);
    canvas.line({at, at + Vec2(0, 4)}, {kFrame, 0.9, {}});
    canvas.text(at + Vec2(0, 16), log_x ? decade_label(v) : tick_label(v, x_ticks),
                {.size = tick.size, .anchor = Anchor::kCentre});
  }
  canvas.line({plot.lo, {plot.lo.x(), plot.hi.y()}, plot.hi}, {kFrame, 0.9, {}});
  if (two_axes) {
    const Colour colour = chart.right_curves.front().style.colour;
    canvas.line({{plot.hi.x(), plot.lo.y()}, plot.hi}, {kFrame, 0.9, {}});
    const std::vector<double> ticks = round_ticks(right.low, right.high, 5);
    for (double v : ticks)
      canvas.text({plot.hi.x() + 6, to_page(x.low, v, right).y() + 3.4}, tick_label(v, ticks),
                  {.size = tick.size, .colour = colour});
    canvas.text({page.hi.x() - 12, 0.5 * (plot.lo.y() + plot.hi.y())}, chart.right_label,
                {.size = 11, .anchor = Anchor::kCentre, .colour = colour, .angle = -M_PI / 2});
  }

  canvas.clipped({plot.lo - Vec2(0, 4), plot.hi + Vec2(0, 2)}, [&] {
    const auto draw = [&](const std::vector<Curve>& curves, const Range& axis) {
      for (const Curve& c : curves) {
        std::vector<Vec2> points;
        for (std::size_t k = 0; k < c.x.size(); ++k) points.push_back(to_page(c.x[k], c.y[k], axis));
        if (c.drawn == CurveKind::kBars && points.size() > 1) {
          const double half = 0.46 * (points[1].x() - points[0].x());
          for (std::size_t k = 0; k < points.size(); ++k)
            canvas.rectangle({points[k] - Vec2(half, 0), {points[k].x() + half, to_page(c.x[k], 0, axis).y()}},
                             c.style.colour);
        }
        if (c.drawn == CurveKind::kLine) canvas.line(points, c.style);
        if (c.drawn == CurveKind::kDots)
          for (const Vec2& point : points) canvas.dot(point, 2.6, c.style.colour);
      }
    };
    draw(chart.right_curves, right);
    draw(chart.curves, y);
  });
  for (const Mark& mark : chart.marks) {
    const Vec2 at = to_page(mark.x, mark.y, y);
    canvas.dot(at, 4.6, {1, 1, 1});
    canvas.dot(at, 3.4, mark.colour);
    const bool at_right = at.x() > plot.hi.x() - 40;
    canvas.text(at + Vec2(at_right ? -8 : 8, -6), mark.label,
                {.size = 10, .anchor = at_right ? Anchor::kRight : Anchor::kLeft, .weight = Weight::kBold});
  }

  canvas.text({0.5 * (plot.lo.x() + plot.hi.x()), page.hi.y() - 9}, chart.x_label,
              {.size = 11, .anchor = Anchor::kCentre});
  canvas.text({page.lo.x() + 14, 0.5 * (plot.lo.y() + plot.hi.y())}, chart.y_label,
              {.size = 11, .anchor = Anchor::kCentre, .angle = -M_PI / 2});
  canvas.text({plot.lo.x(), page.lo.y() + 15}, chart.title, {.size = 12, .weight = Weight::kBold});

  // The legend, right-aligned above the plot: never over a curve.
  for (std::size_t row = 0; row < legend.size(); ++row) {
    const double base = page.lo.y() + 15 + kLegendRow * static_cast<double>(row);
    double place = plot.hi.x();
    for (auto c = legend[row].rbegin(); c != legend[row].rend(); ++c) {
      canvas.text({place, base}, (*c)->label, kLegendText);
      place -= canvas.text_width((*c)->label, kLegendText) + kLegendGap;
      if ((*c)->drawn == CurveKind::kDots)
        canvas.dot({place - 0.5 * kLegendLine, base - 3.5}, 2.6, (*c)->style.colour);
      else if ((*c)->drawn == CurveKind::kBars)
        canvas.rectangle({{place - kLegendLine + 3, base - 8}, {place - 3, base + 1}}, (*c)->style.colour);
      else
        canvas.line({{place - kLegendLine, base - 3.5}, {place, base - 3.5}},
                    {(*c)->style.colour, 2, (*c)->style.dashes});
      place -= kLegendLine + kLegendSpace;
    }
  }
}

}  // namespace lamella
