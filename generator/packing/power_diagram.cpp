#include "generator/packing/power_diagram.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "generator/packing/spatial_order.h"
#include "generator/sample/union_find.h"

namespace lamella {
namespace {

struct Known {
  Index index = -1;
};
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<Known, Kernel, CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<Known, Kernel, CGAL::Regular_triangulation_face_base_2<Kernel>>;
using Triangulation = CGAL::Regular_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using Face = Triangulation::Face_handle;
using Point = Kernel::Weighted_point_2;

/// Where the three sites have equal power, relative to the first: 2 b.p = |b|^2 + w0 - w1 and 2 c.p = |c|^2 + w0 - w2.
template <class Number>
std::array<Number, 2> power_centre(const std::array<PowerSite, 3>& s) {
  const Number bx = Number(s[1].centre.x()) - Number(s[0].centre.x()),
               by = Number(s[1].centre.y()) - Number(s[0].centre.y()),
               cx = Number(s[2].centre.x()) - Number(s[0].centre.x()),
               cy = Number(s[2].centre.y()) - Number(s[0].centre.y());
  const Number right_b = bx * bx + by * by + (Number(s[0].weight) - Number(s[1].weight)),
               right_c = cx * cx + cy * cy + (Number(s[0].weight) - Number(s[2].weight)),
               determinant = 2 * (bx * cy - by * cx);
  return {(right_b * cy - right_c * by) / determinant, (bx * right_c - cx * right_b) / determinant};
}

Vec2 vertex_position(std::array<PowerSite, 3> s) {
  // Relative to the smallest disk, so that tiny cells far from the origin keep their digits.
  if (s[1].weight < s[0].weight) std::swap(s[0], s[1]);
  if (s[2].weight < s[0].weight) std::swap(s[0], s[2]);
  const Vec2 b = s[1].centre - s[0].centre, c = s[2].centre - s[0].centre;
  const double turn = cross(b, c);
  // Nearly collinear: the vertex is far away, and rounding could put it on the wrong side altogether.
  if (turn * turn < 1e-8 * b.squaredNorm() * c.squaredNorm()) {
    const auto p = power_centre<CGAL::Exact_rational>(s);
    return s[0].centre + Vec2(CGAL::to_double(p[0]), CGAL::to_double(p[1]));
  }
  const auto p = power_centre<double>(s);
  return s[0].centre + Vec2(p[0], p[1]);
}

/// Whether the power of q to the circle orthogonal to a, b and c is 0 may be in doubt: the determinant is compared with a
/// bound on its rounding (45 units in the last place of the sum of its terms' magnitudes, of which fewer than 20 can be lost).
bool may_be_cocircular(const std::array<Point, 3>& p, const Point& q) {
  std::array<double, 3> x, y, z, size;
  for (int k = 0; k < 3; ++k) {
    x[k] = p[k].x() - q.x(), y[k] = p[k].y() - q.y();
    const double square = x[k] * x[k] + y[k] * y[k];
    z[k] = square - (p[k].weight() - q.weight());
    size[k] = square + std::abs(p[k].weight()) + std::abs(q.weight());
  }
  double determinant = 0, magnitude = 0;
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    determinant += z[k] * (x[a] * y[b] - x[b] * y[a]);
    magnitude += size[k] * (std::abs(x[a] * y[b]) + std::abs(x[b] * y[a]));
  }
  return !(std::abs(determinant) > 1e-14 * magnitude);
}

/// Sites are numbered by Vertex::info, vertices of the diagram by Face::info: -1 for an infinite face.
class Builder {
 public:
  Builder(const std::vector<PowerSite>& sites, Index wanted) : sites_(sites), wanted_(wanted) {
    Face hint;
    for (const Index i : insertion_order(sites)) {
      const auto vertex = triangulation_.insert(point(sites[i]), hint);
      hint = vertex->face();
      Index& known = vertex->info().index;  // of a duplicate: then the first of them has the cell, in every image
      known = known < 0 ? i : std::min(known, i);
    }
  }

  PowerDiagram diagram() {
    diagram_.ring_begin.assign(wanted_, 0);
    diagram_.ring_end.assign(wanted_, 0);
    diagram_.order.reserve(wanted_);
    if (triangulation_.dimension() < 2) {
      collect_strips();
    } else {
      number_vertices();
      merge_cocircular();
      collect_rings();
      if (static_cast<std::size_t>(wanted_) < sites_.size()) collect_members();
    }
    return std::move(diagram_);
  }

 private:
  static Point point(const PowerSite& site) { return Point({site.centre.x(), site.centre.y()}, site.weight); }
  static Index site_of(Triangulation::Vertex_handle vertex) { return vertex->info().index; }

  /// Sites that lie on one line: no triangles; cells are strips, edges run from infinity to infinity.
  void collect_strips() {
    std::vector<std::array<Index, 2>> beside(sites_.size(), {-1, -1});
    if (triangulation_.dimension() == 1) {
      for (auto edge = triangulation_.finite_edges_begin(); edge != triangulation_.finite_edges_end(); ++edge) {
        const Index a = site_of(edge->first->vertex(0)), b = site_of(edge->first->vertex(1));
        beside[a][beside[a][0] < 0 ? 0 : 1] = b;
        beside[b][beside[b][0] < 0 ? 0 : 1] = a;
      }
    }
    for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end(); ++v) {
      const Index site = site_of(v);
      if (site >= wanted_) continue;
      begin_ring(site);
      for (const Index other : beside[site])
        if (other >= 0) add_edge(other, -1);
      end_ring(site);
    }
  }

  void number_vertices() {
    diagram_.vertices.reserve(triangulation_.number_of_faces());
    for (auto face = triangulation_.finite_faces_begin(); face != triangulation_.finite_faces_end(); ++face) {
      face->info().index = static_cast<Index>(diagram_.vertices.size());
      diagram_.vertices.push_back(vertex_position(
          {sites_[site_of(face->vertex(0))], sites_[site_of(face->vertex(1))], sites_[site_of(face->vertex(2))]}));
    }
  }

  /// Triangles on one and the same power circle are one vertex, with the number and position of the first of them.
  void merge_cocircular() {
    UnionFind merged;
    for (auto face = triangulation_.finite_faces_begin(); face != triangulation_.finite_faces_end(); ++face) {
      for (int i = 0; i < 3; ++i) {
        const Face other = face->neighbor(i);
        if (other->info().index <= face->info().index || !cocircular(face, other)) continue;
        if (merged.size() == 0) merged = UnionFind(static_cast<Index>(diagram_.vertices.size()));
        merged.join(face->info().index, other->info().index);
      }
    }
    if (merged.size() == 0) return;
    std::vector<Index> number(merged.size());
    Index count = 0;
    for (Index i = 0; i < merged.size(); ++i) {  // a root comes before all that it stands for
      const Index first = merged.root(i);
      if (first == i) diagram_.vertices[count] = diagram_.vertices[i];
      number[i] = first == i ? count++ : number[first];
    }
    diagram_.vertices.resize(count);
    for (auto face = triangulation_.finite_faces_begin(); face != triangulation_.finite_faces_end(); ++face)
      face->info().index = number[face->info().index];
  }

  bool cocircular(Face face, Face other) const {
    const std::array<Point, 3> p{face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point()};
    const Point& q = other->vertex(other->index(face))->point();
    return may_be_cocircular(p, q) && triangulation_.geom_traits().power_side_of_oriented_power_circle_2_object()(
                                          p[0], p[1], p[2], q) == CGAL::ON_ORIENTED_BOUNDARY;
  }

  void begin_ring(Index site) {
    diagram_.order.push_back(site);
    diagram_.ring_begin[site] = static_cast<Index>(diagram_.ring_site.size());
  }
  void add_edge(Index other, Index start) {
    diagram_.ring_site.push_back(other);
    diagram_.ring_vertex.push_back(start);
  }
  void end_ring(Index site) { diagram_.ring_end[site] = static_cast<Index>(diagram_.ring_site.size()); }

  void collect_rings() {
    diagram_.ring_site.reserve(6 * sites_.size());
    diagram_.ring_vertex.reserve(6 * sites_.size());
    for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end(); ++v) {
      if (site_of(v) < wanted_) collect_ring(v);
    }
  }

  void collect_ring(Triangulation::Vertex_handle v) {
    const Index site = site_of(v);
    begin_ring(site);
    bool bounded = true;
    const Face first = v->face();
    Face face = first;
    do {
      const int i = face->index(v);
      const Face next = face->neighbor(Triangulation::ccw(i));
      const Index start = face->info().index, end = next->info().index;
      bounded = bounded && start >= 0;
      const auto other = face->vertex(Triangulation::cw(i));
      if (!triangulation_.is_infinite(other) && (start < 0 || start != end)) add_edge(site_of(other), start);
      face = next;
    } while (face != first);
    end_ring(site);
    // A cell that is a point: the site would be hidden if its weight were any smaller.
    if (bounded && diagram_.ring_end[site] - diagram_.ring_begin[site] < 2) {
      diagram_.ring_site.resize(diagram_.ring_begin[site]);
      diagram_.ring_vertex.resize(diagram_.ring_begin[site]);
      diagram_.order.pop_back();
      diagram_.ring_end[site] = diagram_.ring_begin[site];
    }
  }

  void collect_members() {
    const std::size_t vertices = diagram_.vertices.size();
    std::vector<char> beside(vertices, 0);
    std::vector<std::pair<Index, Index>> members;  // vertex, site
    const auto each_corner = [&](auto visit) {
      for (auto face = triangulation_.finite_faces_begin(); face != triangulation_.finite_faces_end(); ++face)
        for (int i = 0; i < 3; ++i) visit(face->info().index, site_of(face->vertex(i)));
    };
    each_corner([&](Index vertex, Index site) { beside[vertex] |= static_cast<char>(site >= wanted_ ? 2 : 1); });
    each_corner([&](Index vertex, Index site) {
      if (beside[vertex] == 3) members.emplace_back(vertex, site);
    });
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
    diagram_.member_begin.assign(vertices + 1, 0);
    for (const auto& [vertex, site] : members) {
      ++diagram_.member_begin[vertex + 1];
      diagram_.member.push_back(site);
    }
    std::partial_sum(diagram_.member_begin.begin(), diagram_.member_begin.end(), diagram_.member_begin.begin());
  }

  const std::vector<PowerSite>& sites_;
  Index wanted_;
  Triangulation triangulation_;
  PowerDiagram diagram_;
};

}  // namespace

PowerDiagram power_diagram(const std::vector<PowerSite>& sites, Index wanted) {
  return Builder(sites, wanted).diagram();
}

}  // namespace lamella
