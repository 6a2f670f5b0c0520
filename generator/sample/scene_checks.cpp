#include "generator/sample/scene_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "generator/sample/scene_values.h"

namespace lamella {
namespace {

bool has(const Value& table, const std::string& key) { return table.find(key) != nullptr; }

/// At the value when there is one, else at its table.
void add_at(const Value& table, const std::string& path, const std::string& key, const std::string& what,
            Faults& faults) {
  const Value* value = table.find(key);
  faults.add(value ? *value : table, dotted(path, key), what);
}

void require(const Value& table, const std::string& path, const std::string& key, const std::string& why,
             Faults& faults) {
  if (!has(table, key)) faults.add(table, dotted(path, key), "missing; " + why);
}

void exclude(const Value& table, const std::string& path, const std::string& a, const std::string& b, Faults& faults) {
  if (has(table, a) && has(table, b))
    add_at(table, path, b, fmt::format("contradicts {}; give one of them", a), faults);
}

const Value& section_or_empty(const Value& table, const std::string& key) {
  static const Value empty;
  const Value* value = table.find(key);
  return value && value->is_table() ? *value : empty;
}

}  // namespace

void check_alternatives(const Value& table, const std::string& path, Faults& faults) {
  for (const Alternative& way : alternatives())
    for (const std::string& a : way.one)
      for (const std::string& b : way.other) exclude(table, path, a, b, faults);
}

void check_shape(const Value& table, const std::string& path, const ShapeScene& shape, Faults& faults) {
  const std::string of = "a " + shape.kind + " needs it";
  if (shape.kind == "chain" || shape.kind == "plate" || shape.kind == "box") {
    require(table, path, "from", of, faults);
    require(table, path, "to", of, faults);
    if (has(table, "from") && has(table, "to") && shape.from == shape.to)
      add_at(table, path, "to", "is the same point as from; give two points", faults);
  }
  if (shape.kind != "polygon") require(table, path, "segments", of, faults);
  if (shape.kind == "ring") {
    require(table, path, "size", of, faults);
    if (has(table, "segments") && shape.segments < 3)
      add_at(table, path, "segments", "a ring of fewer than 3 nodes has no inside; give 3 or more", faults);
  }
  if (shape.kind == "polygon") {
    require(table, path, "points", of, faults);
    const std::size_t least = shape.open ? 2 : 3;
    if (has(table, "points") && shape.points.size() < least)
      add_at(table, path, "points", fmt::format("has {} points; give at least {}", shape.points.size(), least), faults);
  } else {
    for (const char* key : {"points", "open"})
      if (has(table, key))
        add_at(table, path, key, fmt::format("belongs to kind = \"polygon\", not to a {}", shape.kind), faults);
  }
}

void check_layer(const Value& table, const std::string& path, const LayerScene& layer, Faults& faults) {
  if (has(table, "polygon")) {
    for (const char* key : {"along", "from", "to"}) exclude(table, path, "polygon", key, faults);
    if (layer.polygon.size() < 3)
      add_at(table, path, "polygon", "has fewer than three points; give three or more", faults);
  } else {
    require(table, path, "to", "where the layer ends, or a polygon", faults);
    if (has(table, "to") && !(layer.to > layer.from))
      add_at(table, path, "to", "is not beyond from; give a larger one", faults);
  }
}

void check_mixture(const Value& table, const std::string& path, const MixtureScene&, Faults& faults) {
  exclude(table, path, "share", "area_share", faults);
  if (!has(table, "share") && !has(table, "area_share"))
    faults.add(table, dotted(path, "share"), "missing; give share (by number) or area_share");
}

void check_hole(const Value& table, const std::string& path, const HoleScene& hole, Faults& faults) {
  exclude(table, path, "points", "radius", faults);
  if (has(table, "points")) {
    if (hole.points.size() < 3)
      add_at(table, path, "points", "has fewer than three points; give three or more", faults);
    return;
  }
  for (const char* key : {"centre", "radius"}) require(table, path, key, "a hole is circular, or has points", faults);
}

namespace {

/// A sample that repeats is made of a packing that does, along the same sides.
void check_packing_sides(const Value& packing, const SampleScene& sample, Faults& faults) {
  if (!has(packing, "boundary")) return;
  const std::string& boundary = sample.packing.boundary;
  const std::string asked = sample.periodic == "xy" ? "periodic" : "periodic_" + sample.periodic;
  if (sample.periodic != "none" && boundary != asked)
    add_at(packing, "sample.packing", "boundary",
           fmt::format("\"{}\" contradicts sample.periodic = \"{}\"; remove it, or give \"{}\"", boundary,
                       sample.periodic, asked),
           faults);
  if (sample.domain && boundary != "walls")
    add_at(packing, "sample.packing", "boundary", "contradicts sample.domain, which has walls; remove it", faults);
}

/// What belongs to one distribution only.
void check_sizes(const Value& table, const SizesScene& sizes, Faults& faults) {
  const std::string path = "sample.sizes";
  const std::string& kind = sizes.distribution;
  for (const char* of : {"table", "mixture"}) {
    if (kind == of)
      require(table, path, of, fmt::format("distribution = \"{}\" is made of it", of), faults);
    else if (has(table, of))
      add_at(table, path, of, fmt::format("contradicts distribution; use distribution = \"{}\"", of), faults);
  }
  if (kind == "table" || kind == "mixture" || kind == "file")
    for (const char* key : {"mean", "cv"})
      if (has(table, key)) add_at(table, path, key, fmt::format("follows from the {}; remove it", kind), faults);
}

}  // namespace

void check_sample_section(const Value& table, const SampleScene& sample, Faults& faults) {
  const std::string path = "sample";
  const std::string& kind = sample.kind;
  const auto belongs = [&](const std::string& key, std::initializer_list<const char*> kinds) {
    if (has(table, key) && std::none_of(kinds.begin(), kinds.end(), [&](const char* k) { return kind == k; }))
      add_at(table, path, key, fmt::format("belongs to kind = \"{}\", not to \"{}\"; remove it", *kinds.begin(), kind),
             faults);
  };
  belongs("ring_nodes", {"rings"});
  for (const char* key : {"side", "orientation"}) belongs(key, {"honeycomb"});
  for (const char* key : {"columns", "rows"}) belongs(key, {"honeycomb", "bricks"});
  for (const char* key : {"brick", "shift"}) belongs(key, {"bricks"});
  for (const char* key : {"domain", "areas", "layers", "gradient", "stretch"}) belongs(key, {"tissue"});
  belongs("periodic", {"tissue", "honeycomb", "bricks"});
  belongs("image", {"image"});
  for (const char* key : {"file", "outlines", "facing_tolerance", "scale"}) belongs(key, {"polygons"});
  for (const char* key : {"sizes", "packing"}) belongs(key, {"tissue", "rings"});
  belongs("walls", {"tissue", "honeycomb", "bricks", "polygons", "image", "rings", "shapes"});

  if (has(table, "width") != has(table, "height"))
    faults.add(table, dotted(path, has(table, "width") ? "height" : "width"), "missing; a box needs both, or neither");
  if (kind == "honeycomb")
    for (const char* key : {"columns", "rows", "side"}) require(table, path, key, "a honeycomb needs it", faults);
  if (kind == "bricks")
    for (const char* key : {"columns", "rows", "brick"}) require(table, path, key, "a brick wall needs it", faults);
  if (kind == "image") require(table, path, "image", "the picture, such as image = { file = \"labels.png\" }", faults);
  if (kind == "polygons") require(table, path, "file", "the text file of the polygons, `x y cell` a line", faults);
  if (kind == "shapes") require(table, path, "shapes", "list at least one [[sample.shapes]]", faults);

  const Value& walls = section_or_empty(table, "walls");
  if (kind != "rings" && kind != "shapes" && !has(walls, "spacing") && !has(walls, "segments"))
    faults.add(has(table, "walls") ? walls : table, "sample.walls.spacing",
               "missing; give the distance of mass points, or walls.segments, their number on a wall of mean length");

  const Value& packing = section_or_empty(table, "packing");
  const Value& sizes = section_or_empty(table, "sizes");
  if (has(packing, "file") && has(table, "sizes"))
    add_at(table, path, "sizes", "contradicts packing.file, which gives the radii; keep one of them", faults);
  check_packing_sides(packing, sample, faults);
  if (has(table, "sizes") && !has(packing, "file")) check_sizes(sizes, sample.sizes, faults);
  if ((kind == "tissue" || kind == "rings") && !has(packing, "file")) {
    const bool from_file = sample.sizes.distribution == "file";
    const bool with_radii = from_file || sample.sizes.distribution == "table" || sample.sizes.distribution == "mixture";
    if (from_file) require(sizes, "sample.sizes", "file", "the radii, one a line", faults);
    if (!from_file && has(sizes, "file"))
      add_at(sizes, "sample.sizes", "file", "contradicts distribution; use distribution = \"file\"", faults);
    if (!with_radii && !has(sizes, "mean") && !has(table, "width") && !has(table, "domain"))
      faults.add(has(table, "sizes") ? sizes : table, "sample.sizes.mean",
                 "missing; give the mean radius, or width and height of the box");
  }
  check_tissue_sections(table, sample, faults);
  if (const Value* notch = table.find("notch"); notch && notch->is_table()) {
    if (!has(*notch, "line") && !has(*notch, "polygon"))
      faults.add(*notch, "sample.notch", "is empty; give a line or a polygon");
    if (sample.notch && has(*notch, "line") && sample.notch->line.size() == 1)
      add_at(*notch, "sample.notch", "line", "has one point; give two or more", faults);
    if (sample.notch && has(*notch, "polygon") && sample.notch->polygon.size() < 3 && !sample.notch->polygon.empty())
      add_at(*notch, "sample.notch", "polygon", "has fewer than three points; give three or more", faults);
  }
}

void check_cell(const Value& table, const std::string& path, Needs needs, Faults& faults) {
  check_alternatives(table, path, faults);
  const bool rigidities = has(table, "axial_rigidity") || has(table, "bending_rigidity");
  if (needs == Needs::mechanics) {
    if (!has(table, "young") && !rigidities)
      faults.add(table, dotted(path, "young"),
                 "missing; give Young's modulus of the wall, or axial_rigidity and bending_rigidity");
    if (rigidities) {
      require(table, path, "axial_rigidity", "give both rigidities, or young", faults);
      require(table, path, "bending_rigidity", "give both rigidities (0: no bending), or young", faults);
    }
    if (!has(table, "density") && !has(table, "mass_per_length"))
      faults.add(table, dotted(path, "density"),
                 "missing; without it nodes have no mass; give it in kg/m3, or mass_per_length");
  }
  if (has(table, "thickness")) return;
  const bool made_of_thickness = has(table, "young") || has(table, "density") || has(table, "yield_stress") ||
                                 has(table, "break_stress") || !has(table, "radius");
  if (made_of_thickness)
    faults.add(table, dotted(path, "thickness"), "missing; give the wall thickness, such as thickness = \"1 um\"");
}

void check_core(const Value& table, const std::string& path, const CoreScene& core, Faults& faults) {
  check_alternatives(table, path, faults);
  const bool stiff = has(table, "modulus") || has(table, "stiffness_ratio");
  if (core.drained && stiff)
    add_at(table, path, "drained", "contradicts the modulus: a drained core has none; remove one of them", faults);
  if (!core.drained && !stiff)
    faults.add(table, dotted(path, "modulus"), "missing; give modulus or stiffness_ratio, or drained = true");
  if (has(table, "pressure_history")) {
    exclude(table, path, "pressure", "pressure_history", faults);
    if (!core.drained) add_at(table, path, "pressure_history", "needs drained = true", faults);
    for (std::size_t k = 1; k < core.pressure_history.size(); ++k)
      if (core.pressure_history[k].x() <= core.pressure_history[k - 1].x()) {
        add_at(table, path, "pressure_history", fmt::format("entry {}: times must increase", k), faults);
        break;
      }
  }
}

void check_link(const Value& table, const std::string& path, Faults& faults) {
  for (const auto& [given, other] :
       {std::pair{"normal_strength", "tangential_strength"}, {"tangential_strength", "normal_strength"}})
    if (has(table, given))
      require(table, path, other, fmt::format("strengths come together; {} is given", given), faults);
  const Value* law = table.find("law");
  if (law && law->text == "cohesive_zone") {
    require(table, path, "normal_strength", "a cohesive zone softens from a strength on; give both strengths", faults);
    require(table, path, "toughness", "a cohesive zone ends with it; give it in J/m (J per link)", faults);
    return;
  }
  if (law) return;  // who says "brittle" beside a toughness compares the two, or means one group of links
  for (const char* key : {"toughness", "shear_toughness", "mixing", "mixing_exponent"})
    if (has(table, key))
      add_at(table, path, key, "is used with law = \"cohesive_zone\" only; give that law, or leave this out", faults);
}

void check_selection(const Value& table, const std::string& path, Faults& faults) {
  std::vector<std::string> ways;
  for (const char* key : {"side", "box", "cells", "nodes", "end"})
    if (has(table, key)) ways.emplace_back(key);
  if (has(table, "group") && !has(table, "end")) ways.emplace_back("group");
  const char* right = "give one of side, box, group, cells, nodes, or end (with a group if you like)";
  if (ways.empty()) faults.add(table, path, fmt::format("selects nothing; {}", right));
  if (ways.size() > 1) faults.add(table, path, fmt::format("{} contradict each other; {}", joined(ways, ", "), right));
}

void check_load(const Value& table, const std::string& path, Faults& faults) {
  bool any = false;
  for (const std::string axis : {"x", "y"}) {
    exclude(table, path, "velocity_" + axis, "force_" + axis, faults);
    exclude(table, path, "velocity_" + axis, "line_force_" + axis, faults);
    for (const char* kind : {"velocity_", "force_", "line_force_"}) any = any || has(table, kind + axis);
  }
  if (!any) faults.add(table, path, "does nothing; give a velocity, force or line_force, such as velocity_y = 0");
  require(table, path, "nodes", "which nodes, such as nodes = { side = \"top\" }", faults);
}

void check_initial(const Value& table, const std::string& path, Faults& faults) {
  if (!has(table, "velocity_x") && !has(table, "velocity_y") && !has(table, "spin"))
    faults.add(table, path, "states nothing; give velocity_x, velocity_y or spin");
  if (has(table, "centre") && !has(table, "spin"))
    add_at(table, path, "centre", "is that of a spin; give spin, or leave it out", faults);
  require(table, path, "nodes", "which nodes, such as nodes = { group = \"cells\" }", faults);
}

void check_loading(const Value& table, const LoadingScene& loading, Faults& faults) {
  const std::string path = "loading";
  check_alternatives(table, path, faults);
  if (!has(table, "strain_rate") && !has(table, "speed"))
    faults.add(table, "loading.strain_rate", "missing; give strain_rate, or the speed of the moving grip");
  if (loading.kind == "shear" && loading.normal_only)
    add_at(table, path, "normal_only",
           "contradicts kind = \"shear\", which moves the grips along themselves; remove it", faults);
  if (loading.kind == "compression" && loading.strain >= 1)
    add_at(table, path, "strain", "compression ends below strain 1, where nothing is left; give less", faults);
  if (loading.step > loading.strain)
    add_at(table, path, "step", "is more than strain, where loading ends; give less", faults);
  if (has(table, "rest_tolerance") && !has(table, "step"))
    add_at(table, path, "rest_tolerance", "is used with step only; give step, or use stop.at_rest", faults);
}

void check_stage(const Value& at, const std::string& path, const Stage& stage, Faults& faults) {
  const Value& stop = section_or_empty(at, "stop");
  if (!stage.loading && stage.stop.separated)
    add_at(stop, "stop", "separated", "needs grips: a section [loading]", faults);
  if (!stage.loading && stage.stop.stress_drop)
    add_at(stop, "stop", "stress_drop", "needs a stress: a section [loading]", faults);
  if (!stage.loading && !stage.stop.time && !stage.stop.at_rest)
    faults.add(at, dotted(path, "stop"), "nothing ends the run; give [loading], stop.time or stop.at_rest");
  if (stage.contact && !stage.contact->normal_stiffness && stage.links.empty())
    faults.add(section_or_empty(at, "contact"), "contact.normal_stiffness",
               "missing, and there are no links to take it from; give it in N/m2");
  std::set<std::string> names;
  for (const LoadScene& load : stage.loads)
    if (!load.name.empty() && !names.insert(load.name).second)
      faults.add(at, "loads." + load.name, "there are two of this name; give each load its own");
}

void check_groups(const Value& at, const Scene& scene, Faults& faults) {
  std::vector<std::string> groups;
  if (scene.sample.kind != "shapes") groups.emplace_back("cells");
  const auto add = [&](const std::string& group) {
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
  };
  for (const ShapeScene& shape : scene.sample.shapes) add(shape.group);
  for (const LayerScene& layer : scene.sample.layers) add(layer.group);
  for (const MixtureScene& part : scene.sample.sizes.mixture) add(part.group);
  const auto check = [&](const std::string& group, int line, const std::string& path, const std::string& own) {
    if (group == own || std::find(groups.begin(), groups.end(), group) != groups.end()) return;
    std::vector<std::string> known = groups;
    if (own == "cells") known.emplace_back("core");
    Value place = at;
    place.members.clear();
    place.line = line;
    faults.add(place, path, fmt::format("the sample has no group \"{}\";{}", group, suggestion(group, known)));
  };
  for (const Stage& stage : scene.stages) {
    for (const auto& [group, cell] : stage.cells) check(group, cell.line, "cells." + group, "cells");
    for (const auto& [group, link] : stage.links) check(group, link.line, "links." + group, "links");
    for (const LoadScene& load : stage.loads)
      if (!load.nodes.group.empty()) check(load.nodes.group, load.line, "loads." + load.name + ".nodes.group", "");
    for (const InitialScene& initial : stage.initial)
      if (!initial.nodes.group.empty()) check(initial.nodes.group, initial.line, "initial.nodes.group", "");
  }
}

}  // namespace lamella
