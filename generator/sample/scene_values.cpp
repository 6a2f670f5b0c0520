#include "generator/sample/scene_values.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "generator/sample/units.h"

namespace lamella {
namespace {

std::string wrong_kind(const Value& value, const std::string& right) {
  return fmt::format("is {}; give {}", value.kind_name(), right);
}

std::string number_wanted(const std::string& unit) {
  if (unit.empty() || unit == "1") return "a number, such as 0.05 or \"5 %\"";
  return fmt::format("a number in {0}, or a string with a unit, such as \"1 {0}\"", unit);
}

std::string out_of_range(const std::string& shown, const Demand& demand) {
  return fmt::format("{} is out of range; give a value {}", shown, demand.range.text(demand.unit));
}

template <class T>
std::string take_whole(const Value& value, const Demand& demand, T& out, double largest) {
  if (value.kind != Value::Kind::integer) return wrong_kind(value, "a whole number");
  if (!demand.range.contains(value.number) || value.number > largest)
    return out_of_range(std::to_string(value.integer), demand);
  out = static_cast<T>(value.integer);
  return "";
}

/// Number of insertions, deletions and replacements from one word to the other.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

/// A key as it is shown: whatever a hostile file calls its keys, the message stays short and on one line.
std::string shown(const std::string& word) {
  std::string out = word.substr(0, 40);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return word.size() > 40 ? out + "..." : out;
}

}  // namespace

std::string take(const Value& value, const Demand& demand, double& out) {
  double number = value.number;
  std::string text = fmt::format("{:g}", number);
  if (value.kind == Value::Kind::text) {
    text = fmt::format("\"{}\"", shown(value.text));
    try {
      const PhysicalValue quantity = parse_quantity(value.text);
      if (quantity.dimension != parse_unit(demand.unit).dimension)
        return fmt::format("{} is of another dimension; give {}", text, number_wanted(demand.unit));
      number = quantity.value;
    } catch (const std::invalid_argument& fault) {
      return fmt::format("{} is no quantity: {}; give {}", text, fault.what(), number_wanted(demand.unit));
    }
  } else if (value.kind != Value::Kind::number && value.kind != Value::Kind::integer) {
    return wrong_kind(value, number_wanted(demand.unit));
  }
  if (!std::isfinite(number)) return fmt::format("{} is not finite; give {}", text, number_wanted(demand.unit));
  if (!demand.range.contains(number)) return out_of_range(text, demand);
  out = number;
  return "";
}

std::string take(const Value& value, const Demand& demand, int& out) { return take_whole(value, demand, out, 2e9); }
std::string take(const Value& value, const Demand& demand, std::uint64_t& out) {
  return take_whole(value, demand, out, 9.3e18);
}

std::string take(const Value& value, const Demand&, bool& out) {
  if (value.kind != Value::Kind::boolean) return wrong_kind(value, "true or false");
  out = value.boolean;
  return "";
}

std::string take(const Value& value, const Demand& demand, std::string& out) {
  const auto& choices = demand.choices;
  if (value.kind != Value::Kind::text)
    return wrong_kind(
        value, choices.empty() ? std::string("a string") : fmt::format("one of \"{}\"", joined(choices, "\", \"")));
  if (!choices.empty() && std::find(choices.begin(), choices.end(), value.text) == choices.end())
    return fmt::format("\"{}\" is not known;{}", shown(value.text), suggestion(value.text, choices));
  if (value.text.empty()) return "is empty; leave it out, or give a text";
  out = value.text;
  return "";
}

std::string take(const Value& value, const Demand& demand, Vec2& out) {
  if (value.kind != Value::Kind::array || value.items.size() != 2) return wrong_kind(value, "a pair [x, y]");
  Demand second = demand;
  if (!demand.unit_of_second.empty()) second.unit = demand.unit_of_second;
  for (int c = 0; c < 2; ++c)
    if (std::string fault = take(value.items[c], c == 0 ? demand : second, out[c]); !fault.empty()) return fault;
  return "";
}

std::string take(const Value& value, const Demand& demand, Box& out) {
  if (value.kind != Value::Kind::array || value.items.size() != 4)
    return wrong_kind(value, "four numbers [x0, y0, x1, y1]");
  double* const numbers[4] = {&out.lo.x(), &out.lo.y(), &out.hi.x(), &out.hi.y()};
  for (int k = 0; k < 4; ++k)
    if (std::string fault = take(value.items[k], demand, *numbers[k]); !fault.empty()) return fault;
  if ((out.lo.array() > out.hi.array()).any()) return "has x0 > x1 or y0 > y1; the lower left corner comes first";
  return "";
}

std::string take(const Value& value, const Demand& demand, std::vector<Vec2>& out) {
  if (value.kind != Value::Kind::array || value.items.empty()) return wrong_kind(value, "pairs [[x, y], [x, y], ...]");
  out.assign(value.items.size(), Vec2::Zero());
  for (std::size_t k = 0; k < out.size(); ++k)
    if (std::string fault = take(value.items[k], demand, out[k]); !fault.empty())
      return fmt::format("entry {}: {}", k, fault);
  return "";
}

std::string take(const Value& value, const Demand& demand, std::vector<int>& out) {
  if (value.kind != Value::Kind::array || value.items.empty()) return wrong_kind(value, "whole numbers [0, 3, ...]");
  out.assign(value.items.size(), 0);
  for (std::size_t k = 0; k < out.size(); ++k)
    if (std::string fault = take(value.items[k], demand, out[k]); !fault.empty())
      return fmt::format("entry {}: {}", k, fault);
  return "";
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const std::string* nearest = nullptr;
  // Two letters swapped are two replacements; what is further off is another word.
  std::size_t distance = std::clamp<std::size_t>((word.size() + 1) / 3, 1, 3) + 1;
  if (word.size() <= 60)
    for (const std::string& candidate : known)
      if (const std::size_t d = edit_distance(word, candidate); d < distance) distance = d, nearest = &candidate;
  if (nearest) return fmt::format(" did you mean \"{}\"?", *nearest);
  return known.empty() ? "" : fmt::format(" known: {}", joined(known, ", "));
}

void refuse_unknown(const Value& table, const std::string& path, const std::vector<std::string>& known,
                    Faults& faults) {
  for (const Member& member : table.members)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      faults.add(member.value, dotted(path, shown(member.key)), "unknown key;" + suggestion(member.key, known));
}

}  // namespace lamella
