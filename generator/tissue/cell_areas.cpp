#include "generator/tissue/cell_areas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/packing/exact_areas.h"
#include "generator/sample/errors.h"
#include "generator/tissue/inset_areas.h"
#include "generator/tissue/outlines.h"

namespace lamella {
namespace {

using Progress = std::function<void(double done, const std::string& what)>;

/// What was asked of each cell: what a file states, or else the square of the disk's radius.
std::vector<double> shares_of(const Packing& packing, bool whole_tiles, Notes& notes) {
  std::vector<double> shares = packing.target_area;
  if (shares.empty()) {
    for (const Disk& disk : packing.disks) shares.push_back(disk.radius * disk.radius);
    return shares;
  }
  const double box = packing.box.area();
  long double sum = 0;
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    sum += shares[i];
    if (shares[i] >= box && shares.size() > 1)
      faults.push_back(fmt::format("sample.areas: disk {} shall have a cell of {:.6g} m2, the box has {:.6g} m2", i,
                                   shares[i], box));
  }
  if (!faults.empty()) throw SceneError(faults);
  if (!whole_tiles || std::abs(static_cast<double>(sum) / box - 1) > 1e-9)
    notes.push_back(
        fmt::format("the stated areas sum to {:.6g} m2, the box has {:.6g} m2: cells have them in proportion",
                    static_cast<double>(sum), box));
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

}  // namespace

CellAreas tessellate_with_areas(const Packing& packing, const AreasScene& scene, const Periodic& periodic,
                                const std::vector<double>& distance, Notes& notes, const Progress& progress) {
  const bool insets = scene.of == "inset";
  CellAreas result;
  result.shares = shares_of(packing, !insets, notes);
  std::vector<Vec2> centres;
  std::vector<double> weights;
  for (const Disk& disk : packing.disks) {
    centres.push_back(disk.centre);
    weights.push_back(disk.radius * disk.radius);
  }
  if (scene.sites == "random") std::fill(weights.begin(), weights.end(), 0);

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
  // Measured again, on the tiles that the tissue is made of.
  const auto areas = cell_areas(result.tessellation, result.distance, static_cast<Index>(problem.centres.size()));
  double sum = 0;
  for (const double area : areas) sum += area;
  notes.push_back(fmt::format(
      "areas of {} {} as prescribed to within {:.2g}, {:.6g} m2 together: {} Newton iterations, {} diagrams{}",
      areas.size(), insets ? "insets" : "tiles", largest_error(areas, result.shares), sum, search.iterations,
      search.diagrams, scene.sweeps > 0 ? fmt::format(", {} sweep{}", scene.sweeps, scene.sweeps > 1 ? "s" : "") : ""));
  return result;
}

void note_welded_areas(const CellAreas& exact, const Tessellation& welded, int count, Notes& notes) {
  if (count == 0) {
    notes.push_back("no wall was welded: areas are exact");
    return;
  }
  const auto sites = static_cast<Index>(exact.shares.size());
  const auto before = cell_areas(exact.tessellation, exact.distance, sites);
  const auto after = cell_areas(welded, exact.distance, sites);
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
