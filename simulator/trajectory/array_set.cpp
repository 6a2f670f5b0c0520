#include <fmt/format.h>

#include <utility>

#include "generator/sample/errors.h"
#include "simulator/trajectory/trajectory.h"

namespace lamella {
namespace {

template <typename T>
const std::vector<T>& values(const NamedArray* array, const std::string& name, const char* type) {
  if (!array) throw DataError(fmt::format("array '{}' is missing", name));
  const auto* data = std::get_if<std::vector<T>>(&array->data);
  if (!data) throw DataError(fmt::format("array '{}' is of the wrong type; must hold {}", name, type));
  return *data;
}

}  // namespace

void ArraySet::add(NamedArray array) {
  if (find(array.name)) throw DataError(fmt::format("array '{}' is given twice; names must differ", array.name));
  arrays_.push_back(std::move(array));
}

const NamedArray* ArraySet::find(const std::string& name) const {
  for (const auto& array : arrays_)
    if (array.name == name) return &array;
  return nullptr;
}

const std::vector<double>& ArraySet::doubles(const std::string& name) const {
  return values<double>(find(name), name, "floating-point numbers");
}

const std::vector<std::int32_t>& ArraySet::ints(const std::string& name) const {
  return values<std::int32_t>(find(name), name, "32-bit integers");
}

const std::vector<std::int64_t>& ArraySet::longs(const std::string& name) const {
  return values<std::int64_t>(find(name), name, "64-bit integers");
}

}  // namespace lamella
