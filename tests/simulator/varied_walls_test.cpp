// Factors on the thickness of walls and on the strength of links, beside groups that say the same in their sections.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "generator/sample/errors.h"
#include "simulator/model.h"
#include "tests/simulator/oracles.h"
#include "tests/simulator/tissues.h"
#include "tests/support/samples.h"

namespace lamella {
namespace {

using testing::HasSubstr;

CellScene wall(double thickness) {
  CellScene cell;
  cell.thickness = thickness;
  cell.depth = 0.7;
  cell.young = 1e6;
  cell.poisson = 0.3;
  cell.density = 1000;
  cell.yield_stress = 2e4;
  cell.break_stress = 1.9e4;
  cell.core.emplace();
  cell.core->stiffness_ratio = 0.5;
  return cell;
}

/// The second cell's walls are `factor` times as thick: by its group, or by the sample's factor.
Stage by_group(double factor) {
  Stage stage;
  stage.cells["cells"] = wall(0.1);
  stage.cells["thick"] = wall(0.1 * factor);
  return stage;
}

TEST(VariedThickness, is_that_of_a_group_with_such_walls) {
  const double factor = 1.7;
  Sample grouped = two_bonded_squares(), varied = grouped;
  grouped.group_names = {"cells", "thick"};
  grouped.group = {0, 1};
  varied.cell_thickness = {1, factor};
  const Stage stage = by_group(factor);
  const Field rest = field_of(grouped.x);
  const auto a = build_model(grouped, stage, rest), b = build_model(varied, stage, rest);
  ASSERT_EQ(a->mass.size(), b->mass.size());
  for (std::size_t i = 0; i < a->mass.size(); ++i) EXPECT_NEAR(a->mass[i], b->mass[i], 1e-14 * a->mass[i]);
  EXPECT_GT(b->mass.back(), 1.5 * b->mass.front());
  for (const double amplitude : {1e-4, 0.01, 0.04}) {  // elastic, then flowing
    const Field x = shaken(grouped, amplitude);
    EXPECT_NEAR(a->energy(x), b->energy(x), 1e-12 * a->energy(x)) << amplitude;
    for (const auto& [one, other] : {std::pair<Term*, Term*>{a->bars.get(), b->bars.get()},
                                     {a->hinges.get(), b->hinges.get()},
                                     {a->core.get(), b->core.get()}}) {
      const Eigen::VectorXd f = force_of(*one, x);
      EXPECT_LT((f - force_of(*other, x)).norm(), 1e-12 * f.norm());
      one->commit(x), other->commit(x);
    }
    EXPECT_EQ(a->plastic_dissipated() > 0, amplitude > 0.005);
    EXPECT_NEAR(a->plastic_dissipated(), b->plastic_dissipated(), 1e-12 * a->plastic_dissipated());
  }
}

TEST(VariedThickness, is_refused_beside_what_is_given_directly) {
  Sample sample = two_bonded_squares();
  sample.cell_thickness = {1, 2};
  for (const char* key : {"axial_rigidity", "mass_per_length", "yield_force", "yield_moment", "break_force"}) {
    Stage stage = by_group(1);
    CellScene& cell = stage.cells["cells"];
    const std::string name = key;
    if (name == "axial_rigidity") cell.young.reset(), cell.axial_rigidity = 1e4, cell.bending_rigidity = 1;
    if (name == "mass_per_length") cell.density.reset(), cell.mass_per_length = 1;
    if (name == "yield_force") cell.yield_stress.reset(), cell.yield_force = 1;
    if (name == "yield_moment") cell.yield_stress.reset(), cell.yield_moment = 1;
    if (name == "break_force") cell.break_stress.reset(), cell.break_force = 1;
    try {
      build_model(sample, stage, field_of(sample.x));
      ADD_FAILURE() << "no error for " << key;
    } catch (const SceneError& error) {
      EXPECT_THAT(error.what(), HasSubstr("cells." + name)) << key;
    }
  }
}

Stage linked(double strength, const char* law = "brittle") {
  Stage stage;
  stage.cells["cells"] = cell_scene(1, 1, 1);
  LinkScene links = link_scene("length", 100, 50, strength);
  links.tangential_strength = 0.6 * strength;
  links.law = law;
  if (links.law == "cohesive_zone") links.toughness = 0.1;
  stage.links["links"] = links;
  return stage;
}

TEST(VariedStrength, is_that_of_links_of_such_strength) {
  const double factor = 1.3;
  for (const char* law : {"brittle", "cohesive_zone"}) {
    Sample plain = two_bonded_squares(), varied = plain;
    varied.link_strength.assign(varied.links.size(), factor);
    const Field rest = field_of(plain.x);
    const auto a = build_model(plain, linked(factor * 2, law), rest), b = build_model(varied, linked(2, law), rest);
    for (const double opening : {0.01, 0.02, 0.024, 0.0275, 0.03, 0.05, 0.2}) {
      Field x = rest;
      for (Index i = plain.cell_begin[1]; i < plain.nodes(); ++i) x.add(i, {0.3 * opening, opening});
      a->links->commit(x), b->links->commit(x);
      EXPECT_EQ(a->links->broken(), b->links->broken()) << law << " " << opening;
      EXPECT_DOUBLE_EQ(a->links->energy(x), b->links->energy(x));
      EXPECT_DOUBLE_EQ(a->links->dissipated(), b->links->dissipated());
    }
    EXPECT_EQ(a->links->broken(), static_cast<Index>(plain.links.size()));
  }
}

TEST(VariedStrength, of_links_that_store_more_than_their_toughness_is_refused) {
  Sample sample = two_bonded_squares();
  const Field rest = field_of(sample.x);
  EXPECT_NO_THROW(build_model(sample, linked(3, "cohesive_zone"), rest));
  sample.link_strength.assign(sample.links.size(), 1);
  sample.link_strength.back() = 2;  // 6^2 / (2 100) > 0.1
  EXPECT_THROW(build_model(sample, linked(3, "cohesive_zone"), rest), SceneError);
}

}  // namespace
}  // namespace lamella
