// Pictures of Laguerre tessellations give them back; of other cells the closest is near.
#include "generator/image/laguerre_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "generator/packing/laguerre.h"
#include "generator/packing/sizes.h"
#include "generator/tissue/image_laguerre.h"
#include "tests/generator/image/pictures.h"

namespace lamella {
namespace {

/// Disks without overlap, of radii that differ by a factor of up to three, so that cells are not tiny.
std::vector<Disk> spread_disks(int width, int height, double diameter, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Disk> disks;
  for (int tries = 0; tries < 20000; ++tries) {
    const Disk disk{Vec2(width * unit(random), height * unit(random)), diameter * (0.2 + 0.3 * unit(random))};
    bool free = true;
    for (const Disk& other : disks) free = free && (disk.centre - other.centre).norm() > disk.radius + other.radius;
    if (free) disks.push_back(disk);
  }
  return disks;
}

double share_of(const std::vector<Disk>& disks, const LabelImage& labels) {
  std::size_t agreeing = 0;
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x)
      agreeing +=
          static_cast<Index>(nearest(disks, {x + 0.5, labels.height - y - 0.5})) == labels.cell[labels.at(x, y)];
  return static_cast<double>(agreeing) / static_cast<double>(labels.pixels());
}

TEST(LaguerreFit, recovers_a_tessellation_from_its_picture) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const int size = 400;
    LabelImage labels = labels_of(tessellated(size, size, spread_disks(size, size, 40, seed)));
    clean_labels(labels, 20);
    const LaguerreFit fit = fit_laguerre(labels);
    EXPECT_GT(labels.number.size(), 80u);
    EXPECT_GT(share_of(fit.disks, labels), 0.995);
    EXPECT_LT(fit.rms, 0.5);
    for (const Disk& disk : fit.disks) EXPECT_TRUE((Box{Vec2::Zero(), Vec2(size, size)}).contains(disk.centre));
  }
}

TEST(LaguerreFit, agreement_counts_pixels_as_brute_force_does) {
  const auto disks = spread_disks(120, 90, 25, 5);
  const LabelImage other = labels_of(tessellated(120, 90, spread_disks(120, 90, 25, 6)));
  const Tessellation tessellation = tessellate(disks, {Vec2::Zero(), Vec2(120, 90)});
  EXPECT_DOUBLE_EQ(agreement(tessellation, other, 1 << 30), share_of(disks, other));
}

TEST(LaguerreFit, of_concave_cells_is_better_than_their_centres) {
  LabelImage labels = labels_of(wavy(300, 300, spread_disks(300, 300, 40, 2), 2));
  clean_labels(labels, 20);
  std::vector<Disk> centres(labels.number.size());
  std::vector<double> area(centres.size(), 0);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x) {
      const Index cell = labels.cell[labels.at(x, y)];
      centres[cell].centre += Vec2(x + 0.5, 300 - y - 0.5);
      ++area[cell];
    }
  for (std::size_t c = 0; c < centres.size(); ++c) {
    centres[c].centre /= area[c];
    centres[c].radius = std::sqrt(area[c] / 3.14159);
  }
  const double fitted = share_of(fit_laguerre(labels).disks, labels);
  EXPECT_GT(fitted, share_of(centres, labels));
  EXPECT_GT(fitted, 0.9);
}

TEST(LaguerreFit, of_one_cell_or_two_is_their_tessellation) {
  for (const int cells : {1, 2, 3}) {
    const LabelImage labels =
        labels_of(picture_of(60, 30, [&](int x, int) { return static_cast<std::uint32_t>(x * cells / 60) + 1; }));
    EXPECT_GE(share_of(fit_laguerre(labels).disks, labels), 0.999) << cells;
  }
}

TEST(LaguerreFit, parts_the_background_into_pieces_that_reach_no_cell) {
  LabelImage labels = labels_of(picture_of(100, 80, [](int x, int y) {
    return std::hypot(x - 50, y - 40) < 20 ? 1u : std::hypot(x - 80, y - 40) < 8 ? 2u : 0u;
  }));
  const LabelImage before = labels;
  EXPECT_EQ(part_background(labels), 2);
  std::set<Index> seen;
  for (std::size_t k = 0; k < labels.pixels(); ++k) {
    EXPECT_EQ(labels.cell[k] >= 2, before.cell[k] == kBackground);
    if (before.cell[k] >= 0) {
      EXPECT_EQ(labels.cell[k], before.cell[k]);
    }
    seen.insert(labels.cell[k]);
  }
  EXPECT_EQ(seen.size(), labels.number.size());
}

}  // namespace
}  // namespace lamella
