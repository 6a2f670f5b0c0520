#include "generator/packing/filling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

// By how much disks are larger while they are pushed apart: the more, the sooner those of true size are; near jamming little
// is left.
constexpr double kClearances[] = {1e-3, 1e-4};

double disk_area(const std::vector<double>& radii) {
  return std::accumulate(radii.begin(), radii.end(), 0.0,
                         [](double sum, double r) { return sum + std::numbers::pi * r * r; });
}

void scale_radii(SoftDisks& disks, double factor) {
  for (double& radius : disks.radius) radius *= factor;
}

/// The size of the box, from what is given of it and the disks.
Vec2 box_size(const std::vector<double>& radii, double fraction, const PackingSpace& space) {
  if (space.domain) return space.domain->box.size();
  const double area = disk_area(radii) / fraction;
  if (space.width > 0 && space.height > 0) return {space.width, space.height};
  if (space.width > 0) return {space.width, area / space.width};
  if (space.height > 0) return {area / space.height, space.height};
  return Vec2::Constant(std::sqrt(area));
}

void add_walls(SoftDisks& soft, const Domain& domain) {
  for (const auto& loop : domain.loops) {
    const auto corner = [&](std::size_t k) { return Vec2(loop[k % loop.size()] - domain.box.lo); };
    for (std::size_t k = 0; k < loop.size(); ++k) soft.walls.push_back({corner(k), corner(k + 1)});
  }
}

/// Draws places with a density in proportion to 1 / factor^2, which is constant on each cell of a raster.
class Places {
 public:
  Places(const Filling& filling, Random& random) : filling_(filling), random_(random) {
    if (!filling.factor) return;
    double sum = 0;
    for (int cell = 0; cell < kRaster * kRaster; ++cell) {
      const double factor = filling.factor_at(in_cell(cell, {0.5, 0.5}));
      if (!(factor > 0) || !std::isfinite(factor))
        throw SceneError(fmt::format("sample: the factor on the radii is {} in one place: must be positive", factor));
      sums_.push_back(sum += 1 / (factor * factor));
    }
  }

  /// For a disk of this radius before the factor. In a domain, one where it fits, if chance finds one: in a passage that
  /// is too narrow for it it would be stuck.
  Vec2 next(double radius) {
    if (!filling_.domain) return anywhere();
    Vec2 best;
    double most_room = -std::numeric_limits<double>::infinity();
    for (int trial = 0; trial < 200 && most_room < 0; ++trial) {
      const Vec2 x = inside();
      const double room = filling_.domain->distance_to_boundary(filling_.origin() + x) - radius * filling_.factor_at(x);
      if (room > most_room) most_room = room, best = x;
    }
    return best;
  }

  /// Mean square of the factor over places drawn so.
  double mean_square() const { return sums_.empty() ? 1 : kRaster * kRaster / sums_.back(); }

 private:
  static constexpr int kRaster = 128;
  Vec2 anywhere() {
    const Vec2 at(random_.unit(), random_.unit());
    return sums_.empty() ? Vec2(at.cwiseProduct(filling_.soft.size)) : in_cell(random_cell(), at);
  }
  Vec2 inside() {
    for (int trial = 0; trial < 1000000; ++trial)
      if (const Vec2 x = anywhere(); filling_.contains(x)) return x;
    throw SceneError("sample.domain: is too thin to be packed: it covers less than a millionth of its box");
  }
  Vec2 in_cell(int cell, const Vec2& at) const {
    return (Vec2(cell % kRaster, cell / kRaster) + at).cwiseProduct(filling_.soft.size) / kRaster;
  }
  int random_cell() {
    const auto found = std::upper_bound(sums_.begin(), sums_.end(), random_.unit() * sums_.back());
    return static_cast<int>(std::min<std::ptrdiff_t>(found - sums_.begin(), kRaster * kRaster - 1));
  }

  const Filling& filling_;
  Random& random_;
  std::vector<double> sums_;
};

/// Between walls disks start inside; in a domain that is left to the relaxation.
Vec2 off_sides(const SoftDisks& soft, Vec2 x, double radius) {
  for (const int axis : {0, 1})
    if (!soft.periodic[axis]) x[axis] = radius + x[axis] / soft.size[axis] * (soft.size[axis] - 2 * radius);
  return x;
}

/// Radii as the places ask, at the fraction that they fill now or shall fill.
void set_radii(Filling& filling, double fraction) {
  SoftDisks& soft = filling.soft;
  for (std::size_t i = 0; i < soft.x.size(); ++i) soft.radius[i] = filling.drawn[i] * filling.factor_at(soft.x[i]);
  scale_radii(soft, std::sqrt(fraction / fraction_of(soft)));
}

/// Largest overlap over the sum of the two radii (to a wall: over the radius).
double relative_overlap(SoftDisks disks) { return relax(disks, {.clearance = 0, .balance = 0, .steps = 1}).overlap; }

/// The same disks in a new place each: a random step of up to `amplitude` mean radii, but not out of the domain.
void shake(Filling& filling, double amplitude, Random& random) {
  SoftDisks& soft = filling.soft;
  const double mean =
      std::accumulate(soft.radius.begin(), soft.radius.end(), 0.0) / static_cast<double>(soft.radius.size());
  for (Vec2& x : soft.x) {
    const Vec2 moved = x + amplitude * mean * Vec2(2 * random.unit() - 1, 2 * random.unit() - 1);
    if (filling.contains(moved)) x = moved;
  }
}

Relaxation push_apart(SoftDisks& disks, const std::function<void(const Relaxation&)>& report) {
  const int steps = static_cast<int>(std::min<std::size_t>(20000, 5000 + 100 * disks.x.size()));
  Relaxation state;
  for (const double clearance : kClearances) {
    state = relax(disks, {.clearance = clearance, .balance = 1e-3, .steps = steps}, report);
    // Far more overlap than the clearance: jammed without it too.
    if (state.end == RelaxationEnd::kSeparated || state.overlap > 5 * clearance) break;
  }
  return state;
}

}  // namespace

double fraction_of(const SoftDisks& disks) { return disk_area(disks.radius) / disks.area; }

Filling random_start(const std::vector<double>& radii, double fraction, const PackingSpace& space, Periodic periodic,
                     Random& random) {
  Filling filling{.soft = {.size = box_size(radii, fraction, space),
                           .area = 0,
                           .periodic = periodic,
                           .walls = {},
                           .x = {},
                           .radius = radii},
                  .drawn = radii,
                  .domain = space.domain,
                  .factor = space.factor};
  SoftDisks& soft = filling.soft;
  soft.area = space.domain ? space.domain->area : soft.size.x() * soft.size.y();
  if (space.domain) add_walls(soft, *space.domain);
  // A given box scales the radii; a box of their own leaves them to the last bit.
  if (space.domain || (space.width > 0 && space.height > 0)) scale_radii(soft, std::sqrt(fraction / fraction_of(soft)));
  Places places(filling, random);
  const double expected = 1 / std::sqrt(places.mean_square());
  for (std::size_t i = 0; i < radii.size(); ++i) soft.x.push_back(places.next(expected * soft.radius[i]));
  if (filling.factor) set_radii(filling, fraction);
  const double largest = *std::max_element(soft.radius.begin(), soft.radius.end());
  if (2 * largest >= soft.size.minCoeff())
    throw SceneError(
        fmt::format("sample: the largest disk (diameter {:.4g} m) does not fit the box ({:.4g} x {:.4g} m): "
                    "ask for more disks, a lower fraction or a wider box",
                    2 * largest, soft.size.x(), soft.size.y()));
  if (!space.domain)
    for (std::size_t i = 0; i < radii.size(); ++i) soft.x[i] = off_sides(soft, soft.x[i], soft.radius[i]);
  return filling;
}

std::vector<double> size_deviations(const Filling& filling) {
  const std::size_t n = filling.drawn.size();
  std::vector<double> asked(n), deviation(n);
  double squares = 0;
  for (std::size_t i = 0; i < n; ++i)
    squares += std::pow(asked[i] = filling.drawn[i] * filling.factor_at(filling.soft.x[i]), 2);
  // The common scale is that of the areas, as in set_radii.
  const double scale = std::sqrt(disk_area(filling.soft.radius) / (std::numbers::pi * squares));
  for (std::size_t i = 0; i < n; ++i) deviation[i] = std::abs(filling.soft.radius[i] / (scale * asked[i]) - 1);
  return deviation;
}

void even_out(Filling& filling, Random& random, const PackingProgress& progress) {
  constexpr int kRounds = 40;
  SoftDisks& soft = filling.soft;
  const std::size_t n = soft.x.size();
  const double fraction = fraction_of(soft);
  Places places(filling, random);
  for (int round = 0; round < kRounds; ++round) {
    relax(soft, {.clearance = kClearances[0], .balance = 1e-3, .steps = 300});
    const std::vector<double> overlap = overlaps(soft);
    const double mean = std::accumulate(overlap.begin(), overlap.end(), 0.0) / static_cast<double>(n);
    std::vector<std::size_t> squeezed;
    for (std::size_t i = 0; i < n; ++i)
      if (overlap[i] > std::max(0.02, 4 * mean)) squeezed.push_back(i);
    if (progress) progress(0, fmt::format("packing: {} disks squeezed", squeezed.size()));
    if (squeezed.empty()) return;
    std::sort(squeezed.begin(), squeezed.end(),
              [&](std::size_t i, std::size_t j) { return std::pair(-overlap[i], i) < std::pair(-overlap[j], j); });
    // Some at a time: those next to them have room then.
    squeezed.resize(std::min(squeezed.size(), std::max<std::size_t>(1, n / 100)));
    for (const std::size_t i : squeezed) soft.x[i] = places.next(soft.radius[i] / filling.factor_at(soft.x[i]));
    if (filling.factor) set_radii(filling, fraction);
  }
}

void follow_factor(Filling& filling, const PackingProgress& progress) {
  constexpr int kRounds = 40;
  const double fraction = fraction_of(filling.soft);
  for (int round = 0; round < kRounds; ++round) {
    const Relaxation state = relax(filling.soft, {.clearance = kClearances[0], .balance = 1e-3, .steps = 50});
    const std::vector<double> deviations = size_deviations(filling);
    const double deviation = *std::max_element(deviations.begin(), deviations.end());
    if (progress) progress(0.3 * round / kRounds, fmt::format("packing: radii off their place's by {:.1e}", deviation));
    if (state.end != RelaxationEnd::kOutOfSteps && deviation < 1e-3) return;
    set_radii(filling, fraction);
  }
}

double jam(SoftDisks& disks, double start, const PackingProgress& progress, double needed) {
  scale_radii(disks, std::sqrt(start / fraction_of(disks)));
  double fraction = start, jammed_fraction = start, jammed_pressure = 0;
  double slope = 1;  // of the pressure; it is about 0.5 near jamming: the first steps are rather too small
  const int steps = static_cast<int>(std::min<std::size_t>(50000, 5000 + 100 * disks.x.size()));
  for (int k = 0; k < 60; ++k) {
    const Relaxation state = relax(disks, {.clearance = 0, .balance = 1e-3, .steps = steps});
    if (progress)
      progress(std::min(0.99, k / 20.0),
               fmt::format("jamming: fraction {:.6f}, pressure {:.1e}", fraction, state.pressure));
    double next = (fraction + jammed_fraction) / 2;  // when they came apart
    if (state.end != RelaxationEnd::kSeparated) {
      if (state.pressure < 2e-7) break;
      // The pressure vanishes about linearly in the fraction.
      if (jammed_pressure > state.pressure && jammed_fraction > fraction)
        slope = (jammed_pressure - state.pressure) / (jammed_fraction - fraction);
      jammed_fraction = fraction, jammed_pressure = state.pressure;
      if (fraction < needed) return std::max(fraction - state.pressure / std::min(slope, 0.5), fraction / 2);
      next = std::max(fraction - 0.8 * state.pressure / slope, fraction / 2);
    } else if (jammed_fraction - fraction < 1e-6) {
      break;
    }
    scale_radii(disks, std::sqrt(next / fraction));
    fraction = next;
  }
  // What overlap is left, about a millionth, is taken off the radii.
  for (double overlap; (overlap = relative_overlap(disks)) > 0;)
    scale_radii(disks, std::max(1 - 1.01 * overlap - 1e-12, 0.5));
  return fraction_of(disks);
}

void separate(Filling& filling, Random& random, const PackingProgress& progress) {
  SoftDisks& disks = filling.soft;
  const double fraction = fraction_of(disks);
  const std::vector<double> radius = disks.radius;
  const auto report = [&](const Relaxation& state) {
    // From overlaps of order 1 to the clearance, on a logarithmic scale.
    const double done =
        std::clamp(std::log(std::max(state.overlap, kClearances[0])) / std::log(kClearances[0]), 0.0, 1.0);
    if (progress)
      progress(done, fmt::format("packing: fraction {:.4f}, largest overlap {:.1e}", fraction, state.overlap));
  };
  // Few disks jam at fractions that scatter widely, and cost little.
  const int trials = std::clamp(static_cast<int>(4000 / disks.x.size()), 2, 20);
  const double scatter = 0.5 / std::sqrt(static_cast<double>(disks.x.size()));
  // What is far off is not tried again.
  const auto hopeless = [&](int trial, double missing) { return missing > (trial > 2 ? 1 : 3) * scatter; };
  for (int trial = 0; trial < trials; ++trial) {
    const Relaxation state = push_apart(disks, report);
    if (state.end == RelaxationEnd::kSeparated) return;
    // The pressure is about half the distance from the fraction at which they jam.
    if (hopeless(trial + 1, 2 * state.pressure)) break;
    shake(filling, trial % 2 == 0 ? 0.2 : 0.5, random);
  }
  double densest = 0;
  for (int trial = 0; trial < trials && (trial == 0 || !hopeless(trial, fraction - densest)); ++trial) {
    const double jammed = jam(disks, std::max(1.05 * fraction, 0.9), progress, fraction);
    densest = std::max(densest, jammed);
    disks.radius = radius;
    if (jammed > fraction) return;
    shake(filling, trial % 2 == 0 ? 0.2 : 0.5, random);
  }
  throw SceneError(
      fmt::format("sample.packing.fraction = {:.4g}: {} disks of these sizes jam at about {:.3f} in this {}; ask for "
                  "less{}, or for "
                  "more disks",
                  fraction, disks.x.size(), densest, filling.domain ? "domain" : "box",
                  filling.domain || (disks.periodic[0] && disks.periodic[1]) ? "" : ", for periodic boundaries"));
}

}  // namespace lamella
