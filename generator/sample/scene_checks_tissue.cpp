// Keys of [sample] that contradict or need each other where a tissue fills a domain, varies, or is drawn out; and bricks.
#include <fmt/format.h>

#include <cmath>
#include <initializer_list>

#include "generator/sample/scene_checks.h"
#include "generator/sample/scene_values.h"

namespace lamella {
namespace {

/// One section, by its name in the file, and what is wrong with it.
class Section {
 public:
  Section(const Value& sample, const std::string& key, Faults& faults)
      : table_(sample.find(key)), path_(dotted("sample", key)), faults_(faults) {
    if (table_ && !table_->is_table()) table_ = nullptr;
  }
  explicit operator bool() const { return table_ != nullptr; }
  bool has(const std::string& key) const { return table_->find(key) != nullptr; }
  void fault(const std::string& key, const std::string& what) {
    const Value* value = table_->find(key);
    faults_.add(value ? *value : *table_, dotted(path_, key), what);
  }
  void fault(const std::string& what) { faults_.add(*table_, path_, what); }
  void require(const std::string& key, const std::string& kind) {
    if (!has(key)) fault(key, fmt::format("missing; a {} needs it", kind));
  }
  void refuse(std::initializer_list<const char*> keys, const std::string& kind) {
    for (const char* key : keys)
      if (has(key)) fault(key, fmt::format("does not belong to a {}; remove it", kind));
  }

 private:
  const Value* table_;
  std::string path_;
  Faults& faults_;
};

void check_domain(Section domain, const DomainScene& scene) {
  const std::string& kind = scene.kind;
  if (kind == "disk") {
    domain.require("radius", kind);
    domain.refuse({"inner_radius", "points"}, kind);
  } else if (kind == "ring") {
    domain.require("radius", kind);
    domain.require("inner_radius", kind);
    domain.refuse({"points"}, kind);
    if (domain.has("radius") && domain.has("inner_radius") && !(scene.inner_radius < scene.radius))
      domain.fault("inner_radius", "is not below radius; give a smaller one");
  } else if (kind == "polygon") {
    domain.require("points", kind);
    domain.refuse({"radius", "inner_radius"}, kind);
    if (domain.has("points") && scene.points.size() < 3)
      domain.fault("points", fmt::format("has {} points; give three or more", scene.points.size()));
  }
}

constexpr double kLeastFactor = 0.05, kMostFactor = 20;  // as for the size of a layer

void check_gradient(Section gradient, const GradientScene& scene, const std::string& periodic) {
  if (periodic == "xy" ? scene.along != "radius" : periodic == scene.along)
    gradient.fault("along",
                   fmt::format("\"{}\": the sample repeats that way, and what changes would jump at its sides; "
                               "choose the other way, or remove sample.periodic",
                               scene.along));
  if (!gradient.has("size") && !gradient.has("thickness") && !gradient.has("strength"))
    gradient.fault("is empty; give size, thickness or strength as [[position, factor], ...]");
  for (const auto& [key, pairs] :
       {std::pair{"size", &scene.size}, {"thickness", &scene.thickness}, {"strength", &scene.strength}}) {
    if (gradient.has(key) && pairs->empty()) gradient.fault(key, "is empty; give [[position, factor], ...]");
    for (std::size_t k = 0; k < pairs->size(); ++k) {
      const Vec2& pair = (*pairs)[k];
      if (!(pair.y() > 0)) {
        gradient.fault(key, fmt::format("entry {}: the factor {:g} is not positive", k, pair.y()));
        break;
      }
      if (!(pair.y() >= kLeastFactor && pair.y() <= kMostFactor)) {
        gradient.fault(key, fmt::format("entry {}: the factor {:g} is not in {:g} to {:g}", k, pair.y(), kLeastFactor,
                                        kMostFactor));
        break;
      }
      if (k > 0 && !(pair.x() > (*pairs)[k - 1].x())) {
        gradient.fault(key, fmt::format("entry {}: positions must increase; {:g} m follows {:g} m", k, pair.x(),
                                        (*pairs)[k - 1].x()));
        break;
      }
    }
  }
}

}  // namespace

void check_tissue_sections(const Value& table, const SampleScene& sample, Faults& faults) {
  const auto at = [&](const std::string& key, const std::string& what) {
    const Value* value = table.find(key);
    faults.add(value ? *value : table, dotted("sample", key), what);
  };
  const auto has = [&](const char* key) { return table.find(key) != nullptr; };
  if (sample.kind == "bricks" && has("brick") && !(sample.brick.array() > 0).all())
    at("brick", "is not positive; give [width, height] of a brick");
  if (sample.kind != "tissue") return;
  const bool from_file = !sample.packing.file.empty();
  const bool repeats = sample.periodic != "none" || sample.packing.boundary != "walls";
  if (Section domain(table, "domain", faults); domain) {
    check_domain(domain, *sample.domain);
    if (has("width")) at("width", "contradicts the domain, which has its own size; remove width and height");
    if (sample.periodic != "none")
      domain.fault("has a boundary, and a sample that repeats has none; remove one of them");
  }
  const bool placed = sample.domain || has("width") || from_file;
  const auto needs_place = [&](Section section) {
    if (section && !placed)
      section.fault("refers to places in a box that follows from the disks; give width and height, or a domain");
  };
  if (Section gradient(table, "gradient", faults); gradient) {
    check_gradient(gradient, *sample.gradient, sample.periodic);
    needs_place(gradient);
    if (from_file && gradient.has("size"))
      gradient.fault("size", "contradicts packing.file, which gives the radii; keep one of them");
  }
  if (has("layers") && !placed)
    at("layers", "refer to places in a box that follows from the disks; give width and height, or a domain");
  for (const LayerScene& layer : sample.layers)
    if (from_file && layer.size != 1) {
      at("layers", "a size contradicts packing.file, which gives the radii; keep one of them");
      break;
    }
  if (Section stretch(table, "stretch", faults); stretch) {
    if (!sample.domain && !has("width"))
      stretch.fault("needs width and height, or a domain: it does not follow from the disks what it fills");
    if (sample.periodic == "none" && repeats)
      stretch.fault("squeezes disks whose packing repeats and whose sample does not; give sample.periodic");
    // sin(2 angle): zero along the axes
    if (sample.periodic != "none" && !(std::abs(std::sin(2 * sample.stretch->angle)) <= 1e-9))
      stretch.fault("angle", "is neither 0 nor 90 deg: other stretches squeeze a box that repeats to a parallelogram");
    if (sample.periodic != "none" && sample.areas && sample.areas->of == "inset")
      stretch.fault("draws out tiles, not their insets; give sample.areas.of = \"tile\"");
    if (from_file) stretch.fault("contradicts packing.file, whose disks are where they are; keep one of them");
  }
}

void check_varied_thickness(const Value& at, const Scene& scene, Faults& faults) {
  if (!scene.sample.gradient || scene.sample.gradient->thickness.empty()) return;
  for (const Stage& stage : scene.stages)
    for (const auto& [group, cell] : stage.cells)
      for (const auto& [given, key, instead] : {std::tuple{cell.axial_rigidity.has_value(), "axial_rigidity", "young"},
                                                {cell.bending_rigidity.has_value(), "bending_rigidity", "young"},
                                                {cell.mass_per_length.has_value(), "mass_per_length", "density"},
                                                {cell.yield_force.has_value(), "yield_force", "yield_stress"},
                                                {cell.yield_moment.has_value(), "yield_moment", "yield_stress"},
                                                {cell.break_force.has_value(), "break_force", "break_stress"}}) {
        if (!given) continue;
        Value place = at;
        place.members.clear();
        place.line = cell.line;
        faults.add(place, fmt::format("{}.{}", group == "cells" ? group : "cells." + group, key),
                   fmt::format("does not follow gradient.thickness, which varies from cell to cell; give {}", instead));
      }
}

}  // namespace lamella
