#include "generator/packing/neighbours.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "generator/packing/domain.h"
#include "generator/sample/parallel.h"

namespace lamella {
namespace {

int count_of(double length, double cell) { return static_cast<int>(std::clamp(length / cell, 1.0, 8192.0)); }

/// Numbers ghosts as they are asked for.
class Ghosts {
 public:
  Ghosts(Neighbours& list, const Vec2& size, Eigen::Index disks) : list_(list), size_(size), disks_(disks) {}

  std::int32_t of(std::int32_t disk, std::array<int, 2> image) {
    const std::int64_t key = (disk * kImages + image[0] + kImages / 2) * kImages + image[1] + kImages / 2;
    const auto [at, is_new] = number_.insert({key, static_cast<std::int32_t>(disks_ + list_.ghosts.size())});
    if (is_new) list_.ghosts.push_back({disk, image, {image[0] * size_.x(), image[1] * size_.y()}});
    return at->second;
  }

 private:
  static constexpr std::int64_t kImages = 1024;  // a box holds at least a good part of the largest disk
  Neighbours& list_;
  Vec2 size_;
  Eigen::Index disks_;
  std::unordered_map<std::int64_t, std::int32_t> number_;
};

/// Which cell of the grid lies at `at`, and in which image of the box.
struct Wrapped {
  int cell, image = 0;
  Wrapped(int at, int count) : cell(at) {
    for (; cell < 0; cell += count) --image;
    for (; cell >= count; cell -= count) ++image;
  }
};

}  // namespace

NeighbourGrid::NeighbourGrid(const Vec2& size, Periodic periodic, double cell)
    : size_(size),
      periodic_(periodic),
      columns_(count_of(size.x(), cell)),
      rows_(count_of(size.y(), cell)),
      begin_(static_cast<std::size_t>(columns_) * rows_ + 1) {}

int NeighbourGrid::column(double x) const { return static_cast<int>(std::floor(x / size_.x() * columns_)); }
int NeighbourGrid::row(double y) const { return static_cast<int>(std::floor(y / size_.y() * rows_)); }

std::vector<std::int32_t> NeighbourGrid::order(const DiskArrays& disks) {
  std::vector<std::size_t> cell(disks.count);
  std::fill(begin_.begin(), begin_.end(), 0);
  for (Eigen::Index i = 0; i < disks.count; ++i) {
    cell[i] = static_cast<std::size_t>(std::clamp(row(disks.y[i]), 0, rows_ - 1)) * columns_ +
              std::clamp(column(disks.x[i]), 0, columns_ - 1);
    ++begin_[cell[i] + 1];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
  std::vector<std::int32_t> place(disks.count);
  for (Eigen::Index i = 0; i < disks.count; ++i) place[i] = next[cell[i]]++;
  return place;
}

Neighbours NeighbourGrid::list(const DiskArrays& disks, const std::vector<StraightWall>& walls, double skin) const {
  constexpr std::size_t kPiece = 4096;
  const auto count = static_cast<std::size_t>(disks.count);
  std::vector<Neighbours> pieces((count + kPiece - 1) / kPiece);
  for_pieces(count, kPiece, [&](std::size_t begin, std::size_t end) {
    pieces[begin / kPiece] = pairs(disks, skin, static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end));
  });
  Neighbours list;
  Ghosts ghosts(list, size_, disks.count);
  std::size_t all = 0;
  for (const Neighbours& piece : pieces) all += piece.first.size();
  list.first.reserve(all), list.second.reserve(all);
  for (const Neighbours& piece : pieces) {
    // Each piece has numbered its ghosts itself.
    std::vector<std::int32_t> number;
    for (const Ghost& ghost : piece.ghosts) number.push_back(ghosts.of(ghost.owner, ghost.image));
    list.first.insert(list.first.end(), piece.first.begin(), piece.first.end());
    for (const std::int32_t j : piece.second) list.second.push_back(j < disks.count ? j : number[j - disks.count]);
  }
  if (!walls.empty()) list_at_walls(disks, walls, skin, list);
  return list;
}

/// Those of the disks [from, to) with smaller ones.
Neighbours NeighbourGrid::pairs(const DiskArrays& disks, double skin, std::int32_t from, std::int32_t to) const {
  const auto& [x, y, radius, count] = disks;
  Neighbours list;
  Ghosts ghosts(list, size_, count);
  for (std::int32_t i = from; i < to; ++i) {
    // Every pair is found from its larger disk, so that small disks need not look as far as the largest reaches.
    const double far = 2 * radius[i] + skin;
    const int last_row = row(y[i] + far), last_column = column(x[i] + far), first_column = column(x[i] - far);
    for (int r = row(y[i] - far); r <= last_row; ++r) {
      const Wrapped at_row(r, rows_);
      if (at_row.image != 0 && !periodic_[1]) continue;
      const double yi = y[i] - at_row.image * size_.y();
      for (int c = first_column; c <= last_column;) {
        const Wrapped at_column(c, columns_);
        const int run = std::min(last_column - c, columns_ - 1 - at_column.cell);  // cells more, before the box ends
        c += run + 1;
        if (at_column.image != 0 && !periodic_[0]) continue;
        const double xi = x[i] - at_column.image * size_.x();
        const auto cell = static_cast<std::size_t>(at_row.cell) * columns_ + at_column.cell;
        for (std::int32_t j = begin_[cell]; j < begin_[cell + run + 1]; ++j) {
          const double dx = x[j] - xi, dy = y[j] - yi, reach = radius[i] + radius[j] + skin;
          if (dx * dx + dy * dy >= reach * reach) continue;
          if (j == i || radius[j] > radius[i] || (radius[j] == radius[i] && j > i)) continue;
          list.first.push_back(i);
          list.second.push_back(
              at_column.image == 0 && at_row.image == 0 ? j : ghosts.of(j, {at_column.image, at_row.image}));
        }
      }
    }
  }
  return list;
}

void NeighbourGrid::list_at_walls(const DiskArrays& disks, const std::vector<StraightWall>& walls, double skin,
                                  Neighbours& list) const {
  const auto& [x, y, radius, count] = disks;
  const double far = radius.head(count).maxCoeff() + skin;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const Vec2 lo = walls[w].a.cwiseMin(walls[w].b), hi = walls[w].a.cwiseMax(walls[w].b);
    for (int r = std::max(0, row(lo.y() - far)); r <= std::min(rows_ - 1, row(hi.y() + far)); ++r) {
      const int first = std::clamp(column(lo.x() - far), 0, columns_ - 1);
      const int last = std::clamp(column(hi.x() + far), 0, columns_ - 1);
      const auto cells = static_cast<std::size_t>(r) * columns_;
      for (std::int32_t i = begin_[cells + first]; i < begin_[cells + last + 1]; ++i)
        if (distance_to_segment({x[i], y[i]}, walls[w].a, walls[w].b) < radius[i] + skin)
          list.at_wall.push_back({i, static_cast<std::int32_t>(w)});
    }
  }
}

}  // namespace lamella
