#include "postproc/quantities/material_constants.h"

#include <gtest/gtest.h>

#include "generator/sample/errors.h"
#include "tests/postproc/hexagons.h"

namespace lamella {
namespace {

constexpr double kYoung = 3e6, kPeak = 0.02;

/// Linear to the peak, then linear to zero at twice the strain, and flat.
LoadCurve triangle() {
  LoadCurve curve;
  for (int k = 0; k <= 600; ++k) {
    const double strain = 1e-4 * k;
    curve.time.push_back(10 * strain);
    curve.strain.push_back(strain);
    curve.stress.push_back(kYoung * (strain <= kPeak ? strain : std::max(0.0, 2 * kPeak - strain)));
  }
  return curve;
}

const TestSetup kSetup{.axis = 1, .kind = "tension", .gauge_length = 0.5, .width = 1, .depth = 1, .stage = 0};

TEST(MaterialConstants, a_triangle_has_known_ones) {
  const std::vector<Vec2> lateral{{0, 0}, {0.002, -0.0005}, {0.004, -0.001}, {0.03, 0.2}};
  const MaterialConstants m = material_constants(triangle(), kSetup, {}, lateral);
  ASSERT_TRUE(m.modulus && m.poisson && m.strain_at_failure);
  EXPECT_NEAR(*m.modulus, kYoung, 1e-6 * kYoung);
  EXPECT_NEAR(m.elastic_strain, 0.3 * kPeak, 1.01e-4);
  EXPECT_NEAR(*m.poisson, 0.25, 1e-12);
  EXPECT_NEAR(m.peak_stress, kYoung * kPeak, 1e-6);
  EXPECT_NEAR(m.strain_at_peak, kPeak, 1e-12);
  EXPECT_NEAR(*m.strain_at_failure, 1.8 * kPeak, 1.01e-4);
  // the triangle less its last corner, times the gauge length
  EXPECT_NEAR(m.work_per_area, 0.5 * kYoung * kPeak * (2 * kPeak - 0.2 * 0.2 * kPeak) * 0.5, 1e-2 * 300);
}

TEST(MaterialConstants, the_modulus_is_not_fitted_beyond_the_first_break) {
  LoadCurve curve = triangle();
  for (std::size_t k = 0; k < curve.strain.size(); ++k)
    if (curve.strain[k] > 0.003 && curve.strain[k] < kPeak) curve.stress[k] *= 0.9;  // damage softens
  Event event;
  event.time = 10 * 0.003;
  EXPECT_NEAR(*material_constants(curve, kSetup, {event}, {}).modulus, kYoung, 1e-6 * kYoung);
}

TEST(MaterialConstants, a_test_that_does_not_fail_says_so) {
  LoadCurve curve = triangle();
  curve.time.resize(150), curve.strain.resize(150), curve.stress.resize(150);
  EXPECT_FALSE(material_constants(curve, kSetup, {}, {}).strain_at_failure);
}

TEST(MaterialConstants, a_sample_in_two_has_failed_at_the_latest_where_the_curve_ends) {
  LoadCurve curve = triangle();
  curve.time.resize(150), curve.strain.resize(150), curve.stress.resize(150);
  MaterialConstants m = material_constants(curve, kSetup, {}, {});
  fail_at_separation(m, curve);
  EXPECT_EQ(m.strain_at_failure, curve.strain.back());
  m = material_constants(triangle(), kSetup, {}, {});
  const auto by_stress = m.strain_at_failure;
  fail_at_separation(m, triangle());
  EXPECT_EQ(m.strain_at_failure, by_stress);
}

TEST(MaterialConstants, a_frame_stands_behind_the_fall_at_its_time) {
  const std::vector<double> times{0, 1, 1, 2}, stress{0, 10, 4, 6};
  EXPECT_EQ(value_at_frame(times, stress, 1), 4);
  EXPECT_EQ(value_at(times, stress, 1), 10);
  for (const double time : {-1.0, 0.0, 0.5, 1.5, 2.0, 3.0})
    EXPECT_EQ(value_at_frame(times, stress, time), value_at(times, stress, time)) << time;
}

TEST(MaterialConstants, compression_counts_positive) {
  TestSetup setup = kSetup;
  setup.kind = "compression";
  Response response;
  response.columns = {"time", "strain", "stress"};
  for (int k = 0; k < 100; ++k) response.rows.push_back({0.1 * k, -1e-4 * k, -kYoung * 1e-4 * k});
  const LoadCurve curve = load_curve(response, setup);
  EXPECT_NEAR(*material_constants(curve, setup, {}, {}).modulus, kYoung, 1e-6 * kYoung);
  EXPECT_GT(material_constants(curve, setup, {}, {}).peak_stress, 0);
}

TEST(MaterialConstants, only_rows_of_the_loading_stage_count) {
  Response response;
  response.columns = {"time", "stage", "strain", "stress"};
  response.rows = {{0, 0, 0, 99}, {1, 1, 0, 3}, {2, 1, 0.1, 1}, {3, 2, 0.2, 77}};
  TestSetup setup = kSetup;
  setup.stage = 1;
  EXPECT_EQ(load_curve(response, setup).stress, (std::vector<double>{3, 1}));
}

TEST(MaterialConstants, lateral_strain_of_an_affine_move_is_exact) {
  const Sample sample = hexagon_tissue(5, 5, 1, 2, 0.05);
  std::vector<Vec2> x;
  for (const Vec2& p : sample.x) x.emplace_back(p.x() * 0.97 + 4, p.y() * 1.1);
  EXPECT_NEAR(lateral_strain(sample, x, 1), -0.03, 1e-12);
  EXPECT_NEAR(lateral_strain(sample, x, 0), 0.1, 1e-12);
}

TEST(MaterialConstants, the_set_up_is_found_in_a_later_stage) {
  EXPECT_FALSE(test_setup({{"title", "beam"}}));
  const auto setup = test_setup({{"stage_2_axis", "x"},
                                 {"stage_2_kind", "shear"},
                                 {"stage_2_gauge_length", "2"},
                                 {"stage_2_width", "3"},
                                 {"stage_2_depth", "1"}});
  ASSERT_TRUE(setup);
  EXPECT_EQ(setup->stage, 2);
  EXPECT_EQ(setup->axis, 0);
  EXPECT_THROW(test_setup({{"axis", "y"}, {"gauge_length", "long"}, {"width", "1"}, {"depth", "1"}}), DataError);
  EXPECT_THROW(test_setup({{"axis", "y"}}), DataError);
}

}  // namespace
}  // namespace lamella
