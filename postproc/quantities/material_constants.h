// What a test says about the tissue as a material: moduli, strength, strains, work of fracture. The definitions are text
// beside the numbers (postproc/summary.cpp).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/sample/sample.h"
#include "simulator/trajectory/trajectory.h"

namespace lamella {

/// The set-up of a test, from the trajectory's provenance.
struct TestSetup {
  int axis = 1;                  // of the gauge length: 0 x, 1 y
  std::string kind = "tension";  // tension | compression | shear
  double gauge_length = 0;       // [m]
  double width = 0;              // across the load [m]
  double depth = 1;              // [m]
  int stage = 0;                 // of the first loading

  /// 1 in tension and shear, -1 in compression: strains and stresses times this grow with the load.
  double sign() const { return kind == "compression" ? -1 : 1; }
};

/// Empty when no stage of the run has a loading.
std::optional<TestSetup> test_setup(const Provenance& provenance);

/// The stress-strain curve of the first loading, times TestSetup::sign(). Rows are those of one stage.
struct LoadCurve {
  std::vector<double> time, strain, stress;
};
LoadCurve load_curve(const Response& response, const TestSetup& setup);

/// Straight line by least squares.
struct LineFit {
  double slope = 0, intercept = 0;
  double r_squared = 0;
  int points = 0;
};
LineFit fit_line(const std::vector<double>& x, const std::vector<double>& y, std::size_t begin, std::size_t end);

struct MaterialConstants {
  double peak_stress = 0, strain_at_peak = 0, time_at_peak = 0;  // [Pa], [1], [s]
  std::optional<double> modulus;                                 // Young's, of shear in a shear test [Pa]
  double modulus_r_squared = 0;
  double elastic_strain = 0;                // up to which the modulus is fitted [1]
  std::optional<double> poisson;            // [1]
  std::optional<double> strain_at_failure;  // [1]
  std::optional<double> time_at_failure;    // [s]
  double work_per_area = 0;                 // [J/m2]
};

/// `lateral` are (strain, mean lateral strain) pairs of frames, times the sign, in order; may be empty.
MaterialConstants material_constants(const LoadCurve& curve, const TestSetup& setup, const std::vector<Event>& events,
                                     const std::vector<Vec2>& lateral);

/// For a sample that is in two at the end of the curve: it has failed there, if the stress did not say so before (a run that ends
/// with the separation still shows the inertia of the pieces).
void fail_at_separation(MaterialConstants& constants, const LoadCurve& curve);

/// Mean strain across the axis: slope of a straight line through the lateral displacements of the cells' centroids against their
/// places at rest, over the cells in the middle half of the gauge length (where the grips' hold is not felt).
double lateral_strain(const Sample& sample, const std::vector<Vec2>& x, int axis);

/// Piecewise linear value of the curve at a time, clamped to its ends.
double value_at(const std::vector<double>& times, const std::vector<double>& values, double time);

/// The same at the time of a frame: where rows share a time, as before and after a fall at rest, that of the last.
double value_at_frame(const std::vector<double>& times, const std::vector<double>& values, double time);

}  // namespace lamella
