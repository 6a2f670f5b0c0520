// Micrographs that are drawn: cells are found where they are, and walls are as thick as drawn.
#include "generator/image/segment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tests/generator/image/pictures.h"

namespace lamella {
namespace {

double noise(std::mt19937& random, double deviation) { return std::normal_distribution<double>(0, deviation)(random); }

std::uint32_t grey(double brightness) {
  return static_cast<std::uint32_t>(std::clamp(brightness, 0.0, 1.0) * 255 + 0.5);
}

/// Distance of a point from the nearest wall of a brick pattern, and the number of its brick.
struct Brick {
  double distance;
  std::uint32_t number;
};

Brick brick_at(double x, double y, double width, double height, int columns) {
  const int row = static_cast<int>(y / height);
  const double shifted = x + (row % 2) * width / 2;
  const int column = static_cast<int>(shifted / width);
  const double u = shifted - column * width, v = y - row * height;
  return {std::min({u, width - u, v, height - v}), static_cast<std::uint32_t>(row * (columns + 1) + column)};
}

/// Of the pixels, how many are in the cell that holds most of their true cell.
double agreement_with(const LabelImage& found, const std::vector<std::uint32_t>& truth) {
  std::map<std::pair<std::uint32_t, Index>, int> shared;
  for (std::size_t k = 0; k < truth.size(); ++k) ++shared[{truth[k], found.cell[k]}];
  std::map<std::uint32_t, int> best;
  for (const auto& [pair, count] : shared)
    if (pair.second >= 0) best[pair.first] = std::max(best[pair.first], count);
  double sum = 0;
  for (const auto& [number, count] : best) sum += count;
  return sum / static_cast<double>(truth.size());
}

TEST(Otsu, parts_two_classes_between_them) {
  std::vector<float> value;
  for (int k = 0; k < 100; ++k) value.push_back(0.2F + 0.001F * static_cast<float>(k % 7));
  for (int k = 0; k < 300; ++k) value.push_back(0.8F - 0.001F * static_cast<float>(k % 5));
  const double threshold = otsu_threshold(value);
  EXPECT_GT(threshold, 0.21);
  EXPECT_LT(threshold, 0.79);
  EXPECT_GT(otsu_threshold(std::vector<float>(10, 1.0F)), 0);  // one class: anything, but a number
}

TEST(Otsu, is_the_least_variance_within_by_brute_force) {
  std::mt19937 random(9);
  std::vector<float> value;
  for (int k = 0; k < 3000; ++k)
    value.push_back(
        static_cast<float>(std::clamp(k % 4 == 0 ? 0.3 + noise(random, 0.1) : 0.7 + noise(random, 0.07), 0.0, 0.999)));
  const auto within = [&](double threshold) {
    double sum[2] = {0, 0}, square[2] = {0, 0}, count[2] = {0, 0};
    for (const float v : value) {
      const int c = v >= threshold;
      sum[c] += v;
      square[c] += v * v;
      ++count[c];
    }
    double total = 0;
    for (int c = 0; c < 2; ++c) total += count[c] > 0 ? square[c] - sum[c] * sum[c] / count[c] : 0;
    return total;
  };
  double least = 1e300;
  for (int k = 1; k < 512; ++k) least = std::min(least, within(k / 512.0));
  EXPECT_LT(within(otsu_threshold(value)), least * 1.001);
}

class Bricks : public ::testing::TestWithParam<bool> {};

TEST_P(Bricks, are_found_and_their_walls_are_as_thick_as_drawn) {
  const bool dark = GetParam();
  for (const double thickness : {2.0, 3.5, 6.0}) {
    std::mt19937 random(4);
    std::vector<std::uint32_t> truth;
    const Picture picture = picture_of(240, 180, [&](int x, int y) {
      const Brick brick = brick_at(x + 0.5, y + 0.5, 40, 30, 6);
      truth.push_back(brick.number);
      // Brightness by how much of a pixel the wall covers.
      const double cover = std::clamp(thickness / 2 - brick.distance + 0.5, 0.0, 1.0);
      const double wall = dark ? 0.2 : 0.85, cell = dark ? 0.8 : 0.1;
      return grey(cover * wall + (1 - cover) * cell + noise(random, 0.06));
    });
    const Segmentation found = segment(picture, {.dark_walls = dark});
    const std::set<std::uint32_t> numbers(truth.begin(), truth.end());
    EXPECT_EQ(found.labels.number.size(), numbers.size());
    EXPECT_GT(agreement_with(found.labels, truth), 0.99);
    EXPECT_GT(found.walls, 40);
    EXPECT_NEAR(found.thickness, thickness, 0.6);
    EXPECT_LT(found.deviation, 0.6);
  }
}

INSTANTIATE_TEST_SUITE_P(walls, Bricks, ::testing::Values(true, false),
                         [](const auto& walls) { return walls.param ? "dark" : "bright"; });

TEST(Segmentation, parts_cells_at_a_constriction_where_their_wall_has_a_hole) {
  const auto two_rooms = [](int hole) {
    return picture_of(60, 30, [&](int x, int y) {
      const bool frame = x < 2 || y < 2 || x >= 58 || y >= 28;
      const bool wall = std::abs(x - 30) < 2 && std::abs(y - 15) >= hole;
      return frame || wall ? 10u : 240u;
    });
  };
  EXPECT_EQ(segment(two_rooms(3), {}).labels.number.size(), 2u);
  EXPECT_EQ(segment(two_rooms(12), {}).labels.number.size(), 1u);
}

TEST(Segmentation, does_not_cut_a_long_cell_where_it_is_a_quarter_narrower) {
  const Picture picture = picture_of(200, 30, [&](int x, int y) {
    const double middle = 15 + 6 * std::sin(x / 25.0);
    return std::abs(y - middle) < 8 + std::cos(x / 12.0) && x > 3 && x < 196 ? 240u : 10u;
  });
  EXPECT_EQ(segment(picture, {}).labels.number.size(), 1u);
}

TEST(Segmentation, ignores_specks_in_cells_and_in_walls) {
  const Picture picture = picture_of(80, 40, [&](int x, int y) {
    const bool in_wall = x < 6 || y < 6 || x >= 74 || y >= 34 || std::abs(x - 40) < 5;
    const bool speck = (x % 17 == 8 && y % 13 == 4) || (std::abs(x - 40) < 2 && y == 20);
    return in_wall != speck ? 10u : 240u;
  });
  EXPECT_EQ(segment(picture, {.smoothing = 0}).labels.number.size(), 2u);
}

TEST(Segmentation, leaves_wide_dark_places_as_background) {
  // Discs of radius 14 with walls of 3 pixels, in the dark: cells grow to the walls' middles, not into the dark.
  const Picture picture = picture_of(120, 120, [&](int x, int y) {
    const auto inside = [&](double cx, double cy) { return std::hypot(x + 0.5 - cx, y + 0.5 - cy) < 14; };
    return inside(60, 60) || inside(60 + 31, 60) || inside(60, 60 + 31) ? 230u : 20u;
  });
  const Segmentation found = segment(picture, {.smoothing = 0});
  EXPECT_EQ(found.labels.number.size(), 3u);
  EXPECT_EQ(found.labels.cell[found.labels.at(5, 5)], kBackground);
  std::size_t background = 0;
  for (const Index cell : found.labels.cell) background += cell == kBackground;
  EXPECT_GT(background, 120u * 120u / 2);
}

TEST(Segmentation, of_one_shade_finds_no_cell_or_one) {
  EXPECT_EQ(segment(picture_of(20, 20, [](int, int) { return 0u; }), {}).labels.number.size(), 0u);
  EXPECT_LE(segment(picture_of(20, 20, [](int, int) { return 128u; }), {}).labels.number.size(), 1u);
}

}  // namespace
}  // namespace lamella
