#include "generator/packing/packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "generator/packing/packing_file.h"
#include "generator/packing/random.h"
#include "generator/packing/random_sites.h"
#include "generator/packing/relaxation.h"
#include "generator/packing/sizes.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

// Gap left between disks over the sum of their radii: far above rounding, and 0.02 % of fraction at most.
constexpr double kClearance = 1e-4;
// Random packings of disks jam below this whatever their sizes: measured 0.892 for lognormal radii of CV 1.
constexpr double kLargestFraction = 0.92;

Periodic periodic_of(const PackingScene& scene) {
  const bool both = scene.boundary == "periodic";
  return {both || scene.boundary == "periodic_x", both || scene.boundary == "periodic_y"};
}

double disk_area(const std::vector<double>& radii) {
  return std::accumulate(radii.begin(), radii.end(), 0.0,
                         [](double sum, double r) { return sum + std::numbers::pi * r * r; });
}

void refuse_bad_request(const PackingScene& packing, const std::vector<double>& radii, double width, double height) {
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
  for (const auto& [name, length] : {std::pair{"width", width}, std::pair{"height", height}})
    if (!(length >= 0) || !std::isfinite(length))
      faults.push_back(fmt::format("sample.{} = {}: must be positive, or 0 to follow from the disks", name, length));
  if (!faults.empty()) throw SceneError(std::move(faults));
}

/// Disks at random in a box of the asked shape that they fill to `fraction`.
SoftDisks random_start(const std::vector<double>& radii, double fraction, double width, double height,
                       Periodic periodic, Random& random) {
  SoftDisks disks{.size = {width, height}, .periodic = periodic, .x = {}, .radius = radii};
  const double area = disk_area(radii) / fraction;
  if (width > 0 && height > 0) {
    const double scale = std::sqrt(width * height / area);
    for (double& radius : disks.radius) radius *= scale;
  } else if (width > 0) {
    disks.size.y() = area / width;
  } else if (height > 0) {
    disks.size.x() = area / height;
  } else {
    disks.size.setConstant(std::sqrt(area));
  }
  const double largest = *std::max_element(disks.radius.begin(), disks.radius.end());
  if (2 * largest >= disks.size.minCoeff())
    throw SceneError(
        fmt::format("sample: the largest disk (diameter {:.4g} m) does not fit the box ({:.4g} x {:.4g} m): "
                    "ask for more disks, a lower fraction or a wider box",
                    2 * largest, disks.size.x(), disks.size.y()));
  for (const double radius : disks.radius) {
    const Vec2 margin(periodic[0] ? 0 : radius, periodic[1] ? 0 : radius);
    const Vec2 at(random.unit(), random.unit());
    disks.x.push_back(margin + at.cwiseProduct(disks.size - 2 * margin));
  }
  return disks;
}

double fraction_of(const SoftDisks& disks) { return disk_area(disks.radius) / (disks.size.x() * disks.size.y()); }

void scale_radii(SoftDisks& disks, double factor) {
  for (double& radius : disks.radius) radius *= factor;
}

/// Largest overlap over the sum of the two radii (to a wall: over the radius).
double relative_overlap(SoftDisks disks) { return relax(disks, {.clearance = 0, .balance = 0, .steps = 1}).overlap; }

/// Compresses beyond jamming, then shrinks the disks step by step to where the pressure vanishes, which it does about linearly
/// in the fraction; what overlap is left then, a millionth, is taken off the radii.
void jam(SoftDisks& disks, double start, const PackingProgress& progress) {
  scale_radii(disks, std::sqrt(start / fraction_of(disks)));
  double fraction = start, jammed_fraction = start, jammed_pressure = 0;
  double slope = 1;  // of the pressure; it is about 0.5 near jamming: the first steps are rather too small
  for (int k = 0; k < 60; ++k) {
    const Relaxation state = relax(disks, {.clearance = 0, .balance = 1e-3, .steps = 50000});
    if (progress)
      progress(std::min(0.99, k / 20.0),
               fmt::format("jamming: fraction {:.6f}, pressure {:.1e}", fraction, state.pressure));
    double next = (fraction + jammed_fraction) / 2;  // when they came apart
    if (state.end != RelaxationEnd::kSeparated) {
      if (state.pressure < 2e-7) break;
      if (jammed_pressure > state.pressure && jammed_fraction > fraction)
        slope = (jammed_pressure - state.pressure) / (jammed_fraction - fraction);
      jammed_fraction = fraction, jammed_pressure = state.pressure;
      next = fraction - 0.8 * state.pressure / slope;
    } else if (jammed_fraction - fraction < 1e-6) {
      break;
    }
    scale_radii(disks, std::sqrt(next / fraction));
    fraction = next;
  }
  scale_radii(disks, 1 - 1.01 * relative_overlap(disks) - 1e-12);
}

/// The same disks in a new place each: a random step of up to `amplitude` mean radii.
void shake(SoftDisks& disks, double amplitude, Random& random) {
  const double mean =
      std::accumulate(disks.radius.begin(), disks.radius.end(), 0.0) / static_cast<double>(disks.radius.size());
  for (Vec2& x : disks.x) x += amplitude * mean * Vec2(2 * random.unit() - 1, 2 * random.unit() - 1);
}

/// Pushes the disks apart at the fraction they have. Where they jam instead they are shaken and try again; last, they are
/// jammed from a higher fraction, which packs denser, and given back the room that is then left.
void separate(SoftDisks& disks, Random& random, const PackingProgress& progress) {
  const double fraction = fraction_of(disks);
  const std::vector<double> radius = disks.radius;
  const auto report = [&](const Relaxation& state) {
    // From overlaps of order 1 to the clearance, on a logarithmic scale.
    const double done = std::clamp(std::log(std::max(state.overlap, kClearance)) / std::log(kClearance), 0.0, 1.0);
    if (progress)
      progress(done, fmt::format("packing: fraction {:.4f}, largest overlap {:.1e}", fraction, state.overlap));
  };
  // Few disks jam at fractions that scatter widely, and cost little.
  const int trials = std::clamp(static_cast<int>(4000 / disks.x.size()), 2, 20);
  double densest = 0;
  for (int trial = 0; trial < 2 * trials; ++trial) {
    if (trial < trials) {
      const Relaxation state = relax(disks, {.clearance = kClearance, .balance = 1e-3, .steps = 20000}, report);
      if (state.end == RelaxationEnd::kSeparated) return;
    } else {
      jam(disks, std::max(1.05 * fraction, 0.9), progress);
      const double jammed = fraction_of(disks);
      densest = std::max(densest, jammed);
      disks.radius = radius;
      if (jammed > fraction) return;
    }
    shake(disks, trial % 2 == 0 ? 0.2 : 0.5, random);
  }
  throw SceneError(fmt::format(
      "sample.packing.fraction = {:.4g}: {} disks of these sizes jam at about {:.3f} in this box; ask for "
      "less{}, or for more disks",
      fraction, disks.x.size(), densest, disks.periodic[0] && disks.periodic[1] ? "" : ", for periodic boundaries"));
}

Packing as_packing(const SoftDisks& soft, double scale) {
  Packing packing;
  packing.box.hi = soft.size * scale;
  packing.periodic = soft.periodic;
  for (std::size_t i = 0; i < soft.x.size(); ++i) {
    Vec2 x = soft.x[i] * scale;
    // Scaling can round a centre across the side that it lies on.
    for (const int axis : {0, 1})
      if (soft.periodic[axis]) x[axis] = std::clamp(x[axis], packing.box.lo[axis], packing.box.hi[axis]);
    packing.disks.push_back({x, soft.radius[i] * scale});
  }
  packing.fraction = area_fraction(packing.disks, packing.box);
  return packing;
}

}  // namespace

double area_fraction(const std::vector<Disk>& disks, const Box& box) {
  double area = 0;
  for (const Disk& disk : disks) area += std::numbers::pi * disk.radius * disk.radius;
  return area / box.area();
}

double largest_overlap(const Packing& packing) {
  const Vec2 size = packing.box.size();
  std::vector<Disk> disks = packing.disks;
  double largest = -std::numeric_limits<double>::infinity(), reach = 0;
  for (const Disk& disk : disks) reach = std::max(reach, disk.radius);
  for (const int axis : {0, 1}) {
    if (packing.periodic[axis]) continue;
    for (const Disk& disk : disks)
      largest = std::max({largest, packing.box.lo[axis] - disk.centre[axis] + disk.radius,
                          disk.centre[axis] - packing.box.hi[axis] + disk.radius});
  }
  // Images within reach of a side, so that what follows need not know of them.
  for (const int axis : {0, 1}) {
    if (!packing.periodic[axis]) continue;
    const std::size_t count = disks.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (const int image : {-1, 1}) {
        Disk ghost = disks[i];
        ghost.centre[axis] += image * size[axis];
        if (ghost.centre[axis] > packing.box.lo[axis] - 4 * reach &&
            ghost.centre[axis] < packing.box.hi[axis] + 4 * reach)
          disks.push_back(ghost);
      }
    }
  }
  // Swept along x; of two disks the one further left looks to the right until no disk can reach it.
  std::sort(disks.begin(), disks.end(), [](const Disk& a, const Disk& b) { return a.centre.x() < b.centre.x(); });
  for (std::size_t i = 0; i < disks.size(); ++i) {
    for (std::size_t j = i + 1; j < disks.size(); ++j) {
      const Vec2 d = disks[j].centre - disks[i].centre;
      if (d.x() > disks[i].radius + reach - largest) break;
      largest = std::max(largest, disks[i].radius + disks[j].radius - d.norm());
    }
  }
  return largest;
}

Packing pack(const PackingScene& scene, const std::vector<double>& radii, double width, double height,
             std::uint64_t seed, const PackingProgress& progress) {
  refuse_bad_request(scene, radii, width, height);
  Random random(seed);
  const Periodic periodic = periodic_of(scene);
  double scale = 1;
  SoftDisks disks = random_start(radii, scene.jammed ? 0.8 : scene.fraction, width, height, periodic, random);
  if (scene.jammed) {
    const double before = disks.radius[0];
    jam(disks, kLargestFraction, progress);
    if (width == 0 || height == 0) scale = before / disks.radius[0];  // the radii keep, the box shrinks
  } else {
    separate(disks, random, progress);
  }
  Packing packing = as_packing(disks, scale);
  // Certified in the final coordinates; rounding alone can need this.
  for (double overlap; (overlap = largest_overlap(packing)) > 0;)
    for (Disk& disk : packing.disks) disk.radius -= overlap;
  packing.fraction = area_fraction(packing.disks, packing.box);
  packing.notes.push_back(fmt::format("{} disks packed at fraction {:.5f}{}, no overlap", packing.disks.size(),
                                      packing.fraction, scene.jammed ? ", jammed" : ""));
  return packing;
}

Packing make_packing(const Scene& scene, const PackingProgress& progress) {
  const SampleScene& sample = scene.sample;
  const bool at_random = sample.areas && sample.areas->sites == "random";
  if (!sample.packing.file.empty()) {
    const Box box{Vec2::Zero(), {sample.width, sample.height}};
    const bool box_given = sample.width > 0 && sample.height > 0;
    Packing packing =
        read_packing(scene.resolve(sample.packing.file), box_given ? &box : nullptr, sample.packing.duplicates);
    packing.periodic = periodic_of(sample.packing);
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
  const std::vector<double> radii = draw_radii(sample.sizes, sample.packing.count, scene.seed, scene);
  if (at_random) return scattered(sample.packing, radii, sample.width, sample.height, scene.seed);
  return pack(sample.packing, radii, sample.width, sample.height, scene.seed, progress);
}

}  // namespace lamella
