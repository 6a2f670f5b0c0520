// What each pipeline models and holds in memory, and no more: its terms by name, and their bytes from the counts of its sample.
#include <gtest/gtest.h>

#include "generator/generate.h"
#include "simulator/model.h"

namespace lamella {
namespace {

struct Counts {
  std::size_t slots, nodes, links;  // slots: nodes and the two ghosts of each cell
};

/// Names and bytes of the terms, where bytes do not depend on how cells lie.
void expect_terms(const std::string& scene_file, const std::vector<std::string>& settings,
                  const std::vector<std::string>& names,
                  const std::map<std::string, std::function<std::size_t(const Counts&)>>& bytes) {
  const Scene scene = read_scene(LAMELLA_SOURCE_DIR "/pipelines/" + scene_file, settings);
  Notes notes;
  const Sample sample = generate(scene, notes);
  Field x(sample.nodes());
  for (Index i = 0; i < sample.nodes(); ++i) x.set(i, sample.x[i]);
  const auto model = build_model(sample, scene.stages.at(0), x);
  const Counts counts{static_cast<std::size_t>(sample.nodes() + 2 * sample.cells()),
                      static_cast<std::size_t>(sample.nodes()), sample.links.size()};
  std::vector<std::string> found;
  for (const Term* term : model->terms()) {
    found.push_back(term->name());
    if (const auto expected = bytes.find(term->name()); expected != bytes.end()) {
      EXPECT_EQ(term->bytes(), expected->second(counts)) << scene_file << ": " << term->name();
    }
  }
  EXPECT_EQ(found, names) << scene_file;
  EXPECT_FALSE(model->dashpots) << scene_file;
  // A bonded tissue pays no contact between glued walls: what is listed while all links hold is near junctions.
  if (model->contacts) {
    model->contacts->update_candidates(x);
    EXPECT_LE(model->contacts->active(), 0.1 * sample.nodes()) << scene_file;
  }
}

constexpr std::size_t kDouble = sizeof(double);

TEST(pipelines, elastic_tissues_hold_no_plastic_history) {
  // bars: stiffness, rest length; hinges: stiffness, rest angle, last angle in single precision
  const std::map<std::string, std::function<std::size_t(const Counts&)>> bytes = {
      {"bars", [](const Counts& n) { return 2 * kDouble * n.slots; }},
      {"hinges", [](const Counts& n) { return (2 * kDouble + sizeof(float)) * n.slots; }}};
  const std::vector<std::string> terms = {"bars", "hinges", "links", "contacts"};
  expect_terms("tensile_fracture/elastic.toml", {"sample.packing.count=40", "sample.packing.fraction=0.7"}, terms,
               bytes);
  expect_terms("tensile_fracture_polygons/elastic.toml", {}, terms, bytes);
}

TEST(pipelines, plastic_tissues_hold_yield_and_plastic_length_besides) {
  expect_terms("tensile_fracture/plastic.toml", {"sample.packing.count=40", "sample.packing.fraction=0.7"},
               {"bars", "hinges", "links", "contacts"},
               {{"bars", [](const Counts& n) { return 4 * kDouble * n.slots; }},
                {"hinges", [](const Counts& n) { return (3 * kDouble + sizeof(float)) * n.slots; }}});
}

TEST(pipelines, the_tissue_whose_speed_is_measured_rubs_nowhere) {
  expect_terms("performance/tissue.toml", {"sample.columns=4", "sample.rows=4"},
               {"bars", "hinges", "links", "contacts"},
               {{"bars", [](const Counts& n) { return 2 * kDouble * n.slots; }}});
}

}  // namespace
}  // namespace lamella
