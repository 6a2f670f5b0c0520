// The law of links that tear slowly (docs/model.md, section 5): linear up to the criterion of laws/cohesive.h, then softening in the
// energy norm, irreversibly. Pure functions of the openings d_n, d_t and of the history; nothing here knows nodes.
//
//   s = sqrt(k_n <d_n>^2 + k_t d_t^2)      [J^1/2]; <d_n> = max(d_n, 0): what is pressed keeps its full k_n and is no part of s
//   sigma(s) = s up to s0,      s0 (s_f - s) / (s_f - s0) up to s_f = 2 G_c / s0,      0 beyond;      (1 - d) = sigma(s_max) / s_max
//
// s0, and with it the mode mix B = k_t d_t^2 / s^2, is taken where damage begins and kept: from then on all depends on s alone, and the
// force is the gradient of a potential. A mix that followed the opening would have none.
#pragma once
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "simulator/laws/cohesive.h"
#include "simulator/measures/jet.h"

namespace lamella {

enum class ModeMixing { kBenzeggaghKenane, kPower };

/// One link.
struct ZoneLink {
  double k_n = 0, k_t = 0;                // [N/m]
  double strength_n = 1, strength_t = 1;  // f_n0, f_t0 [N]
  double alpha = 2;
  double toughness_n = 0, toughness_t = 0;  // energy of the whole link in pure opening and in pure shear [J]
  ModeMixing mixing = ModeMixing::kBenzeggaghKenane;
  double mixing_exponent = 2;  // eta, at least 1
};

/// What a link remembers. All 0: damage has not begun.
struct ZoneHistory {
  double onset = 0;  // s0 [J^1/2]
  double end =
      0;  // s_f [J^1/2]; at most `onset`: there was too little toughness to soften, and the link breaks as a brittle one
  double largest = 0;  // s_max so far [J^1/2]
  double shear = 0;    // B where damage began
  bool begun() const { return onset > 0; }
  bool gone() const { return begun() && largest >= end; }
};

struct ZoneResponse {
  double potential = 0;                 // stored, and dissipated by moving here from the last commit [J]
  double stored = 0;                    // [J]
  double f_n = 0, f_t = 0;              // its derivatives with respect to d_n and d_t [N]
  double k_nn = 0, k_nt = 0, k_tt = 0;  // its second derivatives [N/m]
  double damage = 0;                    // d once committed
  bool advances = false;                // a commit would change the history
};

/// Energy that the whole link dissipates at mode mix B, `opening` being 1 - B [J]. Benzeggagh and Kenane, Compos. Sci. Technol. 56 (1996)
/// 439: G_I + (G_II - G_I) B^eta; power law: ((1 - B) / G_I)^eta + (B / G_II)^eta = 1 / G_c^eta.
template <class T>
T critical_energy(const ZoneLink& p, const T& opening, const T& shear) {
  using std::pow;
  const double eta = p.mixing_exponent;
  if (p.mixing == ModeMixing::kBenzeggaghKenane)
    return T(p.toughness_n) + T(p.toughness_t - p.toughness_n) * pow(shear, eta);
  if (p.toughness_n <= 0 || p.toughness_t <= 0) return T(0.0);
  const T sum = pow(opening * T(1 / p.toughness_n), eta) + pow(shear * T(1 / p.toughness_t), eta);
  return T(1.0) / pow(sum, 1 / eta);
}

/// The factor that brings forces with f_n = c_n f_n0 and |f_t| = c_t f_t0 (c_n, c_t >= 0, not both 0) onto the criterion: the root of
/// q c_n + (q c_t)^alpha = 1.
template <class T>
T factor_to_criterion(const T& c_n, const T& c_t, double alpha) {
  using std::pow;
  // Convex and rising: Newton's method comes down from any point above the root, such as where one of the two terms alone is 1.
  const double n = value_of(c_n), t = value_of(c_t);
  double q = std::min(n > 0 ? 1 / n : 1 / t, t > 0 ? 1 / t : 1 / n);
  for (int k = 0; k < 100; ++k) {
    const double next = q - (q * n + std::pow(q * t, alpha) - 1) / (n + alpha * t * std::pow(q * t, alpha - 1));
    if (!(next < q)) break;
    q = next;
  }
  if constexpr (std::is_same_v<T, double>) return q;
  // Each further iteration, on jets, doubles the order of the derivatives that are right.
  T root(q);
  for (int k = 0; k < 2; ++k)
    root = root - (root * c_n + pow(root * c_t, alpha) - T(1.0)) / (c_n + T(alpha) * c_t * pow(root * c_t, alpha - 1));
  return root;
}

template <class T>
struct ZoneOnset {
  T s, onset, energy;  // s here, s0, G_c [J^1/2], [J^1/2], [J]
  double shear = 0;    // B
};

/// Where damage begins on the way to these openings: their forces scaled back onto the criterion, under compression the tangential one
/// alone.
template <class T>
ZoneOnset<T> zone_onset(const ZoneLink& p, const T& d_n, const T& d_t) {
  using std::pow;
  using std::sqrt;
  const T shear = T(value_of(d_t) < 0 ? -1.0 : 1.0) * d_t;
  if (!(value_of(d_n) > 0)) {
    const T strength = T(p.strength_t) * pow(T(1.0) - T(p.k_n / p.strength_n) * d_n, 1 / p.alpha);
    return {T(std::sqrt(p.k_t)) * shear, T(1 / std::sqrt(p.k_t)) * strength, T(p.toughness_t), 1};
  }
  const T opening_part = T(p.k_n) * d_n * d_n, shear_part = T(p.k_t) * d_t * d_t, whole = opening_part + shear_part;
  const T s = sqrt(whole);
  const T q = factor_to_criterion<T>(T(p.k_n / p.strength_n) * d_n, T(p.k_t / p.strength_t) * shear, p.alpha);
  return {s, q * s, critical_energy<T>(p, opening_part / whole, shear_part / whole),
          value_of(shear_part) / value_of(whole)};
}

/// Stored energy, and energy dissipated since damage began, of a link that is stretched to s for the first time. s0 <= s, s0 < s_f.
template <class T>
T zone_potential(const T& s, const T& onset, const T& end) {
  if (value_of(s) >= value_of(end)) return T(0.5) * onset * end;
  const T sigma = onset * (end - s) / (end - onset);
  return T(0.5) * sigma * s + T(0.5) * onset * end * (s - onset) / (end - onset);
}

/// Energy that damage has dissipated: the area between the law and the line back to the origin [J].
inline double zone_dissipated(const ZoneHistory& h) {
  if (!h.begun() || h.end <= h.onset) return 0;
  return 0.5 * h.onset * h.end * (std::min(h.largest, h.end) - h.onset) / (h.end - h.onset);
}

/// s of these openings [J^1/2].
inline double energy_norm(const ZoneLink& p, double d_n, double d_t) {
  const double open = std::max(d_n, 0.0);
  return std::sqrt(p.k_n * open * open + p.k_t * d_t * d_t);
}

/// Whether damage begins at these openings, if it has not.
inline bool zone_begins(const ZoneLink& p, double d_n, double d_t) {
  return yield_function(p.k_n * d_n, p.k_t * d_t, p.strength_n, p.strength_t, p.alpha) >= 0;
}

/// The history after a commit at these openings.
inline ZoneHistory advanced(const ZoneLink& p, ZoneHistory h, double d_n, double d_t) {
  if (h.begun()) {
    h.largest = std::max(h.largest, energy_norm(p, d_n, d_t));
  } else if (zone_begins(p, d_n, d_t)) {
    const auto at = zone_onset<double>(p, d_n, d_t);
    h = {.onset = at.onset, .end = 2 * at.energy / at.onset, .largest = std::max(at.s, at.onset), .shear = at.shear};
  }
  return h;
}

/// Potential, force and stiffness at these openings with the history of the last commit.
inline ZoneResponse zone_response(const ZoneLink& p, const ZoneHistory& h, double d_n, double d_t) {
  ZoneResponse r;
  const bool pressed = !(d_n > 0);
  const auto elastic = [&](double intact) {  // `intact`: 1 - d
    r.k_nn = pressed ? p.k_n : intact * p.k_n, r.k_tt = intact * p.k_t;
    r.f_n = r.k_nn * d_n, r.f_t = r.k_tt * d_t;
    r.stored = r.potential = 0.5 * r.f_n * d_n + 0.5 * r.f_t * d_t;
    r.damage = 1 - intact;
  };
  const double pressing = pressed ? 0.5 * p.k_n * d_n * d_n : 0.0;

  if (!h.begun()) {
    r.advances = zone_begins(p, d_n, d_t);
    if (!r.advances) return elastic(1), r;
    // The onset, and so s0 and G_c, lie in the direction of these very openings: that too is differentiated.
    const auto at = zone_onset<Jet>(p, Jet::variable_x(d_n), Jet::variable_y(d_t));
    const Jet end = Jet(2.0) * at.energy / at.onset;
    if (end.value <= at.onset.value) return elastic(1), r;  // brittle: the commit takes it out
    const Jet w = zone_potential(at.s, at.onset, end);
    r.potential = w.value + pressing;
    r.f_n = w.x + (pressed ? p.k_n * d_n : 0.0), r.f_t = w.y;
    r.k_nn = w.xx + (pressed ? p.k_n : 0.0), r.k_nt = w.xy, r.k_tt = w.yy;
    const double sigma = std::max(0.0, at.onset.value * (end.value - at.s.value) / (end.value - at.onset.value));
    r.stored = 0.5 * sigma * at.s.value + pressing;
    r.damage = 1 - sigma / at.s.value;
    return r;
  }

  const double s = energy_norm(p, d_n, d_t);
  const auto secant = [&](double at) {  // sigma / s
    return at < h.end ? h.onset * (h.end - at) / ((h.end - h.onset) * at) : 0.0;
  };
  r.advances = s > h.largest;
  if (!r.advances) return elastic(secant(h.largest)), r;
  elastic(secant(s));
  r.potential = zone_potential(s, h.onset, h.end) - zone_dissipated(h) + pressing;
  // Second derivative: sigma / s K + (sigma' - sigma / s) / s^2 (K d)(K d)^T with K = diag(k_n or 0, k_t); the rest is elastic.
  const double slope = s < h.end ? -h.onset / (h.end - h.onset) : 0.0;
  const double c = (slope - (1 - r.damage)) / (s * s);
  const double q_n = pressed ? 0.0 : p.k_n * d_n, q_t = p.k_t * d_t;
  r.k_nn += c * q_n * q_n, r.k_nt += c * q_n * q_t, r.k_tt += c * q_t * q_t;
  return r;
}

/// Angle of the forces where damage began, as `mode_mix` [rad].
inline double zone_mode_mix(const ZoneLink& p, const ZoneHistory& h) {
  return mode_mix(std::sqrt(p.k_n * (1 - h.shear)), std::sqrt(p.k_t * h.shear), p.strength_n, p.strength_t);
}

/// The largest ratio, over all mode mixes in opening, of the energy with which the link reaches its criterion to its toughness. Below 1 it
/// softens; from 1 on it cannot, as s_f <= s0.
inline double brittleness(const ZoneLink& p) {
  double worst = 0;
  const int steps = p.k_t > 0 ? 720 : 0;
  for (int k = 0; k <= steps; ++k) {
    const double angle = steps > 0 ? 0.5 * M_PI * k / steps : 0.0;
    const double opening = std::cos(angle), shear = std::sin(angle);  // shares of s
    const double onset = factor_to_criterion<double>(std::sqrt(p.k_n) * opening / p.strength_n,
                                                     std::sqrt(p.k_t) * shear / p.strength_t, p.alpha);
    worst = std::max(worst, 0.5 * onset * onset / critical_energy<double>(p, opening * opening, shear * shear));
  }
  return worst;
}

}  // namespace lamella
