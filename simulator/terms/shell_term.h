// A term whose forces stay inside cells. It says what it adds to one block; the whole-system form follows from that, so
// that each force is written once.
#pragma once
#include "simulator/shells.h"
#include "simulator/terms/term.h"

namespace lamella {

/// Sums that terms keep while history moves: what plastic flow has dissipated, block by block, so that the total does not depend
/// on the number of threads.
class ShellTerm : public Term {
 public:
  explicit ShellTerm(const ShellLayout& layout) : layout_(layout), dissipated_(layout.blocks().size(), 0.0) {}

  /// Adds the forces of the block, from the geometry in `scratch`, to its section forces or to the nodes.
  virtual void add_to_block(ShellScratch& scratch, Field& f) const = 0;
  /// Asks for what `add_to_block` will read of the block.
  virtual void prefetch_block(const CellBlock& /*block*/) const {}
  /// Moves the history of the block to the state that `add_to_block` has just evaluated in `scratch`.
  virtual void commit_block(Index /*block*/, const ShellScratch& /*scratch*/) {}
  /// True if `commit_block` does anything.
  virtual bool has_history() const { return false; }
  /// True if bars or hinges of this term can yield.
  virtual bool plastic() const { return false; }
  /// Energy stored in each cell at x [J].
  virtual std::vector<double> stored(const Field& x) const = 0;
  /// What plastic flow has dissipated so far [J].
  double dissipated() const;

  void add_force(const Field& x, Field& f) const final;
  void commit(const Field& x) final;

 protected:
  const ShellLayout& layout_;
  std::vector<double> dissipated_;  // per block [J]
};

}  // namespace lamella
