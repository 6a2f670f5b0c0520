// Measures and checks of a tessellation, however it was made.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>

#include "generator/packing/laguerre.h"

namespace lamella {
namespace {

bool on_side(const Box& box, const Vec2& p, Index side) {
  switch (side) {
    case kLeftSide:
      return p.x() == box.lo.x();
    case kRightSide:
      return p.x() == box.hi.x();
    case kBottomSide:
      return p.y() == box.lo.y();
    default:
      return p.y() == box.hi.y();
  }
}

Image image_of(const std::vector<Image>& images, std::size_t k) { return images.empty() ? Image{0, 0} : images[k]; }

bool periodic(const Tessellation& t) { return t.periodic[0] || t.periodic[1]; }

void check_indices(const Tessellation& t, const Tile& tile, std::vector<std::string>& faults) {
  const std::size_t n = tile.vertex.size(), images = periodic(t) ? n : 0;
  if (n < 3 || tile.neighbour.size() != n || tile.image.size() != images || tile.across.size() != images)
    faults.push_back(fmt::format("tile {}: {} vertices, {} neighbours and {} images of each", tile.site, n,
                                 tile.neighbour.size(), std::min(tile.image.size(), tile.across.size())));
  for (const Index v : tile.vertex)
    if (v < 0 || v >= static_cast<Index>(t.vertices.size()))
      faults.push_back(fmt::format("tile {}: no vertex {}", tile.site, v));
}

void check_shape(const Tessellation& t, const Tile& tile, std::vector<std::string>& faults) {
  const double area = tile_area(t, tile);
  if (!(area > 0)) faults.push_back(fmt::format("tile {}: area {}", tile.site, area));
  // Shorter than this, directions are rounding.
  const double scale2 = t.box.area() / static_cast<double>(t.tiles.size());
  const std::size_t n = tile.vertex.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 u = corner(t, tile, k), v = corner(t, tile, (k + 1) % n), w = corner(t, tile, (k + 2) % n);
    if (cross(v - u, w - v) < -1e-12 * scale2)
      faults.push_back(fmt::format("tile {} is not convex at vertex {}", tile.site, tile.vertex[(k + 1) % n]));
    if (tile.neighbour[k] < 0 && !(on_side(t.box, u, tile.neighbour[k]) && on_side(t.box, v, tile.neighbour[k])))
      faults.push_back(fmt::format("tile {}: edge {} {} does not lie on its side of the box", tile.site, tile.vertex[k],
                                   tile.vertex[(k + 1) % n]));
  }
}

/// An edge as its tile sees it.
struct EdgeSide {
  Index tile, neighbour;
  std::array<int, 2> across;
  Index from, to;
  std::array<int, 2> from_image, to_image;
  auto operator<=>(const EdgeSide&) const = default;

  /// The same edge as the neighbour sees it, whose tile lies where its own site is.
  EdgeSide seen_from_across() const {
    const auto minus = [&](const std::array<int, 2>& a) { return std::array{a[0] - across[0], a[1] - across[1]}; };
    return {neighbour, tile, {-across[0], -across[1]}, to, from, minus(to_image), minus(from_image)};
  }
};

/// Each wall has two sides with the same two vertices, and V - E + F is that of a disk, an annulus or a torus.
void check_walls(const Tessellation& t, std::vector<std::string>& faults) {
  const auto wide = [](const Image& image) { return std::array<int, 2>{image[0], image[1]}; };
  std::vector<EdgeSide> sides;
  std::vector<char> used(t.vertices.size(), 0);
  Index boundary = 0;
  for (const Tile& tile : t.tiles) {
    const std::size_t n = tile.vertex.size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = (k + 1) % n;
      used[tile.vertex[k]] = 1;
      if (tile.neighbour[k] < 0)
        ++boundary;
      else
        sides.push_back({tile.site, tile.neighbour[k], wide(image_of(tile.across, k)), tile.vertex[k],
                         tile.vertex[next], wide(image_of(tile.image, k)), wide(image_of(tile.image, next))});
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i > 0 && sides[i] == sides[i - 1])
      faults.push_back(fmt::format("tile {} has the edge {} {} twice", sides[i].tile, sides[i].from, sides[i].to));
    if (!std::binary_search(sides.begin(), sides.end(), sides[i].seen_from_across()))
      faults.push_back(fmt::format("the wall of tiles {} and {} has one side only", sides[i].tile, sides[i].neighbour));
  }
  const Index walls = static_cast<Index>(sides.size() / 2),
              vertices = static_cast<Index>(std::count(used.begin(), used.end(), 1));
  const Index euler = vertices - (walls + boundary) + static_cast<Index>(t.tiles.size());
  if (euler != (periodic(t) ? 0 : 1))
    faults.push_back(fmt::format("V - E + F = {} instead of {}", euler, periodic(t) ? 0 : 1));
}

}  // namespace

Vec2 corner(const Tessellation& tessellation, const Tile& tile, std::size_t k) {
  const Vec2& x = tessellation.vertices[tile.vertex[k]];
  return tile.image.empty() ? x : x + displacement(tile.image[k], tessellation.box);
}

double tile_area(const Tessellation& tessellation, const Tile& tile) {
  const Vec2 origin = corner(tessellation, tile, 0);
  double twice = 0;
  for (std::size_t k = 1; k + 1 < tile.vertex.size(); ++k)
    twice += cross(corner(tessellation, tile, k) - origin, corner(tessellation, tile, k + 1) - origin);
  return twice / 2;
}

Vec2 tile_centroid(const Tessellation& tessellation, const Tile& tile) {
  const Vec2 origin = corner(tessellation, tile, 0);
  double twice = 0;
  Vec2 moment = Vec2::Zero();
  for (std::size_t k = 1; k + 1 < tile.vertex.size(); ++k) {
    const Vec2 a = corner(tessellation, tile, k) - origin, b = corner(tessellation, tile, k + 1) - origin;
    twice += cross(a, b);
    moment += cross(a, b) * (a + b) / 3;
  }
  return origin + moment / twice;
}

double edge_length(const Tessellation& tessellation, const Tile& tile, std::size_t k) {
  return (corner(tessellation, tile, (k + 1) % tile.vertex.size()) - corner(tessellation, tile, k)).norm();
}

double mean_edge_length(const Tessellation& tessellation) {
  double sum = 0, sides = 0;
  for (const Tile& tile : tessellation.tiles)
    for (std::size_t k = 0; k < tile.vertex.size(); ++k)
      if (tile.neighbour[k] >= 0) sum += edge_length(tessellation, tile, k), ++sides;
  return sides > 0 ? sum / sides : 0;
}

std::vector<std::string> check_tessellation(const Tessellation& tessellation) {
  std::vector<std::string> faults;
  for (const Tile& tile : tessellation.tiles) check_indices(tessellation, tile, faults);
  if (!faults.empty()) return faults;
  long double sum = 0;  // in double, a hundred thousand equal areas all round the same way, to 2e-12 of their sum
  for (const Tile& tile : tessellation.tiles) {
    sum += tile_area(tessellation, tile);
    check_shape(tessellation, tile, faults);
  }
  check_walls(tessellation, faults);
  const double area = tessellation.box.area();
  if (!(std::abs(static_cast<double>(sum) - area) <= 1e-12 * area))
    faults.push_back(fmt::format("the areas sum to {:.17g} instead of {:.17g}", static_cast<double>(sum), area));
  return faults;
}

}  // namespace lamella
