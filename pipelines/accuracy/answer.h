// What a run says about its largest load, and how far off that is by the pace of the run: the difference of two runs at different paces.
#pragma once
#include <string>
#include <vector>

#include "simulator/trajectory/trajectory.h"

namespace lamella {

/// The load that a run measures, as it grows with its progress.
struct Answer {
  std::string name;              // "nominal stress", "force_y_lid", "elastic energy"
  std::string unit;              // "Pa", "N", "J"
  std::vector<double> progress;  // strain of the test, else time over the slowdown [s]; ascending
  std::vector<double> load;      // magnitude

  /// Row of the largest load.
  std::size_t peak() const;
  /// Load at a progress, linear between rows.
  double at(double place) const;
};

/// The nominal stress where the scene has a [loading]; else the largest force that [[loads]] exert; else the elastic energy. `like`: the
/// same load as another run's. Up to the largest load. Throws DataError where the run has none of them.
Answer answer_of(const TrajectoryReader& run, double slowdown, const Answer* like = nullptr);

/// Relative errors.
struct ErrorEstimate {
  double peak = 0;   // of the largest load
  double curve = 0;  // root mean square over the way up to the largest load, over the load's root mean square
  double larger() const { return peak > curve ? peak : curve; }
};

/// Places at which curves are compared: `count` of them, up to the earlier of the two largest loads.
std::vector<double> compared_places(const Answer& a, const Answer& b, int count = 20);

/// Distance of an answer from another one, at these places: what the error would be if the other one were exact.
ErrorEstimate distance(const Answer& found, const Answer& exact, const std::vector<double>& places);

/// Error of the slower of two runs. Drag and inertia pull with the speed, so what is left of their error at half the speed is half of
/// it: e(slow) = |slow - fast| / (ratio - 1), ratio = speed of the fast over that of the slow run.
ErrorEstimate error_of_slower(const Answer& slow, const Answer& fast, double ratio);

}  // namespace lamella
