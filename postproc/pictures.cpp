#include "postproc/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "postproc/drawing/chart.h"
#include "postproc/drawing/tissue_drawing.h"
#include "postproc/quantities/cell_energy.h"
#include "postproc/quantities/link_frame.h"

namespace lamella {
namespace {

const Colour kInk{0.13, 0.14, 0.17}, kQuiet{0.42, 0.44, 0.49}, kCrack{0.90, 0.20, 0.16};

/// The cells' energies in the unit of the picture.
struct EnergyScale {
  double unit = 1;  // [J]
  double largest = 0;
  bool clipped = false;  // some cells lie above
  std::string label;
};

EnergyScale energy_scale(const std::vector<Snapshot>& snapshots) {
  EnergyScale scale;
  std::vector<double> all;
  for (const Snapshot& s : snapshots) {
    const std::vector<double> total = cell_energy(*s.view).total;
    for (Index c = 0; c < static_cast<Index>(total.size()); ++c)
      if (!s.view->broken_bars() || !s.view->broken_bars()->opened(c)) all.push_back(total[c]);
  }
  std::sort(all.begin(), all.end());
  const double most = all.empty() ? 0 : all.back();
  const double usual = all.empty() ? 0 : all[std::min(all.size() - 1, all.size() * 99 / 100)];
  // A few cells of a crack tip would leave no colour for the others.
  scale.clipped = most > 1.3 * usual && usual > 0;
  scale.largest = scale.clipped ? usual : most;
  const double w0 = snapshots.empty() ? 0 : link_reference_energy(*snapshots.front().view);
  if (w0 > 0) {
    scale.unit = w0;
    scale.label = "elastic energy of a cell / W\u2080";
  } else {
    const ScaledUnit unit = scaled_unit(scale.largest, "J");
    scale.unit = 1 / unit.factor > 0 ? unit.factor : 1;
    scale.label = "elastic energy of a cell [" + unit.name + "]";
  }
  scale.largest /= scale.unit;
  if (w0 > 0) scale.largest = std::max(scale.largest, 1e-6);  // below that, colours would show rounding
  if (!(scale.largest > 0)) scale.largest = 1;
  return scale;
}

}  // namespace

Paths draw_snapshots(const std::filesystem::path& stem, const std::vector<Snapshot>& snapshots,
                     const std::optional<TestSetup>& setup) {
  std::vector<const FrameView*> views;
  for (const Snapshot& s : snapshots) views.push_back(s.view);
  const Box world = drawn_extent(views, setup);
  const double shape = world.size().x() / world.size().y();
  const bool stacked = shape > 1.8 && snapshots.size() > 1;
  const auto count = static_cast<double>(snapshots.size());
  const double panel_width = stacked || count == 1 ? 560 : 330, header = 44, gap = 14, margin = 14, bar = 92;
  const double panel_height = std::min(panel_width / shape, 760.0);
  const Vec2 size =
      stacked ? Vec2(2 * margin + panel_width + bar, margin + count * (header + panel_height + gap))
              : Vec2(2 * margin + count * panel_width + (count - 1) * gap + bar, 2 * margin + header + panel_height);
  const EnergyScale scale = energy_scale(snapshots);

  return draw_page(stem, size, [&](Canvas& canvas) {
    for (std::size_t k = 0; k < snapshots.size(); ++k) {
      const double step = static_cast<double>(k);
      const Vec2 corner = stacked ? Vec2(margin, margin + step * (header + panel_height + gap))
                                  : Vec2(margin + step * (panel_width + gap), margin);
      const Box area{corner + Vec2(0, header), corner + Vec2(panel_width, header + panel_height)};
      const PageMap map(world, area);
      const Snapshot& snapshot = snapshots[k];
      const Vec2 middle(0.5 * (area.lo.x() + area.hi.x()), corner.y());
      canvas.text(middle + Vec2(0, 14), snapshot.title,
                  {.size = 13, .anchor = Anchor::kCentre, .weight = Weight::kBold});
      canvas.text(middle + Vec2(0, 31), snapshot.subtitle, {.size = 10.5, .anchor = Anchor::kCentre, .colour = kQuiet});

      const CellEnergy energy = cell_energy(*snapshot.view);
      draw_cells(canvas, map, *snapshot.view,
                 [&](Index c) { return viridis(energy.total[c] / scale.unit / scale.largest); });
      draw_images(canvas, map, *snapshot.view, [&](const Vec2& displaced) {
        const Vec2 on_page = map(displaced) - map(Vec2(0, 0));
        for (const Crack& crack : snapshot.cracks)
          for (const CrackLine& line : crack.lines) {
            std::vector<Vec2> points;
            for (const Vec2& p : line.points) points.push_back(map(p));
            if (points.size() == 1) points = link_mark(map, *snapshot.view, line.links[0], snapshot.view->x);
            for (Vec2& p : points) p += on_page;
            canvas.line(points, {kCrack, 1.7, {}});
          }
      });
      if (setup) draw_grips(canvas, map, *snapshot.view, *setup);
      if (k == 0) draw_scale_bar(canvas, map, {area.lo.x(), corner.y() + header + panel_height});
    }
    const double height = std::min(300.0, 0.8 * (size.y() - header));
    const Vec2 at(size.x() - margin - bar + 22, header + 0.5 * (size.y() - header - height));
    draw_colour_bar(canvas, {at, at + Vec2(14, height)},
                    {.low = 0, .high = scale.largest, .open_end = scale.clipped, .label = scale.label, .map = viridis});
  });
}

Paths draw_crack_path(const std::filesystem::path& stem, const FrameView& last, const std::vector<Crack>& cracks,
                      const std::optional<TestSetup>& setup, const LoadCurve& curve) {
  const Sample& sample = last.sample;
  Frame at_rest;
  std::vector<double> flat;
  for (const Vec2& p : sample.x) flat.push_back(p.x()), flat.push_back(p.y());
  at_rest.arrays.add({"x", "m", "node", 2, std::move(flat)});
  const FrameView rest(sample, at_rest);

  // When each link broke, as strain where there is one.
  const std::vector<double>* break_time = last.doubles("link_break_time");
  const std::vector<double>* bar_break_time = last.doubles("bar_break_time");
  const bool by_strain = setup && !curve.strain.empty();
  const auto broken_at = [&](const std::vector<double>* times, Index k) {
    const double time = times ? (*times)[k] : last.frame.time;
    return by_strain ? 100 * value_at(curve.time, curve.strain, time) : time;
  };
  const auto when = [&](Index link) { return broken_at(break_time, link); };
  const BrokenBars* const broken = last.broken_bars();
  std::vector<std::pair<Index, Index>> bars;  // (cell, segment) that is gone
  for (Index c = 0; broken && c < sample.cells(); ++c)
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i)
      if (broken->gone(i)) bars.emplace_back(c, i);
  double first = std::numeric_limits<double>::max(), latest = std::numeric_limits<double>::lowest();
  for (const Crack& crack : cracks)
    for (const CrackLine& line : crack.lines)
      for (Index l : line.links) first = std::min(first, when(l)), latest = std::max(latest, when(l));
  for (const auto& [cell, bar] : bars)
    first = std::min(first, broken_at(bar_break_time, bar)), latest = std::max(latest, broken_at(bar_break_time, bar));
  if (first > latest) first = 0, latest = 1;
  if (first == latest) latest = first + std::max(1e-12, 0.01 * std::abs(first));

  const Box world = drawn_extent({&rest}, setup);
  const double width = 520, header = 44, margin = 14, bar = 92;
  const double height = std::min(width * world.size().y() / world.size().x(), 760.0);
  const Vec2 size(2 * margin + width + bar, 2 * margin + header + height);
  const auto side_to_side =
      std::count_if(cracks.begin(), cracks.end(), [](const Crack& c) { return c.from_side_to_side; });

  return draw_page(stem, size, [&](Canvas& canvas) {
    const Box area{Vec2(margin, margin + header), Vec2(margin + width, margin + header + height)};
    const PageMap map(world, area);
    canvas.text({margin + 0.5 * width, margin + 14}, "Crack path on the undeformed tissue",
                {.size = 13, .anchor = Anchor::kCentre, .weight = Weight::kBold});
    canvas.text(
        {margin + 0.5 * width, margin + 31},
        fmt::format("{} crack{}{}, {} from side to side", cracks.size(), cracks.size() == 1 ? "" : "s",
                    bars.empty() ? "" : " between cells", side_to_side) +
            (bars.empty() ? "" : fmt::format("; {} broken bar{} of walls", bars.size(), bars.size() == 1 ? "" : "s")),
        {.size = 10.5, .anchor = Anchor::kCentre, .colour = kQuiet});
    draw_cells(
        canvas, map, rest,
        [&](Index c) {
          return broken && broken->opened(c) ? Colour{0.98, 0.92, 0.86} : Colour{0.93, 0.94, 0.95};
        },
        Colour{0.74, 0.76, 0.79});
    // Later breaks first, so that the beginning stays on top.
    struct Piece {
      double when;
      std::vector<Vec2> points;
    };
    std::vector<Piece> pieces;
    for (const Crack& crack : cracks)
      for (const CrackLine& line : crack.lines)
        for (Index l : line.links) pieces.push_back({when(l), link_mark(map, rest, l, sample.x)});
    for (const auto& [cell, segment] : bars)
      pieces.push_back({broken_at(bar_break_time, segment), bar_mark(map, sample, cell, segment)});
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.when > b.when; });
    for (const Piece& p : pieces) canvas.line(p.points, {embers((p.when - first) / (latest - first)), 3.2, {}});
    if (setup) draw_grips(canvas, map, rest, *setup);
    draw_scale_bar(canvas, map, {area.lo.x(), margin + header + height});

    const double bar_height = std::min(300.0, 0.8 * height);
    const Vec2 at(size.x() - margin - bar + 22, header + 0.5 * (size.y() - header - bar_height));
    draw_colour_bar(canvas, {at, at + Vec2(14, bar_height)},
                    {.low = first,
                     .high = latest,
                     .label = by_strain ? "strain at break [%]" : "time of break [s]",
                     .map = embers});
  });
}

Paths draw_stress_strain(const std::filesystem::path& stem, const LoadCurve& curve, const TestSetup& setup,
                         const std::vector<Event>& events, const std::vector<double>& mark_times) {
  double largest = 0;
  for (double s : curve.stress) largest = std::max(largest, std::abs(s));
  const ScaledUnit unit = scaled_unit(largest, "Pa");
  Chart chart;
  chart.x_label = setup.kind == "shear"         ? "shear strain \u03b3 [%]"
                  : setup.kind == "compression" ? "compressive strain \u03b5 [%]"
                                                : "strain \u03b5 [%]";
  chart.y_label = fmt::format("{} \u03c3 [{}]",
                              setup.kind == "shear"         ? "shear stress"
                              : setup.kind == "compression" ? "compressive stress"
                                                            : "nominal stress",
                              unit.name);
  Curve stress{.x = {}, .y = {}, .style = {viridis(0.22), 1.7, {}}, .label = ""};
  for (std::size_t k = 0; k < curve.strain.size(); ++k)
    stress.x.push_back(100 * curve.strain[k]), stress.y.push_back(curve.stress[k] / unit.factor);
  if (!events.empty()) {
    stress.label = "stress";
    const bool bars = std::any_of(events.begin(), events.end(), [](const Event& e) { return e.bar >= 0; });
    const std::string what = bars ? "broken links and bars" : "broken links";
    // A staircase.
    Curve broken{.x = {0}, .y = {0}, .style = {{0.80, 0.43, 0.20}, 1.3, {}}, .label = what};
    std::vector<double> strains;
    for (const Event& e : events)
      if (!curve.time.empty() && e.time <= curve.time.back())
        strains.push_back(100 * value_at(curve.time, curve.strain, e.time));
    double count = 0;
    for (double s : strains) {
      broken.x.push_back(s), broken.y.push_back(count++);
      broken.x.push_back(s), broken.y.push_back(count);
    }
    if (!stress.x.empty()) broken.x.push_back(stress.x.back()), broken.y.push_back(count);
    chart.right_curves.push_back(std::move(broken));
    chart.right_label = what;
  }
  chart.curves.push_back(std::move(stress));
  for (std::size_t k = 0; k < mark_times.size(); ++k)
    chart.marks.push_back({100 * value_at(curve.time, curve.strain, mark_times[k]),
                           value_at_frame(curve.time, curve.stress, mark_times[k]) / unit.factor,
                           std::string(1, static_cast<char>('a' + k)), kCrack});
  const Vec2 size(560, 380);
  return draw_page(stem, size, [&](Canvas& canvas) { draw_chart(canvas, {Vec2(0, 8), size}, chart); });
}

Paths draw_energy_ledger(const std::filesystem::path& stem, const EnergyBudget& budget,
                         const std::vector<double>& strain) {
  double largest = budget.largest_work;
  for (double e : budget.stored) largest = std::max(largest, std::abs(e));
  const ScaledUnit unit = scaled_unit(largest, "J");
  const bool by_strain = !strain.empty() && *std::max_element(strain.begin(), strain.end()) > 0;
  const std::vector<double>& x = by_strain ? strain : budget.time;
  double latest = x.empty() ? 1 : std::abs(x.back());
  const ScaledUnit time_unit = scaled_unit(latest, "s");
  Chart chart;
  chart.x_label = by_strain ? "strain \u03b5 [%]" : "time [" + time_unit.name + "]";
  chart.y_label = "energy [" + unit.name + "]";
  const auto add = [&](const std::vector<double>& values, const std::string& label, const Style& style) {
    Curve curve{.x = {}, .y = {}, .style = style, .label = label};
    for (std::size_t k = 0; k < values.size(); ++k) {
      curve.x.push_back(by_strain ? 100 * x[k] : x[k] / time_unit.factor);
      curve.y.push_back(values[k] / unit.factor);
    }
    chart.curves.push_back(std::move(curve));
  };
  add(budget.work, "work", {kInk, 1.6, {5, 3}});
  add(budget.stored, "stored", {viridis(0.2), 1.7, {}});
  static const std::vector<std::pair<std::string, Colour>> kColours{
      {"kinetic", {0.20, 0.63, 0.75}}, {"damping", {0.55, 0.57, 0.62}},  {"friction", {0.64, 0.42, 0.72}},
      {"plastic", {0.20, 0.62, 0.36}}, {"fracture", {0.85, 0.25, 0.17}}, {"released", {0.55, 0.57, 0.62}}};
  for (const EnergyBudget::Entry& sink : budget.sinks)
    for (const auto& [name, colour] : kColours)
      if (sink.name == name) add(sink.value, name, {colour, 1.5, {}});
  const Vec2 size(560, 360);
  return draw_page(stem, size, [&](Canvas& canvas) { draw_chart(canvas, {Vec2(0, 8), size}, chart); });
}

}  // namespace lamella
