#include "generator/packing/tess_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

#include "generator/packing/word_reader.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

constexpr int kLargest = std::numeric_limits<int>::max();

using Edge = std::pair<Index, Index>;  // of vertices, the lower first

Edge edge_between(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// Words up to the next that begins with `*`.
void pass_over(WordReader& in) {
  while (!in.at_end() && in.peek().front() != '*') in.next("a word");
}

void read_head(WordReader& in) {
  if (in.peek() != "***tess") {
    in.next("***tess");
    in.refuse("no tessellation of Neper's; a .tess file begins with ***tess");
  }
  in.next("***tess");
  in.expect("**format");
  const std::string version(in.next("the version of the format"));
  if (version.find_first_not_of("0123456789.") != std::string::npos || version.starts_with("0") ||
      version.starts_with("1."))
    in.refuse(fmt::format("the format is \"{}\"; must be 2.0 or later", shown(version)));
  in.expect("**general");
  if (const int dimension = in.whole("the dimension", 1, 3); dimension != 2)
    in.refuse(fmt::format("a tessellation of dimension {}; must be 2 (neper -T -dim 2)", dimension));
  in.next("the type");
}

Vec2 read_point(WordReader& in, const std::string& what) {
  const double x = in.number("x of " + what), y = in.number("y of " + what), z = in.number("z of " + what);
  if (z != 0) in.refuse(fmt::format("z of {} is {}; must be 0 in two dimensions", what, z));
  return {x, y};
}

void read_seeds(WordReader& in, int cells, TessFile& tess) {
  if (!tess.seeds.empty()) in.refuse("a second *seed");
  for (int k = 1; k <= cells; ++k) {
    if (in.whole("the seed's number", 1, cells) != k) in.refuse(fmt::format("seeds must be in order: {} follows", k));
    TessSeed seed;
    seed.line = in.line();
    const std::string name = fmt::format("seed {}", k);
    seed.at = read_point(in, name);
    seed.weight = in.number("the weight of " + name);
    if (seed.weight < 0)
      in.refuse(fmt::format("the weight of {} is {}; a radius must not be negative", name, seed.weight));
    tess.seeds.push_back(seed);
  }
}

void read_cells(WordReader& in, TessFile& tess) {
  in.expect("**cell");
  const int cells = in.count("the number of cells");
  if (cells == 0) in.refuse("no cells; there must be at least one");
  for (int k = 1; k <= cells; ++k) tess.id.push_back(k);
  while (!in.at_end() && !in.peek().starts_with("**")) {
    const std::string section(in.next("a section"));
    if (section == "*id") {
      std::map<int, int> seen;
      for (int& id : tess.id) {
        id = in.whole("a cell's id", 1, kLargest);
        if (const auto [known, fresh] = seen.try_emplace(id, in.line()); !fresh)
          in.refuse(fmt::format("cell {} is there twice, first in line {}", id, known->second));
      }
    } else if (section == "*seed") {
      read_seeds(in, cells, tess);
    } else if (section.front() == '*') {
      pass_over(in);
    } else {
      in.refuse(fmt::format("\"{}\" where a section of **cell or **vertex should be", shown(section)));
    }
  }
}

void read_vertices(WordReader& in, TessFile& tess) {
  in.expect("**vertex");
  const int count = in.count("the number of vertices");
  for (int k = 1; k <= count; ++k) {
    if (in.whole("the vertex's number", 1, count) != k)
      in.refuse(fmt::format("vertices must be in order: {} follows", k));
    tess.vertex_line.push_back(in.line());
    tess.vertices.push_back(read_point(in, fmt::format("vertex {}", k)));
    in.whole("the vertex's state", -1, kLargest);
  }
}

std::vector<Edge> read_edges(WordReader& in, const TessFile& tess) {
  in.expect("**edge");
  const int count = in.count("the number of edges");
  const int vertices = static_cast<int>(tess.vertices.size());
  std::vector<Edge> edges;
  for (int k = 1; k <= count; ++k) {
    if (in.whole("the edge's number", 1, count) != k) in.refuse(fmt::format("edges must be in order: {} follows", k));
    const int a = in.whole("an edge's vertex", 1, vertices), b = in.whole("an edge's vertex", 1, vertices);
    edges.push_back(edge_between(a - 1, b - 1));
    in.whole("the edge's state", -1, kLargest);
  }
  return edges;
}

void read_face(WordReader& in, const std::vector<Edge>& edges, TessFile& tess) {
  const int number = static_cast<int>(tess.faces.size()) + 1;
  if (in.whole("the face's number", 1, kLargest) != number)
    in.refuse(fmt::format("faces must be in order: {} follows", number));
  TessFace face;
  face.line = in.line();
  const int count = in.count("the number of the face's vertices");
  if (count < 3) in.refuse(fmt::format("face {} has {} vertices; it needs at least 3", number, count));
  for (int k = 0; k < count; ++k)
    face.vertex.push_back(in.whole("a face's vertex", 1, static_cast<int>(tess.vertices.size())) - 1);
  auto sorted = face.vertex;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
    in.refuse(fmt::format("face {} has vertex {} twice", number, *twice + 1));
  if (const int sides = in.count("the number of the face's edges"); sides != count)
    in.refuse(fmt::format("face {} has {} vertices and {} edges; must be as many", number, count, sides));
  std::vector<Edge> named, between;
  const int most = static_cast<int>(edges.size());
  for (int k = 0; k < count; ++k) {
    const int edge = in.whole("a face's edge", -most, most);
    if (edge == 0) in.refuse("a face's edge is 0; edges are numbered from 1");
    named.push_back(edges[std::abs(edge) - 1]);
    between.push_back(edge_between(face.vertex[k], face.vertex[(k + 1) % count]));
  }
  std::sort(named.begin(), named.end());
  std::sort(between.begin(), between.end());
  if (named != between) in.refuse(fmt::format("the edges of face {} are not those between its vertices", number));
  for (const char* what : {"d", "a", "b", "c"}) in.number(fmt::format("{} of the face's plane", what));
  in.whole("the face's state", -1, kLargest);
  in.whole("the face's point", -1, kLargest);
  for (int k = 0; k < 3; ++k) in.number("the face's point");
  tess.faces.push_back(std::move(face));
}

}  // namespace

TessFile read_tess(const std::filesystem::path& path) {
  WordReader in(path, "a tessellation of Neper's (.tess)");
  TessFile tess;
  read_head(in);
  read_cells(in, tess);
  read_vertices(in, tess);
  const std::vector<Edge> edges = read_edges(in, tess);
  in.expect("**face");
  const int faces = in.count("the number of faces");
  if (faces != static_cast<int>(tess.id.size()))
    in.refuse(fmt::format("{} faces for {} cells; in two dimensions every cell is a face", faces, tess.id.size()));
  for (int k = 0; k < faces; ++k) read_face(in, edges, tess);
  while (in.peek() != "***end") {
    const std::string word(in.next("***end"));
    if (word == "**periodicity") tess.periodic = true;
  }
  return tess;
}

Packing read_tess_seeds(const std::filesystem::path& path, const Box* box) {
  const TessFile tess = read_tess(path);
  const std::string file = path.string();
  if (tess.seeds.empty())
    throw SceneError(
        fmt::format("{}: has no *seed in **cell; without seeds it can be read as cells: kind = "
                    "\"polygons\", file = \"{}\"",
                    file, path.filename().string()));
  Packing packing;
  packing.box = {tess.vertices.front(), tess.vertices.front()};
  for (const Vec2& x : tess.vertices) {
    packing.box.lo = packing.box.lo.cwiseMin(x);
    packing.box.hi = packing.box.hi.cwiseMax(x);
  }
  if (box) packing.box = *box;
  double least = std::numeric_limits<double>::max();
  for (const TessSeed& seed : tess.seeds) least = std::min(least, seed.weight);
  // A disk has a radius, a seed of an ordinary Voronoi tessellation has none: a thousandth of the mean tile's size.
  const double area = packing.box.area() / static_cast<double>(tess.seeds.size());
  const double added = least > 0 ? 0 : 1e-6 * area;
  if (added > 0)
    packing.notes.push_back(fmt::format(
        "{}: seeds of weight 0; {:.3g} m2 added to the square of all weights, which changes no tile", file, added));
  std::map<std::pair<double, double>, int> line_of;
  std::vector<std::string> faults;
  for (const TessSeed& seed : tess.seeds) {
    const auto [known, fresh] = line_of.try_emplace({seed.at.x(), seed.at.y()}, seed.line);
    if (!fresh)
      faults.push_back(fmt::format("{}:{}: a seed at the place of the one in line {}", file, seed.line, known->second));
    if (!packing.box.contains(seed.at))
      faults.push_back(fmt::format(
          "{}:{}: the seed ({:.9g}, {:.9g}) lies outside the box [{:.9g}, {:.9g}] x [{:.9g}, {:.9g}]", file, seed.line,
          seed.at.x(), seed.at.y(), packing.box.lo.x(), packing.box.hi.x(), packing.box.lo.y(), packing.box.hi.y()));
    packing.disks.push_back({seed.at, std::sqrt(seed.weight * seed.weight + added)});
  }
  if (faults.size() > 50) faults.resize(50);
  if (!faults.empty()) throw SceneError(faults);
  packing.fraction = area_fraction(packing.disks, packing.box);
  return packing;
}

}  // namespace lamella
