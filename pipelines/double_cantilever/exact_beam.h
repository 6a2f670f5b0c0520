// A glued double cantilever of hinge chains: its exact discrete solution, and the chains that are long enough for it.
#pragma once
#include <algorithm>
#include <cmath>
#include <complex>

#include "pipelines/studies/facing_chains.h"

namespace lamella {

// In units of k_b = l = 1, and of the strength f_n0 of a link.

/// The exact solution: arms free up to node c, from there on chains of hinges on springs, without end. Deflections of the bonded part are
/// Re(a z^-(j - c)) with z - 2 + 1 / z = i beta.
class ExactBeam {
 public:
  ExactBeam(double beta, int crack) : beta_(beta), crack_(crack) {
    using namespace std::complex_literals;
    z_ = 1.0 + 0.5i * beta + std::sqrt(1i * beta - 0.25 * beta * beta);
  }
  double p() const { return z_.real(); }
  double q() const { return z_.imag(); }
  /// Nodes over which deflections fall by exp(-1).
  double decay() const { return 1 / std::log(std::abs(z_)); }
  /// P_c over f_n0.
  double load() const { return q() / (beta_ * (1 + crack_ * (p() - 1))); }
  /// Half the opening at node 0 when the first link breaks, over f_n0. The bending moment is P j on the arm, so there deflections have the
  /// second difference P j, and link c is stretched by twice w_c = f_n0 / 2 k_n.
  double half_opening() const {
    const double w_c = 1 / (beta_ * beta_);
    const std::complex<double> a(w_c, -load() * crack_ / beta_);
    double after = (a / z_).real(), here = w_c;
    for (int j = crack_; j > 0; --j) {
      const double before = 2 * here - after + load() * j;
      after = here, here = before;
    }
    return here;
  }
  double compliance() const { return half_opening() / load(); }  // half opening per load
  /// What the break of the first link releases while the opening is held, over W_0 = f_n0^2 / 2 k_n: both arms store half_opening^2 / compliance.
  double released() const {
    const double w = half_opening(), w_0 = 1 / (beta_ * beta_);
    return w * w * (1 / compliance() - 1 / ExactBeam(beta_, crack_ + 1).compliance()) / w_0;
  }
  /// sqrt(G_c s EI) / a with G_c s = W_0 / l.
  double fracture_mechanics() const { return 1 / (beta_ * crack_); }

 private:
  double beta_;
  int crack_;
  std::complex<double> z_;
};

/// A strength at which the arms turn by about `slope` before the first link breaks.
inline double strength_for(const ExactBeam& exact, int crack, double slope) {
  return slope * crack / exact.half_opening();
}

/// Enough bonded nodes for what is beyond them to matter less than 1e-9, and `spare` ones for a crack that grows.
inline FacingChains glued_beam(double beta, int crack, int spare = 0) {
  const int bonded = std::max(20, static_cast<int>(std::ceil(11 * ExactBeam(beta, crack).decay()))) + spare;
  return {.segments = crack + bonded, .first_link = crack, .radius = 0.1};
}

}  // namespace lamella
