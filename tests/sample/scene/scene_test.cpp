#include "generator/sample/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

using testing::ElementsAre;

Scene fixture(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return read_scene(LAMELLA_SOURCE_DIR "/tests/sample/scene/scenes/" + name, overrides);
}

const std::string kPlate = R"([sample]
kind = "shapes"
[[sample.shapes]]
kind = "plate"
group = "plate"
from = [0, 0]
to = [1, 0]
segments = 2
[cells]
thickness = 0.1
young = 1e6
density = 1000
)";

TEST(scene, a_tissue_pull_reads_in_si) {
  const Scene scene = fixture("tissue_pull.toml");
  EXPECT_EQ(scene.title, "Pull a tissue apart");
  EXPECT_EQ(scene.seed, 3u);
  EXPECT_EQ(scene.sample.kind, "tissue");
  EXPECT_DOUBLE_EQ(scene.sample.sizes.mean, 25e-6);
  EXPECT_DOUBLE_EQ(scene.sample.sizes.cv, 0.08);
  EXPECT_EQ(scene.sample.packing.count, 400);
  EXPECT_EQ(scene.sample.walls.segments, 6);
  ASSERT_TRUE(scene.sample.notch);
  ASSERT_EQ(scene.sample.notch->line.size(), 2u);
  EXPECT_TRUE(scene.sample.notch->line[1].isApprox(Vec2(60e-6, 400e-6)));
  ASSERT_EQ(scene.stages.size(), 1u);
  const Stage& stage = scene.stages[0];
  const CellScene& cell = stage.cell("cells");
  EXPECT_DOUBLE_EQ(*cell.young, 1e8);
  EXPECT_DOUBLE_EQ(*cell.core->stiffness_ratio, 100);
  EXPECT_FALSE(cell.core->modulus);
  const LinkScene& link = stage.links.at("links");
  EXPECT_DOUBLE_EQ(link.normal_stiffness, 2e12);
  EXPECT_DOUBLE_EQ(link.tangential_stiffness, 2e11);
  EXPECT_DOUBLE_EQ(*link.tangential_strength, 2000);
  EXPECT_DOUBLE_EQ(stage.contact->friction, 0.3);
  EXPECT_DOUBLE_EQ(*stage.loading->strain_rate, 200);
  EXPECT_DOUBLE_EQ(stage.loading->ramp_strain, 0.01);
  EXPECT_TRUE(stage.stop.separated);
  EXPECT_DOUBLE_EQ(*stage.stop.stress_drop, 0.1);
  EXPECT_EQ(stage.output.frames, 60);
  EXPECT_FALSE(stage.gravity);
}

TEST(scene, stages_change_what_they_continue) {
  const Scene scene = fixture("settle_then_press.toml");
  ASSERT_EQ(scene.stages.size(), 3u);
  const Stage &settle = scene.stages[0], &press = scene.stages[1], &faster = scene.stages[2];
  EXPECT_DOUBLE_EQ(settle.gravity->acceleration.y(), -9.81);
  EXPECT_DOUBLE_EQ(*settle.stop.at_rest, 1e-3);
  EXPECT_DOUBLE_EQ(*settle.stop.time, 60);
  EXPECT_DOUBLE_EQ(*settle.cell("cells").core->modulus, 1e4);

  EXPECT_FALSE(press.gravity);
  EXPECT_FALSE(press.stop.at_rest);
  EXPECT_DOUBLE_EQ(*press.stop.time, 0.1);
  EXPECT_DOUBLE_EQ(press.drag->rate, 5);
  EXPECT_DOUBLE_EQ(*press.cell("cells").core->modulus, 2e4);
  ASSERT_EQ(press.loads.size(), 2u);
  EXPECT_EQ(press.loads[0].name, "vessel");
  EXPECT_DOUBLE_EQ(*press.loads[1].velocity_y, -0.01);
  EXPECT_DOUBLE_EQ(*press.loads[1].velocity_x, 0);
  EXPECT_EQ(press.loads[1].nodes.group, "piston");

  EXPECT_EQ(faster.from, "settle");
  ASSERT_EQ(faster.loads.size(), 1u);
  EXPECT_DOUBLE_EQ(*faster.loads[0].velocity_y, 0);
  EXPECT_DOUBLE_EQ(*faster.cell("cells").core->modulus, 1e4);
  EXPECT_DOUBLE_EQ(*faster.stop.time, 0.05);
}

TEST(scene, a_group_inherits_what_it_does_not_set) {
  const Stage stage = fixture("settle_then_press.toml").stages[0];
  const CellScene &vessel = stage.cell("vessel"), &piston = stage.cell("piston");
  EXPECT_DOUBLE_EQ(vessel.thickness, 1e-5);
  EXPECT_DOUBLE_EQ(*vessel.density, 1000);
  EXPECT_DOUBLE_EQ(vessel.axial(), 1);
  EXPECT_FALSE(vessel.young) << "a group's rigidities replace the modulus that it would inherit";
  EXPECT_EQ(&piston, &stage.cell("cells"));
}

TEST(scene, settings_override_and_make_sections) {
  const Scene scene = fixture("tissue_pull.toml",
                              {"seed=9", "loading.speed=1 mm/s", "sample.kind=rings", "gravity.acceleration=[0, -1]",
                               "links.normal_strength=\"3 kN/m\"", "run.threads = 2"});
  EXPECT_EQ(scene.seed, 9u);
  EXPECT_EQ(scene.sample.kind, "rings");
  EXPECT_FALSE(scene.stages[0].loading->strain_rate);
  EXPECT_DOUBLE_EQ(*scene.stages[0].loading->speed, 1e-3);
  EXPECT_DOUBLE_EQ(scene.stages[0].gravity->acceleration.y(), -1);
  EXPECT_DOUBLE_EQ(*scene.stages[0].links.at("links").normal_strength, 3000);
  EXPECT_EQ(scene.stages[0].run.threads, 2);
  EXPECT_EQ(scene.overrides.size(), 6u);
}

TEST(scene, settings_reach_entries_by_name_and_by_number) {
  const Scene scene = fixture("settle_then_press.toml",
                              {"loads.piston.velocity_x=2", "stages.settle.stop.time=5", "sample.shapes.0.segments=7"});
  EXPECT_DOUBLE_EQ(*scene.stages[0].loads[1].velocity_x, 2);
  EXPECT_DOUBLE_EQ(*scene.stages[0].stop.time, 5);
  EXPECT_EQ(scene.sample.shapes[0].segments, 7);
}

TEST(scene, an_absent_section_leaves_nothing) {
  const Stage stage = parse_scene(kPlate).stages.at(0);
  EXPECT_TRUE(stage.links.empty());
  EXPECT_TRUE(stage.loads.empty());
  EXPECT_FALSE(stage.contact || stage.gravity || stage.drag || stage.loading || stage.cell("plate").core);
}

TEST(scene, a_scene_without_sample_takes_it_from_a_file) {
  const Scene scene = parse_scene("[cells]\nthickness = 1\nyoung = 1\ndensity = 1\n[stop]\ntime = 1\n");
  EXPECT_EQ(scene.sample.kind, "");
}

TEST(scene, every_way_of_selecting_nodes_reads) {
  const auto selection = [](const std::string& nodes) {
    return parse_scene(kPlate + "[stop]\ntime = 1\n[[loads]]\nname = \"a\"\nvelocity_x = 0\nnodes = " + nodes)
        .stages[0]
        .loads[0]
        .nodes;
  };
  EXPECT_EQ(selection(R"({ side = "top" })").side, "top");
  EXPECT_EQ(selection(R"({ group = "plate" })").group, "plate");
  EXPECT_THAT(selection("{ cells = [0, 3] }").cells, ElementsAre(0, 3));
  EXPECT_THAT(selection("{ nodes = [7] }").nodes, ElementsAre(7));
  const Selection end = selection(R"({ end = "clamp_start", group = "plate" })");
  EXPECT_EQ(end.end + end.group, "clamp_startplate");
  EXPECT_DOUBLE_EQ(selection(R"({ box = [0, "1 mm", 2, 3] })").box->lo.y(), 1e-3);
}

TEST(scene, per_link_values_have_other_units) {
  const auto links = [](const std::string& text) {
    return parse_scene(kPlate + "[links]\n" + text).stages[0].links.at("links");
  };
  EXPECT_DOUBLE_EQ(links("per = \"link\"\nnormal_stiffness = \"2 N/mm\"").normal_stiffness, 2000);
  EXPECT_DOUBLE_EQ(links("normal_stiffness = \"2 N/mm2\"").normal_stiffness, 2e6);
  EXPECT_THROW(links("per = \"link\"\nnormal_stiffness = \"2 N/mm2\""), SceneError);
  const std::string zone =
      "law = \"cohesive_zone\"\nnormal_strength = 1\ntangential_strength = 1\nnormal_stiffness = 1\n";
  EXPECT_DOUBLE_EQ(*links(zone + "toughness = \"3 uJ/mm\"").toughness, 3e-3);
  EXPECT_DOUBLE_EQ(*links(zone + "per = \"link\"\ntoughness = \"3 uJ\"").toughness, 3e-6);
  EXPECT_THROW(links(zone + "per = \"link\"\ntoughness = \"3 uJ/mm\""), SceneError);
}

TEST(scene, stiffness_and_yield_follow_from_material_and_section) {
  CellScene cell;
  cell.thickness = 0.02, cell.depth = 3, cell.young = 5e6, cell.poisson = 0.25, cell.yield_stress = 1e4,
  cell.density = 100;
  const double modulus = 5e6 / (1 - 0.0625), flow = 2e4 / std::sqrt(3.0);
  EXPECT_DOUBLE_EQ(cell.plane_modulus(), modulus);
  EXPECT_DOUBLE_EQ(cell.axial(), modulus * 0.06);
  EXPECT_DOUBLE_EQ(cell.bending(), modulus * 3 * 8e-6 / 12);
  EXPECT_DOUBLE_EQ(*cell.bar_yield(), flow * 0.06);
  EXPECT_DOUBLE_EQ(*cell.hinge_yield(), flow * 3 * 4e-4 / 4);
  EXPECT_DOUBLE_EQ(cell.line_density(), 6);
  EXPECT_DOUBLE_EQ(cell.outline_radius(), 0.01);
  cell.plane = "stress";
  EXPECT_DOUBLE_EQ(cell.plane_modulus(), 5e6);
  EXPECT_DOUBLE_EQ(*cell.bar_yield(), 1e4 * 0.06);
  EXPECT_FALSE(CellScene{}.bar_yield());
  EXPECT_THROW(CellScene{}.axial(), SceneError);
}

TEST(scene, velocities_at_the_start_belong_to_the_stage_in_which_they_stand) {
  const std::string all = "nodes = { group = \"plate\" }\n";
  const Scene scene = parse_scene(kPlate + "[stop]\ntime = 1\n[[initial]]\nvelocity_x = \"3 mm/s\"\n" + all +
                                      "[[stages]]\nname = \"shot\"\n[[stages]]\nname = \"flight\"\n"
                                      "[[stages]]\nname = \"second shot\"\n[[stages.initial]]\nspin = \"1 rad/s\"\n" +
                                      all + "[[stages]]\nname = \"again\"\nfrom = \"shot\"\n",
                                  "s.toml", {"initial.0.velocity_y=2"});
  ASSERT_EQ(scene.stages.size(), 4u);
  ASSERT_EQ(scene.stages[0].initial.size(), 1u);
  EXPECT_DOUBLE_EQ(*scene.stages[0].initial[0].velocity_x, 3e-3);
  EXPECT_DOUBLE_EQ(*scene.stages[0].initial[0].velocity_y, 2);
  EXPECT_EQ(scene.stages[0].initial[0].nodes.group, "plate");
  EXPECT_TRUE(scene.stages[1].initial.empty());
  ASSERT_EQ(scene.stages[2].initial.size(), 1u);
  EXPECT_FALSE(scene.stages[2].initial[0].velocity_x);
  EXPECT_DOUBLE_EQ(*scene.stages[2].initial[0].spin, 1);
  EXPECT_TRUE(scene.stages[3].initial.empty());
}

TEST(scene, files_named_inside_start_at_the_folder_of_the_scene) {
  Scene scene;
  scene.path = "/somewhere/study/scene.toml";
  EXPECT_EQ(scene.resolve("disks.csv"), "/somewhere/study/disks.csv");
  EXPECT_EQ(scene.resolve("/data/disks.csv"), "/data/disks.csv");
}

TEST(scene, a_slowdown_stretches_all_that_is_prescribed_in_time) {
  const std::string text = kPlate + R"([cells.core]
drained = true
pressure_history = [[0, 0], [2, 5]]
[[loads]]
name = "push"
nodes = { group = "plate" }
velocity_x = 0
velocity_y = 6
ramp = 0.5
[stop]
time = 4
[drag]
rate = 7
)";
  const Stage stage = parse_scene(text, "scene", {"run.slowdown=2"}).stages.at(0);
  EXPECT_DOUBLE_EQ(*stage.loads[0].velocity_y, 3);
  EXPECT_DOUBLE_EQ(stage.loads[0].ramp, 1);
  EXPECT_DOUBLE_EQ(*stage.stop.time, 8);
  EXPECT_DOUBLE_EQ(stage.cell("cells").core->pressure_history[1].x(), 4);
  EXPECT_DOUBLE_EQ(stage.drag->rate, 7);  // the material stays as it is
  const Scene pull = fixture("tissue_pull.toml", {"run.slowdown=4"});
  EXPECT_DOUBLE_EQ(*pull.stages[0].loading->strain_rate, 50);
  EXPECT_DOUBLE_EQ(pull.stages[0].loading->ramp_strain, 0.01);
}

}  // namespace
}  // namespace lamella
