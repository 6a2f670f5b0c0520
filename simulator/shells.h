// How the explicit step walks over cells: in blocks that stay in cache, each block with a scratch copy of its shells in
// which every cell is padded by a copy of its last node in front and of its first node behind. With the padding, one loop without
// branches covers all segments, and one all hinges, of the block.
#pragma once
#include <vector>

#include "generator/sample/sample.h"
#include "simulator/positions.h"

namespace lamella {

struct CellBlock {
  Index cell_begin = 0, cell_end = 0;
  Index node_begin = 0, node_end = 0;
  Index slot_begin = 0, slots = 0;  // of the padded layout
};

/// Which cells form a block, and where nodes stand in the padded layout.
class ShellLayout {
 public:
  explicit ShellLayout(const Sample& sample, Index nodes_per_block = 512);
  const Sample& sample() const { return *sample_; }
  const std::vector<CellBlock>& blocks() const { return blocks_; }
  /// Blocks [chunk(k), chunk(k + 1)) form chunk k, the unit that a thread works on. The partition does not depend on the number of
  /// threads, and so neither does any sum.
  Index chunks() const { return static_cast<Index>(chunk_.size()) - 1; }
  Index chunk(Index k) const { return chunk_[k]; }
  Index block_of_cell(Index cell) const { return block_of_cell_[cell]; }
  Index chunk_of_block(Index block) const { return chunk_of_block_[block]; }
  Index slots() const { return sample_->nodes() + 2 * sample_->cells(); }
  Index largest_block() const { return largest_; }
  static Index slot(Index cell, Index node) { return node + 2 * cell + 1; }

  /// Per-segment (or per-node) values in the padded layout: copies at the two ghosts of a closed cell, `filler` at those of a chain.
  std::vector<double> padded(const std::vector<double>& per_node, double filler) const;
  /// Sets one value of the padded layout, and its copy beyond the seam of a closed cell.
  void set_padded(std::vector<double>& per_slot, Index cell, Index node, double value) const;
  /// The values of real nodes back out of the padded layout.
  std::vector<double> unpadded(const std::vector<double>& per_slot) const;

 private:
  const Sample* sample_;
  std::vector<CellBlock> blocks_;
  std::vector<Index> chunk_, block_of_cell_, chunk_of_block_;
  Index largest_ = 0;
};

/// Scratch of one block: geometry at the present positions, and what the terms add to it. Index: slot in the block.
/// Segment s runs from slot s to slot s + 1.
struct ShellScratch {
  explicit ShellScratch(const ShellLayout& layout);

  /// Copies the positions of the block and computes its segments; section forces start from 0.
  void load(const Sample& sample, const CellBlock& block, const Field& x);
  /// Adds S_k - S_(k-1), the difference of the section forces, to the nodes of the block.
  void add_section_forces(const Sample& sample, Field& f) const;
  /// Padded copy of a second field (velocities, for dashpots).
  void load_velocity(const Sample& sample, const Field& v);

  CellBlock block;
  std::vector<double> px, py;                  // positions [m]
  std::vector<double> ex, ey;                  // segment vectors [m]
  std::vector<double> length, inverse_length;  // [m], [1/m]
  std::vector<double> sx, sy;                  // section force of the segment, as it acts on its first node [N]
  std::vector<double> angle, moment;           // of the hinge at the slot [rad], [N m]; set by the hinges
  std::vector<double> tension;                 // axial force [N]; set by the bars
  std::vector<double> vx, vy;                  // velocities [m/s]; set by load_velocity
};

}  // namespace lamella
