#include "postproc/drawing/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "generator/sample/errors.h"
#include "postproc/output_file.h"

namespace lamella {
namespace {

cairo_t* handle(void* cairo) { return static_cast<cairo_t*>(cairo); }

void set_colour(cairo_t* cairo, const Colour& c) { cairo_set_source_rgba(cairo, c.red, c.green, c.blue, c.alpha); }

void set_style(cairo_t* cairo, const Style& style) {
  set_colour(cairo, style.colour);
  cairo_set_line_width(cairo, style.width);
  cairo_set_dash(cairo, style.dashes.data(), static_cast<int>(style.dashes.size()), 0);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
}

void trace(cairo_t* cairo, const std::vector<Vec2>& points) {
  cairo_new_path(cairo);
  for (const Vec2& p : points) cairo_line_to(cairo, p.x(), p.y());
}

void set_font(cairo_t* cairo, const TextStyle& style) {
  cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.weight == Weight::kBold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, style.size);
}

/// Piecewise linear between equally spaced 8-bit colours.
Colour from_table(std::span<const std::array<int, 3>> table, double value) {
  const double at = std::clamp(value, 0.0, 1.0) * static_cast<double>(table.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), table.size() - 2);
  const auto colour = [&](std::size_t i) {
    return Colour{table[i][0] / 255.0, table[i][1] / 255.0, table[i][2] / 255.0};
  };
  return mix(colour(k), colour(k + 1), at - static_cast<double>(k));
}

using SurfaceHandle = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using CairoHandle = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void check(cairo_status_t status, const std::filesystem::path& path) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw DataError(path.string() + ": cannot be written: " + cairo_status_to_string(status));
}

}  // namespace

Colour mix(const Colour& a, const Colour& b, double s) {
  return {a.red + s * (b.red - a.red), a.green + s * (b.green - a.green), a.blue + s * (b.blue - a.blue),
          a.alpha + s * (b.alpha - a.alpha)};
}

Colour viridis(double value) {
  static constexpr std::array<std::array<int, 3>, 9> kTable{{{68, 1, 84},
                                                             {71, 44, 122},
                                                             {59, 81, 139},
                                                             {44, 113, 142},
                                                             {33, 144, 141},
                                                             {39, 173, 129},
                                                             {92, 200, 99},
                                                             {170, 220, 50},
                                                             {253, 231, 37}}};
  return from_table(kTable, value);
}

Colour embers(double value) {
  static constexpr std::array<std::array<int, 3>, 5> kTable{
      {{250, 196, 76}, {246, 142, 52}, {225, 86, 42}, {176, 38, 46}, {98, 14, 44}}};
  return from_table(kTable, value);
}

void Canvas::polygon(const std::vector<Vec2>& points, const Colour& fill) {
  cairo_t* cairo = handle(cairo_);
  trace(cairo, points);
  cairo_close_path(cairo);
  set_colour(cairo, fill);
  cairo_fill(cairo);
}

void Canvas::outline(const std::vector<Vec2>& points, const Style& style) {
  cairo_t* cairo = handle(cairo_);
  set_style(cairo, style);
  trace(cairo, points);
  cairo_close_path(cairo);
  cairo_stroke(cairo);
}

void Canvas::line(const std::vector<Vec2>& points, const Style& style) {
  cairo_t* cairo = handle(cairo_);
  set_style(cairo, style);
  trace(cairo, points);
  cairo_stroke(cairo);
}

void Canvas::rectangle(const Box& box, const Colour& fill) {
  cairo_t* cairo = handle(cairo_);
  set_colour(cairo, fill);
  cairo_rectangle(cairo, box.lo.x(), box.lo.y(), box.size().x(), box.size().y());
  cairo_fill(cairo);
}

void Canvas::dot(const Vec2& centre, double radius, const Colour& fill) {
  cairo_t* cairo = handle(cairo_);
  set_colour(cairo, fill);
  cairo_new_path(cairo);
  cairo_arc(cairo, centre.x(), centre.y(), radius, 0, 2 * M_PI);
  cairo_fill(cairo);
}

void Canvas::arrow(const Vec2& from, const Vec2& to, const Style& style) {
  const Vec2 along = (to - from).normalized(), side = left_of(along);
  const double head = 4.5 * style.width;
  line({from, to - 0.8 * head * along}, style);
  polygon({to, to - head * along + 0.45 * head * side, to - head * along - 0.45 * head * side}, style.colour);
}

void Canvas::text(const Vec2& at, const std::string& words, const TextStyle& style) {
  cairo_t* cairo = handle(cairo_);
  const double width = text_width(words, style);
  const double shift = style.anchor == Anchor::kLeft ? 0 : style.anchor == Anchor::kCentre ? -0.5 * width : -width;
  cairo_save(cairo);
  set_font(cairo, style);
  set_colour(cairo, style.colour);
  cairo_translate(cairo, at.x(), at.y());
  cairo_rotate(cairo, style.angle);
  cairo_move_to(cairo, shift, 0);
  cairo_show_text(cairo, words.c_str());
  cairo_restore(cairo);
  cairo_new_path(cairo);
}

double Canvas::text_width(const std::string& words, const TextStyle& style) {
  cairo_t* cairo = handle(cairo_);
  set_font(cairo, style);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, words.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::clipped(const Box& box, const std::function<void()>& draw) {
  cairo_t* cairo = handle(cairo_);
  cairo_save(cairo);
  cairo_rectangle(cairo, box.lo.x(), box.lo.y(), box.size().x(), box.size().y());
  cairo_clip(cairo);
  draw();
  cairo_restore(cairo);
}

void draw_file(const std::filesystem::path& path, const Vec2& size, const std::function<void(Canvas&)>& draw) {
  constexpr double kPixelsPerPoint = 2;
  const std::string ending = path.extension().string();
  if (ending != ".png" && ending != ".pdf" && ending != ".svg")
    throw DataError(path.string() + ": no picture; must end in .png, .pdf or .svg");
  replace_output(path, [&](const std::filesystem::path& temporary) {
    const bool pixels = ending == ".png";
    const double scale = pixels ? kPixelsPerPoint : 1;
    const SurfaceHandle surface(
        pixels ? cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(scale * size.x())),
                                            static_cast<int>(std::lround(scale * size.y())))
        : ending == ".pdf" ? cairo_pdf_surface_create(temporary.c_str(), size.x(), size.y())
                           : cairo_svg_surface_create(temporary.c_str(), size.x(), size.y()),
        cairo_surface_destroy);
    check(cairo_surface_status(surface.get()), path);
    {
      const CairoHandle cairo(cairo_create(surface.get()), cairo_destroy);
      cairo_scale(cairo.get(), scale, scale);
      cairo_set_source_rgb(cairo.get(), 1, 1, 1);
      cairo_paint(cairo.get());
      Canvas canvas(cairo.get());
      draw(canvas);
      check(cairo_status(cairo.get()), path);
    }
    if (pixels) return check(cairo_surface_write_to_png(surface.get(), temporary.c_str()), path);
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()), path);
  });
}

std::vector<std::filesystem::path> draw_page(const std::filesystem::path& stem, const Vec2& size,
                                             const std::function<void(Canvas&)>& draw) {
  std::filesystem::path png = stem, pdf = stem;
  png += ".png", pdf += ".pdf";
  draw_file(png, size, draw);
  draw_file(pdf, size, draw);
  return {png, pdf};
}

}  // namespace lamella
