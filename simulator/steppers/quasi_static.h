// Fracture at rest: equilibrium under a slowly growing load, and the exact load of every break. Between breaks the load grows as far as the
// tangent says that the next link holds; then the most loaded link breaks, the load is held while equilibrium is found again, and so on
// while any link is beyond its criterion (the avalanche). What is released in between, which would become motion and then heat, is booked
// as such. Time only says where the loads are.
#pragma once
#include <functional>
#include <optional>

#include "simulator/load_path.h"
#include "simulator/steppers/equilibrium.h"

namespace lamella {

/// [run]: how well, and how.
struct QuasiStaticSettings {
  double residual = 1e-4;        // force that may be left, over the largest internal force
  double load_tolerance = 1e-4;  // of the criterion, at which a link counts as being at it
  bool all_at_once = false;      // every link beyond its criterion breaks before equilibrium is found again
  bool follow =
      false;  // an avalanche is followed by taking the load back to where one link after the other holds no more
  double longest = 0;  // step in time [s]
};

/// A break at rest.
struct BreakAtRest {
  Break link;                  // .link is -1 where a bar of a wall broke
  WallBreak wall;              // else not set
  std::int64_t avalanche = 0;  // from 0
  std::int64_t place = 0;      // in it, from 0
  double time = 0;             // of the stage [s]
  double released = 0;         // energy that was free to become motion when the sample fell to its next equilibrium [J]
};

/// Booked since the stepper was made [J].
struct StaticWorks {
  double loads = 0, pressure = 0, fracture = 0, released = 0;
};

class QuasiStatic {
 public:
  /// `x`: where the stage starts; held components go from there.
  QuasiStatic(Model& model, const std::vector<Load>& loads, const LoadPath& path, Field x, double start_time,
              const QuasiStaticSettings& settings);

  const Field& x() const { return x_; }
  /// Of the stage [s].
  double time() const { return time_; }

  /// Finds the first equilibrium, under the loads of the present time. Throws SolverError.
  void settle();
  /// One increment of load towards `end`, at most until a link reaches its criterion. `go_on` is asked on the way. Throws SolverError where no
  /// equilibrium is found.
  void load_towards(double end, const std::function<bool()>& go_on);
  /// A link is at its criterion: there is a break to come before the load may grow.
  bool critical() const { return critical_; }
  /// Breaks links at this load until all that are left hold. `go_on` is asked after each equilibrium. Where the settings say `follow`:
  /// breaks one, and takes the load back to where the next is at its criterion.
  void fall(const std::function<bool()>& go_on);

  /// Why the stage is over although it has not come to its end: nothing holds a load any more. Empty: it is not.
  const std::string& over() const { return over_; }

  /// Breaks since the last call.
  std::vector<BreakAtRest> take_breaks() { return std::exchange(breaks_, {}); }
  StaticWorks works() const;
  /// How often the sample fell to another branch of equilibria without a break.
  std::int64_t falls() const { return falls_; }
  /// What each load exerts on the sample [N], and on each node.
  std::vector<Vec2> load_forces() const;
  Field load_force_on_nodes() const;
  const EquilibriumSolver& solver() const { return solver_; }
  /// See EquilibriumSolver::forget.
  void forget();

  void save(ArraySet& restart) const;
  void restore(const ArraySet& restart);

 private:
  struct Held {
    Index node;
    int component;
    std::size_t load;
    double origin;  // [m]
  };
  Eigen::VectorXd first_motion(double increment);
  void take_back();
  void prescribe(double time, Field& x);
  bool try_at(double time, Field& x);
  /// Work of an increment, by the trapezoidal rule [J].
  struct StepWork {
    double loads = 0, pressure = 0;
    double turnover = 0;         // sum of what is done by each force, and of what is done against each
    std::vector<double> levers;  // of prescribed pressures, at its end [J/Pa]
  };
  StepWork work_to(double time, const Field& x) const;
  double surplus_at(double time, const Field& x, double& turnover) const;
  Field lower_start(double time, Field predicted);
  bool fall_to_rest(double time, Field x);
  bool leaps(double time, const Field& x);
  bool begins_too_far(const Field& x) const;
  std::vector<double> fronts() const;
  void remember();
  Eigen::VectorXd control() const;
  bool meet(const Eigen::VectorXd& c, double length, Field& x, double& time);
  bool softens_at(const Field& x);
  bool follow_branch(double end);
  void save_behind(ArraySet& restart) const;
  void restore_behind(const ArraySet& restart);
  void fall_or_give_up(double time, Field x);
  void accept(double time, Field x);
  Field pushes(double time) const;
  double criterion(const Field& x);
  void commit();
  bool hand_over_softened();
  void bring_to_rest();
  void break_most_loaded(std::int64_t place);
  void break_link(Index link, std::int64_t place);
  void break_wall(const WallRupture::Loaded& bar, std::int64_t place);
  void record(BreakAtRest event, std::int64_t place);
  void give_up(const std::string& what, double time);

  Model& model_;
  const std::vector<Load>& loads_;
  const LoadPath& path_;
  QuasiStaticSettings settings_;
  EquilibriumSolver solver_;
  std::vector<Held> held_;
  Field x_;
  Field dead_;                    // of the accepted configuration [N]
  Eigen::VectorXd work_;          // scratch
  std::vector<double> reaction_;  // on each of held_, at the accepted configuration [N]
  LinkForces link_work_;
  ShellScratch wall_work_;
  double start_time_ = 0, time_ = 0;
  double trusted_ = 0;         // increment of time that a search may ask for [s]
  double potential_ = 0;       // of the accepted configuration: energy less the work of dead forces [J]
  std::vector<double> lever_;  // of prescribed pressures, at the accepted configuration [J/Pa]
  bool dissipates_ = false;    // committing history lowers the potential: walls flow, or contacts rub
  std::string over_;
  double largest_turnover_ = 0;  // of one increment [J]
  std::int64_t falls_ = 0;
  // Where the load follows a branch: before the last increment.
  struct Behind {
    Field x;
    double time = 0;            // [s]
    std::vector<double> front;  // s_max of each link, as it was committed there [J^1/2]
    double length = 0;          // of the next increment along the branch; 0: as long as the last
    // What damage and breaks had taken where a branch was last begun to be followed [J].
    double spent_at_start = -1e300;
    int fruitless = 0;  // how often one was begun to be followed since, with next to no more damage
  };
  Behind behind_;
  bool following_ = false;  // the present configuration lies on a branch that no search would find
  bool softens_ = false;    // links lose their hold little by little, in `commit`
  bool critical_ = false;
  std::int64_t avalanches_ = 0;
  std::vector<BreakAtRest> breaks_;
  StaticWorks works_;  // fracture: of what has broken, less what damage had dissipated before the stage
};

}  // namespace lamella
