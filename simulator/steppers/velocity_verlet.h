// Velocity Verlet, written with velocities half a step behind: v(n+1/2) = v(n-1/2) + dt f(n) / m, x(n+1) = x(n) + dt v(n+1/2). One sweep over
// blocks of cells computes a block's forces and integrates it at once, in place, while it is in cache: a link belongs to
// the lower of its two blocks, so all forces on a block are complete when its turn comes. Links between chunks (the
// unit of a thread) are evaluated before the sweep. Every sum runs in an order that does not depend on the number of threads.
//
// It knows no term by its formula; energies and works are booked as the ledger of docs/model.md needs them: a force does the work
// f . (v(n-1/2) + v(n+1/2)) dt / 2, of which the first half belongs to the time before step n.
#pragma once
#include <vector>

#include "generator/sample/team.h"
#include "simulator/steppers/box_step.h"
#include "simulator/steppers/stepper.h"

namespace lamella {

class VelocityVerlet final : public Stepper {
 public:
  VelocityVerlet(Model& model, std::vector<Load>& loads, State& state, int threads);

  void step(double dt, double kick) override;
  Measurement measured_step(double dt, double kick, Field* force_on_node) override;

  std::vector<Break> take_breaks() override;
  std::vector<WallBreak> take_wall_breaks() override;
  /// Number of steps so far.
  std::int64_t steps() const { return steps_; }
  const std::vector<std::uint8_t>& fully_held() const override { return fully_held_; }

  void save(ArraySet& restart) const override;
  void restore(const ArraySet& restart) override;

 private:
  struct HeldNode {
    Index node;
    std::uint8_t mask;
  };
  struct Run;     // the part of a load that lies in one block
  struct Worker;  // scratch of a thread
  struct BlockSums {
    double damping = 0, damping_out = 0, kinetic = 0, largest_force = 0, section_square = 0, speed = 0;
    Vec2 box = Vec2::Zero(), box_damped = Vec2::Zero();  // on the growth of a box that moves, in this step [N]
  };

  template <bool Measured>
  void advance(double dt, double kick, Field* force_on_node);
  template <bool Measured>
  void sweep_block(Index block, Worker& worker, double dt, double kick, Field* force_on_node);
  void add_to_box(const CellBlock& block, BlockSums& sums);
  void step_box(double dt, double kick);
  void evaluate_boundary(Index chunk, double kick);
  void prefetch_block(Index block) const;
  Works works_at_start() const;
  double dropped_kinetic(const std::vector<Break>& breaks, std::size_t first, double kick) const;
  double hand_over(const Break& event, double dt);
  void list_incoming();
  void end_walls(std::vector<WallBreak>& now, double dt);

  Model& model_;
  std::vector<Load>& loads_;
  State& state_;
  Team team_;
  Field f_, damped_f_;  // zero between steps
  Field carried_v_;     // velocities of nodes that a box carries along, for dashpots [m/s]; empty without either
  std::vector<ShellTerm*> shell_terms_;
  std::vector<Worker> workers_;
  std::vector<std::vector<Run>> runs_;  // per block
  std::vector<BlockSums> sums_;         // per block
  std::vector<LinkForces> boundary_;    // per block: its links to other chunks
  std::vector<std::vector<std::pair<Index, Index>>>
      incoming_;                                      // per chunk: (block, position) of links that reach it from others
  std::vector<std::vector<Break>> broken_;            // per chunk, in this step
  std::vector<std::vector<WallBreak>> broken_walls_;  // likewise; empty where walls do not break
  std::vector<double> dropped_kinetic_;               // per chunk, in this step [J]
  std::vector<Break> breaks_;
  std::vector<WallBreak> wall_breaks_;
  std::vector<std::uint8_t> fully_held_;
  BoxStep box_;
  Works booked_;      // all but the cumulative sums of blocks and runs
  double moved_ = 0;  // bound on any node's way since the candidates were last checked [m]
  std::int64_t steps_ = 0;

 public:
  ~VelocityVerlet() override;
};

}  // namespace lamella
