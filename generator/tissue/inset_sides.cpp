#include "generator/tissue/inset_sides.h"

#include <fmt/format.h>

#include <algorithm>

#include "generator/sample/errors.h"
#include "generator/sample/parallel.h"
#include "generator/tissue/inset.h"
#include "generator/tissue/outlines.h"

namespace lamella {
namespace {

struct Shrunk {
  Inset::Outcome outcome;
  bool lost_edges;
};

Shrunk inset_sides(const std::vector<Vec2>& polygon, double distance, std::vector<InsetSide>& sides) {
  const Inset inset = inset_polygon(polygon, distance);
  sides.resize(polygon.size());
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    sides[k].start = polygon[k];
    sides[k].along = (polygon[(k + 1) % polygon.size()] - polygon[k]).normalized();
  }
  for (const InsetEdge& edge : inset.edges) {
    sides[edge.edge].from = edge.from;
    sides[edge.edge].to = edge.to;
    sides[edge.edge].present = true;
  }
  return {inset.outcome, inset.outcome == Inset::Outcome::whole && inset.edges.size() < polygon.size()};
}

}  // namespace

Sides inset_sides(const Mosaic& mosaic, const std::vector<double>& distances, Notes& notes) {
  Sides sides(mosaic.cells.size());
  std::vector<std::string> vanished, split, lost;
  double thinnest = 1e300;          // of what vanishes, relative to how far its walls move in
  double distance = 0, widest = 0;  // of what vanishes first, and of what falls apart
  std::vector<Shrunk> shrunk(mosaic.cells.size());
  for_pieces(mosaic.cells.size(), kCellsOfPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      shrunk[c] = inset_sides(polygon_of(mosaic, mosaic.cells[c]), distances[c], sides[c]);
  });
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c) {
    if (shrunk[c].outcome == Inset::Outcome::vanished) {
      vanished.push_back(mosaic.cells[c].name);
      const double bearable = vanishing_distance(polygon_of(mosaic, mosaic.cells[c])) / distances[c];
      if (bearable < thinnest) thinnest = bearable, distance = distances[c];
    }
    if (shrunk[c].outcome == Inset::Outcome::split) {
      split.push_back(mosaic.cells[c].name);
      widest = std::max(widest, distances[c]);
    }
    for (std::size_t k = 0; shrunk[c].lost_edges && k < sides[c].size(); ++k)
      if (!sides[c][k].present) lost.push_back(fmt::format("edge {} of {}", k, mosaic.cells[c].name));
  }
  std::vector<std::string> faults;
  if (!vanished.empty())
    faults.push_back(
        fmt::format("{} vanish when walls move in by radius + gap / 2 = {:.4g} m; at most {:.4g} m would "
                    "leave every cell",
                    listed(vanished), distance, thinnest * distance));
  if (!split.empty())
    faults.push_back(
        fmt::format("{}: concave, and narrower somewhere than twice radius + gap / 2 = {:.4g} m: choose a "
                    "smaller radius",
                    listed(split), widest));
  if (!faults.empty()) throw SceneError(faults);
  if (!lost.empty()) notes.push_back(fmt::format("{} edges vanish by the inset: {}", lost.size(), listed(lost)));
  return sides;
}

double edge_length(const InsetSide& s, const InsetSide& o, const Vec2& displaced) {
  return (o.start + displaced - s.start).dot(s.along);  // o runs the other way, from the end of s
}

void overlap(const InsetSide& s, const InsetSide& o, double length, double& low, double& high) {
  low = std::max(s.from, length - o.to);
  high = std::min(s.to, length - o.from);
}

double mean_overlap(const Sides& sides, const std::vector<std::vector<EdgePlace>>& opposite, const Box& box) {
  double sum = 0;
  Index count = 0;
  for (std::size_t c = 0; c < sides.size(); ++c) {
    for (std::size_t k = 0; k < sides[c].size(); ++k) {
      const EdgePlace there = opposite[c][k];
      if (!comes_first(static_cast<Index>(c), there) || !sides[c][k].present) continue;
      const InsetSide& across = sides[there.cell][there.edge];
      if (!across.present) continue;
      double low, high;
      overlap(sides[c][k], across, edge_length(sides[c][k], across, displacement(there.image, box)), low, high);
      if (high > low) {
        sum += high - low;
        ++count;
      }
    }
  }
  if (count > 0) return sum / count;
  for (const auto& cell : sides)
    for (const InsetSide& side : cell)
      if (side.present) {
        sum += side.to - side.from;
        ++count;
      }
  return sum / std::max<Index>(1, count);
}

void refuse_too_many(const Sides& sides, double spacing) {
  double length = 0;
  for (const auto& cell : sides)
    for (const InsetSide& side : cell) length += side.present ? side.to - side.from : 0;
  constexpr double most = 2e8;
  if (!(length / spacing < most))
    throw SceneError(
        fmt::format("sample.walls.spacing: {:.4g} m on {:.4g} m of walls makes {:.3g} mass points; at most "
                    "{:.0g} are possible, so at least {:.3g} m",
                    spacing, length, length / spacing, most, length / most));
}

}  // namespace lamella
