// A ring squeezed between two plates along y, frame by frame: what the studies of rings with cores and of plastic rings measure. For any
// run whose first closed cell lies between plates that loads move.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "pipelines/studies/study.h"

namespace lamella {

/// The ring in one frame. Extents are those of its nodes, so that the overlap with the plates does not enter.
struct SqueezedRing {
  double time = 0;               // [s]
  double stage = 0;              // of the run
  double strain = 0;             // 1 - b / b0, b the extent along y
  double width = 1;              // a / b0, a the extent along x
  double area = 1;               // over that at rest
  double shrinkage = 0;          // 1 - area
  double force = 0;              // of a plate on the ring, mean of both [N]
  double moment = 0;             // <|x|>: first moment of the plates' force over the force [m]
  double touching = 0;           // distance along x of the outermost nodes that the plates push, mean of both [m]
  double pressure = 0;           // of the core; 0 without one [Pa]
  double bars = 0, hinges = 0;   // stored energies [J]
  double work = 0, plastic = 0;  // of the loads in this stage, and what flowed of it [J]
  std::vector<Vec2> x;           // nodes, from the middle of their extents [m]
  std::vector<double> push;      // of the plates on each node, across them [N]

  double stretch_over_bending() const { return bars / hinges; }
};

/// A run's frames. What is asked at a strain is asked on the way in: in the first stage, up to the largest strain.
struct RingCourse {
  std::vector<SqueezedRing> frames;
  double diameter = 2;  // b0 [m]
  double spacing = 0;   // rest length of a segment [m]

  std::vector<double> all(double SqueezedRing::*what) const;
  /// The values up to the largest strain.
  std::vector<double> inward(double SqueezedRing::*what) const;
  /// All numbers at a strain: least-squares parabolas through the frames within `window` of it. Nodes are those of the nearest frame.
  /// Throws DataError where there is no frame.
  SqueezedRing at(double strain, double window = 0.005) const;
  /// The frame whose strain is nearest, as it is.
  const SqueezedRing& nearest(double strain) const;
  /// Mean of the force between two strains: the work done over the shortening, exact whatever chatters between frames [N]. With
  /// `plastic` instead of `work`, the force that the flow alone asks for.
  double mean_force(double from, double to, double SqueezedRing::*work = &SqueezedRing::work) const;
  std::size_t turn() const;  // frame of the largest strain of the first stage
};

RingCourse ring_course(const StudyRun& run);

/// Length of the flat part, from the first moment of the force, with a core that presses it with `line` = p s per length and edges that
/// carry the rest: <|x|> F = p s L^2 / 4 + (F - p s L) L / 2. Without pressure 2 <|x|> [m].
double contact_length(double force, double moment, double line);
/// What the edges carry, F - p s L [N].
double edge_force(double force, double moment, double line);

/// Rings side by side with their plates, at one scale, each with its label.
void ring_picture(StudyReport& report, const std::string& name, const std::string& caption,
                  const std::vector<std::pair<std::string, SqueezedRing>>& rings);

}  // namespace lamella
