#include "generator/packing/sizes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::Gt;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

SizesScene sizes(const std::string& distribution, double cv) {
  SizesScene scene;
  scene.distribution = distribution;
  scene.mean = 2e-5;
  scene.cv = cv;
  return scene;
}

double mean(const std::vector<double>& radii) {
  return std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
}

double moment(const std::vector<double>& radii, int order) {
  const double centre = mean(radii);
  double sum = 0;
  for (const double r : radii) sum += std::pow(r - centre, order);
  return sum / static_cast<double>(radii.size());
}

double cv(const std::vector<double>& radii) { return std::sqrt(moment(radii, 2)) / mean(radii); }
double skewness(const std::vector<double>& radii) { return moment(radii, 3) / std::pow(moment(radii, 2), 1.5); }

std::string message_of(const SizesScene& scene, int count) {
  try {
    draw_radii(scene, count, 1, {});
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(sizes, mean_and_coefficient_of_variation_are_those_asked_for) {
  for (const char* distribution : {"uniform", "normal", "lognormal", "gamma"}) {
    for (const double asked : {0.0, 0.001, 0.1, 0.3, 0.55}) {
      const auto radii = draw_radii(sizes(distribution, asked), 20000, 3, {});
      // Stratified: far closer than the 0.7 % of independent draws.
      EXPECT_NEAR(mean(radii) / 2e-5, 1, 1e-4) << distribution;
      EXPECT_NEAR(cv(radii), asked, 2e-3 * asked + 1e-12) << distribution;
      EXPECT_THAT(radii, Each(Gt(0)));
    }
  }
}

TEST(sizes, the_third_moment_tells_the_distributions_apart) {
  const double c = 0.4;
  EXPECT_NEAR(skewness(draw_radii(sizes("uniform", c), 50000, 1, {})), 0, 0.01);
  EXPECT_NEAR(skewness(draw_radii(sizes("gamma", c), 50000, 1, {})), 2 * c, 0.02);
  EXPECT_NEAR(skewness(draw_radii(sizes("lognormal", c), 50000, 1, {})), c * (3 + c * c), 0.05);
  EXPECT_NEAR(skewness(draw_radii(sizes("normal", 0.1), 50000, 1, {})), 0, 0.02);
}

TEST(sizes, a_wide_normal_distribution_is_cut_off_at_zero_and_keeps_its_moments) {
  const auto radii = draw_radii(sizes("normal", 0.9), 20000, 3, {});
  EXPECT_THAT(radii, Each(Gt(0)));
  EXPECT_NEAR(mean(radii) / 2e-5, 1, 1e-3);
  EXPECT_NEAR(cv(radii), 0.9, 2e-3);
}

TEST(sizes, bidisperse_has_the_share_and_ratio_asked_for) {
  SizesScene scene = sizes("bidisperse", 0);
  scene.ratio = 1.4, scene.share = 0.25;
  const auto radii = draw_radii(scene, 400, 1, {});
  const double small_radius = *std::min_element(radii.begin(), radii.end());
  EXPECT_EQ(std::count(radii.begin(), radii.end(), small_radius), 300);
  EXPECT_NEAR(*std::max_element(radii.begin(), radii.end()) / small_radius, 1.4, 1e-14);
  EXPECT_NEAR(mean(radii) / 2e-5, 1, 1e-14);
}

TEST(sizes, the_seed_decides_and_nothing_else) {
  const auto radii = draw_radii(sizes("lognormal", 0.3), 100, 5, {});
  EXPECT_EQ(radii, draw_radii(sizes("lognormal", 0.3), 100, 5, {}));
  EXPECT_NE(radii, draw_radii(sizes("lognormal", 0.3), 100, 6, {}));
  EXPECT_FALSE(std::is_sorted(radii.begin(), radii.end()));
}

TEST(sizes, a_file_gives_its_own_radii) {
  const auto path = std::filesystem::path(testing::TempDir()) / "radii.txt";
  std::ofstream(path) << "# radii\n3\n1 # the smallest\n\n2\n";
  SizesScene scene = sizes("file", 0);
  scene.file = path.string();
  EXPECT_THAT(draw_radii(scene, 3, 1, {}), UnorderedElementsAre(1, 2, 3));
  EXPECT_THAT(draw_radii(scene, 6, 1, {}), UnorderedElementsAre(1, 1, 2, 2, 3, 3));
  std::ofstream(path) << "1\nwide\n-2\nnan\n1 2\n";
  try {
    read_radii(path);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_THAT(error.faults(), ElementsAre(HasSubstr("radii.txt:2: "), HasSubstr("radii.txt:3: "),
                                            HasSubstr("radii.txt:4: "), HasSubstr("radii.txt:5: ")));
  }
  scene.file = path.string() + ".missing";
  EXPECT_THROW(draw_radii(scene, 3, 1, {}), DataError);
}

TEST(sizes, what_cannot_be_drawn_is_refused) {
  EXPECT_THAT(message_of(sizes("uniform", 0.6), 10), AllOf(HasSubstr("sample.sizes.cv = 0.6"), HasSubstr("0.577")));
  EXPECT_THAT(message_of(sizes("lognormal", -0.1), 10), HasSubstr("cv = -0.1"));
  EXPECT_THAT(message_of(sizes("gamma", NAN), 10), HasSubstr("cv = nan"));
  EXPECT_THAT(message_of(sizes("weibull", 0.1), 10), HasSubstr("must be one of"));
  EXPECT_THAT(message_of(sizes("normal", 0.1), 0), HasSubstr("count = 0"));
  EXPECT_THAT(message_of(sizes("file", 0.1), 3), HasSubstr("sample.sizes.file is missing"));
  SizesScene negative = sizes("normal", 0.1);
  negative.mean = -1;
  EXPECT_THAT(message_of(negative, 10), HasSubstr("mean = -1"));
}

}  // namespace
}  // namespace lamella
