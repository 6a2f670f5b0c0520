#include "simulator/health.h"

#include <fmt/format.h>

#include <cmath>

#include "generator/sample/errors.h"

namespace lamella {

void check_health(const Model& model, const Field& x, double time) {
  const Sample& sample = model.sample;
  const BrokenBars* const broken = model.rupture ? &model.rupture->broken() : nullptr;
  for (Index c = 0; c < sample.cells(); ++c) {
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) {
      if (!std::isfinite(x.x[i]) || !std::isfinite(x.y[i]))
        throw SolverError(
            fmt::format("t = {:.6g} s: the position of node {} of cell {} is no longer a number", time, i, c));
      if (!sample.starts_segment(c, i) || (broken && broken->gone(i))) continue;
      const double l = (x.at(sample.next(c, i)) - x.at(i)).norm();
      if (l < 0.1 * sample.rest_length[i])
        throw SolverError(fmt::format(
            "t = {:.6g} s: segment {} of cell {} has collapsed to {:.3g} of its rest length; load more slowly, or "
            "make the wall stiffer",
            time, i, c, l / sample.rest_length[i]));
    }
    if (!sample.closed[c] || !(sample.rest_area[c] > 0) || (broken && broken->opened(c))) continue;
    double twice = 0;
    const Vec2 origin = x.at(sample.cell_begin[c]);
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i)
      twice += cross(x.at(i) - origin, x.at(sample.next(c, i)) - origin);
    if (0.5 * twice < 0.02 * sample.rest_area[c])
      throw SolverError(fmt::format("t = {:.6g} s: cell {} has {:.3g} of its rest area left, and would turn inside out",
                                    time, c, 0.5 * twice / sample.rest_area[c]));
  }
  if (model.links)
    if (const auto crushed = model.links->crushed(x))
      throw SolverError(fmt::format(
          "t = {:.6g} s: link {} (nodes {} and {}) has been pressed past zero distance; make links or walls stiffer",
          time, *crushed, sample.links[*crushed].a, sample.links[*crushed].b));
  if (model.contacts)
    if (const auto fault = model.contacts->fault(x)) throw SolverError(fmt::format("t = {:.6g} s: {}", time, *fault));
}

}  // namespace lamella
