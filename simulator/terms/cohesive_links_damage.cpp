// Links that soften before they break (laws/cohesive_zone.h): their forces, their history, its commit and its restart. Stations are first
// evaluated as undamaged ones, all at once; only those at or beyond the criterion, or damaged before, pass through here.
#include <fmt/format.h>

#include "generator/sample/errors.h"
#include "simulator/terms/cohesive_links.h"

namespace lamella {

ZoneLink CohesiveLinks::zone_link(Index l) const {
  return {.k_n = first_normal_stiffness_[l],
          .k_t = first_tangential_stiffness_[l],
          .strength_n = p_.normal_strength[l],
          .strength_t = p_.tangential_strength[l],
          .alpha = p_.exponent,
          .toughness_n = p_.normal_toughness[l],
          .toughness_t = p_.tangential_toughness[l],
          .mixing = p_.mixing,
          .mixing_exponent = p_.mixing_exponent};
}

void CohesiveLinks::respond(Index l, State& s) const {
  const ZoneResponse r = zone_response(zone_link(l), zone_[l], s.u_n, s.u_t);
  s.potential = r.potential, s.stored = r.stored;
  s.f_n = r.f_n, s.f_t = r.f_t;
  s.k_nn = r.k_nn, s.k_nt = r.k_nt, s.k_tt = r.k_tt;
  s.damage = r.damage, s.advances = r.advances;
}

bool CohesiveLinks::soften(const Field& x, Index first, Index last, LinkForces& out) const {
  out.advancing.clear();
  for (Index i = first; i < last; ++i) {
    const Index l = link_[i], at = i - first + 1;
    if (l < 0 || !intact_[l]) continue;
    if (!zone_[l].begun() &&
        yield_function(out.f_n[at], out.f_t[at], p_.normal_strength[l], p_.tangential_strength[l], p_.exponent) < 0)
      continue;
    const State s = state(x, l);
    const Vec2 force = s.f_n * s.n + s.f_t * s.t, frame = (-s.moment / s.tau) * s.n;
    out.f_n[at] = s.f_n, out.f_t[at] = s.f_t;
    out.fx[at] = force.x(), out.fy[at] = force.y();
    out.gx[at] = frame.x(), out.gy[at] = frame.y();
    if (s.advances) out.advancing.push_back(i);
  }
  return !out.advancing.empty();
}

// Every link here is that of one station, so that blocks commit theirs independently of each other.
void CohesiveLinks::commit_damage(const Field& x, Index first, LinkForces& out, std::vector<Break>& breaks) {
  for (const Index i : out.advancing) {
    const Index l = link_[i];
    const State s = state(x, l);
    const ZoneHistory next = advanced(zone_link(l), zone_[l], s.u_n, s.u_t);
    if (next.gone()) take_out(x, l, i - first + 1, out, breaks);
    zone_[l] = next;
  }
}

double CohesiveLinks::dissipated() const {
  double sum = 0;
  for (std::size_t l = 0; l < zone_.size(); ++l)
    if (intact_[l]) sum += zone_dissipated(zone_[l]);
  return sum;
}

bool CohesiveLinks::begins_beyond(const Field& x, double zeta) const {
  for (std::size_t l = 0; l < zone_.size(); ++l)
    if (const auto link = static_cast<Index>(l);
        intact_[l] && !zone_[l].begun() && zeta_of(link, state(x, link)) > zeta)
      return true;
  return false;
}

std::vector<double> CohesiveLinks::damage_fronts() const {
  std::vector<double> fronts;
  for (const ZoneHistory& h : zone_) fronts.push_back(h.largest);
  return fronts;
}

// Beams whose ends are pulled by f per length over the length z, open by f z^4 / EI there: by G / f at the end of the zone.
double CohesiveLinks::zone_length(Index l, double bending) const {
  if (!softens()) return 0;
  const double length = sample_.links[l].length;
  const double toughness = p_.normal_toughness[l] / length, strength = p_.normal_strength[l] / length;
  return std::pow(bending * toughness / (strength * strength), 0.25);
}

void CohesiveLinks::add_undamaged_stiffness(const Field& x, StiffnessSink& sink) const {
  for (Index l = 0; l < static_cast<Index>(sample_.links.size()); ++l) {
    if (!intact_[l]) continue;
    State s = state(x, l);
    s.k_nn = p_.normal_stiffness[l], s.k_nt = 0, s.k_tt = p_.tangential_stiffness[l];
    add_stiffness_of(l, s, sink);
  }
}

namespace {

// Names of the history's numbers in a restart, and their units.
struct HistoryArray {
  const char* name;
  const char* unit;
  double ZoneHistory::*member;
};
constexpr HistoryArray kHistory[] = {{"link_damage_onset", "J^(1/2)", &ZoneHistory::onset},
                                     {"link_damage_end", "J^(1/2)", &ZoneHistory::end},
                                     {"link_damage_largest", "J^(1/2)", &ZoneHistory::largest},
                                     {"link_damage_shear", "1", &ZoneHistory::shear}};

}  // namespace

void CohesiveLinks::save_damage(ArraySet& restart) const {
  for (const HistoryArray& array : kHistory) {
    std::vector<double> values;
    for (const ZoneHistory& h : zone_) values.push_back(h.*array.member);
    restart.add({array.name, array.unit, "link", 1, std::move(values)});
  }
}

void CohesiveLinks::restore_damage(const ArraySet& restart) {
  if (!restart.find(kHistory[0].name)) return;  // the stage before had no such law
  if (!softens()) {
    const auto& onset = restart.doubles(kHistory[0].name);
    for (std::size_t l = 0; l < onset.size(); ++l)
      if (intact_[l] && onset[l] > 0)
        throw SceneError(fmt::format(
            "links.law: link {} is damaged already, which brittle links cannot be; keep law = \"cohesive_zone\"", l));
    return;
  }
  for (const HistoryArray& array : kHistory) {
    const auto& values = restart.doubles(array.name);
    for (std::size_t l = 0; l < zone_.size(); ++l) zone_[l].*array.member = values.at(l);
  }
}

}  // namespace lamella
