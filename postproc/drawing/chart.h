// Line and bar charts: axes with ticks at round numbers, labels with units, a legend. Knows nothing of what the curves mean.
#pragma once
#include <string>
#include <vector>

#include "postproc/drawing/canvas.h"

namespace lamella {

/// Round numbers within [low, high], about `count` of them, 1, 2 or 5 times a power of ten apart.
std::vector<double> round_ticks(double low, double high, int count);
/// A number as short as its neighbours in `ticks` allow.
std::string tick_label(double value, const std::vector<double>& ticks);

/// A unit with a prefix that brings `largest` between 1 and 1000: {1e3, "kPa"}.
struct ScaledUnit {
  double factor = 1;
  std::string name;
};
ScaledUnit scaled_unit(double largest, const std::string& unit);

/// Bars stand on zero, centred on their x and as wide as x values are apart, with a little air.
enum class CurveKind { kLine, kDots, kBars };

struct Curve {
  std::vector<double> x, y;
  Style style;
  std::string label;
  CurveKind drawn = CurveKind::kLine;
};

struct Mark {
  double x = 0, y = 0;
  std::string label;
  Colour colour;
};

/// Logarithmic: points that are not positive are left out.
enum class Scale { kLinear, kLogarithmic };

struct Chart {
  std::string title, x_label, y_label;
  std::vector<Curve> curves{};
  std::vector<Mark> marks{};
  // a second axis on the right; unused while it has no curves
  std::string right_label{};
  std::vector<Curve> right_curves{};
  Scale x_scale = Scale::kLinear, y_scale = Scale::kLinear;
};

void draw_chart(Canvas& canvas, const Box& page, const Chart& chart);

}  // namespace lamella
