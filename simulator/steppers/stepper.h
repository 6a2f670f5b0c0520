// What takes a state from one time to the next: what the driver of a stage in time needs to know of a scheme.
#pragma once
#include <vector>

#include "simulator/loads.h"
#include "simulator/model.h"

namespace lamella {

struct State {
  Field x;          // positions at `time` [m]
  Field v;          // velocities half a step before [m/s]
  double time = 0;  // [s]
  std::int64_t step = 0;
};

/// What left the mechanical energy, or entered it, since the stepper was made [J].
struct Works {
  double loads = 0;  // work of grips and prescribed forces
  double pressure =
      0;  // of pressures that were held in cells that have opened; that of a pressure's change is booked by who changes it
  double damping = 0;  // drag, dashpots, contact damping
  double friction = 0;
  double plastic = 0;
  double fracture = 0;
};

/// A configuration weighed on the way through it. Everything refers to the start of the step.
struct Measurement {
  Works works;
  double kinetic = 0;            // 1/2 m v(n-1/2) . v(n+1/2) [J]
  std::vector<Vec2> load_force;  // what each load exerts on the sample, its nodes' inertia apart [N]
  double unbalanced = 0;         // largest force F on a free node: F / (F + root mean square section force) [1]
};

class Stepper {
 public:
  virtual ~Stepper() = default;

  /// One step. `kick` is the mean of the last step and this one where the step changes, else dt. Throws SolverError where an implicit
  /// step finds no solution.
  virtual void step(double dt, double kick) = 0;
  /// One step, weighed. `force_on_node` receives what loads exert on each node, where wanted.
  virtual Measurement measured_step(double dt, double kick, Field* force_on_node) = 0;

  /// Breaks since the last call, in order of time, then link.
  virtual std::vector<Break> take_breaks() = 0;
  virtual std::vector<WallBreak> take_wall_breaks() = 0;
  /// Nodes of which both components are prescribed.
  virtual const std::vector<std::uint8_t>& fully_held() const = 0;
  /// Where in a step loads push as hard as they do in it: 0 at its beginning, 1 at its end.
  virtual double push_time() const { return 0; }
  /// Whether steps longer than the stable limit of an explicit scheme are allowed.
  virtual bool implicit() const { return false; }

  /// Forgets what a run that goes on from here could not know.
  virtual void forget() {}

  virtual void save(ArraySet& restart) const = 0;
  virtual void restore(const ArraySet& restart) = 0;
};

}  // namespace lamella
