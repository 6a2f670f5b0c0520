// Whether disks overlap, by searches that share nothing with the packer.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "generator/packing/domain.h"
#include "generator/packing/packing.h"
#include "generator/sample/parallel.h"

namespace lamella {

double area_fraction(const std::vector<Disk>& disks, const Box& box) {
  double area = 0;
  for (const Disk& disk : disks) area += std::numbers::pi * disk.radius * disk.radius;
  return area / box.area();
}

double largest_overlap(const Packing& packing) {
  const Vec2 size = packing.box.size();
  std::vector<Disk> disks = packing.disks;
  double largest = -std::numeric_limits<double>::infinity(), reach = 0;
  for (const Disk& disk : disks) reach = std::max(reach, disk.radius);
  for (const int axis : {0, 1}) {
    if (packing.periodic[axis]) continue;
    for (const Disk& disk : disks)
      largest = std::max({largest, packing.box.lo[axis] - disk.centre[axis] + disk.radius,
                          disk.centre[axis] - packing.box.hi[axis] + disk.radius});
  }
  // Images within reach of a side, so that what follows need not know of them.
  for (const int axis : {0, 1}) {
    if (!packing.periodic[axis]) continue;
    const std::size_t count = disks.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (const int image : {-1, 1}) {
        Disk ghost = disks[i];
        ghost.centre[axis] += image * size[axis];
        if (ghost.centre[axis] > packing.box.lo[axis] - 4 * reach &&
            ghost.centre[axis] < packing.box.hi[axis] + 4 * reach)
          disks.push_back(ghost);
      }
    }
  }
  // Along x, each disk looks both ways for those that are not larger, until none of them can reach it.
  std::sort(disks.begin(), disks.end(), [](const Disk& a, const Disk& b) { return a.centre.x() < b.centre.x(); });
  constexpr std::size_t kPiece = 4096;
  std::vector<double> of_piece((disks.size() + kPiece - 1) / kPiece, largest);
  for_pieces(disks.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    double& so_far = of_piece[begin / kPiece];
    const auto look = [&](const Disk& disk, const Disk& other) {
      const Vec2 d = other.centre - disk.centre;
      if (std::abs(d.x()) > 2 * disk.radius - so_far) return false;
      if (other.radius <= disk.radius) so_far = std::max(so_far, disk.radius + other.radius - d.norm());
      return true;
    };
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = i + 1; j < disks.size() && look(disks[i], disks[j]); ++j) {
      }
      for (std::size_t j = i; j > 0 && look(disks[i], disks[j - 1]); --j) {
      }
    }
  });
  for (const double piece : of_piece) largest = std::max(largest, piece);
  return largest;
}

double largest_overlap(const Packing& packing, const Domain& domain) {
  double largest = largest_overlap(packing);
  for (const Disk& disk : packing.disks) {
    const double distance = domain.distance_to_boundary(disk.centre);
    largest = std::max(largest, disk.radius + (domain.contains(disk.centre) ? -distance : distance));
  }
  return largest;
}

}  // namespace lamella
