#include "simulator/moving_box.h"

#include <array>

namespace lamella {
namespace {

Field carried(const Sample& sample, Field field, double sign) {
  if (!box_moves(sample, field)) return field;
  const Vec2 growth = box_growth(sample, field);
  for (std::size_t i = 0; i < sample.x.size(); ++i) field.add(i, sign * carried_share(sample, i).cwiseProduct(growth));
  return field;
}

}  // namespace

Field relative(const Sample& sample, Field x) { return carried(sample, std::move(x), -1); }
Field absolute(const Sample& sample, Field w) { return carried(sample, std::move(w), +1); }

void make_relative(const Sample& sample, Field& f) {
  if (!box_moves(sample, f)) return;
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < sample.x.size(); ++i) sum += carried_share(sample, i).cwiseProduct(f.at(i));
  f.add(sample.x.size(), sum);
}

std::vector<double> rows_of_nodes(const Sample& sample, const Field& field) {
  std::vector<double> rows = rows_from(field);
  rows.resize(2 * sample.x.size());
  return rows;
}

void append_box(Field& field, const Vec2& entry) {
  field.x.push_back(entry.x());
  field.y.push_back(entry.y());
}

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
