// The table of all parameters: key, where it goes, unit, range, sentence. Defaults are those of scene.h.
#include "generator/sample/scene_rows.h"

#include <fmt/format.h>

#include <cmath>

#include "generator/sample/scene_ranges.h"

namespace lamella {
bool Range::contains(double value) const {
  return std::isfinite(value) && (low_excluded ? value > low : value >= low) &&
         (high_excluded ? value < high : value <= high);
}

std::string Range::text(const std::string& unit) const {
  const std::string tail = unit.empty() || unit == "1" ? "" : " " + unit;
  const std::string above = fmt::format("{} {:g}", low_excluded ? ">" : ">=", low);
  const std::string below = fmt::format("{} {:g}", high_excluded ? "<" : "<=", high);
  if (low == -kInfinity && high == kInfinity) return "";
  if (high == kInfinity) return above + tail;
  if (low == -kInfinity) return below + tail;
  if (!low_excluded && !high_excluded) return fmt::format("{:g} to {:g}{}", low, high, tail);
  return above + " and " + below + tail;
}

template <>
const std::vector<Row<Scene>>& rows() {
  static const std::vector<Row<Scene>> list{
      {.key = "title", .member = &Scene::title, .sentence = "Shown on pictures and in the report.", .fallback = "none"},
      {.key = "seed",
       .member = &Scene::seed,
       .range = kNotNegative,
       .sentence = "Of all random numbers: same scene and seed, same sample, bit for bit."},
  };
  return list;
}

template <>
const std::vector<Row<CellScene>>& rows() {
  using S = CellScene;
  static const std::vector<Row<S>> list{
      {.key = "thickness",
       .member = &S::thickness,
       .unit = "m",
       .range = kPositive,
       .sentence = "Wall thickness h, of which stiffness and mass are made.",
       .fallback = "required, unless rigidities, mass_per_length and radius are given"},
      {.key = "depth", .member = &S::depth, .unit = "m", .range = kPositive, .sentence = "Out-of-plane depth s."},
      {.key = "radius",
       .member = &S::radius,
       .unit = "m",
       .range = kPositive,
       .sentence = "Minkowski radius r: distance of the wall's outline from its centre line.",
       .fallback = "half the thickness"},
      {.key = "plane",
       .member = &S::plane,
       .sentence = "Plane strain or plane stress.",
       .choices = {"strain", "stress"}},
      {.key = "young",
       .member = &S::young,
       .unit = "Pa",
       .range = kPositive,
       .sentence = "Young's modulus E of the wall.",
       .fallback = "required, or both rigidities"},
      {.key = "poisson",
       .member = &S::poisson,
       .unit = "1",
       .range = {-1, 0.5, true},
       .sentence = "Poisson's ratio nu of the wall."},
      {.key = "axial_rigidity",
       .member = &S::axial_rigidity,
       .unit = "N",
       .range = kPositive,
       .sentence = "EA, instead of E, h and s; together with bending_rigidity.",
       .fallback = "E' h s"},
      {.key = "bending_rigidity",
       .member = &S::bending_rigidity,
       .unit = "N m2",
       .range = kNotNegative,
       .sentence = "EI, instead of E, h and s; 0 makes strings without bending.",
       .fallback = "E' s h3 / 12"},
      {.key = "density",
       .member = &S::density,
       .unit = "kg/m3",
       .range = kPositive,
       .sentence = "Of the wall.",
       .fallback = "required, or mass_per_length"},
      {.key = "mass_per_length",
       .member = &S::mass_per_length,
       .unit = "kg/m",
       .range = kPositive,
       .sentence = "Of the wall in its whole depth, instead of density.",
       .fallback = "density h s"},
      {.key = "yield_stress",
       .member = &S::yield_stress,
       .unit = "Pa",
       .range = kPositive,
       .sentence = "sigma_Y of bars and hinges; in plane strain they flow at 2 sigma_Y / sqrt 3.",
       .fallback = "elastic"},
      {.key = "yield_force",
       .member = &S::yield_force,
       .unit = "N",
       .range = kPositive,
       .sentence = "Axial force at which bars flow, instead of yield_stress.",
       .fallback = "from yield_stress"},
      {.key = "yield_moment",
       .member = &S::yield_moment,
       .unit = "N m",
       .range = kPositive,
       .sentence = "Moment at which hinges flow, instead of yield_stress.",
       .fallback = "from yield_stress"},
      {.key = "break_stress",
       .member = &S::break_stress,
       .unit = "Pa",
       .range = kPositive,
       .sentence = "Tension over h s at which a bar of the wall breaks, for good.",
       .fallback = "walls never break"},
      {.key = "break_force",
       .member = &S::break_force,
       .unit = "N",
       .range = kPositive,
       .sentence = "Tension at which a bar breaks, instead of break_stress.",
       .fallback = "from break_stress"},
      {.key = "break_strain",
       .member = &S::break_strain,
       .unit = "1",
       .range = kPositive,
       .sentence = "Elongation over the rest length, plastic part included, at which a bar breaks, instead.",
       .fallback = "no limit"},
      {.key = "bar_dashpot",
       .member = &S::bar_dashpot,
       .unit = "N s",
       .range = kNotNegative,
       .sentence = "c of an axial dashpot: force = c times strain rate of the segment."},
      {.key = "hinge_dashpot",
       .member = &S::hinge_dashpot,
       .unit = "N m2 s",
       .range = kNotNegative,
       .sentence = "c of a hinge dashpot: moment = c times rate of curvature."},
  };
  return list;
}

template <>
const std::vector<Row<CoreScene>>& rows() {
  using S = CoreScene;
  static const std::vector<Row<S>> list{
      {.key = "modulus",
       .member = &S::modulus,
       .unit = "Pa",
       .range = kNotNegative,
       .sentence = "K: pressure = p0 - K (A / A0 - 1).",
       .fallback = "this or stiffness_ratio is required when undrained"},
      {.key = "stiffness_ratio",
       .member = &S::stiffness_ratio,
       .unit = "1",
       .range = kNotNegative,
       .sentence = "eta = K / (E' h / 2 R), instead of the modulus; R is that of a circle of the rest area.",
       .fallback = "from modulus"},
      {.key = "pressure",
       .member = &S::pressure,
       .unit = "Pa",
       .sentence = "p0: pressure above that outside, at the rest area."},
      {.key = "drained", .member = &S::drained, .sentence = "The pressure does not depend on the area."},
      {.key = "pressure_history",
       .member = &S::pressure_history,
       .unit = "s",
       .sentence = "drained: [[time, pressure], ...], linear between, instead of a constant pressure.",
       .fallback = "none",
       .unit_of_second = "Pa"},
      {.key = "density",
       .member = &S::density,
       .unit = "kg/m3",
       .range = kNotNegative,
       .sentence = "Of the core; its mass is shared out to the nodes."},
  };
  return list;
}

template <>
const std::vector<Row<LinkScene>>& rows() {
  using S = LinkScene;
  static const std::vector<Row<S>> list{
      {.key = "per",
       .member = &S::per,
       .sentence = "Stiffness and strength are per length of wall, or of each link whatever its length.",
       .choices = {"length", "link"}},
      {.key = "normal_stiffness",
       .member = &S::normal_stiffness,
       .unit = "N/m2",
       .range = kPositive,
       .sentence = "k_n.",
       .fallback = "",
       .unit_per_link = "N/m",
       .required = true},
      {.key = "tangential_stiffness",
       .member = &S::tangential_stiffness,
       .unit = "N/m2",
       .range = kNotNegative,
       .sentence = "k_t.",
       .unit_per_link = "N/m"},
      {.key = "normal_strength",
       .member = &S::normal_strength,
       .unit = "N/m",
       .range = kPositive,
       .sentence = "f_n0 in opening, a positive number.",
       .fallback = "never breaks",
       .unit_per_link = "N"},
      {.key = "tangential_strength",
       .member = &S::tangential_strength,
       .unit = "N/m",
       .range = kPositive,
       .sentence = "f_t0, given together with normal_strength.",
       .fallback = "never breaks",
       .unit_per_link = "N"},
      {.key = "exponent",
       .member = &S::exponent,
       .unit = "1",
       .range = between(1, 100),
       .sentence =
           "alpha: a link breaks (or begins to soften) where f_n / f_n0 + |f_t / f_t0|^alpha = 1. One for all links."},
      {.key = "law",
       .member = &S::law,
       .sentence = "At that point a link breaks at once, or softens until it has dissipated its toughness.",
       .choices = {"brittle", "cohesive_zone"}},
      {.key = "toughness",
       .member = &S::toughness,
       .unit = "J/m",
       .range = kPositive,
       .sentence = "cohesive_zone: energy that a link takes in pure opening (per length of wall; depth included, as in "
                   "the strengths).",
       .fallback = "",
       .unit_per_link = "J"},
      {.key = "shear_toughness",
       .member = &S::shear_toughness,
       .unit = "J/m",
       .range = kPositive,
       .sentence = "cohesive_zone: the same in pure shear.",
       .fallback = "toughness",
       .unit_per_link = "J"},
      {.key = "mixing",
       .member = &S::mixing,
       .sentence = "cohesive_zone: how the toughness follows from the two where opening and shear come together. One "
                   "for all links.",
       .choices = {"benzeggagh_kenane", "power"}},
      {.key = "mixing_exponent",
       .member = &S::mixing_exponent,
       .unit = "1",
       .range = between(1, 100),
       .sentence = "cohesive_zone: eta of the mixing. One for all links.",
       .fallback = "2, power: 1"},
  };
  return list;
}

template <>
const std::vector<Row<ContactScene>>& rows() {
  using S = ContactScene;
  static const std::vector<Row<S>> list{
      {.key = "normal_stiffness",
       .member = &S::normal_stiffness,
       .unit = "N/m2",
       .range = kPositive,
       .sentence = "Penalty per length of wall.",
       .fallback = "that of the links"},
      {.key = "friction", .member = &S::friction, .unit = "1", .range = between(0, 10), .sentence = "Coulomb's mu."},
      {.key = "tangential_ratio",
       .member = &S::tangential_ratio,
       .unit = "1",
       .range = kPositiveFraction,
       .sentence = "Stiffness of the friction spring over that of the contact; used with friction."},
      {.key = "damping",
       .member = &S::damping,
       .unit = "1",
       .range = kFraction,
       .sentence = "Normal dashpot, as a fraction of critical damping."},
      {.key = "skin",
       .member = &S::skin,
       .unit = "m",
       .range = kPositive,
       .sentence = "By how much the search looks further than contact, so that its list lasts.",
       .fallback = "chosen from the segments"},
  };
  return list;
}

template <>
const std::vector<Row<GravityScene>>& rows() {
  static const std::vector<Row<GravityScene>> list{{.key = "acceleration",
                                                    .member = &GravityScene::acceleration,
                                                    .unit = "m/s2",
                                                    .sentence = "[x, y].",
                                                    .required = true}};
  return list;
}

template <>
const std::vector<Row<DragScene>>& rows() {
  static const std::vector<Row<DragScene>> list{
      {.key = "rate",
       .member = &DragScene::rate,
       .unit = "1/s",
       .range = kNotNegative,
       .sentence = "Viscous drag of every node: force = -rate times momentum.",
       .required = true}};
  return list;
}

template <>
const std::vector<Row<LoadScene>>& rows() {
  using S = LoadScene;
  static const std::vector<Row<S>> list{
      {.key = "name", .member = &S::name, .sentence = "By which later stages change or remove it.", .required = true},
      {.key = "velocity_x",
       .member = &S::velocity_x,
       .unit = "m/s",
       .sentence = "Prescribed; 0 holds.",
       .fallback = "free"},
      {.key = "velocity_y",
       .member = &S::velocity_y,
       .unit = "m/s",
       .sentence = "Prescribed; 0 holds.",
       .fallback = "free"},
      {.key = "force_x",
       .member = &S::force_x,
       .unit = "N",
       .sentence = "Total, shared equally by the nodes.",
       .fallback = "none"},
      {.key = "force_y",
       .member = &S::force_y,
       .unit = "N",
       .sentence = "Total, shared equally by the nodes.",
       .fallback = "none"},
      {.key = "line_force_x",
       .member = &S::line_force_x,
       .unit = "N/m",
       .sentence = "Per length of wall.",
       .fallback = "none"},
      {.key = "line_force_y",
       .member = &S::line_force_y,
       .unit = "N/m",
       .sentence = "Per length of wall.",
       .fallback = "none"},
      {.key = "ramp",
       .member = &S::ramp,
       .unit = "s",
       .range = kNotNegative,
       .sentence = "Time to reach the full value, smoothly."},
      {.key = "stop_force",
       .member = &S::stop_force,
       .unit = "N",
       .range = kPositive,
       .sentence = "The stage ends when the load exerts more than this: a lid has touched.",
       .fallback = "never"},
  };
  return list;
}

template <>
const std::vector<Row<InitialScene>>& rows() {
  using S = InitialScene;
  static const std::vector<Row<S>> list{
      {.key = "velocity_x",
       .member = &S::velocity_x,
       .unit = "m/s",
       .sentence = "When the stage begins. Entries that select the same node add up.",
       .fallback = "as it is: 0, or what the stage continues"},
      {.key = "velocity_y", .member = &S::velocity_y, .unit = "m/s", .sentence = "Likewise.", .fallback = "as it is"},
      {.key = "spin",
       .member = &S::spin,
       .unit = "rad/s",
       .sentence = "Rotation, counter-clockwise, added to the velocities; states both components.",
       .fallback = "none"},
      {.key = "centre",
       .member = &S::centre,
       .unit = "m",
       .sentence = "Of the spin.",
       .fallback = "the nodes' centre of mass"},
  };
  return list;
}

template <>
const std::vector<Row<Selection>>& rows() {
  using S = Selection;
  static const std::vector<Row<S>> list{
      {.key = "side",
       .member = &S::side,
       .sentence = "Nodes of all walls cut by that side of the box.",
       .fallback = "none",
       .choices = {"left", "right", "bottom", "top"}},
      {.key = "box", .member = &S::box, .unit = "m", .sentence = "[x0, y0, x1, y1]: nodes inside.", .fallback = "none"},
      {.key = "group", .member = &S::group, .sentence = "All nodes of the group's cells.", .fallback = "none"},
      {.key = "cells",
       .member = &S::cells,
       .range = kNotNegative,
       .sentence = "All nodes of these cells.",
       .fallback = "none"},
      {.key = "nodes", .member = &S::nodes, .range = kNotNegative, .sentence = "These nodes.", .fallback = "none"},
      {.key = "end",
       .member = &S::end,
       .sentence = "That end of the open chains of `group`, or of all; a clamp end is the last two nodes.",
       .fallback = "none",
       .choices = {"start", "end", "clamp_start", "clamp_end", "middle"}},
  };
  return list;
}

template <>
const std::vector<Row<LoadingScene>>& rows() {
  using S = LoadingScene;
  static const std::vector<Row<S>> list{
      {.key = "kind", .member = &S::kind, .sentence = "Of the test.", .choices = {"tension", "compression", "shear"}},
      {.key = "axis",
       .member = &S::axis,
       .sentence = "From grip to grip: x, left and right; y, bottom and top.",
       .choices = {"x", "y"}},
      {.key = "strain_rate",
       .member = &S::strain_rate,
       .unit = "1/s",
       .range = kPositive,
       .sentence = "Of the gauge length.",
       .fallback = "this or speed is required"},
      {.key = "speed",
       .member = &S::speed,
       .unit = "m/s",
       .range = kPositive,
       .sentence = "Of the moving grip, instead of strain_rate.",
       .fallback = "from strain_rate"},
      {.key = "both", .member = &S::both, .sentence = "Both grips move apart, each at half the speed."},
      {.key = "normal_only",
       .member = &S::normal_only,
       .sentence =
           "Grips hold only the component along the axis; not for shear. Of a sample that repeats both ways: the box's "
           "length across is free."},
      {.key = "ramp_strain",
       .member = &S::ramp_strain,
       .unit = "1",
       .range = kNotNegative,
       .sentence = "The rate grows from 0 over this strain, smoothly."},
      {.key = "strain", .member = &S::strain, .unit = "1", .range = kPositive, .sentence = "Where loading ends."},
      {.key = "unload", .member = &S::unload, .sentence = "Then back to strain 0 at the same rate."},
      {.key = "step",
       .member = &S::step,
       .unit = "1",
       .range = kPositive,
       .sentence = "Load by this strain, hold until at rest, and so on.",
       .fallback = "continuous"},
      {.key = "rest_tolerance",
       .member = &S::rest_tolerance,
       .unit = "1",
       .range = kInsideFraction,
       .sentence = "Relative unbalanced force that counts as rest; used with step."},
  };
  return list;
}

template <>
const std::vector<Row<StopScene>>& rows() {
  using S = StopScene;
  static const std::vector<Row<S>> list{
      {.key = "time",
       .member = &S::time,
       .unit = "s",
       .range = kPositive,
       .sentence = "After this time of the stage.",
       .fallback = "never"},
      {.key = "stress_drop",
       .member = &S::stress_drop,
       .unit = "1",
       .range = kInsideFraction,
       .sentence = "When the stress falls below this fraction of its peak so far.",
       .fallback = "never"},
      {.key = "separated",
       .member = &S::separated,
       .sentence = "When no path of shells and intact links joins the grips, or goes round a box that is pulled."},
      {.key = "at_rest",
       .member = &S::at_rest,
       .unit = "1",
       .range = kInsideFraction,
       .sentence = "When the relative unbalanced force falls below this.",
       .fallback = "never"},
      {.key = "compaction",
       .member = &S::compaction,
       .unit = "1",
       .range = {-1, 1, true, true},
       .sentence =
           "When the room between the walls has shrunk by this fraction since the sample; from above, when it has "
           "grown back to it. Walls: open chains along x and y on all four sides of the cells.",
       .fallback = "never"},
      {.key = "void_ratio",
       .member = &S::void_ratio,
       .unit = "1",
       .range = kPositive,
       .sentence = "When area without cells over area with cells, between the walls, falls below this.",
       .fallback = "never"},
  };
  return list;
}

template <>
const std::vector<Row<RunScene>>& rows() {
  using S = RunScene;
  static const std::vector<Row<S>> list{
      {.key = "stepper",
       .member = &S::stepper,
       .sentence = "velocity_verlet: explicit, in time, with inertia. quasi_static: equilibrium under a growing load, "
                   "and the exact load of "
                   "every break; time then only says where loads are. backward_euler, generalised_alpha: in time, with "
                   "inertia, by implicit "
                   "steps of any length (time_step; by default that between two rows of the response); first order and "
                   "damping, second "
                   "order. auto: quasi_static where the load is slow beside the slowest swing of the sample, else "
                   "velocity_verlet; the summary says why.",
       .choices = {"velocity_verlet", "quasi_static", "backward_euler", "generalised_alpha", "auto"}},
      {.key = "step_fraction",
       .member = &S::step_fraction,
       .unit = "1",
       .range = kPositiveFraction,
       .sentence = "Of the stable time step, which is found from the present stiffness."},
      {.key = "time_step",
       .member = &S::time_step,
       .unit = "s",
       .range = kPositive,
       .sentence = "A fixed one, instead of step_fraction; refused where an explicit scheme is not stable with it.",
       .fallback = "from step_fraction"},
      {.key = "slowdown",
       .member = &S::slowdown,
       .unit = "1",
       .range = kPositive,
       .sentence =
           "All that is prescribed in time takes this many times longer: velocities and rates are divided by it, "
           "ramps, histories and stop.time multiplied."},
      {.key = "accuracy",
       .member = &S::accuracy,
       .unit = "1",
       .range = kInsideFraction,
       .sentence =
           "Error of the largest load that is accepted: `lamella run` then chooses slowdown, drag (where the scene "
           "has no damping) and step_fraction, and says how large the error is by two runs.",
       .fallback = "as the scene says, error not estimated"},
      {.key = "threads",
       .member = &S::threads,
       .range = between(1, 256),
       .sentence = "The result does not depend on it."},
      {.key = "spectral_radius",
       .member = &S::spectral_radius,
       .unit = "1",
       .range = kFraction,
       .sentence =
           "generalised_alpha: share of a swing that is too fast for the step which is left after one: 1 all, 0 none."},
      {.key = "residual",
       .member = &S::residual,
       .unit = "1",
       .range = kInsideFraction,
       .sentence = "quasi_static and implicit steps: largest force that may be left, over the largest internal (or "
                   "inertia) force."},
      {.key = "load_tolerance",
       .member = &S::load_tolerance,
       .unit = "1",
       .range = kInsideFraction,
       .sentence = "quasi_static: a link breaks where its criterion is met within this."},
      {.key = "load_steps",
       .member = &S::load_steps,
       .range = between(1, 1000000),
       .sentence =
           "quasi_static: equilibria at least over the stage; walls that flow and contacts that rub need many."},
      {.key = "breaking",
       .member = &S::breaking,
       .sentence =
           "quasi_static: one_at_a_time: the most loaded link breaks, then equilibrium is found again. all_at_once: "
           "all links beyond their criteria break together; faster, and rougher.",
       .choices = {"one_at_a_time", "all_at_once"}},
      {.key = "unstable",
       .member = &S::unstable,
       .sentence =
           "quasi_static, where links break or soften without more load. fall: the load stays, and the curve drops. "
           "follow: the load goes back to where the next link just breaks, or as links soften, and the curve snaps "
           "back.",
       .choices = {"fall", "follow"}},
  };
  return list;
}

template <>
const std::vector<Row<OutputScene>>& rows() {
  using S = OutputScene;
  static const std::vector<Row<S>> list{
      {.key = "frames",
       .member = &S::frames,
       .range = between(1, 100000),
       .sentence = "Number of frames, about equally spaced in time."},
      {.key = "response",
       .member = &S::response,
       .range = between(1, 1e6),
       .sentence = "Rows of the response curve, likewise."},
  };
  return list;
}

template <>
const std::vector<Row<StageScene>>& rows() {
  static const std::vector<Row<StageScene>> list{
      {.key = "name", .member = &StageScene::name, .sentence = "Of the stage.", .required = true},
      {.key = "from",
       .member = &StageScene::from,
       .sentence = "Stage whose last frame it continues.",
       .fallback = "the previous one"},
  };
  return list;
}

}  // namespace lamella
