// One pass of each term over the tissue of pipelines/performance/tissue.toml, as the stepper's sweep makes it, block by block.
#include <benchmark/benchmark.h>

#include "generator/generate.h"
#include "simulator/model.h"

namespace lamella {
namespace {

struct Tissue {
  Scene scene = read_scene(LAMELLA_SOURCE_DIR "/pipelines/performance/tissue.toml");
  Notes notes;
  Sample sample = generate(scene, notes);
  Field x = positions(sample), v = Field(sample.nodes()), f = Field(sample.nodes());
  std::unique_ptr<Model> model = build_model(sample, scene.stages.front(), x);

  static Field positions(const Sample& s) {
    Field x(s.nodes());
    for (Index i = 0; i < s.nodes(); ++i) x.set(i, s.x[i]);
    return x;
  }
};

Tissue& tissue() {
  static Tissue t;
  return t;
}

/// Time of a pass over the mass points; `visit(block index)` is one block's share.
template <class Visit>
void pass_over_blocks(benchmark::State& state, Visit visit) {
  const Index blocks = static_cast<Index>(tissue().model->layout.blocks().size());
  for (auto _ : state)
    for (Index b = 0; b < blocks; ++b) visit(b);
  benchmark::DoNotOptimize(tissue().f.x.data());
  state.SetItemsProcessed(state.iterations() * tissue().sample.nodes());
}

void geometry_of_segments(benchmark::State& state) {
  Tissue& t = tissue();
  ShellScratch scratch(t.model->layout);
  pass_over_blocks(state, [&](Index b) {
    scratch.load(t.sample, t.model->layout.blocks()[b], t.x);
    scratch.add_section_forces(t.sample, t.f);
  });
}

void shell_term(benchmark::State& state, const ShellTerm& term) {
  Tissue& t = tissue();
  ShellScratch scratch(t.model->layout);
  scratch.load(t.sample, t.model->layout.blocks().front(), t.x);
  pass_over_blocks(state, [&](Index) { term.add_to_block(scratch, t.f); });
}

void bars(benchmark::State& state) { shell_term(state, *tissue().model->bars); }
void hinges(benchmark::State& state) { shell_term(state, *tissue().model->hinges); }

void core(benchmark::State& state) {
  const Sample& s = tissue().sample;
  const std::vector<double> one(s.cells(), 1.0);
  const Core term(tissue().model->layout, {one, one, one});
  shell_term(state, term);
}

void links(benchmark::State& state) {
  Tissue& t = tissue();
  const CohesiveLinks& links = *t.model->links;
  LinkForces forces;
  pass_over_blocks(state, [&](Index b) {
    const Index first = links.begin(b), last = links.end(b);
    links.evaluate(t.x, first, last, forces);
    links.combine(first, last, forces);
    links.scatter(forces, first, last, t.f);
  });
}

void contacts_of_a_bonded_tissue(benchmark::State& state) {
  Tissue& t = tissue();
  Contacts& contacts = *t.model->contacts;
  contacts.update_candidates(t.x);
  Field unused;
  for (auto _ : state) {
    contacts.evaluate(t.x, t.v, 0, contacts.active());
    contacts.scatter(t.f, unused);
  }
  state.SetItemsProcessed(state.iterations() * t.sample.nodes());
}

BENCHMARK(geometry_of_segments);
BENCHMARK(bars);
BENCHMARK(hinges);
BENCHMARK(core);
BENCHMARK(links);
BENCHMARK(contacts_of_a_bonded_tissue);

}  // namespace
}  // namespace lamella
