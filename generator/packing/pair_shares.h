// Pairs of soft disks shared among threads. Each disk belongs to one thread, which alone adds to its force, in the order of
// the list: the sum is the same to the last bit for any number of threads. Blocks of pairs at a border between two
// threads are computed by both.
#pragma once
#include <vector>

#include "generator/packing/neighbours.h"

namespace lamella {

struct PairShare {
  struct Block {
    Eigen::Index begin, count;  // of pairs
    bool whole;                 // all their disks belong to this thread
    bool first;                 // of all threads that compute the block, this one keeps its sums
  };
  std::int32_t disk_begin = 0, disk_end = 0;    // of this thread
  std::int32_t ghost_begin = 0, ghost_end = 0;  // numbered after the disks
  std::vector<Block> blocks;                    // in the order of the list

  bool owns(std::int32_t k) const { return (k >= disk_begin && k < disk_end) || (k >= ghost_begin && k < ghost_end); }
};

/// Shares of about as many pairs each. `block`: pairs in a block; only the last is shorter.
std::vector<PairShare> share_pairs(const Neighbours& list, std::int32_t disks, int threads, Eigen::Index block);

}  // namespace lamella
