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

/// Largest ledger residual, relative to the largest work, while two bonded squares are torn apart; and its last value.
std::pair<double, double> residual_of_a_rupture(double fraction, double drag) {
  static const Sample s = two_bonded_squares(4, 0.05);
  Stage stage = bonded_stage();
  if (drag > 0) stage.drag = DragScene{drag};
  Load low, high;
  for (Load* load : {&low, &high}) load->holds[0] = load->holds[1] = true;
  for (Index i = 0; i < s.nodes(); ++i) {
    if (s.side[i] & kBottom) low.nodes.push_back(i);
    if (s.side[i] & kTop) high.nodes.push_back(i);
  }
  high.velocity = {0.05, 0.2};
  Rig rig(s, stage, {low, high});
  const double dt = fraction * 2 / std::sqrt(largest_frequency_squared(*rig.model, rig.state.x));
  double largest_work = 0, worst = 0, last = 0;
  for (int n = 0; n < static_cast<int>(3.0 / dt); ++n) {
    const double energy = rig.energy();
    rig.loads[1].factor = smooth_ramp((n + 0.5) * dt / 0.5);
    const Measurement m = rig.stepper.measured_step(dt, dt, nullptr);
    const double out = energy + m.kinetic + m.works.damping + m.works.fracture + m.works.plastic;
    largest_work = std::max(largest_work, std::abs(m.works.loads));
    last = std::abs(m.works.loads - out) / (largest_work + 1e-300);
    if (n > 10) worst = std::max(worst, last);
  }
  EXPECT_EQ(rig.model->links->broken(), 5);
  return {worst, last};
}

TEST(Ledger, closes_through_a_rupture_and_falls_as_dt_squared) {
  const auto [coarse, coarse_end] = residual_of_a_rupture(0.6, 0);
  const auto [fine, fine_end] = residual_of_a_rupture(0.15, 0);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, coarse / 8);  // dt^2 would give 16
}

TEST(Ledger, closes_with_drag) { EXPECT_LT(residual_of_a_rupture(0.15, 0.5).first, 1e-3); }

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
  EXPECT_THROW(build_model(s, stage, field_of(s)), SceneError);
}

TEST(Model, an_elastic_scene_has_no_plastic_arrays_and_a_scene_without_links_none_of_theirs) {
  const Sample s = hexagons(2, 2, 2, 0.05);
  Stage stage;
  stage.cells["cells"] = cell_scene(50.0, 1.0, 1.0);
  const Field x = field_of(s);
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
