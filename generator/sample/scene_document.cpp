#include "generator/sample/scene_document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

/// Nested deeper than any scene, and still harmless to walk through recursively.
constexpr int kDeepestKey = 16;

Value from_toml(const toml::node& node, const std::string& setting) {
  Value value;
  value.line = static_cast<int>(node.source().begin.line);
  value.setting = setting;
  if (const auto* table = node.as_table()) {
    for (const auto& [key, member] : *table)
      value.members.push_back({std::string(key.str()), from_toml(member, setting)});
    std::stable_sort(value.members.begin(), value.members.end(),
                     [](const Member& a, const Member& b) { return a.value.line < b.value.line; });
  } else if (const auto* array = node.as_array()) {
    value.kind = Value::Kind::array;
    for (const auto& item : *array) value.items.push_back(from_toml(item, setting));
  } else if (const auto* text = node.as_string()) {
    value.kind = Value::Kind::text;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = Value::Kind::integer;
    value.integer = integer->get();
    value.number = static_cast<double>(value.integer);
  } else if (const auto* number = node.as_floating_point()) {
    value.kind = Value::Kind::number;
    value.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.kind = Value::Kind::boolean;
    value.boolean = boolean->get();
  } else {
    value.kind = Value::Kind::date;
  }
  return value;
}

/// Skips a string or a comment that starts at `i`; returns the index after it, or `i` when none starts there.
std::size_t after_string_or_comment(const std::string& text, std::size_t i) {
  if (text[i] == '#') return std::min(text.find('\n', i), text.size());
  if (text[i] != '"' && text[i] != '\'') return i;
  const std::string quote(text.compare(i, 3, std::string(3, text[i])) == 0 ? 3 : 1, text[i]);
  for (std::size_t k = i + quote.size(); k < text.size(); ++k) {
    if (text[i] == '"' && text[k] == '\\') {
      ++k;
    } else if (text.compare(k, quote.size(), quote) == 0) {
      return k + quote.size();
    } else if (quote.size() == 1 && text[k] == '\n') {
      return k;
    }
  }
  return text.size();
}

/// A key like a.a.a.a... makes a table for every dot, and a tree that deep overflows the stack. The TOML library limits
/// the depth of arrays and inline tables, not that of keys. Returns the line of such a key, 0 when there is none.
int line_of_endless_key(const std::string& text) {
  int line = 1, dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t after = after_string_or_comment(text, i);
    if (after > i) {
      line += static_cast<int>(std::count(text.begin() + i, text.begin() + after, '\n'));
      i = after;
      continue;
    }
    const char c = text[i++];
    if (c == '\n') ++line;
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}') dots = 0;
    if (c == '.' && ++dots > kDeepestKey) return line;
  }
  return 0;
}

bool names_its_entries(const Value& array) {
  return array.kind == Value::Kind::array && !array.items.empty() &&
         std::all_of(array.items.begin(), array.items.end(),
                     [](const Value& item) { return item.is_table() && item.find("name"); });
}

Value* entry(Value& array, const std::string& part) {
  for (Value& item : array.items)
    if (const Value* name = item.find("name"); name && name->text == part) return &item;
  if (part.empty() || part.size() > 6 || part.find_first_not_of("0123456789") != std::string::npos) return nullptr;
  const std::size_t index = std::stoul(part);
  return index < array.items.size() ? &array.items[index] : nullptr;
}

/// The text behind `=`, as TOML where it is, else as a string.
Value setting_value(const std::string& text, const std::string& setting) {
  Value value;
  if (!line_of_endless_key(text)) {
    try {
      const toml::table table = toml::parse("value = " + text);
      if (table.size() == 1) {
        value = from_toml(*table.get("value"), setting);
        return value;
      }
    } catch (const toml::parse_error&) {
      // bare words
    }
  }
  value.kind = Value::Kind::text;
  value.text = text;
  value.setting = setting;
  return value;
}

void remove_contradicted(Value& lower, const Value& upper) {
  const auto any = [&](const std::vector<std::string>& keys) {
    return std::any_of(keys.begin(), keys.end(), [&](const std::string& key) { return upper.find(key) != nullptr; });
  };
  for (const Alternative& way : alternatives()) {
    const bool one = any(way.one), other = any(way.other);
    if (one == other) continue;
    for (const std::string& key : one ? way.other : way.one) lower.erase(key);
  }
}

Value merged_entries(const Value& lower, const Value& upper) {
  Value out = lower;
  for (const Value& item : upper.items) {
    Value* below = nullptr;
    for (Value& candidate : out.items)
      if (candidate.find("name")->text == item.find("name")->text) below = &candidate;
    if (below) {
      *below = merged(*below, item);
    } else {
      out.items.push_back(item);
    }
  }
  return out;
}

}  // namespace

const Value* Value::find(const std::string& key) const {
  for (const Member& member : members)
    if (member.key == key) return &member.value;
  return nullptr;
}

Value* Value::find(const std::string& key) { return const_cast<Value*>(std::as_const(*this).find(key)); }

void Value::erase(const std::string& key) {
  std::erase_if(members, [&](const Member& member) { return member.key == key; });
}

const char* Value::kind_name() const {
  switch (kind) {
    case Kind::text:
      return "a string";
    case Kind::number:
      return "a number";
    case Kind::integer:
      return "a whole number";
    case Kind::boolean:
      return "true or false";
    case Kind::array:
      return "an array";
    case Kind::table:
      return "a table";
    case Kind::date:
      break;
  }
  return "a date or time";
}

void Faults::add(const Value& at, const std::string& key, const std::string& what) {
  const std::string place = at.setting.empty() ? fmt::format("{}:{}", file_, std::max(1, at.line)) : at.setting;
  const auto last_part = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
  for (const Fault& fault : faults_)
    if (fault.place == place && fault.what == what && last_part(fault.key) == last_part(key)) return;
  faults_.push_back({at.setting.empty() ? at.line : 0, place, key, what});
}

void Faults::raise() const {
  if (faults_.empty()) return;
  auto sorted = faults_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Fault& a, const Fault& b) { return a.line < b.line; });
  std::vector<std::string> lines;
  for (const Fault& fault : sorted)
    lines.push_back(fmt::format("{}: {}{}{}", fault.place, fault.key, fault.key.empty() ? "" : ": ", fault.what));
  throw SceneError(std::move(lines));
}

Value parse_document(const std::string& text, const std::string& name) {
  if (const int line = line_of_endless_key(text))
    throw SceneError(
        fmt::format("{}:{}: a key of more than {} parts; sections go two or three deep", name, line, kDeepestKey));
  try {
    return from_toml(toml::parse(text), "");
  } catch (const toml::parse_error& fault) {
    throw SceneError(fmt::format("{}:{}: not TOML: {}", name, std::max(1u, fault.source().begin.line),
                                 std::string(fault.description())));
  }
}

void apply_setting(Value& root, const std::string& setting, Faults& faults) {
  const std::size_t equals = setting.find('=');
  Value at;
  at.setting = "--set " + setting;
  if (equals == std::string::npos || equals == 0)
    return faults.add(at, "", "not of the form key=value; for instance --set loading.strain=0.2");
  std::string path = setting.substr(0, equals);
  path.erase(std::remove(path.begin(), path.end(), ' '), path.end());
  if (std::count(path.begin(), path.end(), '.') > kDeepestKey)
    return faults.add(at, "", "the key is nested too deep; sections go two or three deep");

  Value* table = &root;
  for (std::size_t dot; (dot = path.find('.')) != std::string::npos; path.erase(0, dot + 1)) {
    const std::string part = path.substr(0, dot);
    Value* next = table->find(part);
    if (table->kind == Value::Kind::array) {
      next = entry(*table, part);
      if (!next)
        return faults.add(at, "", fmt::format("no entry \"{}\" there; give its name, or its number from 0", part));
    } else if (!next) {
      Value section;
      section.setting = at.setting;
      table->members.push_back({part, section});
      next = &table->members.back().value;
    }
    if (!next->is_table() && next->kind != Value::Kind::array)
      return faults.add(at, "", fmt::format("\"{}\" is {}, not a section", part, next->kind_name()));
    table = next;
  }
  if (!table->is_table()) return faults.add(at, "", "names a whole entry of a list; name one of its keys");
  Value upper;
  upper.members.push_back({path, setting_value(setting.substr(equals + 1), at.setting)});
  *table = merged(*table, upper);
}

Value merged(const Value& lower, const Value& upper) {
  if (names_its_entries(lower) && names_its_entries(upper)) return merged_entries(lower, upper);
  if (!lower.is_table() || !upper.is_table()) return upper;
  Value out = lower;
  remove_contradicted(out, upper);
  for (const Member& member : upper.members) {
    Value* below = out.find(member.key);
    if (below) {
      *below = merged(*below, member.value);
    } else {
      out.members.push_back(member);
    }
  }
  return out;
}

const std::vector<Alternative>& alternatives() {
  static const std::vector<Alternative> list{
      {{"young"}, {"axial_rigidity", "bending_rigidity"}},
      {{"density"}, {"mass_per_length"}},
      {{"yield_stress"}, {"yield_force", "yield_moment"}},
      {{"break_stress"}, {"break_force", "break_strain"}},
      {{"break_force"}, {"break_strain"}},
      {{"modulus"}, {"stiffness_ratio"}},
      {{"strain_rate"}, {"speed"}},
      {{"spacing"}, {"segments"}},
      {{"step_fraction"}, {"time_step"}},
      {{"count"}, {"file"}},
  };
  return list;
}

}  // namespace lamella
