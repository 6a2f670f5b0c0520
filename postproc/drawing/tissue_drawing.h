// A tissue on a page: cells, grips, scale bar, colour bar. Used by all pictures of cells.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "postproc/drawing/canvas.h"
#include "postproc/frame_view.h"
#include "postproc/quantities/material_constants.h"

namespace lamella {

/// From metres, y up, to points, y down; one scale for both, centred.
class PageMap {
 public:
  PageMap(const Box& world, const Box& page);
  Vec2 operator()(const Vec2& p) const {
    return {page_.x() + scale_ * (p.x() - world_.x()), page_.y() - scale_ * (p.y() - world_.y())};
  }
  double scale() const { return scale_; }  // [pt/m]
  double world_width() const { return world_width_; }

 private:
  Vec2 world_, page_;  // centres
  double scale_, world_width_;
};

/// What a picture of these frames must hold, grips included [m].
Box drawn_extent(const std::vector<const FrameView*>& views, const std::optional<TestSetup>& setup);

/// Cells filled with their colours, walls drawn with their true thickness 2 r (not thinner than is visible). Of opened cells the bars
/// that are left; they are not filled.
void draw_cells(Canvas& canvas, const PageMap& map, const FrameView& view, const std::function<Colour(Index)>& fill,
                const Colour& wall = {0.10, 0.11, 0.14});

/// Lines across the sample, drawn by `draw` with a displacement [m]: of a periodic sample in all images that reach the cells in the picture.
void draw_images(Canvas& canvas, const PageMap& map, const FrameView& view,
                 const std::function<void(const Vec2&)>& draw);

/// The stretch of the crack that a broken link stands for: along its wall, as long as its tributary length, on the page.
std::vector<Vec2> link_mark(const PageMap& map, const FrameView& view, Index link, const std::vector<Vec2>& x);

/// The stretch of the crack that a broken bar stands for: across its wall at rest, on the page.
std::vector<Vec2> bar_mark(const PageMap& map, const Sample& sample, Index cell, Index bar);

/// Bars at the gripped sides, with an arrow where the grip has moved.
void draw_grips(Canvas& canvas, const PageMap& map, const FrameView& view, const TestSetup& setup);

/// A bar of a round length; `corner` is its lower left.
void draw_scale_bar(Canvas& canvas, const PageMap& map, const Vec2& corner);

struct ColourBar {
  double low = 0, high = 1;
  bool open_end = false;  // values above are drawn in the last colour
  std::string label;
  Colour (*map)(double) = viridis;
};
void draw_colour_bar(Canvas& canvas, const Box& area, const ColourBar& bar);

}  // namespace lamella
