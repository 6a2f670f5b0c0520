// [stop]: when a stage ends, whatever steps it.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/sample/scene.h"
#include "simulator/loads.h"
#include "simulator/model.h"

namespace lamella {

/// Parts of the sample that shells and intact links hold together: a number for each node, the same within a part.
std::vector<Index> parts_of(const Model& model);

/// Whether shells and intact links join a periodic sample to its own images along x (0) or y (1): whether some path goes round the box.
bool joined_round(const Model& model, int axis);

/// The name of a load whose force acts, along x or y, on a part of which no node is held in that direction, if there is one: such a part
/// can come to rest nowhere, unless contact stops it.
std::optional<std::string> unheld_load(const Model& model, const std::vector<Load>& loads);

class StopConditions {
 public:
  /// `x`: where the stage starts. Throws SceneError where a condition needs walls that the sample does not have. All but `loads`' forces
  /// are copied or outlive this.
  StopConditions(const Stage& stage, const Model& model, const std::vector<Load>& loads, const Field& x);

  /// What conditions refer to.
  struct Now {
    double since = 0;   // time of the stage [s]
    double stress = 0;  // [Pa]
    int broken = 0;     // links and bars
    double unbalanced = 0;
    bool first = false;                 // nothing has been done yet
    std::vector<Vec2> load_force;       // of each load [N]
    std::optional<std::string> packed;  // by `packed`
  };
  /// Why the stage ends now, if it does. Remembers the largest stress.
  std::optional<std::string> reason(const Now& now);
  /// The condition of the room between the walls that holds at x. Throws SolverError where no room is left.
  std::optional<std::string> packed(const Field& x, double time) const;

  /// For restarts.
  struct History {
    double peak_stress = 0;  // [Pa]
    bool loosens = false;    // the stage began beyond stop.compaction, and ends when it has come back to it
  };
  const History& history() const { return history_; }
  void set_history(const History& history) { history_ = history; }

 private:
  double compaction(const Box& room) const { return 1 - room.area() / sample_room_; }
  bool separated() const;
  /// The axis along which the box is pulled, where it is.
  std::optional<int> pulled_box() const;

  const StopScene& stop_;
  const Model& model_;
  const std::vector<Load>& loads_;
  double sample_room_ = 0;  // between the walls, in the sample [m2]; 0: no condition asks
  History history_;
};

}  // namespace lamella
