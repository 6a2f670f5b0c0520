// The law of links that soften, against closed forms and finite differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulator/laws/cohesive_zone.h"

namespace lamella {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// k_n = 3, k_t = 1, strengths 1 and 0.8, toughnesses 0.9 and 1.6: s_f / s0 is 5 in opening.
ZoneLink zone_link(double alpha = 2, ModeMixing mixing = ModeMixing::kBenzeggaghKenane, double eta = 2) {
  return {.k_n = 3,
          .k_t = 1,
          .strength_n = 1,
          .strength_t = 0.8,
          .alpha = alpha,
          .toughness_n = 0.9,
          .toughness_t = 1.6,
          .mixing = mixing,
          .mixing_exponent = eta};
}

TEST(Jet, has_the_derivatives_of_the_formula_that_it_goes_through) {
  const auto formula = [](auto x, auto y) {
    using std::pow;
    using std::sqrt;
    return pow(x * y, 1.7) / sqrt(x + y * y) - x * x / y;
  };
  const double x = 1.3, y = 0.7, h = 1e-4;
  const Jet at = formula(Jet::variable_x(x), Jet::variable_y(y));
  EXPECT_NEAR(at.value, formula(x, y), 1e-15);
  EXPECT_NEAR(at.x, (formula(x + h, y) - formula(x - h, y)) / (2 * h), 1e-7);
  EXPECT_NEAR(at.y, (formula(x, y + h) - formula(x, y - h)) / (2 * h), 1e-7);
  EXPECT_NEAR(at.xx, (formula(x + h, y) - 2 * at.value + formula(x - h, y)) / (h * h), 1e-6);
  EXPECT_NEAR(at.yy, (formula(x, y + h) - 2 * at.value + formula(x, y - h)) / (h * h), 1e-6);
  EXPECT_NEAR(
      at.xy,
      (formula(x + h, y + h) - formula(x + h, y - h) - formula(x - h, y + h) + formula(x - h, y - h)) / (4 * h * h),
      1e-6);
}

TEST(CohesiveZone, mixes_toughness_as_the_two_laws_say) {
  const ZoneLink bk = zone_link(2, ModeMixing::kBenzeggaghKenane, 1.5), power = zone_link(2, ModeMixing::kPower, 2);
  for (const double B : {0.0, 0.2, 0.5, 1.0}) {
    EXPECT_NEAR(critical_energy<double>(bk, 1 - B, B), 0.9 + 0.7 * std::pow(B, 1.5), 1e-15);
    const double g = critical_energy<double>(power, 1 - B, B);
    EXPECT_NEAR(std::pow((1 - B) * g / 0.9, 2) + std::pow(B * g / 1.6, 2), 1, 1e-14);
  }
}

/// What pulling a link from rest along (u cos phi, u sin phi) until it is gone finds, with a commit at every one of `steps` steps.
struct Pulled {
  double peak_zeta = -1;  // largest value of the criterion by the forces
  double work = 0;        // of the forces, by the trapezoidal rule [J]
  double dissipated = 0;  // [J]
  double shear = 0;       // B
};

Pulled pull(const ZoneLink& p, double phi, double last, int steps) {
  Pulled out;
  ZoneHistory h;
  double f_n = 0, f_t = 0;
  const double c = std::cos(phi), s = std::sin(phi), du = last / steps;
  for (int k = 1; k <= steps; ++k) {
    const double d_n = k * du * c, d_t = k * du * s;
    const ZoneHistory next = advanced(p, h, d_n, d_t);
    const ZoneResponse r = zone_response(p, next, d_n, d_t);
    out.work += 0.5 * du * ((f_n + r.f_n) * c + (f_t + r.f_t) * s);
    f_n = r.f_n, f_t = r.f_t;
    out.peak_zeta = std::max(out.peak_zeta, yield_function(f_n, f_t, p.strength_n, p.strength_t, p.alpha));
    h = next;
    if (h.gone()) break;
  }
  EXPECT_TRUE(h.gone()) << phi;
  out.dissipated = zone_dissipated(h);
  out.shear = h.shear;
  return out;
}

TEST(CohesiveZone, peaks_on_the_criterion_and_dissipates_the_toughness_of_its_mix_over_all_mode_mixes) {
  for (const double alpha : {1.0, 1.4, 2.0, 4.0})
    for (const ModeMixing mixing : {ModeMixing::kBenzeggaghKenane, ModeMixing::kPower})
      for (int degrees = 0; degrees <= 90; degrees += 10) {
        const ZoneLink p = zone_link(alpha, mixing, 1.5);
        const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
        const double shear = p.k_t * s * s / (p.k_n * c * c + p.k_t * s * s);
        const double toughness = critical_energy<double>(p, 1 - shear, shear);
        const Pulled pulled = pull(p, degrees * kDegree, 6, 60000);
        EXPECT_NEAR(pulled.dissipated, toughness, 1e-12) << alpha << " " << degrees;
        EXPECT_NEAR(pulled.work, toughness, 1e-6 * toughness) << alpha << " " << degrees;
        EXPECT_NEAR(pulled.shear, shear, 1e-12);
        // A step near the peak changes the forces by k du = 3e-4.
        EXPECT_LE(pulled.peak_zeta, 1e-12) << alpha << " " << degrees;
        EXPECT_GT(pulled.peak_zeta, -2e-3) << alpha << " " << degrees;
      }
}

TEST(CohesiveZone, dissipates_the_same_in_a_hundred_steps_and_in_one) {
  const ZoneLink p = zone_link();
  EXPECT_NEAR(pull(p, 0.6, 6, 100).dissipated, pull(p, 0.6, 6, 60000).dissipated, 1e-12);
  EXPECT_NEAR(pull(p, 0.6, 6, 1).dissipated, pull(p, 0.6, 6, 60000).dissipated, 1e-12);
  EXPECT_NEAR(zone_response(p, {}, 6 * std::cos(0.6), 6 * std::sin(0.6)).potential, pull(p, 0.6, 6, 1).dissipated,
              1e-12);
}

TEST(CohesiveZone, unloads_to_the_origin_and_reloads_the_same_way_at_no_cost) {
  const ZoneLink p = zone_link();
  const ZoneHistory h = advanced(p, {}, 0.5, 0.4);
  const ZoneResponse top = zone_response(p, h, 0.5, 0.4);
  EXPECT_GT(top.damage, 0.1);
  EXPECT_LT(top.damage, 0.9);
  for (const double share : {0.8, 0.5, 0.1, -0.3}) {  // and through the origin, sideways
    const double d_n = share > 0 ? share * 0.5 : 0, d_t = share * 0.4;
    const ZoneHistory same = advanced(p, h, d_n, d_t);
    EXPECT_EQ(same.largest, h.largest);
    const ZoneResponse r = zone_response(p, same, d_n, d_t);
    EXPECT_NEAR(r.f_n, (1 - top.damage) * p.k_n * d_n, 1e-15);
    EXPECT_NEAR(r.f_t, (1 - top.damage) * p.k_t * d_t, 1e-15);
    EXPECT_NEAR(r.potential, 0.5 * (r.f_n * d_n + r.f_t * d_t), 1e-15);
    EXPECT_EQ(r.potential, r.stored);
  }
  const ZoneResponse just_before = zone_response(p, h, 0.5 * (1 - 1e-9), 0.4 * (1 - 1e-9)),
                     just_beyond = zone_response(p, h, 0.5 * (1 + 1e-9), 0.4 * (1 + 1e-9));
  EXPECT_NEAR(just_before.f_n, just_beyond.f_n, 1e-8);
  EXPECT_NEAR(just_before.f_t, just_beyond.f_t, 1e-8);
}

TEST(CohesiveZone, compression_is_elastic_with_the_whole_stiffness_however_damaged) {
  const ZoneLink p = zone_link();
  EXPECT_FALSE(advanced(p, {}, -1e6, 0).begun());
  const ZoneHistory h = advanced(p, {}, 0.8, 0.1);
  ASSERT_GT(zone_response(p, h, 0.8, 0.1).damage, 0.5);
  const ZoneResponse r = zone_response(p, h, -2, 0.1);
  EXPECT_NEAR(r.f_n, -2 * p.k_n, 1e-15);
  EXPECT_EQ(r.k_nn, p.k_n);
  EXPECT_LT(r.f_t, 0.5 * p.k_t * 0.1);
  EXPECT_EQ(advanced(p, h, -2, 0.1).largest, h.largest);
}

TEST(CohesiveZone, begins_under_compression_where_shear_reaches_what_pressure_has_raised) {
  const ZoneLink p = zone_link();
  const double f_n = -0.3, strength = p.strength_t * std::sqrt(1 - f_n / p.strength_n);
  const ZoneHistory h = advanced(p, {}, f_n / p.k_n, 1.2 * strength / p.k_t);
  EXPECT_NEAR(h.onset, strength / std::sqrt(p.k_t), 1e-14);
  EXPECT_EQ(h.shear, 1);
  EXPECT_NEAR(0.5 * h.onset * h.end, p.toughness_t, 1e-14);
}

TEST(CohesiveZone, force_is_the_slope_of_the_potential_and_stiffness_its_curvature_at_and_beyond_the_onset) {
  // From rest straight to openings far beyond the criterion, in every direction: what lies in their direction is differentiated too.
  const double h = 2e-5;
  for (const double alpha : {1.0, 1.4, 2.0})
    for (const ModeMixing mixing : {ModeMixing::kBenzeggaghKenane, ModeMixing::kPower})
      for (int degrees = 4; degrees < 180; degrees += 8)
        for (const double size : {0.7, 1.5, 2.5, 8.0}) {
          if (degrees > 90 && degrees < 96) continue;  // within h of where pressing begins
          const ZoneLink p = zone_link(alpha, mixing, 1.5);
          const double n = size * std::cos(degrees * kDegree), t = size * std::sin(degrees * kDegree);
          const ZoneHistory begun = advanced(p, {}, 0.2 * n, 0.9 * t);
          for (const ZoneHistory& history : {ZoneHistory{}, begun}) {
            if (history.gone()) continue;
            const auto at = [&](double d_n, double d_t) { return zone_response(p, history, d_n, d_t); };
            const ZoneResponse r = at(n, t);
            const double scale = 1 + p.k_n * size;
            EXPECT_NEAR(r.f_n, (at(n + h, t).potential - at(n - h, t).potential) / (2 * h), 2e-7 * scale) << degrees;
            EXPECT_NEAR(r.f_t, (at(n, t + h).potential - at(n, t - h).potential) / (2 * h), 2e-7 * scale) << degrees;
            EXPECT_NEAR(r.k_nn, (at(n + h, t).f_n - at(n - h, t).f_n) / (2 * h), 2e-6) << degrees << " " << size;
            EXPECT_NEAR(r.k_tt, (at(n, t + h).f_t - at(n, t - h).f_t) / (2 * h), 2e-6) << degrees << " " << size;
            EXPECT_NEAR(r.k_nt, (at(n, t + h).f_n - at(n, t - h).f_n) / (2 * h), 2e-6) << degrees << " " << size;
            EXPECT_NEAR(r.k_nt, (at(n + h, t).f_t - at(n - h, t).f_t) / (2 * h), 2e-6) << degrees << " " << size;
          }
        }
}

TEST(CohesiveZone, brittleness_is_1_where_the_energy_at_the_criterion_is_the_toughness) {
  ZoneLink p = zone_link();
  p.toughness_n = 0.5 * p.strength_n * p.strength_n / p.k_n;
  p.toughness_t = 10;
  EXPECT_NEAR(brittleness(p), 1, 1e-12);
  p.toughness_n = 10;
  p.toughness_t = 0.5 * p.strength_t * p.strength_t / p.k_t;
  EXPECT_NEAR(brittleness(p), 1, 1e-12);
}

}  // namespace
}  // namespace lamella
