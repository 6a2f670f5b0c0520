#include "generator/sample/units.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace lamella {
namespace {

struct NamedUnit {
  std::string_view name;
  double size;  // in SI
  Dimension dimension;
  bool prefixed;  // takes SI prefixes
};

constexpr std::array<NamedUnit, 13> kUnits{{
    {"m", 1, {1, 0, 0, 0}, true},
    {"g", 1e-3, {0, 1, 0, 0}, true},
    {"s", 1, {0, 0, 1, 0}, true},
    {"rad", 1, {0, 0, 0, 1}, true},
    {"N", 1, {1, 1, -2, 0}, true},
    {"Pa", 1, {-1, 1, -2, 0}, true},
    {"J", 1, {2, 1, -2, 0}, true},
    {"Hz", 1, {0, 0, -1, 0}, true},
    {"deg", std::numbers::pi / 180, {0, 0, 0, 1}, false},
    {"min", 60, {0, 0, 1, 0}, false},
    {"h", 3600, {0, 0, 1, 0}, false},
    {"%", 0.01, {}, false},
    {"1", 1, {}, false},
}};

struct Prefix {
  std::string_view name;
  double size;
};

// Both ways of writing micro: the Greek letter and the sign, in UTF-8.
constexpr std::array<Prefix, 11> kPrefixes{{{"f", 1e-15},
                                            {"p", 1e-12},
                                            {"n", 1e-9},
                                            {"u", 1e-6},
                                            {"\u03bc", 1e-6},
                                            {"\u00b5", 1e-6},
                                            {"m", 1e-3},
                                            {"c", 1e-2},
                                            {"k", 1e3},
                                            {"M", 1e6},
                                            {"G", 1e9}}};

/// Whole names go first: "min" is a minute, not a milli-inch, and "m" a metre.
std::optional<PhysicalValue> named(std::string_view name) {
  for (const NamedUnit& unit : kUnits)
    if (unit.name == name) return PhysicalValue{unit.size, unit.dimension};
  for (const Prefix& prefix : kPrefixes) {
    if (!name.starts_with(prefix.name)) continue;
    for (const NamedUnit& unit : kUnits)
      if (unit.prefixed && unit.name == name.substr(prefix.name.size()))
        return PhysicalValue{prefix.size * unit.size, unit.dimension};
  }
  return std::nullopt;
}

PhysicalValue power(const PhysicalValue& q, int exponent) {
  return {std::pow(q.value, exponent),
          {q.dimension.metre * exponent, q.dimension.kilogram * exponent, q.dimension.second * exponent,
           q.dimension.radian * exponent}};
}

PhysicalValue product(const PhysicalValue& a, const PhysicalValue& b) {
  return {a.value * b.value,
          {a.dimension.metre + b.dimension.metre, a.dimension.kilogram + b.dimension.kilogram,
           a.dimension.second + b.dimension.second, a.dimension.radian + b.dimension.radian}};
}

/// One factor: a name and an exponent, "m2", "m^2", "s-1".
PhysicalValue factor(std::string_view text) {
  if (text == "1") return {1, {}};
  std::size_t end = text.size();
  while (end > 0 && text[end - 1] >= '0' && text[end - 1] <= '9') --end;
  int exponent = 1;
  std::string_view name = text;
  if (end < text.size()) {
    if (text.size() - end > 1) throw std::invalid_argument(fmt::format("\"{}\" has an exponent above 9", text));
    exponent = text[end] - '0';
    name = text.substr(0, end);
    if (name.ends_with('-')) exponent = -exponent, name.remove_suffix(1);
    if (name.ends_with('^')) name.remove_suffix(1);
  }
  const auto unit = named(name);
  if (!unit)
    throw std::invalid_argument(
        fmt::format("\"{}\" is no unit known here; units are m g s rad N Pa J Hz with SI prefixes, deg min h %", text));
  return power(*unit, exponent);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

}  // namespace

PhysicalValue parse_unit(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 40) throw std::invalid_argument("the unit is longer than any real one");
  PhysicalValue unit{1, {}};
  bool divide = false, expected = false;  // a factor must follow
  while (!(text = trimmed(text)).empty()) {
    if (text.front() == '*' || text.front() == '/') {
      if (expected) throw std::invalid_argument(fmt::format("a unit is missing before \"{}\"", text));
      divide = text.front() == '/';
      expected = true;
      text.remove_prefix(1);
      continue;
    }
    const std::string_view name = text.substr(0, text.find_first_of(" \t*/"));
    unit = product(unit, power(factor(name), divide ? -1 : 1));
    divide = expected = false;
    text.remove_prefix(name.size());
  }
  if (expected) throw std::invalid_argument("a unit is missing at the end");
  return unit;
}

PhysicalValue parse_quantity(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault == std::errc::result_out_of_range) throw std::invalid_argument("the number is too large or too small");
  if (fault != std::errc()) throw std::invalid_argument("it does not begin with a number");
  const PhysicalValue unit = parse_unit(text.substr(end - text.data()));
  return {number * unit.value, unit.dimension};
}

}  // namespace lamella
