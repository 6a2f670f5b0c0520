#include "generator/tissue/notch.h"

#include <fmt/format.h>

#include <set>

#include "generator/sample/errors.h"
#include "generator/tissue/mosaic.h"

namespace lamella {
namespace {

bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) <= 0 && cross(d - c, a - c) * cross(d - c, b - c) <= 0;
}

}  // namespace

void cut_links(const std::vector<Vec2>& line, Sample& sample, Notes& notes) {
  if (line.size() < 2) throw SceneError("sample.notch.line: a cut needs at least two points");
  std::vector<Vec2> centre(static_cast<std::size_t>(sample.cells()));
  for (Index c = 0; c < sample.cells(); ++c)
    centre[c] = polygon_centre({sample.x.begin() + sample.cell_begin[c], sample.x.begin() + sample.cell_begin[c + 1]});
  const auto crossed = [&](const Vec2& from, const Vec2& to) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k)
      if (meet(line[k], line[k + 1], from, to)) return true;
    return false;
  };
  std::vector<char> wall_cut(sample.walls.size());
  for (std::size_t w = 0; w < sample.walls.size(); ++w)
    wall_cut[w] = crossed(centre[sample.walls[w].cell_a], centre[sample.walls[w].cell_b]);
  std::set<Index> walls;
  const auto cut = std::erase_if(sample.links, [&](const Link& link) {
    const bool absent = wall_cut[link.wall] || crossed(sample.x[link.a], sample.x[link.b]);
    if (absent) walls.insert(link.wall);
    return absent;
  });
  if (cut == 0) throw SceneError("sample.notch.line: the cut crosses no link of the tissue");
  notes.push_back(fmt::format("the notch cuts {} links of {} walls", cut, walls.size()));
}

}  // namespace lamella
