// Links that soften: the term against its own energy, and the explicit step that tears them.
#include <cmath>
#include <numbers>

#include "generator/sample/errors.h"
#include "simulator/steppers/stable_time_step.h"
#include "tests/simulator/tissues.h"
#include "tests/support/samples.h"

namespace lamella {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// ---- the term --------------------------------------------------------------------------------------------------------

LinkParameters softening(const Sample& s, double strength, double toughness) {
  LinkParameters p;
  const std::size_t n = s.links.size();
  p.normal_stiffness.assign(n, 4.0), p.tangential_stiffness.assign(n, 1.5);
  p.normal_strength.assign(n, strength), p.tangential_strength.assign(n, 0.8 * strength);
  p.full_energy.assign(n, strength * strength / 8);
  p.normal_toughness.assign(n, toughness), p.tangential_toughness.assign(n, 1.5 * toughness);
  return p;
}

TEST(SofteningLinks, force_and_stiffness_are_derivatives_of_the_energy_in_every_state_of_damage) {
  const Sample s = two_bonded_squares(5, 0.1);
  const ShellLayout layout(s);
  // Links store about 4 (0.05)^2 / 2; the criterion lies at openings of about 0.02, the end at about 0.1.
  const auto make = [&] { return CohesiveLinks(layout, softening(s, 0.08, 0.0040)); };
  const auto moved = [&](double amplitude, double apart, unsigned seed) {
    Field x = shaken(s, amplitude, seed);
    for (Index i = s.cell_begin[1]; i < s.nodes(); ++i) x.add(i, {0.3 * apart, apart});
    return x;
  };
  int damaged = 0, growing = 0, whole = 0, pressed = 0;
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u})
    for (const double later : {-0.02, 0.0, 0.01, 0.04}) {
      CohesiveLinks links = make();
      links.commit(moved(0.02, 0.025, seed));
      if (links.broken() == static_cast<Index>(s.links.size())) continue;
      const Field x = moved(0.02, 0.025 + later, seed + (later > 0 ? 0 : 10));
      ArraySet before, after;
      links.add_output(x, before);
      for (Index l = 0; l < 6; ++l) {
        const double d = before.doubles("link_damage")[l];
        (d > 0 ? damaged : whole) += links.intact(l);
        pressed += d > 0 && before.doubles("link_force")[2 * l] < 0;
      }
      expect_consistent_derivatives(links, x, 1e-7, 2e-6);
      expect_balanced(links, x);
      const double spent = links.dissipated();
      CohesiveLinks moved_on = make();
      ArraySet history;
      links.save(history);
      moved_on.restore(history);
      moved_on.commit(x);
      growing += moved_on.dissipated() > spent;
    }
  EXPECT_GT(damaged, 20);
  EXPECT_GT(whole, 5);
  EXPECT_GT(growing, 5);
  EXPECT_GT(pressed, 3);
  // Straight from rest: the onset and the mode mix are found at x.
  expect_consistent_derivatives(make(), moved(0.02, 0.04, 6), 1e-7, 2e-6);
  expect_balanced(make(), moved(0.02, 0.04, 6));
}

TEST(SofteningLinks, a_link_pulled_apart_takes_the_energy_of_its_mode_mix_out_of_the_nodes_that_pull) {
  Sample s = two_bonded_squares(1);
  s.links.resize(1);
  const ShellLayout layout(s);
  const Vec2 n(0, 1), t(-1, 0);
  for (int degrees = 0; degrees <= 90; degrees += 15) {
    CohesiveLinks links(layout, softening(s, 1.0, 0.5));
    const Vec2 way = std::cos(degrees * kDegree) * n + std::sin(degrees * kDegree) * t;
    const double opening = 4.0 * std::pow(std::cos(degrees * kDegree), 2),
                 shear = 1.5 * std::pow(std::sin(degrees * kDegree), 2), B = shear / (opening + shear);
    const double toughness = 0.5 + 0.25 * B * B;  // Benzeggagh and Kenane, eta = 2
    const int steps = 20000;
    const double du = 3.0 / steps;
    Field x = field_of(s.x);
    double work = 0, pull_before = 0;
    for (int k = 1; k <= steps && links.broken() == 0; ++k) {
      for (Index i = 4; i < 8; ++i) x.add(i, du * way);
      Field f(s.nodes());
      links.add_force(x, f);
      Vec2 on_upper = Vec2::Zero();
      for (Index i = 4; i < 8; ++i) on_upper += f.at(i);
      const double pull = -on_upper.dot(way);
      work += 0.5 * du * (pull + pull_before);
      pull_before = pull;
      links.commit(x);
    }
    ASSERT_EQ(links.broken(), 1) << degrees;
    const Break& event = links.breaks().front();
    EXPECT_NEAR(event.energy, toughness, 1e-12) << degrees;
    EXPECT_NEAR(work, toughness, 1e-6 * toughness) << degrees;
    EXPECT_EQ(links.dissipated(), 0) << "booked with the break";
    const double expected = std::atan2(1.5 * std::sin(degrees * kDegree) / 0.8, 4.0 * std::cos(degrees * kDegree));
    EXPECT_NEAR(links.mode_mix_of(event), expected, 1e-9);
    EXPECT_EQ(force_of(links, x).cwiseAbs().maxCoeff(), 0);
  }
}

TEST(SofteningLinks, what_damage_dissipates_is_no_longer_stored) {
  const Sample s = two_bonded_squares(3);
  const ShellLayout layout(s);
  CohesiveLinks links(layout, softening(s, 0.08, 0.0040));
  Field x = field_of(s.x);
  for (Index i = s.cell_begin[1]; i < s.nodes(); ++i) x.y[i] += 0.04;
  const double potential = links.energy(x);
  links.commit(x);
  EXPECT_GT(links.dissipated(), 0.1 * potential);
  EXPECT_NEAR(links.energy(x) + links.dissipated(), potential, 1e-15);
  ArraySet frame;
  links.add_output(x, frame);
  double stored = 0;
  for (const double e : frame.doubles("link_energy")) stored += e;
  EXPECT_NEAR(stored, links.energy(x), 1e-15);
  for (const double zeta : frame.doubles("link_zeta")) EXPECT_NEAR(zeta, 4 * 0.04 / 0.08 - 1, 1e-12);
  // sigma: onset at 0.02, end at 2 * 0.004 / 0.08 = 0.1; force 0.08 (0.1 - 0.04) / 0.08
  for (int l = 0; l < 4; ++l) EXPECT_NEAR(frame.doubles("link_force")[2 * l], 0.06, 1e-12);
  for (const double d : frame.doubles("link_damage")) EXPECT_NEAR(d, 1 - 0.06 / 0.16, 1e-12);
  for (Index i = s.cell_begin[1]; i < s.nodes(); ++i) x.y[i] += 1;
  links.commit(x);
  ArraySet gone;
  links.add_output(x, gone);
  for (const double d : gone.doubles("link_damage")) EXPECT_EQ(d, 1);
}

TEST(SofteningLinks, a_link_without_toughness_breaks_as_a_brittle_one) {
  const Sample s = two_bonded_squares(6);
  const ShellLayout layout(s);
  Field x = shaken(s, 0.02, 3);
  for (Index i = s.cell_begin[1]; i < s.nodes(); ++i) x.add(i, {0.01, 0.005});
  LinkParameters without = softening(s, 0.07, 0.0), brittle = without;
  brittle.normal_toughness.clear(), brittle.tangential_toughness.clear();
  CohesiveLinks one(layout, without), other(layout, brittle);
  EXPECT_LT((force_of(one, x) - force_of(other, x)).cwiseAbs().maxCoeff(), 1e-15);
  one.commit(x), other.commit(x);
  ASSERT_GT(other.broken(), 0);
  ASSERT_LT(other.broken(), 7);
  ASSERT_EQ(one.breaks().size(), other.breaks().size());
  for (std::size_t k = 0; k < one.breaks().size(); ++k) {
    EXPECT_EQ(one.breaks()[k].link, other.breaks()[k].link);
    EXPECT_NEAR(one.breaks()[k].energy, other.breaks()[k].energy, 1e-16);
    EXPECT_EQ(one.mode_mix_of(one.breaks()[k]), other.mode_mix_of(other.breaks()[k]));
  }
}

TEST(SofteningLinks, brittle_links_have_no_arrays_of_it) {
  const Sample s = two_bonded_squares(3);
  const ShellLayout layout(s);
  LinkParameters p = softening(s, 0.08, 0.0040);
  const std::size_t with = CohesiveLinks(layout, p).bytes();
  p.normal_toughness.clear(), p.tangential_toughness.clear();
  CohesiveLinks brittle(layout, p);
  EXPECT_LT(brittle.bytes(), with);
  ArraySet frame, restart;
  brittle.add_output(field_of(s.x), frame);
  brittle.save(restart);
  for (const ArraySet* set : {&frame, &restart})
    for (const NamedArray& a : set->all()) EXPECT_EQ(a.name.find("damage"), std::string::npos) << a.name;
}

TEST(SofteningLinks, damage_is_not_forgotten_by_a_stage_whose_links_are_brittle) {
  const Sample s = two_bonded_squares(3);
  const ShellLayout layout(s);
  LinkParameters p = softening(s, 0.08, 0.0040);
  CohesiveLinks links(layout, p);
  ArraySet fresh, damaged;
  links.save(fresh);
  Field x = field_of(s.x);
  for (Index i = s.cell_begin[1]; i < s.nodes(); ++i) x.y[i] += 0.04;
  links.commit(x);
  links.save(damaged);
  p.normal_toughness.clear(), p.tangential_toughness.clear();
  CohesiveLinks brittle(layout, p);
  EXPECT_NO_THROW(brittle.restore(fresh));
  EXPECT_THROW(brittle.restore(damaged), SceneError);
}

// ---- the explicit step -----------------------------------------------------------------------------------------------

/// A strip of cells whose links soften, torn apart.
Stage tearing_stage(double toughness) {
  Stage stage;
  stage.cells["cells"] = cell_scene(40.0, 0.05, 1.0);
  LinkScene links = link_scene("length", 400.0, 150.0, 6.0);
  links.law = "cohesive_zone";
  links.toughness = toughness;
  links.shear_toughness = 1.6 * toughness;
  stage.links["links"] = links;
  stage.contact = ContactScene{};
  stage.contact->friction = 0.3;
  return stage;
}

struct Tearing {
  Tearing(const Sample& s, int rows, int columns, double speed, const Stage& stage, int threads = 1) {
    std::vector<Index> low, high;
    for (Index r = 0; r < rows; ++r) low.push_back(columns * r), high.push_back(columns * r + columns - 1);
    rig = std::make_unique<Rig>(
        s, stage, std::vector<Load>{moving_cells(s, low, {0, 0}), moving_cells(s, high, {speed, 0.3 * speed})},
        threads);
    rig->model->contacts->rebuild(rig->state.x);  // its first list knew of no links
  }
  std::unique_ptr<Rig> rig;
};

TEST(SofteningLinks, tearing_closes_the_ledger_and_falls_as_dt_squared) {
  const Sample s = hexagons(2, 3, 3, 0.05);
  for (const bool walls_break : {false, true}) {
    double worst[2];
    for (const int fine : {0, 1}) {
      Stage stage = tearing_stage(0.3);
      if (walls_break) stage.cells["cells"].break_force = 1.0;
      Tearing tearing(s, 2, 3, 0.3, stage);
      Rig& rig = *tearing.rig;
      const double dt = fine ? 5e-4 : 2e-3;
      double largest = 0, spent = 0, of_breaks = 0;
      int lost_its_frame = 0;  // and was cut while it still pulled
      worst[fine] = 0;
      for (int n = 0; n * dt < 10; ++n) {
        const double energy = rig.energy();
        const Measurement m = rig.stepper.measured_step(dt, dt, nullptr);
        const double out = energy + m.kinetic + m.works.fracture + m.works.friction;
        largest = std::max(largest, std::abs(m.works.loads));
        worst[fine] = std::max(worst[fine], std::abs(m.works.loads - out) / (largest + 1e-2));
        EXPECT_GE(m.works.fracture, spent - 1e-9);
        spent = m.works.fracture;
        for (const Break& b : rig.stepper.take_breaks()) {
          of_breaks += b.energy;
          lost_its_frame += b.f_n > 0;
        }
        for (const WallBreak& b : rig.stepper.take_wall_breaks()) of_breaks += b.energy;
      }
      EXPECT_GT(rig.model->links->dissipated(), 0);
      EXPECT_NEAR(spent, of_breaks + rig.model->links->dissipated(), 1e-3 * spent);  // but for the last step
      if (walls_break)
        EXPECT_GT(lost_its_frame, 0);
      else
        EXPECT_GT(rig.model->links->broken(), 2);
    }
    EXPECT_LT(worst[1], 2e-5) << walls_break;
    EXPECT_LT(worst[1], worst[0] / 4) << walls_break;  // dt^2 would give 16; friction and walls have their share
  }
}

TEST(SofteningLinks, a_damaged_link_that_loses_its_frame_leaves_nothing_out_of_the_ledger) {
  // Squares of one bar a side, drawn so wide that all bars along x break in the first step, and so far apart that links are damaged in it.
  const Sample s = two_bonded_squares(1, 0.1);
  Stage stage = tearing_stage(0.3);
  stage.contact.reset();
  stage.cells["cells"].break_strain = 0.05;
  Rig rig(s, stage);
  for (Index i = 0; i < s.nodes(); ++i)
    rig.state.x.set(i, {1.1 * s.x[i].x(), s.x[i].y() + (i < s.cell_begin[1] ? 0.0 : 0.05)});
  const double dt = 1e-4;
  double first = 0;
  for (int n = 0; n < 3; ++n) {
    const double energy = rig.energy();
    const Measurement m = rig.stepper.measured_step(dt, dt, nullptr);
    const double all = energy + m.kinetic + m.works.fracture;
    if (n == 0) first = all;
    EXPECT_NEAR(all, first, 1e-5 * first) << n;
  }
  EXPECT_EQ(rig.model->rupture->broken().count(), 4);
  const auto breaks = rig.stepper.take_breaks();
  ASSERT_EQ(breaks.size(), 2u);
  // All that they took from the nodes, with what damage had dissipated.
  const double end = 2 * 0.3 / 6.0, onset = 6.0 / 400, dissipated = 0.5 * 0.3 * (0.05 - onset) / (end - onset);
  for (const Break& b : breaks) {
    EXPECT_GT(b.f_n, 0);
    EXPECT_GT(b.energy, dissipated);
    EXPECT_NEAR(b.energy, dissipated + 0.5 * 0.5 * 6.0 * (end - 0.05) / (end - onset) * 0.05, 1e-4 * b.energy);
  }
}

TEST(SofteningLinks, free_cells_keep_momentum_and_angular_momentum_while_they_come_apart) {
  const Sample s = two_bonded_squares(4, 0.1);
  Stage stage = tearing_stage(0.3);
  stage.contact.reset();
  Rig rig(s, stage);
  for (Index i = 0; i < s.nodes(); ++i) rig.state.v.set(i, i < s.cell_begin[1] ? Vec2(0.3, -0.8) : Vec2(-0.5, 1.2));
  const auto momenta = [&] {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Index i = 0; i < s.nodes(); ++i) {
      const Vec2 p = rig.model->mass[i] * rig.state.v.at(i);
      sum += Eigen::Vector3d(p.x(), p.y(), cross(rig.state.x.at(i), p));
    }
    return sum;
  };
  const Eigen::Vector3d before = momenta();
  for (int n = 0; n < 4000 && rig.model->links->broken() < 5; ++n) rig.stepper.step(1e-3, 1e-3);
  EXPECT_EQ(rig.model->links->broken(), 5);
  EXPECT_LT((momenta() - before).norm(), 1e-12 * s.nodes());
}

TEST(SofteningLinks, the_explicit_step_commits_what_the_generic_commit_does) {
  const Sample s = hexagons(2, 3, 3, 0.05);
  const Stage stage = tearing_stage(0.3);
  Tearing tearing(s, 2, 3, 0.3, stage), other(s, 2, 3, 0.3, stage);
  const double dt = 1e-3;
  for (int n = 0; n < 2000; ++n) {
    if (n % 100 == 0) {  // the generic one sees every configuration that the sweep has passed
      const double difference = other.rig->model->links->dissipated() - tearing.rig->model->links->dissipated();
      EXPECT_LT(std::abs(difference), 1e-14);
    }
    const Field x = tearing.rig->state.x;
    tearing.rig->stepper.step(dt, dt);
    other.rig->model->links->commit(x);
  }
  EXPECT_GT(tearing.rig->model->links->dissipated(), 0);
  EXPECT_EQ(tearing.rig->model->links->intact(), other.rig->model->links->intact());
}

TEST(SofteningLinks, give_the_same_bits_on_one_and_three_threads) {
  const Sample s = hexagons(8, 30, 4, 0.05);  // more than one block
  std::vector<Field> results;
  std::vector<double> dissipated;
  for (const int threads : {1, 3}) {
    Tearing tearing(s, 8, 30, 2.0, tearing_stage(0.6), threads);
    for (int n = 0; n < 250; ++n) tearing.rig->stepper.step(2e-3, 2e-3);
    results.push_back(tearing.rig->state.x);
    dissipated.push_back(tearing.rig->model->links->dissipated());
    EXPECT_GT(tearing.rig->model->links->broken(), 0);
  }
  EXPECT_GT(dissipated[0], 0);
  EXPECT_EQ(dissipated[0], dissipated[1]);
  EXPECT_EQ(results[0].x, results[1].x);
  EXPECT_EQ(results[0].y, results[1].y);
}

TEST(SofteningLinks, continue_bit_for_bit_from_a_restart_amid_damage) {
  const Sample s = hexagons(2, 4, 3, 0.05);
  const Stage stage = tearing_stage(0.3);
  Tearing one(s, 2, 4, 0.3, stage), two(s, 2, 4, 0.3, stage);
  Rig &first = *one.rig, &second = *two.rig;
  const double dt = 2e-3;
  for (int n = 0; n < 10000 && first.model->links->broken() < 2; ++n) first.stepper.step(dt, dt);
  ASSERT_GE(first.model->links->broken(), 2);
  ASSERT_GT(first.model->links->dissipated(), 0);
  ArraySet restart;
  for (const Term* term : first.model->terms()) term->save(restart);
  first.stepper.save(restart);

  second.state = first.state;
  for (Term* term : second.model->terms()) term->restore(restart);
  second.stepper.restore(restart);
  first.model->contacts->rebuild(first.state.x), second.model->contacts->rebuild(second.state.x);
  const Index before = first.model->links->broken();
  first.stepper.take_breaks();
  for (int k = 0; k < 2000; ++k) first.stepper.step(dt, dt), second.stepper.step(dt, dt);
  EXPECT_GT(first.model->links->broken(), before);
  const auto breaks = first.stepper.take_breaks(), again = second.stepper.take_breaks();
  ASSERT_EQ(breaks.size(), again.size());
  double shear = 0;
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    EXPECT_EQ(breaks[k].energy, again[k].energy);
    EXPECT_EQ(first.model->links->mode_mix_of(breaks[k]), second.model->links->mode_mix_of(again[k]));
    shear += first.model->links->mode_mix_of(breaks[k]);
  }
  EXPECT_GT(shear, 0);
  EXPECT_EQ(first.state.x.x, second.state.x.x);
  EXPECT_EQ(first.state.x.y, second.state.x.y);
  EXPECT_EQ(first.state.v.x, second.state.v.x);
  EXPECT_EQ(first.stepper.measured_step(dt, dt, nullptr).works.fracture,
            second.stepper.measured_step(dt, dt, nullptr).works.fracture);
}

TEST(SofteningLinks, damage_does_not_lengthen_the_time_step) {
  // A link that is pressed again is as stiff as ever.
  const Sample s = two_bonded_squares(4);
  Stage stage = tearing_stage(0.3);
  stage.contact.reset();
  Rig rig(s, stage);
  const double whole = stable_time_step(*rig.model, rig.state.x, rig.stepper.fully_held()).dt;
  Field x = rig.state.x;
  for (Index i = s.cell_begin[1]; i < s.nodes(); ++i) x.y[i] += 0.08;
  rig.model->links->commit(x);
  ASSERT_GT(rig.model->links->dissipated(), 0);
  ASSERT_EQ(rig.model->links->broken(), 0);
  EXPECT_NEAR(stable_time_step(*rig.model, rig.state.x, rig.stepper.fully_held()).dt, whole, 1e-12 * whole);
}

TEST(SofteningLinks, take_toughness_per_length_of_wall_or_per_link_as_they_take_strength) {
  const Sample s = two_bonded_squares(4);
  for (const char* per : {"length", "link"}) {
    Stage stage = tearing_stage(0.3);
    stage.links["links"].per = per;
    const auto model = build_model(s, stage, field_of(s.x));
    Field x = field_of(s.x);
    for (Index i = s.cell_begin[1]; i < s.nodes(); ++i) x.y[i] += 1;
    model->links->commit(x);
    ASSERT_EQ(model->links->breaks().size(), 5u);
    for (const Break& b : model->links->breaks())
      EXPECT_NEAR(b.energy, 0.3 * (per == std::string("length") ? s.links[b.link].length : 1), 1e-12);
  }
}

TEST(SofteningLinks, too_little_toughness_is_refused_with_the_least_that_works) {
  const Sample s = two_bonded_squares(4);
  // 6^2 / (2 400) in opening, 6^2 / (2 150) in shear, against 0.01 and 0.016: shear needs 7.5 times as much.
  Stage stage = tearing_stage(0.01);
  std::string said;
  try {
    build_model(s, stage, field_of(s.x));
  } catch (const SceneError& error) {
    said = error.what();
  }
  EXPECT_NE(said.find("links.toughness: 0.01 J/m is too little"), std::string::npos) << said;
  const auto number_after = [&](const std::string& words) {
    const std::size_t at = said.find(words, said.find("give at least"));
    EXPECT_NE(at, std::string::npos) << words << " in " << said;
    return at == std::string::npos ? 0.0 : std::stod(said.substr(at + words.size()));
  };
  Stage tougher = stage;
  tougher.links["links"].toughness = number_after(" toughness = ");
  tougher.links["links"].shear_toughness = number_after("shear_toughness = ");
  EXPECT_NO_THROW(build_model(s, tougher, field_of(s.x)));
  EXPECT_LT(*tougher.links["links"].shear_toughness, 1.01 * 36 / 300);
  Stage weaker = stage;
  weaker.links["links"].normal_strength = number_after("normal_strength = ");
  weaker.links["links"].tangential_strength = number_after("tangential_strength = ");
  EXPECT_NO_THROW(build_model(s, weaker, field_of(s.x)));
}

}  // namespace
}  // namespace lamella
