// Charts of pressed rings: what was computed as dots, what is exact as lines.
#pragma once
#include <string>
#include <vector>

#include "pipelines/ring_between_plates/elastica.h"
#include "pipelines/ring_between_plates/pressed_ring.h"

namespace lamella {

/// Exact rings from strain 0 to 0.7.
class ExactCurves {
 public:
  ExactCurves(int count, double axial);
  std::vector<double> strain() const { return of(&Elastica::strain); }
  std::vector<double> of(double Elastica::*value) const;
  const std::vector<Elastica>& rings() const { return rings_; }

 private:
  std::vector<Elastica> rings_;
};

Curve dashed_curve(int colour, const std::string& label, std::vector<double> x, std::vector<double> y);
/// About 35 frames of the way in.
Curve ring_dots(int colour, const std::string& label, const Squeeze& squeeze, Measure y,
                Measure x = &PressedRing::strain);

/// Figs. 11 to 14: width, contact length, area, energies, each with what the paper says of it.
void draw_shape_charts(StudyReport& report, const ExactCurves& exact, const Squeeze& ring, int nodes);
/// The ring at several strains on its elastica.
void draw_rings(StudyReport& report, const Squeeze& ring, double axial);
/// Pressure of each node at the upper plate over p* = EI / (s R l^2), which is its force over F* = EI / (R l).
Chart pressure_chart(const std::string& title, const Squeeze& ring, const std::vector<double>& strains, Measure over,
                     double segment);

}  // namespace lamella
