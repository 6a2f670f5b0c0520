#include "simulator/contact/images.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "generator/sample/errors.h"

namespace lamella {

Image image_between(const Steps& of_a, const Steps& of_b) {
  Image image{0, 0};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::int64_t step = of_a[axis] - of_b[axis];
    if (std::abs(step) > std::numeric_limits<std::int8_t>::max())
      throw SolverError(fmt::format(
          "cells of the periodic sample have moved {} boxes apart, and at most {} can be told; stop earlier",
          std::abs(step), std::numeric_limits<std::int8_t>::max()));
    image[axis] = static_cast<std::int8_t>(step);
  }
  return image;
}

namespace {

constexpr double kWidest = 16;  // boxes: cells of a tissue reach over one or two, and what has exploded over more

void refuse_too_wide(const Sample& sample, const Vec2& period, std::size_t cell, const Box& around) {
  for (int axis = 0; axis < 2; ++axis)
    if (const double boxes = around.size()[axis] / period[axis]; sample.periodic[axis] && boxes > kWidest)
      throw SolverError(
          fmt::format("cell {} reaches over {:.3g} lengths of the periodic box along {}; at most {:.0f} are possible",
                      cell, boxes, axis == 0 ? "x" : "y", kWidest));
}

}  // namespace

// A position that is no number, or is beyond counting, stays where it is: the health check finds it.
std::int64_t Homes::steps(double distance, std::size_t axis, bool up) const {
  const double count = distance / period_[axis];
  if (!(std::abs(count) < 1e9)) return 0;
  return static_cast<std::int64_t>(up ? std::ceil(count) : std::floor(count));
}

Homes::Homes(const Sample& sample, const Vec2& period, const std::vector<Box>& around)
    : periodic_(sample.periodic), period_(period), home_(around.size(), Steps{0, 0}) {
  for (std::size_t c = 0; c < around.size(); ++c) {
    refuse_too_wide(sample, period, c, around[c]);
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (periodic_[axis])
        home_[c][axis] = -steps(0.5 * (around[c].lo[axis] + around[c].hi[axis]) - sample.box.lo[axis], axis, false);
    const Vec2 off = displacement(home_[c]);
    const Box at{around[c].lo + off, around[c].hi + off};
    all_ = c == 0 ? at : Box{all_.lo.cwiseMin(at.lo), all_.hi.cwiseMax(at.hi)};
  }
}

Field brought_home(const Sample& sample, const Homes& homes, const Field& x) {
  Field out = x;
  out.x.resize(sample.x.size()), out.y.resize(sample.x.size());  // without a box that moves
  for (Index c = 0; c < sample.cells(); ++c) {
    const Vec2 off = homes.displacement(homes.home(c));
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) out.add(i, off);
  }
  return out;
}

}  // namespace lamella
