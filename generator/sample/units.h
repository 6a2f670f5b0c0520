// Quantities as people write them: "10 um", "2 MPa", "1e-3 N/m", "5 %", with SI prefixes and compound units.
#pragma once
#include <string>
#include <string_view>

namespace lamella {

/// Exponents of the base units. The angle counts as one, so that a turn is not mistaken for a ratio.
struct Dimension {
  int metre = 0, kilogram = 0, second = 0, radian = 0;
  bool operator==(const Dimension&) const = default;
};

/// A value in SI and what kind of quantity it is.
struct PhysicalValue {
  double value = 0;
  Dimension dimension;
};

/// "N/m2", "kg/m^3", "m/s2", "N m", "1/s", "%": factors joined by a space, `*` or `/`; `/` divides by the next factor only.
/// Returns the unit's size in SI. Throws std::invalid_argument that says what is not understood.
PhysicalValue parse_unit(std::string_view text);

/// A number, then a unit: "-1.5e3 kN / m". A number alone has dimension 1. Throws std::invalid_argument.
PhysicalValue parse_quantity(std::string_view text);

}  // namespace lamella
