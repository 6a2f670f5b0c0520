#include "postproc/vtk_meshes.h"

#include <algorithm>
#include <cmath>

#include "postproc/quantities/cell_energy.h"
#include "postproc/quantities/cell_shape.h"
#include "postproc/quantities/cell_stress.h"
#include "postproc/quantities/fragments.h"
#include "postproc/quantities/link_frame.h"

namespace lamella {
namespace {

std::vector<float> single(const std::vector<double>& values) { return {values.begin(), values.end()}; }

template <class Value>
void add_array(std::vector<MeshArray>& arrays, const std::string& name, std::vector<Value> data, int components = 1) {
  arrays.push_back({name, components, std::move(data)});
}

/// Vectors in the plane, stored row by row, as vectors in space.
std::vector<float> in_space(const std::vector<double>& flat) {
  std::vector<float> vectors;
  vectors.reserve(flat.size() / 2 * 3);
  for (std::size_t i = 0; i + 1 < flat.size(); i += 2) {
    vectors.push_back(static_cast<float>(flat[i]));
    vectors.push_back(static_cast<float>(flat[i + 1]));
    vectors.push_back(0);
  }
  return vectors;
}

std::vector<float> component(const std::vector<double>& flat, int which) {
  std::vector<float> values;
  for (std::size_t i = which; i < flat.size(); i += 2) values.push_back(static_cast<float>(flat[i]));
  return values;
}

}  // namespace

Mesh cells_mesh(const FrameView& view, double depth) {
  const Sample& sample = view.sample;
  Mesh mesh;
  mesh.kind = Mesh::Kind::kPolygons;
  mesh.points = view.x;
  std::vector<Index> cells;
  for (Index c = 0; c < sample.cells(); ++c) {
    if (!view.closed(c)) continue;
    cells.push_back(c);
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) mesh.connectivity.push_back(i);
    mesh.end_cell();
  }
  const auto numbers = [&](const std::string& name, auto&& of_cell) {
    std::vector<float> values;
    for (Index c : cells) values.push_back(static_cast<float>(of_cell(c)));
    add_array(mesh.cell_data, name, std::move(values));
  };
  const auto integers = [&](const std::string& name, auto&& of_cell) {
    std::vector<int> values;
    for (Index c : cells) values.push_back(of_cell(c));
    add_array(mesh.cell_data, name, std::move(values));
  };
  const auto list = [&](const std::string& name, const std::vector<double>& values) {
    if (!values.empty()) numbers(name, [&](Index c) { return values[c]; });
  };

  integers("cell_id", [](Index c) { return c; });
  integers("group", [&](Index c) { return sample.group[c]; });
  const CellEnergy energy = cell_energy(view);
  list("energy", energy.total);
  list("energy_stretch", energy.stretch);
  list("energy_bend", energy.bend);
  list("energy_core", energy.core);
  list("link_share", energy.link_share);
  if (const double w0 = link_reference_energy(view); w0 > 0)
    numbers("energy_over_w0", [&](Index c) { return energy.total[c] / w0; });
  if (const std::vector<double>* pressure = view.doubles("pressure")) list("pressure", *pressure);

  const std::vector<CellShape> shapes = cell_shapes(view);
  numbers("area", [&](Index c) { return shapes[c].area; });
  numbers("outline_area", [&](Index c) { return shapes[c].outline_area; });
  numbers("aspect", [&](Index c) { return shapes[c].aspect; });
  const std::vector<Stress> stresses = cell_stress(view, shapes, depth);
  std::vector<float> tensors;
  for (Index c : cells) {
    const Stress& s = stresses[c];
    for (double value : {s.xx, s.xy, 0.0, s.xy, s.yy, 0.0, 0.0, 0.0, 0.0}) tensors.push_back(static_cast<float>(value));
  }
  add_array(mesh.cell_data, "stress", std::move(tensors), 9);

  if (const std::vector<std::int32_t>* node = view.ints("contact_node")) {
    const std::vector<std::int32_t>& other = *view.ints("contact_cell");
    const std::vector<Index> cell_of = cell_of_node(sample);
    std::vector<int> count(sample.cells(), 0);
    for (std::size_t k = 0; k < node->size(); ++k) ++count[cell_of[(*node)[k]]], ++count[other[k]];
    integers("contacts", [&](Index c) { return count[c]; });
  }
  if (!sample.links.empty()) {
    const Fragments pieces = fragments(view);
    integers("fragment_id", [&](Index c) { return pieces.id[c]; });
  }
  return mesh;
}

Mesh walls_mesh(const FrameView& view) {
  const Sample& sample = view.sample;
  Mesh mesh;
  mesh.kind = Mesh::Kind::kLines;
  mesh.points = view.x;
  std::vector<Index> segments;
  std::vector<int> cell_id;
  for (Index c = 0; c < sample.cells(); ++c)
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) {
      if (!sample.starts_segment(c, i) || view.gone(i)) continue;
      segments.push_back(i);
      cell_id.push_back(c);
      mesh.connectivity.push_back(i);
      mesh.connectivity.push_back(sample.next(c, i));
      mesh.end_cell();
    }
  add_array(mesh.cell_data, "cell_id", std::move(cell_id));
  for (const char* name : {"axial_force", "bar_plastic_length"})
    if (const std::vector<double>* values = view.doubles(name)) {
      std::vector<float> of_segment;
      for (Index i : segments) of_segment.push_back(static_cast<float>((*values)[i]));
      add_array(mesh.cell_data, name, std::move(of_segment));
    }
  for (const char* name : {"moment", "hinge_plastic_angle"})
    if (const std::vector<double>* values = view.doubles(name)) add_array(mesh.point_data, name, single(*values));
  if (const std::vector<double>* v = view.doubles("v")) add_array(mesh.point_data, "velocity", in_space(*v), 3);
  if (const std::vector<double>* force = view.doubles("load_force"))
    add_array(mesh.point_data, "load_force", in_space(*force), 3);
  std::vector<double> displacement;
  for (Index i = 0; i < sample.nodes(); ++i)
    displacement.push_back(view.x[i].x() - sample.x[i].x()), displacement.push_back(view.x[i].y() - sample.x[i].y());
  add_array(mesh.point_data, "displacement", in_space(displacement), 3);
  return mesh;
}

Mesh links_mesh(const FrameView& view) {
  const Sample& sample = view.sample;
  Mesh mesh;
  mesh.kind = Mesh::Kind::kLines;
  std::vector<int> id, wall, intact;
  std::vector<float> opening;
  for (std::size_t l = 0; l < sample.links.size(); ++l) {
    const Link& link = sample.links[l];
    const Vec2 displaced = view.displaced(l);
    for (const Vec2& end : {view.x[link.a], Vec2(view.x[link.b] + displaced)}) {
      mesh.connectivity.push_back(static_cast<std::int64_t>(mesh.points.size()));
      mesh.points.push_back(end);
    }
    mesh.end_cell();
    id.push_back(static_cast<int>(l));
    wall.push_back(link.wall);
    intact.push_back(view.intact(static_cast<Index>(l)) ? 1 : 0);
    opening.push_back(static_cast<float>(link_opening(view.link(static_cast<Index>(l)), view.x, displaced)));
  }
  add_array(mesh.cell_data, "link_id", std::move(id));
  add_array(mesh.cell_data, "wall_id", std::move(wall));
  add_array(mesh.cell_data, "intact", std::move(intact));
  add_array(mesh.cell_data, "opening", std::move(opening));
  if (const std::vector<double>* force = view.doubles("link_force")) {
    add_array(mesh.cell_data, "f_n", component(*force, 0));
    add_array(mesh.cell_data, "f_t", component(*force, 1));
  }
  if (const std::vector<double>* energy = view.doubles("link_energy"))
    add_array(mesh.cell_data, "energy", single(*energy));
  if (const std::vector<double>* zeta = view.doubles("link_zeta")) add_array(mesh.cell_data, "zeta", single(*zeta));
  if (const std::vector<double>* damage = view.doubles("link_damage"))
    add_array(mesh.cell_data, "damage", single(*damage));
  if (const std::vector<double>* time = view.doubles("link_break_time"))
    add_array(mesh.cell_data, "break_time", single(*time));
  return mesh;
}

Mesh contacts_mesh(const FrameView& view) {
  Mesh mesh;
  mesh.kind = Mesh::Kind::kLines;
  const std::vector<std::int32_t>& node = *view.ints("contact_node");
  const std::vector<std::int32_t>& cell = *view.ints("contact_cell");
  const std::vector<double>& position = *view.doubles("contact_position");
  const std::vector<double>& normal = *view.doubles("contact_normal");
  const std::vector<double>& force = *view.doubles("contact_force");
  const std::vector<Index> cell_of = cell_of_node(view.sample);
  std::vector<int> nodes, cells_a, cells_b;
  std::vector<double> vectors;
  for (std::size_t k = 0; k < node.size(); ++k) {
    // From the node through the contact point, as far again: one contact alone still has an extent that a viewer can frame.
    const Vec2 at(position[2 * k], position[2 * k + 1]), from = view.x[node[k]];
    mesh.points.push_back(from);
    mesh.points.emplace_back(2 * at - from);
    mesh.connectivity.push_back(static_cast<std::int64_t>(2 * k));
    mesh.connectivity.push_back(static_cast<std::int64_t>(2 * k + 1));
    mesh.end_cell();
    nodes.push_back(node[k]), cells_a.push_back(cell_of[node[k]]), cells_b.push_back(cell[k]);
    const Vec2 n(normal[2 * k], normal[2 * k + 1]);
    const Vec2 f = force[2 * k] * n + force[2 * k + 1] * left_of(n);
    vectors.push_back(f.x()), vectors.push_back(f.y());
  }
  add_array(mesh.cell_data, "node_id", std::move(nodes));
  add_array(mesh.cell_data, "cell_a", std::move(cells_a));
  add_array(mesh.cell_data, "cell_b", std::move(cells_b));
  add_array(mesh.cell_data, "f_n", component(force, 0));
  add_array(mesh.cell_data, "f_t", component(force, 1));
  add_array(mesh.cell_data, "position", in_space(position), 3);
  add_array(mesh.cell_data, "normal", in_space(normal), 3);
  add_array(mesh.cell_data, "force", in_space(vectors), 3);
  if (const std::vector<std::int32_t>* sliding = view.ints("contact_sliding"))
    add_array(mesh.cell_data, "sliding", std::vector<int>(sliding->begin(), sliding->end()));
  return mesh;
}

Mesh cracks_mesh(const FrameView& view, const std::vector<Crack>& cracks) {
  Mesh mesh;
  mesh.kind = Mesh::Kind::kLines;
  std::vector<int> crack_id, branch, links, across;
  std::vector<float> length, opening, first_time, last_time, crack_length;
  for (std::size_t k = 0; k < cracks.size(); ++k)
    for (std::size_t b = 0; b < cracks[k].lines.size(); ++b) {
      const CrackLine& line = cracks[k].lines[b];
      std::vector<Vec2> points = line.points;
      if (points.size() == 1) {  // a lone link within its wall: as long as what it stands for
        const Link link = view.link(line.links[0]);
        const Vec2 displaced = view.displaced(line.links[0]);
        const Vec2 half = 0.5 * link.length * link_frame(link, view.x, displaced).t;
        points = {line.points[0] - half, line.points[0] + half};
      }
      for (const Vec2& p : points) {
        mesh.connectivity.push_back(static_cast<std::int64_t>(mesh.points.size()));
        mesh.points.push_back(p);
      }
      mesh.end_cell();
      crack_id.push_back(static_cast<int>(k)), branch.push_back(static_cast<int>(b));
      links.push_back(static_cast<int>(line.links.size()));
      across.push_back(cracks[k].from_side_to_side ? 1 : 0);
      length.push_back(static_cast<float>(line.length)), opening.push_back(static_cast<float>(line.opening));
      first_time.push_back(static_cast<float>(line.first_time)),
          last_time.push_back(static_cast<float>(line.last_time));
      crack_length.push_back(static_cast<float>(cracks[k].length));
    }
  add_array(mesh.cell_data, "crack_id", std::move(crack_id));
  add_array(mesh.cell_data, "branch", std::move(branch));
  add_array(mesh.cell_data, "broken_links", std::move(links));
  add_array(mesh.cell_data, "from_side_to_side", std::move(across));
  add_array(mesh.cell_data, "length", std::move(length));
  add_array(mesh.cell_data, "crack_length", std::move(crack_length));
  add_array(mesh.cell_data, "opening", std::move(opening));
  add_array(mesh.cell_data, "time", std::move(first_time));
  add_array(mesh.cell_data, "last_time", std::move(last_time));
  return mesh;
}

}  // namespace lamella
