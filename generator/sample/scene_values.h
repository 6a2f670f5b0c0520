// From the values of a scene file to numbers in SI, words and points, as a row demands them.
#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

#include "generator/sample/scene_document.h"
#include "generator/sample/scene_rows.h"

namespace lamella {

/// What a row demands of its value.
struct Demand {
  std::string unit, unit_of_second;
  Range range;
  std::vector<std::string> choices;
};

// Each puts the value into `out`, or returns what is wrong and what would be right; "" when all is well.
std::string take(const Value& value, const Demand& demand, double& out);
std::string take(const Value& value, const Demand& demand, int& out);
std::string take(const Value& value, const Demand& demand, std::uint64_t& out);
std::string take(const Value& value, const Demand& demand, bool& out);
std::string take(const Value& value, const Demand& demand, std::string& out);
std::string take(const Value& value, const Demand& demand, Vec2& out);
std::string take(const Value& value, const Demand& demand, Box& out);
std::string take(const Value& value, const Demand& demand, std::vector<Vec2>& out);
std::string take(const Value& value, const Demand& demand, std::vector<int>& out);
template <class T>
std::string take(const Value& value, const Demand& demand, std::optional<T>& out) {
  T inner{};
  std::string fault = take(value, demand, inner);
  if (fault.empty()) out = inner;
  return fault;
}

/// Words in a row.
std::string joined(const std::vector<std::string>& words, const std::string& between);

/// " did you mean ...?" for the nearest of the known words, else the list of them.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

/// Faults for members of the table whose key is not known.
void refuse_unknown(const Value& table, const std::string& path, const std::vector<std::string>& known, Faults& faults);

inline std::string dotted(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

/// Reads the rows of S from a table into `out`. `others` are keys that the caller reads: sections inside this one.
template <class S>
void read_section(const Value& table, const std::string& path, S& out, Faults& faults,
                  const std::vector<std::string>& others = {}) {
  if (!table.is_table())
    return faults.add(table, path, fmt::format("is {}; it is a section of keys, [{}]", table.kind_name(), path));
  std::vector<std::string> known;
  for (const auto& row : rows<S>()) known.emplace_back(row.key);
  known.insert(known.end(), others.begin(), others.end());
  refuse_unknown(table, path, known, faults);
  const Value* per = table.find("per");
  for (const auto& row : rows<S>()) {
    const Value* value = table.find(row.key);
    const bool per_link = per && per->text == "link" && *row.unit_per_link;
    const Demand demand{per_link ? row.unit_per_link : row.unit, row.unit_of_second, row.range, row.choices};
    if (!value) {
      if (row.required)
        faults.add(table, dotted(path, row.key),
                   fmt::format("missing; {}{}", row.sentence, demand.unit.empty() ? "" : " [" + demand.unit + "]"));
      continue;
    }
    const std::string fault = std::visit([&](auto member) { return take(*value, demand, out.*member); }, row.member);
    if (!fault.empty()) faults.add(*value, dotted(path, row.key), fault);
  }
}

}  // namespace lamella
