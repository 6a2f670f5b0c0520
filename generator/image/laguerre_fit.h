// The Laguerre tessellation closest to a picture of labels.
#pragma once
#include <functional>
#include <vector>

#include "generator/image/labels.h"
#include "generator/packing/packing.h"

namespace lamella {

struct LaguerreFit {
  std::vector<Disk> disks;  // of every cell, inside the picture [pixels, y upwards from the lowest row]
  double rms = 0;           // distance of the boundary of the pixels from the walls' lines, root mean square [pixels]
  int steps = 0;            // of the minimisation
};

/// Sites and weights with the least sum, over all sides of pixels between two cells, of the squared distance of the side's
/// middle from the line of equal power of the two: a non-linear least-squares problem (Levenberg-Marquardt) in the
/// power's coefficients c_i - 2 p . x_i, which are linear in c_i = |x_i|^2 - w_i and in the sites x_i. Tessellations stay
/// the same when all sites move or shrink together; of these, the sites nearest to the cells' centres are given.
/// The labels leave no background.
LaguerreFit fit_laguerre(const LabelImage& labels, const std::function<void(double)>& progress = {});

/// Parts the background into cells of about the mean area, numbered 0, after the others; the first of them is returned.
Index part_background(LabelImage& labels);

}  // namespace lamella
