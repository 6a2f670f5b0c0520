// From pictures to proper cells: against drawings that show what must come out, and brute force on noise.
#include "generator/image/labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "generator/image/distance.h"
#include "generator/image/regions.h"
#include "generator/sample/errors.h"
#include "tests/generator/image/pictures.h"

namespace lamella {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Rows = std::vector<std::string>;

Rows cleaned(const Rows& rows, int least_area, Cleaning* done = nullptr) {
  LabelImage labels = labels_of(drawn(rows));
  const Cleaning cleaning = clean_labels(labels, least_area);
  if (done) *done = cleaning;
  return drawing_of(labels);
}

Rows closed(const Rows& rows, int square) {
  LabelImage labels = labels_of(drawn(rows));
  close_gaps(labels, square);
  return drawing_of(labels);
}

TEST(NearestMarked, is_as_near_as_any_by_brute_force) {
  std::mt19937 random(5);
  for (const auto& [width, height, share] :
       {std::tuple{17, 11, 0.02}, {1, 9, 0.2}, {9, 1, 0.2}, {23, 19, 0.3}, {40, 3, 0.01}, {12, 12, 1.0}}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::vector<char> marked(static_cast<std::size_t>(width) * height);
      std::bernoulli_distribution mark(share);
      for (char& m : marked) m = mark(random);
      const auto nearest = nearest_marked(marked, width, height);
      for (std::size_t k = 0; k < marked.size(); ++k) {
        std::int64_t least = -1;
        for (std::size_t j = 0; j < marked.size(); ++j) {
          const auto d = square_distance(static_cast<Index>(k), static_cast<Index>(j), width);
          if (marked[j] && (least < 0 || d < least)) least = d;
        }
        if (least < 0) {
          EXPECT_EQ(nearest[k], -1);
          continue;
        }
        ASSERT_GE(nearest[k], 0);
        EXPECT_TRUE(marked[nearest[k]]);
        EXPECT_EQ(square_distance(static_cast<Index>(k), nearest[k], width), least);
      }
    }
  }
}

TEST(Labels, are_cells_in_ascending_order_and_the_background_is_none) {
  bool pieces = true;
  const LabelImage labels =
      labels_of(picture_of(3, 2, [](int x, int y) { return x == 0   ? 7u
                                                           : y == 0 ? 4000000000u
                                                                    : 3u; }), 3, pieces);
  EXPECT_FALSE(pieces);
  EXPECT_THAT(labels.number, ElementsAre(7u, 4000000000u));
  EXPECT_THAT(labels.cell, ElementsAre(0, 1, 1, 0, kBackground, kBackground));
}

TEST(Labels, of_a_mask_are_its_connected_pieces) {
  // Lines of 1 pixel that touch at corners only part cells, as a skeleton does.
  bool pieces = false;
  const LabelImage labels = labels_of(drawn({"11.11",  //
                                             "1.111",  //
                                             ".1111",  //
                                             "11111"}),
                                      0, pieces);
  EXPECT_TRUE(pieces);
  EXPECT_THAT(drawing_of(labels), ElementsAre("11.22", "1.222", ".2222", "22222"));
}

TEST(Gaps, of_one_to_three_pixels_are_closed_and_wider_ones_stay) {
  for (int gap = 1; gap <= 6; ++gap) {
    const std::string row = std::string(8, '1') + std::string(gap, '.') + std::string(8, '2');
    const Rows result = closed(Rows(9, row), 4);
    for (const std::string& line : result) {
      if (gap > 3) {
        EXPECT_EQ(line, row);
        continue;
      }
      EXPECT_THAT(line, ::testing::Not(HasSubstr(".")));
      // Shared out evenly: the odd pixel goes to either.
      EXPECT_NEAR(std::count(line.begin(), line.end(), '1'), 8 + gap / 2.0, 0.5);
    }
  }
}

TEST(Gaps, are_closed_where_no_square_fits_by_brute_force) {
  std::mt19937 random(11);
  for (int repeat = 0; repeat < 30; ++repeat) {
    const int width = 30, height = 20, side = 2 + repeat % 3;
    std::bernoulli_distribution speck(0.06);
    const LabelImage before = labels_of(
        picture_of(width, height, [&](int x, int) { return speck(random) ? 1u + static_cast<unsigned>(x) : 0u; }));
    LabelImage after = before;
    const std::size_t given = close_gaps(after, side);
    std::size_t expected = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        bool covered = before.cell[before.at(x, y)] != kBackground;
        const bool was_cell = covered;
        for (int top = y - side + 1; top <= y; ++top)
          for (int left = x - side + 1; left <= x; ++left) {
            bool fits = top >= 0 && left >= 0 && top + side <= height && left + side <= width;
            for (int v = top; fits && v < top + side; ++v)
              for (int u = left; fits && u < left + side; ++u) fits = before.cell[before.at(u, v)] == kBackground;
            covered |= fits;
          }
        expected += !covered;
        const Index now = after.cell[after.at(x, y)];
        EXPECT_EQ(now == kBackground, covered && !was_cell) << x << " " << y;
        if (was_cell) {
          EXPECT_EQ(now, before.cell[before.at(x, y)]);
        }
      }
    EXPECT_EQ(given, expected);
  }
}

TEST(Gaps, at_the_side_of_the_picture_are_closed_too) {
  EXPECT_THAT(closed({"......", ".1111.", ".1111.", "......"}, 4), ElementsAre("111111", "111111", "111111", "111111"));
}

TEST(Cleaning, joins_pieces_to_what_they_touch_most_and_keeps_the_largest) {
  Cleaning done;
  EXPECT_THAT(cleaned({"111222",  //
                       "111212",  //
                       "111222",  //
                       "333333"},
                      1, &done),
              ElementsAre("111222", "111222", "111222", "333333"));
  EXPECT_THAT(done.scattered, ElementsAre(1u));
  EXPECT_EQ(done.pieces, 1u);
  EXPECT_THAT(done.small, IsEmpty());
}

TEST(Cleaning, joins_small_cells_to_the_neighbour_with_the_longest_common_boundary) {
  Cleaning done;
  EXPECT_THAT(cleaned({"1112222",  //
                       "1113322",  //
                       "1114322",  //
                       "1111222"},
                      4, &done),
              ElementsAre("1112222", "1112222", "1111222", "1111222"));
  // 4 (one pixel) has two sides with 1 (left, below), one with 3 above, one with 3 on its right: by number, 1.
  EXPECT_THAT(done.small, ElementsAre(4u, 3u));
}

TEST(Cleaning, keeps_a_small_cell_that_has_grown_enough_by_another) {
  EXPECT_THAT(cleaned({"11", "11", "11", "23", "23", "23", "23"}, 6),
              ElementsAre("11", "11", "11", "33", "33", "33", "33"));
}

TEST(Cleaning, gives_specks_in_the_background_to_it_and_small_gaps_to_cells) {
  Cleaning done;
  EXPECT_THAT(cleaned({"1111....", "1..1..2.", "1111....", "1111...."}, 3, &done),
              ElementsAre("1111....", "1111....", "1111....", "1111...."));
  EXPECT_THAT(done.small, ElementsAre(2u));
  EXPECT_EQ(done.small_gaps, 1);
}

TEST(Cleaning, fills_holes_and_takes_in_what_lies_there) {
  Cleaning done;
  EXPECT_THAT(cleaned({"1111113",  //
                       "1222113",  //
                       "12.2113",  //
                       "1222113",  //
                       "1111113"},
                      1, &done),
              ElementsAre("1111113", "1111113", "1111113", "1111113", "1111113"));
  EXPECT_THAT(done.filled, ElementsAre(1u));
  EXPECT_THAT(done.enclosed, ElementsAre(2u));
}

TEST(Cleaning, refuses_a_cell_around_more_than_itself) {
  try {
    cleaned({"11111111", "12223341", "12223341", "12223341", "12223341", "12223341", "11111111"}, 1);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("label 1 encloses 3 cells"));
    EXPECT_THAT(error.what(), HasSubstr("give background = 1"));
  }
}

TEST(Cleaning, opens_corners_at_which_a_cell_touches_itself) {
  Cleaning done;
  const Rows result = cleaned({"11111",  //
                               "13331",  //
                               "13331",  //
                               "13312",  //
                               "11112",  //
                               "22222"},
                              1, &done);
  EXPECT_EQ(done.pinches, 1u);
  EXPECT_THAT(done.enclosed, IsEmpty());
  EXPECT_THAT(done.scattered, IsEmpty());
}

/// All that is promised of clean labels, by brute force.
void expect_clean(const LabelImage& labels, int least_area) {
  const Regions regions = regions_of(labels);
  std::set<Index> seen;
  for (std::size_t r = 0; r < regions.cell.size(); ++r) {
    if (regions.cell[r] < 0) continue;
    EXPECT_TRUE(seen.insert(regions.cell[r]).second) << "in two pieces";
    EXPECT_GE(regions.area[r], least_area);
  }
  EXPECT_EQ(seen.size(), labels.number.size());
  for (int y = 0; y + 1 < labels.height; ++y)
    for (int x = 0; x + 1 < labels.width; ++x) {
      const Index a = labels.cell[labels.at(x, y)], b = labels.cell[labels.at(x + 1, y)];
      const Index c = labels.cell[labels.at(x, y + 1)], d = labels.cell[labels.at(x + 1, y + 1)];
      EXPECT_FALSE(a >= 0 && a == d && a != b && a != c) << x << " " << y;
      EXPECT_FALSE(b >= 0 && b == c && b != a && b != d) << x << " " << y;
    }
  // Without the cell everything else reaches the outside.
  for (Index cell = 0; cell < static_cast<Index>(labels.number.size()); ++cell) {
    LabelImage mask{labels.width + 2, labels.height + 2, {}, {0}};
    for (int y = -1; y <= labels.height; ++y)
      for (int x = -1; x <= labels.width; ++x) {
        const bool inside = x >= 0 && y >= 0 && x < labels.width && y < labels.height;
        mask.cell.push_back(inside && labels.cell[labels.at(x, y)] == cell ? 0 : kBackground);
      }
    EXPECT_EQ(regions_of(mask).cell.size(), 2u) << "label " << labels.number[cell] << " has a hole";
  }
}

TEST(Cleaning, makes_proper_cells_of_noise) {
  std::mt19937 random(1);
  int cells = 0;
  for (int repeat = 0; repeat < 300; ++repeat) {
    const int numbers = 2 + repeat % 5, least_area = 1 + repeat % 4;
    std::uniform_int_distribution<unsigned> number(0, static_cast<unsigned>(numbers));
    LabelImage labels = labels_of(picture_of(14, 11, [&](int, int) { return number(random); }));
    try {
      clean_labels(labels, least_area);
    } catch (const SceneError& error) {
      EXPECT_THAT(error.what(), HasSubstr("encloses"));
      continue;
    }
    expect_clean(labels, least_area);
    cells += static_cast<int>(labels.number.size());
  }
  EXPECT_GT(cells, 300);
}

TEST(Cleaning, changes_nothing_where_nothing_is_wrong) {
  std::vector<Disk> disks = random_disks(12, 14, 14, 6, 3);
  for (int k = 0; k < 12; ++k) disks[k].centre += 25 * Vec2(k % 4, k / 4);
  LabelImage labels = labels_of(tessellated(90, 70, disks));
  const LabelImage before = labels;
  const Cleaning done = clean_labels(labels, 1);
  EXPECT_THAT(done.scattered, IsEmpty());
  EXPECT_THAT(done.filled, IsEmpty());
  EXPECT_EQ(labels.cell, before.cell);
  EXPECT_EQ(labels.number, before.number);
}

}  // namespace
}  // namespace lamella
