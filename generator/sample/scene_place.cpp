#include "generator/sample/scene_place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "generator/sample/scene_document.h"

namespace lamella {
namespace {

/// The parts of the key of [sample] that the fault begins with: "sample.domain.holes[1].radius = 3" has five.
std::vector<std::string> key_of(const std::string& fault) {
  const std::string of_key = "abcdefghijklmnopqrstuvwxyz_0123456789";
  std::vector<std::string> parts;
  for (std::size_t at = 0; at < fault.size();) {
    const std::size_t end = std::min(fault.find_first_not_of(of_key, at), fault.size());
    if (end == at) break;
    parts.push_back(fault.substr(at, end - at));
    at = end;
    if (at < fault.size() && fault[at] == ']') ++at;
    if (at >= fault.size() || (fault[at] != '.' && fault[at] != '[')) break;
    ++at;
  }
  if (!parts.empty() && parts.front() != "sample") parts.clear();  // a word, such as "cells 3 and 4 cross"
  return parts;
}

const Value* member_of(const Value& of, const std::string& part) {
  if (of.kind != Value::Kind::array) return of.find(part);
  const bool is_number = part.find_first_not_of("0123456789") == std::string::npos;
  const auto k = is_number ? std::strtoull(part.c_str(), nullptr, 10) : of.items.size();
  return k < of.items.size() ? &of.items[k] : nullptr;
}

std::string place_of(const std::string& fault, const Value& root, const std::string& file) {
  const Value* at = &root;
  std::string place;
  for (const std::string& part : key_of(fault)) {
    at = member_of(*at, part);
    if (!at) break;
    if (!at->setting.empty())
      place = at->setting;
    else if (at->line > 0)
      place = fmt::format("{}:{}", file, at->line);
  }
  return place;
}

}  // namespace

std::vector<std::string> with_places(const Scene& scene, std::vector<std::string> faults) {
  const std::string file = scene.path.string();
  Value root = parse_document(scene.text, file);
  Faults unread(file);
  for (const std::string& setting : scene.overrides) apply_setting(root, setting, unread);
  for (std::string& fault : faults)
    if (const std::string place = place_of(fault, root, file); !place.empty()) fault = place + ": " + fault;
  return faults;
}

}  // namespace lamella
