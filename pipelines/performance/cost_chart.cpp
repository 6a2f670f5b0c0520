// Draws cost against size from lines `CURVE SIZE SECONDS` on standard input, sizes ascending; a curve's name has _ for blanks.
//   cost_chart OUT.png
#include <fmt/core.h>

#include <algorithm>
#include <iostream>

#include "postproc/drawing/chart.h"

namespace lamella {
namespace {

Chart read_chart(std::istream& in) {
  constexpr std::array<Colour, 4> kColours = {
      {{0.13, 0.36, 0.66}, {0.80, 0.33, 0.10}, {0.20, 0.55, 0.30}, {0.45, 0.30, 0.60}}};
  Chart chart{"Cost of generating", "cells", "processor time, one thread [s]"};
  chart.x_scale = chart.y_scale = Scale::kLogarithmic;
  std::string name;
  double size = 0, seconds = 0;
  while (in >> name >> size >> seconds) {
    std::replace(name.begin(), name.end(), '_', ' ');
    if (chart.curves.empty() || chart.curves.back().label != name)
      chart.curves.push_back({{}, {}, {kColours[chart.curves.size() % kColours.size()], 1.6, {}}, name});
    chart.curves.back().x.push_back(size);
    chart.curves.back().y.push_back(seconds);
  }
  for (std::size_t k = 0, lines = chart.curves.size(); k < lines; ++k) {
    Curve dots = chart.curves[k];
    dots.label.clear();
    dots.drawn = CurveKind::kDots;
    chart.curves.push_back(std::move(dots));
  }
  return chart;
}

}  // namespace
}  // namespace lamella

int main(int count, char** arguments) {
  if (count != 2) {
    fmt::print(stderr, "cost_chart: OUT.png\n");
    return 2;
  }
  try {
    const lamella::Chart chart = lamella::read_chart(std::cin);
    const lamella::Box page{{0, 0}, {480, 320}};
    lamella::draw_file(arguments[1], page.hi, [&](lamella::Canvas& canvas) { draw_chart(canvas, page, chart); });
  } catch (const std::exception& e) {
    fmt::print(stderr, "cost_chart: {}\n", e.what());
    return 2;
  }
}
