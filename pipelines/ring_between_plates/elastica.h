// A ring between rigid plates without friction, exactly: the elastica by quadratures, with walls that stretch. Lengths in R,
// forces in EI / R^2, energies in EI / R.
#pragma once
#include <vector>

#include "generator/sample/vec.h"

namespace lamella {

/// The ring at one strain. All lengths are of the centre line.
struct Elastica {
  double strain = 0;                   // 1 - b / 2
  double force = 0;                    // of a plate
  double contact_length = 0;           // of the flat part at one plate, over 2 (as L_c / b_0)
  double width = 0;                    // a / 2 (as a / b_0)
  double area = 0;                     // over pi
  double bending = 0, stretching = 0;  // energies
  double top = 0, side = 0;            // curvatures under a plate and half way between them
  std::vector<Vec2> outline;           // the upper right quarter of the wall, from the middle of the plate to the side
};

/// `axial`: S = EA R^2 / EI; infinity: inextensible. Strain where the plates begin to touch more than a point.
double contact_onset(double axial);
/// 0 < strain < 0.95.
Elastica elastica(double strain, double axial);
}  // namespace lamella
