// The numbers of a run, each with unit and definition: written once here, shown in summary.json and in the report.
#pragma once
#include <string>
#include <vector>

#include "simulator/trajectory/trajectory.h"

namespace lamella {

struct Quantity {
  std::string key;  // snake_case
  double value = 0;
  std::string unit;
  std::string definition;
};

/// Groups in order of appearance: "test", "fracture", "accuracy", "sample", "run".
struct Summary {
  struct Group {
    std::string name;
    std::vector<Quantity> quantities;
  };
  std::vector<Group> groups;
  std::vector<std::string> warnings;

  void add(const std::string& group, Quantity quantity);
  const Quantity* find(const std::string& key) const;
};

/// `files` are listed by name.
std::string summary_json(const Summary& summary, const Provenance& provenance, const std::string& ended,
                         const std::vector<std::string>& files);

/// Names of columns carry their units, as in `stress [Pa]`.
std::string response_csv(const Response& response);
/// With bars, a column says which one broke (-1: a link did).
enum class Breaks { kLinks, kLinksAndBars };
std::string events_csv(const std::vector<Event>& events, Breaks breaks);

}  // namespace lamella
