// Connected regions of a picture.
#pragma once
#include <vector>

#include "generator/image/labels.h"

namespace lamella {

/// Sets that are joined; the name of a joined set is its smallest member.
class Sets {
 public:
  explicit Sets(std::size_t count = 0) { grow(count); }
  void grow(std::size_t count) {
    for (auto k = static_cast<Index>(above_.size()); k < static_cast<Index>(count); ++k) above_.push_back(k);
  }
  Index add() {
    above_.push_back(static_cast<Index>(above_.size()));
    return above_.back();
  }
  Index find(Index k) {
    while (above_[k] != k) k = above_[k] = above_[above_[k]];
    return k;
  }
  void join(Index a, Index b) {
    a = find(a);
    b = find(b);
    if (a < b)
      above_[b] = a;
    else
      above_[a] = b;
  }

 private:
  std::vector<Index> above_;
};

/// Pixels of one label that are connected through their sides, numbered in the order of their first pixel.
struct Regions {
  std::vector<Index> of;    // per pixel
  std::vector<Index> cell;  // per region: its label
  std::vector<Index> area;  // per region [pixels]
};

Regions regions_of(const LabelImage& labels);

}  // namespace lamella
