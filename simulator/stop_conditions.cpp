#include "simulator/stop_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "generator/sample/errors.h"
#include "generator/sample/union_find.h"
#include "generator/sample/voids.h"
#include "generator/sample/way_round.h"

namespace lamella {

StopConditions::StopConditions(const Stage& stage, const Model& model, const std::vector<Load>& loads, const Field& x)
    : stop_(stage.stop), model_(model), loads_(loads) {
  if (!stop_.compaction && !stop_.void_ratio) return;
  const Sample& sample = model.sample;
  const auto room = room_between_walls(sample, sample.x), now = room_between_walls(sample, points_of(x));
  if (!room || !now)
    throw SceneError(fmt::format(
        "stop.{}: needs closed cells between walls on all four sides: open chains along x and y, such as plates",
        stop_.compaction ? "compaction" : "void_ratio"));
  sample_room_ = room->area();
  history_.loosens = stop_.compaction && compaction(*now) > *stop_.compaction;
}

std::optional<std::string> StopConditions::reason(const Now& now) {
  const double magnitude = std::abs(now.stress);
  history_.peak_stress = std::max(history_.peak_stress, magnitude);
  if (stop_.time && now.since >= *stop_.time * (1 - 1e-9)) return fmt::format("time {:.4g} s reached", *stop_.time);
  const bool damaged = now.broken > 0;
  if (stop_.stress_drop && damaged && magnitude < *stop_.stress_drop * history_.peak_stress)
    return fmt::format("stress fell below {:.0f} % of its peak {:.4g} Pa", 100 * *stop_.stress_drop,
                       history_.peak_stress);
  if (stop_.separated && damaged && separated())
    return pulled_box() ? fmt::format("separated: no path of shells and intact links goes round the box along {}",
                                      *pulled_box() == 0 ? "x" : "y")
                        : "separated: no path of shells and intact links joins the grips";
  if (stop_.at_rest && !now.first && now.unbalanced < *stop_.at_rest)
    return fmt::format("at rest: relative unbalanced force {:.2g}", now.unbalanced);
  for (std::size_t l = 0; l < loads_.size(); ++l)
    if (loads_[l].stop_force && now.load_force[l].norm() > *loads_[l].stop_force)
      return fmt::format("load '{}' exerts {:.4g} N", loads_[l].name, now.load_force[l].norm());
  return now.packed;
}

std::optional<std::string> StopConditions::packed(const Field& field, double time) const {
  if (!(sample_room_ > 0)) return std::nullopt;
  const std::vector<Vec2> x = points_of(field);
  const auto room = room_between_walls(model_.sample, x);
  if (!room) throw SolverError(fmt::format("t = {:.6g} s: there is no room left between the walls", time));
  if (const auto& asked = stop_.compaction)
    if (const double reached = compaction(*room); history_.loosens ? reached <= *asked : reached >= *asked)
      return fmt::format("compaction {:.4g} reached", reached);
  if (const auto& asked = stop_.void_ratio)
    if (const double reached = void_ratio(model_.sample, x, *room); reached < *asked)
      return fmt::format("void ratio {:.4g} reached", reached);
  return std::nullopt;
}

std::vector<Index> parts_of(const Model& model) {
  const Sample& sample = model.sample;
  const Pieces pieces = pieces_of(sample, model.rupture ? &model.rupture->broken() : nullptr);
  UnionFind joined(pieces.count);
  if (model.links)
    for (std::size_t l = 0; l < sample.links.size(); ++l)
      if (model.links->intact(static_cast<Index>(l)))
        joined.join(pieces.of_node[sample.links[l].a], pieces.of_node[sample.links[l].b]);
  std::vector<Index> part(sample.nodes());
  for (Index i = 0; i < sample.nodes(); ++i) part[i] = joined.root(pieces.of_node[i]);
  return part;
}

std::optional<int> StopConditions::pulled_box() const {
  if (loads_.empty() || !loads_[0].box) return std::nullopt;
  return loads_[0].velocity.x() != 0 ? 0 : 1;
}

bool StopConditions::separated() const {
  if (const auto axis = pulled_box()) return !joined_round(model_, *axis);
  const std::vector<Index> part = parts_of(model_);
  std::vector<std::uint8_t> low(part.size(), 0);
  for (Index i : loads_[0].nodes) low[part[i]] = 1;
  return std::none_of(loads_[1].nodes.begin(), loads_[1].nodes.end(), [&](Index i) { return low[part[i]] != 0; });
}

bool joined_round(const Model& model, int axis) {
  const Sample& sample = model.sample;
  const Pieces pieces = pieces_of(sample, model.rupture ? &model.rupture->broken() : nullptr);
  std::vector<Joint> joints;
  if (model.links)
    for (std::size_t l = 0; l < sample.links.size(); ++l)
      if (model.links->intact(static_cast<Index>(l)))
        joints.push_back({pieces.of_node[sample.links[l].a], pieces.of_node[sample.links[l].b],
                          sample.link_image.empty() ? Image{0, 0} : sample.link_image[l]});
  return goes_round(pieces.count, joints, axis);
}

std::optional<std::string> unheld_load(const Model& model, const std::vector<Load>& loads) {
  const std::vector<Index> part = parts_of(model);
  for (int c = 0; c < 2; ++c) {
    std::vector<std::uint8_t> held(part.size(), 0);
    for (const Load& load : loads)
      if (load.holds[c])
        for (Index i : load.nodes) held[part[i]] = 1;
    for (const Load& load : loads)
      if (load.pushes_along[c])
        for (std::size_t k = 0; k < load.nodes.size(); ++k)
          if (load.force[k][c] != 0 && !held[part[load.nodes[k]]]) return load.name;
  }
  return std::nullopt;
}

}  // namespace lamella
