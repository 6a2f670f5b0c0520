#include "simulator/loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "generator/sample/errors.h"
#include "generator/sample/selection.h"

namespace lamella {
namespace {

const char* kSideName[4] = {"left", "right", "bottom", "top"};

Selection on_side(int side) {
  Selection selection;
  selection.side = kSideName[side];
  return selection;
}

/// The two grips of a [loading] section: the fixed one on the left or bottom, the moving one opposite.
std::vector<Load> grips(const Sample& sample, const Stage& stage, const LoadingScene& loading) {
  const int axis = loading.axis == "x" ? 0 : 1;
  if (sample.periodic[axis])
    throw SceneError(fmt::format(
        "loading.axis: the sample repeats along {0} (sample.periodic), where it has no sides that grips could hold{1}",
        loading.axis,
        sample.periodic[1 - axis] ? ", nor anywhere else; a sample that repeats both ways can be made, but not pulled: "
                                    "give sample.periodic = \"x\" or \"y\", and pull across it"
                                  : fmt::format("; pull along {}", axis == 0 ? "y" : "x")));
  const bool shear = loading.kind == "shear";
  const Gauge gauge = [&] {
    Load low, high;
    low.nodes = select_nodes(sample, on_side(2 * axis));
    high.nodes = select_nodes(sample, on_side(2 * axis + 1));
    return measure_gauge(sample, stage, {low, high});
  }();
  std::vector<Load> loads(2);
  for (int g = 0; g < 2; ++g) {
    Load& load = loads[g];
    load.name = g == 0 ? "fixed grip" : "moving grip";
    load.nodes = select_nodes(sample, on_side(2 * axis + g));
    load.grip = true;
    load.holds[axis] = true;
    load.holds[1 - axis] = shear || !loading.normal_only;
    const double share = loading.both ? (g == 0 ? -0.5 : 0.5) : (g == 0 ? 0.0 : 1.0);
    load.velocity[shear ? 1 - axis : axis] = share * gauge.speed;
    load.factor = 0;
  }
  return loads;
}

Load from_scene(const Sample& sample, const LoadScene& scene) {
  Load load;
  load.name = scene.name;
  load.nodes = select_nodes(sample, scene.nodes);
  load.ramp = scene.ramp;
  load.stop_force = scene.stop_force;
  const std::optional<double> velocity[2] = {scene.velocity_x, scene.velocity_y};
  for (int c = 0; c < 2; ++c)
    if (velocity[c]) load.holds[c] = true, load.velocity[c] = *velocity[c];
  const Vec2 total(scene.force_x.value_or(0), scene.force_y.value_or(0));
  const Vec2 line(scene.line_force_x.value_or(0), scene.line_force_y.value_or(0));
  load.pushes_along[0] = scene.force_x || scene.line_force_x;
  load.pushes_along[1] = scene.force_y || scene.line_force_y;
  load.pushes = load.pushes_along[0] || load.pushes_along[1];
  if (load.pushes) {
    const auto cell_of = cell_of_node(sample);
    for (Index i : load.nodes) {
      const Index c = cell_of[i], before = sample.prev(c, i);
      double length = sample.rest_length[i];
      if (sample.starts_segment(c, before)) length += sample.rest_length[before];
      load.force.push_back(total / static_cast<double>(load.nodes.size()) + 0.5 * length * line);
    }
  }
  return load;
}

void refuse_contradictions(const Sample& sample, const std::vector<Load>& loads) {
  std::vector<std::string> faults;
  std::vector<int> holder[2] = {std::vector<int>(sample.nodes(), -1), std::vector<int>(sample.nodes(), -1)};
  for (int l = 0; l < static_cast<int>(loads.size()); ++l)
    for (int c = 0; c < 2; ++c) {
      if (!loads[l].holds[c]) continue;
      for (Index i : loads[l].nodes) {
        if (holder[c][i] >= 0) {
          faults.push_back(
              fmt::format("loads: '{}' and '{}' both prescribe the {} velocity of node {}; let one of them go, "
                          "or select nodes that do not overlap",
                          loads[holder[c][i]].name, loads[l].name, c == 0 ? "x" : "y", i));
          break;
        }
        holder[c][i] = l;
      }
    }
  if (!faults.empty()) throw SceneError(std::move(faults));
}

/// Names may be any text; those of columns are words of letters, digits, '-' and '_'.
std::string column_word(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
  return name;
}

}  // namespace

std::vector<LoadColumn> load_columns(const std::vector<Load>& loads) {
  std::vector<LoadColumn> columns;
  for (std::size_t l = 0; l < loads.size(); ++l) {
    if (loads[l].grip) continue;
    const std::string word = column_word(loads[l].name);
    for (std::size_t k = 0; k < l; ++k)
      if (!loads[k].grip && column_word(loads[k].name) == word)
        throw SceneError(
            fmt::format("loads: '{}' and '{}' would share columns of the response, ..._{}; rename one of them",
                        loads[k].name, loads[l].name, word));
    for (int c = 0; c < 2; ++c) {
      const std::string of = fmt::format("{}_{}", c == 0 ? "x" : "y", word);
      if (loads[l].holds[c] || loads[l].pushes_along[c]) columns.push_back({"force_" + of, "N", l, c, false});
      if (loads[l].holds[c]) columns.push_back({"moved_" + of, "m", l, c, true});
    }
  }
  return columns;
}

double mean_displacement(const Sample& sample, const Field& x, const Load& load, int component) {
  double sum = 0;
  for (Index i : load.nodes) sum += x.at(i)[component] - sample.x[i][component];
  return sum / static_cast<double>(load.nodes.size());
}

std::vector<Load> build_loads(const Sample& sample, const Stage& stage) {
  std::vector<Load> loads;
  if (stage.loading) loads = grips(sample, stage, *stage.loading);
  for (const LoadScene& scene : stage.loads) loads.push_back(from_scene(sample, scene));
  for (Load& load : loads) {
    if (!std::is_sorted(load.nodes.begin(), load.nodes.end())) {
      std::vector<std::pair<Index, Vec2>> both;
      for (std::size_t k = 0; k < load.nodes.size(); ++k)
        both.emplace_back(load.nodes[k], load.pushes ? load.force[k] : Vec2(0, 0));
      std::sort(both.begin(), both.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      for (std::size_t k = 0; k < both.size(); ++k) {
        load.nodes[k] = both[k].first;
        if (load.pushes) load.force[k] = both[k].second;
      }
    }
  }
  refuse_contradictions(sample, loads);
  return loads;
}

Gauge measure_gauge(const Sample& sample, const Stage& stage, const std::vector<Load>& loads) {
  Gauge gauge;
  if (!stage.loading || loads.size() < 2) return gauge;
  const LoadingScene& loading = *stage.loading;
  gauge.axis = loading.axis == "x" ? 0 : 1;
  gauge.component = loading.kind == "shear" ? 1 - gauge.axis : gauge.axis;
  double low = 0, high = 0;
  for (Index i : loads[0].nodes) low += sample.x[i][gauge.axis] / static_cast<double>(loads[0].nodes.size());
  for (Index i : loads[1].nodes) high += sample.x[i][gauge.axis] / static_cast<double>(loads[1].nodes.size());
  gauge.length = high - low;
  gauge.width = sample.box.size()[1 - gauge.axis];
  gauge.depth = stage.cell("cells").depth;
  if (!(gauge.length > 0) || !(gauge.width > 0))
    throw SceneError(fmt::format(
        "loading: the grips lie {:.3g} m apart along {} and the box is {:.3g} m wide; both must be positive",
        gauge.length, loading.axis, gauge.width));
  const double speed = loading.speed ? *loading.speed : loading.strain_rate.value_or(0) * gauge.length;
  gauge.speed = loading.kind == "compression" ? -std::abs(speed) : std::abs(speed);
  return gauge;
}

}  // namespace lamella
