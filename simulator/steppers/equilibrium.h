// Finds where the model is at rest: the minimum of W(x) - f . x + 1/2 sum d (x - a)^2 over the free components, with history frozen. W is
// the energy of the terms, f are dead forces, and the last sum is what implicit steps in time add (d = m / dt^2); statics have none.
//
// Newton's method whose tangent is kept: a sparse Cholesky factor of an earlier stiffness, from which links that break are taken out as
// they do (low rank), gives the first direction; limited-memory BFGS updates bring what has changed since. Where that does not converge at once,
// the part of the factor that belongs to the cells that have turned meanwhile is made anew, with all that depends on it: after a break these are
// few. All of it is made anew only where that does not do. Where the stiffness is not positive definite it is shifted until it is, so that every direction goes
// downhill; a line search on the slope along it makes every step one.
#pragma once
#include <deque>

#include "simulator/assembly.h"
#include "simulator/solver_cost.h"
#include "simulator/steppers/sparse_factor.h"

namespace lamella {

class EquilibriumSolver {
 public:
  /// `loads`: only which components they hold matters.
  EquilibriumSolver(Model& model, const std::vector<Load>& loads);

  /// Forces that do not depend on the positions [N].
  void set_dead_forces(const Field& f);
  /// d [N/m] of each node, and a [m]; both of relative coordinates, where a box moves (moving_box.h). Empty: statics.
  void set_anchors(std::vector<double> stiffness, Field positions);

  /// Moves the free components of x to rest. Converged: the largest force that is left is below `tolerance` times the largest internal
  /// force. Returns whether it is; if not, x is as it was.
  bool relax(Field& x, double tolerance);
  /// How far the last search has come, if it has failed.
  const Field& reached() const { return reached_; }
  /// At the end of the last search: the largest force that is left over the largest internal force; the node that has it.
  double residual() const { return residual_; }
  Index worst_node() const { return worst_node_; }
  /// The largest internal force: of the walls' sections and dead forces [N].
  double internal_force() const { return scale_; }
  /// Forces of all terms and dead forces at the end of the last search; on what is held, the opposite of what loads exert [N].
  const Field& force() const { return f_; }

  /// The first-order motion of the free components for the force that is left at x: K^-1 f. Makes a factor at x where there is none.
  const Eigen::VectorXd& response(const Field& x, const Eigen::VectorXd& f);
  /// All forces at x, but for those of anchors; `free` receives those on free components.
  void evaluate(const Field& x, Eigen::VectorXd& free);
  /// One iteration of Newton's method with an unknown load: K dx - f_t dt = f and c . dx = c_left (bordered_newton.cpp). `f`: what is left at
  /// x; `f_t`: its change with time [N/s]. Returns false where there is no solution.
  bool bordered_step(const Field& x, const Eigen::VectorXd& f, const Eigen::VectorXd& f_t, const Eigen::VectorXd& c,
                     double c_left, Eigen::VectorXd& dx, double& dt);
  /// Whether the stiffness at x is positive definite.
  bool holds_at(const Field& x);
  /// The largest of the forces that `evaluate` has left over the largest internal force.
  double measure(const Eigen::VectorXd& f);
  /// What a search minimises [J].
  double potential(const Field& x) const;
  const FreeComponents& free() const { return free_; }
  /// Of all walls [m].
  double mean_segment() const { return length_; }

  /// This link is about to break: takes its stiffness out of the factor.
  void drop_link(Index link);
  /// The factor is of another system: the next search makes one.
  void drop_factor() { factored_ = false; }
  /// Forgets all that searches have learnt: pattern, factor, shifts. What follows depends on x and the model alone, and not on how they
  /// were come by.
  void forget();
  const SolverCost& cost() const { return cost_; }
  /// What made the last search fail.
  const std::string& failure() const { return failure_; }

 private:
  void evaluate_all(const Field& x, Eigen::VectorXd& free);
  double noise(double height) const;
  Vec2 from_anchor(const Field& x, std::size_t node) const;
  void couple_anchors(StiffnessSink& sink) const;
  void assemble(const Field& x);
  void refactor(const Field& x);
  /// The same for the cells alone that have turned or stretched since their part was made, where that is less work. Returns whether there is a
  /// new factor; a failed try may leave none.
  bool refactor_turned(const Field& x);
  std::vector<std::uint8_t> turned_cells(const Field& x) const;
  bool holds_lost(const Eigen::VectorXd& step);
  /// Of a rest at which the factor was just made: a larger shift than rounding asks for is one over a saddle, and where there may be saddles
  /// what is held as loose may hide one.
  bool is_minimum() const { return shift_ <= 1e-9 && (!barriers_ || loose_.isZero(0)); }
  bool rush(Field& x, double tolerance);
  bool leave_saddle(Field& x, double height);
  Eigen::VectorXd tangent_solution(const Eigen::VectorXd& f);
  double allowed_share(const Field& x, const Eigen::VectorXd& step);
  Eigen::VectorXd direction(const Eigen::VectorXd& f);
  void follow_contacts(const Field& x);

  Model& model_;
  std::vector<Term*> other_terms_;  // all but shell terms
  std::vector<ShellTerm*> shell_terms_;
  FreeComponents free_;
  StiffnessMatrix stiffness_;
  SparseFactor factor_;
  ShellScratch scratch_;
  Field dead_, anchor_, f_;
  double largest_dead_ = 0;  // its square [N^2]
  std::vector<double> anchor_stiffness_;
  bool analyzed_ = false, factored_ = false;
  bool barriers_ =
      false;  // links soften: there is more than one minimum, and a search goes to none that lies higher than its start
  Field reached_;
  Field factor_x_;         // of the nodes of each cell: where its part of the factor was made
  double largest_ = 0;     // entry on its diagonal
  Eigen::VectorXd loose_;  // shift of each row beside shift_, where next to nothing holds it
  std::vector<Index> cell_of_;
  std::vector<std::uint8_t> dropped_;  // per cell: links of it have been taken out of the factor since it was made
  double shift_ = 0;                   // of the last factor, over the largest diagonal
  double scale_ = 0, residual_ = 0;
  double length_ = 0;    // mean segment [m]
  double rounding_ = 0;  // force below which nothing can be told [N]
  Index worst_node_ = 0;
  struct Pair {
    Eigen::VectorXd s, y;
    double rho = 0;
  };
  std::deque<Pair> pairs_;
  SolverCost cost_;
  std::string failure_;
};

}  // namespace lamella
