// Hinges: the wall resists being bent at its mass points. k_b = E I / lt with lt the tributary length, M = k_b (theta - theta0
// - theta_p), perfectly plastic beyond the yield moment where one is given. The turning angle is followed in time, so
// that M has no jump when a hinge folds over.
#pragma once
#include "simulator/terms/shell_term.h"

namespace lamella {

class Hinges final : public ShellTerm {
 public:
  /// `bending_rigidity`: E I of each cell [N m2]; `yield`: M_Y of each cell [N m], infinite where elastic, empty if all are.
  Hinges(const ShellLayout& layout, const std::vector<double>& bending_rigidity, const std::vector<double>& yield);

  std::string name() const override { return "hinges"; }
  double energy(const Field& x) const override;
  void add_to_block(ShellScratch& scratch, Field& f) const override;
  void prefetch_block(const CellBlock& block) const override;
  void commit_block(Index block, const ShellScratch& scratch) override;
  bool has_history() const override { return true; }  // the angle itself
  bool plastic() const override { return !yield_.empty(); }
  void add_stiffness(const Field& x, StiffnessSink& sink) const override;
  std::vector<double> stored(const Field& x) const override;
  void save(ArraySet& restart) const override;
  void restore(const ArraySet& restart) override;
  void add_output(const Field& x, ArraySet& frame) const override;
  std::size_t bytes() const override;

  bool present(Index slot) const { return stiffness_[slot] != 0; }
  /// What the hinge at this slot stores at this moment [J].
  double stored_at(Index slot, double moment) const { return 0.5 * moment * moment / stiffness_[slot]; }
  /// One of its two segments is gone: from now on it carries nothing.
  void end(Index cell, Index node) { layout_.set_padded(stiffness_, cell, node, 0.0); }

 private:
  template <class F>
  void for_each_hinge(const Field& x, F&& visit, StiffnessSink* sink = nullptr)
      const;  // visit(cell, prev, node, next, slot, elastic trial moment)

  // padded layout
  std::vector<double> stiffness_;   // k_b [N m]; 0 where there is no hinge
  std::vector<double> rest_angle_;  // theta0 + theta_p [rad]: plastic flow moves the rest angle
  std::vector<float>
      last_angle_;             // turning angle at the last commit; only chooses the turn, so single precision is enough
  std::vector<double> yield_;  // M_Y [N m]; empty: elastic
};

}  // namespace lamella
