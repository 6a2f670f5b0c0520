// Walls that break: when, what ends with a bar, and where its energy goes.
#include "generator/sample/broken_bars.h"
#include "generator/sample/errors.h"
#include "simulator/steppers/stable_time_step.h"
#include "tests/simulator/tissues.h"
#include "tests/support/samples.h"

namespace lamella {
namespace {

Load holding(const std::vector<Index>& nodes, const Vec2& velocity) {
  Load load;
  load.holds[0] = load.holds[1] = true;
  load.nodes = nodes;
  load.velocity = velocity;
  return load;
}

/// One bar of length 1 and k = 10, its end pulled at 0.01: the break, and the number of steps until then.
WallBreak pulled_bar(const CellScene& cell) {
  Stage stage;
  stage.cells["cells"] = cell;
  const Sample s = chain_sample(1);
  Rig rig(s, stage, {holding({0}, {0, 0}), holding({1}, {0.01, 0})});
  for (int n = 0; n < 100000; ++n) {
    rig.stepper.step(1e-3, 1e-3);
    const auto breaks = rig.stepper.take_wall_breaks();
    if (!breaks.empty()) return breaks.front();
  }
  ADD_FAILURE() << "nothing broke";
  return {};
}

TEST(Rupture, a_bar_breaks_at_the_force_that_the_scene_states_and_books_what_it_stored) {
  CellScene cell = cell_scene(10.0, 1.0, 1.0);
  cell.break_force = 0.5;
  const WallBreak by_force = pulled_bar(cell);
  EXPECT_GE(by_force.tension, 0.5);
  EXPECT_LE(by_force.tension, 0.5 + 10 * 0.01 * 1e-3 * (1 + 1e-9));  // k v dt
  EXPECT_NEAR(by_force.energy, 0.5 * by_force.tension * by_force.tension / 10, 1e-15);
  EXPECT_NEAR(by_force.position.x(), 0.5 * (1 + by_force.tension / 10), 1e-12);

  cell.break_force.reset();
  cell.break_stress = 0.5 / (cell.thickness * cell.depth);
  EXPECT_EQ(pulled_bar(cell).tension, by_force.tension);
}

TEST(Rupture, a_plastic_bar_breaks_at_the_strain_that_the_scene_states) {
  CellScene cell = cell_scene(10.0, 1.0, 1.0);
  cell.yield_force = 0.2, cell.yield_moment = 1.0;
  cell.break_strain = 0.05;
  const WallBreak event = pulled_bar(cell);
  EXPECT_EQ(event.tension, 0.2);
  EXPECT_NEAR(event.position.x(), 0.525, 1e-5);
  EXPECT_NEAR(event.energy, 0.5 * 0.2 * 0.2 / 10, 1e-15);
}

TEST(Rupture, a_strength_above_the_yield_force_is_refused) {
  const Sample s = chain_sample(2);
  Stage stage;
  stage.cells["cells"] = cell_scene(10.0, 1.0, 1.0);
  stage.cells["cells"].yield_force = 0.2, stage.cells["cells"].yield_moment = 1.0;
  stage.cells["cells"].break_force = 0.3;
  EXPECT_THROW(build_model(s, stage, field_of(s.x)), SceneError);
}

TEST(Rupture, walls_without_strength_have_nothing_of_it) {
  const Sample s = ring_sample(8);
  Stage stage;
  stage.cells["cells"] = cell_scene(10.0, 1.0, 1.0);
  EXPECT_EQ(build_model(s, stage, field_of(s.x))->rupture, nullptr);
}

/// A ring with a core of its own fluid under pressure, whose bars break where they are drawn to 1.3.
struct Burst {
  explicit Burst(bool drained) : sample(ring_sample(12)) {
    Stage stage;
    CellScene cell = cell_scene(20.0, 0.2, 1.0);
    cell.core.emplace();
    cell.core->pressure = 12;
    cell.core->drained = drained;
    if (!drained) cell.core->modulus = 8;
    cell.break_strain = 0.3;
    stage.cells["cells"] = cell;
    stage.contact = ContactScene{};
    stage.contact->normal_stiffness = 200;
    rig = std::make_unique<Rig>(sample, stage);
    rig->state.v.set(3, {0.3, -0.2});  // not the same for all bars
  }
  Vec2 momentum() const {
    Vec2 sum = Vec2::Zero();
    for (Index i = 0; i < sample.nodes(); ++i) sum += rig->model->mass[i] * rig->state.v.at(i);
    return sum;
  }
  Sample sample;
  std::unique_ptr<Rig> rig;
};

TEST(Rupture, a_burst_cell_has_no_core_and_keeps_its_momentum) {
  for (const bool drained : {false, true}) {
    Burst burst(drained);
    Rig& rig = *burst.rig;
    const Vec2 before = burst.momentum();
    const double dt = 1e-3;
    std::vector<WallBreak> breaks;
    for (int n = 0; n < 3000 && breaks.empty(); ++n) {
      rig.stepper.step(dt, dt);
      breaks = rig.stepper.take_wall_breaks();
    }
    ASSERT_FALSE(breaks.empty());
    EXPECT_TRUE(rig.model->rupture->broken().opened(0));
    EXPECT_FALSE(rig.model->core->present(0));
    Field f(burst.sample.nodes());
    rig.model->core->add_force(rig.state.x, f);
    for (Index i = 0; i < burst.sample.nodes(); ++i) EXPECT_EQ(f.at(i), Vec2(0, 0));
    // The hinges beside the bar are gone, the others are not.
    const Index bar = breaks.front().bar;
    for (const Index i : {bar, burst.sample.next(0, bar)})
      EXPECT_FALSE(rig.model->hinges->present(ShellLayout::slot(0, i)));
    EXPECT_EQ(breaks.front().pressure_work > 0, drained);
    EXPECT_GT(breaks.front().energy, 0);
    for (int n = 0; n < 500; ++n) rig.stepper.step(dt, dt);
    EXPECT_LT((burst.momentum() - before).norm(), 1e-12);
  }
}

/// Largest residual of the ledger over the largest energy while the ring bursts and its ends fly on, hit and rub.
double burst_residual(bool drained, double dt) {
  Burst burst(drained);
  Rig& rig = *burst.rig;
  double first = 0, largest = 0, worst = 0;
  for (int n = 0; n * dt < 1.5; ++n) {
    const double energy = rig.energy();
    const Measurement m = rig.stepper.measured_step(dt, dt, nullptr);
    const double all = energy + m.kinetic + m.works.fracture - m.works.pressure;
    if (n == 0) first = all;
    largest = std::max(largest, m.kinetic);
    worst = std::max(worst, std::abs(all - first));
  }
  EXPECT_GT(rig.model->rupture->broken().count(), 0);
  return worst / largest;
}

TEST(Rupture, the_ledger_closes_through_a_burst_and_falls_as_dt_squared) {
  for (const bool drained : {false, true}) {
    const double coarse = burst_residual(drained, 4e-3), fine = burst_residual(drained, 1e-3);
    EXPECT_LT(fine, 1e-4);
    EXPECT_LT(fine, coarse / 6);  // dt^2 would give 16; when bars break shifts by up to a step
  }
}

/// A strip of cells, links and walls of like strength, contact and friction, torn apart.
Stage tearing_stage(double link_strength) {
  Stage stage;
  stage.cells["cells"] = cell_scene(40.0, 0.05, 1.0);
  stage.cells["cells"].core.emplace();
  stage.cells["cells"].core->modulus = 5;
  stage.cells["cells"].break_force = 0.8;
  stage.links["links"] = link_scene("length", 400.0, 150.0, link_strength);
  stage.contact = ContactScene{};
  stage.contact->friction = 0.3;
  return stage;
}

struct Tearing {
  Tearing(const Sample& s, int rows, int columns, double speed, double link_strength, int threads) {
    std::vector<Index> low, high;
    for (Index r = 0; r < rows; ++r) low.push_back(columns * r), high.push_back(columns * r + columns - 1);
    rig = std::make_unique<Rig>(s, tearing_stage(link_strength),
                                std::vector<Load>{moving_cells(s, low, {0, 0}), moving_cells(s, high, {speed, 0})},
                                threads);
    rig->model->contacts->rebuild(rig->state.x);  // its first list knew of no links
  }
  std::unique_ptr<Rig> rig;
};

TEST(Rupture, cracks_through_walls_and_links_close_the_ledger) {
  const Sample s = hexagons(2, 3, 3, 0.05);
  double worst[2];
  for (const int fine : {0, 1}) {
    Tearing tearing(s, 2, 3, 0.3, 6.0, 1);
    Rig& rig = *tearing.rig;
    const double dt = fine ? 5e-4 : 2e-3;
    double largest = 0;
    worst[fine] = 0;
    for (int n = 0; n * dt < 8; ++n) {
      const double energy = rig.energy();
      const Measurement m = rig.stepper.measured_step(dt, dt, nullptr);
      const double out = energy + m.kinetic + m.works.fracture + m.works.friction;
      largest = std::max(largest, std::abs(m.works.loads));
      worst[fine] = std::max(worst[fine], std::abs(m.works.loads - out) / (largest + 1e-2));
    }
    EXPECT_GT(rig.model->rupture->broken().count(), 2);
    EXPECT_GT(rig.model->links->broken(), 2);
  }
  EXPECT_LT(worst[1], 2e-5);
  EXPECT_LT(worst[1], worst[0] / 4);  // dt^2 would give 16; friction has its share
}

TEST(Rupture, gives_the_same_bits_on_one_and_three_threads) {
  const Sample s = hexagons(8, 30, 4, 0.05);  // more than one block
  std::vector<Field> results;
  std::vector<Index> bars;
  for (const int threads : {1, 3}) {
    Tearing tearing(s, 8, 30, 2.0, 20.0, threads);
    for (int n = 0; n < 250; ++n) tearing.rig->stepper.step(2e-3, 2e-3);
    results.push_back(tearing.rig->state.x);
    bars.push_back(tearing.rig->model->rupture->broken().count());
  }
  EXPECT_GT(bars[0], 0);
  EXPECT_EQ(bars[0], bars[1]);
  EXPECT_EQ(results[0].x, results[1].x);
  EXPECT_EQ(results[0].y, results[1].y);
}

TEST(Rupture, continues_bit_for_bit_from_a_restart_behind_a_break) {
  const Sample s = hexagons(2, 4, 3, 0.05);
  Tearing one(s, 2, 4, 0.3, 7.0, 1), two(s, 2, 4, 0.3, 7.0, 1);
  Rig &first = *one.rig, &second = *two.rig;
  const double dt = 2e-3;
  int n = 0;
  while (first.model->rupture->broken().count() < 2 && n++ < 10000) first.stepper.step(dt, dt);
  ASSERT_GE(first.model->rupture->broken().count(), 2);
  for (int k = 0; k < 50; ++k) first.stepper.step(dt, dt);  // ends touch
  ArraySet restart;
  for (const Term* term : first.model->terms()) term->save(restart);
  first.model->rupture->save(restart);
  first.stepper.save(restart);

  second.state = first.state;
  second.model->rupture->restore(restart);
  second.model->links->follow(second.model->rupture->broken());
  for (Term* term : second.model->terms()) term->restore(restart);
  second.stepper.restore(restart);
  second.model->contacts->rebuild(second.state.x);
  const Index before = first.model->rupture->broken().count();
  for (int k = 0; k < 1500; ++k) first.stepper.step(dt, dt), second.stepper.step(dt, dt);
  EXPECT_GT(first.model->rupture->broken().count(), before);
  EXPECT_EQ(first.state.x.x, second.state.x.x);
  EXPECT_EQ(first.state.x.y, second.state.x.y);
  EXPECT_EQ(first.state.v.x, second.state.v.x);
}

TEST(Rupture, a_link_beside_a_broken_bar_keeps_to_the_bars_that_stand) {
  const Sample s = two_bonded_squares(4);
  const ShellLayout layout(s);
  LinkParameters p;
  p.normal_stiffness.assign(5, 3.0);
  p.tangential_stiffness.assign(5, 2.0);
  CohesiveLinks links(layout, p);
  BrokenBars broken(s);
  broken.add(0, s.links[1].a);  // between links 1 and 2
  EXPECT_TRUE(links.without_tangent(broken).empty());
  links.follow(broken);
  EXPECT_EQ(links.link(1).a_next, s.links[1].a);
  EXPECT_EQ(links.link(2).a_prev, s.links[2].a);
  EXPECT_EQ(links.link(1).b_prev, s.links[1].b_prev);
  expect_consistent_derivatives(links, shaken(s, 0.02), 1e-5, 1e-7);
  expect_balanced(links, shaken(s, 0.02));
  // Away from the bar nothing has changed; where it was, its far node does not matter.
  Field x = shaken(s, 0.02);
  const double energy = links.energy(x);
  EXPECT_NE(energy, CohesiveLinks(layout, p).energy(x));

  // The link at the wall's end has one bar on each side; without both it has no frame.
  broken.add(0, s.links[0].a);
  EXPECT_TRUE(links.without_tangent(broken).empty());
  broken.add(1, s.links[0].b_prev);
  EXPECT_EQ(links.without_tangent(broken), (std::vector<Index>{0}));
}

TEST(Rupture, contact_forgets_the_bar_and_meets_its_ends) {
  Sample s = ring_sample(12, 1, 0.05);
  const Vec2 middle = 0.5 * (s.x[0] + s.x[1]);
  add_cell(s, {1.03 * middle, 3 * middle}, false, 0.05, "cells");  // its first node presses the bar's middle
  ContactParameters p;
  p.node_stiffness.assign(s.nodes(), 1.0);
  p.node_mass.assign(s.nodes(), 1.0);
  Contacts contacts(s, p, field_of(s.x));
  const Field x = field_of(s.x);
  EXPECT_GT(contacts.energy(x), 0);
  BrokenBars broken(s);
  contacts.watch(broken);
  broken.add(0, 0);
  contacts.lose(0, x);
  EXPECT_EQ(contacts.energy(x), 0);
  // A node that presses an end of the gap from its open side.
  Field at_end = x;
  at_end.set(12, s.x[0] + 0.06 * (s.x[1] - s.x[0]).normalized());
  EXPECT_NEAR(contacts.energy(at_end), 0.5 * 0.04 * 0.04, 1e-12);  // a half from each of the two nodes
  // Both ends of the chain touch each other, as they did not while they were neighbours.
  Field closed = x;
  closed.set(0, s.x[1] + Vec2(0.03, -0.04));
  EXPECT_GT(contacts.energy(closed), 0);
}

TEST(BrokenBars, one_break_leaves_a_cell_in_one_piece_and_two_leave_two) {
  Sample s = ring_sample(6);
  add_cell(s, {{3, 0}, {4, 0}, {5, 0}}, false, 0.05, "cells");
  EXPECT_EQ(pieces_of(s, nullptr).count, 2);
  BrokenBars broken(s);
  broken.add(0, 1);
  EXPECT_EQ(pieces_of(s, &broken).count, 2);
  broken.add(0, 3);
  EXPECT_EQ(pieces_of(s, &broken).of_node, (std::vector<Index>{0, 0, 1, 1, 0, 0, 2, 2, 2}));
  broken.add(0, 5);
  broken.add(1, 6);
  EXPECT_EQ(pieces_of(s, &broken).of_node, (std::vector<Index>{0, 0, 1, 1, 2, 2, 3, 4, 4}));
  EXPECT_EQ(broken.opened_cells(s), 1);
}

}  // namespace
}  // namespace lamella
