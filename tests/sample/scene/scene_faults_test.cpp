// What is wrong with a scene is said with its line, all at once, with what would be right; and nothing crashes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "generator/sample/errors.h"
#include "generator/sample/scene.h"

namespace lamella {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> faults(const std::string& text, const std::vector<std::string>& settings = {}) {
  try {
    parse_scene(text, "s.toml", settings);
  } catch (const SceneError& error) {
    return error.faults();
  }
  return {};
}

/// A scene of a plate in which `cells` starts at line 8, and to which sections are added from line 12.
std::string plate(const std::string& more) {
  return "[sample]\nkind = \"shapes\"\n[[sample.shapes]]\nkind = \"plate\"\nfrom = [0, 0]\nto = [1, 0]\nsegments = 2\n"
         "[cells]\nthickness = 0.1\nyoung = 1e6\ndensity = 1000\n" +
         more;
}

std::string tissue(const std::string& more) { return "[cells]\nthickness = 0.1\n[sample]\nkind = \"tissue\"\n" + more; }

TEST(scene_faults, the_scenes_used_here_are_fine) {
  EXPECT_THAT(faults(plate("")), ElementsAre());
  EXPECT_THAT(faults(tissue("walls.segments = 3\nsizes.mean = 1\n")), ElementsAre());
}

TEST(scene_faults, an_unknown_key_suggests_the_nearest) {
  EXPECT_THAT(faults(plate("yuong = 3\n")),
              ElementsAre("s.toml:12: cells.yuong: unknown key; did you mean \"young\"?"));
  EXPECT_THAT(faults(plate("[loding]\nstrain = 1\n")),
              ElementsAre("s.toml:12: loding: unknown key; did you mean \"loading\"?"));
  EXPECT_THAT(faults(plate("[drag]\nrate = 1\nxyzzy = 1\n")),
              ElementsAre("s.toml:14: drag.xyzzy: unknown key; known: rate"));
}

TEST(scene_faults, a_wrong_type_says_what_to_give) {
  EXPECT_THAT(
      faults(plate("depth = true\n")),
      ElementsAre(
          "s.toml:12: cells.depth: is true or false; give a number in m, or a string with a unit, such as \"1 m\""));
  EXPECT_THAT(faults(plate("plane = 3\n")),
              ElementsAre(HasSubstr("s.toml:12: cells.plane: is a whole number; give one of")));
  EXPECT_THAT(faults(plate("[output]\nframes = 3.5\n")),
              ElementsAre(HasSubstr("s.toml:13: output.frames: is a number; give a whole number")));
  EXPECT_THAT(faults(plate("[stop]\ntime = 1\nseparated = \"yes\"\n")),
              ElementsAre(HasSubstr("s.toml:14: stop.separated: is a string; give true or false")));
  EXPECT_THAT(faults(plate("links = 3\n")), ElementsAre(HasSubstr("s.toml:12: cells.links")));
  EXPECT_THAT(faults("links = 3\n" + plate("")),
              ElementsAre("s.toml:1: links: is a whole number; it is a section of keys, [links]"));
  EXPECT_THAT(faults("loads = 3\n" + plate("[stop]\ntime = 1\n")),
              ElementsAre(HasSubstr("s.toml:1: loads: is a whole number; loads are a list")));
  EXPECT_THAT(faults(plate("depth = 1979-05-27\n")), ElementsAre(HasSubstr("is a date or time")));
}

TEST(scene_faults, a_wrong_dimension_names_the_right_one) {
  EXPECT_THAT(faults(plate("depth = \"10 s\"\n")),
              ElementsAre("s.toml:12: cells.depth: \"10 s\" is of another dimension; give a number in m, or a string "
                          "with a unit, such as \"1 m\""));
  EXPECT_THAT(faults(plate("depth = \"10 parsec\"\n")), ElementsAre(HasSubstr("\"parsec\" is no unit known here")));
  EXPECT_THAT(faults(plate("depth = \"deep\"\n")), ElementsAre(HasSubstr("it does not begin with a number")));
  EXPECT_THAT(faults(plate("poisson = \"0.3 m\"\n")), ElementsAre(HasSubstr("give a number, such as 0.05 or \"5 %\"")));
}

TEST(scene_faults, values_out_of_range_and_not_finite_are_refused) {
  EXPECT_THAT(faults(plate("depth = -2\n")),
              ElementsAre("s.toml:12: cells.depth: -2 is out of range; give a value > 0 m"));
  EXPECT_THAT(faults(plate("poisson = 0.6\n")),
              ElementsAre(HasSubstr("0.6 is out of range; give a value > -1 and <= 0.5")));
  EXPECT_THAT(faults(plate("depth = nan\n")), ElementsAre(HasSubstr("s.toml:12: cells.depth: nan is not finite")));
  EXPECT_THAT(faults(plate("depth = -inf\n")), ElementsAre(HasSubstr("-inf is not finite")));
  EXPECT_THAT(faults(plate("depth = \"inf m\"\n")), ElementsAre(HasSubstr("is not finite")));
  EXPECT_THAT(faults(plate("[gravity]\nacceleration = [0, nan]\n")),
              ElementsAre(HasSubstr("gravity.acceleration: nan is not finite")));
  EXPECT_THAT(faults("seed = -1\n" + plate("")), ElementsAre(HasSubstr("s.toml:1: seed: -1 is out of range")));
  EXPECT_THAT(faults(plate("[output]\nframes = 0\n")), ElementsAre(HasSubstr("give a value 1 to 100000")));
}

TEST(scene_faults, what_is_missing_is_named_with_a_way_out) {
  EXPECT_THAT(faults(""), ElementsAre(AllOf(StartsWith("s.toml:1: cells: missing"), HasSubstr("thickness"))));
  EXPECT_THAT(faults("[cells]\nyoung = 1\ndensity = 1\n[stop]\ntime = 1\n"),
              ElementsAre(HasSubstr("s.toml:1: cells.thickness: missing")));
  EXPECT_THAT(faults("[cells]\nthickness = 1\n[stop]\ntime = 1\n"),
              ElementsAre(HasSubstr("s.toml:1: cells.young: missing"),
                          HasSubstr("s.toml:1: cells.density: missing; without it nodes have no mass")));
  EXPECT_THAT(faults(tissue("")),
              ElementsAre(HasSubstr("sample.walls.spacing: missing"), HasSubstr("sample.sizes.mean: missing")));
  EXPECT_THAT(faults(plate("[links]\n")), ElementsAre("s.toml:12: links.normal_stiffness: missing; k_n. [N/m2]"));
  EXPECT_THAT(faults(plate("[gravity]\n")), ElementsAre(HasSubstr("gravity.acceleration: missing")));
  EXPECT_THAT(faults(plate("[loading]\nstrain = 1\n")), ElementsAre(HasSubstr("loading.strain_rate: missing")));
  EXPECT_THAT(faults(plate("[contact]\nfriction = 1\n[stop]\ntime = 1\n")),
              ElementsAre(HasSubstr("s.toml:12: contact.normal_stiffness: missing")));
  EXPECT_THAT(faults(plate("[run]\nthreads = 1\n")), ElementsAre(HasSubstr("stop: nothing ends the run")));
}

TEST(scene_faults, sizes_say_what_their_distribution_needs_and_no_more) {
  const std::string start = "walls.segments = 3\n";
  EXPECT_THAT(faults(tissue(start + "sizes.distribution = \"table\"\nsizes.table = [[\"1 um\", 1], [2e-6, 0]]\n")),
              ElementsAre());
  EXPECT_THAT(faults(tissue(start + "[[sample.sizes.mixture]]\nmean = 1\nshare = 1\n"
                                    "[sample.sizes]\ndistribution = \"mixture\"\n")),
              ElementsAre());
  EXPECT_THAT(faults(tissue(start + "sizes.distribution = \"table\"\n")),
              ElementsAre(HasSubstr("sample.sizes.table: missing")));
  EXPECT_THAT(faults(tissue(start + "sizes.distribution = \"mixture\"\nsizes.mean = 1\n")),
              ElementsAre(HasSubstr("sample.sizes.mixture: missing"),
                          HasSubstr("s.toml:7: sample.sizes.mean: follows from the mixture; remove it")));
  EXPECT_THAT(faults(tissue(start + "sizes.mean = 1\nsizes.table = [[1, 1], [2, 0]]\n")),
              ElementsAre(HasSubstr("s.toml:7: sample.sizes.table: contradicts distribution; use distribution = "
                                    "\"table\"")));
}

TEST(scene_faults, a_packing_has_the_sides_of_its_sample) {
  const std::string start = "walls.segments = 3\nsizes.mean = 1\n";
  EXPECT_THAT(faults(tissue(start + "periodic = \"x\"\n")), ElementsAre());
  EXPECT_THAT(faults(tissue(start + "periodic = \"x\"\npacking.boundary = \"periodic_x\"\n")), ElementsAre());
  EXPECT_THAT(faults(tissue(start + "periodic = \"xy\"\npacking.boundary = \"periodic\"\n")), ElementsAre());
  EXPECT_THAT(faults(tissue(start + "packing.boundary = \"periodic\"\n")), ElementsAre());
  for (const char* other : {"walls", "periodic", "periodic_y"})
    EXPECT_THAT(
        faults(tissue(start + "periodic = \"x\"\npacking.boundary = \"" + other + "\"\n")),
        ElementsAre(AllOf(HasSubstr("s.toml:8: sample.packing.boundary: "),
                          HasSubstr("contradicts sample.periodic = \"x\"; remove it, or give \"periodic_x\""))));
  EXPECT_THAT(faults(tissue(start + "domain = { kind = \"disk\", radius = 1 }\npacking.boundary = \"periodic\"\n")),
              ElementsAre(HasSubstr("sample.packing.boundary: contradicts sample.domain")));
}

TEST(scene_faults, two_ways_of_saying_one_thing_contradict_each_other) {
  EXPECT_THAT(faults(plate("axial_rigidity = 1\nbending_rigidity = 1\n")),
              ElementsAre("s.toml:12: cells.axial_rigidity: contradicts young; give one of them",
                          "s.toml:13: cells.bending_rigidity: contradicts young; give one of them"));
  EXPECT_THAT(faults(plate("mass_per_length = 1\n")), ElementsAre(HasSubstr("contradicts density")));
  EXPECT_THAT(faults(plate("break_strain = 0.1\nbreak_force = 1\n")),
              ElementsAre(HasSubstr("cells.break_strain: contradicts break_force")));
  EXPECT_THAT(faults(plate("break_stress = 1\nbreak_force = 1\n")),
              ElementsAre(HasSubstr("cells.break_force: contradicts break_stress")));
  EXPECT_THAT(faults(plate("break_force = -1\n")),
              ElementsAre(HasSubstr("s.toml:12: cells.break_force: -1 is out of range")));
  EXPECT_THAT(faults(plate("yield_stress = 1\nyield_moment = 1\n")),
              ElementsAre(HasSubstr("s.toml:13: cells.yield_moment: contradicts yield_stress")));
  EXPECT_THAT(faults(plate("core = { modulus = 1, stiffness_ratio = 1 }\n")),
              ElementsAre(HasSubstr("cells.core.stiffness_ratio: contradicts modulus")));
  EXPECT_THAT(faults(plate("core = { modulus = 1, drained = true }\n")),
              ElementsAre(HasSubstr("cells.core.drained: contradicts the modulus")));
  EXPECT_THAT(faults(plate("[loading]\nstrain_rate = 1\nspeed = 1\n")),
              ElementsAre(HasSubstr("s.toml:14: loading.speed: contradicts strain_rate")));
  EXPECT_THAT(faults(plate("[loading]\nspeed = 0\n")),
              ElementsAre(HasSubstr("s.toml:13: loading.speed: 0 is out of range; give a value > 0 m/s")));
  EXPECT_THAT(faults(plate("[loading]\nspeed = 1\nkind = \"shear\"\nnormal_only = true\n")),
              ElementsAre(HasSubstr("contradicts kind = \"shear\"")));
  EXPECT_THAT(faults(tissue("walls.segments = 3\nwalls.spacing = 1\nsizes.mean = 1\n")),
              ElementsAre(HasSubstr("sample.walls.segments: contradicts spacing")));
  EXPECT_THAT(faults(tissue("walls.segments = 3\nsizes.mean = 1\npacking.file = \"a.csv\"\n")),
              ElementsAre(HasSubstr("sample.sizes: contradicts packing.file")));
  EXPECT_THAT(faults(tissue("walls.segments = 3\nsizes.mean = 1\ncolumns = 4\n")),
              ElementsAre(HasSubstr("s.toml:7: sample.columns: belongs to kind = \"honeycomb\"")));
  EXPECT_THAT(faults(plate("[links]\nnormal_stiffness = 1\nnormal_strength = 1\n")),
              ElementsAre(HasSubstr("links.tangential_strength: missing; strengths come together")));
  EXPECT_THAT(faults(plate("[stop]\ntime = 1\nseparated = true\n")),
              ElementsAre(HasSubstr("s.toml:14: stop.separated: needs grips")));
  EXPECT_THAT(faults(plate("[stop]\ntime = 1\n[run]\ntime_step = 1\nstep_fraction = 0.5\n")),
              ElementsAre(HasSubstr("contradicts")));
}

TEST(scene_faults, a_cohesive_zone_needs_what_it_softens_from_and_to_and_a_brittle_link_takes_neither) {
  const std::string links = "[links]\nnormal_stiffness = 1\nnormal_strength = 1\ntangential_strength = 1\n";
  const auto zone = [&](const std::string& more) { return faults(plate(links + "law = \"cohesive_zone\"\n" + more)); };
  EXPECT_THAT(zone("toughness = 1\n"), ElementsAre());
  EXPECT_THAT(zone("toughness = 1\nshear_toughness = 2\nmixing = \"power\"\nmixing_exponent = 1\n"), ElementsAre());
  EXPECT_THAT(zone(""), ElementsAre(HasSubstr("s.toml:12: links.toughness: missing")));
  EXPECT_THAT(faults(plate("[links]\nnormal_stiffness = 1\nlaw = \"cohesive_zone\"\ntoughness = 1\n")),
              ElementsAre(HasSubstr("s.toml:12: links.normal_strength: missing; a cohesive zone softens from")));
  EXPECT_THAT(zone("toughness = -1\n"), ElementsAre(HasSubstr("s.toml:17: links.toughness: -1 is out of range")));
  EXPECT_THAT(zone("toughness = 0\n"), ElementsAre(HasSubstr("s.toml:17: links.toughness: 0 is out of range")));
  EXPECT_THAT(zone("toughness = nan\n"), ElementsAre(HasSubstr("s.toml:17: links.toughness: nan is not finite")));
  EXPECT_THAT(zone("toughness = \"1 N/m\"\n"), ElementsAre(HasSubstr("s.toml:17: links.toughness")));
  EXPECT_THAT(zone("toughness = 1\nshear_toughness = -1\n"),
              ElementsAre(HasSubstr("s.toml:18: links.shear_toughness")));
  EXPECT_THAT(zone("toughness = 1\nmixing = \"linear\"\n"),
              ElementsAre(AllOf(HasSubstr("s.toml:18: links.mixing"), HasSubstr("benzeggagh_kenane"))));
  EXPECT_THAT(zone("toughness = 1\nmixing_exponent = 0.5\n"),
              ElementsAre(HasSubstr("s.toml:18: links.mixing_exponent")));
  EXPECT_THAT(faults(plate(links + "law = \"ductile\"\n")),
              ElementsAre(AllOf(HasSubstr("s.toml:16: links.law"), HasSubstr("cohesive_zone"))));
  EXPECT_THAT(faults(plate(links + "toughness = 1\nmixing_exponent = 2\n")),
              ElementsAre(HasSubstr("s.toml:16: links.toughness: is used with law = \"cohesive_zone\" only"),
                          HasSubstr("s.toml:17: links.mixing_exponent: is used with law = \"cohesive_zone\" only")));
  EXPECT_THAT(faults(plate(links + "law = \"brittle\"\ntoughness = 1\n")), ElementsAre()) << "to compare";
  // A group may be brittle among links that are not.
  EXPECT_THAT(zone("toughness = 1\n[links.cells]\nlaw = \"brittle\"\n"), Not(Contains(HasSubstr("toughness"))));
}

TEST(scene_faults, a_selection_uses_exactly_one_way) {
  const auto load = [](const std::string& nodes) {
    return faults(plate("[stop]\ntime = 1\n[[loads]]\nname = \"a\"\nvelocity_x = 0\nnodes = " + nodes + "\n"));
  };
  EXPECT_THAT(load("{}"), ElementsAre(HasSubstr("s.toml:17: loads.a.nodes: selects nothing; give one of")));
  EXPECT_THAT(load("{ side = \"top\", cells = [1] }"), ElementsAre(HasSubstr("side, cells contradict each other")));
  EXPECT_THAT(load("{ side = \"up\" }"),
              ElementsAre(HasSubstr("\"up\" is not known; known: left, right, bottom, top")));
  EXPECT_THAT(load("{ cells = [] }"), ElementsAre(HasSubstr("give whole numbers")));
  EXPECT_THAT(load("{ nodes = [-1] }"), ElementsAre(HasSubstr("entry 0: -1 is out of range")));
  EXPECT_THAT(load("{ box = [1, 0, 0, 1] }"), ElementsAre(HasSubstr("the lower left corner comes first")));
  EXPECT_THAT(load("{ group = \"plat\" }"),
              ElementsAre(HasSubstr("s.toml:14: loads.a.nodes.group: the sample has no group \"plat\"")));
  EXPECT_THAT(load("\"top\""), ElementsAre(HasSubstr("is a string; it is a section of keys")));
}

TEST(scene_faults, a_load_must_do_one_thing_for_each_component) {
  const auto load = [](const std::string& keys) {
    return faults(plate("[stop]\ntime = 1\n[[loads]]\nname = \"a\"\nnodes = { side = \"top\" }\n" + keys));
  };
  EXPECT_THAT(load(""), ElementsAre(HasSubstr("loads.a: does nothing; give a velocity, force or line_force")));
  EXPECT_THAT(load("velocity_x = 0\nforce_x = 1\n"), ElementsAre(HasSubstr("loads.a.force_x: contradicts velocity_x")));
  EXPECT_THAT(load("velocity_x = 0\nforce_y = 1\n"), ElementsAre());
}

TEST(scene_faults, groups_are_those_of_the_sample) {
  EXPECT_THAT(faults(plate("[cells.plaet]\nyoung = 2\n")),
              ElementsAre("s.toml:12: cells.plaet: the sample has no group \"plaet\"; known: cells, core"));
  EXPECT_THAT(faults(plate("[cells.cor]\nmodulus = 2\n")),
              ElementsAre(HasSubstr("cells.cor: the sample has no group \"cor\"; did you mean \"core\"?"),
                          HasSubstr("cells.cor.modulus: unknown key")));
  EXPECT_THAT(faults(plate("[cells.cells]\nyoung = 2\n")),
              ElementsAre("s.toml:12: cells.cells: is [cells] itself; put its keys there"));
}

TEST(scene_faults, shapes_need_what_makes_them) {
  const auto shape = [](const std::string& keys) {
    return faults("[cells]\nthickness = 1\n[sample]\nkind = \"shapes\"\n[[sample.shapes]]\n" + keys);
  };
  EXPECT_THAT(shape("kind = \"ring\"\nsegments = 2\nsize = 1\n"),
              ElementsAre(HasSubstr("s.toml:7: sample.shapes[0].segments: a ring of fewer than 3 nodes")));
  EXPECT_THAT(shape("kind = \"polygon\"\npoints = [[0, 0], [1, 1]]\n"),
              ElementsAre(HasSubstr("has 2 points; give at least 3")));
  EXPECT_THAT(shape("kind = \"chain\"\nfrom = [1, 1]\nto = [1, 1]\nsegments = 2\n"),
              ElementsAre(HasSubstr("is the same point as from")));
  EXPECT_THAT(shape("kind = \"box\"\n").size(), 3u);
  EXPECT_THAT(faults("[cells]\nthickness = 1\n[sample]\nkind = \"shapes\"\n"),
              ElementsAre(HasSubstr("list at least one [[sample.shapes]]")));
}

TEST(scene_faults, velocities_at_the_start_state_something_of_some_nodes) {
  const auto initial = [](const std::string& keys) { return faults(plate("[stop]\ntime = 1\n[[initial]]\n" + keys)); };
  const std::string all = "nodes = { group = \"cells\" }\n";
  EXPECT_THAT(initial(all + "velocity_x = 1\n"), ElementsAre());
  EXPECT_THAT(initial(all + "spin = 1\ncentre = [0, 1]\n"), ElementsAre());
  EXPECT_THAT(initial(all), ElementsAre("s.toml:14: initial[0]: states nothing; give velocity_x, velocity_y or spin"));
  EXPECT_THAT(initial("velocity_x = 1\n"), ElementsAre(HasSubstr("s.toml:14: initial[0].nodes: missing")));
  EXPECT_THAT(initial(all + "velocity_y = 1\ncentre = [0, 1]\n"),
              ElementsAre(HasSubstr("s.toml:17: initial[0].centre: is that of a spin")));
  EXPECT_THAT(initial(all + "spin = \"1 m/s\"\n"), ElementsAre(HasSubstr("initial[0].spin: \"1 m/s\" is of another")));
  EXPECT_THAT(initial(all + "velocity_x = nan\n"), ElementsAre(HasSubstr("is not finite")));
  EXPECT_THAT(initial(all + "velosity_x = 1\n"), Contains(HasSubstr("did you mean \"velocity_x\"?")));
  EXPECT_THAT(initial("velocity_x = 1\nnodes = { group = \"cels\" }\n"),
              ElementsAre(HasSubstr("initial.nodes.group: the sample has no group \"cels\"")));
  EXPECT_THAT(faults("initial = 3\n" + plate("[stop]\ntime = 1\n")),
              ElementsAre(HasSubstr("s.toml:1: initial: is a whole number; velocities are a list: [[initial]]")));
}

TEST(scene_faults, stages_name_what_exists) {
  const std::string stages = plate("[stop]\ntime = 1\n[[stages]]\nname = \"settle\"\n[[stages]]\nname = \"pull\"\n");
  EXPECT_THAT(faults(stages), ElementsAre());
  EXPECT_THAT(faults(stages + "from = \"setle\"\n"),
              ElementsAre("s.toml:18: stages.pull.from: no earlier stage \"setle\"; did you mean \"settle\"?"));
  EXPECT_THAT(faults(stages + "remove = [\"gravty\", \"stop\"]\ngravity.acceleration = [0, 1]\nstop.time = 1\n"),
              ElementsAre(HasSubstr("s.toml:18: stages.pull.remove: nothing called \"gravty\" to remove here")));
  EXPECT_THAT(faults(stages + "remove = [\"stop\"]\n"),
              ElementsAre(HasSubstr("s.toml:16: stages.pull.stop: nothing ends the run")));
  EXPECT_THAT(faults(stages + "remove = \"loads.no\"\n"), ElementsAre(HasSubstr("nothing called \"loads.no\"")));
  EXPECT_THAT(faults(stages + "sample.kind = \"rings\"\n"), ElementsAre(HasSubstr("stages.pull.sample: unknown key")));
  EXPECT_THAT(faults(plate("[stop]\ntime = 1\n[[stages]]\n")), ElementsAre(HasSubstr("stages[0].name: missing")));
  EXPECT_THAT(faults(stages + "[[stages]]\nname = \"pull\"\n"),
              ElementsAre(HasSubstr("there is an earlier stage of this name")));
  EXPECT_THAT(faults("stages = []\n" + plate("")), ElementsAre(HasSubstr("stages: is empty")));
}

TEST(scene_faults, a_fault_that_several_stages_inherit_is_reported_once) {
  const std::string groups = "[cells]\nthickness = -1\n[cells.a]\ndepth = 1\n";
  EXPECT_THAT(faults(groups), ElementsAre(HasSubstr("s.toml:2: cells.thickness: -1 is out of range")));
  EXPECT_THAT(faults(plate("depth = -1\n[stop]\ntime = 1\n[[stages]]\nname = \"a\"\n[[stages]]\nname = \"b\"\n")),
              ElementsAre("s.toml:12: cells.depth: -1 is out of range; give a value > 0 m"));
}

TEST(scene_faults, all_faults_are_reported_at_once_in_the_order_of_lines) {
  EXPECT_THAT(
      faults("sed = 1\n" + plate("depth = 0\n[drag]\nrate = \"1 m\"\n")),
      ElementsAre(HasSubstr("s.toml:1: sed"), HasSubstr("s.toml:13: cells.depth"), HasSubstr("s.toml:15: drag.rate")));
}

TEST(scene_faults, a_setting_is_named_in_its_messages) {
  EXPECT_THAT(faults(plate(""), {"cells.depth=-1"}),
              ElementsAre("--set cells.depth=-1: cells.depth: -1 is out of range; give a value > 0 m"));
  EXPECT_THAT(faults(plate(""), {"cells.depht=1"}),
              ElementsAre(HasSubstr("--set cells.depht=1: cells.depht: unknown key; did you mean \"depth\"?")));
  EXPECT_THAT(faults(plate(""), {"cells"}), ElementsAre(HasSubstr("--set cells: not of the form key=value")));
  EXPECT_THAT(faults(plate(""), {"seed.x=1", "seed=1", "seed.y=2"}),
              ElementsAre(HasSubstr("\"seed\" is a whole number, not a section")));
  EXPECT_THAT(faults(plate(""), {"sample.shapes.4.segments=1"}), ElementsAre(HasSubstr("no entry \"4\" there")));
  EXPECT_THAT(faults(plate(""), {"sample.shapes.plate=1"}).size(), 1u);
  EXPECT_THAT(faults(plate(""), {"cells.depth=1\nx=2"}), ElementsAre(HasSubstr("cells.depth")));
}

TEST(scene_faults, text_that_is_not_toml_is_refused_with_its_line) {
  EXPECT_THAT(faults("[cells]\nthickness = = 1\n"), ElementsAre(StartsWith("s.toml:2: not TOML: ")));
  EXPECT_THAT(faults("a = 1\na = 2\n"), ElementsAre(StartsWith("s.toml:2: not TOML: ")));
  EXPECT_THAT(faults("[cells\n"), ElementsAre(StartsWith("s.toml:")));
  EXPECT_THAT(faults("\xff\xfe\x00 binary"), ElementsAre(StartsWith("s.toml:1: not TOML: ")));
  EXPECT_THAT(faults(std::string("\0\0\0\0", 4)), ElementsAre(StartsWith("s.toml:1: ")));
  EXPECT_THAT(faults("title = \"\xc3\x28\"\n"), ElementsAre(StartsWith("s.toml:1: not TOML: ")));
}

TEST(scene_faults, nesting_cannot_exhaust_the_stack) {
  std::string dots = "a", brackets, tables;
  for (int k = 0; k < 500'000; ++k) dots += ".a";
  for (int k = 0; k < 500'000; ++k) brackets += "[", tables += "{a=";
  EXPECT_THAT(faults(dots + " = 1\n"), ElementsAre(HasSubstr("s.toml:1: a key of more than")));
  EXPECT_THAT(faults("\n[" + dots + "]\n"), ElementsAre(HasSubstr("s.toml:2: a key of more than")));
  EXPECT_THAT(faults("a = " + brackets), ElementsAre(StartsWith("s.toml:1: ")));
  EXPECT_THAT(faults("a = " + tables), ElementsAre(StartsWith("s.toml:1: ")));
  EXPECT_THAT(faults(plate(""), {dots + "=1"}), ElementsAre(HasSubstr("nested too deep")));
  EXPECT_THAT(
      faults(
          "# ...................................................\ntitle = \".....................................\"\n" +
          plate("")),
      ElementsAre());
}

TEST(scene_faults, a_file_that_cannot_be_a_scene_is_a_data_error) {
  const auto folder = std::filesystem::temp_directory_path() / "lamella_scene_faults";
  std::filesystem::create_directories(folder);
  EXPECT_THROW(read_scene(folder / "absent.toml"), DataError);
  EXPECT_THROW(read_scene(folder), DataError);
  EXPECT_THROW(read_scene("/dev/null"), DataError);
  std::ofstream(folder / "empty.toml").close();
  EXPECT_THROW(read_scene(folder / "empty.toml"), SceneError);
  std::ofstream(folder / "huge.toml") << std::string(10'000'001, '\n');
  EXPECT_THROW(read_scene(folder / "huge.toml"), DataError);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace lamella
