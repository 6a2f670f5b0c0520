#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "generator/sample/scene.h"

namespace lamella {
namespace {

TEST(scene_page, the_committed_reference_is_what_the_rows_say) {
  std::ifstream in(LAMELLA_SOURCE_DIR "/docs/scene_reference.md");
  std::stringstream committed;
  committed << in.rdbuf();
  EXPECT_EQ(committed.str(), scene_reference())
      << "write it anew: build/lamella describe --markdown > docs/scene_reference.md";
}

TEST(scene_page, every_parameter_has_unit_range_default_and_sentence) {
  const std::string text = describe_scene();
  EXPECT_THAT(text, testing::HasSubstr("young: number in Pa; > 0; default: required, or both rigidities"));
  EXPECT_THAT(text, testing::HasSubstr("exponent: number; 1 to 100; default: 2"));
  EXPECT_THAT(text, testing::HasSubstr("normal_stiffness: number in N/m2 (N/m per link)"));
}

}  // namespace
}  // namespace lamella
