// The explicit step: it computes what the terms say, within the stable limit, on any number of threads, and books every joule.
#include "generator/sample/errors.h"
#include "simulator/steppers/stable_time_step.h"
#include "tests/simulator/tissues.h"
#include "tests/support/samples.h"

namespace lamella {
namespace {

Stage bonded_stage() {
  Stage stage;
  stage.cells["cells"] = cell_scene(40.0, 0.05, 1.0);
  stage.links["links"] = link_scene("length", 80.0, 30.0, 2.0);
  return stage;
}

/// Largest eigenvalue of M^-1 K, for nodes that are free.
double largest_frequency_squared(const Model& model, const Field& x) {
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(2 * x.size(), 2 * x.size());
  for (const Term* term : model.terms()) k += stiffness_of(*term, x);
  Eigen::VectorXd scale(k.rows());
  for (int i = 0; i < k.rows(); ++i) scale[i] = std::sqrt(model.inverse_mass[i / 2]);
  k = scale.asDiagonal() * k * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

TEST(StableTimeStep, lies_below_the_true_limit_and_not_far_below) {
  const Sample tissue = hexagons(3, 3, 3, 0.05);
  Rig rig(tissue, bonded_stage());
  const double truth = 2 / std::sqrt(largest_frequency_squared(*rig.model, rig.state.x));
  const StableStep bound = stable_time_step(*rig.model, rig.state.x, rig.stepper.fully_held());
  EXPECT_LE(bound.dt, truth);
  EXPECT_GT(bound.dt, 0.7 * truth);
  EXPECT_NE(bound.limited_by.find('%'), std::string::npos);
}

TEST(StableTimeStep, is_exact_for_a_long_chain_of_bars) {
  Stage stage;
  stage.cells["cells"] = cell_scene(1.0, 0.0, 1.0);
  const Sample chain = chain_sample(40);
  Rig rig(chain, stage);  // k_s = 40, m = 1 / 40: dt_c = sqrt(m / k_s)
  EXPECT_NEAR(stable_time_step(*rig.model, rig.state.x, rig.stepper.fully_held()).dt, 1.0 / 40, 1e-6);
}

TEST(StableTimeStep, a_step_above_the_true_limit_blows_up_and_one_below_does_not) {
  const Sample tissue = hexagons(2, 2, 2, 0.05);
  Stage stage = bonded_stage();
  stage.links["links"].normal_strength.reset();
  for (const double fraction : {0.99, 1.02}) {
    Rig rig(tissue, stage);
    rig.state.x = shaken(tissue, 1e-6);
    const double dt = fraction * 2 / std::sqrt(largest_frequency_squared(*rig.model, rig.state.x));
    for (int n = 0; n < 2000; ++n) rig.stepper.step(dt, dt);
    EXPECT_EQ(rig.energy() < 1e-6, fraction < 1) << fraction;
  }
}

TEST(VelocityVerlet, one_step_from_rest_is_the_sum_of_the_terms) {
  const Sample tissue = hexagons(3, 4, 4, 0.05);
  Stage stage = bonded_stage();
  stage.links["links"].normal_strength.reset();
  stage.cells["cells"].core.emplace();
  stage.cells["cells"].core->modulus = 3.0;
  stage.gravity = GravityScene{{0.1, -0.2}};
  Rig rig(tissue, stage);
  rig.state.x = shaken(tissue, 0.01);
  Field f(tissue.nodes());
  for (const Term* term : rig.model->terms()) term->add_force(rig.state.x, f);
  const double dt = 1e-3;
  rig.stepper.step(dt, dt);
  double worst = 0, scale = 0;
  for (Index i = 0; i < tissue.nodes(); ++i) {
    worst = std::max(worst, (rig.state.v.at(i) - dt * f.at(i) * rig.model->inverse_mass[i]).norm());
    scale = std::max(scale, rig.state.v.at(i).norm());
  }
  EXPECT_LT(worst, 1e-13 * scale);
}

TEST(VelocityVerlet, gives_the_same_bits_on_one_two_and_three_threads) {
  const Sample tissue = hexagons(8, 30, 4, 0.05);  // more than one block
  Stage stage = bonded_stage();
  stage.drag = DragScene{0.1};
  std::vector<Field> results;
  std::vector<Index> broken;
  for (const int threads : {1, 2, 3}) {
    std::vector<Index> low, high;
    for (Index r = 0; r < 8; ++r) low.push_back(30 * r), high.push_back(30 * r + 29);
    Rig rig(tissue, stage, {moving_cells(tissue, low, {0, 0}), moving_cells(tissue, high, {6.0, 0})}, threads);
    for (int n = 0; n < 300; ++n) rig.stepper.step(2e-3, 2e-3);
    results.push_back(rig.state.x);
    broken.push_back(rig.model->links->broken());
  }
  EXPECT_GT(broken[0], 0);
  for (int k : {1, 2}) {
    EXPECT_EQ(broken[0], broken[k]);
    EXPECT_EQ(results[0].x, results[k].x);
    EXPECT_EQ(results[0].y, results[k].y);
  }
}

struct Rupture {
  double worst = 0, last = 0;  // ledger residual, relative to the largest work
  double taken_over = 0;       // by contact at the breaks, beyond what the links' own closing says [J]
};

/// Two bonded squares, torn apart: the bottom is held, the top moves at `velocity`.
Rupture rupture(const Stage& stage, const Vec2& velocity, double fraction) {
  static const Sample s = two_bonded_squares(4, 0.05);
  Load low, high;
  for (Load* load : {&low, &high}) load->holds[0] = load->holds[1] = true;
  for (Index i = 0; i < s.nodes(); ++i) {
    if (s.side[i] & kBottom) low.nodes.push_back(i);
    if (s.side[i] & kTop) high.nodes.push_back(i);
  }
  high.velocity = velocity;
  Rig rig(s, stage, {low, high});
  const double dt = fraction * 2 / std::sqrt(largest_frequency_squared(*rig.model, rig.state.x));
  double largest_work = 0;
  Rupture out;
  for (int n = 0; n < static_cast<int>(3.0 / dt); ++n) {
    const double energy = rig.energy();
    rig.loads[1].factor = smooth_ramp((n + 0.5) * dt / 0.5);
    const Measurement m = rig.stepper.measured_step(dt, dt, nullptr);
    const double booked = energy + m.kinetic + m.works.damping + m.works.fracture + m.works.plastic;
    largest_work = std::max(largest_work, std::abs(m.works.loads));
    out.last = std::abs(m.works.loads - booked) / (largest_work + 1e-300);
    if (n > 10) out.worst = std::max(out.worst, out.last);
    for (const Break& b : rig.stepper.take_breaks()) {
      const double length = s.links[b.link].length;
      const LinkScene& links = stage.links.at("links");
      out.taken_over +=
          0.5 * (b.f_n * b.f_n / links.normal_stiffness + b.f_t * b.f_t / links.tangential_stiffness) / length -
          b.energy;
    }
  }
  EXPECT_EQ(rig.model->links->broken(), 5);
  return out;
}

Rupture opened(double fraction, double drag) {
  Stage stage = bonded_stage();
  if (drag > 0) stage.drag = DragScene{drag};
  return rupture(stage, {0.05, 0.2}, fraction);
}

TEST(Ledger, closes_through_a_rupture_and_falls_as_dt_squared) {
  const double coarse = opened(0.6, 0).worst, fine = opened(0.15, 0).worst;
  EXPECT_LT(coarse, 1e-2);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, coarse / 8);  // dt^2 would give 16
}

TEST(Ledger, closes_where_contact_takes_over_walls_that_overlap_beside_the_link) {
  // A square slides along another, links break in shear, and both walls bend towards each other beside the middle link: when contact
  // takes over, it finds other overlaps than the links' own closing says.
  const Sample s = two_bonded_squares(4, 0.05);
  const double k_n = 80, k_t = 30, dt = 4e-4;
  Stage stage;
  stage.cells["cells"] = cell_scene(0.1, 1e-3, 1.0);
  stage.links["links"] = link_scene("length", k_n, k_t, 1e3);
  stage.links["links"].tangential_strength = 0.1 * k_t;  // at a slip of 0.1
  stage.contact = ContactScene{};
  Rig rig(s, stage);
  for (Index i = 0; i < s.nodes(); ++i) {
    const bool upper = i >= s.cell_begin[1];
    Vec2 x = s.x[i];
    const bool facing = upper ? x.y() < 1.06 : x.y() > 0.99, beside = std::abs(std::abs(x.x() - 0.5) - 0.25) < 0.01;
    if (facing && beside) x.y() += upper ? -0.0225 : 0.0225;
    if (upper) x += Vec2(0.08, 0.002), rig.state.v.set(i, {1.0, 0.0});
    rig.state.x.set(i, x);
  }
  rig.model->contacts->rebuild(rig.state.x);
  double first = 0, worst = 0, found = 0;
  for (int n = 0; n * dt < 0.05; ++n) {
    const double energy = rig.energy();
    const Measurement m = rig.stepper.measured_step(dt, dt, nullptr);
    const double all = energy + m.kinetic + m.works.fracture;
    if (n == 0) first = all;
    worst = std::max(worst, std::abs(all - first) / first);
    for (const Break& b : rig.stepper.take_breaks()) {
      const double length = s.links[b.link].length, opening = std::max(b.f_n, 0.0);
      const double expected = 0.5 * (opening * opening / k_n + b.f_t * b.f_t / k_t) / length;
      found += std::abs(b.energy - expected) / first;
    }
  }
  EXPECT_EQ(rig.model->links->broken(), 5);
  EXPECT_GT(found, 1e-3);
  EXPECT_LT(worst, 1e-6);
}

TEST(Ledger, closes_with_drag) { EXPECT_LT(opened(0.15, 0.5).worst, 1e-3); }

/// What a ring does to the ledger while one of its nodes is pulled away from the opposite one.
struct PulledRing {
  double residual = 0;  // largest, relative to the largest work
  double work = 0;      // largest [J]
  Works works;          // at the end [J]
};

PulledRing pull_ring(const Stage& stage, double step_fraction, double seconds) {
  const Sample s = ring_sample(20);
  Load left, right;
  for (Load* load : {&left, &right}) load->holds[0] = load->holds[1] = true;
  right.nodes = {0}, left.nodes = {10};
  right.velocity = {0.1, 0};
  Rig rig(s, stage, {left, right});
  const double dt = step_fraction * stable_time_step(*rig.model, rig.state.x, rig.stepper.fully_held()).dt;
  PulledRing out;
  for (int n = 0; n < static_cast<int>(seconds / dt); ++n) {
    const double energy = rig.energy();
    rig.loads[1].factor = smooth_ramp((n + 0.5) * dt / 0.3);
    const Measurement m = rig.stepper.measured_step(dt, dt, nullptr);
    out.works = m.works;
    out.work = std::max(out.work, std::abs(m.works.loads));
    const double open = m.works.loads - energy - m.kinetic - m.works.damping - m.works.plastic;
    if (n > 10) out.residual = std::max(out.residual, std::abs(open) / out.work);
  }
  return out;
}

TEST(Ledger, closes_with_plastic_walls) {
  Stage stage;
  stage.cells["cells"] = cell_scene(50.0, 1.0, 1.0);
  stage.cells["cells"].yield_moment = 0.05;
  stage.cells["cells"].yield_force = 2.0;
  stage.drag = DragScene{0.5};
  const PulledRing ring = pull_ring(stage, 0.2, 3.0);
  EXPECT_GT(ring.works.plastic, 0.3 * ring.work);
  EXPECT_LT(ring.residual, 1e-3);
}

TEST(Ledger, closes_with_dashpots_that_pull_on_a_moving_grip) {
  Stage stage;
  stage.cells["cells"] = cell_scene(50.0, 1.0, 1.0);
  stage.cells["cells"].bar_dashpot = 0.2;
  stage.cells["cells"].hinge_dashpot = 0.02;
  const PulledRing ring = pull_ring(stage, 0.1, 2.0);
  EXPECT_GT(ring.works.damping, 1e-3 * ring.work);
  EXPECT_LT(ring.residual, 1e-4);
}

TEST(Model, links_on_a_sample_without_any_are_refused) {
  const Sample s = ring_sample(8);
  Stage stage;
  stage.cells["cells"] = cell_scene(50.0, 1.0, 1.0);
  stage.links["links"] = link_scene("length", 1.0, 1.0);
  EXPECT_THROW(build_model(s, stage, field_of(s.x)), SceneError);
}

TEST(Model, an_elastic_scene_has_no_plastic_arrays_and_a_scene_without_links_none_of_theirs) {
  const Sample s = hexagons(2, 2, 2, 0.05);
  Stage stage;
  stage.cells["cells"] = cell_scene(50.0, 1.0, 1.0);
  const Field x = field_of(s.x);
  const auto bare = build_model(s, stage, x);
  EXPECT_EQ(bare->terms().size(), 2u);
  ArraySet frame;
  for (const Term* term : bare->terms()) term->add_output(x, frame);
  std::vector<std::string> names;
  for (const auto& a : frame.all()) names.push_back(a.name);
  EXPECT_EQ(names, (std::vector<std::string>{"axial_force", "bar_energy", "moment", "hinge_energy"}));
  stage.links["links"] = link_scene("length", 1.0, 1.0);
  const auto bonded = build_model(s, stage, x);
  EXPECT_EQ(bonded->terms().size(), 3u);
  EXPECT_GT(bonded->bytes(), bare->bytes());
}

}  // namespace
}  // namespace lamella
