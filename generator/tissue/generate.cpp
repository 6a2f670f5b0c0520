// The generator's front door: which scene makes which sample.
#include "generator/generate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "generator/packing/laguerre.h"
#include "generator/packing/packing.h"
#include "generator/packing/stretch.h"
#include "generator/packing/variation.h"
#include "generator/packing/weld.h"
#include "generator/sample/errors.h"
#include "generator/sample/scene_place.h"
#include "generator/tissue/bricks.h"
#include "generator/tissue/cell_areas.h"
#include "generator/tissue/check_tiles.h"
#include "generator/tissue/image_tissue.h"
#include "generator/tissue/lattice.h"
#include "generator/tissue/missing_links.h"
#include "generator/tissue/notch.h"
#include "generator/tissue/packed_tiles.h"
#include "generator/tissue/polygon_file.h"
#include "generator/tissue/polygons.h"
#include "generator/tissue/shapes.h"
#include "generator/tissue/varied_tissue.h"
#include "generator/tissue/walls.h"

namespace lamella {
namespace {

constexpr const char* kGroup = "cells";  // of the cells of a tissue

using Progress = std::function<void(double, const std::string&)>;

/// Inset, links and notch: what tiles, hexagons and imported polygons have in common. `mosaic` goes to the origin.
Sample make_tissue(Mosaic& mosaic, const Scene& scene, Notes& notes, Origin& origin) {
  if (scene.sample.notch && !scene.sample.notch->polygon.empty()) {
    const Index removed = remove_cells_inside(mosaic, scene.sample.notch->polygon);
    if (removed == 0) throw SceneError("sample.notch.polygon: no cell has its centre inside");
    if (mosaic.cells.empty()) throw SceneError("sample.notch.polygon: removes all cells");
    notes.push_back(fmt::format("the notch removes {} cells", removed));
  }
  order_by_rows(mosaic);
  const auto radius = [&](const std::string& group) { return scene.stages.front().cell(group).outline_radius(); };
  Sample sample = make_tissue(mosaic, scene.sample.walls, radius, notes);
  origin.tiles = std::move(mosaic);
  return sample;
}

/// What is filled with cells that are round on average, before it is drawn out along its axes.
Scene squeezed(Scene scene, const Vec2& drawn) {
  scene.sample.width /= drawn.x();
  scene.sample.height /= drawn.y();
  return scene;
}

Mosaic make_packed_mosaic(const Scene& scene, Notes& notes, const Progress& progress, Origin& origin) {
  const auto& stretch = scene.sample.stretch;
  if (scene.sample.domain || (stretch && scene.sample.periodic == "none"))
    return make_domain_mosaic(scene, notes, progress, origin);
  const Periodic periodic = periodic_of(scene.sample);
  const Box asked{Vec2::Zero(), {scene.sample.width, scene.sample.height}};
  const Vec2 drawn = stretch ? stretch_of_axes(*stretch) : Vec2::Ones();
  PositionFactor factor = size_factor(scene.sample, asked);
  if (factor && stretch) factor = [=, whole = factor](const Vec2& p) { return whole(p.cwiseProduct(drawn)); };
  Packing& packing = origin.packing = make_packing(
      stretch ? squeezed(scene, drawn) : scene,
      [&](double done, const std::string& what) {
        if (progress) progress(0.7 * done, what);
      },
      factor);
  notes.insert(notes.end(), packing.notes.begin(), packing.notes.end());
  vary_disks(packing, scene.sample, stretch ? asked : packing.box, drawn.asDiagonal(), notes);
  if (progress) progress(0.7, "tessellation");
  std::optional<CellAreas> exact;
  if (scene.sample.areas)
    exact = tessellate_with_areas(packing, *scene.sample.areas, periodic, inset_distances(packing, scene), notes,
                                  [&](double done, const std::string& what) {
                                    if (progress) progress(0.7 + 0.1 * done, what);
                                  });
  Tessellation tessellation =
      exact ? exact->tessellation
            : tessellate_packing(packing.disks, packing.box, laguerre_options(scene.sample.packing, periodic), notes,
                                 packing.number);
  if (exact) origin.asked = exact->shares;
  if (!stretch) origin.sites = exact ? exact->sites() : packing.disks;
  if (stretch) {
    tessellation.box = asked;
    for (Vec2& vertex : tessellation.vertices) vertex = vertex.cwiseProduct(drawn);
  }
  // Cocircular sites leave edges without length, which no wall can be made of: those are welded whatever is asked.
  const double share = std::max(scene.sample.walls.weld, 1e-9);
  origin.welded = weld_short_edges(tessellation, share * mean_edge_length(tessellation), &notes);
  origin.hidden = static_cast<Index>(tessellation.hidden.size());
  if (exact) note_welded_areas(*exact, tessellation, origin.welded, notes);
  Mosaic mosaic = mosaic_of(tessellation);
  std::vector<Index> site;
  for (const Tile& tile : tessellation.tiles) site.push_back(tile.site);
  take_from_disks(packing, site, mosaic);
  return mosaic;
}

Sample make_packed_tissue(const Scene& scene, Notes& notes, const Progress& progress, Origin& origin) {
  Mosaic mosaic = make_packed_mosaic(scene, notes, progress, origin);
  if (progress) progress(0.8, "walls");
  Sample sample = make_tissue(mosaic, scene, notes, origin);
  if (scene.sample.areas && scene.sample.areas->of == "inset")
    note_enclosed_areas(origin.tiles, scene.sample.walls.gap, sample, notes);
  return sample;
}

Sample make_packed_rings(const Scene& scene, Notes& notes, const Progress& progress, Origin& origin) {
  const Packing& packing = origin.packing = make_packing(scene, progress);
  notes.insert(notes.end(), packing.notes.begin(), packing.notes.end());
  std::vector<double> areas(packing.disks.size(), 0);
  if (packing.periodic[0] || packing.periodic[1]) {
    notes.push_back("the packing is periodic, the sample is not: rings cross the sides of the box");
    // A disk across a side has no whole tile in the box: gaps are shared out in proportion.
    for (std::size_t i = 0; i < areas.size(); ++i)
      areas[i] = std::numbers::pi * packing.disks[i].radius * packing.disks[i].radius / packing.fraction;
  } else {
    const Tessellation tessellation =
        tessellate_packing(packing.disks, packing.box, laguerre_options(scene.sample.packing), notes);
    for (const Tile& tile : tessellation.tiles) areas[tile.site] = tile_area(tessellation, tile);
  }
  return make_rings(packing, scene.sample.ring_nodes, scene.stages.front().cell(kGroup).outline_radius(), kGroup,
                    areas);
}

Sample make_imported_tissue(const Scene& scene, Notes& notes, Origin& origin) {
  const auto path = scene.resolve(scene.sample.file);
  const auto polygons = read_polygons(path, scene.sample.scale, notes);
  if (scene.sample.outlines == "separate") {
    if (scene.sample.notch && !scene.sample.notch->polygon.empty())
      throw SceneError(
          "sample.notch.polygon: only with outlines = \"shared\"; leave the cells out of the file instead");
    return make_separate_tissue(polygons, scene.sample, path.string(),
                                scene.stages.front().cell(kGroup).outline_radius(), kGroup, notes);
  }
  Mosaic mosaic = share_walls(polygons, scene.sample, path.string());
  return make_tissue(mosaic, scene, notes, origin);
}

Sample make_pictured_tissue(const Scene& scene, Notes& notes, const Progress& progress, Origin& origin) {
  Mosaic mosaic = make_image_mosaic(scene, notes, origin, [&](double done, const std::string& what) {
    if (progress) progress(0.8 * done, what);
  });
  try {
    return make_tissue(mosaic, scene, notes, origin);
  } catch (const SceneError& error) {
    if (!has_narrow_cells(mosaic, scene)) throw;
    auto faults = error.faults();
    faults.emplace_back(kNarrowCellsOfPictures);
    throw SceneError(faults);
  }
}

/// A box for shapes that were given none: what encloses their outlines.
Box enclosing_box(const Sample& sample) {
  Box box{sample.x.front(), sample.x.front()};
  for (Index c = 0; c < sample.cells(); ++c)
    for (Index k = sample.cell_begin[c]; k < sample.cell_begin[c + 1]; ++k) {
      const Vec2 reach = Vec2::Constant(sample.radius[c]);
      box.lo = box.lo.cwiseMin(sample.x[k] - reach);
      box.hi = box.hi.cwiseMax(sample.x[k] + reach);
    }
  return box;
}

void check(const Sample& sample, const SampleScene& asked, const Mosaic& tiles) {
  const Filled filled = filled_by(asked, sample.box);
  auto violations = check_sample(sample, asked.shapes.empty() ? filled.area : 0);
  if (!tiles.cells.empty())
    for (std::string& fault : check_tiles(tiles, filled)) violations.push_back(std::move(fault));
  if (violations.empty()) return;
  violations.insert(violations.begin(), fmt::format("sample: the {} that the scene asks for is not sound", asked.kind));
  throw SceneError(violations);
}

Sample generated(const Scene& scene, Notes& notes, const Progress& progress, Origin& from) {
  const SampleScene& asked = scene.sample;
  Sample sample;
  if (asked.kind == "tissue") {
    sample = make_packed_tissue(scene, notes, progress, from);
  } else if (asked.kind == "rings") {
    sample = make_packed_rings(scene, notes, progress, from);
  } else if (asked.kind == "honeycomb") {
    Mosaic mosaic = make_honeycomb(asked);
    sample = make_tissue(mosaic, scene, notes, from);
  } else if (asked.kind == "bricks") {
    Mosaic mosaic = make_bricks(asked);
    sample = make_tissue(mosaic, scene, notes, from);
  } else if (asked.kind == "polygons") {
    sample = make_imported_tissue(scene, notes, from);
  } else if (asked.kind == "image") {
    sample = make_pictured_tissue(scene, notes, progress, from);
  } else if (asked.kind == "shapes") {
    if (asked.shapes.empty()) throw SceneError("sample: kind = \"shapes\" needs at least one [[sample.shapes]]");
    sample.cell_begin.push_back(0);
  } else {
    throw SceneError(fmt::format(
        "sample.kind: unknown kind \"{}\"; tissue, rings, honeycomb, bricks, polygons, image or shapes", asked.kind));
  }
  if (asked.notch && !asked.notch->line.empty()) cut_links(asked.notch->line, sample, notes);
  if (asked.walls.missing > 0) drop_links(asked.walls.missing, scene.seed, sample, notes);
  for (const ShapeScene& shape : asked.shapes)
    add_shape(
        shape, [&](const std::string& group) { return scene.stages.front().cell(group).outline_radius(); }, sample);
  if (asked.kind == "shapes") {
    sample.box = enclosing_box(sample);
    if (asked.width > 0 && asked.height > 0) sample.box = {Vec2::Zero(), Vec2(asked.width, asked.height)};
  }
  vary_links(sample, asked);
  sample.scene_text = scene.text;
  sample.seed = scene.seed;
  if (progress) progress(0.95, "check");
  check(sample, asked, from.tiles);
  if (progress) progress(1, "done");
  return sample;
}

}  // namespace

Sample generate(const Scene& scene, Notes& notes, const std::function<void(double, const std::string&)>& progress,
                Origin* origin) {
  Origin unasked;
  try {
    return generated(scene, notes, progress, origin ? *origin : unasked);
  } catch (const SceneError& error) {
    throw SceneError(with_places(scene, error.faults()));
  }
}

}  // namespace lamella
