// A model: the terms that a stage of a scene asks for, over one sample. What a scene does not name is a null pointer here, and costs nothing.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "generator/sample/sample.h"
#include "generator/sample/scene.h"
#include "simulator/contact/contacts.h"
#include "simulator/shells.h"
#include "simulator/terms/bars.h"
#include "simulator/terms/cohesive_links.h"
#include "simulator/terms/core.h"
#include "simulator/terms/dashpots.h"
#include "simulator/terms/gravity.h"
#include "simulator/terms/hinges.h"
#include "simulator/terms/wall_rupture.h"

namespace lamella {

/// Drained pressure that follows a history: (time [s], pressure [Pa]), linear between.
struct PressureHistory {
  Index cell = 0;
  const std::vector<Vec2>* points = nullptr;

  double at(double time) const;  // [Pa]
};

struct Model {
  explicit Model(const Sample& s) : sample(s), layout(s) {}
  Model(const Model&) = delete;

  const Sample& sample;
  ShellLayout layout;
  std::vector<double> mass, inverse_mass;  // of the nodes, and of the box where it moves [kg], [1/kg]

  std::unique_ptr<Bars> bars;
  std::unique_ptr<Hinges> hinges;
  std::unique_ptr<Core> core;
  std::unique_ptr<CohesiveLinks> links;
  std::unique_ptr<Contacts> contacts;
  std::unique_ptr<Gravity> gravity;
  std::unique_ptr<Dashpots> dashpots;
  std::unique_ptr<WallRupture> rupture;
  double drag_rate = 0;        // [1/s]; 0: no drag
  double contact_damping = 0;  // fraction of critical; 0: none
  double friction = 0;         // mu; 0: none
  std::vector<PressureHistory> pressure_histories;

  /// The terms that are there, in a fixed order.
  std::vector<Term*> terms() const;
  /// Terms inside cells, in the order in which a block adds them.
  std::vector<ShellTerm*> shell_terms() const;
  /// Of all terms at x [J].
  double energy(const Field& x) const;
  /// Of all terms at x [N/m]; see Term.
  void add_stiffness(const Field& x, StiffnessSink& sink) const;
  /// Whether any wall can flow; what that has dissipated so far [J].
  bool yields() const;
  double plastic_dissipated() const;
  /// This link has just broken at x, at that time [s]: contact takes its pair over. Takes from the energy of the break what contact and
  /// its friction springs hold beyond what the link has left to them.
  void hand_over(Break& event, const Field& x, double time);
  /// Walls that break from now on, or are broken (restored) though the stage has no strengths. After all terms are there.
  void add_rupture(const WallStrength& strength);
  std::size_t bytes() const;
};

/// The table "this section of the scene makes this term"; nothing else decides what is simulated. `x` are the positions at which
/// the stage starts. Throws SceneError for parameters that the sample cannot take.
std::unique_ptr<Model> build_model(const Sample& sample, const Stage& stage, const Field& x);

}  // namespace lamella
