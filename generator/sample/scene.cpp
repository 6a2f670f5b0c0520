#include "generator/sample/scene.h"

#include <fmt/format.h>

#include <cmath>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

/// What a group lacks, when the scene was only meant to make a sample.
[[noreturn]] void lacks(const CellScene& cell, const char* what) {
  throw SceneError(fmt::format("line {}: cells: {}", cell.line, what));
}

/// Stress at which a wall flows: in plane strain von Mises' criterion gives 2 / sqrt 3 times that of the uniaxial test.
double flow_stress(const CellScene& cell) {
  return *cell.yield_stress * (cell.plane == "strain" ? 2 / std::sqrt(3.0) : 1.0);
}

}  // namespace

double CellScene::plane_modulus() const {
  if (!young) lacks(*this, "young is missing; give Young's modulus of the wall");
  return plane == "strain" ? *young / (1 - poisson * poisson) : *young;
}

double CellScene::axial() const {
  if (axial_rigidity) return *axial_rigidity;
  if (!young) lacks(*this, "stiffness is missing; give young, or axial_rigidity and bending_rigidity");
  return plane_modulus() * thickness * depth;
}

double CellScene::bending() const {
  if (bending_rigidity) return *bending_rigidity;
  if (!young) lacks(*this, "stiffness is missing; give young, or axial_rigidity and bending_rigidity");
  return plane_modulus() * depth * thickness * thickness * thickness / 12;
}

double CellScene::line_density() const {
  if (mass_per_length) return *mass_per_length;
  if (!density) lacks(*this, "mass is missing; give density, or mass_per_length");
  return *density * thickness * depth;
}

double CellScene::outline_radius() const { return radius.value_or(thickness / 2); }

std::optional<double> CellScene::bar_yield() const {
  if (yield_stress) return flow_stress(*this) * thickness * depth;
  return yield_force;
}

std::optional<double> CellScene::hinge_yield() const {
  if (yield_stress) return flow_stress(*this) * depth * thickness * thickness / 4;
  return yield_moment;
}

void Stage::slow_down() {
  const double factor = run.slowdown;
  if (factor == 1) return;
  const auto divide = [&](std::optional<double>& rate) {
    if (rate) *rate /= factor;
  };
  if (loading) divide(loading->strain_rate), divide(loading->speed);
  for (LoadScene& load : loads) divide(load.velocity_x), divide(load.velocity_y), load.ramp *= factor;
  if (stop.time) *stop.time *= factor;
  for (auto& [group, section] : cells)
    if (section.core)
      for (Vec2& point : section.core->pressure_history) point.x() *= factor;
}

std::optional<double> CellScene::bar_strength() const {
  if (break_stress) return *break_stress * thickness * depth;
  return break_force;
}

const CellScene& Stage::cell(const std::string& group) const {
  auto found = cells.find(group);
  if (found == cells.end()) found = cells.find("cells");
  if (found == cells.end())
    throw SceneError(fmt::format(
        "stage \"{}\": no parameters for the cells of group \"{}\"; give [cells] or [cells.{}]", name, group, group));
  return found->second;
}

std::filesystem::path Scene::resolve(const std::string& file) const {
  const std::filesystem::path named(file);
  return named.is_absolute() ? named : path.parent_path() / named;
}

}  // namespace lamella
