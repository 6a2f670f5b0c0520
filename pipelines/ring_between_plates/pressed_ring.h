// What is measured on a ring between two plates, frame by frame. The ring is cell 0, the upper plate cell 1, the lower cell 2. The scenes
// set the ring's radius R and EI to 1, so that lengths are in R, forces in EI / R^2, energies in EI / R.
#pragma once
#include <string>
#include <vector>

#include "pipelines/studies/study.h"

namespace lamella {

const double kRingAxial = 4800;  // S = EA R^2 / EI of the scenes' ring: walls of thickness 0.05 R

/// Length l of a ring's segments.
double ring_segment(int nodes);

/// The ring in one frame.
struct PressedRing {
  int frame = 0, stage = 0;
  double strain = 0;           // 1 - b / 2, b the extent of the nodes across the plates
  double plate_strain = 0;     // the same with b the distance of the plates less the radii: larger where walls sink in
  double force = 0;            // of a plate, mean of both
  double width = 0;            // extent of the nodes along the plates over 2: a / b_0
  double area = 0;             // over that of the first frame
  double contact_length = 0;   // 2 <|x|>, contact forces as weights, over 2: L_c / b_0
  double touching = 0;         // nodes at a plate, nearer than 1e-4 to touching; mean of both plates
  double touching_length = 0;  // distance of the outermost of them, over 2
  double pushing = 0;          // nodes that carry force at a plate; mean of both plates
  double bending = 0, stretching = 0;  // energies
  double top = 0, side = 0;            // curvatures at the nodes under a plate and half way between the plates

  double overlap() const { return plate_strain - strain; }
};

using Measure = double PressedRing::*;

/// A ring pressed and released: two curves over strain.
class Squeeze {
 public:
  /// Measures all frames. The first stage presses, the second, if any, releases.
  explicit Squeeze(StudyRun run);

  const StudyRun& run() const { return run_; }
  const std::vector<PressedRing>& press() const { return press_; }
  const std::vector<PressedRing>& release() const { return release_; }
  /// On the way in, at a value of `strain` or another measure that grows; linear between frames. NaN where it is not reached.
  double pressing(Measure value, double at, Measure over = &PressedRing::strain) const;
  /// Mean of both ways. Drag and inertia pull with the speed, in opposite senses on the two ways: in the mean they cancel.
  double at(Measure value, double at, Measure over = &PressedRing::strain) const;
  /// Frame of the way in whose value is nearest.
  const PressedRing& nearest(double at, Measure over = &PressedRing::strain) const;
  std::vector<double> pressed(Measure value) const;

 private:
  StudyRun run_;
  std::vector<PressedRing> press_, release_;
};

/// Force on a node of the ring from the upper plate.
struct NodeForce {
  double x = 0, force = 0;
};

/// From left to right.
std::vector<NodeForce> upper_forces(const StudyRun& run, int frame);

}  // namespace lamella
