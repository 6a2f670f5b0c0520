// From the text of a scene to plain data: layers are merged as trees, then each section is read by its rows and checked.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "generator/sample/errors.h"
#include "generator/sample/scene_checks.h"
#include "generator/sample/scene_values.h"

namespace lamella {
namespace {

constexpr std::uintmax_t kLargestScene = 10'000'000;  // [bytes]; geometry belongs in files of its own

const std::vector<std::string> kStageSections{"cells",   "links",   "contact", "gravity", "drag",  "loads",
                                              "initial", "loading", "stop",    "run",     "output"};

/// [cells] and [links] hold their own keys and, as tables, what groups change.
bool is_group(const Member& member) { return member.value.is_table() && member.key != "core"; }

Value without_groups(const Value& table) {
  Value out = table;
  std::erase_if(out.members, is_group);
  return out;
}

/// A group: what its section says, over what the main section says.
Value group_over(const Value& main, const Value& group) {
  Value out = merged(main, group);
  out.line = group.line;
  out.setting = group.setting;
  return out;
}

CellScene read_cell(const Value& table, const std::string& path, Needs needs, Faults& faults) {
  CellScene cell;
  cell.line = table.line;
  read_section(table, path, cell, faults, {"core"});
  check_cell(table, path, needs, faults);
  if (const Value* core = table.find("core")) {
    cell.core.emplace();
    read_section(*core, path + ".core", *cell.core, faults);
    if (core->is_table()) check_core(*core, path + ".core", *cell.core, faults);
  }
  return cell;
}

LinkScene read_link(const Value& table, const std::string& path, Faults& faults) {
  LinkScene link;
  link.line = table.line;
  read_section(table, path, link, faults);
  check_link(table, path, faults);
  return link;
}

/// The main section under its own name, and each group under the group's.
template <class S, class Read>
std::map<std::string, S> read_groups(const Value& section, const std::string& name, bool main_required, Faults& faults,
                                     Read read) {
  std::map<std::string, S> out;
  if (!section.is_table()) {
    faults.add(section, name, fmt::format("is {}; it is a section of keys, [{}]", section.kind_name(), name));
    return out;
  }
  const Value main = without_groups(section);
  if (main_required || !main.members.empty() || section.members.empty()) out.emplace(name, read(main, name));
  for (const Member& member : section.members) {
    if (!is_group(member)) continue;
    if (member.key == name)
      faults.add(member.value, dotted(name, member.key), fmt::format("is [{}] itself; put its keys there", name));
    else
      out.emplace(member.key, read(group_over(main, member.value), dotted(name, member.key)));
  }
  return out;
}

LoadScene read_load(const Value& table, std::size_t index, Faults& faults) {
  LoadScene load;
  load.line = table.line;
  const Value* name = table.is_table() ? table.find("name") : nullptr;
  const std::string path = name ? "loads." + name->text : fmt::format("loads[{}]", index);
  read_section(table, path, load, faults, {"nodes"});
  if (!table.is_table()) return load;
  check_load(table, path, faults);
  if (const Value* nodes = table.find("nodes")) {
    read_section(*nodes, path + ".nodes", load.nodes, faults);
    if (nodes->is_table()) check_selection(*nodes, path + ".nodes", faults);
  }
  return load;
}

InitialScene read_initial(const Value& table, std::size_t index, Faults& faults) {
  InitialScene initial;
  initial.line = table.line;
  const std::string path = fmt::format("initial[{}]", index);
  read_section(table, path, initial, faults, {"nodes"});
  if (!table.is_table()) return initial;
  check_initial(table, path, faults);
  if (const Value* nodes = table.find("nodes")) {
    read_section(*nodes, path + ".nodes", initial.nodes, faults);
    if (nodes->is_table()) check_selection(*nodes, path + ".nodes", faults);
  }
  return initial;
}

/// Reads the section `key` into the optional; leaves it empty when the section is absent.
template <class S>
void read_optional(const Value& table, const char* key, std::optional<S>& out, Faults& faults) {
  const Value* section = table.find(key);
  if (!section) return;
  out.emplace();
  if constexpr (requires { out->line; }) out->line = section->line;
  read_section(*section, key, *out, faults);
}

template <class S>
void read_plain(const Value& table, const char* key, S& out, Faults& faults) {
  if (const Value* section = table.find(key)) {
    if constexpr (requires { out.line; }) out.line = section->line;
    read_section(*section, key, out, faults);
    if (section->is_table()) check_alternatives(*section, key, faults);
  }
}

/// True when the scene asks for a run, and not only for a sample.
bool simulates(const Value& root) {
  const auto keys = {"loads", "initial", "loading", "stop", "run", "stages"};
  return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return root.find(key) != nullptr; });
}

Stage read_stage(const Value& table, const std::string& path, Needs needs, Faults& faults) {
  Stage stage;
  if (const Value* cells = table.find("cells"))
    stage.cells = read_groups<CellScene>(*cells, "cells", false, faults, [&](const Value& cell, const std::string& at) {
      return read_cell(cell, at, needs, faults);
    });
  else
    faults.add(table, "cells", "missing; describe the walls of the cells: [cells] with thickness, young and density");
  if (const Value* links = table.find("links"))
    stage.links = read_groups<LinkScene>(*links, "links", true, faults, [&](const Value& link, const std::string& at) {
      return read_link(link, at, faults);
    });
  read_optional(table, "contact", stage.contact, faults);
  read_optional(table, "gravity", stage.gravity, faults);
  read_optional(table, "drag", stage.drag, faults);
  read_optional(table, "loading", stage.loading, faults);
  if (const Value* loading = table.find("loading"); loading && loading->is_table())
    check_loading(*loading, *stage.loading, faults);
  if (const Value* loads = table.find("loads")) {
    if (loads->kind != Value::Kind::array)
      faults.add(*loads, "loads", fmt::format("is {}; loads are a list: [[loads]]", loads->kind_name()));
    for (std::size_t k = 0; k < loads->items.size(); ++k) stage.loads.push_back(read_load(loads->items[k], k, faults));
  }
  if (const Value* initial = table.find("initial")) {
    if (initial->kind != Value::Kind::array)
      faults.add(*initial, "initial", fmt::format("is {}; velocities are a list: [[initial]]", initial->kind_name()));
    for (std::size_t k = 0; k < initial->items.size(); ++k)
      stage.initial.push_back(read_initial(initial->items[k], k, faults));
  }
  read_plain(table, "stop", stage.stop, faults);
  read_plain(table, "run", stage.run, faults);
  read_plain(table, "output", stage.output, faults);
  if (needs == Needs::mechanics) check_stage(table, path, stage, faults);
  return stage;
}

/// Takes "gravity", "loading.strain_rate" or "loads.NAME" out of the tree of a stage.
void remove_part(Value& stage, const Value& part, const std::string& path, Faults& faults) {
  if (part.kind != Value::Kind::text)
    return faults.add(part, path, fmt::format("is {}; give names, such as remove = [\"gravity\"]", part.kind_name()));
  Value* table = &stage;
  std::string key = part.text;
  for (std::size_t dot; table && (dot = key.find('.')) != std::string::npos; key.erase(0, dot + 1)) {
    Value* inner = table->find(key.substr(0, dot));
    if (inner && inner->kind == Value::Kind::array) {
      const std::string name = key.substr(dot + 1);
      const auto removed = std::erase_if(inner->items, [&](const Value& item) {
        const Value* own = item.find("name");
        return own && own->text == name;
      });
      if (removed > 0) return;
      table = nullptr;
      break;
    }
    table = inner;
  }
  if (table && table->find(key)) return table->erase(key);
  std::vector<std::string> present;
  for (const Member& member : stage.members) present.push_back(member.key);
  faults.add(part, path,
             fmt::format("nothing called \"{}\" to remove here;{}", part.text, suggestion(part.text, present)));
}

/// The stages of the scene, each merged over the one that it continues. The file's own sections come before the first.
std::vector<Stage> read_stages(const Value& root, Needs needs, Faults& faults) {
  Value base;
  base.line = root.line;
  for (const Member& member : root.members)
    if (std::find(kStageSections.begin(), kStageSections.end(), member.key) != kStageSections.end())
      base.members.push_back(member);
  const Value* list = root.find("stages");
  if (!list) return {read_stage(base, "", needs, faults)};
  if (list->kind != Value::Kind::array || list->items.empty()) {
    faults.add(*list, "stages",
               fmt::format("is {}; stages are a list: [[stages]]",
                           list->items.empty() && list->kind == Value::Kind::array ? "empty" : list->kind_name()));
    return {};
  }
  std::vector<Stage> stages;
  std::vector<std::pair<std::string, Value>> trees;
  for (std::size_t k = 0; k < list->items.size(); ++k) {
    const Value& own = list->items[k];
    StageScene facts;
    std::vector<std::string> others = kStageSections;
    others.emplace_back("remove");
    const Value* name = own.is_table() ? own.find("name") : nullptr;
    const std::string path = name ? "stages." + name->text : fmt::format("stages[{}]", k);
    read_section(own, path, facts, faults, others);
    if (!own.is_table()) continue;

    std::vector<std::string> earlier;
    for (const auto& [known, tree] : trees) earlier.push_back(known);
    Value tree = trees.empty() ? base : trees.back().second;
    if (!facts.from.empty()) {
      const auto found = std::find(earlier.begin(), earlier.end(), facts.from);
      if (found == earlier.end())
        faults.add(*own.find("from"), path + ".from",
                   earlier.empty()
                       ? "the first stage continues none; remove it"
                       : fmt::format("no earlier stage \"{}\";{}", facts.from, suggestion(facts.from, earlier)));
      else
        tree = trees[found - earlier.begin()].second;
    }
    if (!trees.empty()) tree.erase("initial");  // the start of a stage, not of those that continue it
    if (std::find(earlier.begin(), earlier.end(), facts.name) != earlier.end())
      faults.add(*name, path + ".name", "there is an earlier stage of this name; give each its own");
    if (const Value* remove = own.find("remove")) {
      if (remove->kind != Value::Kind::array) remove_part(tree, *remove, path + ".remove", faults);
      for (const Value& part : remove->items) remove_part(tree, part, path + ".remove", faults);
    }
    Value change = own;
    for (const char* key : {"name", "from", "remove"}) change.erase(key);
    tree = merged(tree, change);
    tree.line = own.line;
    trees.emplace_back(facts.name, tree);
    stages.push_back(read_stage(tree, path, needs, faults));
    stages.back().name = facts.name;
    stages.back().from = facts.from;
  }
  return stages;
}

/// A list of tables, each checked by `check(table, path, entry, faults)`.
template <class S, class Check>
void read_list(const Value& table, const std::string& at, const std::string& key, std::vector<S>& out, Faults& faults,
               Check check) {
  const Value* list = table.find(key);
  if (!list) return;
  const std::string path = dotted(at, key);
  if (list->kind != Value::Kind::array)
    faults.add(*list, path, fmt::format("is {}; {} are a list: [[{}]]", list->kind_name(), key, path));
  for (std::size_t k = 0; k < list->items.size(); ++k) {
    const std::string place = fmt::format("{}[{}]", path, k);
    S entry;
    read_section(list->items[k], place, entry, faults);
    if (list->items[k].is_table()) check(list->items[k], place, entry, faults);
    out.push_back(std::move(entry));
  }
}

SampleScene read_sample_section(const Value& table, Faults& faults) {
  SampleScene sample;
  read_section(
      table, "sample", sample, faults,
      {"sizes", "packing", "walls", "notch", "shapes", "domain", "areas", "layers", "gradient", "stretch", "image"});
  if (!table.is_table()) return sample;
  const auto part = [&](const char* key, auto& out, const char* inner = nullptr) {
    const Value* section = table.find(key);
    const std::string path = dotted("sample", key);
    if (!section) return;
    read_section(*section, path, out, faults, inner ? std::vector<std::string>{inner} : std::vector<std::string>{});
    if (section->is_table()) check_alternatives(*section, path, faults);
  };
  part("sizes", sample.sizes, "mixture");
  part("packing", sample.packing);
  part("walls", sample.walls);
  if (table.find("notch")) part("notch", sample.notch.emplace());
  if (table.find("domain")) part("domain", sample.domain.emplace(), "holes");
  if (table.find("areas")) part("areas", sample.areas.emplace());
  if (table.find("gradient")) part("gradient", sample.gradient.emplace());
  if (table.find("stretch")) part("stretch", sample.stretch.emplace());
  if (table.find("image")) part("image", sample.image.emplace());
  read_list(table, "sample", "shapes", sample.shapes, faults, check_shape);
  read_list(table, "sample", "layers", sample.layers, faults, check_layer);
  if (const Value* sizes = table.find("sizes"); sizes && sizes->is_table())
    read_list(*sizes, "sample.sizes", "mixture", sample.sizes.mixture, faults, check_mixture);
  if (const Value* domain = table.find("domain"); domain && domain->is_table())
    read_list(*domain, "sample.domain", "holes", sample.domain->holes, faults, check_hole);
  check_sample_section(table, sample, faults);
  return sample;
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& name, const std::vector<std::string>& overrides) {
  Value root = parse_document(text, name);
  Faults faults(name);
  for (const std::string& setting : overrides) apply_setting(root, setting, faults);
  faults.raise();  // what follows would only repeat it

  Scene scene;
  scene.text = text;
  scene.overrides = overrides;
  scene.path = name;
  std::vector<std::string> sections = kStageSections;
  sections.insert(sections.end(), {"sample", "stages"});
  read_section(root, "", scene, faults, sections);
  const Value* sample = root.find("sample");
  if (sample)
    scene.sample = read_sample_section(*sample, faults);
  else
    scene.sample.kind.clear();  // the sample comes from a file
  scene.stages = read_stages(root, simulates(root) ? Needs::mechanics : Needs::geometry, faults);
  if (sample) check_groups(root, scene, faults), check_varied_thickness(root, scene, faults);
  faults.raise();
  for (Stage& stage : scene.stages) stage.slow_down(), stage.file = name;
  return scene;
}

Scene read_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw DataError(fmt::format("{}: no such file; give the path of a scene (TOML)", path.string()));
  if (std::filesystem::is_directory(status))
    throw DataError(fmt::format("{}: is a folder; give the path of a scene file (TOML)", path.string()));
  if (!std::filesystem::is_regular_file(status))
    throw DataError(fmt::format("{}: is not a regular file; give the path of a scene (TOML)", path.string()));
  if (const auto size = std::filesystem::file_size(path, error); error || size > kLargestScene)
    throw DataError(
        fmt::format("{}: is larger than {} MB, which no scene is; points belong in a file that the scene names",
                    path.string(), kLargestScene / 1'000'000));
  std::ifstream in(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in && !in.eof()) throw DataError(fmt::format("{}: cannot be read; check its permissions", path.string()));
  Scene scene = parse_scene(text, path.string(), overrides);
  scene.path = path;
  return scene;
}

}  // namespace lamella
