#include "generator/image/lattice_lines.h"

namespace lamella {
namespace {

double distance_to_edge(const Lattice& p, const Lattice& a, const Lattice& b) {
  const auto along = static_cast<double>(dot(a, b, p));
  const double length = distance(a, b);
  if (along <= 0 || length == 0) return distance(a, p);
  if (along >= length * length) return distance(b, p);
  return std::abs(static_cast<double>(turn(a, b, p))) / length;
}

/// Marks the corners that stay between two that do.
void keep_far_corners(const std::vector<Lattice>& corner, std::size_t first, std::size_t last, double tolerance,
                      std::vector<char>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    std::size_t farthest = from;
    double most = tolerance;
    for (std::size_t k = from + 1; k < to; ++k) {
      const double d = distance_to_edge(corner[k], corner[from], corner[to]);
      if (d > most) {
        most = d;
        farthest = k;
      }
    }
    if (farthest == from) continue;
    kept[farthest] = 1;
    open.emplace_back(from, farthest);
    open.emplace_back(farthest, to);
  }
}

}  // namespace

std::vector<Lattice> simplified(const std::vector<Lattice>& corner, double tolerance) {
  std::vector<char> kept(corner.size(), 0);
  kept.front() = kept.back() = 1;
  std::size_t middle = 0;
  if (corner.front() == corner.back()) {  // a closed wall: first cut it at the corner farthest from its node
    for (std::size_t k = 1; k < corner.size(); ++k)
      if (distance(corner[0], corner[k]) > distance(corner[0], corner[middle])) middle = k;
    kept[middle] = 1;
  }
  keep_far_corners(corner, 0, middle, tolerance, kept);
  keep_far_corners(corner, middle, corner.size() - 1, tolerance, kept);
  std::vector<Lattice> result;
  for (std::size_t k = 0; k < corner.size(); ++k)
    if (kept[k]) result.push_back(corner[k]);
  return result;
}

double length_of(const std::vector<Lattice>& points) {
  double length = 0;
  for (std::size_t k = 1; k < points.size(); ++k) length += distance(points[k - 1], points[k]);
  return length;
}

}  // namespace lamella
