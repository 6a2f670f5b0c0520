// The parameters as a list for the terminal and as a Markdown page, both from the rows.
#include <fmt/format.h>

#include <utility>

#include "generator/sample/scene_values.h"

namespace lamella {
namespace {

struct Line {
  std::string key, kind, unit, range, fallback, sentence;
};

struct Section {
  std::string name, sentence;
  std::vector<Line> lines;
};

std::string as_text(double v) { return fmt::format("{:g}", v); }
std::string as_text(int v) { return std::to_string(v); }
std::string as_text(std::uint64_t v) { return std::to_string(v); }
std::string as_text(bool v) { return v ? "true" : "false"; }
std::string as_text(const std::string& v) { return v.empty() ? "none" : v; }
std::string as_text(const Vec2& v) { return fmt::format("[{:g}, {:g}]", v.x(), v.y()); }
template <class T>
std::string as_text(const std::optional<T>&) {
  return "none";
}
template <class T>
std::string as_text(const std::vector<T>&) {
  return "none";
}

const char* kind_of(double) { return "number"; }
const char* kind_of(const std::optional<double>&) { return "number"; }
const char* kind_of(int) { return "whole number"; }
const char* kind_of(std::uint64_t) { return "whole number"; }
const char* kind_of(bool) { return "true or false"; }
const char* kind_of(const std::string&) { return "word"; }
const char* kind_of(const Vec2&) { return "pair"; }
const char* kind_of(const std::vector<Vec2>&) { return "pairs"; }
const char* kind_of(const std::vector<int>&) { return "whole numbers"; }
const char* kind_of(const std::optional<Vec2>&) { return "pair"; }
const char* kind_of(const std::optional<Box>&) { return "four numbers"; }

template <class S>
Line line_of(const Row<S>& row) {
  Line line;
  const S defaults{};
  line.key = row.key;
  line.kind = std::visit([&](auto member) { return kind_of(defaults.*member); }, row.member);
  line.unit = *row.unit_of_second ? fmt::format("{}, {}", row.unit, row.unit_of_second) : row.unit;
  if (*row.unit_per_link) line.unit += fmt::format(" ({} per link)", row.unit_per_link);
  line.range = row.choices.empty() ? row.range.text("") : joined(row.choices, ", ");
  line.fallback = row.required    ? "required"
                  : *row.fallback ? row.fallback
                                  : std::visit([&](auto member) { return as_text(defaults.*member); }, row.member);
  line.sentence = row.sentence;
  return line;
}

template <class S>
Section section_of(const char* name, const char* sentence) {
  Section section{name, sentence, {}};
  for (const auto& row : rows<S>()) section.lines.push_back(line_of(row));
  return section;
}

std::vector<Section> sections() {
  return {
      section_of<Scene>("", "At the top of the file, before any section."),
      section_of<SampleScene>("[sample]", "The geometry. Absent where the sample comes from a file."),
      section_of<SizesScene>("[sample.sizes]", "Radii of the disks of which cells are made (tissue, rings)."),
      section_of<MixtureScene>("[[sample.sizes.mixture]]", "One kind of disk each; their shares sum to 1."),
      section_of<PackingScene>("[sample.packing]", "How the disks are packed (tissue, rings)."),
      section_of<WallsScene>("[sample.walls]", "From tiles to shells of mass points."),
      section_of<DomainScene>("[sample.domain]", "What a tissue fills. Absent: the box."),
      section_of<HoleScene>("[[sample.domain.holes]]", "What the domain leaves out."),
      section_of<AreasScene>(
          "[sample.areas]",
          "Every cell has exactly the share of the area that its disk has of all disks' area (or that the file of "
          "disks states). Absent: the areas are those of the disks' Laguerre tiles."),
      section_of<LayerScene>("[[sample.layers]]",
                             "A part of the tissue with a size or a group of its own; the last that holds counts."),
      section_of<GradientScene>("[sample.gradient]", "What changes with the place in a tissue. Absent: nothing."),
      section_of<StretchScene>("[sample.stretch]", "Longer cells. Absent: none."),
      section_of<ImageScene>("[sample.image]", "The picture of kind = \"image\"."),
      section_of<NotchScene>("[sample.notch]", "A cut. A line, a polygon, or both."),
      section_of<ShapeScene>("[[sample.shapes]]", "One shell each, beside a tissue or instead of one."),
      section_of<CellScene>("[cells]", "Walls. [cells.NAME] holds what is different for the group NAME."),
      section_of<CoreScene>("[cells.core]", "What fills closed cells. Absent: empty cells, without pressure."),
      section_of<LinkScene>(
          "[links]",
          "Cohesion of facing points. [links.NAME] holds what is different for links that touch the group "
          "NAME. Absent: no cohesion."),
      section_of<ContactScene>("[contact]",
                               "Cells push each other, and themselves. Absent: they pass through each other."),
      section_of<GravityScene>("[gravity]", "Absent: none."),
      section_of<DragScene>("[drag]", "Absent: none."),
      section_of<LoadingScene>(
          "[loading]",
          "The two grips of a test on the sides of the box. Strain is nominal; tension and opening "
          "are positive. A sample that repeats both ways has no sides: its box is pulled."),
      section_of<LoadScene>(
          "[[loads]]", "Velocities or forces prescribed to groups of nodes. A component that is not given stays free."),
      section_of<InitialScene>(
          "[[initial]]",
          "Velocities of groups of nodes when the stage in which it stands begins (the first, where it stands in the "
          "file itself). Stages that continue that one do not inherit it. Where a load holds a component, the load's "
          "velocity holds from the first step on."),
      section_of<Selection>("nodes = { ... } of [[loads]] and [[initial]]", "Which nodes: exactly one of these ways."),
      section_of<StopScene>("[stop]", "A stage ends when the first of these holds, or when its loading is over."),
      section_of<RunScene>("[run]", "How time is stepped."),
      section_of<OutputScene>("[output]", "How much is written."),
      section_of<StageScene>(
          "[[stages]]",
          "Stages run one after another. Each starts with all sections of the one that it continues (the first: "
          "those of the file) but [[initial]], takes out what `remove` lists (\"gravity\", \"loading.ramp_strain\", "
          "\"loads.NAME\"), and puts its own sections [stages.SECTION] over the rest, key by key."),
  };
}

/// "|" would end the cell of a table.
std::string in_table(std::string text) {
  for (std::size_t k = 0; (k = text.find('|', k)) != std::string::npos; k += 2) text.insert(k, 1, '\\');
  return text;
}

}  // namespace

std::string describe_scene() {
  std::string out;
  for (const Section& section : sections()) {
    out += fmt::format("{}{}{}\n", section.name, section.name.empty() ? "" : "  ", section.sentence);
    for (const Line& line : section.lines) {
      out += fmt::format("  {}: {}", line.key, line.kind);
      if (!line.unit.empty() && line.unit != "1") out += " in " + line.unit;
      if (!line.range.empty()) out += "; " + line.range;
      out += fmt::format("; default: {}\n      {}\n", line.fallback, line.sentence);
    }
    out += "\n";
  }
  return out;
}

std::string scene_reference() {
  std::string out =
      "# Scene reference\n\n"
      "Made from the program's table of parameters (`generator/sample/scene_rows.cpp`); a test compares the two. After "
      "a change:\n"
      "`build/lamella describe --markdown > docs/scene_reference.md`.\n\n"
      "A scene is a TOML file. A value is a number in SI units or a string with a unit: `\"10 um\"`, `\"2 MPa\"`, "
      "`\"1e-3 N/m\"`,\n"
      "`\"5 %\"`. Units are m, g, s, rad, N, Pa, J, Hz with SI prefixes, and deg, min, h, %; they are joined by a "
      "space, `*` or `/`\n"
      "(`N m2`, `kg/m3`, `m/s^2`), and `/` divides by the next factor only. Reading is strict: every fault is "
      "reported, with its\n"
      "line, before anything is computed. A section that is absent costs nothing: what it describes does not exist in "
      "the run.\n";
  for (const Section& section : sections()) {
    out += fmt::format("\n## {}\n\n{}\n\n", section.name.empty() ? "Top level" : "`" + section.name + "`",
                       section.sentence);
    out += "| key | value | unit | range | default | |\n|---|---|---|---|---|---|\n";
    for (const Line& line : section.lines)
      out += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", line.key, line.kind, line.unit, in_table(line.range),
                         line.fallback, in_table(line.sentence));
  }
  return out;
}

}  // namespace lamella
