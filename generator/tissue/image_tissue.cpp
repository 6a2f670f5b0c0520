#include "generator/tissue/image_tissue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/image/boundaries.h"
#include "generator/image/labels.h"
#include "generator/image/regions.h"
#include "generator/image/segment.h"
#include "generator/sample/errors.h"
#include "generator/tissue/image_laguerre.h"
#include "generator/tissue/inset.h"
#include "generator/tissue/outlines.h"
#include "generator/tissue/picture_walls.h"

namespace lamella {
namespace {

/// A background line is closed where no square of this many pixels a side fits into it.
constexpr int kThinGap = 4;

std::string listed_labels(const std::vector<std::uint32_t>& numbers) {
  std::vector<std::string> names;
  for (const std::uint32_t number : numbers) names.push_back(fmt::format("label {}", number));
  return listed(names);
}

void note(const Cleaning& done, Notes& notes) {
  if (!done.scattered.empty())
    notes.push_back(
        fmt::format("{} cells are in several pieces: the largest stays, {} others are joined to what they "
                    "touch most: {}",
                    done.scattered.size(), done.pieces, listed_labels(done.scattered)));
  if (!done.small.empty())
    notes.push_back(fmt::format("{} cells are smaller than least_area and joined to what they touch most: {}",
                                done.small.size(), listed_labels(done.small)));
  if (done.small_gaps > 0)
    notes.push_back(fmt::format("{} places without cell are smaller than least_area and joined to what they touch most",
                                done.small_gaps));
  if (!done.filled.empty())
    notes.push_back(
        fmt::format("{} cells have holes, which are filled: {}", done.filled.size(), listed_labels(done.filled)));
  if (!done.enclosed.empty())
    notes.push_back(fmt::format("{} cells lie inside another and are part of it now: {}", done.enclosed.size(),
                                listed_labels(done.enclosed)));
  if (done.pinches > 0)
    notes.push_back(fmt::format("{} corners at which a cell touches itself are opened", done.pinches));
}

/// A micrograph that is read as labels, or labels that a lossy format has spoilt, have pieces of one label everywhere.
void refuse_scattered(const LabelImage& labels, const std::string& file) {
  const Regions regions = regions_of(labels);
  std::vector<Index> largest(labels.number.size(), 0);
  double all = 0, kept = 0;
  std::size_t pieces = 0;
  for (std::size_t r = 0; r < regions.cell.size(); ++r) {
    if (regions.cell[r] == kBackground) continue;
    ++pieces;
    all += regions.area[r];
    largest[regions.cell[r]] = std::max(largest[regions.cell[r]], regions.area[r]);
  }
  for (const Index area : largest) kept += area;
  if (kept < all / 2)
    throw SceneError(
        fmt::format("{}: {} numbers are in {} pieces, the largest of which hold {:.0f} % of the pixels: "
                    "these are no cells; for a micrograph give sample.image.kind = \"grey\"",
                    file, labels.number.size(), pieces, 100 * kept / all));
}

LabelImage read_labels(const ImageScene& image, const std::string& file, const Picture& picture, Notes& notes) {
  bool pieces = false;
  LabelImage labels = labels_of(picture, static_cast<std::uint32_t>(image.background), pieces);
  if (labels.number.empty())
    throw SceneError(
        fmt::format("{}: no cells: all pixels are {}, the background; give sample.image.background the "
                    "number of what is no cell",
                    file, image.background));
  if (pieces)
    notes.push_back(
        fmt::format("the picture holds one number beside the background: each of its {} connected pieces "
                    "is a cell",
                    labels.number.size()));
  refuse_scattered(labels, file);
  const std::size_t closed = close_gaps(labels, kThinGap);
  if (closed > 0)
    notes.push_back(
        fmt::format("{} pixels of background, in gaps that no square of {} pixels fits into, are given to "
                    "the nearest cells",
                    closed, kThinGap));
  return labels;
}

LabelImage find_cells(const ImageScene& image, const std::string& file, const Picture& picture, Notes& notes) {
  Segmenting how;
  how.dark_walls = image.walls == "dark";
  how.threshold = image.threshold;
  how.smoothing = image.smoothing;
  how.least_area = image.least_area;
  Segmentation found = segment(picture, how);
  if (found.labels.number.empty())
    throw SceneError(
        fmt::format("{}: no cells: no pixel is {} than the threshold of {:.3g}; choose sample.image.threshold or walls",
                    file, how.dark_walls ? "brighter" : "darker", found.threshold));
  notes.push_back(fmt::format("walls are {} than {:.3g} of white{}", how.dark_walls ? "darker" : "brighter",
                              found.threshold, image.threshold ? "" : " (Otsu's threshold)"));
  if (found.walls > 0)
    notes.push_back(
        fmt::format("{} walls are {:.2f} +- {:.2f} pixels thick (mean, standard deviation): for [cells] "
                    "thickness, {:.3g} m if a cell's wall is half of the wall between two cells",
                    found.walls, found.thickness, found.deviation, found.thickness * image.pixel / 2));
  return std::move(found.labels);
}

std::uint8_t side_of(Index beyond) {
  switch (beyond) {
    case kBeyondLeft:
      return kLeft;
    case kBeyondRight:
      return kRight;
    case kBeyondBottom:
      return kBottom;
    case kBeyondTop:
      return kTop;
    default:
      return 0;
  }
}

/// Sides that no cell touches go to the free walls that look at them from the outermost cells.
void mark_untouched_sides(Mosaic& mosaic) {
  std::uint8_t touched = 0;
  std::vector<std::vector<std::uint8_t>> exact;
  for (const MosaicCell& cell : mosaic.cells) {
    for (const std::uint8_t side : cell.side) touched |= side;
    exact.push_back(cell.side);
  }
  if (touched == (kLeft | kRight | kBottom | kTop)) return;
  const Box picture = mosaic.box;
  mosaic.box = {picture.hi, picture.lo};
  for (const MosaicCell& cell : mosaic.cells)
    for (const Index v : cell.vertex) {
      mosaic.box.lo = mosaic.box.lo.cwiseMin(mosaic.vertices[v]);
      mosaic.box.hi = mosaic.box.hi.cwiseMax(mosaic.vertices[v]);
    }
  mark_rough_sides(mosaic);
  mosaic.box = picture;
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c)
    for (std::size_t k = 0; k < exact[c].size(); ++k) {
      auto& side = mosaic.cells[c].side[k];
      side = static_cast<std::uint8_t>((side & ~touched) | exact[c][k]);
    }
}

/// Sides; and names that can be found in the picture.
void finish(Mosaic& mosaic, double pixel) {
  mark_untouched_sides(mosaic);
  for (MosaicCell& cell : mosaic.cells) {
    const Vec2 centre = polygon_centre(polygon_of(mosaic, cell));
    cell.name += fmt::format(" (about pixel {:.0f}, {:.0f})", std::floor(centre.x() / pixel),
                             std::floor((mosaic.box.hi.y() - centre.y()) / pixel));
  }
}

Mosaic mosaic_of(const SimplifiedWalls& walls, const LabelImage& labels, double pixel) {
  Mosaic mosaic;
  mosaic.box = {Vec2::Zero(), pixel * Vec2(labels.width, labels.height)};
  for (const Lattice& p : walls.vertices) mosaic.vertices.emplace_back(pixel * p.x, pixel * (labels.height - p.y));
  for (std::size_t c = 0; c < walls.cells.size(); ++c) {
    MosaicCell cell;
    cell.vertex = walls.cells[c].vertex;
    for (const Index beyond : walls.cells[c].beyond) cell.side.push_back(side_of(beyond));
    cell.name = fmt::format("label {}", labels.number[c]);
    cell.number = labels.number[c];
    mosaic.cells.push_back(std::move(cell));
  }
  return mosaic;
}

}  // namespace

bool has_narrow_cells(const Mosaic& mosaic, const Scene& scene) {
  const double distance = scene.stages.front().cell("cells").outline_radius() + scene.sample.walls.gap / 2;
  return std::any_of(mosaic.cells.begin(), mosaic.cells.end(), [&](const MosaicCell& cell) {
    return inset_polygon(polygon_of(mosaic, cell), distance).outcome != Inset::Outcome::whole;
  });
}

Mosaic make_image_mosaic(const Scene& scene, Notes& notes, Origin& origin, const ImageProgress& progress) {
  const ImageScene& image = *scene.sample.image;
  const auto tell = [&](double done, const char* what) {
    if (progress) progress(done, what);
  };
  const auto path = scene.resolve(image.file);
  const bool grey = image.kind == "grey";
  tell(0, "picture");
  const Picture picture = read_picture(path, grey ? Colours::kToGrey : Colours::kRefuse);
  tell(0.2, grey ? "segmentation" : "labels");
  LabelImage labels =
      grey ? find_cells(image, path.string(), picture, notes) : read_labels(image, path.string(), picture, notes);
  tell(0.5, "cells");
  note(clean_labels(labels, image.least_area), notes);
  if (labels.number.empty())
    throw SceneError(fmt::format("{}: no cells are left that have at least sample.image.least_area = {} pixels",
                                 path.string(), image.least_area));
  notes.push_back(fmt::format("{} x {} pixels: {} cells", labels.width, labels.height, labels.number.size()));
  Mosaic mosaic;
  if (image.cells == "laguerre") {
    mosaic = make_laguerre_mosaic(labels, image.pixel, scene.sample.walls.weld, notes, origin,
                                  [&](double done) { tell(0.6 + 0.4 * done, "Laguerre tessellation"); });
    finish(mosaic, image.pixel);
    return mosaic;
  }
  tell(0.7, "boundaries");
  const SimplifiedWalls walls = simplify_walls(trace_boundaries(labels), image.simplify, scene.sample.walls.weld);
  origin.welded = walls.welded;
  if (walls.welded > 0) notes.push_back(fmt::format("{} short walls are welded to a point", walls.welded));
  if (walls.refined > 0)
    notes.push_back(fmt::format("{} walls keep more of their pixels than simplify asks, so that cells do not overlap",
                                walls.refined));
  mosaic = mosaic_of(walls, labels, image.pixel);
  finish(mosaic, image.pixel);
  return mosaic;
}

}  // namespace lamella
