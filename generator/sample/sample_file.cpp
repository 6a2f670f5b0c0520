#include "generator/sample/sample_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "generator/sample/errors.h"
#include "generator/sample/h5.h"

namespace lamella {
namespace {

constexpr const char* kFormat = "lamella sample 1";

std::vector<double> interleaved(const std::vector<Vec2>& points) {
  std::vector<double> values(2 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) values[2 * i] = points[i].x(), values[2 * i + 1] = points[i].y();
  return values;
}

/// One member of every element, as an array of its own.
template <typename T, typename Element, typename Get>
std::vector<T> column(const std::vector<Element>& elements, Get get) {
  std::vector<T> values;
  values.reserve(elements.size());
  for (const auto& element : elements) values.push_back(get(element));
  return values;
}

/// Two members of every element, row by row.
template <typename T, typename Element, typename First, typename Second>
std::vector<T> columns(const std::vector<Element>& elements, First first, Second second) {
  std::vector<T> values;
  values.reserve(2 * elements.size());
  for (const auto& element : elements) values.push_back(first(element)), values.push_back(second(element));
  return values;
}

// ---- reading, with the invariants that the program relies on ----------------------------------------------------

/// Arrays of one group that have one row per `of`.
class Rows {
 public:
  Rows(const h5::Node& group, std::size_t rows, std::string of) : group_(group), rows_(rows), of_(std::move(of)) {}

  std::vector<double> doubles(const std::string& name, int columns = 1) const {
    auto values = group_.doubles(name, columns);
    check_rows(name, values.size() / static_cast<std::size_t>(columns));
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i])) refuse(name, i / static_cast<std::size_t>(columns), values[i], "a finite number");
    return values;
  }
  std::vector<double> at_least_zero(const std::string& name) const {
    auto values = doubles(name);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] < 0) refuse(name, i, values[i], "at least 0");
    return values;
  }
  std::vector<double> positive(const std::string& name) const {
    auto values = doubles(name);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] <= 0) refuse(name, i, values[i], "positive");
    return values;
  }
  /// Integers in [0, count): indices of `what`.
  std::vector<Index> indices(const std::string& name, Index count, const std::string& what, int columns = 1) const {
    auto values = group_.ints(name, columns);
    check_rows(name, values.size() / static_cast<std::size_t>(columns));
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] < 0 || values[i] >= count)
        refuse(name, i / static_cast<std::size_t>(columns), values[i],
               fmt::format("the index of one of the {} {}", count, what));
    return values;
  }
  std::vector<std::uint8_t> flags(const std::string& name, std::uint8_t largest) const {
    auto values = group_.bytes(name);
    check_rows(name, values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] > largest) refuse(name, i, int{values[i]}, fmt::format("from 0 to {}", largest));
    return values;
  }

  template <typename T>
  [[noreturn]] void refuse(const std::string& name, std::size_t row, T value, const std::string& expected) const {
    throw DataError(
        fmt::format("{}: '{}' of {} {} is {}; must be {}", group_.where(), name, of_, row, value, expected));
  }

 private:
  void check_rows(const std::string& name, std::size_t rows) const {
    if (rows != rows_)
      throw DataError(
          fmt::format("{}: '{}' has {} rows; must have {}, one per {}", group_.where(), name, rows, rows_, of_));
  }

  const h5::Node& group_;
  std::size_t rows_;
  std::string of_;
};

std::vector<Vec2> points(const std::vector<double>& values) {
  std::vector<Vec2> found(values.size() / 2);
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = {values[2 * i], values[2 * i + 1]};
  return found;
}

/// Enclosed by the nodes of a closed cell, positive when counter-clockwise; about its first node, to lose no digits.
double enclosed(const Sample& sample, Index c) {
  const Vec2 origin = sample.x[sample.cell_begin[c]];
  double twice = 0;
  for (Index k = sample.cell_begin[c]; k < sample.cell_begin[c + 1]; ++k)
    twice += cross(sample.x[k] - origin, sample.x[sample.next(c, k)] - origin);
  return twice / 2;
}

void read_cells(const h5::Node& group, Index nodes, Sample& sample) {
  sample.cell_begin = group.ints("begin");
  const auto& begin = sample.cell_begin;
  if (begin.size() < 2)
    throw DataError(fmt::format("{}: 'begin' is too short; there must be at least one cell", group.where()));
  if (begin.front() != 0 || begin.back() != nodes)
    throw DataError(fmt::format("{}: 'begin' runs from {} to {}; must run from 0 to the number of nodes, {}",
                                group.where(), begin.front(), begin.back(), nodes));
  const std::size_t cells = begin.size() - 1;
  const Rows rows(group, cells, "cell");
  sample.closed = rows.flags("closed", 1);
  for (std::size_t c = 0; c < cells; ++c) {
    const std::int64_t size = std::int64_t{begin[c + 1]} - begin[c];
    const int least = sample.closed[c] ? 3 : 2;
    if (size < least)
      throw DataError(fmt::format("{}: {} cell {} has {} nodes; must have at least {}", group.where(),
                                  sample.closed[c] ? "closed" : "open", c, size, least));
  }
  sample.group_names = group.texts("group_names");
  sample.group = rows.indices("group", static_cast<Index>(sample.group_names.size()), "group names");
  sample.radius = rows.at_least_zero("radius");
  sample.rest_area = rows.at_least_zero("rest_area");
  sample.tile_area = rows.at_least_zero("tile_area");
  if (group.has("thickness")) sample.cell_thickness = rows.positive("thickness");
  for (std::size_t c = 0; c < cells; ++c)
    if (sample.closed[c] && sample.rest_area[c] <= 0)
      rows.refuse("rest_area", c, sample.rest_area[c], "positive, because the cell is closed");
}

void read_nodes(const h5::Node& group, Sample& sample) {
  const auto values = group.doubles("x", 2);
  if (values.size() / 2 > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    throw DataError(fmt::format("{}: 'x' has {} rows; must have fewer than 2^31", group.where(), values.size() / 2));
  const Rows rows(group, values.size() / 2, "node");
  sample.x = points(rows.doubles("x", 2));
  sample.side = rows.flags("side", kLeft | kRight | kBottom | kTop);
  sample.rest_length = rows.at_least_zero("rest_length");
  sample.rest_angle = rows.doubles("rest_angle");
  sample.hinge_length = rows.at_least_zero("hinge_length");
}

void check_shells(const h5::Node& nodes, const Sample& sample) {
  for (Index c = 0; c < sample.cells(); ++c) {
    for (Index k = sample.cell_begin[c]; k < sample.cell_begin[c + 1]; ++k)
      if (sample.starts_segment(c, k) && sample.rest_length[k] <= 0)
        throw DataError(
            fmt::format("{}: 'rest_length' of node {} is {}; must be positive, because a segment starts there",
                        nodes.where(), k, sample.rest_length[k]));
    if (sample.closed[c] && !(enclosed(sample, c) > 0))
      throw DataError(fmt::format("{}: the nodes of cell {} enclose {} m2; they must run counter-clockwise around it",
                                  nodes.where(), c, enclosed(sample, c)));
  }
}

void read_walls(const h5::Node& group, Index cells, Sample& sample) {
  const auto pairs = group.ints("cells", 2);
  const Rows rows(group, pairs.size() / 2, "wall");
  rows.indices("cells", cells, "cells", 2);
  const auto length = rows.at_least_zero("length");
  sample.walls.resize(length.size());
  for (std::size_t w = 0; w < length.size(); ++w) {
    sample.walls[w] = {pairs[2 * w], pairs[2 * w + 1], length[w]};
    const bool own_image = pairs[2 * w] == pairs[2 * w + 1] && is_periodic(sample);
    if (pairs[2 * w] >= pairs[2 * w + 1] && !own_image)
      throw DataError(fmt::format("{}: wall {} joins cell {} to cell {}; the first must be the lower", group.where(), w,
                                  pairs[2 * w], pairs[2 * w + 1]));
  }
}

/// A link's nodes and its tangent's must belong to the two cells of its wall.
void check_link(const h5::Node& group, const Sample& sample, std::size_t l) {
  const Link& link = sample.links[l];
  const Wall& wall = sample.walls[link.wall];
  const auto inside = [&](Index cell, Index node) {
    return node >= sample.cell_begin[cell] && node < sample.cell_begin[cell + 1];
  };
  for (const Index node : {link.a, link.a_prev, link.a_next})
    if (!inside(wall.cell_a, node))
      throw DataError(
          fmt::format("{}: link {} names node {} on its side a; must be a node of cell {}, as its wall {} says",
                      group.where(), l, node, wall.cell_a, link.wall));
  for (const Index node : {link.b, link.b_prev, link.b_next})
    if (!inside(wall.cell_b, node))
      throw DataError(
          fmt::format("{}: link {} names node {} on its side b; must be a node of cell {}, as its wall {} says",
                      group.where(), l, node, wall.cell_b, link.wall));
  if (l > 0 && link.wall < sample.links[l - 1].wall)
    throw DataError(
        fmt::format("{}: link {} belongs to wall {}, the one before to wall {}; links must be sorted by wall",
                    group.where(), l, link.wall, sample.links[l - 1].wall));
}

/// By how many box lengths b is displaced where a link joins it to a: the same along a wall, and none across sides that do not repeat.
void read_images(const h5::Node& group, Sample& sample) {
  const auto values = group.ints("image", 2);
  if (values.size() != 2 * sample.links.size())
    throw DataError(fmt::format("{}: 'image' has {} rows; must have {}, one per link", group.where(), values.size() / 2,
                                sample.links.size()));
  sample.link_image.resize(sample.links.size());
  for (std::size_t l = 0; l < sample.links.size(); ++l) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto value = values[2 * l + axis];
      const int most = sample.periodic[axis] ? kFarthestImage : 0;
      if (value < -most || value > most)
        throw DataError(fmt::format("{}: 'image' of link {} is {} along {}; must be {}", group.where(), l, value,
                                    axis == 0 ? "x" : "y",
                                    most == 0 ? std::string("0, because the sample does not repeat there")
                                              : fmt::format("from -{} to {}", most, most)));
      sample.link_image[l][axis] = static_cast<std::int8_t>(value);
    }
    const Wall& wall = sample.walls[sample.links[l].wall];
    if (wall.cell_a == wall.cell_b && sample.link_image[l] == Image{0, 0})
      throw DataError(
          fmt::format("{}: link {} joins cell {} to itself; must join it to an image of itself, such as 1 0",
                      group.where(), l, wall.cell_a));
    if (l > 0 && sample.links[l - 1].wall == sample.links[l].wall && sample.link_image[l - 1] != sample.link_image[l])
      throw DataError(fmt::format("{}: 'image' of link {} differs from that of link {}; must be the same along wall {}",
                                  group.where(), l, l - 1, sample.links[l].wall));
  }
}

void read_links(const h5::Node& group, Index nodes, Sample& sample) {
  const auto ends = group.ints("nodes", 2);
  const Rows rows(group, ends.size() / 2, "link");
  rows.indices("nodes", nodes, "nodes", 2);
  const auto tangent_a = rows.indices("tangent_a", nodes, "nodes", 2);
  const auto tangent_b = rows.indices("tangent_b", nodes, "nodes", 2);
  const auto wall = rows.indices("wall", static_cast<Index>(sample.walls.size()), "walls");
  const auto wall_end = rows.flags("wall_end", 1);
  const auto length = rows.positive("length");
  const auto spacing = rows.positive("spacing");
  const auto offset = rows.doubles("offset", 2);
  if (group.has("strength")) sample.link_strength = rows.positive("strength");
  sample.links.resize(length.size());
  for (std::size_t l = 0; l < length.size(); ++l) {
    Link& link = sample.links[l];
    link.a = ends[2 * l], link.b = ends[2 * l + 1];
    link.a_prev = tangent_a[2 * l], link.a_next = tangent_a[2 * l + 1];
    link.b_prev = tangent_b[2 * l], link.b_next = tangent_b[2 * l + 1];
    link.wall = wall[l], link.wall_end = wall_end[l];
    link.length = length[l], link.spacing = spacing[l];
    link.offset_n = offset[2 * l], link.offset_t = offset[2 * l + 1];
    check_link(group, sample, l);
  }
  if (is_periodic(sample)) read_images(group, sample);
}

void read_box(const h5::Node& file, Sample& sample) {
  const auto corners = points(Rows(file, 2, "corner").doubles("box", 2));
  sample.box = {corners[0], corners[1]};
  if (!((corners[1] - corners[0]).array() > 0).all())
    throw DataError(
        fmt::format("{}: 'box' runs from ({}, {}) to ({}, {}); the second corner must be the upper right one",
                    file.where(), corners[0].x(), corners[0].y(), corners[1].x(), corners[1].y()));
}

void read_periodic(const h5::Node& file, Sample& sample) {
  if (!file.has("periodic")) return;
  const auto flags = Rows(file, 2, "direction").flags("periodic", 1);
  sample.periodic = {flags[0] != 0, flags[1] != 0};
}

void check_format(const h5::Node& file) {
  if (!file.has_attribute("format"))
    throw DataError(
        fmt::format("{} is not a sample: its attribute 'format' is missing; must be '{}'", file.where(), kFormat));
  if (const auto format = file.text("format"); format != kFormat)
    throw DataError(fmt::format("{} is of the format '{}'; must be '{}'", file.where(), format, kFormat));
}

}  // namespace

void write_sample(h5::Node& group, const Sample& sample) {
  group.write_text("format", kFormat);
  group.write_text("scene", sample.scene_text);
  group.write_text("seed", std::to_string(sample.seed));
  group.write("box", interleaved({sample.box.lo, sample.box.hi}), 2);
  if (is_periodic(sample)) group.write("periodic", std::vector<std::uint8_t>{sample.periodic[0], sample.periodic[1]});

  auto nodes = group.make_group("nodes");
  nodes.write("x", interleaved(sample.x), 2);
  nodes.write("side", sample.side);
  nodes.write("rest_length", sample.rest_length);
  nodes.write("rest_angle", sample.rest_angle);
  nodes.write("hinge_length", sample.hinge_length);

  auto cells = group.make_group("cells");
  cells.write("begin", sample.cell_begin);
  cells.write("closed", sample.closed);
  cells.write("group", sample.group);
  cells.write("radius", sample.radius);
  cells.write("rest_area", sample.rest_area);
  cells.write("tile_area", sample.tile_area);
  if (!sample.cell_thickness.empty()) cells.write("thickness", sample.cell_thickness);
  cells.write_texts("group_names", sample.group_names);

  auto walls = group.make_group("walls");
  const auto& w = sample.walls;
  walls.write("cells",
              columns<Index>(
                  w, [](auto& e) { return e.cell_a; }, [](auto& e) { return e.cell_b; }),
              2);
  walls.write("length", column<double>(w, [](auto& e) { return e.length; }));

  auto links = group.make_group("links");
  const auto& l = sample.links;
  links.write("nodes",
              columns<Index>(
                  l, [](auto& e) { return e.a; }, [](auto& e) { return e.b; }),
              2);
  links.write("tangent_a",
              columns<Index>(
                  l, [](auto& e) { return e.a_prev; }, [](auto& e) { return e.a_next; }),
              2);
  links.write("tangent_b",
              columns<Index>(
                  l, [](auto& e) { return e.b_prev; }, [](auto& e) { return e.b_next; }),
              2);
  links.write("wall", column<Index>(l, [](auto& e) { return e.wall; }));
  links.write("wall_end", column<std::uint8_t>(l, [](auto& e) { return e.wall_end; }));
  links.write("length", column<double>(l, [](auto& e) { return e.length; }));
  links.write("spacing", column<double>(l, [](auto& e) { return e.spacing; }));
  links.write("offset",
              columns<double>(
                  l, [](auto& e) { return e.offset_n; }, [](auto& e) { return e.offset_t; }),
              2);
  if (!sample.link_strength.empty()) links.write("strength", sample.link_strength);
  if (is_periodic(sample))
    links.write("image",
                columns<Index>(
                    sample.link_image, [](auto& e) { return e[0]; }, [](auto& e) { return e[1]; }),
                2);
}

Sample read_sample(const h5::Node& group) {
  check_format(group);
  Sample sample;
  if (group.has_attribute("scene")) sample.scene_text = group.text("scene");
  if (group.has_attribute("seed")) {
    const std::string seed = group.text("seed");
    if (seed.empty() || seed.size() > 20 || seed.find_first_not_of("0123456789") != std::string::npos)
      throw DataError(fmt::format("{}: 'seed' is '{}'; must be a whole number as text", group.where(), seed));
    sample.seed = std::strtoull(seed.c_str(), nullptr, 10);
  }
  read_box(group, sample);
  read_periodic(group, sample);
  read_nodes(group.group("nodes"), sample);
  read_cells(group.group("cells"), sample.nodes(), sample);
  check_shells(group.group("nodes"), sample);
  read_walls(group.group("walls"), sample.cells(), sample);
  read_links(group.group("links"), sample.nodes(), sample);
  return sample;
}

void write_sample(const std::filesystem::path& path, const Sample& sample) {
  h5::replace_file(path, [&](h5::Node& file) { write_sample(file, sample); });
}

Sample read_sample(const std::filesystem::path& path) { return read_sample(h5::Node::open(path)); }

}  // namespace lamella
