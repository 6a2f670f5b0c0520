// What can go wrong, and whose fault it is. The program turns each type into an exit status.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace lamella {

/// The user's input is wrong: a scene, an argument, an imported packing or tissue. Exit status 2.
/// Carries every fault found, each a line `file:line: what, and what would be right`.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::string fault) : SceneError(std::vector<std::string>{std::move(fault)}) {}
  explicit SceneError(std::vector<std::string> faults);
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  std::vector<std::string> faults_;
};

/// A file cannot be read or written, or is not what it claims to be: missing, truncated, wrong version. Exit status 4.
class DataError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The numerics gave up: a node inside another cell, a collapsed segment, a step that cannot be stable. Exit status 3.
/// The message names the time and the object.
class SolverError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The user interrupted the program (Ctrl-C); what was computed is on disk. Exit status 130.
class Interrupted : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lamella
