// Which soft disks may come to touch: a list of pairs, found on a grid, that stays complete while no disk moves far.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "generator/sample/vec.h"

namespace lamella {

/// A straight piece of the boundary that disks must not cross [m].
struct StraightWall {
  Vec2 a = Vec2::Zero(), b = Vec2::Zero();
};

/// The image of a disk, its owner, beyond a periodic side.
struct Ghost {
  std::int32_t owner;
  std::array<int, 2> image;
  Vec2 shift;  // image, in box lengths [m]
};

struct Neighbours {
  std::vector<std::int32_t> first, second;           // of each pair, once; ghosts are numbered after the disks
  std::vector<Ghost> ghosts;                         // those that occur in pairs
  std::vector<std::array<std::int32_t, 2>> at_wall;  // disk, wall
};

/// Disks as the search sees them.
struct DiskArrays {
  const Eigen::ArrayXd &x, &y, &radius;
  Eigen::Index count;  // the arrays may hold more
};

/// Uniform grid over the box [0, size], which holds all centres.
class NeighbourGrid {
 public:
  NeighbourGrid(const Vec2& size, Periodic periodic, double cell);

  /// The place that each disk takes in the order of the cells, so that neighbours are near in memory.
  std::vector<std::int32_t> order(const DiskArrays& disks);

  /// All pairs, and disks at walls, that are less than `skin` apart. The disks were put in the order that the grid told.
  Neighbours list(const DiskArrays& disks, const std::vector<StraightWall>& walls, double skin) const;

 private:
  int column(double x) const;
  int row(double y) const;
  Neighbours pairs(const DiskArrays& disks, double skin, std::int32_t from, std::int32_t to) const;
  void list_at_walls(const DiskArrays& disks, const std::vector<StraightWall>& walls, double skin,
                     Neighbours& list) const;

  Vec2 size_;
  Periodic periodic_;
  int columns_, rows_;
  std::vector<std::int32_t> begin_;  // disks of cell c: begin[c] to begin[c + 1]
};

}  // namespace lamella
