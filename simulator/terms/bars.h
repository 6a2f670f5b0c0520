// Bars: the wall between two mass points resists being stretched. k_s = E A / l0 (physics.md 1), T = k_s (l - l0 - l_p), tension
// positive, perfectly plastic beyond the yield force where one is given.
#pragma once
#include "simulator/terms/shell_term.h"

namespace lamella {

class Bars final : public ShellTerm {
 public:
  /// `axial_rigidity`: E A of each cell [N]; `yield`: F_Y of each cell [N], infinite where elastic, empty if all are.
  Bars(const ShellLayout& layout, const std::vector<double>& axial_rigidity, const std::vector<double>& yield);

  std::string name() const override { return "bars"; }
  double energy(const Field& x) const override;
  void add_to_block(ShellScratch& scratch, Field& f) const override;
  void prefetch_block(const CellBlock& block) const override;
  void commit_block(Index block, const ShellScratch& scratch) override;
  bool has_history() const override { return !yield_.empty(); }
  bool plastic() const override { return !yield_.empty(); }
  void add_stiffness(const Field& x, StiffnessSink& sink) const override;
  std::vector<double> stored(const Field& x) const override;
  void save(ArraySet& restart) const override;
  void restore(const ArraySet& restart) override;
  void add_output(const Field& x, ArraySet& frame) const override;
  std::size_t bytes() const override;

  /// What the bar at this slot stores at this tension [J].
  double stored_at(Index slot, double tension) const { return 0.5 * tension * tension / stiffness_[slot]; }
  /// The bar is gone: from now on it carries nothing.
  void end(Index cell, Index node) { layout_.set_padded(stiffness_, cell, node, 0.0); }

 private:
  template <class F>
  void for_each_bar(const Field& x, F&& visit,
                    StiffnessSink* sink = nullptr) const;  // visit(cell, node, next node, slot, length)

  // padded layout
  std::vector<double> stiffness_;    // k_s [N/m]; 0 where no segment starts, or it has broken
  std::vector<double> rest_length_;  // l0 [m]
  std::vector<double> yield_;        // F_Y [N]; empty: elastic
  std::vector<double> plastic_;      // l_p [m]; empty: elastic
};

}  // namespace lamella
