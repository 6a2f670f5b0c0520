#include "generator/sample/errors.h"

namespace lamella {
namespace {
std::string joined(const std::vector<std::string>& faults) {
  std::string text;
  for (const auto& fault : faults) text += (text.empty() ? "" : "\n") + fault;
  return text;
}
}  // namespace

SceneError::SceneError(std::vector<std::string> faults)
    : std::runtime_error(joined(faults)), faults_(std::move(faults)) {}

}  // namespace lamella
