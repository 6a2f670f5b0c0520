#include "generator/packing/pair_shares.h"

#include <algorithm>

namespace lamella {
namespace {

/// Disks in the order of the list, so that most pairs join disks of one thread; ghosts go with the disk that first asks for them.
void divide_disks(const Neighbours& list, std::int32_t disks, Eigen::Index block, std::vector<PairShare>& shares) {
  const auto pairs = static_cast<Eigen::Index>(list.first.size()), threads = static_cast<Eigen::Index>(shares.size());
  const Eigen::Index blocks = (pairs + block - 1) / block;
  std::int32_t disk = 0, ghost = disks;
  Eigen::Index pair = 0;
  for (Eigen::Index t = 0; t < threads; ++t) {
    PairShare& share = shares[t];
    share.disk_begin = disk, share.ghost_begin = ghost;
    const Eigen::Index end = blocks * (t + 1) / threads * block;
    disk = end < pairs ? std::max(disk, list.first[end]) : disks;
    for (; pair < pairs && list.first[pair] < disk; ++pair) ghost = std::max(ghost, list.second[pair] + 1);
    share.disk_end = disk, share.ghost_end = ghost;
  }
}

}  // namespace

std::vector<PairShare> share_pairs(const Neighbours& list, std::int32_t disks, int threads, Eigen::Index block) {
  std::vector<PairShare> shares(threads);
  divide_disks(list, disks, block, shares);
  const auto pairs = static_cast<Eigen::Index>(list.first.size());
  std::vector<Eigen::Index> touched(threads);
  for (Eigen::Index begin = 0; begin < pairs; begin += block) {
    const Eigen::Index count = std::min(block, pairs - begin);
    std::fill(touched.begin(), touched.end(), 0);
    for (Eigen::Index k = begin; k < begin + count; ++k)
      for (int t = 0; t < threads; ++t) {
        touched[t] += shares[t].owns(list.first[k]) ? 1 : 0;
        touched[t] += shares[t].owns(list.second[k]) ? 1 : 0;
      }
    bool first = true;
    for (int t = 0; t < threads; ++t) {
      if (touched[t] == 0) continue;
      shares[t].blocks.push_back({begin, count, touched[t] == 2 * count, first});
      first = false;
    }
  }
  return shares;
}

}  // namespace lamella
