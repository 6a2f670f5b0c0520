// What every force of the model is: an energy, its gradient, its stiffness and its history. Generic, over the whole system:
// the form that the tests, the time step and later the implicit steppers use.
#pragma once
#include <Eigen/Core>
#include <string>

#include "generator/sample/sample.h"
#include "simulator/positions.h"
#include "simulator/trajectory/trajectory.h"

namespace lamella {

/// Receives the 2 x 2 blocks d2W / dx_i dx_j of a stiffness, both (i, j) and (j, i), element by element (not yet summed).
/// One sink adds them into a sparse matrix, another into row sums, another multiplies by a vector.
class StiffnessSink {
 public:
  virtual ~StiffnessSink() = default;
  virtual void add(Index i, Index j, const Eigen::Matrix2d& block) = 0;
  /// What follows, up to the next call, is the stiffness of elements of this cell (of a link: the cell of its node a; each element always belongs to
  /// the same one). Returns whether it is wanted; if not, it is left out.
  virtual bool begin_elements(Index /*cell*/) { return true; }
};

class Term {
 public:
  virtual ~Term() = default;
  virtual std::string name() const = 0;

  /// Potential of the forces at x, with the history frozen at the last commit [J]. For a plastic or frictional term it is the
  /// incremental potential: stored plus what the move from the last commit dissipates.
  virtual double energy(const Field& x) const = 0;
  /// f -= d(energy)/dx [N].
  virtual void add_force(const Field& x, Field& f) const = 0;
  /// d2(energy)/dx2 [N/m], element by element, where the sink wants them.
  virtual void add_stiffness(const Field& x, StiffnessSink& sink) const = 0;
  /// Moves the history (plastic lengths and angles, friction anchors, damage) to x. The only place where history moves.
  virtual void commit(const Field&) {}

  /// History arrays, under names of their own, and back. Together they make a restart bitwise.
  virtual void save(ArraySet&) const {}
  virtual void restore(const ArraySet&) {}
  /// Columns of a frame (docs/formats.md), at x.
  virtual void add_output(const Field&, ArraySet&) const {}
  /// Memory that the term holds [bytes].
  virtual std::size_t bytes() const { return 0; }
};

}  // namespace lamella
