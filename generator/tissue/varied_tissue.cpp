#include "generator/tissue/varied_tissue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/packing/domain.h"
#include "generator/packing/packing.h"
#include "generator/packing/stretch.h"
#include "generator/packing/variation.h"
#include "generator/packing/weld.h"
#include "generator/sample/errors.h"
#include "generator/tissue/cell_areas.h"
#include "generator/tissue/domain_tissue.h"
#include "generator/tissue/packed_tiles.h"

namespace lamella {
namespace {

/// Coincidences are decided at 1e-9 cell sizes: edges that they leave are shorter than this share of the mean wall.
constexpr double kLeastWeld = 1e-6;

/// The box of the scene, or of its domain.
Domain asked_domain(const SampleScene& sample) {
  if (sample.domain) return make_domain(*sample.domain);
  if (!(sample.width > 0 && sample.height > 0))
    throw SceneError("sample.stretch: needs width and height, or a domain: the box does not follow from the disks");
  return make_domain(as_domain({Vec2::Zero(), {sample.width, sample.height}}));
}

std::vector<double> areas_of(const DomainTissue& tissue) {
  std::vector<double> areas;
  for (const MosaicCell& cell : tissue.mosaic.cells) areas.push_back(polygon_area(polygon_of(tissue.mosaic, cell)));
  return areas;
}

void draw_out(DomainTissue& tissue, const Eigen::Matrix2d& map, const Box& box) {
  for (Vec2& v : tissue.mosaic.vertices) v = map * v;
  tissue.mosaic.box = box;
}

}  // namespace

Mosaic make_domain_mosaic(const Scene& scene, Notes& notes, const TissueProgress& progress, Origin& origin) {
  const SampleScene& asked = scene.sample;
  if (asked.periodic != "none") throw SceneError("sample.periodic: not with a domain or a stretch, whose cells end");
  const Domain domain = asked_domain(asked);
  const Eigen::Matrix2d map = asked.stretch ? stretch_map(*asked.stretch) : Eigen::Matrix2d::Identity();
  Scene filled = scene;
  if (asked.stretch) filled.sample.domain = squeezed(domain, map);
  filled.sample.width = filled.sample.height = 0;
  const Domain squeezed_domain = asked.stretch ? make_domain(*filled.sample.domain) : domain;
  const PositionFactor factor = size_factor(asked, domain.box);
  PositionFactor squeezed_factor;
  if (factor) squeezed_factor = [&](const Vec2& p) { return factor(map * p); };
  Packing& packing = origin.packing = make_packing(
      filled,
      [&](double done, const std::string& what) {
        if (progress) progress(0.7 * done, what);
      },
      squeezed_factor);
  notes.insert(notes.end(), packing.notes.begin(), packing.notes.end());
  vary_disks(packing, asked, domain.box, map, notes);
  if (progress) progress(0.7, "tessellation");
  const LaguerreOptions options = laguerre_options(asked.packing);
  Tessellation tiles;
  if (asked.areas) {
    CellAreas exact =
        tessellate_with_areas(packing, *asked.areas, squeezed_domain, notes, [&](double done, const std::string& what) {
          if (progress) progress(0.7 + 0.1 * done, what);
        });
    if (!asked.stretch) origin.sites = exact.sites();
    origin.asked = exact.shares;
    tiles = std::move(exact.tessellation);
  } else {
    tiles = tessellate_packing(packing.disks, box_around(squeezed_domain.loops, packing.disks), options, notes,
                               packing.number);
    if (!asked.stretch) origin.sites = packing.disks;
    const double threshold = std::max(asked.walls.weld, 1e-9) * mean_edge_length(tiles);
    origin.welded = weld_short_edges(tiles, threshold);
    if (origin.welded > 0)
      notes.push_back(fmt::format("{} edges of at most {:.3g} m welded to a point, inside the domain or beside it",
                                  origin.welded, threshold));
  }
  DomainTissue tissue = clip_tiles(tiles, squeezed_domain.loops, options, notes, domain.keys);
  draw_out(tissue, map, domain.box);
  const auto before = areas_of(tissue);
  origin.hidden = static_cast<Index>(tiles.hidden.size());
  const int welded = weld_short_edges(tissue, std::max(asked.walls.weld, kLeastWeld) * mean_wall_length(tissue), notes);
  origin.welded += welded;
  if (asked.areas) note_welded_areas(before, areas_of(tissue), welded, notes);
  mark_outer_sides(tissue);
  take_from_disks(packing, tissue.site, tissue.mosaic);
  return std::move(tissue.mosaic);
}

void vary_disks(Packing& packing, const SampleScene& scene, const Box& box, const Eigen::Matrix2d& map, Notes& notes) {
  PositionFactor thickness;
  if (scene.gradient) thickness = gradient_factor(*scene.gradient, scene.gradient->thickness, "thickness", box);
  if (!thickness && scene.layers.empty()) return;
  if (packing.group.empty()) packing.group.assign(packing.disks.size(), "cells");
  std::vector<Index> held(scene.layers.size(), 0);
  for (std::size_t i = 0; i < packing.disks.size(); ++i) {
    const Vec2 at = map * packing.disks[i].centre;
    if (thickness) packing.thickness.push_back(thickness(at));
    const int layer = layer_at(scene.layers, box, at);
    if (layer < 0) continue;
    ++held[layer];
    if (scene.layers[layer].group != "cells") packing.group[i] = scene.layers[layer].group;
  }
  for (std::size_t k = 0; k < held.size(); ++k)
    if (held[k] == 0)
      notes.push_back(fmt::format(
          "sample.layers: layer {} (group \"{}\") holds the centre of no disk: {}", k, scene.layers[k].group,
          k + 1 < held.size() ? "it lies elsewhere, is thinner than a cell, or later layers cover it"
                              : "it lies elsewhere, or is thinner than a cell"));
}

void take_from_disks(const Packing& packing, const std::vector<Index>& site, Mosaic& mosaic) {
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c) {
    if (!packing.group.empty()) mosaic.cells[c].group = packing.group[site[c]];
    if (!packing.thickness.empty()) mosaic.cells[c].thickness = packing.thickness[site[c]];
    if (packing.number.empty()) continue;
    mosaic.cells[c].number = packing.number[site[c]];
    mosaic.cells[c].name = fmt::format("site {}", packing.number[site[c]]);
  }
}

std::vector<double> inset_distances(const Packing& packing, const Scene& scene) {
  std::vector<double> distance;
  for (std::size_t i = 0; i < packing.disks.size(); ++i) {
    const std::string group = packing.group.empty() ? "cells" : packing.group[i];
    const double factor = packing.thickness.empty() ? 1 : packing.thickness[i];
    distance.push_back(factor * scene.stages.front().cell(group).outline_radius() + scene.sample.walls.gap / 2);
  }
  return distance;
}

void vary_links(Sample& sample, const SampleScene& scene) {
  if (!sample.cell_thickness.empty()) sample.cell_thickness.resize(sample.cells(), 1);
  if (!scene.gradient) return;
  const PositionFactor strength = gradient_factor(*scene.gradient, scene.gradient->strength, "strength", sample.box);
  if (!strength) return;
  for (std::size_t l = 0; l < sample.links.size(); ++l) {
    Vec2 b = sample.x[sample.links[l].b];
    if (!sample.link_image.empty()) b += displacement(sample.link_image[l], sample.box);
    sample.link_strength.push_back(strength((sample.x[sample.links[l].a] + b) / 2));
  }
}

}  // namespace lamella
