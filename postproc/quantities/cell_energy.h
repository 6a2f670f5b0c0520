// Elastic energy of each cell: its walls (stretch, bend) and its core. Links are shared half and half, in a column apart.
#pragma once
#include <vector>

#include "postproc/frame_view.h"

namespace lamella {

struct CellEnergy {
  // per cell [J]; empty where the scene has no such term
  std::vector<double> stretch, bend, core;
  std::vector<double> total;       // of those
  std::vector<double> link_share;  // half the energy of the links that hold the cell
};

CellEnergy cell_energy(const FrameView& view);

/// W_0 = f_n0^2 / 2 k_n of one link of a full spacing, the mean over all links [J]; 0 where links cannot break.
double link_reference_energy(const FrameView& view);

}  // namespace lamella
