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
    throw SceneError(
        fmt::format("loading.axis: the sample repeats along {} (sample.periodic), where it has no sides that grips "
                    "could hold; pull "
                    "along {}",
                    loading.axis, axis == 0 ? "y" : "x"));
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

/// A box has lengths along x and y and nothing else: what needs sides, or a frame that is at rest while nodes are carried along, has no meaning.
void refuse_on_box(const Sample& sample, const Stage& stage, const LoadingScene& loading) {
  std::vector<std::string> faults;
  const auto at = [&](int line) {
    if (stage.file.empty()) return std::string();
    return line > 0 ? fmt::format("{}:{}: ", stage.file, line) : stage.file + ": ";
  };
  const auto refuse = [&](bool present, int line, const std::string& key, const std::string& why) {
    if (present)
      faults.push_back(fmt::format(
          "{}{}: the sample repeats both ways (sample.periodic = \"xy\"), so that its box is pulled, which {}",
          at(line), key, why));
  };
  refuse(loading.kind == "shear", loading.line, "loading.kind",
         "has no sides to shear; give \"tension\" or \"compression\", or a sample that repeats along x or y alone");
  refuse(loading.both, loading.line, "loading.both", "has no grips: it grows about its middle anyhow; remove it");
  if (!stage.loads.empty())
    refuse(true, stage.loads.front().line, "loads",
           "carries all nodes along: none can be held or pushed beside it; remove [[loads]]");
  refuse(stage.gravity.has_value(), 0, "gravity", "has nothing that would bear its weight; remove [gravity]");
  const Vec2 size = sample.box.size();
  if (!(size.x() > 0) || !(size.y() > 0))
    faults.push_back(
        fmt::format("loading: the sample's box is {:.3g} m by {:.3g} m; both must be positive", size.x(), size.y()));
  if (!faults.empty()) throw SceneError(std::move(faults));
}

Load pulled_box(const Sample& sample, const Stage& stage, const LoadingScene& loading) {
  refuse_on_box(sample, stage, loading);
  Load load = held_box(sample);
  load.name = "box";
  load.holds[loading.axis == "x" ? 1 : 0] = !loading.normal_only;
  const Gauge gauge = measure_gauge(sample, stage, {load});
  load.velocity[gauge.axis] = gauge.speed;
  return load;
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
  std::vector<int> holder[2] = {std::vector<int>(sample.nodes() + 1, -1), std::vector<int>(sample.nodes() + 1, -1)};
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

bool pulls_box(const Sample& sample, const Stage& stage) {
  return stage.loading && sample.periodic[0] && sample.periodic[1];
}

Load held_box(const Sample& sample) {
  Load load;
  load.name = "box that is held";
  load.nodes = {sample.nodes()};
  load.holds[0] = load.holds[1] = true;
  load.grip = load.box = true;
  load.factor = 0;
  return load;
}

std::array<double, 2> grip_forces(const Gauge& gauge, const std::vector<Vec2>& load_force) {
  if (gauge.box) return {load_force[0][gauge.component], load_force[0][gauge.component]};
  return {-load_force[0][gauge.component], load_force[1][gauge.component]};
}

std::vector<Load> build_loads(const Sample& sample, const Stage& stage) {
  std::vector<Load> loads;
  if (pulls_box(sample, stage))
    loads.push_back(pulled_box(sample, stage, *stage.loading));
  else if (stage.loading)
    loads = grips(sample, stage, *stage.loading);
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
  if (!stage.loading || loads.empty()) return gauge;
  const LoadingScene& loading = *stage.loading;
  gauge.axis = loading.axis == "x" ? 0 : 1;
  gauge.component = loading.kind == "shear" ? 1 - gauge.axis : gauge.axis;
  gauge.box = loads[0].box;
  const auto mean = [&](const Load& load) {
    double sum = 0;
    for (Index i : load.nodes) sum += sample.x[i][gauge.axis] / static_cast<double>(load.nodes.size());
    return sum;
  };
  gauge.length = gauge.box ? sample.box.size()[gauge.axis] : mean(loads.at(1)) - mean(loads[0]);
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
