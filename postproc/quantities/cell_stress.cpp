#include "postproc/quantities/cell_stress.h"

#include "postproc/quantities/link_frame.h"

namespace lamella {

std::vector<Stress> cell_stress(const FrameView& view, const std::vector<CellShape>& shapes, double depth) {
  const Sample& sample = view.sample;
  // Positions count from the cell's centroid: forces that balance give the same sum, and forces that do not (a cell in
  // motion) do not bring in the distance to the origin.
  std::vector<Eigen::Matrix2d> moment(sample.cells(), Eigen::Matrix2d::Zero());
  const auto act = [&](Index cell, const Vec2& force, const Vec2& at) {
    moment[cell] += force * (at - shapes[cell].centroid).transpose();
  };

  const std::vector<Index> cell_of = cell_of_node(sample);
  if (const std::vector<double>* link_force = view.doubles("link_force"))
    for (std::size_t l = 0; l < sample.links.size(); ++l) {
      if (!view.intact(static_cast<Index>(l))) continue;
      const Link link = view.link(static_cast<Index>(l));
      const Vec2 displaced = view.displaced(l);
      const LinkFrame frame = link_frame(link, view.x, displaced);
      const Vec2 on_a = (*link_force)[2 * l] * frame.n + (*link_force)[2 * l + 1] * frame.t;
      const Vec2 middle = link_middle(link, view.x, displaced);
      act(cell_of[link.a], on_a, middle);
      act(cell_of[link.b], -on_a, middle - displaced);
    }

  if (const std::vector<double>* contact_force = view.doubles("contact_force")) {
    const std::vector<double>& position = *view.doubles("contact_position");
    const std::vector<double>& normal = *view.doubles("contact_normal");
    const std::vector<std::int32_t>& node = *view.ints("contact_node");
    const std::vector<std::int32_t>& cell = *view.ints("contact_cell");
    const std::vector<std::int32_t>* image = view.ints("contact_image");  // of the node, seen from the cell
    for (std::size_t k = 0; k < node.size(); ++k) {
      const Vec2 n(normal[2 * k], normal[2 * k + 1]), at(position[2 * k], position[2 * k + 1]);
      const Vec2 on_node = (*contact_force)[2 * k] * n + (*contact_force)[2 * k + 1] * left_of(n);
      act(cell_of[node[k]], on_node, at);
      const Vec2 displaced =
          image ? Vec2((*image)[2 * k], (*image)[2 * k + 1]).cwiseProduct(view.box_size()) : Vec2(0, 0);
      act(cell[k], -on_node, at + displaced);
    }
  }

  if (const std::vector<double>* load = view.doubles("load_force"))
    for (Index i = 0; i < sample.nodes(); ++i) act(cell_of[i], {(*load)[2 * i], (*load)[2 * i + 1]}, view.x[i]);

  std::vector<Stress> stresses(sample.cells());
  for (Index c = 0; c < sample.cells(); ++c) {
    const double area = tile_area(sample, shapes[c], c);
    if (!sample.closed[c] || !(area > 0)) continue;
    const Eigen::Matrix2d sigma = moment[c] / (area * depth);
    stresses[c] = {sigma(0, 0), sigma(1, 1), 0.5 * (sigma(0, 1) + sigma(1, 0))};
  }
  return stresses;
}

Stress mean_stress(const Sample& sample, const std::vector<CellShape>& shapes, const std::vector<Stress>& stresses) {
  Stress mean;
  double total = 0;
  for (Index c = 0; c < sample.cells(); ++c) {
    if (!sample.closed[c]) continue;
    const double area = tile_area(sample, shapes[c], c);
    total += area;
    mean.xx += area * stresses[c].xx, mean.yy += area * stresses[c].yy, mean.xy += area * stresses[c].xy;
  }
  if (total > 0) mean.xx /= total, mean.yy /= total, mean.xy /= total;
  return mean;
}

}  // namespace lamella
