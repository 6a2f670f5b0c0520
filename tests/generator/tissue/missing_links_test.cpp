// Links that are absent from the start.
#include "generator/tissue/missing_links.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

using Pairs = std::set<std::pair<Index, Index>>;

Scene honeycomb(double missing, std::uint64_t seed = 1) {
  Scene scene;
  scene.seed = seed;
  scene.sample.kind = "honeycomb";
  scene.sample.columns = scene.sample.rows = 4;
  scene.sample.side = 1;
  scene.sample.walls.segments = 4;
  scene.sample.walls.missing = missing;
  scene.stages.emplace_back();
  CellScene cells;
  cells.thickness = 0.02;
  scene.stages.front().cells["cells"] = cells;
  return scene;
}

Sample made(double missing, std::uint64_t seed = 1) {
  Notes notes;
  return generate(honeycomb(missing, seed), notes);
}

Pairs pairs_of(const Sample& sample) {
  Pairs out;
  for (const Link& link : sample.links) out.emplace(link.a, link.b);
  return out;
}

TEST(MissingLinks, are_so_many_of_those_of_the_whole_tissue_and_nothing_else_changes) {
  const Sample whole = made(0);
  const auto all = static_cast<double>(whole.links.size());
  for (const double share : {0.1, 0.5, 1.0}) {
    const Sample flawed = made(share);
    EXPECT_EQ(flawed.links.size(), whole.links.size() - static_cast<std::size_t>(std::lround(share * all)));
    std::size_t at = 0;  // the rest in its old order, each as it was
    for (const Link& link : flawed.links) {
      while (at < whole.links.size() && (whole.links[at].a != link.a || whole.links[at].b != link.b)) ++at;
      ASSERT_LT(at, whole.links.size());
      EXPECT_EQ(link.length, whole.links[at].length);
      EXPECT_EQ(link.wall, whole.links[at].wall);
      EXPECT_EQ(link.a_next, whole.links[at].a_next);
    }
    EXPECT_EQ(flawed.walls.size(), whole.walls.size());
    ASSERT_EQ(flawed.x.size(), whole.x.size());
    EXPECT_EQ(std::memcmp(flawed.x.data(), whole.x.data(), whole.x.size() * sizeof(Vec2)), 0);
  }
}

TEST(MissingLinks, are_the_same_by_the_same_seed_others_by_another_and_a_larger_share_has_those_of_a_smaller_one) {
  EXPECT_EQ(pairs_of(made(0.2, 3)), pairs_of(made(0.2, 3)));
  EXPECT_NE(pairs_of(made(0.2, 3)), pairs_of(made(0.2, 4)));
  const Pairs more = pairs_of(made(0.1, 3)), fewer = pairs_of(made(0.3, 3));
  EXPECT_TRUE(std::includes(more.begin(), more.end(), fewer.begin(), fewer.end()));
}

TEST(MissingLinks, take_every_link_equally_often_over_many_seeds) {
  const Sample whole = made(0);
  const std::size_t links = whole.links.size();
  const int seeds = 2000;
  const double share = 0.1;
  std::vector<int> absent(links, seeds);
  for (int seed = 0; seed < seeds; ++seed) {
    Sample sample = whole;
    sample.link_strength.resize(links);
    for (std::size_t l = 0; l < links; ++l) sample.link_strength[l] = static_cast<double>(l);
    Notes notes;
    drop_links(share, static_cast<std::uint64_t>(seed), sample, notes);
    ASSERT_EQ(sample.link_strength.size(), sample.links.size());
    for (std::size_t l = 0; l < sample.links.size(); ++l) {
      const auto which = static_cast<std::size_t>(sample.link_strength[l]);  // what is kept of a link stays with it
      EXPECT_EQ(sample.links[l].a, whole.links[which].a);
      EXPECT_EQ(sample.links[l].b, whole.links[which].b);
      --absent[which];
    }
  }
  // Chi-square of counts with variance seeds p (1 - p), near its number of links; six of its standard deviations.
  const double p = std::round(share * static_cast<double>(links)) / static_cast<double>(links), mean = seeds * p;
  double chi = 0;
  for (const int count : absent) chi += (count - mean) * (count - mean) / (mean * (1 - p));
  EXPECT_NEAR(chi, static_cast<double>(links), 6 * std::sqrt(2.0 * static_cast<double>(links)));
}

TEST(MissingLinks, of_a_sample_without_links_are_refused) {
  Scene scene = honeycomb(0.1);
  scene.sample.walls.links = "none";
  Notes notes;
  try {
    generate(scene, notes);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("sample.walls.missing: the sample has no link"));
  }
}

TEST(MissingLinks, leave_a_sound_sample_and_say_how_many_they_are) {
  Notes notes;
  const Sample flawed = generate(honeycomb(0.1), notes);
  EXPECT_THAT(check_sample(flawed), ::testing::IsEmpty());
  EXPECT_THAT(notes, ::testing::Contains(::testing::HasSubstr("links are absent from the start")));
}

}  // namespace
}  // namespace lamella
