// Where the work went: the energy ledger of the response curve, row by row.
#pragma once
#include <string>
#include <vector>

#include "simulator/trajectory/trajectory.h"

namespace lamella {

/// Column of a response, by name; empty when there is none.
std::vector<double> response_column(const Response& response, const std::string& name);

struct EnergyBudget {
  struct Entry {
    std::string name;
    std::vector<double> value;  // [J], one per row
  };
  std::vector<double> time, work;
  std::vector<double> stored;  // sum of the terms' energies
  std::vector<Entry> terms;    // each term's stored energy
  std::vector<Entry> sinks;    // kinetic, damping, friction, plastic, fracture: those that the scene has
  double largest_work = 0;     // [J]
  double residual = 0;         // largest over the rows, as the run reported it [1]
};

EnergyBudget energy_budget(const Response& response);

}  // namespace lamella
