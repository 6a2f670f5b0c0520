// One frame together with its sample: what every derived quantity is computed from.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "generator/sample/sample.h"
#include "simulator/trajectory/trajectory.h"

namespace lamella {

struct FrameView {
  FrameView(const Sample& of, const Frame& at);

  /// Null where the scene has no such array.
  const std::vector<double>* doubles(const std::string& name) const;
  const std::vector<std::int32_t>* ints(const std::string& name) const;
  bool has(const std::string& name) const { return frame.arrays.find(name) != nullptr; }
  /// A link holds unless the frame says that it is broken.
  bool intact(Index link) const { return !link_intact || (*link_intact)[link] != 0; }

  const Sample& sample;
  const Frame& frame;
  std::vector<Vec2> x;  // positions of the centre lines [m]

 private:
  const std::vector<std::int32_t>* link_intact = nullptr;
};

}  // namespace lamella
