// Loads: groups of nodes whose velocity or force is prescribed, component by component. The two grips of a [loading] section are
// loads too.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "generator/sample/sample.h"
#include "generator/sample/scene.h"
#include "simulator/positions.h"

namespace lamella {

struct Load {
  std::string name;
  std::vector<Index> nodes;        // ascending
  bool holds[2] = {false, false};  // velocity prescribed, per component
  bool pushes = false;             // force prescribed
  bool pushes_along[2] = {false, false};
  Vec2 velocity = Vec2::Zero();      // in full [m/s]
  std::vector<Vec2> force;           // on each node, in full [N]; empty unless `pushes`
  double ramp = 0;                   // [s]
  double factor = 1;                 // of the full value in this step; set by the driver
  bool grip = false;                 // belongs to [loading]: its factor is the loading's
  bool box = false;                  // a grip that holds no node, but the lengths of a box (moving_box.h)
  std::optional<double> stop_force;  // the stage ends when it exerts more [N]
};

/// Adds what the loads push with, each `factor_of(load)` times its full force [N].
template <class Factor>
void add_pushes(const std::vector<Load>& loads, const Factor& factor_of, Field& f) {
  for (const Load& load : loads) {
    if (!load.pushes) continue;
    const double factor = factor_of(load);
    for (std::size_t k = 0; k < load.nodes.size(); ++k) f.add(load.nodes[k], factor * load.force[k]);
  }
}

/// Smooth growth from 0 to 1 over [0, 1] with zero slope at both ends: a load that starts without a jolt.
inline double smooth_ramp(double u) { return u <= 0 ? 0.0 : u >= 1 ? 1.0 : u * u * (3 - 2 * u); }

/// The loads of a stage: the grips first (fixed one, then moving one), then [[loads]]. In a sample that repeats both ways the box itself is
/// pulled: one load, whose node is the box's entry. Throws SceneError where a node is held twice in one component, a selection is
/// empty, or a box is asked for what it does not have.
std::vector<Load> build_loads(const Sample& sample, const Stage& stage);
/// Whether a stage pulls the box, so that fields need its entry.
bool pulls_box(const Sample& sample, const Stage& stage);
/// Holds a box that an earlier stage has pulled, in both directions.
Load held_box(const Sample& sample);

/// A column of the response that a load of [[loads]] fills (docs/formats.md): force_x_NAME, moved_y_NAME.
struct LoadColumn {
  std::string name, unit;
  std::size_t load = 0;  // of the stage's
  int component = 0;     // 0 x, 1 y
  bool displacement = false;
};
/// Two columns of each component whose velocity is prescribed, one of each component with a force; none of grips, which have their own.
/// Throws SceneError where two loads would fill one column.
std::vector<LoadColumn> load_columns(const std::vector<Load>& loads);
/// Mean displacement of the load's nodes from the sample [m].
double mean_displacement(const Sample& sample, const Field& x, const Load& load, int component);

/// Where the grips are: measures of the loading that strain and stress refer to (physics: grips).
struct Gauge {
  int axis = 1;       // 0 x, 1 y
  int component = 1;  // of the grips' motion: the axis, or across it in shear
  double length = 0;  // initial distance of the gripped centre lines [m]
  double width = 0;   // of the box across the load [m]
  double depth = 1;   // s of the cells [m]
  double speed = 0;   // of the grips' separation in full [m/s]; positive opens
  bool box = false;   // there are no grips: the length is that of the box, and its growth is the separation
};
/// What the two grips pull with, the fixed one and the moving one [N], from what each load exerts on the sample: positive pulls apart. A box
/// pulls with one force, which does the work of its growth.
std::array<double, 2> grip_forces(const Gauge& gauge, const std::vector<Vec2>& load_force);
Gauge measure_gauge(const Sample& sample, const Stage& stage, const std::vector<Load>& loads);

}  // namespace lamella
