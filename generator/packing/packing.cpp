#include "generator/packing/packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "generator/packing/domain.h"
#include "generator/packing/filling.h"
#include "generator/packing/packing_file.h"
#include "generator/packing/random.h"
#include "generator/packing/random_sites.h"
#include "generator/packing/sizes.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

// Random packings of disks jam below this whatever their sizes: measured 0.892 for lognormal radii of CV 1.
constexpr double kLargestFraction = 0.92;

Periodic periodic_of(const PackingScene& scene) {
  const bool both = scene.boundary == "periodic";
  return {both || scene.boundary == "periodic_x", both || scene.boundary == "periodic_y"};
}

void refuse_bad_request(const PackingScene& packing, const std::vector<double>& radii, const PackingSpace& space) {
  std::vector<std::string> faults;
  if (radii.empty()) faults.push_back("sample.packing.count = 0: must be at least 1");
  if (!std::all_of(radii.begin(), radii.end(), [](double r) { return r > 0 && std::isfinite(r); }))
    faults.push_back("sample.sizes: all radii must be positive and finite");
  if (packing.boundary != "walls" && packing.boundary != "periodic" && packing.boundary != "periodic_x" &&
      packing.boundary != "periodic_y")
    faults.push_back(fmt::format(
        "sample.packing.boundary = \"{}\": must be \"walls\", \"periodic\", \"periodic_x\" or \"periodic_y\"",
        packing.boundary));
  if (!packing.jammed && !(packing.fraction > 0 && packing.fraction <= kLargestFraction))
    faults.push_back(
        fmt::format("sample.packing.fraction = {}: must be positive, and random packings of disks jam before {}; "
                    "0.83 (periodic) and 0.81 (walls) are reached quickly",
                    packing.fraction, kLargestFraction));
  for (const auto& [name, length] : {std::pair{"width", space.width}, std::pair{"height", space.height}})
    if (!(length >= 0) || !std::isfinite(length))
      faults.push_back(fmt::format("sample.{} = {}: must be positive, or 0 to follow from the disks", name, length));
  if (space.domain && packing.boundary != "walls")
    faults.push_back(fmt::format("sample.packing.boundary = \"{}\": a domain has walls; remove it", packing.boundary));
  if (!faults.empty()) throw SceneError(std::move(faults));
}

/// `scale` is that of a box which shrinks instead of disks that grow.
Packing as_packing(const Filling& filling, double scale) {
  const SoftDisks& soft = filling.soft;
  Packing packing;
  packing.box = filling.domain ? filling.domain->box : Box{Vec2::Zero(), soft.size * scale};
  packing.periodic = soft.periodic;
  for (std::size_t i = 0; i < soft.x.size(); ++i) {
    Vec2 x = filling.origin() + soft.x[i] * scale;
    // Scaling can round a centre across the side that it lies on.
    for (const int axis : {0, 1})
      if (soft.periodic[axis]) x[axis] = std::clamp(x[axis], packing.box.lo[axis], packing.box.hi[axis]);
    packing.disks.push_back({x, soft.radius[i] * scale});
  }
  return packing;
}

/// In the final coordinates; rounding alone can leave an overlap.
void certify(Packing& packing, const Domain* domain) {
  const auto overlap_left = [&] { return domain ? largest_overlap(packing, *domain) : largest_overlap(packing); };
  for (double overlap; (overlap = overlap_left()) > 0;)
    for (Disk& disk : packing.disks) disk.radius -= overlap;
  packing.fraction = area_fraction(packing.disks, packing.box);
  if (domain) packing.fraction *= packing.box.area() / domain->area;
}

}  // namespace

Packing pack(const PackingScene& scene, const std::vector<double>& radii, const PackingSpace& space, std::uint64_t seed,
             const PackingProgress& progress) {
  refuse_bad_request(scene, radii, space);
  Random random(seed);
  Filling filling = random_start(radii, scene.jammed ? 0.8 : scene.fraction, space, periodic_of(scene), random);
  SoftDisks& soft = filling.soft;
  if (space.domain || space.factor) even_out(filling, random, progress);
  if (space.factor) follow_factor(filling, progress);
  double scale = 1;
  if (scene.jammed) {
    const double before = soft.radius[0];
    jam(soft, kLargestFraction, progress);
    const bool box_is_free = !space.domain && !space.factor && (space.width == 0 || space.height == 0);
    if (box_is_free) scale = before / soft.radius[0];
  } else {
    separate(filling, random, progress);
  }
  Packing packing = as_packing(filling, scale);
  certify(packing, space.domain);
  packing.notes.push_back(fmt::format("{} disks packed at fraction {:.5f}{}, no overlap", packing.disks.size(),
                                      packing.fraction, scene.jammed ? ", jammed" : ""));
  if (space.factor) {
    const std::vector<double> deviation = size_deviations(filling);
    packing.size_deviation = *std::max_element(deviation.begin(), deviation.end());
    const auto off = std::count_if(deviation.begin(), deviation.end(), [](double d) { return d > 0.01; });
    packing.notes.push_back(
        fmt::format("radii fit the factor at their place to {:.1e}; {} of them are off by more than 1 %",
                    packing.size_deviation, off));
  }
  return packing;
}

Packing pack(const PackingScene& scene, const std::vector<double>& radii, double width, double height,
             std::uint64_t seed, const PackingProgress& progress) {
  return pack(scene, radii, {.width = width, .height = height, .domain = nullptr, .factor = {}}, seed, progress);
}

Packing make_packing(const Scene& scene, const PackingProgress& progress, const SizeFactor& factor) {
  const SampleScene& sample = scene.sample;
  // A sample that repeats needs a packing that does.
  PackingScene packing_scene = sample.packing;
  if (sample.periodic != "none")
    packing_scene.boundary = sample.periodic == "xy" ? "periodic" : "periodic_" + sample.periodic;
  const bool at_random = sample.areas && sample.areas->sites == "random";
  if (!sample.packing.file.empty()) {
    const Box box{Vec2::Zero(), {sample.width, sample.height}};
    const bool box_given = sample.width > 0 && sample.height > 0;
    Packing packing =
        read_packing(scene.resolve(sample.packing.file), box_given ? &box : nullptr, sample.packing.duplicates);
    packing.periodic = periodic_of(packing_scene);
    if (!packing.target_area.empty() && !sample.areas)
      packing.notes.push_back(fmt::format(
          "{}: states areas of cells, which cells have with a section [sample.areas] only", sample.packing.file));
    if (sample.areas && !at_random && sample.packing.duplicates == "keep_first") keep_first_at_each_place(packing);
    if (at_random) {
      scatter(packing, scene.seed);
      return packing;
    }
    // Allowed, as tiles only need powers; but somebody who believes to have a packing should know.
    if (const double overlap = largest_overlap(packing); overlap > 0)
      packing.notes.push_back(
          fmt::format("{}: disks overlap, or cross a wall, by up to {:.3g} m", sample.packing.file, overlap));
    return packing;
  }
  Sizes sizes = draw_sizes(sample.sizes, packing_scene.count, scene.seed, scene);
  if (at_random && factor)
    throw SceneError(
        "sample.areas.sites = \"random\": sizes depend on the place here, and only a packing knows which disk is "
        "where; leave "
        "sites out, or the layers' and gradient's sizes");
  std::optional<Domain> domain;
  if (sample.domain) domain = make_domain(*sample.domain);
  const PackingSpace space{
      .width = sample.width, .height = sample.height, .domain = domain ? &*domain : nullptr, .factor = factor};
  Packing packing = at_random ? scattered(packing_scene, sizes.radius, space, scene.seed)
                              : pack(packing_scene, sizes.radius, space, scene.seed, progress);
  packing.group = std::move(sizes.group);
  packing.part = std::move(sizes.part);
  packing.area_share = std::move(sizes.area_share);
  return packing;
}

}  // namespace lamella
