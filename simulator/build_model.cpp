#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "generator/sample/errors.h"
#include "simulator/model.h"
#include "simulator/moving_box.h"

namespace lamella {
namespace {

/// The scene's section of every cell's group.
std::vector<const CellScene*> cell_sections(const Sample& sample, const Stage& stage) {
  std::vector<const CellScene*> section(sample.cells());
  for (Index c = 0; c < sample.cells(); ++c) section[c] = &stage.cell(sample.group_names[sample.group[c]]);
  return section;
}

/// Factor on the thickness of a cell's wall: stretching, mass and F_Y are in proportion to it, M_Y to its square, bending to its cube.
double thickness_factor(const Sample& s, std::size_t c) { return s.cell_thickness.empty() ? 1 : s.cell_thickness[c]; }

/// What is given directly cannot follow a thickness that varies from cell to cell.
void refuse_rigid_thickness(const Sample& s, const std::vector<const CellScene*>& section) {
  std::set<const CellScene*> seen;
  for (std::size_t c = 0; c < section.size(); ++c) {
    if (thickness_factor(s, c) == 1 || !seen.insert(section[c]).second) continue;
    const CellScene& cell = *section[c];
    for (const auto& [given, key] : {std::pair{cell.axial_rigidity.has_value(), "axial_rigidity"},
                                     {cell.bending_rigidity.has_value(), "bending_rigidity"},
                                     {cell.mass_per_length.has_value(), "mass_per_length"},
                                     {cell.yield_force.has_value(), "yield_force"},
                                     {cell.yield_moment.has_value(), "yield_moment"},
                                     {cell.break_force.has_value(), "break_force"}})
      if (given)
        throw SceneError(fmt::format(
            "line {}: cells.{}: the sample's walls vary in thickness, which this does not follow; give young, density, "
            "yield_stress or break_stress instead",
            cell.line, key));
  }
}

/// Half the segments on either side of each node [m].
std::vector<double> tributary_lengths(const Sample& s) {
  std::vector<double> length(s.nodes(), 0.0);
  for (Index c = 0; c < s.cells(); ++c)
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i)
      if (s.starts_segment(c, i)) length[i] += 0.5 * s.rest_length[i], length[s.next(c, i)] += 0.5 * s.rest_length[i];
  return length;
}

void set_masses(Model& model, const std::vector<const CellScene*>& section, const std::vector<double>& tributary) {
  const Sample& s = model.sample;
  model.mass.assign(s.nodes(), 0.0);
  model.inverse_mass.resize(s.nodes());
  for (Index c = 0; c < s.cells(); ++c) {
    const double line = section[c]->line_density() * thickness_factor(s, c);
    const double core = section[c]->core && s.closed[c]
                            ? section[c]->core->density * section[c]->depth * s.rest_area[c] / s.cell_size(c)
                            : 0.0;
    for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i) {
      model.mass[i] = line * tributary[i] + core;
      if (!(model.mass[i] > 0) || !std::isfinite(model.mass[i]))
        throw SceneError(
            fmt::format("cells.density: node {} of cell {} would have mass {:.3g} kg; give a positive density "
                        "(or mass_per_length)",
                        i, c, model.mass[i]));
      model.inverse_mass[i] = 1 / model.mass[i];
    }
  }
}

/// Values of an optional yield: infinite where absent; empty when no cell has one.
template <class Get>
std::vector<double> yields(const std::vector<const CellScene*>& section, Get get) {
  std::vector<double> out;
  for (std::size_t c = 0; c < section.size(); ++c)
    if (const auto y = get(*section[c])) {
      if (out.empty()) out.assign(section.size(), std::numeric_limits<double>::infinity());
      out[c] = *y;
    }
  return out;
}

/// Multiplies by a power of the cells' thickness factors.
std::vector<double> by_thickness(const Sample& s, std::vector<double> values, int power) {
  if (!s.cell_thickness.empty())
    for (std::size_t c = 0; c < values.size(); ++c) values[c] *= std::pow(s.cell_thickness[c], power);
  return values;
}

void add_core(Model& model, const std::vector<const CellScene*>& section) {
  const Sample& s = model.sample;
  CoreParameters p;
  bool any = false;
  for (Index c = 0; c < s.cells(); ++c) {
    double modulus = 0, pressure = 0, depth = 0;
    if (const auto& core = section[c]->core; core && s.closed[c]) {
      depth = section[c]->depth;
      pressure = core->pressure;
      if (!core->drained) {
        // eta = K / (E' h / 2 R), with R of the circle of the cell's rest area
        const double radius = std::sqrt(s.rest_area[c] / M_PI);
        modulus = core->modulus ? *core->modulus
                                : core->stiffness_ratio.value_or(0) * section[c]->axial() * thickness_factor(s, c) /
                                      (depth * 2 * radius);
      }
      if (core->drained && !core->pressure_history.empty())
        model.pressure_histories.push_back({c, &core->pressure_history});
      any = any || modulus != 0 || pressure != 0 || !core->pressure_history.empty();
    }
    p.modulus.push_back(modulus), p.pressure.push_back(pressure), p.depth.push_back(depth);
  }
  if (any) model.core = std::make_unique<Core>(model.layout, std::move(p));
}

/// The [links] section that governs a link between two groups.
const LinkScene& link_section(const Stage& stage, const std::string& a, const std::string& b) {
  const auto of_a = stage.links.find(a), of_b = stage.links.find(b), none = stage.links.end();
  if (of_a != none && of_b != none && of_a != of_b)
    throw SceneError(fmt::format(
        "links: [links.{}] and [links.{}] both claim the links between these groups; keep one of them", a, b));
  if (of_a != none) return of_a->second;
  if (of_b != none) return of_b->second;
  return stage.links.at("links");
}

/// The law of a unit link (of length 1, or one link) of this section.
ZoneLink zone_of(const LinkScene& scene, const LinkParameters& p) {
  return {.k_n = scene.normal_stiffness,
          .k_t = scene.tangential_stiffness,
          .strength_n = *scene.normal_strength,
          .strength_t = scene.tangential_strength.value_or(*scene.normal_strength),
          .alpha = p.exponent,
          .toughness_n = *scene.toughness,
          .toughness_t = scene.shear_toughness.value_or(*scene.toughness),
          .mixing = p.mixing,
          .mixing_exponent = p.mixing_exponent};
}

/// Links that store more, when they reach their criterion, than they may dissipate, cannot soften.
void check_toughness(const LinkScene& scene, const ZoneLink& unit) {
  const double ratio = brittleness(unit);
  if (ratio < 1) return;
  const double more = 1.001 * ratio, less = 0.999 / std::sqrt(ratio);
  const char *energy = scene.per == "length" ? "J/m" : "J", *force = scene.per == "length" ? "N/m" : "N";
  throw SceneError(fmt::format(
      "line {}: links.toughness: {:.4g} {} is too little: links store up to {:.4g} times their toughness before they "
      "begin to soften; give at least toughness = {:.4g} {} and shear_toughness = {:.4g} {}, or at most "
      "normal_strength = {:.4g} {} and tangential_strength = {:.4g} {}, or stiffer links",
      scene.line, unit.toughness_n, energy, ratio, more * unit.toughness_n, energy, more * unit.toughness_t, energy,
      less * unit.strength_n, force, less * unit.strength_t, force));
}

double strength_factor(const Sample& s, std::size_t link) {
  return s.link_strength.empty() ? 1 : s.link_strength[link];
}

/// Toughnesses of all links; 0 where they are brittle.
void add_toughness(LinkParameters& p, const Sample& s, const std::vector<const LinkScene*>& section) {
  std::map<const LinkScene*, double> strongest;
  for (std::size_t l = 0; l < s.links.size(); ++l)
    strongest[section[l]] = std::max(strongest[section[l]], strength_factor(s, l));
  for (const auto& [scene, factor] : strongest) {
    if (scene->law != "cohesive_zone") continue;
    ZoneLink unit = zone_of(*scene, p);
    unit.strength_n *= factor, unit.strength_t *= factor;
    check_toughness(*scene, unit);
  }
  for (std::size_t l = 0; l < s.links.size(); ++l) {
    const LinkScene& scene = *section[l];
    double opening = 0, shear = 0;
    if (scene.law == "cohesive_zone") {
      const ZoneLink unit = zone_of(scene, p);
      const double share = scene.per == "length" ? s.links[l].length : 1.0;
      opening = share * unit.toughness_n, shear = share * unit.toughness_t;
    }
    p.normal_toughness.push_back(opening), p.tangential_toughness.push_back(shear);
  }
}

void add_links(Model& model, const Stage& stage) {
  const Sample& s = model.sample;
  const auto cell_of = cell_of_node(s);
  LinkParameters p;
  const LinkScene& main = stage.links.at("links");
  p.exponent = main.exponent;
  p.mixing = main.mixing == "power" ? ModeMixing::kPower : ModeMixing::kBenzeggaghKenane;
  p.mixing_exponent = main.mixing_exponent.value_or(p.mixing == ModeMixing::kPower ? 1 : 2);
  std::vector<const LinkScene*> section;
  std::set<bool> breakable;
  for (std::size_t l = 0; l < s.links.size(); ++l) {
    const Link& link = s.links[l];
    const LinkScene& scene =
        link_section(stage, s.group_names[s.group[cell_of[link.a]]], s.group_names[s.group[cell_of[link.b]]]);
    section.push_back(&scene);
    const bool per_length = scene.per == "length";
    const double share = per_length ? link.length : 1.0, full = per_length ? link.spacing : 1.0;
    p.normal_stiffness.push_back(share * scene.normal_stiffness);
    p.tangential_stiffness.push_back(share * scene.tangential_stiffness);
    breakable.insert(scene.normal_strength.has_value());
    if (!scene.normal_strength) continue;
    const double factor = strength_factor(s, l), strength = factor * *scene.normal_strength;
    p.normal_strength.push_back(share * strength);
    p.tangential_strength.push_back(share * factor * scene.tangential_strength.value_or(*scene.normal_strength));
    p.full_energy.push_back(full * strength * strength / (2 * scene.normal_stiffness));
  }
  if (breakable.size() == 2)
    throw SceneError(
        "links: some groups have strengths and others none; give every [links] section a normal_strength, "
        "as large as it takes where links should not break");
  if (std::any_of(section.begin(), section.end(), [](const LinkScene* l) { return l->law == "cohesive_zone"; }))
    add_toughness(p, s, section);
  if (stage.contact) {
    p.contact_after = true;
    p.friction = stage.contact->friction;
    p.tangential_ratio = stage.contact->tangential_ratio;
  }
  model.links = std::make_unique<CohesiveLinks>(model.layout, std::move(p));
}

void add_contacts(Model& model, const Stage& stage, const std::vector<double>& tributary, const Field& x) {
  const Sample& s = model.sample;
  const ContactScene& scene = *stage.contact;
  double kappa = 0;
  if (scene.normal_stiffness) {
    kappa = *scene.normal_stiffness;
  } else if (!stage.links.empty()) {
    const LinkScene& links = stage.links.at("links");
    double mean = 0;  // per_link stiffness over the mean spacing
    for (const Link& link : s.links) mean += link.spacing / static_cast<double>(s.links.size());
    kappa = links.per == "length" ? links.normal_stiffness : mean > 0 ? links.normal_stiffness / mean : 0.0;
  }
  if (!(kappa > 0))
    throw SceneError("contact.normal_stiffness: missing, and there are no links to take it from; give it in N/m2");
  ContactParameters p;
  for (double length : tributary) p.node_stiffness.push_back(kappa * length);
  p.node_mass = model.mass;
  p.friction = scene.friction;
  p.tangential_ratio = scene.tangential_ratio;
  p.damping = scene.damping;
  p.skin = scene.skin;
  // A chain of one segment is a wall without nodes of its own: the others press against it with their full stiffness.
  for (Index c = 0; c < s.cells(); ++c) p.bare.push_back(!s.closed[c] && s.cell_size(c) == 2);
  model.contacts = std::make_unique<Contacts>(s, std::move(p), x);
  model.friction = scene.friction;
  model.contact_damping = scene.damping;
  if (model.links)
    for (Index l = 0; l < static_cast<Index>(s.links.size()); ++l) {
      model.contacts->set_pair_stiffness(l, model.links->normal_stiffness(l));
      model.contacts->set_intact(l);
    }
}

/// Values of an optional strength per cell: infinite where absent; empty when no cell has one.
WallStrength wall_strength(const Sample& sample, const std::vector<const CellScene*>& section) {
  WallStrength strength;
  strength.force = by_thickness(sample, yields(section, [](const CellScene& c) { return c.bar_strength(); }), 1);
  strength.strain = yields(section, [](const CellScene& c) { return c.break_strain; });
  for (Index c = 0; c < sample.cells(); ++c) {
    const auto force = section[c]->bar_strength(), flow = section[c]->bar_yield();
    if (force && flow && *force > *flow)
      throw SceneError(
          fmt::format("line {}: cells.break_{}: walls would flow at {:.4g} N and never reach the {:.4g} N at which "
                      "they break; give "
                      "less, or break_strain",
                      section[c]->line, section[c]->break_stress ? "stress" : "force", *flow, *force));
  }
  return strength;
}

std::unique_ptr<Model> assemble(const Sample& sample, const Stage& stage, const Field& x) {
  auto model = std::make_unique<Model>(sample);
  const auto section = cell_sections(sample, stage);
  const auto tributary = tributary_lengths(sample);
  refuse_rigid_thickness(sample, section);
  set_masses(*model, section, tributary);

  std::vector<double> axial, bending, bar_dashpot, hinge_dashpot;
  bool dashpots = false;
  for (const CellScene* cell : section) {
    axial.push_back(cell->axial());
    bending.push_back(cell->bending());
    bar_dashpot.push_back(cell->bar_dashpot);
    hinge_dashpot.push_back(cell->hinge_dashpot);
    dashpots = dashpots || cell->bar_dashpot > 0 || cell->hinge_dashpot > 0;
  }
  axial = by_thickness(sample, std::move(axial), 1), bending = by_thickness(sample, std::move(bending), 3);
  bar_dashpot = by_thickness(sample, std::move(bar_dashpot), 1);  // as a wall of one viscosity
  hinge_dashpot = by_thickness(sample, std::move(hinge_dashpot), 3);
  model->bars = std::make_unique<Bars>(
      model->layout, axial, by_thickness(sample, yields(section, [](const CellScene& c) { return c.bar_yield(); }), 1));
  bool bends = false;
  for (double b : bending) bends = bends || b > 0;
  if (bends)
    model->hinges = std::make_unique<Hinges>(
        model->layout, bending,
        by_thickness(sample, yields(section, [](const CellScene& c) { return c.hinge_yield(); }), 2));
  add_core(*model, section);
  if (!stage.links.empty()) {
    if (sample.links.empty())
      throw SceneError(
          "links: the sample has no facing points to link; remove [links], or make a sample whose cells face each "
          "other");
    add_links(*model, stage);
  }
  if (stage.contact) add_contacts(*model, stage, tributary, x);
  if (stage.gravity) model->gravity = std::make_unique<Gravity>(model->mass, stage.gravity->acceleration);
  if (stage.drag) model->drag_rate = stage.drag->rate;
  if (dashpots) model->dashpots = std::make_unique<Dashpots>(model->layout, bar_dashpot, hinge_dashpot);
  const WallStrength strength = wall_strength(sample, section);
  if (!strength.force.empty() || !strength.strain.empty()) model->add_rupture(strength);
  if (box_moves(sample, x)) {
    model->mass.push_back(box_mass(std::accumulate(model->mass.begin(), model->mass.end(), 0.0)));
    model->inverse_mass.push_back(1 / model->mass.back());
  }
  return model;
}

}  // namespace

double PressureHistory::at(double time) const {
  if (time <= points->front().x()) return points->front().y();
  for (std::size_t k = 1; k < points->size(); ++k)
    if (const Vec2& before = (*points)[k - 1], &after = (*points)[k]; time <= after.x()) {
      const double u = (time - before.x()) / (after.x() - before.x());
      return (1 - u) * before.y() + u * after.y();
    }
  return points->back().y();
}

std::unique_ptr<Model> build_model(const Sample& sample, const Stage& stage, const Field& x) {
  try {
    return assemble(sample, stage, x);
  } catch (const SceneError& error) {  // "line N: ..." of the sections' own sources
    std::vector<std::string> faults = error.faults();
    for (std::string& fault : faults)
      if (!stage.file.empty() && fault.starts_with("line ")) fault = stage.file + ":" + fault.substr(5);
    throw SceneError(std::move(faults));
  }
}

void Model::add_rupture(const WallStrength& strength) {
  rupture = std::make_unique<WallRupture>(
      layout, strength,
      WallRupture::Parts{.bars = bars.get(), .hinges = hinges.get(), .core = core.get(), .dashpots = dashpots.get()});
  if (contacts) contacts->watch(rupture->broken());
  if (links) links->keep_break_times();
}

std::vector<ShellTerm*> Model::shell_terms() const {
  std::vector<ShellTerm*> out;
  for (ShellTerm* term : std::initializer_list<ShellTerm*>{bars.get(), hinges.get(), core.get()})
    if (term) out.push_back(term);
  return out;
}

std::vector<Term*> Model::terms() const {
  std::vector<Term*> out;
  for (Term* term :
       std::initializer_list<Term*>{bars.get(), hinges.get(), core.get(), links.get(), contacts.get(), gravity.get()})
    if (term) out.push_back(term);
  return out;
}

double Model::energy(const Field& x) const {
  double sum = 0;
  for (const Term* term : terms()) sum += term->energy(x);
  return sum;
}

void Model::add_stiffness(const Field& x, StiffnessSink& sink) const {
  for (const Term* term : terms()) term->add_stiffness(x, sink);
}

bool Model::yields() const {
  const auto list = shell_terms();
  return std::any_of(list.begin(), list.end(), [](const ShellTerm* term) { return term->plastic(); });
}

double Model::plastic_dissipated() const {
  double sum = 0;
  for (const ShellTerm* term : shell_terms()) sum += term->dissipated();
  return sum;
}

void Model::hand_over(Break& event, const Field& x, double time) {
  links->set_break_time(event.link, time);
  if (!contacts) return;
  const double ignoring = contacts->pressing_across(event.link, x);
  const double rubbing = contacts->release(event.link, x, event.friction_force);
  const double pressing = contacts->pressing_across(event.link, x) - links->left_to_contact(event, x);
  event.energy -= pressing - ignoring + rubbing - links->left_to_friction(event);
}

std::size_t Model::bytes() const {
  std::size_t sum = 2 * sizeof(double) * mass.size();
  for (const Term* term : terms()) sum += term->bytes();
  if (dashpots) sum += dashpots->bytes();
  if (rupture) sum += rupture->bytes();
  return sum;
}

}  // namespace lamella
