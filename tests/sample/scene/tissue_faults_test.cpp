// What is wrong with domains, layers, gradients, stretches and bricks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "generator/sample/errors.h"
#include "generator/sample/scene.h"

namespace lamella {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> faults(const std::string& text) {
  try {
    parse_scene(text, "s.toml");
  } catch (const SceneError& error) {
    return error.faults();
  }
  return {};
}

const std::string kCells = "[cells]\nthickness = 0.1\nyoung = 1e6\ndensity = 1000\n";

/// A tissue in a box; `more` starts in [sample], at line 8.
std::string boxed(const std::string& more) {
  return kCells + "[sample]\nkind = \"tissue\"\nwidth = 10\nheight = 10\nwalls.segments = 3\n" + more;
}

/// A tissue without a box.
std::string open(const std::string& more) {
  return kCells + "[sample]\nkind = \"tissue\"\nsizes.mean = 1\nwalls.segments = 3\n" + more;
}

TEST(tissue_faults, the_scenes_used_here_are_fine) {
  EXPECT_THAT(faults(boxed("")), ElementsAre());
  EXPECT_THAT(faults(open("domain = { kind = \"disk\", radius = 3 }\n")), ElementsAre());
  EXPECT_THAT(faults(open("domain = { kind = \"ring\", radius = 3, inner_radius = 1 }\nstretch.ratio = 2\n")),
              ElementsAre());
  EXPECT_THAT(faults(boxed("gradient.thickness = [[0, 1], [10, 2]]\n[[sample.layers]]\nto = 3\nsize = 0.5\n")),
              ElementsAre());
}

TEST(tissue_faults, a_domain_lacks_what_its_kind_needs_or_has_what_it_does_not) {
  EXPECT_THAT(faults(open("domain.kind = \"disk\"\n")),
              ElementsAre(HasSubstr("sample.domain.radius: missing; a disk needs it")));
  EXPECT_THAT(faults(open("domain = { kind = \"disk\", radius = 1, points = [[0, 0], [1, 0], [0, 1]] }\n")),
              ElementsAre(HasSubstr("sample.domain.points: does not belong to a disk")));
  EXPECT_THAT(faults(open("domain = { kind = \"ring\", radius = 1 }\n")),
              ElementsAre(HasSubstr("sample.domain.inner_radius: missing")));
  EXPECT_THAT(faults(open("domain = { kind = \"ring\", radius = 1, inner_radius = 1 }\n")),
              ElementsAre(HasSubstr("inner_radius: is not below radius")));
  EXPECT_THAT(faults(open("domain = { kind = \"polygon\" }\n")),
              ElementsAre(HasSubstr("sample.domain.points: missing; a polygon needs it")));
  EXPECT_THAT(faults(open("domain = { kind = \"polygon\", points = [[0, 0], [1, 0]] }\n")),
              ElementsAre(HasSubstr("has 2 points; give three or more")));
  EXPECT_THAT(faults(open("domain = { radius = 1 }\n")), Contains(HasSubstr("sample.domain.kind: missing")));
  EXPECT_THAT(faults(open("domain = { kind = \"disk\", radius = 0 }\n")), Contains(HasSubstr("sample.domain.radius")));
  EXPECT_THAT(faults(open("domain = 3\n")), Contains(HasSubstr("sample.domain: is a whole number")));
}

TEST(tissue_faults, a_domain_excludes_a_box_and_what_repeats) {
  EXPECT_THAT(faults(boxed("domain = { kind = \"disk\", radius = 1 }\n")),
              ElementsAre(HasSubstr("s.toml:7: sample.width: contradicts the domain")));
  EXPECT_THAT(faults(open("domain = { kind = \"disk\", radius = 1 }\npacking.boundary = \"periodic\"\n")),
              ElementsAre(HasSubstr("sample.packing.boundary: contradicts sample.domain")));
  EXPECT_THAT(faults(open("domain = { kind = \"disk\", radius = 1 }\nperiodic = \"x\"\n")),
              Contains(HasSubstr("sample.domain: has a boundary")));
}

TEST(tissue_faults, a_gradient_jumps_where_the_sample_repeats_or_is_out_of_range) {
  const std::string gradient = "gradient = { along = \"x\", size = [[0, 1], [1, 2]] }\n";
  EXPECT_THAT(faults(boxed("periodic = \"y\"\n" + gradient)), ElementsAre());
  for (const char* along : {"x", "xy"})
    EXPECT_THAT(faults(boxed(std::string("periodic = \"") + along + "\"\n" + gradient)),
                ElementsAre(HasSubstr("sample.gradient.along: \"x\": the sample repeats that way")));
  for (const char* factor : {"0.01", "1e6"})
    EXPECT_THAT(faults(boxed(std::string("gradient.size = [[0, ") + factor + "]]\n")),
                ElementsAre(HasSubstr("is not in 0.05 to 20")));
}

TEST(tissue_faults, a_gradient_is_empty_or_not_one) {
  EXPECT_THAT(faults(boxed("gradient.along = \"x\"\n")), ElementsAre(HasSubstr("sample.gradient: is empty")));
  EXPECT_THAT(faults(boxed("gradient.size = []\n")), Contains(HasSubstr("sample.gradient.size: is empty")));
  EXPECT_THAT(faults(boxed("gradient.size = [[0, 1], [0, 2]]\n")),
              ElementsAre(HasSubstr("s.toml:10: sample.gradient.size: entry 1: positions must increase")));
  EXPECT_THAT(faults(boxed("gradient.thickness = [[0, 1], [1, 0]]\n")),
              ElementsAre(HasSubstr("sample.gradient.thickness: entry 1: the factor 0 is not positive")));
  EXPECT_THAT(faults(boxed("gradient.strength = [[0, -1]]\n")),
              ElementsAre(HasSubstr("sample.gradient.strength: entry 0: the factor -1 is not positive")));
}

TEST(tissue_faults, places_are_named_in_a_box_that_is_not_known) {
  EXPECT_THAT(faults(open("gradient.size = [[0, 1], [1, 2]]\n")),
              ElementsAre(HasSubstr("sample.gradient: refers to places")));
  EXPECT_THAT(faults(open("[[sample.layers]]\nto = 1\n")), ElementsAre(HasSubstr("sample.layers: refer to places")));
  EXPECT_THAT(faults(open("stretch.ratio = 2\n")), ElementsAre(HasSubstr("sample.stretch: needs width and height")));
}

TEST(tissue_faults, sizes_and_stretches_contradict_a_packing_from_a_file) {
  const std::string file = "[sample]\nkind = \"tissue\"\npacking.file = \"p.csv\"\nwalls.segments = 3\n";
  EXPECT_THAT(faults(kCells + file + "gradient.size = [[0, 1]]\n"), ElementsAre(HasSubstr("contradicts packing.file")));
  EXPECT_THAT(faults(kCells + file + "[[sample.layers]]\nto = 1\nsize = 2\n"),
              ElementsAre(HasSubstr("a size contradicts packing.file")));
  EXPECT_THAT(faults(kCells + file + "domain = { kind = \"disk\", radius = 1 }\nstretch.ratio = 2\n"),
              ElementsAre(HasSubstr("sample.stretch: contradicts packing.file")));
  EXPECT_THAT(faults(kCells + file + "[[sample.layers]]\nto = 1\ngroup = \"skin\"\n"), ElementsAre());
}

TEST(tissue_faults, a_layer_has_no_end_no_width_or_two_shapes) {
  EXPECT_THAT(faults(boxed("[[sample.layers]]\nfrom = 1\n")), ElementsAre(HasSubstr("missing; where the layer ends")));
  EXPECT_THAT(faults(boxed("[[sample.layers]]\nfrom = 1\nto = 1\n")), ElementsAre(HasSubstr("is not beyond from")));
  EXPECT_THAT(faults(boxed("[[sample.layers]]\npolygon = [[0, 0], [1, 1]]\n")),
              ElementsAre(HasSubstr("has fewer than three points")));
  EXPECT_THAT(faults(boxed("[[sample.layers]]\nto = 1\npolygon = [[0, 0], [1, 1], [0, 1]]\n")),
              Contains(HasSubstr("contradicts polygon")));
  EXPECT_THAT(faults(boxed("[[sample.layers]]\nto = 1\nsize = 0\n")), Contains(HasSubstr("size")));
}

TEST(tissue_faults, a_stretch_is_no_ratio_or_repeats) {
  EXPECT_THAT(faults(boxed("stretch.angle = 1\n")), Contains(HasSubstr("sample.stretch.ratio: missing")));
  EXPECT_THAT(faults(boxed("stretch.ratio = 0\n")), Contains(HasSubstr("sample.stretch.ratio")));
  EXPECT_THAT(faults(boxed("stretch.ratio = 2\npacking.boundary = \"periodic\"\n")),
              ElementsAre(HasSubstr("sample.stretch: squeezes disks whose packing repeats")));
  EXPECT_THAT(faults(boxed("stretch = { ratio = 2, angle = \"45 deg\" }\nperiodic = \"xy\"\n")),
              ElementsAre(HasSubstr("sample.stretch.angle: is neither 0 nor 90 deg")));
  EXPECT_THAT(faults(boxed("stretch = { ratio = 2, angle = \"90 deg\" }\nperiodic = \"xy\"\n")), ElementsAre());
  EXPECT_THAT(faults(boxed("stretch.ratio = 2\nperiodic = \"x\"\nareas.of = \"inset\"\n")),
              ElementsAre(HasSubstr("sample.stretch: draws out tiles")));
}

TEST(tissue_faults, sections_of_a_tissue_do_not_belong_to_other_kinds) {
  const std::string bricks = kCells + "[sample]\nkind = \"bricks\"\ncolumns = 2\nrows = 2\nwalls.segments = 3\n";
  EXPECT_THAT(faults(bricks + "brick = [2, 1]\n"), ElementsAre());
  EXPECT_THAT(faults(bricks), ElementsAre(HasSubstr("sample.brick: missing")));
  EXPECT_THAT(faults(bricks + "brick = [2, 0]\n"), ElementsAre(HasSubstr("sample.brick: is not positive")));
  EXPECT_THAT(faults(bricks + "brick = [2, 1]\nshift = 1\n"), Contains(HasSubstr("sample.shift")));
  EXPECT_THAT(faults(bricks + "brick = [2, 1]\nstretch.ratio = 2\n"),
              Contains(HasSubstr("sample.stretch: belongs to kind = \"tissue\"")));
}

TEST(tissue_faults, what_is_given_directly_does_not_follow_a_varied_thickness) {
  const std::string graded =
      "[sample]\nkind = \"tissue\"\nwidth = 10\nheight = 10\nwalls.segments = 3\ngradient.thickness = [[0, 1], [1, "
      "2]]\n";
  EXPECT_THAT(faults("[cells]\nthickness = 0.1\naxial_rigidity = 1\nbending_rigidity = 1\ndensity = 1\n" + graded),
              ElementsAre(HasSubstr("s.toml:1: cells.axial_rigidity: does not follow gradient.thickness"),
                          HasSubstr("s.toml:1: cells.bending_rigidity: does not follow gradient.thickness")));
  EXPECT_THAT(faults("[cells]\nthickness = 0.1\nyoung = 1\nmass_per_length = 1\n" + graded),
              ElementsAre(HasSubstr("cells.mass_per_length: does not follow")));
}

}  // namespace
}  // namespace lamella
