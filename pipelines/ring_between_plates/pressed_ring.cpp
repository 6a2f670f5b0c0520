#include "pipelines/ring_between_plates/pressed_ring.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lamella {
namespace {

constexpr double kTouching = 1e-4;

std::size_t first_node(const Sample& sample, int cell) {
  return static_cast<std::size_t>(sample.cell_begin[static_cast<std::size_t>(cell)]);
}

/// Extents, area and curvatures.
void measure_shape(const FrameView& view, std::size_t nodes, PressedRing& ring) {
  const std::vector<Vec2>& x = view.x;
  const std::vector<double>& moment = *view.doubles("moment");
  Vec2 low = x[0], high = x[0], middle = Vec2::Zero();
  for (std::size_t k = 0; k < nodes; ++k) {
    const Vec2& next = x[(k + 1) % nodes];
    low = low.cwiseMin(x[k]), high = high.cwiseMax(x[k]), middle += x[k] / static_cast<double>(nodes);
    ring.area += (x[k].x() * next.y() - x[k].y() * next.x()) / 2;
  }
  ring.strain = 1 - (high.y() - low.y()) / 2;
  ring.width = (high.x() - low.x()) / 2;
  std::size_t top = 0, side = 0;
  for (std::size_t k = 0; k < nodes; ++k) {
    if (std::abs(x[k].x() - middle.x()) < std::abs(x[top].x() - middle.x())) top = k;
    if (std::abs(x[k].y() - middle.y()) < std::abs(x[side].y() - middle.y())) side = k;
  }
  ring.top = 1 + moment[top], ring.side = 1 + moment[side];
}

void measure_touching(const FrameView& view, std::size_t nodes, PressedRing& ring) {
  const double reach = view.sample.radius[0] + view.sample.radius[1];
  const double upper = view.x[first_node(view.sample, 1)].y(), lower = view.x[first_node(view.sample, 2)].y();
  ring.plate_strain = 1 - (upper - lower - 2 * reach) / 2;
  for (const double plate : {upper, lower}) {
    std::vector<double> places;
    for (std::size_t k = 0; k < nodes; ++k)
      if (std::abs(plate - view.x[k].y()) - reach < kTouching) places.push_back(view.x[k].x());
    if (places.empty()) continue;
    const auto [first, last] = std::minmax_element(places.begin(), places.end());
    ring.touching += static_cast<double>(places.size()) / 2;
    ring.touching_length += (*last - *first) / 2 / 2;
  }
}

void measure_forces(const FrameView& view, PressedRing& ring) {
  const std::vector<double>& held = *view.doubles("load_force");
  for (std::size_t k = first_node(view.sample, 1); k < first_node(view.sample, 3); ++k)
    ring.force += (k < first_node(view.sample, 2) ? -0.5 : 0.5) * held[2 * k + 1];
  const std::vector<double>& contact = *view.doubles("contact_force");
  const std::vector<double>& place = *view.doubles("contact_position");
  double sum = 0, moment = 0;
  for (std::size_t c = 0; c < contact.size(); c += 2) {
    sum += contact[c], moment += contact[c] * std::abs(place[c]);
    if (contact[c] > 0) ring.pushing += 0.5;
  }
  ring.contact_length = sum > 0 ? moment / sum : 0;
}

double interpolated(const std::vector<PressedRing>& curve, Measure value, double at, Measure over) {
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const PressedRing &a = curve[k - 1], &b = curve[k];
    if ((a.*over - at) * (b.*over - at) > 0 || a.*over == b.*over) continue;
    const double share = (at - a.*over) / (b.*over - a.*over);
    return (1 - share) * a.*value + share * b.*value;
  }
  return std::nan("");
}

}  // namespace

double ring_segment(int nodes) { return 2 * std::sin(std::numbers::pi / nodes); }

Squeeze::Squeeze(StudyRun run) : run_(std::move(run)) {
  for (int k = 0; k < run_.reader.frames(); ++k) {
    const Frame frame = run_.reader.frame(k);
    const FrameView view(run_.reader.sample(), frame);
    const std::size_t nodes = first_node(view.sample, 1);
    PressedRing ring;
    ring.frame = k, ring.stage = frame.stage;
    measure_shape(view, nodes, ring);
    measure_touching(view, nodes, ring);
    measure_forces(view, ring);
    ring.bending = view.doubles("hinge_energy")->front();
    ring.stretching = view.doubles("bar_energy")->front();
    (frame.stage == 0 ? press_ : release_).push_back(ring);
  }
  const double whole = press_.front().area;
  for (auto* curve : {&press_, &release_})
    for (PressedRing& ring : *curve) ring.area /= whole;
}

double Squeeze::pressing(Measure value, double at, Measure over) const { return interpolated(press_, value, at, over); }

double Squeeze::at(Measure value, double at, Measure over) const {
  return (interpolated(press_, value, at, over) + interpolated(release_, value, at, over)) / 2;
}

const PressedRing& Squeeze::nearest(double at, Measure over) const {
  return *std::min_element(press_.begin(), press_.end(), [&](const PressedRing& a, const PressedRing& b) {
    return std::abs(a.*over - at) < std::abs(b.*over - at);
  });
}

std::vector<double> Squeeze::pressed(Measure value) const {
  std::vector<double> all;
  for (const PressedRing& ring : press_) all.push_back(ring.*value);
  return all;
}

std::vector<NodeForce> upper_forces(const StudyRun& run, int index) {
  const Frame frame = run.reader.frame(index);
  const FrameView view(run.reader.sample(), frame);
  const std::vector<double>& force = *view.doubles("contact_force");
  const std::vector<double>& place = *view.doubles("contact_position");
  std::vector<NodeForce> all;
  for (std::size_t c = 0; c < force.size(); c += 2)
    if (place[c + 1] > 0) all.push_back({place[c], force[c]});
  std::sort(all.begin(), all.end(), [](const NodeForce& a, const NodeForce& b) { return a.x < b.x; });
  return all;
}

}  // namespace lamella
