#include "simulator/trajectory/extract.h"

#include <fmt/format.h>

#include "generator/sample/errors.h"

namespace lamella {

Sample extract_sample(const TrajectoryReader& reader, int frame) {
  const int at = frame < 0 ? reader.frames() + frame : frame;
  if (at < 0 || at >= reader.frames())
    throw SceneError(fmt::format("frame {}: the trajectory has {} frames; give 0 to {}, or -1 for the last", frame,
                                 reader.frames(), reader.frames() - 1));
  Sample sample = reader.sample();
  const ArraySet arrays = reader.frame(at).arrays;
  const std::vector<double>& x = arrays.doubles("x");
  for (std::size_t i = 0; i < sample.x.size(); ++i) sample.x[i] = {x[2 * i], x[2 * i + 1]};
  if (arrays.find("link_intact")) {
    const std::vector<std::int32_t>& intact = arrays.ints("link_intact");
    std::vector<Link> held;
    std::vector<double> strength;
    for (std::size_t l = 0; l < sample.links.size(); ++l) {
      if (intact[l] == 0) continue;
      held.push_back(sample.links[l]);
      if (!sample.link_strength.empty()) strength.push_back(sample.link_strength[l]);
    }
    sample.links = std::move(held);
    sample.link_strength = std::move(strength);
  }
  return sample;
}

}  // namespace lamella
