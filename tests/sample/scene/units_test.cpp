#include "generator/sample/units.h"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace lamella {
namespace {

constexpr Dimension kLength{1, 0, 0, 0}, kPressure{-1, 1, -2, 0};

void expect_quantity(const char* text, double value, Dimension dimension) {
  const PhysicalValue quantity = parse_quantity(text);
  EXPECT_NEAR(quantity.value, value, 1e-14 * std::abs(value)) << text;
  EXPECT_EQ(quantity.dimension, dimension) << text;
}

TEST(units, lengths_take_every_prefix) {
  expect_quantity("10 um", 10e-6, kLength);
  expect_quantity("10 \u00b5m", 10e-6, kLength);
  expect_quantity("10 \u03bcm", 10e-6, kLength);
  expect_quantity("3nm", 3e-9, kLength);
  expect_quantity("2.5 cm", 0.025, kLength);
  expect_quantity("-1e3 mm", -1, kLength);
  expect_quantity("+4 km", 4000, kLength);
}

TEST(units, whole_names_go_before_prefixes) {
  expect_quantity("2 min", 120, {0, 0, 1, 0});
  expect_quantity("1 h", 3600, {0, 0, 1, 0});
  expect_quantity("1 m", 1, kLength);
}

TEST(units, compound_units_multiply_and_divide) {
  expect_quantity("2 MPa", 2e6, kPressure);
  expect_quantity("1e-3 N/m", 1e-3, {0, 1, -2, 0});
  expect_quantity("3 N/mm2", 3e6, kPressure);
  expect_quantity("3 N / mm^2", 3e6, kPressure);
  expect_quantity("1 g/cm3", 1000, {-3, 1, 0, 0});
  expect_quantity("5 N m2", 5, {3, 1, -2, 0});
  expect_quantity("5 N*m2*s", 5, {3, 1, -1, 0});
  expect_quantity("7 kg m s-2", 7, {1, 1, -2, 0});
  expect_quantity("7 kg m s^-2", 7, {1, 1, -2, 0});
  expect_quantity("200 1/s", 200, {0, 0, -1, 0});
  expect_quantity("2 kHz", 2000, {0, 0, -1, 0});
  expect_quantity("1 J/m2", 1, {0, 1, -2, 0});
}

TEST(units, a_slash_divides_by_the_next_factor_only) { expect_quantity("1 kg/m s", 1, {-1, 1, 1, 0}); }

TEST(units, percent_and_bare_numbers_are_ratios) {
  expect_quantity("5 %", 0.05, {});
  expect_quantity("5%", 0.05, {});
  expect_quantity("0.25", 0.25, {});
}

TEST(units, an_angle_is_not_a_ratio) { expect_quantity("90 deg", std::numbers::pi / 2, {0, 0, 0, 1}); }

TEST(units, nonsense_is_refused_with_a_reason) {
  for (const char* text :
       {"", "um", "1 parsec", "1 m/", "1 /", "1 m//s", "1 m^12", "1 m^", "1e999 m", "ten um", "1 mmin", "1 kmin"})
    EXPECT_THROW(parse_quantity(text), std::invalid_argument) << text;
}

}  // namespace
}  // namespace lamella
