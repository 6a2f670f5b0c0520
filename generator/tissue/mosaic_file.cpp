#include "generator/tissue/mosaic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/sample/errors.h"
#include "generator/sample/sample_file.h"

namespace lamella {
namespace {

constexpr const char* kGroup = "tiles";

/// Arrays over all corners of all tiles, tile by tile.
struct Corners {
  std::vector<Index> begin{0}, vertex;
  std::vector<std::uint8_t> side;
  std::vector<std::int32_t> image;  // two a corner; empty where nothing is periodic
};

Corners corners_of(const Mosaic& tiles) {
  Corners all;
  const bool periodic = tiles.periodic[0] || tiles.periodic[1];
  for (const MosaicCell& tile : tiles.cells) {
    all.vertex.insert(all.vertex.end(), tile.vertex.begin(), tile.vertex.end());
    all.side.insert(all.side.end(), tile.side.begin(), tile.side.end());
    all.side.resize(all.vertex.size(), 0);
    all.begin.push_back(static_cast<Index>(all.vertex.size()));
    if (!periodic) continue;
    for (std::size_t k = 0; k < tile.vertex.size(); ++k)
      for (const int axis : {0, 1}) all.image.push_back(tile.image.empty() ? 0 : tile.image[k][axis]);
  }
  return all;
}

[[noreturn]] void refuse(const h5::Node& group, const std::string& what) {
  throw DataError(group.where() + ": " + what);
}

Corners read_corners(const h5::Node& group, std::size_t vertices) {
  Corners all;
  all.begin = group.ints("begin");
  all.vertex = group.ints("vertex");
  all.side = group.bytes("side");
  if (all.begin.size() < 2 || all.begin.front() != 0 || all.begin.back() != static_cast<Index>(all.vertex.size()) ||
      all.side.size() != all.vertex.size())
    refuse(group, fmt::format("'begin' does not divide the {} rows of 'vertex' and 'side'", all.vertex.size()));
  for (std::size_t t = 0; t + 1 < all.begin.size(); ++t)
    if (all.begin[t + 1] < all.begin[t] || all.begin[t + 1] - std::int64_t{all.begin[t]} < 3)
      refuse(group, fmt::format("tile {} has fewer than 3 corners", t));
  for (const Index v : all.vertex)
    if (v < 0 || v >= static_cast<Index>(vertices))
      refuse(group, fmt::format("'vertex' names {}; there are {} vertices", v, vertices));
  if (group.has("image")) {
    all.image = group.ints("image", 2);
    if (all.image.size() != 2 * all.vertex.size()) refuse(group, "'image' must have one row per corner");
    if (std::any_of(all.image.begin(), all.image.end(), [](int i) { return std::abs(i) > 100; }))
      refuse(group, "'image' is larger than 100");
  }
  return all;
}

Mosaic read(const h5::Node& file) {
  const h5::Node group = file.group(kGroup);
  Mosaic tiles;
  const auto box = file.doubles("box", 2);
  if (box.size() != 4) refuse(file, "'box' must have 2 rows");
  tiles.box = {Vec2(box[0], box[1]), Vec2(box[2], box[3])};
  const auto x = group.doubles("x", 2);
  for (std::size_t v = 0; v + 1 < x.size(); v += 2) {
    if (!std::isfinite(x[v]) || !std::isfinite(x[v + 1]))
      refuse(group, fmt::format("'x' of vertex {} is not finite", v / 2));
    tiles.vertices.emplace_back(x[v], x[v + 1]);
  }
  const Corners all = read_corners(group, tiles.vertices.size());
  const auto names = group.texts("groups");
  const auto group_of = group.ints("group");
  if (group_of.size() + 1 != all.begin.size()) refuse(group, "'group' must have one row per tile");
  const auto numbers = group.has("number") ? group.longs("number") : std::vector<std::int64_t>{};
  if (!numbers.empty() && numbers.size() != group_of.size()) refuse(group, "'number' must have one row per tile");
  for (std::size_t t = 0; t + 1 < all.begin.size(); ++t) {
    if (group_of[t] < 0 || group_of[t] >= static_cast<Index>(names.size()))
      refuse(group, fmt::format("'group' of tile {} is {}; there are {} names", t, group_of[t], names.size()));
    MosaicCell tile;
    tile.vertex.assign(all.vertex.begin() + all.begin[t], all.vertex.begin() + all.begin[t + 1]);
    tile.side.assign(all.side.begin() + all.begin[t], all.side.begin() + all.begin[t + 1]);
    tile.name = fmt::format("cell {}", t);
    if (!numbers.empty()) tile.number = numbers[t];
    tile.group = names[group_of[t]];
    for (Index k = all.begin[t]; k < all.begin[t + 1] && !all.image.empty(); ++k)
      tile.image.push_back(
          {static_cast<std::int8_t>(all.image[2 * k]), static_cast<std::int8_t>(all.image[2 * k + 1])});
    tiles.cells.push_back(std::move(tile));
  }
  const std::string periodic = group.text("periodic");
  tiles.periodic = {periodic.find('x') != std::string::npos, periodic.find('y') != std::string::npos};
  return tiles;
}

void write(h5::Node& file, const Mosaic& tiles) {
  h5::Node group = file.make_group(kGroup);
  std::vector<double> x;
  for (const Vec2& v : tiles.vertices) x.insert(x.end(), {v.x(), v.y()});
  group.write("x", x, 2);
  const Corners all = corners_of(tiles);
  group.write("begin", all.begin);
  group.write("vertex", all.vertex);
  group.write("side", all.side);
  if (!all.image.empty()) group.write("image", all.image, 2);
  std::vector<std::string> names;
  std::vector<Index> group_of;
  for (const MosaicCell& tile : tiles.cells) {
    const auto known = std::find(names.begin(), names.end(), tile.group);
    group_of.push_back(static_cast<Index>(known - names.begin()));
    if (known == names.end()) names.push_back(tile.group);
  }
  group.write("group", group_of);
  std::vector<std::int64_t> numbers;
  for (const MosaicCell& tile : tiles.cells) numbers.push_back(tile.number);
  if (std::any_of(numbers.begin(), numbers.end(), [](std::int64_t k) { return k >= 0; }))
    group.write("number", numbers);
  group.write_texts("groups", names);
  group.write_text("periodic", std::string(tiles.periodic[0] ? "x" : "") + (tiles.periodic[1] ? "y" : ""));
}

}  // namespace

void write_sample(const std::filesystem::path& path, const Sample& sample, const Mosaic& tiles) {
  h5::replace_file(path, [&](h5::Node& file) {
    write_sample(file, sample);
    if (!tiles.cells.empty()) write(file, tiles);
  });
}

std::optional<Mosaic> read_tiles(const std::filesystem::path& path) {
  const h5::Node file = h5::Node::open(path);
  if (!file.has(kGroup)) return {};
  return read(file);
}

}  // namespace lamella
