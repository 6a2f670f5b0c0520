// What rows cannot say: keys that contradict each other, or need each other. Every check looks at one section.
#pragma once
#include <string>

#include "generator/sample/scene.h"
#include "generator/sample/scene_document.h"

namespace lamella {

void check_alternatives(const Value& table, const std::string& path, Faults& faults);
void check_sample_section(const Value& table, const SampleScene& sample, Faults& faults);
/// Domain, layers, gradient, stretch and bricks.
void check_tissue_sections(const Value& table, const SampleScene& sample, Faults& faults);
void check_layer(const Value& table, const std::string& path, const LayerScene& layer, Faults& faults);
void check_mixture(const Value& table, const std::string& path, const MixtureScene& part, Faults& faults);
void check_hole(const Value& table, const std::string& path, const HoleScene& hole, Faults& faults);
void check_shape(const Value& table, const std::string& path, const ShapeScene& shape, Faults& faults);
/// What the generator needs; and, where the scene is simulated, stiffness and mass.
enum class Needs { geometry, mechanics };
void check_cell(const Value& table, const std::string& path, Needs needs, Faults& faults);
void check_core(const Value& table, const std::string& path, const CoreScene& core, Faults& faults);
void check_link(const Value& table, const std::string& path, Faults& faults);
void check_load(const Value& table, const std::string& path, Faults& faults);
void check_initial(const Value& table, const std::string& path, Faults& faults);
void check_selection(const Value& table, const std::string& path, Faults& faults);
void check_loading(const Value& table, const LoadingScene& loading, Faults& faults);
/// Sections of one stage against each other. `at` is the stage's table, `path` "" or "stages.NAME".
void check_stage(const Value& at, const std::string& path, const Stage& stage, Faults& faults);
/// Groups that sections and loads name, against those that the sample has.
void check_groups(const Value& at, const Scene& scene, Faults& faults);
/// What is given directly, against a thickness of walls that varies.
void check_varied_thickness(const Value& at, const Scene& scene, Faults& faults);

}  // namespace lamella
