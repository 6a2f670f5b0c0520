// Faults that are found long after the scene was read say where in it stands what they are about.
#include "generator/sample/scene_place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lamella {
namespace {

using testing::ElementsAre;

const char* const kScene =
    "[cells]\nthickness = 0.1\n[sample]\nkind = \"tissue\"\npacking.count = 10\n"
    "sizes = { distribution = \"mixture\", mixture = [\n{ mean = 1, share = 0.5 },\n{ mean = 2, share = 0.5 }] }\n"
    "[sample.domain]\nkind = \"polygon\"\npoints = [[0, 0],\n[1, 0], [1, 1]]\n[[sample.domain.holes]]\n"
    "radius = 0.1\ncentre = [0.5, 0.2]\n[[sample.domain.holes]]\nradius = 0.05\ncentre = [0.9, "
    "0.2]\n[sample.walls]\nsegments = 2\n";

std::vector<std::string> placed(const std::vector<std::string>& faults, const std::vector<std::string>& settings = {}) {
  return with_places(parse_scene(kScene, "s.toml", settings), faults);
}

TEST(scene_place, is_that_of_the_key_or_of_its_section) {
  EXPECT_THAT(placed({"sample.domain.points: encloses no area"}),
              ElementsAre("s.toml:11: sample.domain.points: encloses no area"));
  EXPECT_THAT(placed({"sample.domain.holes[1]: lies outside", "sample.domain.holes[1].radius = 3: is large"}),
              ElementsAre("s.toml:16: sample.domain.holes[1]: lies outside",
                          "s.toml:17: sample.domain.holes[1].radius = 3: is large"));
  EXPECT_THAT(placed({"sample.sizes.mixture[1]: has 0.1 of 10 disks", "sample.sizes.mixture: the shares"}),
              ElementsAre("s.toml:8: sample.sizes.mixture[1]: has 0.1 of 10 disks",
                          "s.toml:6: sample.sizes.mixture: the shares"));
  EXPECT_THAT(placed({"sample.packing.count = 10: x", "sample.packing.fraction = 0.9: x", "sample: x"}),
              ElementsAre("s.toml:5: sample.packing.count = 10: x", "s.toml:5: sample.packing.fraction = 0.9: x",
                          "s.toml:3: sample: x"));
}

TEST(scene_place, is_the_setting_that_gives_the_key) {
  EXPECT_THAT(placed({"sample.packing.fraction = 0.9: x"}, {"sample.packing.fraction=0.9"}),
              ElementsAre("--set sample.packing.fraction=0.9: sample.packing.fraction = 0.9: x"));
}

TEST(scene_place, of_what_names_no_key_is_not_made_up) {
  const std::vector<std::string> faults{"cells 3 and 4 cross", "site 3: x", "", "a.csv:3: x",
                                        "sample.domain.holes[7: x"};
  const std::vector<std::string> found = placed(faults);
  EXPECT_THAT(std::vector(found.begin(), found.end() - 1), testing::ElementsAreArray(faults.begin(), faults.end() - 1));
  EXPECT_EQ(with_places(Scene{}, {"sample.domain.points: x"}).front(), "sample.domain.points: x");
}

}  // namespace
}  // namespace lamella
