#include "generator/packing/sizes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "generator/sample/errors.h"
#include "tests/support/temporary_folder.h"

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
  for (const char* distribution : {"uniform", "normal", "lognormal", "gamma", "weibull"}) {
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

TEST(sizes, a_weibull_distribution_of_cv_1_is_the_exponential_one) {
  auto radii = draw_radii(sizes("weibull", 1), 20000, 1, {});
  std::sort(radii.begin(), radii.end());
  for (const int k : {2000, 10000, 18000})  // -log(1 - p)
    EXPECT_NEAR(radii[k] / 2e-5, -std::log(1 - (k + 0.5) / 20000), 1e-3);
  EXPECT_NEAR(skewness(radii), 2, 0.05);
  EXPECT_NEAR(cv(draw_radii(sizes("weibull", 3), 200000, 1, {})), 3, 0.1);
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

SizesScene table(std::vector<Vec2> pairs) {
  SizesScene scene = sizes("table", 0);
  scene.table = std::move(pairs);
  return scene;
}

TEST(sizes, a_table_gives_its_density_whatever_its_scale) {
  // A triangle from 1 to 4 with its top at 2, then nothing until 6, then a block to 7: areas 3 and 1.
  const std::vector<Vec2> pairs{{1, 0}, {2, 2}, {4, 0}, {6, 0}, {6.0000001, 1}, {7, 1}};
  auto radii = draw_radii(table(pairs), 40000, 1, {});
  std::sort(radii.begin(), radii.end());
  const auto below = [&](double r) {
    return static_cast<double>(std::lower_bound(radii.begin(), radii.end(), r) - radii.begin()) / 40000;
  };
  EXPECT_NEAR(below(1), 0, 1e-12);
  EXPECT_NEAR(below(1.5), 0.25 / 4, 1e-4);
  EXPECT_NEAR(below(2), 1.0 / 4, 1e-4);
  EXPECT_NEAR(below(3), (3 - 0.5) / 4, 1e-4);
  EXPECT_NEAR(below(4), 3.0 / 4, 1e-4);
  EXPECT_NEAR(below(6), 3.0 / 4, 1e-4);
  EXPECT_NEAR(below(6.5), 3.5 / 4, 1e-4);
  EXPECT_LE(radii.back(), 7);
  EXPECT_NEAR(mean(radii), (3 * (1 + 2 + 4) / 3.0 + 6.5) / 4, 1e-4);

  std::vector<Vec2> scaled = pairs;
  for (Vec2& pair : scaled) pair.y() *= 1e-30;
  const auto same = draw_radii(table(pairs), 100, 1, {}), again = draw_radii(table(scaled), 100, 1, {});
  for (std::size_t k = 0; k < same.size(); ++k) EXPECT_NEAR(same[k], again[k], 1e-12);
}

TEST(sizes, a_table_that_is_no_density_is_refused) {
  EXPECT_THAT(message_of(table({}), 10), HasSubstr("has 0 pairs"));
  EXPECT_THAT(message_of(table({{1, 1}}), 10), HasSubstr("two or more"));
  EXPECT_THAT(message_of(table({{1, 1}, {1, 2}}), 10), AllOf(HasSubstr("pair 2"), HasSubstr("must increase")));
  EXPECT_THAT(message_of(table({{2, 1}, {1, 2}}), 10), HasSubstr("must increase"));
  EXPECT_THAT(message_of(table({{1, 1}, {2, -1}}), 10), AllOf(HasSubstr("pair 2"), HasSubstr("density")));
  EXPECT_THAT(message_of(table({{-1, 1}, {2, 1}}), 10), AllOf(HasSubstr("pair 1"), HasSubstr("radius")));
  EXPECT_THAT(message_of(table({{1, 0}, {2, 0}}), 10), HasSubstr("all densities are 0"));
  EXPECT_THAT(message_of(table({{1, NAN}, {2, 1}}), 10), HasSubstr("must be finite"));
}

MixtureScene part(const std::string& group, double mean_radius, double variation) {
  MixtureScene scene;
  scene.group = group, scene.mean = mean_radius, scene.cv = variation;
  return scene;
}

SizesScene mixture(std::vector<MixtureScene> parts, std::vector<double> shares, bool by_area) {
  SizesScene scene = sizes("mixture", 0);
  for (std::size_t k = 0; k < parts.size(); ++k) (by_area ? parts[k].area_share : parts[k].share) = shares[k];
  scene.mixture = std::move(parts);
  return scene;
}

TEST(sizes, the_parts_of_a_mixture_have_their_shares_means_and_groups) {
  const std::vector<MixtureScene> parts{part("small", 1, 0.3), part("large", 4, 0.1), part("round", 2, 0)};
  const std::vector<double> shares{0.503, 0.297, 0.2};
  for (const bool by_area : {false, true}) {
    for (const int count : {37, 1000, 20000}) {
      const Sizes drawn = draw_sizes(mixture(parts, shares, by_area), count, 4, {});
      ASSERT_EQ(drawn.group.size(), drawn.radius.size());
      double total_area = 0;
      for (const double r : drawn.radius) total_area += r * r;
      for (std::size_t k = 0; k < parts.size(); ++k) {
        std::vector<double> radii;
        for (int i = 0; i < count; ++i)
          if (drawn.group[i] == parts[k].group) radii.push_back(drawn.radius[i]);
        const double mean_square = parts[k].mean * parts[k].mean * (1 + parts[k].cv * parts[k].cv);
        if (!by_area) {
          EXPECT_NEAR(static_cast<double>(radii.size()), shares[k] * count, 1);
        } else {
          // One disk more or less of any part, and what is left of chance in a stratified sample.
          double area = 0;
          for (const double r : radii) area += r * r;
          EXPECT_NEAR(area / total_area, shares[k], (mean_square + 16.2) / total_area + 1e-3);
        }
        EXPECT_NEAR(mean(radii) / parts[k].mean, 1, 3.0 * parts[k].cv / static_cast<double>(radii.size()) + 1e-14);
        if (count == 20000) {
          EXPECT_NEAR(cv(radii), parts[k].cv, 2e-3 * parts[k].cv + 1e-12);
        }
      }
    }
  }
}

TEST(sizes, kinds_are_mixed_in_space) {
  const Sizes drawn = draw_sizes(mixture({part("a", 1, 0.1), part("b", 2, 0.1)}, {0.5, 0.5}, false), 1000, 4, {});
  const auto first_half = std::count(drawn.group.begin(), drawn.group.begin() + 500, "a");
  EXPECT_NEAR(static_cast<double>(first_half), 250, 4 * std::sqrt(1000.0 / 16));
}

TEST(sizes, a_mixture_that_is_none_is_refused) {
  const std::vector<MixtureScene> parts{part("a", 1, 0.1), part("b", 2, 0.1)};
  EXPECT_THAT(message_of(mixture({}, {}, false), 10), HasSubstr("mixture: is empty"));
  EXPECT_THAT(message_of(mixture(parts, {0.5, 0.4}, false), 10), HasSubstr("the shares sum to 0.9; must be 1"));
  EXPECT_THAT(message_of(mixture(parts, {0.5, 0.6}, true), 10), HasSubstr("the shares sum to 1.1"));
  EXPECT_THAT(message_of(mixture(parts, {1.5, -0.5}, true), 10),
              AllOf(HasSubstr("mixture[0].area_share = 1.5"), HasSubstr("mixture[1].area_share = -0.5")));
  EXPECT_THAT(message_of(mixture(parts, {0.5, NAN}, false), 10), HasSubstr("mixture[1].share = nan"));
  EXPECT_THAT(message_of(mixture(parts, {0.999, 0.001}, false), 10), HasSubstr("mixture[1]: has 0.01 of 10 disks"));
  SizesScene both = mixture(parts, {0.5, 0.5}, false);
  both.mixture[1].share.reset();
  EXPECT_THAT(message_of(both, 10), HasSubstr("mixture[1]: needs share"));
  both.mixture[1].area_share = 0.5;
  EXPECT_THAT(message_of(both, 10), HasSubstr("one of them throughout"));
  SizesScene bad = mixture(parts, {0.5, 0.5}, false);
  bad.mixture[0].mean = 0, bad.mixture[0].cv = -1, bad.mixture[1].distribution = "file";
  EXPECT_THAT(message_of(bad, 10), AllOf(HasSubstr("mixture[0].mean = 0"), HasSubstr("mixture[0].cv = -1"),
                                         HasSubstr("mixture[1].distribution = \"file\"")));
}

TEST(sizes, the_seed_decides_and_nothing_else) {
  const auto radii = draw_radii(sizes("lognormal", 0.3), 100, 5, {});
  EXPECT_EQ(radii, draw_radii(sizes("lognormal", 0.3), 100, 5, {}));
  EXPECT_NE(radii, draw_radii(sizes("lognormal", 0.3), 100, 6, {}));
  EXPECT_FALSE(std::is_sorted(radii.begin(), radii.end()));
}

TEST(sizes, a_file_gives_its_own_radii) {
  static const TemporaryFolder folder;
  const auto path = folder / "radii.txt";
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
  EXPECT_THAT(message_of(sizes("pareto", 0.1), 10), HasSubstr("must be one of"));
  EXPECT_THAT(message_of(sizes("normal", 0.1), 0), HasSubstr("count = 0"));
  EXPECT_THAT(message_of(sizes("file", 0.1), 3), HasSubstr("sample.sizes.file is missing"));
  SizesScene negative = sizes("normal", 0.1);
  negative.mean = -1;
  EXPECT_THAT(message_of(negative, 10), HasSubstr("mean = -1"));
}

}  // namespace
}  // namespace lamella
