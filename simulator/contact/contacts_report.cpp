// What contacts say about themselves: restart, frames, faults, and what the time step has to be ready for.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulator/contact/contacts.h"

namespace lamella {
namespace {

/// Whether p lies inside the closed cell, by the crossings of a ray towards +x.
bool inside(const Sample& sample, const Field& x, Index cell, const Vec2& p) {
  bool in = false;
  Vec2 a = x.at(sample.cell_begin[cell + 1] - 1);
  for (Index i = sample.cell_begin[cell]; i < sample.cell_begin[cell + 1]; ++i) {
    const Vec2 b = x.at(i);
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      in = !in;
    a = b;
  }
  return in;
}

bool cross_each_other(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

/// Ordered pairs of cells whose boxes meet, the first of each displaced by the image.
template <class Visit>
void for_each_meeting(const Sample& sample, const Vec2& period, const std::vector<Box>& boxes, Visit visit) {
  for (const auto& [a, b, image] : meeting_boxes(sample, period, boxes, 0))
    visit(a, b, image), visit(b, a, opposite(image));
}

}  // namespace

std::vector<Contacts::Inside> Contacts::nodes_inside(const Field& x) const {
  const auto boxes = bounding_boxes(sample_, x);
  std::vector<Inside> found;
  const Vec2 period = box_size(sample_, x);
  for_each_meeting(sample_, period, boxes, [&](Index guest, Index host, const Image& image) {
    if (!sample_.closed[host] || opened(host)) return;
    const Vec2 off = displacement(image, period);
    for (Index i = sample_.cell_begin[guest]; i < sample_.cell_begin[guest + 1]; ++i)
      if (const Vec2 p = x.at(i) + off; boxes[host].contains(p) && inside(sample_, x, host, p))
        found.push_back({i, host, image});
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::optional<std::string> Contacts::fault(const Field& x) const {
  for (const auto& [node, cell, image] : nodes_inside(x))
    if (!std::binary_search(inside_.begin(), inside_.end(), Inside{node, cell, image}))
      return fmt::format(
          "node {} of cell {} is inside cell {}, at ({:.6g}, {:.6g}) m; use a stiffer contact, a larger wall radius, "
          "slower loading or a smaller step",
          node, cell_of_[node], cell, x.x[node], x.y[node]);

  const auto boxes = bounding_boxes(sample_, x);
  std::optional<std::string> message;
  const Vec2 period = box_size(sample_, x);
  for_each_meeting(sample_, period, boxes, [&](Index guest, Index chain, const Image& image) {
    if (message || (sample_.closed[chain] && !opened(chain))) return;
    for (Index i = sample_.cell_begin[guest]; i < sample_.cell_begin[guest + 1]; ++i) {
      if (!sample_.starts_segment(guest, i) || rules_.gone(i)) continue;
      const Vec2 off = displacement(image, period);
      const Vec2 a = x.at(i) + off, b = x.at(sample_.next(guest, i)) + off;
      const Box& box = boxes[chain];
      if ((a.cwiseMax(b).array() < box.lo.array()).any() || (a.cwiseMin(b).array() > box.hi.array()).any()) continue;
      for (Index s = sample_.cell_begin[chain]; s < sample_.cell_begin[chain + 1]; ++s)
        if (!message && sample_.starts_segment(chain, s) && !rules_.gone(s) &&
            cross_each_other(a, b, x.at(s), x.at(sample_.next(chain, s))))
          message = fmt::format(
              "the wall of cell {} behind node {}, at ({:.6g}, {:.6g}) m, has gone through the wall of cell {}; use a "
              "stiffer contact, a larger wall radius, slower loading or a smaller step",
              guest, i, x.x[i], x.y[i], chain);
    }
  });
  return message;
}

void Contacts::save(ArraySet& restart) const {
  if (p_.friction == 0) return;
  std::vector<std::int32_t> places;
  std::vector<double> numbers;
  std::vector<std::int32_t> images;
  for_each_spring([&](Index, const Pair& pair, const FrictionSpring& s) {
    places.insert(places.end(), {pair.node, pair.cell, s.segment, s.next});
    images.insert(images.end(), {pair.image[0], pair.image[1]});
    numbers.insert(numbers.end(), {s.t, s.along, s.across, s.stretch, s.limit, s.force});
  });
  restart.add({"contact_spring_places", "1", "model", 1, std::move(places)});
  restart.add({"contact_springs", "1", "model", 1, std::move(numbers)});
  if (is_periodic(sample_)) restart.add({"contact_spring_images", "1", "model", 1, std::move(images)});
  restart.add({"contact_dissipated", "J", "model", 1, std::vector<double>{dissipated_}});
}

void Contacts::restore(const ArraySet& restart) {
  if (restart.find("link_intact")) {
    const auto& intact = restart.ints("link_intact");
    for (std::size_t l = 0; l < intact.size(); ++l)
      if (!intact[l]) linked_.set_intact(static_cast<Index>(l), 0);
  }
  rebuild(Field(drift_.start()));
  if (p_.friction == 0 || !restart.find("contact_springs")) return;
  const auto& places = restart.ints("contact_spring_places");
  const auto& numbers = restart.doubles("contact_springs");
  dissipated_ = restart.doubles("contact_dissipated").at(0);
  for (std::size_t k = 0; 4 * k + 3 < places.size(); ++k) {
    Image image{0, 0};
    if (is_periodic(sample_))
      for (std::size_t axis = 0; axis < 2; ++axis)
        image[axis] = static_cast<std::int8_t>(restart.ints("contact_spring_images").at(2 * k + axis));
    const Index pair = list_pair({places[4 * k], places[4 * k + 1], 0, 0, image});
    const double* v = numbers.data() + 6 * k;
    spring_[pair] = {places[4 * k + 2], places[4 * k + 3], v[0], v[1], v[2], v[3], v[4], v[5]};
    trial_[pair] = spring_[pair];
  }
}

void Contacts::add_output(const Field& x, ArraySet& frame) const {
  std::vector<double> position, normal, force;
  std::vector<std::int32_t> node, cell, slides, image;
  for_each_touch(x, [&](const Pair& pair, const Touch& t) {
    const int heavy = heaviest(t.feet, t.overlap);
    for (int f = 0; f < t.feet.count; ++f) {
      if (t.overlap.lambda[f] <= 0) continue;
      const Foot& foot = t.feet.foot[f];
      const double share = sample_.radius[pair.cell] / reach(pair);  // where the two outlines meet
      const Vec2 p = x.at(pair.node) - (1 - share) * foot.distance * foot.n;
      position.insert(position.end(), {p.x(), p.y()});
      normal.insert(normal.end(), {foot.n.x(), foot.n.y()});
      node.push_back(pair.node), cell.push_back(pair.cell);
      image.insert(image.end(), {pair.image[0], pair.image[1]});
      double f_t = 0;
      bool sliding_now = false;
      if (const auto k = place_of(pair); f == heavy && p_.friction > 0 && k && spring_[*k].acts()) {
        const Slip moved = slip(spring_[*k], x, pair);
        const Sliding s = sliding(*k, moved);
        f_t = -s.force * moved.tangent.dot(left_of(foot.n));
        sliding_now = std::abs(s.force) >= spring_[*k].limit;
      }
      force.insert(force.end(), {t.k * t.overlap.lambda[f], f_t});
      slides.push_back(sliding_now ? 1 : 0);
    }
  });
  frame.add({"contact_position", "m", "contact", 2, std::move(position)});
  frame.add({"contact_node", "1", "contact", 1, std::move(node)});
  frame.add({"contact_cell", "1", "contact", 1, std::move(cell)});
  if (is_periodic(sample_)) frame.add({"contact_image", "1", "contact", 2, std::move(image)});
  frame.add({"contact_normal", "1", "contact", 2, std::move(normal)});
  frame.add({"contact_force", "N", "contact", 2, std::move(force)});
  if (p_.friction > 0) frame.add({"contact_sliding", "1", "contact", 1, std::move(slides)});
}

namespace {

/// Blocks of the quadratic form w w^T (x) m over a foot's nodes.
void add_foot_blocks(Index node, const Foot& foot, const Eigen::Matrix2d& m, StiffnessSink& sink) {
  const std::array<Index, 3> nodes{node, foot.segment, foot.next};
  const Eigen::Vector3d w = foot_weights(foot.t);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      if (w[a] != 0 && w[b] != 0) sink.add(nodes[a], nodes[b], w[a] * w[b] * m);
}

}  // namespace

// Where a node has several feet it may be held in all directions (a crease), so each counts in all directions.
void Contacts::add_possible_stiffness(const Field& x, StiffnessSink& sink) const {
  for (const Pair& pair : list_.pairs) {
    const Feet feet = find_feet(sample_, x, pair.node, pair.cell, list_.of(pair), reach(pair) + 2 * rules_.skin,
                                rules_.broken, shift(pair, x));
    const double k = stiffness(pair), k_t = p_.friction > 0 ? tangential_stiffness(pair) : 0.0;
    for (int f = 0; f < feet.count; ++f) {
      const Vec2 &n = feet.foot[f].n, t = left_of(n);
      const Eigen::Matrix2d m = feet.count > 1 ? Eigen::Matrix2d((k + k_t) * Eigen::Matrix2d::Identity())
                                               : Eigen::Matrix2d(k * n * n.transpose() + k_t * t * t.transpose());
      add_foot_blocks(pair.node, feet.foot[f], m, sink);
    }
  }
}

void Contacts::add_possible_damping(const Field& x, StiffnessSink& sink) const {
  for (const Pair& pair : list_.pairs) {
    const Feet feet = find_feet(sample_, x, pair.node, pair.cell, list_.of(pair), reach(pair) + 2 * rules_.skin,
                                rules_.broken, shift(pair, x));
    for (int f = 0; f < feet.count; ++f)
      add_foot_blocks(pair.node, feet.foot[f], dashpot(pair) * feet.foot[f].n * feet.foot[f].n.transpose(), sink);
  }
}

}  // namespace lamella
