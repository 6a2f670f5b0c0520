#include "generator/tissue/cell_areas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/packing/exact_areas.h"
#include "generator/sample/errors.h"
#include "generator/tissue/domain_measure.h"
#include "generator/tissue/domain_tissue.h"
#include "generator/tissue/inset_areas.h"
#include "generator/tissue/outlines.h"
#include "generator/tissue/packed_tiles.h"

namespace lamella {
namespace {

using Progress = std::function<void(double done, const std::string& what)>;

/// In each part of a mixture by area, shares in proportion to the squares of the radii, which sum to the part's.
void scale_parts(const Packing& packing, std::vector<double>& shares) {
  std::vector<double> sum(packing.area_share.size(), 0);
  for (std::size_t i = 0; i < packing.part.size(); ++i) sum[packing.part[i]] += shares[i];
  for (std::size_t i = 0; i < packing.part.size(); ++i)
    shares[i] *= packing.area_share[packing.part[i]] / sum[packing.part[i]];
}

/// What was asked of each cell: what a file states, or else the square of the disk's radius.
std::vector<double> shares_of(const Packing& packing, double room, bool whole_tiles, Notes& notes) {
  std::vector<double> shares = packing.target_area;
  if (shares.empty()) {
    for (const Disk& disk : packing.disks) shares.push_back(disk.radius * disk.radius);
    scale_parts(packing, shares);
    return shares;
  }
  long double sum = 0;
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    sum += shares[i];
    if (shares[i] >= room && shares.size() > 1)
      faults.push_back(fmt::format("sample.areas: disk {} shall have a cell of {:.6g} m2, there are {:.6g} m2 in all",
                                   i, shares[i], room));
  }
  if (!faults.empty()) throw SceneError(faults);
  if (!whole_tiles || std::abs(static_cast<double>(sum) / room - 1) > 1e-9)
    notes.push_back(fmt::format("the stated areas sum to {:.6g} m2, there are {:.6g} m2: cells have them in proportion",
                                static_cast<double>(sum), room));
  return shares;
}

/// Counts every search that the areas need, and tells how far the present one is: errors fall from about 1 to the tolerance.
class AreaSearch {
 public:
  AreaSearch(double tolerance, const Progress& progress) : tolerance_(tolerance), progress_(progress) {}

  WeightOptions options(double tolerance, double from, double to) const {
    WeightOptions options{.tolerance = tolerance};
    if (progress_)
      options.progress = [=, this](double error) {
        const double left = std::log(std::clamp(error, tolerance_, 1.0)) / std::log(tolerance_);
        progress_(from + (to - from) * left, "cell areas");
      };
    return options;
  }
  Weights count(Weights found) {
    iterations += found.iterations;
    diagrams += found.diagrams;
    return found;
  }

  int iterations = 0, diagrams = 0;

 private:
  double tolerance_;
  const Progress& progress_;
};

/// Sites whose inset vanishes from where the search for inset areas would start.
void refuse_vanished(const TileMeasures& insets) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < insets.area.size(); ++i)
    if (!(insets.area[i] > 0)) names.push_back(fmt::format("site {}", i));
  if (!names.empty())
    throw SceneError(fmt::format(
        "sample.areas.of = \"inset\": the inset by radius + gap / 2 leaves nothing of {} cells ({}): choose a smaller "
        "radius or gap, more sweeps for rounder cells, or sites = \"packing\"",
        names.size(), listed(names)));
}

std::vector<double> cell_areas(const Tessellation& tessellation, const std::vector<double>& distance, Index sites) {
  const std::vector<Vec2> unused(static_cast<std::size_t>(sites), Vec2::Zero());
  if (!distance.empty()) return measure_insets(tessellation, unused, distance).area;
  std::vector<double> areas(unused.size(), 0);
  for (const Tile& tile : tessellation.tiles) areas[tile.site] = tile_area(tessellation, tile);
  return areas;
}

struct Start {
  std::vector<Vec2> centres;
  std::vector<double> weights;
};

Start start_of(const Packing& packing, const AreasScene& scene) {
  Start start;
  for (const Disk& disk : packing.disks) {
    start.centres.push_back(disk.centre);
    start.weights.push_back(scene.sites == "random" ? 0 : disk.radius * disk.radius);
  }
  return start;
}

void note_areas(const std::vector<double>& areas, const CellAreas& exact, const AreasScene& scene,
                const AreaSearch& search, Notes& notes) {
  double sum = 0;
  for (const double area : areas) sum += area;
  notes.push_back(fmt::format(
      "areas of {} {} as prescribed to within {:.2g}, {:.6g} m2 together: {} Newton iterations, {} diagrams{}",
      areas.size(), exact.distance.empty() ? "tiles" : "insets", largest_error(areas, exact.shares), sum,
      search.iterations, search.diagrams,
      scene.sweeps > 0 ? fmt::format(", {} sweep{}", scene.sweeps, scene.sweeps > 1 ? "s" : "") : ""));
}

}  // namespace

std::vector<Disk> CellAreas::sites() const {
  const double least = *std::min_element(weights.begin(), weights.end());
  const double shift = 1e-6 * tessellation.box.area() / static_cast<double>(weights.size()) - least;
  std::vector<Disk> disks;
  for (std::size_t i = 0; i < weights.size(); ++i) disks.push_back({centres[i], std::sqrt(weights[i] + shift)});
  return disks;
}

CellAreas tessellate_with_areas(const Packing& packing, const AreasScene& scene, const Periodic& periodic,
                                const std::vector<double>& distance, Notes& notes, const Progress& progress) {
  const bool insets = scene.of == "inset";
  CellAreas result;
  result.shares = shares_of(packing, packing.box.area(), !insets, notes);
  auto [centres, weights] = start_of(packing, scene);
  AreaSearch search(scene.tolerance, progress);
  AreaProblem problem = tile_problem(packing.box, periodic, std::move(centres), result.shares);
  if (insets) problem.shares = tiles_around_insets(result.shares, distance, packing.box.area());
  const double loose = insets ? std::max(0.01, scene.tolerance) : scene.tolerance;
  Weights found =
      search.count(lloyd_sweeps(problem, std::move(weights), scene.sweeps, search.options(loose, 0, insets ? 0.3 : 1)));
  if (insets) {
    AreaProblem inside = inset_problem(problem, distance);
    inside.shares = result.shares;
    refuse_vanished(inside.measure(inside.centres, found.weight));
    found = search.count(solve_weights(inside, std::move(found.weight), search.options(scene.tolerance, 0.3, 1)));
    result.distance = distance;
  }
  result.tessellation =
      tessellate(problem.centres, found.weight, packing.box, {Duplicates::kRefuse, Hidden::kRefuse, periodic});
  result.centres = std::move(problem.centres);
  result.weights = std::move(found.weight);
  refuse_faults(check_powers(result.tessellation, result.centres, result.weights));
  // Measured again, on the tiles that the tissue is made of.
  const auto areas = cell_areas(result.tessellation, result.distance, static_cast<Index>(result.centres.size()));
  note_areas(areas, result, scene, search, notes);
  return result;
}

CellAreas tessellate_with_areas(const Packing& packing, const AreasScene& scene, const Domain& domain, Notes& notes,
                                const Progress& progress) {
  if (scene.of == "inset")
    throw SceneError(
        "sample.areas.of = \"inset\": only for tissues that fill a box; in a domain, or stretched, the tiles can have "
        "the areas");
  CellAreas result;
  result.shares = shares_of(packing, domain.area, true, notes);
  auto [centres, weights] = start_of(packing, scene);
  AreaProblem problem{.box = domain.box,
                      .periodic = {false, false},
                      .measure = [&](const std::vector<Vec2>& x,
                                     const std::vector<double>& w) { return measure_domain_tiles(x, w, domain.loops); },
                      .centres = std::move(centres),
                      .shares = result.shares};
  AreaSearch search(scene.tolerance, progress);
  const Weights found =
      search.count(lloyd_sweeps(problem, std::move(weights), scene.sweeps, search.options(scene.tolerance, 0, 1)));
  std::vector<Disk> sites;
  for (const Vec2& centre : problem.centres) sites.push_back({centre, 0});
  result.tessellation = tessellate(problem.centres, found.weight, box_around(domain.loops, sites),
                                   {Duplicates::kRefuse, Hidden::kRefuse, {false, false}});
  result.centres = std::move(problem.centres);
  result.weights = found.weight;
  refuse_faults(check_powers(result.tessellation, result.centres, result.weights));
  note_areas(found.cells.area, result, scene, search, notes);
  return result;
}

void note_welded_areas(const CellAreas& exact, const Tessellation& welded, int count, Notes& notes) {
  const auto sites = static_cast<Index>(exact.shares.size());
  note_welded_areas(cell_areas(exact.tessellation, exact.distance, sites), cell_areas(welded, exact.distance, sites),
                    count, notes);
}

void note_welded_areas(const std::vector<double>& before, const std::vector<double>& after, int count, Notes& notes) {
  if (count == 0) {
    notes.push_back("no wall was welded: areas are exact");
    return;
  }
  double largest = 0, squares = 0;
  int changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double change = std::abs(after[i] / before[i] - 1);
    largest = std::max(largest, change);
    squares += change * change;
    changed += change > 1e-12;
  }
  notes.push_back(
      fmt::format("welding {} short walls changes {} of {} areas, by at most {:.2g} and {:.2g} in the mean "
                  "square; areas are exact with sample.walls.weld = 0, and more sweeps leave fewer short walls",
                  count, changed, before.size(), largest, std::sqrt(squares / static_cast<double>(before.size()))));
}

void note_enclosed_areas(const Mosaic& mosaic, double gap, const Sample& sample, Notes& notes) {
  double largest = 0;
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c) {
    const double inset = inset_area(polygon_of(mosaic, mosaic.cells[c]), sample.radius[c] + gap / 2);
    largest = std::max(largest, std::abs(sample.rest_area[c] / inset - 1));
  }
  notes.push_back(fmt::format(
      "mass points enclose the areas of the insets to within {:.2g}: those close to a corner cut it off; more segments "
      "cut off less",
      largest));
}

}  // namespace lamella
