#include "generator/packing/laguerre.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

#include "generator/packing/plane_diagram.h"
#include "generator/packing/tile_maker.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

/// What the user calls a site.
using Naming = std::function<std::string(Index)>;

/// The first few faults in full, the rest as a number.
[[noreturn]] void refuse(std::vector<std::string> faults) {
  constexpr std::size_t kShown = 20;
  if (faults.size() > kShown) {
    const std::size_t more = faults.size() - kShown;
    faults.resize(kShown);
    faults.push_back(fmt::format("and {} more of this kind", more));
  }
  throw SceneError(std::move(faults));
}

void refuse_bad_box(const Box& box) {
  const Vec2 size = box.size();
  if (!(size.array() > 0).all() || !size.allFinite())
    throw SceneError(fmt::format("the box is {} x {} m: width and height must be positive", size.x(), size.y()));
  // Areas are squared in the predicates.
  if (!(size.minCoeff() > 1e-60 && size.maxCoeff() < 1e60))
    throw SceneError(fmt::format("the box is {} x {} m: from 1e-60 to 1e60 m are possible", size.x(), size.y()));
}

/// `boxes`: by how many box lengths a site may lie outside along a periodic axis.
void refuse_sites_outside(const std::vector<PowerSite>& sites, const Box& box, const Periodic& periodic, double boxes,
                          const Naming& name_of) {
  const Vec2 allowed(periodic[0] ? boxes * box.size().x() : 0, periodic[1] ? boxes * box.size().y() : 0);
  const Box all{box.lo - allowed, box.hi + allowed};
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < sites.size(); ++i)
    if (!all.contains(sites[i].centre))
      faults.push_back(fmt::format(
          "{} has its centre outside the box [{:.9g}, {:.9g}] x [{:.9g}, {:.9g}]: move it inside or enlarge the box",
          name_of(static_cast<Index>(i)), all.lo.x(), all.hi.x(), all.lo.y(), all.hi.y()));
  if (!faults.empty()) refuse(std::move(faults));
}

bool is_weight(double weight) { return std::abs(weight) < 1e120; }

std::vector<PowerSite> sites_of(const std::vector<Disk>& disks, const Naming& name_of) {
  std::vector<PowerSite> sites;
  std::vector<std::string> faults;
  sites.reserve(disks.size());
  for (const Disk& disk : disks) {
    sites.push_back({disk.centre, disk.radius * disk.radius});
    if (!disk.centre.allFinite() || !(disk.radius >= 0) || !is_weight(sites.back().weight))
      faults.push_back(name_of(static_cast<Index>(sites.size()) - 1) +
                       " is not a disk: coordinates must be finite and the radius not negative");
  }
  if (!faults.empty()) refuse(std::move(faults));
  return sites;
}

std::vector<PowerSite> sites_of(const std::vector<Vec2>& centres, const std::vector<double>& weights,
                                const Naming& name_of) {
  if (centres.size() != weights.size())
    throw SceneError(
        fmt::format("{} centres and {} weights: each site needs one of each", centres.size(), weights.size()));
  std::vector<PowerSite> sites;
  std::vector<std::string> faults;
  sites.reserve(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    sites.push_back({centres[i], weights[i]});
    if (!centres[i].allFinite() || !is_weight(weights[i]))
      faults.push_back(name_of(static_cast<Index>(i)) + " is no site: coordinates and weight must be finite");
  }
  if (!faults.empty()) refuse(std::move(faults));
  return sites;
}

Naming names_of(const std::vector<Disk>& disks) {
  return [&disks](Index i) {
    return fmt::format("disk {} (x = {:.9g}, y = {:.9g}, r = {:.9g})", i, disks[i].centre.x(), disks[i].centre.y(),
                       disks[i].radius);
  };
}

Naming names_of(const std::vector<Vec2>& centres, const std::vector<double>& weights) {
  return [&](Index i) {
    return fmt::format("disk {} (x = {:.9g}, y = {:.9g}, weight = {:.9g})", i, centres[i].x(), centres[i].y(),
                       weights[i]);
  };
}

/// Sites that are the same as one of lower index, and that one. They are hidden: the first of them has the cell, if any.
std::vector<std::pair<Index, Index>> duplicates(const PlaneDiagram& plane) {
  const auto key = [&](Index i) {
    return std::array{plane.site[i].centre.x(), plane.site[i].centre.y(), plane.site[i].weight};
  };
  std::map<std::array<double, 3>, Index> first;
  for (Index i = 0; i < plane.sites; ++i)
    if (plane.diagram.ring_begin[i] == plane.diagram.ring_end[i]) first.emplace(key(i), -1);
  std::vector<std::pair<Index, Index>> found;
  if (first.empty()) return found;
  for (Index i = 0; i < plane.sites; ++i) {
    const auto at = first.find(key(i));
    if (at == first.end()) continue;
    if (at->second < 0)
      at->second = i;
    else
      found.emplace_back(i, at->second);
  }
  return found;
}

template <class Visit>
void for_each_tile(const PlaneDiagram& plane, std::vector<Vec2>& vertices, Visit visit) {
  TileMaker maker(plane, vertices);
  Tile tile;
  bool none = true;
  for (const Index site : plane.diagram.order) {
    maker.make(site, tile);
    if (tile.vertex.empty()) continue;
    none = false;
    visit(tile);
  }
  if (none && maker.make_whole_box(tile)) visit(tile);
}

/// Tiles of the sites `kept`; returns those among them whose tile has an area that is rounding only, as when a side cuts a
/// tile off almost along a wall.
std::vector<Index> make_tiles(const PlaneDiagram& plane, const std::vector<Index>& kept, Tessellation& result) {
  result.tiles.assign(kept.size(), {});
  std::vector<Index> slivers;
  for_each_tile(plane, result.vertices, [&](const Tile& made) {
    Tile& tile = result.tiles[made.site];
    tile = made;
    tile.site = kept[made.site];
    for (Index& neighbour : tile.neighbour)
      if (neighbour >= 0) neighbour = kept[neighbour];
    if (tile_area(result, tile) <= 1e-15 * result.box.area()) slivers.push_back(tile.site);
  });
  std::erase_if(result.tiles, [](const Tile& tile) { return tile.vertex.empty(); });
  std::sort(slivers.begin(), slivers.end());
  return slivers;
}

std::vector<Index> later_duplicates(const PlaneDiagram& plane, Duplicates what, const Naming& name_of) {
  std::vector<Index> dropped;
  std::vector<std::string> faults;
  for (const auto& [site, first] : duplicates(plane)) {
    dropped.push_back(site);
    if (what == Duplicates::kRefuse)
      faults.push_back(fmt::format(
          "{} is the same as disk {}: remove one of them, or set sample.packing.duplicates = \"keep_first\"",
          name_of(site), first));
  }
  if (!faults.empty()) refuse(std::move(faults));
  return dropped;
}

void refuse_hidden(const Tessellation& result, const std::vector<Index>& dropped, const Naming& name_of) {
  std::vector<std::string> faults;
  for (const Index i : result.hidden)
    if (!std::binary_search(dropped.begin(), dropped.end(), i))
      faults.push_back(name_of(i) +
                       " has no tile in the box, larger disks beside it hide it: remove it, enlarge it, or use disks "
                       "that do not overlap");
  if (!faults.empty()) refuse(std::move(faults));
}

/// Takes the sites anew where it needs them again, which is rare, rather than keep them.
Tessellation tessellate(const std::function<std::vector<PowerSite>()>& make_sites, const Box& box,
                        const LaguerreOptions& options, const Naming& name_of) {
  std::vector<PowerSite> sites = make_sites();
  const auto count = static_cast<Index>(sites.size());
  if (sites.empty()) throw SceneError("the packing has no disks: a tessellation needs at least one");
  refuse_bad_box(box);
  refuse_sites_outside(sites, box, options.periodic, 0, name_of);
  Tessellation result;
  result.box = box;
  result.periodic = options.periodic;
  std::vector<Index> kept(sites.size());
  std::iota(kept.begin(), kept.end(), 0);
  PlaneDiagram plane = plane_diagram(std::move(sites), box, options.periodic);
  const std::vector<Index> dropped = later_duplicates(plane, options.duplicates, name_of);
  // A hidden site does not change the diagram, but slivers do by their rounding: once more without, until there are none.
  for (std::vector<Index> slivers; !(slivers = make_tiles(plane, kept, result)).empty();) {
    std::erase_if(kept, [&](Index site) { return std::binary_search(slivers.begin(), slivers.end(), site); });
    const std::vector<PowerSite> all = make_sites();
    std::vector<PowerSite> some;
    for (const Index i : kept) some.push_back(all[i]);
    plane = plane_diagram(std::move(some), box, options.periodic);
  }
  auto tile = result.tiles.begin();
  for (Index i = 0; i < count; ++i) {
    if (tile != result.tiles.end() && tile->site == i)
      ++tile;
    else
      result.hidden.push_back(i);
  }
  if (options.hidden == Hidden::kRefuse) refuse_hidden(result, dropped, name_of);
  return result;
}

}  // namespace

Tessellation tessellate(const std::vector<Disk>& disks, const Box& box, const LaguerreOptions& options) {
  const Naming name_of = names_of(disks);
  return tessellate([&] { return sites_of(disks, name_of); }, box, options, name_of);
}

Tessellation tessellate(const std::vector<Vec2>& centres, const std::vector<double>& weights, const Box& box,
                        const LaguerreOptions& options) {
  const Naming name_of = names_of(centres, weights);
  return tessellate([&] { return sites_of(centres, weights, name_of); }, box, options, name_of);
}

TileMeasures measure_tiles(const std::vector<Vec2>& centres, const std::vector<double>& weights, const Box& box,
                           Periodic periodic, double* reach) {
  const Naming name_of = names_of(centres, weights);
  std::vector<PowerSite> sites = sites_of(centres, weights, name_of);
  refuse_bad_box(box);
  refuse_sites_outside(sites, box, periodic, 100, name_of);
  TileMeasures measures{std::vector<double>(centres.size(), 0), centres, {}};
  if (sites.empty()) return measures;
  const PlaneDiagram plane = plane_diagram(std::move(sites), box, periodic, reach);
  measures.walls.reserve(plane.diagram.ring_site.size() / 2);
  Tessellation t;
  t.box = box;
  t.periodic = periodic;
  for_each_tile(plane, t.vertices, [&](const Tile& tile) {
    const double area = tile_area(t, tile);
    if (!(area > 0)) return;
    measures.area[tile.site] = area;
    measures.centroid[tile.site] = tile_centroid(t, tile);
    for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
      const Image image = tile.across.empty() ? Image{0, 0} : tile.across[k];
      if (std::pair(tile.neighbour[k], image) > std::pair(tile.site, Image{0, 0}))  // a side is negative
        measures.walls.push_back({tile.site, tile.neighbour[k], image, edge_length(t, tile, k)});
    }
  });
  return measures;
}

}  // namespace lamella
