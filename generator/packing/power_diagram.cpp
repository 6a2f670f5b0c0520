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

namespace lamella {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel, CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<Index, Kernel, CGAL::Regular_triangulation_face_base_2<Kernel>>;
using Triangulation = CGAL::Regular_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

/// Where the three disks have equal power, relative to the first: 2 b.p = |b|^2 + w0 - w1 and 2 c.p = |c|^2 + w0 - w2.
template <class Number>
std::array<Number, 2> power_centre(const std::array<Disk, 3>& d) {
  const auto weight = [](const Disk& disk) { return Number(disk.radius * disk.radius); };  // as rounded for CGAL
  const Number bx = Number(d[1].centre.x()) - Number(d[0].centre.x()),
               by = Number(d[1].centre.y()) - Number(d[0].centre.y()),
               cx = Number(d[2].centre.x()) - Number(d[0].centre.x()),
               cy = Number(d[2].centre.y()) - Number(d[0].centre.y());
  const Number right_b = bx * bx + by * by + weight(d[0]) - weight(d[1]),
               right_c = cx * cx + cy * cy + weight(d[0]) - weight(d[2]), determinant = 2 * (bx * cy - by * cx);
  return {(right_b * cy - right_c * by) / determinant, (bx * right_c - cx * right_b) / determinant};
}

Vec2 vertex_position(std::array<Disk, 3> d) {
  // Relative to the smallest disk, so that tiny cells far from the origin keep their digits. All three in an order of their own: that in
  // which the triangulation names them depends on where it lies in memory, and the last bit on the order.
  const auto key = [](const Disk& disk) { return std::array{disk.radius, disk.centre.x(), disk.centre.y()}; };
  std::sort(d.begin(), d.end(), [&](const Disk& p, const Disk& q) { return key(p) < key(q); });
  const Vec2 b = d[1].centre - d[0].centre, c = d[2].centre - d[0].centre;
  // Nearly collinear: the vertex is far away, and rounding could put it on the wrong side altogether.
  if (std::abs(cross(b, c)) < 1e-4 * b.norm() * c.norm()) {
    const auto p = power_centre<CGAL::Exact_rational>(d);
    return d[0].centre + Vec2(CGAL::to_double(p[0]), CGAL::to_double(p[1]));
  }
  const auto p = power_centre<double>(d);
  return d[0].centre + Vec2(p[0], p[1]);
}

/// Disks that lie on one line, or a single one: no triangles; cells are strips, edges run from infinity to infinity.
void collect_strips(const Triangulation& triangulation, PowerDiagram& diagram, std::vector<std::vector<Index>>& rings) {
  if (triangulation.dimension() < 1) return;
  for (auto edge = triangulation.finite_edges_begin(); edge != triangulation.finite_edges_end(); ++edge) {
    const Index a = edge->first->vertex(0)->info(), b = edge->first->vertex(1)->info();
    for (const Index site : {a, b}) rings[site].push_back(static_cast<Index>(diagram.edges.size()));
    diagram.edges.push_back({.a = a, .b = b});
  }
}

void collect_cells(Triangulation& triangulation, const std::vector<Disk>& disks, PowerDiagram& diagram,
                   std::vector<std::vector<Index>>& rings) {
  Index faces = 0;
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
    face->info() = faces++;
    diagram.vertices.push_back(vertex_position(
        {disks[face->vertex(0)->info()], disks[face->vertex(1)->info()], disks[face->vertex(2)->info()]}));
  }
  for (auto face = triangulation.all_faces_begin(); face != triangulation.all_faces_end(); ++face)
    if (triangulation.is_infinite(face)) face->info() = faces++;
  const auto vertex_of = [&](Triangulation::Face_handle face) {
    return triangulation.is_infinite(face) ? -1 : face->info();
  };

  std::vector<std::array<Index, 3>> edge_of(faces, {-1, -1, -1});
  for (auto edge = triangulation.finite_edges_begin(); edge != triangulation.finite_edges_end(); ++edge) {
    const auto [face, i] = *edge;
    const auto [other, j] = triangulation.mirror_edge(*edge);
    edge_of[face->info()][i] = edge_of[other->info()][j] = static_cast<Index>(diagram.edges.size());
    // The face lies to the left of the way from its vertex ccw(i) to its vertex cw(i).
    diagram.edges.push_back({.a = face->vertex(triangulation.ccw(i))->info(),
                             .b = face->vertex(triangulation.cw(i))->info(),
                             .begin = vertex_of(other),
                             .end = vertex_of(face)});
  }
  for (auto vertex = triangulation.finite_vertices_begin(); vertex != triangulation.finite_vertices_end(); ++vertex) {
    const auto first = triangulation.incident_edges(vertex);
    auto edge = first;
    do {
      if (!triangulation.is_infinite(edge)) rings[vertex->info()].push_back(edge_of[edge->first->info()][edge->second]);
    } while (++edge != first);
  }
}

/// The triangulation lists edges, and their ends, as they lie in memory, which is not the same from one call to the next: here they are listed by
/// their sites, from the lower to the higher, and rings begin with their first edge.
void put_in_order(PowerDiagram& diagram, std::vector<std::vector<Index>>& rings) {
  for (PowerEdge& edge : diagram.edges)
    if (edge.b < edge.a) std::swap(edge.a, edge.b), std::swap(edge.begin, edge.end);
  std::vector<Index> order(diagram.edges.size()), rank(diagram.edges.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](Index e) { return std::pair{diagram.edges[e].a, diagram.edges[e].b}; };
  std::sort(order.begin(), order.end(), [&](Index e, Index f) { return key(e) < key(f); });
  std::vector<PowerEdge> sorted;
  sorted.reserve(order.size());
  for (const Index e : order) {
    rank[e] = static_cast<Index>(sorted.size());
    sorted.push_back(diagram.edges[e]);
  }
  diagram.edges = std::move(sorted);
  for (auto& ring : rings) {
    for (Index& e : ring) e = rank[e];
    std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
  }
}

}  // namespace

PowerDiagram power_diagram(const std::vector<Disk>& disks, const std::vector<Index>& sites) {
  std::vector<std::pair<Kernel::Weighted_point_2, Index>> points;
  points.reserve(sites.size());
  for (const Index site : sites) {
    const Disk& disk = disks[site];
    points.emplace_back(Kernel::Weighted_point_2({disk.centre.x(), disk.centre.y()}, disk.radius * disk.radius), site);
  }
  Triangulation triangulation(points.begin(), points.end());

  PowerDiagram diagram;
  diagram.visible.assign(disks.size(), 0);
  for (auto vertex = triangulation.finite_vertices_begin(); vertex != triangulation.finite_vertices_end(); ++vertex)
    diagram.visible[vertex->info()] = 1;

  std::vector<std::vector<Index>> rings(disks.size());
  if (triangulation.dimension() < 2)
    collect_strips(triangulation, diagram, rings);
  else
    collect_cells(triangulation, disks, diagram, rings);
  put_in_order(diagram, rings);

  diagram.ring_begin.push_back(0);
  for (const auto& ring : rings) {
    diagram.ring.insert(diagram.ring.end(), ring.begin(), ring.end());
    diagram.ring_begin.push_back(static_cast<Index>(diagram.ring.size()));
  }
  return diagram;
}

}  // namespace lamella
