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
  // A periodic sample has the cut in every image of its box.
  const auto crossed = [&](const Vec2& from, const Vec2& to) {
    for (const Vec2& way : ways_home(from, sample.box, sample.periodic))
      for (std::size_t k = 0; k + 1 < line.size(); ++k)
        if (meet(line[k], line[k + 1], from + way, to + way)) return true;
    return false;
  };
  std::vector<char> wall_cut(sample.walls.size());
  for (std::size_t l = 0; l < sample.links.size(); ++l) {
    const Wall& wall = sample.walls[sample.links[l].wall];
    if (l == 0 || sample.links[l].wall != sample.links[l - 1].wall)
      wall_cut[sample.links[l].wall] = crossed(centre[wall.cell_a], centre[wall.cell_b] + link_displacement(sample, l));
  }
  std::set<Index> walls;
  std::size_t kept = 0;
  for (std::size_t l = 0; l < sample.links.size(); ++l) {
    const Link link = sample.links[l];
    if (wall_cut[link.wall] || crossed(sample.x[link.a], sample.x[link.b] + link_displacement(sample, l))) {
      walls.insert(link.wall);
      continue;
    }
    if (!sample.link_image.empty()) sample.link_image[kept] = sample.link_image[l];
    if (!sample.link_strength.empty()) sample.link_strength[kept] = sample.link_strength[l];
    sample.links[kept++] = link;
  }
  const std::size_t cut = sample.links.size() - kept;
  if (cut == 0) throw SceneError("sample.notch.line: the cut crosses no link of the tissue");
  sample.links.resize(kept);
  if (!sample.link_image.empty()) sample.link_image.resize(kept);
  if (!sample.link_strength.empty()) sample.link_strength.resize(kept);
  notes.push_back(fmt::format("the notch cuts {} links of {} walls", cut, walls.size()));
}

}  // namespace lamella
