#include "generator/tissue/mosaic_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <unordered_map>

namespace lamella {
namespace {

using Text = fmt::memory_buffer;

template <class... T>
void put(Text& text, fmt::format_string<T...> format, T&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<T>(values)...);
}

std::string taken(const Text& text) { return {text.data(), text.size()}; }

/// Edges numbered from 1 as they are met, each from its lower vertex to its higher.
class EdgeNumbers {
 public:
  /// Positive along the edge, negative against it: as .tess writes the edges of a face.
  int signed_number(Index from, Index to) {
    const auto low = static_cast<std::uint64_t>(std::min(from, to)),
               high = static_cast<std::uint64_t>(std::max(from, to));
    const auto [known, fresh] = number_.try_emplace(low << 32 | high, static_cast<int>(ends_.size()) + 1);
    if (fresh) ends_.push_back({std::min(from, to), std::max(from, to)});
    return from < to ? known->second : -known->second;
  }
  const std::vector<std::array<Index, 2>>& ends() const { return ends_; }

 private:
  std::unordered_map<std::uint64_t, int> number_;
  std::vector<std::array<Index, 2>> ends_;
};

double filled_area(const PlainMosaic& plain) {
  double area = 0;
  std::vector<Vec2> points;
  for (const auto& cell : plain.cells) {
    points.clear();
    for (const Index v : cell) points.push_back(plain.vertices[v]);
    area += polygon_area(points);
  }
  return area;
}

struct DomainSide {
  const char* label;
  int axis;
  double at;
  int from, to;  // corners of the domain, numbered from 1
};

/// The domain of a tessellation that fills a rectangle, which Neper calls a cube in two dimensions too: its corners and
/// sides, with the tessellation's vertices and edges that lie there.
void put_domain(Text& text, const PlainMosaic& plain, const Box& box, const EdgeNumbers& edges) {
  const std::array<Vec2, 4> corners{box.lo, Vec2(box.hi.x(), box.lo.y()), box.hi, Vec2(box.lo.x(), box.hi.y())};
  const std::array<const char*, 4> labels{"x0y0", "x1y0", "x1y1", "x0y1"};
  put(text, " **domain\n  *general\n   cube\n  *vertex\n   4\n");
  for (int k = 0; k < 4; ++k) {
    std::size_t vertex = 0;
    while (vertex < plain.vertices.size() && plain.vertices[vertex] != corners[k]) ++vertex;
    put(text, "   {} {} {} 0 {}\n      1 {}\n", k + 1, corners[k].x(), corners[k].y(), labels[k], vertex + 1);
  }
  const std::array<DomainSide, 4> sides{{{"y0", 1, box.lo.y(), 1, 2},
                                         {"x1", 0, box.hi.x(), 2, 3},
                                         {"y1", 1, box.hi.y(), 4, 3},
                                         {"x0", 0, box.lo.x(), 1, 4}}};
  put(text, "  *edge\n   4\n");
  for (int k = 0; k < 4; ++k) {
    const DomainSide& side = sides[k];
    std::vector<std::size_t> there;
    for (std::size_t e = 0; e < edges.ends().size(); ++e) {
      const auto [a, b] = edges.ends()[e];
      if (plain.vertices[a][side.axis] == side.at && plain.vertices[b][side.axis] == side.at) there.push_back(e + 1);
    }
    put(text, "   {} 2 {} {}\n     line\n     0\n     {}\n     {} {}\n", k + 1, side.from, side.to, side.label,
        there.size(), fmt::join(there, " "));
  }
}

bool fills(const PlainMosaic& plain, const Mosaic& mosaic) {
  if (mosaic.periodic[0] || mosaic.periodic[1]) return false;
  return std::abs(filled_area(plain) - mosaic.box.area()) <= 1e-9 * mosaic.box.area();
}

}  // namespace

PlainMosaic in_one_piece(const Mosaic& mosaic) {
  const auto image_of = [](const MosaicCell& cell, std::size_t k) {
    return cell.image.empty() ? Image{0, 0} : cell.image[k];
  };
  std::vector<bool> used(mosaic.vertices.size(), false);
  for (const MosaicCell& cell : mosaic.cells)
    for (std::size_t k = 0; k < cell.vertex.size(); ++k)
      if (image_of(cell, k) == Image{0, 0}) used[cell.vertex[k]] = true;
  PlainMosaic plain;
  std::vector<Index> place(mosaic.vertices.size(), -1);
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    place[v] = static_cast<Index>(plain.vertices.size());
    plain.vertices.push_back(mosaic.vertices[v]);
  }
  std::map<std::tuple<Index, int, int>, Index> displaced;
  for (const MosaicCell& cell : mosaic.cells) {
    auto& corners = plain.cells.emplace_back();
    for (std::size_t k = 0; k < cell.vertex.size(); ++k) {
      const Image image = image_of(cell, k);
      if (image == Image{0, 0}) {
        corners.push_back(place[cell.vertex[k]]);
        continue;
      }
      const auto [known, fresh] =
          displaced.try_emplace({cell.vertex[k], image[0], image[1]}, static_cast<Index>(plain.vertices.size()));
      if (fresh) plain.vertices.push_back(mosaic.vertices[cell.vertex[k]] + displacement(image, mosaic.box));
      corners.push_back(known->second);
    }
  }
  return plain;
}

std::string tess_text(const Mosaic& mosaic, const std::vector<Disk>& seeds) {
  const PlainMosaic plain = in_one_piece(mosaic);
  EdgeNumbers edges;
  std::vector<std::vector<int>> edges_of(plain.cells.size());
  for (std::size_t c = 0; c < plain.cells.size(); ++c) {
    const auto& cell = plain.cells[c];
    for (std::size_t k = 0; k < cell.size(); ++k)
      edges_of[c].push_back(edges.signed_number(cell[k], cell[(k + 1) % cell.size()]));
  }
  Text text;
  put(text, "***tess\n **format\n   3.4\n **general\n   2 standard\n **cell\n  {}\n  *id\n", plain.cells.size());
  for (std::size_t c = 0; c < plain.cells.size(); ++c) put(text, "   {}\n", c + 1);
  put(text, "  *crysym\n   triclinic\n");
  if (!seeds.empty()) put(text, "  *seed\n");
  for (std::size_t c = 0; c < seeds.size(); ++c)
    put(text, "   {} {} {} 0 {}\n", c + 1, seeds[c].centre.x(), seeds[c].centre.y(), seeds[c].radius);
  put(text, " **vertex\n {}\n", plain.vertices.size());
  for (std::size_t v = 0; v < plain.vertices.size(); ++v)
    put(text, "   {} {} {} 0 0\n", v + 1, plain.vertices[v].x(), plain.vertices[v].y());
  put(text, " **edge\n {}\n", edges.ends().size());
  for (std::size_t e = 0; e < edges.ends().size(); ++e)
    put(text, "   {} {} {} 0\n", e + 1, edges.ends()[e][0] + 1, edges.ends()[e][1] + 1);
  put(text, " **face\n {}\n", plain.cells.size());
  for (std::size_t c = 0; c < plain.cells.size(); ++c) {
    const auto& cell = plain.cells[c];
    put(text, "   {} {}", c + 1, cell.size());
    for (const Index v : cell) put(text, " {}", v + 1);
    put(text, "\n     {} {}\n     0 0 0 1\n     0 -1 0 0 0\n", cell.size(), fmt::join(edges_of[c], " "));
  }
  if (fills(plain, mosaic)) put_domain(text, plain, mosaic.box, edges);
  put(text, "***end\n");
  return taken(text);
}

std::string off_text(const Mosaic& mosaic) {
  const PlainMosaic plain = in_one_piece(mosaic);
  Text text;
  put(text, "OFF\n{} {} 0\n", plain.vertices.size(), plain.cells.size());
  for (const Vec2& x : plain.vertices) put(text, "{} {} 0\n", x.x(), x.y());
  for (const auto& cell : plain.cells) put(text, "{} {}\n", cell.size(), fmt::join(cell, " "));
  return taken(text);
}

std::string polygons_text(const Mosaic& mosaic) {
  const PlainMosaic plain = in_one_piece(mosaic);
  Text text;
  put(text, "x y cell\n");
  for (std::size_t c = 0; c < plain.cells.size(); ++c)
    for (const Index v : plain.cells[c]) put(text, "{} {} {}\n", plain.vertices[v].x(), plain.vertices[v].y(), c);
  return taken(text);
}

}  // namespace lamella
