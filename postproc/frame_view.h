// One frame together with its sample: what every derived quantity is computed from.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "generator/sample/broken_bars.h"
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

  /// Null where no bar is broken.
  const BrokenBars* broken_bars() const { return broken ? &*broken : nullptr; }
  bool gone(Index segment) const { return broken && broken->gone(segment); }
  /// A closed cell that still is one: not opened by a broken bar.
  bool closed(Index cell) const { return sample.closed[cell] && !(broken && broken->opened(cell)); }
  /// The link with the tangent that broken bars leave it; as it was where they leave none.
  Link link(Index l) const;

  /// Lengths of the box: those of the sample, unless the frame says that they have changed [m].
  Vec2 box_size() const;
  bool box_moves() const { return has("box_size"); }
  /// By which b of a link is displaced where it faces a [m].
  Vec2 displaced(std::size_t link) const;

  const Sample& sample;
  const Frame& frame;
  std::vector<Vec2> x;  // positions of the centre lines [m]

 private:
  const std::vector<std::int32_t>* link_intact = nullptr;
  std::optional<BrokenBars> broken;
};

}  // namespace lamella
