#include "pipelines/studies/squeezed_ring.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

constexpr double kNumbers = 1e-9;  // relative: rows and frames at the same time

struct Extent {
  Vec2 low = Vec2::Constant(1e300), high = Vec2::Constant(-1e300);
  void take(const Vec2& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  Vec2 size() const { return (high - low).cwiseMax(0.0); }
};

Index ring_of(const Sample& sample) {
  const auto closed = std::find(sample.closed.begin(), sample.closed.end(), 1);
  if (closed == sample.closed.end()) throw DataError("no closed cell lies between the plates");
  return static_cast<Index>(closed - sample.closed.begin());
}

/// Forces of the plates: all contacts of the ring's nodes are with them.
void add_contacts(SqueezedRing& ring, const Frame& frame, Index begin) {
  const auto& nodes = frame.arrays.ints("contact_node");
  const auto& forces = frame.arrays.doubles("contact_force");
  const auto& normals = frame.arrays.doubles("contact_normal");
  const auto count = static_cast<Index>(ring.x.size());
  Extent touching[2];  // at the lower and at the upper plate
  double pushed = 0, moment = 0;
  for (std::size_t c = 0; c < nodes.size(); ++c) {
    const double push = forces[2 * c] * std::abs(normals[2 * c + 1]);
    if (nodes[c] < begin || nodes[c] >= begin + count || push <= 0) continue;
    const auto k = static_cast<std::size_t>(nodes[c] - begin);
    ring.push[k] += push;
    pushed += push, moment += push * std::abs(ring.x[k].x());
    touching[ring.x[k].y() > 0 ? 1 : 0].take(ring.x[k]);
  }
  ring.force = pushed / 2;
  ring.moment = pushed > 0 ? moment / pushed : 0;
  for (const Extent& e : touching) ring.touching += e.size().x() / 2;
}

constexpr double SqueezedRing::*kNumbersOfARing[] = {
    &SqueezedRing::time,     &SqueezedRing::width,    &SqueezedRing::area, &SqueezedRing::shrinkage,
    &SqueezedRing::force,    &SqueezedRing::moment,   &SqueezedRing::bars, &SqueezedRing::hinges,
    &SqueezedRing::touching, &SqueezedRing::pressure, &SqueezedRing::work};

}  // namespace

RingCourse ring_course(const StudyRun& run) {
  const Sample& sample = run.reader.sample();
  const Index ring = ring_of(sample), begin = sample.cell_begin[ring], end = sample.cell_begin[ring + 1];
  Extent rest;
  for (Index k = begin; k < end; ++k) rest.take(sample.x[k]);
  RingCourse course;
  course.diameter = rest.size().y();
  course.spacing = sample.rest_length[begin];
  const auto times = run.column("time"), works = run.column("work"), stages = run.column("stage");
  const auto& columns = run.reader.response().columns;
  const bool flows = std::find(columns.begin(), columns.end(), "plastic") != columns.end();
  const auto plastics = flows ? run.column("plastic") : std::vector<double>(times.size(), 0.0);
  std::size_t row = 0;
  for (int f = 0; f < run.reader.frames(); ++f) {
    const Frame frame = run.reader.frame(f);
    const FrameView view(sample, frame);
    SqueezedRing now;
    now.time = frame.time, now.stage = frame.stage;
    while (row + 1 < times.size() && (times[row] < frame.time * (1 - kNumbers) || stages[row] < frame.stage)) ++row;
    now.work = works[row], now.plastic = plastics[row];
    Extent extent;
    for (Index k = begin; k < end; ++k) extent.take(view.x[k]);
    now.strain = 1 - extent.size().y() / course.diameter;
    now.width = extent.size().x() / course.diameter;
    now.area = polygon_area(&view.x[begin], end - begin) / sample.rest_area[ring];
    now.shrinkage = 1 - now.area;
    const Vec2 middle = (extent.low + extent.high) / 2;
    for (Index k = begin; k < end; ++k) now.x.push_back(view.x[k] - middle);
    now.push.assign(now.x.size(), 0.0);
    now.bars = frame.arrays.doubles("bar_energy")[ring];
    now.hinges = frame.arrays.doubles("hinge_energy")[ring];
    if (const auto* pressure = view.doubles("pressure")) now.pressure = (*pressure)[ring];
    add_contacts(now, frame, begin);
    course.frames.push_back(std::move(now));
  }
  return course;
}

std::vector<double> RingCourse::all(double SqueezedRing::*what) const {
  std::vector<double> values;
  for (const SqueezedRing& f : frames) values.push_back(f.*what);
  return values;
}

std::vector<double> RingCourse::inward(double SqueezedRing::*what) const {
  auto values = all(what);
  values.resize(turn() + 1);
  return values;
}

std::size_t RingCourse::turn() const {
  std::size_t turn = 0;
  for (std::size_t f = 0; f < frames.size() && frames[f].stage == frames.front().stage; ++f)
    if (frames[f].strain > frames[turn].strain) turn = f;
  return turn;
}

SqueezedRing RingCourse::at(double strain, double window) const {
  std::vector<const SqueezedRing*> near;
  for (std::size_t f = 0; f <= turn(); ++f)
    if (std::abs(frames[f].strain - strain) <= window) near.push_back(&frames[f]);
  if (near.empty()) throw DataError(fmt::format("no frame is within {} of the strain {}", window, strain));
  const auto count = static_cast<Eigen::Index>(near.size());
  Eigen::MatrixXd powers(count, std::min<Eigen::Index>(3, count));
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index power = 0; power < powers.cols(); ++power)
      powers(k, power) = std::pow((near[static_cast<std::size_t>(k)]->strain - strain) / window, power);
  const auto solve = powers.colPivHouseholderQr();
  SqueezedRing ring = nearest(strain);
  for (const auto what : kNumbersOfARing) {
    Eigen::VectorXd values(count);
    for (Eigen::Index k = 0; k < count; ++k) values(k) = near[static_cast<std::size_t>(k)]->*what;
    ring.*what = solve.solve(values)(0);
  }
  ring.strain = strain;
  return ring;
}

const SqueezedRing& RingCourse::nearest(double strain) const {
  const auto end = frames.begin() + static_cast<std::ptrdiff_t>(turn()) + 1;
  return *std::min_element(frames.begin(), end, [&](const SqueezedRing& a, const SqueezedRing& b) {
    return std::abs(a.strain - strain) < std::abs(b.strain - strain);
  });
}

double RingCourse::mean_force(double from, double to, double SqueezedRing::*work) const {
  const SqueezedRing *first = nullptr, *last = nullptr;
  for (std::size_t f = 0; f <= turn(); ++f) {
    if (!first && frames[f].strain >= from) first = &frames[f];
    if (frames[f].strain <= to) last = &frames[f];
  }
  if (!first || !last || first->strain >= last->strain)
    throw DataError(fmt::format("no two frames are between the strains {} and {}", from, to));
  return (last->*work - first->*work) / (diameter * (last->strain - first->strain));
}

double contact_length(double force, double moment, double line) {
  // the smaller root of the quadratic equation, so written that nothing is lost where the pressure vanishes
  const double root = std::sqrt(std::max(0.0, force * force - 4 * line * moment * force));
  return force > 0 ? 4 * moment * force / (force + root) : 0;
}

double edge_force(double force, double moment, double line) {
  return force - line * contact_length(force, moment, line);
}

void ring_picture(StudyReport& report, const std::string& name, const std::string& caption,
                  const std::vector<std::pair<std::string, SqueezedRing>>& rings) {
  constexpr double kMargin = 14, kLabel = 22, kWide = 700;
  double across = 0, high = 0;  // of all rings in a row
  for (const auto& [label, ring] : rings) {
    Extent extent;
    for (const Vec2& p : ring.x) extent.take(p);
    across += extent.size().x(), high = std::max(high, extent.size().y());
  }
  const double gaps = kMargin * (2.0 * static_cast<double>(rings.size()) + 1);
  const double scale = std::min(90.0, (kWide - gaps) / across);
  const Vec2 size(across * scale + gaps, high * scale + kLabel + 3 * kMargin);
  report.picture(name, caption, size, [&](Canvas& canvas) {
    double left = kMargin;
    for (std::size_t k = 0; k < rings.size(); ++k) {
      const auto& [label, ring] = rings[k];
      Extent extent;
      for (const Vec2& p : ring.x) extent.take(p);
      const Vec2 half = extent.size() / 2 * scale;
      const Vec2 centre(left + kMargin / 2 + half.x(), kLabel + 1.5 * kMargin + high * scale / 2);
      std::vector<Vec2> points;
      for (const Vec2& p : ring.x) points.emplace_back(centre + Vec2(p.x(), -p.y()) * scale);
      canvas.polygon(points, {0.90, 0.94, 0.98});
      canvas.outline(points, {curve_colour(0), 2, {}});
      if (ring.force > 0)  // plates, where they push
        for (double side : {-1.0, 1.0}) {
          const double y = centre.y() + side * (half.y() + 2.5), reach = half.x() + kMargin / 2;
          canvas.line({{centre.x() - reach, y}, {centre.x() + reach, y}}, {curve_colour(4), 3, {}});
        }
      canvas.text({centre.x(), 16}, label, {.size = 10, .anchor = Anchor::kCentre});
      left += 2 * half.x() + 2 * kMargin;
    }
  });
}

}  // namespace lamella
