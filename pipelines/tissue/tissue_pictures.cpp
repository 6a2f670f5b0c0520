#include "pipelines/tissue/tissue_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "generator/tissue/mosaic_text.h"
#include "pipelines/tissue/export.h"
#include "postproc/drawing/tissue_drawing.h"

namespace lamella {
namespace {

const Colour kInk{0.13, 0.14, 0.17}, kQuiet{0.42, 0.44, 0.49};

/// Pale colours for groups; the first is the tissue's usual one.
Colour group_colour(std::size_t k) {
  static const std::array<Colour, 6> kColours{{{0.80, 0.90, 0.77},
                                               {0.98, 0.83, 0.62},
                                               {0.74, 0.83, 0.94},
                                               {0.93, 0.76, 0.80},
                                               {0.84, 0.79, 0.92},
                                               {0.95, 0.92, 0.66}}};
  return kColours[k % kColours.size()];
}

/// Blue below six neighbours, sand at six, red above.
Colour neighbour_colour(Index n) {
  static const std::array<Colour, 7> kColours{{{0.13, 0.30, 0.58},
                                               {0.26, 0.50, 0.75},
                                               {0.58, 0.76, 0.88},
                                               {0.93, 0.90, 0.82},
                                               {0.96, 0.70, 0.48},
                                               {0.85, 0.42, 0.30},
                                               {0.62, 0.14, 0.19}}};
  return kColours[static_cast<std::size_t>(std::clamp<Index>(n, 3, 9) - 3)];
}

Box extent_of(const std::vector<Vec2>& points) {
  Box box{points.front(), points.front()};
  for (const Vec2& p : points) {
    box.lo = box.lo.cwiseMin(p);
    box.hi = box.hi.cwiseMax(p);
  }
  return box;
}

/// Walls get thinner as cells get more, so that a large tissue is not all walls.
double wall_width(const PageMap& map, const PlainMosaic& plain, const Box& extent) {
  const double cell = std::sqrt(extent.area() / static_cast<double>(plain.cells.size())) * map.scale();
  return std::clamp(0.07 * cell, 0.15, 1.4);
}

void draw_tiles(Canvas& canvas, const PageMap& map, const PlainMosaic& plain, double width,
                const std::function<Colour(std::size_t)>& fill) {
  for (std::size_t c = 0; c < plain.cells.size(); ++c) {
    std::vector<Vec2> points;
    for (const Index v : plain.cells[c]) points.push_back(map(plain.vertices[v]));
    const Colour colour = fill(c);
    canvas.polygon(points, colour);
    canvas.outline(points, {mix(colour, kInk, 0.78), width, {}});
  }
}

/// Boxes with what their colours stand for, from `from` to the right.
void draw_neighbour_key(Canvas& canvas, const Vec2& from) {
  Vec2 at = from;
  for (Index n = 3; n <= 9; ++n) {
    canvas.rectangle({at, at + Vec2(13, 13)}, neighbour_colour(n));
    canvas.outline({at, at + Vec2(13, 0), at + Vec2(13, 13), at + Vec2(0, 13)}, {kQuiet, 0.5, {}});
    const std::string label = n == 3 ? "\u2264 3" : n == 9 ? "\u2265 9" : fmt::format("{}", n);
    canvas.text(at + Vec2(18, 10.5), label, {.size = 10});
    at.x() += 18 + canvas.text_width(label, {.size = 10}) + 14;
  }
}

}  // namespace

void draw_mosaic(const std::filesystem::path& path, const Mosaic& mosaic) {
  const PlainMosaic plain = in_one_piece(mosaic);
  const Box extent = extent_of(plain.vertices);
  const double shape = extent.size().x() / extent.size().y();
  const Vec2 inner = shape > 1 ? Vec2(720, std::max(60.0, 720 / shape)) : Vec2(std::max(60.0, 720 * shape), 720);
  const double margin = 12;
  std::map<std::string, std::size_t> groups;
  for (const MosaicCell& cell : mosaic.cells) groups.try_emplace(cell.group, groups.size());
  draw_file(path, inner + Vec2(2 * margin, 2 * margin), [&](Canvas& canvas) {
    const PageMap map(extent, {Vec2(margin, margin), Vec2(margin, margin) + inner});
    draw_tiles(canvas, map, plain, wall_width(map, plain, extent),
               [&](std::size_t c) { return group_colour(groups.at(mosaic.cells[c].group)); });
  });
}

void draw_sample(const std::filesystem::path& path, const Sample& sample) {
  Frame at_rest;
  std::vector<double> flat;
  for (const Vec2& p : sample.x) flat.insert(flat.end(), {p.x(), p.y()});
  at_rest.arrays.add({"x", "m", "node", 2, std::move(flat)});
  const FrameView view(sample, at_rest);
  Box extent = extent_of(sample.x);
  const double reach = *std::max_element(sample.radius.begin(), sample.radius.end());
  extent.lo -= Vec2::Constant(reach);
  extent.hi += Vec2::Constant(reach);
  const double shape = extent.size().x() / extent.size().y();
  const Vec2 inner = shape > 1 ? Vec2(720, std::max(60.0, 720 / shape)) : Vec2(std::max(60.0, 720 * shape), 720);
  const double margin = 12;
  draw_file(path, inner + Vec2(2 * margin, 2 * margin), [&](Canvas& canvas) {
    const PageMap map(extent, {Vec2(margin, margin), Vec2(margin, margin) + inner});
    draw_cells(canvas, map, view, [&](Index c) { return group_colour(static_cast<std::size_t>(sample.group[c])); });
  });
}

std::vector<std::filesystem::path> draw_neighbours_and_areas(const std::filesystem::path& stem, const Mosaic& mosaic,
                                                             const MosaicMeasures& measures) {
  const PlainMosaic plain = in_one_piece(mosaic);
  const Box extent = extent_of(plain.vertices);
  const double shape = extent.size().x() / extent.size().y();
  const double width = 400, height = std::clamp(width / shape, 60.0, 640.0);
  const double margin = 16, header = 26, footer = 44, gap = 30, bar = 84;
  const Vec2 size(2 * margin + 2 * width + gap + bar, header + height + footer + margin);
  double mean = 0;
  for (const CellMeasures& cell : measures.cells) mean += cell.area / static_cast<double>(measures.cells.size());
  std::vector<double> relative;
  for (const CellMeasures& cell : measures.cells) relative.push_back(cell.area / mean);
  auto sorted = relative;
  std::sort(sorted.begin(), sorted.end());
  // A few giants would leave no colour for the others.
  const double usual = sorted[sorted.size() * 99 / 100], most = sorted.back();
  const bool clipped = most > 1.3 * usual;
  const double high = std::max(clipped ? usual : most, 1.2);
  return draw_page(stem, size, [&](Canvas& canvas) {
    const auto panel = [&](double left, const char* title, const std::function<Colour(std::size_t)>& fill) {
      const Box area{Vec2(left, header), Vec2(left + width, header + height)};
      const PageMap map(extent, area);
      canvas.text({left + width / 2, 17}, title, {.size = 12.5, .anchor = Anchor::kCentre, .weight = Weight::kBold});
      draw_tiles(canvas, map, plain, wall_width(map, plain, extent), fill);
      return map;
    };
    const PageMap map = panel(margin, "number of neighbours", [&](std::size_t c) {
      const Colour colour = neighbour_colour(measures.cells[c].neighbours);
      return measures.cells[c].layer == 0 ? mix(colour, {1, 1, 1}, 0.55) : colour;
    });
    panel(margin + width + gap, "area over its mean", [&](std::size_t c) { return viridis(relative[c] / high); });
    draw_neighbour_key(canvas, {margin, header + height + 14});
    if (std::any_of(measures.cells.begin(), measures.cells.end(), [](const auto& c) { return c.layer == 0; }))
      canvas.text({margin, header + height + 43}, "pale: at the boundary, not counted",
                  {.size = 9.5, .colour = kQuiet});
    draw_scale_bar(canvas, map, {margin + width + gap, header + height + 26});
    const double tall = std::min(260.0, 0.9 * height);
    const Vec2 at(size.x() - margin - bar + 16, header + 0.5 * (height - tall));
    draw_colour_bar(canvas, {at, at + Vec2(13, tall)},
                    {.low = 0, .high = high, .open_end = clipped, .label = "A / \u27e8A\u27e9", .map = viridis});
  });
}

}  // namespace lamella
