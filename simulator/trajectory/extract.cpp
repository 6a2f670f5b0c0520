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
  if (arrays.find("box_size")) {
    const std::vector<double>& size = arrays.doubles("box_size");
    const Vec2 middle = 0.5 * (sample.box.lo + sample.box.hi), half = 0.5 * Vec2(size.at(0), size.at(1));
    sample.box = {middle - half, middle + half};
  }
  if (arrays.find("link_intact")) {
    const std::vector<std::int32_t>& intact = arrays.ints("link_intact");
    std::vector<Link> held;
    std::vector<double> strength;
    std::vector<Image> image;
    for (std::size_t l = 0; l < sample.links.size(); ++l) {
      if (intact[l] == 0) continue;
      held.push_back(sample.links[l]);
      if (!sample.link_strength.empty()) strength.push_back(sample.link_strength[l]);
      if (!sample.link_image.empty()) image.push_back(sample.link_image[l]);
    }
    sample.links = std::move(held);
    sample.link_strength = std::move(strength);
    sample.link_image = std::move(image);
  }
  return sample;
}

}  // namespace lamella
