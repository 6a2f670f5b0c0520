#include "generator/packing/domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

using Polygon = std::vector<Vec2>;

/// Of the area pi radius^2.
Polygon circle(const Vec2& centre, double radius, int sides) {
  const double angle = 2 * std::numbers::pi / sides;
  const double corner = radius * std::sqrt(angle / std::sin(angle));
  Polygon polygon;
  for (int k = 0; k < sides; ++k) polygon.push_back(centre + corner * Vec2(std::cos(k * angle), std::sin(k * angle)));
  return polygon;
}

Box box_of(const std::vector<Polygon>& loops) {
  Box box{loops[0][0], loops[0][0]};
  for (const Polygon& loop : loops)
    for (const Vec2& p : loop) box.lo = box.lo.cwiseMin(p), box.hi = box.hi.cwiseMax(p);
  return box;
}

/// An outline as the user named it.
struct Outline {
  std::string key;
  Polygon points;
};

struct Edge {
  std::size_t loop, index;
  Vec2 a, b;
  double low() const { return std::min(a.x(), b.x()); }
  double high() const { return std::max(a.x(), b.x()); }
};

bool cross_each_other(const Edge& e, const Edge& f) {
  const auto apart = [](const Edge& of, const Edge& by) {
    const double p = cross(by.b - by.a, of.a - by.a), q = cross(by.b - by.a, of.b - by.a);
    return (p > 0 && q > 0) || (p < 0 && q < 0);
  };
  return !apart(e, f) && !apart(f, e) && e.low() <= f.high() && f.low() <= e.high() &&
         std::min(e.a.y(), e.b.y()) <= std::max(f.a.y(), f.b.y()) &&
         std::min(f.a.y(), f.b.y()) <= std::max(e.a.y(), e.b.y());
}

bool closer_than(const Edge& e, const Edge& f, double distance) {
  return cross_each_other(e, f) ||
         std::min({distance_to_segment(e.a, f.a, f.b), distance_to_segment(e.b, f.a, f.b),
                   distance_to_segment(f.a, e.a, e.b), distance_to_segment(f.b, e.a, e.b)}) < distance;
}

/// Neighbours in a loop share a point; of them only a fold is a fault.
bool touch(const Edge& e, const Edge& f, std::size_t count, double distance) {
  const bool next = e.loop == f.loop && (e.index + 1) % count == f.index;
  const bool previous = e.loop == f.loop && (f.index + 1) % count == e.index;
  if (!next && !previous) return closer_than(e, f, distance);
  const Edge &first = next ? e : f, &second = next ? f : e;
  return (second.b - second.a).dot(first.b - first.a) < 0 &&
         std::min(distance_to_segment(second.b, first.a, first.b), distance_to_segment(first.a, second.a, second.b)) <
             distance;
}

/// Points and areas of each outline alone. Sizes below `least` are rounding.
void check_each(const std::vector<Outline>& outlines, std::vector<std::string>& faults) {
  for (const Outline& outline : outlines) {
    const std::size_t n = outline.points.size();
    if (n < 3) {
      faults.push_back(fmt::format("{}: has {} points; give three or more", outline.key, n));
      continue;
    }
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 &p = outline.points[k], &q = outline.points[(k + 1) % n];
      // Beyond this, products of coordinates overflow.
      if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e100)
        faults.push_back(fmt::format("{}: point {} is ({}, {}): coordinates must be finite, at most 1e100", outline.key,
                                     k, p.x(), p.y()));
      else if (p == q)
        faults.push_back(fmt::format("{}: points {} and {} are the same ({:.6g}, {:.6g}); remove one{}", outline.key, k,
                                     (k + 1) % n, p.x(), p.y(), k + 1 == n ? ": the polygon is closed anyway" : ""));
    }
  }
}

void check_edges(const std::vector<Outline>& outlines, double least, std::vector<std::string>& faults) {
  std::vector<Edge> edges;
  for (std::size_t loop = 0; loop < outlines.size(); ++loop) {
    const Polygon& points = outlines[loop].points;
    for (std::size_t k = 0; k < points.size(); ++k)
      edges.push_back({loop, k, points[k], points[(k + 1) % points.size()]});
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) { return e.low() < f.low(); });
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size() && edges[j].low() <= edges[i].high() + least; ++j) {
      const Edge &e = edges[i], &f = edges[j];
      if (!touch(e, f, outlines[e.loop].points.size(), least)) continue;
      faults.push_back(
          fmt::format("{}: the side from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) touches or crosses that from "
                      "({:.6g}, {:.6g}) to ({:.6g}, {:.6g}){}; sides must stay apart",
                      outlines[e.loop].key, e.a.x(), e.a.y(), e.b.x(), e.b.y(), f.a.x(), f.a.y(), f.b.x(), f.b.y(),
                      e.loop == f.loop ? "" : " of " + outlines[f.loop].key));
      if (faults.size() >= 10) return;
    }
  }
}

/// Once no sides touch, one point of a hole stands for all.
void check_holes(const std::vector<Outline>& outlines, std::vector<std::string>& faults) {
  for (std::size_t hole = 1; hole < outlines.size(); ++hole) {
    if (!is_inside(outlines[0].points, outlines[hole].points[0]))
      faults.push_back(fmt::format("{}: lies outside the domain; move it inside, or remove it", outlines[hole].key));
    for (std::size_t other = 1; other < outlines.size(); ++other)
      if (other != hole && is_inside(outlines[other].points, outlines[hole].points[0]))
        faults.push_back(fmt::format("{}: lies inside {}; remove it", outlines[hole].key, outlines[other].key));
  }
}

bool positive(double length) { return length > 0 && std::isfinite(length); }

std::vector<Outline> outlines_of(const DomainScene& scene, std::vector<std::string>& faults) {
  std::vector<Outline> outlines;
  if (scene.sides < 8 || scene.sides > 10000)
    faults.push_back(fmt::format("sample.domain.sides = {}: must be 8 to 10000", scene.sides));
  if (scene.kind == "polygon") {
    outlines.push_back({"sample.domain.points", scene.points});
  } else if (scene.kind == "disk" || scene.kind == "ring") {
    if (!positive(scene.radius))
      faults.push_back(fmt::format("sample.domain.radius = {}: a {} needs a positive one", scene.radius, scene.kind));
    const bool ring = scene.kind == "ring";
    if (ring && !(scene.inner_radius > 0 && scene.inner_radius < scene.radius))
      faults.push_back(fmt::format("sample.domain.inner_radius = {}: must be positive and less than the radius, {}",
                                   scene.inner_radius, scene.radius));
    if (!faults.empty()) return {};
    outlines.push_back({"sample.domain.radius", circle(Vec2::Zero(), scene.radius, scene.sides)});
    if (ring) outlines.push_back({"sample.domain.inner_radius", circle(Vec2::Zero(), scene.inner_radius, scene.sides)});
  } else {
    faults.push_back(fmt::format("sample.domain.kind = \"{}\": must be \"disk\", \"ring\" or \"polygon\"", scene.kind));
  }
  for (std::size_t k = 0; k < scene.holes.size(); ++k) {
    const HoleScene& hole = scene.holes[k];
    const std::string key = fmt::format("sample.domain.holes[{}]", k);
    if (!hole.radius)
      outlines.push_back({key, hole.points});
    else if (!positive(*hole.radius))
      faults.push_back(fmt::format("{}: radius = {}: must be positive", key, *hole.radius));
    else if (faults.empty())
      outlines.push_back({key, circle(hole.centre, *hole.radius, scene.sides)});
  }
  return outlines;
}

}  // namespace

bool Domain::contains(const Vec2& p) const {
  bool odd = false;
  for (const Polygon& loop : loops) odd = odd != is_inside(loop, p);
  return odd;
}

double Domain::distance_to_boundary(const Vec2& p) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Polygon& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k)
      nearest = std::min(nearest, distance_to_segment(p, loop[k], loop[(k + 1) % loop.size()]));
  return nearest;
}

Domain make_domain(const DomainScene& scene) {
  std::vector<std::string> faults;
  const auto throw_if_any = [&] {
    if (!faults.empty()) throw SceneError(std::move(faults));
  };
  std::vector<Outline> outlines = outlines_of(scene, faults);
  throw_if_any();
  check_each(outlines, faults);
  throw_if_any();

  Domain domain;
  for (const Outline& outline : outlines) domain.loops.push_back(outline.points), domain.keys.push_back(outline.key);
  domain.box = box_of({domain.loops[0]});
  const double least = 1e-9 * domain.box.size().norm();
  for (const Outline& outline : outlines)
    if (std::abs(polygon_area(outline.points)) < least * domain.box.size().norm())
      faults.push_back(
          fmt::format("{}: encloses no area; its points lie on a line, or it crosses itself", outline.key));
  throw_if_any();
  check_edges(outlines, least, faults);
  throw_if_any();
  check_holes(outlines, faults);
  throw_if_any();

  for (std::size_t k = 0; k < domain.loops.size(); ++k) {
    if ((polygon_area(domain.loops[k]) > 0) != (k == 0)) std::reverse(domain.loops[k].begin(), domain.loops[k].end());
    domain.area += polygon_area(domain.loops[k]);
  }
  return domain;
}

}  // namespace lamella
