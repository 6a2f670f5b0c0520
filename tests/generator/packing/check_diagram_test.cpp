// The checks that tiles are those of their sites: silent on every diagram, and loud where one wall is off.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "generator/packing/laguerre.h"
#include "random_disks.h"

namespace lamella {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const Box kUnit{{0, 0}, {1, 1}};
const std::vector<Periodic> kAll{{false, false}, {true, false}, {false, true}, {true, true}};

void expect_sound(const std::vector<Disk>& disks, const Box& box = kUnit) {
  for (const Periodic periodic : kAll) {
    SCOPED_TRACE(testing::Message() << periodic[0] << periodic[1]);
    const Tessellation t = tessellate(disks, box, {Duplicates::kKeepFirst, Hidden::kReport, periodic});
    EXPECT_THAT(check_disks(t, disks), IsEmpty());
  }
}

TEST(check_diagram, finds_nothing_wrong_with_disks_of_any_kind) {
  for (const double variation : {0.0, 0.3, 1.0}) expect_sound(apart_disks(3000, variation, 0.5, true, 3));
  for (unsigned seed = 0; seed < 20; ++seed) {
    expect_sound(random_disks(300, 0.1, seed));  // most of them hidden
    for (int count = 1; count <= 4; ++count) expect_sound(random_disks(count, 0.2, seed));
  }
  for (const double scale : {1e-20, 1e20}) {
    auto disks = random_disks(200, 0.03, 7);
    for (Disk& disk : disks) disk.centre *= scale, disk.radius *= scale;
    expect_sound(disks, {{0, 0}, {scale, scale}});
  }
}

TEST(check_diagram, finds_nothing_wrong_where_disks_are_in_special_places) {
  std::vector<Disk> square, line, sides;
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j) square.push_back({{(i + 0.5) / 30, (j + 0.5) / 30}, 0.01});
  for (int i = 0; i < 50; ++i) line.push_back({{(i + 0.5) / 50, 0.3}, 0.005});
  for (int i = 0; i < 100; ++i)
    for (const double far : {0.0, 1.0}) {
      sides.push_back({{(i + 0.5) / 100, far}, 0.004});
      sides.push_back({{far, (i + 0.5) / 100}, 0.004});
    }
  expect_sound(square);
  expect_sound(line);
  expect_sound(sides);
}

TEST(check_diagram, says_which_walls_are_not_where_powers_are_equal) {
  const auto disks = apart_disks(300, 0.5, 0.5, true, 5);
  for (const Periodic periodic : kAll) {
    const Tessellation right = tessellate(disks, kUnit, {.periodic = periodic});
    for (const double off : {1e-10, 1e-3}) {
      Tessellation wrong = right;
      const Index v = wrong.tiles[17].vertex[0];
      wrong.vertices[v] += Vec2(off, off) * std::sqrt(1.0 / 300);
      EXPECT_THAT(check_disks(wrong, disks), Contains(HasSubstr("powers differ by"))) << off;
    }
    auto heavier = disks;
    heavier[12].radius *= 1 + 1e-9;
    EXPECT_THAT(check_disks(right, heavier), Contains(HasSubstr("tiles 12 and")));
  }
}

TEST(check_diagram, says_which_disk_leaves_its_tile) {
  // Two disks that touch at x = 0.5, where their wall is. Moved, the wall cuts one of them.
  const std::vector<Disk> disks{{{0.25, 0.5}, 0.25}, {{0.75, 0.5}, 0.25}};
  Tessellation t = tessellate(disks, kUnit);
  EXPECT_THAT(check_disks(t, disks), IsEmpty());
  for (Vec2& v : t.vertices)
    if (v.x() == 0.5) v.x() = 0.5 - 1e-6;
  EXPECT_THAT(check_disks(t, disks), Contains(HasSubstr("disk 0: reaches 1e-06 m beyond its tile's wall to 1")));
}

}  // namespace
}  // namespace lamella
