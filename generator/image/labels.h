// Which pixel belongs to which cell, and how such a picture becomes one whose cells are proper: each in one piece,
// without holes, not too small, and touching its neighbours where only a thin line lies between them.
#pragma once
#include <cstdint>
#include <vector>

#include "generator/image/picture.h"
#include "generator/sample/sample.h"

namespace lamella {

inline constexpr Index kBackground = -1;

/// Rows from the top, as in Picture.
struct LabelImage {
  int width = 0, height = 0;
  std::vector<Index> cell;            // of every pixel, into `number`; kBackground: no cell
  std::vector<std::uint32_t> number;  // of every cell, in the picture

  std::size_t pixels() const { return cell.size(); }
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

/// Cells in ascending order of their numbers. A picture with one number beside the background says where cells are, not
/// which: then every connected piece is a cell, numbered from 1 in the order of its first pixel, and `pieces` is set.
/// Pixels are connected through their sides, here and below. No cells when all is background.
LabelImage labels_of(const Picture& picture, std::uint32_t background, bool& pieces);

/// Gives the background to the nearest cells where it is thin: where no square of `square` pixels a side of background covers
/// the pixel. Beyond the sides of the picture there is no background. Returns how many pixels.
std::size_t close_gaps(LabelImage& labels, int square);

/// What clean_labels has done; cells by their numbers in the picture.
struct Cleaning {
  std::vector<std::uint32_t> scattered;  // were in several pieces, of which the largest is left
  std::size_t pieces = 0;                // that were joined to what they touch most
  std::vector<std::uint32_t> small;      // cells joined to what they touch most
  int small_gaps = 0;                    // background regions likewise
  std::vector<std::uint32_t> filled;     // had holes, which are theirs now
  std::vector<std::uint32_t> enclosed;   // cells that lay in such a hole
  std::size_t pinches = 0;               // corners at which a cell touched itself; a pixel went to a neighbour
};

/// Afterwards every cell has at least `least_area` pixels, is connected, has no hole and touches itself nowhere, not even at
/// a corner. Smaller regions are joined, smallest first, to the neighbour (a cell or the background) with the longest
/// common boundary. Throws SceneError where a cell encloses more than its own area.
Cleaning clean_labels(LabelImage& labels, int least_area);

}  // namespace lamella
