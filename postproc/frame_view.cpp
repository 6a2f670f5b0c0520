#include "postproc/frame_view.h"

namespace lamella {

FrameView::FrameView(const Sample& of, const Frame& at) : sample(of), frame(at) {
  const std::vector<double>& flat = frame.arrays.doubles("x");
  x.reserve(flat.size() / 2);
  for (std::size_t i = 0; i + 1 < flat.size(); i += 2) x.emplace_back(flat[i], flat[i + 1]);
  link_intact = ints("link_intact");
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
