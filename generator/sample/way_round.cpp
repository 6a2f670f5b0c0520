#include "generator/sample/way_round.h"

#include <utility>

namespace lamella {

// A walk gives every part the image in which it is met first; a joint that leads to another image of a part already met closes a way
// round the box.
bool goes_round(Index parts, const std::vector<Joint>& joints, int axis) {
  std::vector<std::vector<std::pair<Index, int>>> neighbours(parts);
  for (const Joint& joint : joints) {
    const int step = joint.image[static_cast<std::size_t>(axis)];
    neighbours[joint.a].emplace_back(joint.b, step);
    neighbours[joint.b].emplace_back(joint.a, -step);
  }
  std::vector<int> at(parts, 0);
  std::vector<std::uint8_t> met(parts, 0);
  std::vector<Index> open;
  for (Index first = 0; first < parts; ++first) {
    if (met[first]) continue;
    met[first] = 1, open.push_back(first);
    while (!open.empty()) {
      const Index part = open.back();
      open.pop_back();
      for (const auto& [next, step] : neighbours[part]) {
        const int there = at[part] + step;
        if (met[next] && at[next] != there) return true;
        if (met[next]) continue;
        met[next] = 1, at[next] = there, open.push_back(next);
      }
    }
  }
  return false;
}

}  // namespace lamella
