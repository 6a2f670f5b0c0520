#include "postproc/drawing/tissue_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "postproc/drawing/chart.h"
#include "postproc/quantities/fragments.h"
#include "postproc/quantities/link_frame.h"

namespace lamella {
namespace {

constexpr double kMoves = 1e-6;       // of the gauge length: a grip that has moved
constexpr double kGripShare = 0.022;  // thickness of a grip's bar over the larger side of the box
const Colour kInk{0.13, 0.14, 0.17}, kGrip{0.47, 0.50, 0.55}, kOpened{0.93, 0.94, 0.95};

struct Grip {
  Box bar;                    // [m]
  Vec2 moved = Vec2::Zero();  // mean displacement of its nodes [m]
  Vec2 outward = Vec2::Zero();
};

/// The box as it is now, about its middle.
Box moved_box(const FrameView& view) {
  const Vec2 middle = 0.5 * (view.sample.box.lo + view.sample.box.hi), half = 0.5 * view.box_size();
  return {middle - half, middle + half};
}

std::vector<Grip> grips(const FrameView& view, const TestSetup& setup) {
  const Sample& sample = view.sample;
  const double thickness = kGripShare * sample.box.size().maxCoeff();
  const int along = setup.axis, across = 1 - along;
  const SidePair sides = sides_across(along);
  const double r = sample.radius.empty() ? 0 : *std::max_element(sample.radius.begin(), sample.radius.end());
  std::vector<Grip> found;
  for (const std::uint8_t side : {sides.low, sides.high}) {
    Vec2 lo = Vec2::Constant(std::numeric_limits<double>::max()), hi = -lo, moved = Vec2::Zero();
    int count = 0;
    for (Index i = 0; i < sample.nodes(); ++i)
      if (sample.side[i] & side) {
        lo = lo.cwiseMin(view.x[i]), hi = hi.cwiseMax(view.x[i]);
        moved += view.x[i] - sample.x[i], ++count;
      }
    if (count == 0) continue;
    Grip grip;
    // Only along the load: what the grips do across it is the sample's contraction.
    const int component = setup.kind == "shear" ? across : along;
    grip.moved[component] = moved[component] / count;
    const double sign = side == sides.low ? -1 : 1;
    grip.outward[along] = sign;
    const double face = (sign < 0 ? lo[along] : hi[along]) + sign * r;
    grip.bar.lo[along] = std::min(face, face + sign * thickness),
    grip.bar.hi[along] = std::max(face, face + sign * thickness);
    grip.bar.lo[across] = lo[across] - r, grip.bar.hi[across] = hi[across] + r;
    found.push_back(grip);
  }
  return found;
}

/// The bars that are left of a cell, piece by piece; it encloses nothing, so nothing is filled.
void draw_pieces(Canvas& canvas, const FrameView& view, Index cell, const std::vector<Vec2>& points,
                 const Style& style) {
  const Sample& sample = view.sample;
  const Index begin = sample.cell_begin[cell], size = sample.cell_size(cell);
  // From behind a broken bar, once around.
  Index first = 0;
  while (sample.closed[cell] && !view.gone(begin + (first + size - 1) % size)) ++first;
  std::vector<Vec2> piece;
  for (Index k = 0; k < size; ++k) {
    const Index i = (first + k) % size;
    piece.push_back(points[i]);
    if (sample.starts_segment(cell, begin + i) && !view.gone(begin + i)) continue;
    if (piece.size() > 1) canvas.line(piece, style);
    piece.clear();
  }
}

}  // namespace

PageMap::PageMap(const Box& world, const Box& page)
    : world_(0.5 * (world.lo + world.hi)), page_(0.5 * (page.lo + page.hi)), world_width_(world.size().x()) {
  scale_ = std::min(page.size().x() / world.size().x(), page.size().y() / world.size().y());
}

Box drawn_extent(const std::vector<const FrameView*>& views, const std::optional<TestSetup>& setup) {
  Box extent{Vec2::Constant(std::numeric_limits<double>::max()), Vec2::Constant(std::numeric_limits<double>::lowest())};
  const auto take = [&](const Vec2& p) { extent.lo = extent.lo.cwiseMin(p), extent.hi = extent.hi.cwiseMax(p); };
  double r = 0;
  for (const FrameView* view : views) {
    for (const Vec2& p : view->x) take(p);
    if (view->box_moves()) take(moved_box(*view).lo), take(moved_box(*view).hi);
    for (double radius : view->sample.radius) r = std::max(r, radius);
    if (setup)
      for (const Grip& grip : grips(*view, *setup)) take(grip.bar.lo), take(grip.bar.hi);
  }
  double longest = extent.size().maxCoeff();
  if (!(longest > 0)) longest = 1;
  // A straight chain is flat: it gets some height.
  const Vec2 half = 0.5 * extent.size().cwiseMax(Vec2::Constant(0.12 * longest)) + Vec2::Constant(r + 0.015 * longest);
  const Vec2 centre = 0.5 * (extent.lo + extent.hi);
  Box world{centre - half, centre + half};
  world.lo.y() -= 0.07 * world.size().y();  // the scale bar's strip
  // Arrows outside the grips that move.
  if (setup)
    for (const FrameView* view : views)
      for (const Grip& grip : grips(*view, *setup)) {
        if (grip.moved.norm() < kMoves * setup->gauge_length) continue;
        const double tip = grip.outward[setup->axis] * 0.075 * longest;
        if (tip > 0) world.hi[setup->axis] = std::max(world.hi[setup->axis], grip.bar.hi[setup->axis] + tip);
        if (tip < 0) world.lo[setup->axis] = std::min(world.lo[setup->axis], grip.bar.lo[setup->axis] + tip);
      }
  return world;
}

void draw_cells(Canvas& canvas, const PageMap& map, const FrameView& view, const std::function<Colour(Index)>& fill,
                const Colour& wall) {
  const Sample& sample = view.sample;
  for (Index c = 0; c < sample.cells(); ++c) {
    std::vector<Vec2> points;
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) points.push_back(map(view.x[i]));
    const double width = std::max(0.35, 2 * sample.radius[c] * map.scale());
    if (view.broken_bars() && view.broken_bars()->opened(c)) {
      draw_pieces(canvas, view, c, points, {mix(kOpened, wall, 0.75), width, {}});
      continue;
    }
    if (!sample.closed[c]) {
      canvas.line(points, {mix(fill(c), wall, 0.15), std::max(width, 1.2), {}});
      continue;
    }
    const Colour colour = fill(c);
    canvas.polygon(points, colour);
    // A little of the cell's colour, and lifted on dark cells, so that cells stay apart everywhere.
    const double lightness = 0.2126 * colour.red + 0.7152 * colour.green + 0.0722 * colour.blue;
    const Colour lifted = mix(wall, {0.50, 0.48, 0.58}, std::clamp(1 - lightness / 0.3, 0.0, 1.0));
    canvas.outline(points, {mix(colour, lifted, 0.82), width, {}});
  }
}

void draw_images(Canvas& canvas, const PageMap& map, const FrameView& view,
                 const std::function<void(const Vec2&)>& draw) {
  const Sample& sample = view.sample;
  if (!is_periodic(sample)) return draw(Vec2(0, 0));
  Box cells{map(view.x.front()), map(view.x.front())};
  for (const Vec2& p : view.x) cells.lo = cells.lo.cwiseMin(map(p)), cells.hi = cells.hi.cwiseMax(map(p));
  canvas.clipped(cells, [&] {
    for (int j = sample.periodic[1] ? -1 : 0; j <= (sample.periodic[1] ? 1 : 0); ++j)
      for (int i = sample.periodic[0] ? -1 : 0; i <= (sample.periodic[0] ? 1 : 0); ++i)
        draw(Vec2(i, j).cwiseProduct(view.box_size()));
  });
}

std::vector<Vec2> bar_mark(const PageMap& map, const Sample& sample, Index cell, Index bar) {
  const Vec2 p = sample.x[bar], q = sample.x[sample.next(cell, bar)];
  // Long enough to be seen on thin walls, and never longer than the bar.
  const double half = std::max(2 * sample.radius[cell], std::min(0.5 * (q - p).norm(), 5 / map.scale()));
  const Vec2 across = half * left_of(Vec2((q - p).normalized()));
  return {map(0.5 * (p + q) - across), map(0.5 * (p + q) + across)};
}

std::vector<Vec2> link_mark(const PageMap& map, const FrameView& view, Index l, const std::vector<Vec2>& x) {
  const Link link = view.link(l);
  const Vec2 displaced = &x == &view.x ? view.displaced(l) : link_displacement(view.sample, l);
  const Vec2 t = link_frame(link, x, displaced).t, middle = link_middle(link, x, displaced);
  // An end link stands for the half spacing towards its wall's inside.
  double before = 0.5 * link.length, after = before;
  if (link.wall_end && link.a_prev == link.a) before = 0, after = link.length;
  if (link.wall_end && link.a_next == link.a) before = link.length, after = 0;
  return {map(middle - before * t), map(middle + after * t)};
}

void draw_grips(Canvas& canvas, const PageMap& map, const FrameView& view, const TestSetup& setup) {
  if (view.box_moves()) {
    const Box box = moved_box(view);
    canvas.outline({map(box.lo), map({box.hi.x(), box.lo.y()}), map(box.hi), map({box.lo.x(), box.hi.y()})},
                   {kGrip, 1, {}});
  }
  for (const Grip& grip : grips(view, setup)) {
    const Vec2 a = map(grip.bar.lo), b = map(grip.bar.hi);
    const Box bar{a.cwiseMin(b), a.cwiseMax(b)};
    canvas.rectangle(bar, {0.86, 0.87, 0.89});
    canvas.clipped(bar, [&] {
      const double height = bar.size().y() + bar.size().x();
      for (double at = bar.lo.x() - bar.size().y(); at < bar.hi.x() + bar.size().y(); at += 6)
        canvas.line({{at, bar.hi.y()}, {at + height, bar.hi.y() - height}}, {kGrip, 0.8, {}});
    });
    canvas.outline({bar.lo, {bar.hi.x(), bar.lo.y()}, bar.hi, {bar.lo.x(), bar.hi.y()}}, {kGrip, 1, {}});
    if (grip.moved.norm() < kMoves * setup.gauge_length) continue;
    const Vec2 centre = 0.5 * (bar.lo + bar.hi);
    const Vec2 outward(grip.outward.x(), -grip.outward.y());  // on the page
    const Vec2 way = Vec2(grip.moved.x(), -grip.moved.y()).normalized();
    const double half = 0.5 * bar.size()[setup.axis], arrow = 17;
    // Along the pull the arrow starts at the bar, across it (shear) it runs beside it, against it (compression) it ends there.
    const double along = way.dot(outward);
    const Vec2 edge = centre + (half + 3) * outward;
    if (along > 0.5)
      canvas.arrow(edge, edge + arrow * way, {kInk, 1.8, {}});
    else if (along < -0.5)
      canvas.arrow(edge - arrow * way, edge, {kInk, 1.8, {}});
    else
      canvas.arrow(edge + 5 * outward - arrow * way, edge + 5 * outward + arrow * way, {kInk, 1.8, {}});
  }
}

void draw_scale_bar(Canvas& canvas, const PageMap& map, const Vec2& corner) {
  const double wanted = 0.22 * map.world_width();
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  const double length = power * (wanted / power >= 5 ? 5 : wanted / power >= 2 ? 2 : 1);
  const ScaledUnit unit = scaled_unit(length * (1 + 1e-9), "m");
  const Vec2 from = corner + Vec2(2, -4), to = from + Vec2(length * map.scale(), 0);
  canvas.line({from, to}, {kInk, 2.4, {}});
  canvas.text(to + Vec2(7, 3.5), fmt::format("{:g} {}", std::round(length / unit.factor * 1e6) / 1e6, unit.name),
              {.size = 10});
}

void draw_colour_bar(Canvas& canvas, const Box& area, const ColourBar& bar) {
  constexpr int kSteps = 128;
  const double height = area.size().y();
  for (int k = 0; k < kSteps; ++k) {
    const double top = area.hi.y() - height * (k + 1) / kSteps;
    // Each step reaches half a step into the last one, so that no seams show.
    canvas.rectangle({{area.lo.x(), top}, {area.hi.x(), std::min(area.hi.y(), top + 1.5 * height / kSteps)}},
                     bar.map((k + 0.5) / kSteps));
  }
  if (bar.open_end)
    canvas.polygon({{area.lo.x(), area.lo.y() - 2},
                    {area.hi.x(), area.lo.y() - 2},
                    {0.5 * (area.lo.x() + area.hi.x()), area.lo.y() - 13}},
                   bar.map(1));
  const std::vector<double> ticks = round_ticks(bar.low, bar.high, 6);
  double widest = 0;
  for (double v : ticks) {
    const double y = area.hi.y() - height * (v - bar.low) / (bar.high - bar.low);
    canvas.line({{area.hi.x(), y}, {area.hi.x() + 4, y}}, {kInk, 0.8, {}});
    const std::string label = tick_label(v, ticks);
    canvas.text({area.hi.x() + 7, y + 3.4}, label, {.size = 9.5});
    widest = std::max(widest, canvas.text_width(label, {.size = 9.5}));
  }
  canvas.text({area.hi.x() + 7 + widest + 14, 0.5 * (area.lo.y() + area.hi.y())}, bar.label,
              {.size = 10.5, .anchor = Anchor::kCentre, .angle = -M_PI / 2});
}

}  // namespace lamella
