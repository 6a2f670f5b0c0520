// The honeycomb with one segment a side (physics 2e): moduli and first link break, against closed forms.
#include "simulator/moving_box.h"
#include "simulator/steppers/quasi_static.h"
#include "tests/simulator/tissues.h"

namespace lamella {
namespace {

constexpr double kGap = 1e-3, kEA = 1200, kEI = 1;

Stage honeycomb_stage(double k_n, std::optional<double> strength) {
  Stage stage;
  stage.cells["cells"] = cell_scene(kEA, kEI, 1.0);
  stage.links["links"] = link_scene("link", k_n, 0.1 * k_n, strength);
  return stage;
}

/// Seven hexagons: a 3 x 3 patch whose cell (1, 1) is surrounded by six others (two corners are loose and unused).
struct Patch {
  Sample sample = hexagons(3, 3, 1, kGap);
  Index centre = 4;
  std::vector<Vec2> origin;  // of every cell
  Patch() {
    for (Index c = 0; c < sample.cells(); ++c) {
      Vec2 mean = Vec2::Zero();
      for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) mean += sample.x[i] / 6;
      origin.push_back(mean);
    }
  }
};

/// Displacements of all nodes when every cell deforms alike under the macroscopic strain: the central cell's equilibrium with
/// its neighbours as copies of itself. Linear, small strain.
Eigen::VectorXd periodic_displacement(const Patch& p, const Model& model, const Field& x,
                                      const Eigen::Matrix2d& strain) {
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(2 * x.size(), 2 * x.size());
  for (const Term* term : model.terms()) k += stiffness_of(*term, x);
  const Index first = 2 * p.sample.cell_begin[p.centre];
  Eigen::MatrixXd folded = Eigen::MatrixXd::Zero(12, 12);
  Eigen::VectorXd affine(2 * x.size());
  for (Index c = 0; c < p.sample.cells(); ++c) {
    folded += k.block(first, 12 * c, 12, 12);
    for (int i = 0; i < 6; ++i) affine.segment<2>(12 * c + 2 * i) = strain * (p.origin[c] - p.origin[p.centre]);
  }
  const Eigen::VectorXd cell = folded.completeOrthogonalDecomposition().solve(-(k * affine).segment(first, 12));
  Eigen::VectorXd u = affine;
  for (Index c = 0; c < p.sample.cells(); ++c) u.segment(12 * c, 12) += cell;
  return u;
}

/// Stress carried through the central cell's links (Love-Weber over the tile).
Eigen::Matrix2d stress_of(const Patch& p, const CohesiveLinks& links, const Field& x) {
  ArraySet frame;
  links.add_output(x, frame);
  const auto& force = frame.doubles("link_force");
  Eigen::Matrix2d stress = Eigen::Matrix2d::Zero();
  for (std::size_t l = 0; l < p.sample.links.size(); ++l) {
    const Link& link = p.sample.links[l];
    const bool is_a = link.a / 6 == p.centre, is_b = link.b / 6 == p.centre;
    if (!is_a && !is_b) continue;
    const Vec2 t = ((x.at(link.a_next) - x.at(link.a_prev)) - (x.at(link.b_next) - x.at(link.b_prev))).normalized();
    const Vec2 f = (is_a ? 1 : -1) * (force[2 * l] * right_of(t) + force[2 * l + 1] * t);
    const Vec2 at = 0.5 * (x.at(link.a) + x.at(link.b)) - p.origin[p.centre];
    stress += f * at.transpose() / p.sample.tile_area[p.centre];
  }
  return 0.5 * (stress + stress.transpose());
}

Field moved(const Field& x, const Eigen::VectorXd& u) {
  Field y = x;
  for (int k = 0; k < u.size(); ++k) coordinate(y, k) += u[k];
  return y;
}

/// Strain under which the stress is uniaxial with unit stress along `axis`.
Eigen::Matrix2d uniaxial_strain(const Patch& p, const Model& model, const Field& x, int axis) {
  Eigen::Matrix3d c;
  const double e = 1e-7;
  for (int k = 0; k < 3; ++k) {
    Eigen::Matrix2d strain = Eigen::Matrix2d::Zero();
    if (k < 2) strain(k, k) = e;
    if (k == 2) strain(0, 1) = strain(1, 0) = e / 2;
    const Eigen::Matrix2d s = stress_of(p, *model.links, moved(x, periodic_displacement(p, model, x, strain)));
    c.col(k) << s(0, 0) / e, s(1, 1) / e, s(0, 1) / e;
  }
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  target[axis] = 1;
  const Eigen::Vector3d v = c.inverse() * target;
  Eigen::Matrix2d strain;
  strain << v[0], v[2] / 2, v[2] / 2, v[1];
  return strain;
}

TEST(Honeycomb, modulus_and_poisson_ratio_are_those_of_the_closed_form) {
  const Patch p;
  const double k_n = 100, k_t = 10;
  const Field x = field_of(p.sample.x);
  const auto model = build_model(p.sample, honeycomb_stage(k_n, {}), x);
  // sides are 1 - gap / sqrt 3, which is within the tolerance
  const double k_w = 6 * kEI, k_a = 2 * kEA;
  const double bulk = 1 / (1 / (k_a / (2 * std::sqrt(3.0))) + 1 / (std::sqrt(3.0) * k_n));
  const double shear = 1 / (std::sqrt(3.0) * (1 / k_w + 1 / k_a) + 2 / (std::sqrt(3.0) * (k_n + k_t)));
  const double young = 4 / (1 / bulk + 1 / shear);
  EXPECT_NEAR(young, 13.024608, 1e-6);
  for (const int axis : {0, 1}) {
    const Eigen::Matrix2d strain = uniaxial_strain(p, *model, x, axis);
    EXPECT_NEAR(1 / strain(axis, axis) / young, 1, 0.01);
    EXPECT_NEAR(-strain(1 - axis, 1 - axis) / strain(axis, axis), 1 - young / (2 * bulk), 0.01);
  }
}

/// Energy per area of a honeycomb that repeats both ways, per square of the strain along an axis, when its box is a little longer there and
/// its nodes are at rest: half the modulus with the strain across held.
double energy_of_stretched_box(int rows, int columns, int axis) {
  Sample sample = hexagons(rows, columns, 1, kGap, {true, true});
  const double strain = 1e-6;
  sample.box.hi[axis] += strain * sample.box.size()[axis];
  for (Index c = 0; c < sample.cells(); ++c) {
    double mean = 0;
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) mean += sample.x[i][axis] / 6;
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) sample.x[i][axis] += strain * mean;
  }
  const auto model = build_model(sample, honeycomb_stage(100, {}), field_of(sample.x));
  Field x = field_of(sample.x);
  // Newton's method; rigid motion of the whole is left free.
  for (int iteration = 0; iteration < 3; ++iteration) {
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(2 * x.size(), 2 * x.size());
    Eigen::VectorXd f = Eigen::VectorXd::Zero(2 * x.size());
    for (const Term* term : model->terms()) k += stiffness_of(*term, x), f += force_of(*term, x);
    x = moved(x, k.completeOrthogonalDecomposition().solve(f));
  }
  return model->energy(x) / (strain * strain * sample.box.area());
}

TEST(Honeycomb, that_repeats_in_its_box_has_the_moduli_of_one_among_copies_of_itself) {
  const Patch p;
  const Field x = field_of(p.sample.x);
  const auto model = build_model(p.sample, honeycomb_stage(100, {}), x);
  for (const int axis : {0, 1}) {
    Eigen::Matrix2d strain = Eigen::Matrix2d::Zero();
    strain(axis, axis) = 1e-7;
    const Eigen::Matrix2d s = stress_of(p, *model->links, moved(x, periodic_displacement(p, *model, x, strain)));
    const double held = s(axis, axis) / strain(axis, axis);
    for (const auto& [rows, columns] : {std::pair{2, 1}, {2, 3}, {4, 2}})
      EXPECT_NEAR(2 * energy_of_stretched_box(rows, columns, axis) / held, 1, 1e-5) << rows << " x " << columns;
  }
}

// Pulled by its box, which is free across.
TEST(Honeycomb, whose_box_is_pulled_has_the_modulus_and_the_poisson_ratio_of_one_among_copies_of_itself) {
  const Patch p;
  const Field rest = field_of(p.sample.x);
  const auto unit = build_model(p.sample, honeycomb_stage(100, {}), rest);
  for (const int axis : {0, 1}) {
    const Eigen::Matrix2d exact = uniaxial_strain(p, *unit, rest, axis);
    for (const auto& [rows, columns] : {std::pair{2, 1}, {2, 3}, {4, 2}}) {
      const Sample s = hexagons(rows, columns, 1, kGap, {true, true});
      Stage stage = honeycomb_stage(100, {});
      stage.loading = LoadingScene{};
      stage.loading->axis = axis == 0 ? "x" : "y";
      stage.loading->strain = stage.loading->strain_rate.emplace(1e-7);
      stage.loading->normal_only = true;
      Field x = field_of(s.x);
      append_box(x, Vec2(0, 0));
      const auto model = build_model(s, stage, x);
      const auto loads = build_loads(s, stage);
      const Gauge gauge = measure_gauge(s, stage, loads);
      const LoadPath path(stage, gauge);
      QuasiStaticSettings settings;
      settings.longest = 1, settings.residual = 1e-10;
      QuasiStatic stepper(*model, loads, path, x, 0.0, settings);
      stepper.settle();
      stepper.load_towards(1, [] { return true; });
      const double stress = grip_forces(gauge, stepper.load_forces())[1] / (gauge.width * gauge.depth);
      const Vec2 strain = box_growth(s, stepper.x()).cwiseQuotient(s.box.size());
      EXPECT_NEAR(strain[axis] / stress / exact(axis, axis), 1, 1e-5) << rows << " x " << columns;
      EXPECT_NEAR(strain[1 - axis] / strain[axis] / (exact(1 - axis, 1 - axis) / exact(axis, axis)), 1, 1e-5);
    }
  }
}

/// Stress, times L over strength, at which the first link of the central cell breaks when the outer cells follow the unit cell's
/// solution, in explicit dynamics.
double first_break(int axis) {
  const Patch p;
  // Strength small against the stiffness, so that the solution stays linear up to the break.
  const double k_n = 100, strength = 1e-3;
  Stage stage = honeycomb_stage(k_n, strength);
  stage.drag = DragScene{2.0};
  const Field rest = field_of(p.sample.x);
  const auto linear = build_model(p.sample, stage, rest);
  const Eigen::VectorXd unit = periodic_displacement(p, *linear, rest, uniaxial_strain(p, *linear, rest, axis));

  const double seconds = 120, full = 3.0 * strength;  // stress 0 to 3 strengths, the mean of both answers is near 1.7
  std::vector<Load> loads;
  for (Index i = 0; i < p.sample.nodes(); ++i) {
    if (i / 6 == p.centre) continue;
    Load load;
    load.nodes = {i};
    load.holds[0] = load.holds[1] = true;
    load.velocity = unit.segment<2>(2 * i) * full / seconds;
    loads.push_back(load);
  }
  Rig rig(p.sample, stage, loads);
  const double dt = 0.5 * 2 / std::sqrt(6 * kEA);
  for (double time = 0; time < seconds; time += dt) {
    for (Load& load : rig.loads) load.factor = smooth_ramp(time / 10);
    rig.stepper.step(dt, dt);
    // Links between two outer cells may break at will; those of the central cell count.
    for (const Break& b : rig.stepper.take_breaks()) {
      const Link& link = p.sample.links[b.link];
      if (link.a / 6 != p.centre && link.b / 6 != p.centre) continue;
      // stress reached: full * (time - lag of the ramp) / seconds
      return full * (time - 5) / seconds / strength;
    }
  }
  return 0;
}

TEST(Honeycomb, the_first_link_breaks_at_the_stress_of_the_closed_form) {
  EXPECT_NEAR(first_break(0) / 1.41935, 1, 0.01);  // along x, normal to the walls along y
  EXPECT_NEAR(first_break(1) / 2.08118, 1, 0.01);  // along y, along those walls
}

}  // namespace
}  // namespace lamella
