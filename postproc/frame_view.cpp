#include "postproc/frame_view.h"

#include <algorithm>

namespace lamella {

FrameView::FrameView(const Sample& of, const Frame& at) : sample(of), frame(at) {
  const std::vector<double>& flat = frame.arrays.doubles("x");
  x.reserve(flat.size() / 2);
  for (std::size_t i = 0; i + 1 < flat.size(); i += 2) x.emplace_back(flat[i], flat[i + 1]);
  link_intact = ints("link_intact");
  const std::vector<std::int32_t>* bars = ints("bar_broken");
  if (!bars || std::none_of(bars->begin(), bars->end(), [](std::int32_t b) { return b != 0; })) return;
  broken.emplace(sample);
  for (Index c = 0; c < sample.cells(); ++c)
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i)
      if ((*bars)[i]) broken->add(c, i);
}

Link FrameView::link(Index l) const {
  if (!broken) return sample.links[l];
  const Link standing = with_standing_tangent(sample.links[l], *broken);
  return has_tangent(standing) ? standing : sample.links[l];
}

Vec2 FrameView::box_size() const {
  const std::vector<double>* size = doubles("box_size");
  return size ? Vec2(size->at(0), size->at(1)) : sample.box.size();
}

Vec2 FrameView::displaced(std::size_t l) const {
  if (sample.link_image.empty()) return Vec2(0, 0);
  const Image& image = sample.link_image[l];
  return box_size().cwiseProduct(Vec2(image[0], image[1]));
}

const std::vector<double>* FrameView::doubles(const std::string& name) const {
  const NamedArray* array = frame.arrays.find(name);
  return array ? std::get_if<std::vector<double>>(&array->data) : nullptr;
}

const std::vector<std::int32_t>* FrameView::ints(const std::string& name) const {
  const NamedArray* array = frame.arrays.find(name);
  return array ? std::get_if<std::vector<std::int32_t>>(&array->data) : nullptr;
}

}  // namespace lamella
