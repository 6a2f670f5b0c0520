#include "generator/tissue/image_laguerre.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/image/laguerre_fit.h"
#include "generator/packing/weld.h"
#include "generator/sample/errors.h"
#include "generator/tissue/lattice.h"
#include "generator/tissue/outlines.h"

namespace lamella {

double agreement(const Tessellation& tessellation, const LabelImage& labels, Index cells) {
  std::int64_t agreeing = 0;
  for (const Tile& tile : tessellation.tiles) {
    double low = labels.height, high = 0;
    for (const Index v : tile.vertex) {
      low = std::min(low, tessellation.vertices[v].y());
      high = std::max(high, tessellation.vertices[v].y());
    }
    // Rows whose line of pixel centres, at height - row - 0.5, passes the tile; convex, so in one interval.
    const int first = std::max(0, static_cast<int>(std::ceil(labels.height - high - 0.5)));
    const int last = std::min(labels.height - 1, static_cast<int>(std::floor(labels.height - low - 0.5)));
    for (int row = first; row <= last; ++row) {
      const double y = labels.height - row - 0.5;
      double left = labels.width, right = 0;
      for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
        const Vec2& a = tessellation.vertices[tile.vertex[k]];
        const Vec2& b = tessellation.vertices[tile.vertex[(k + 1) % tile.vertex.size()]];
        if ((a.y() <= y) == (b.y() <= y)) continue;
        const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
        left = std::min(left, x);
        right = std::max(right, x);
      }
      const int end = std::min(labels.width, static_cast<int>(std::ceil(right - 0.5)));
      for (int x = std::max(0, static_cast<int>(std::ceil(left - 0.5))); x < end; ++x) {
        const Index cell = labels.cell[labels.at(x, row)];
        agreeing += cell == tile.site || (cell >= cells && tile.site >= cells);
      }
    }
  }
  return static_cast<double>(agreeing) / static_cast<double>(labels.pixels());
}

namespace {

void note_fit(const LaguerreFit& fit, const Tessellation& tessellation, const LabelImage& labels, Index cells,
              Notes& notes) {
  notes.push_back(
      fmt::format("the closest Laguerre tessellation: {:.2f} % of the pixels lie in the tile of their cell; "
                  "walls are {:.2f} pixels from the boundary of the pixels (root mean square)",
                  100 * agreement(tessellation, labels, cells), fit.rms));
  std::vector<std::string> lost;
  for (const Index site : tessellation.hidden)
    if (site < cells) lost.push_back(fmt::format("label {}", labels.number[site]));
  if (!lost.empty()) notes.push_back(fmt::format("{} cells have no tile in it: {}", lost.size(), listed(lost)));
}

}  // namespace

Mosaic make_laguerre_mosaic(LabelImage labels, double pixel, double weld, Notes& notes, Origin& origin,
                            const std::function<void(double)>& progress) {
  const Index cells = part_background(labels);
  const LaguerreFit fit = fit_laguerre(labels, progress);
  const Box picture{Vec2::Zero(), Vec2(labels.width, labels.height)};
  Tessellation tessellation = tessellate(fit.disks, picture, {Duplicates::kKeepFirst, Hidden::kReport});
  note_fit(fit, tessellation, labels, cells, notes);
  tessellation.box.hi *= pixel;
  for (Vec2& vertex : tessellation.vertices) vertex *= pixel;
  origin.welded = weld_short_edges(tessellation, std::max(weld, 1e-9) * mean_edge_length(tessellation), &notes);
  Mosaic mosaic = mosaic_of(tessellation);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < tessellation.tiles.size() && tessellation.tiles[t].site < cells; ++t, ++kept) {
    mosaic.cells[t].number = labels.number[tessellation.tiles[t].site];
    mosaic.cells[t].name = fmt::format("label {}", mosaic.cells[t].number);
  }
  mosaic.cells.resize(kept);
  return mosaic;
}

}  // namespace lamella
