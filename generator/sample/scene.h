// A scene: everything that a user can ask for, in SI units, as plain data. A section that is absent from the file is an
// empty optional here, and then nothing of it exists in the program: no object, no array, no output column.
// Units, ranges, defaults and sentences of all keys are stated once, in scene_rows.cpp.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "generator/sample/vec.h"

namespace lamella {

// ---- [sample]: geometry -------------------------------------------------------------------------------------------

/// [[sample.sizes.mixture]]: one kind of disk among several.
struct MixtureScene {
  std::string distribution = "lognormal";  // uniform | normal | lognormal | gamma | weibull
  double mean = 1;                         // mean radius [m]
  double cv = 0.1;                         // standard deviation over mean [1]
  std::optional<double> share;             // of the disks, by number [1]
  std::optional<double> area_share;        // of the area of all disks, instead [1]
  std::string group = "cells";             // of its cells
};

/// [sample.sizes]: radii of the disks.
struct SizesScene {
  std::string distribution =
      "lognormal";          // uniform | normal | lognormal | gamma | weibull | bidisperse | table | mixture | file
  double mean = 1;          // mean radius; only ratios matter when the box is given [m]
  double cv = 0.1;          // standard deviation over mean [1]
  double ratio = 1.4;       // bidisperse: large over small [1]
  double share = 0.5;       // bidisperse: share of large disks by number [1]
  std::vector<Vec2> table;  // table: (radius [m], density of probability), linear between
  std::string file;         // one radius a line
  std::vector<MixtureScene> mixture;
};

/// [sample.packing]
struct PackingScene {
  int count = 400;                   // number of disks
  double fraction = 0.81;            // area of the disks over area of the box [1]
  std::string boundary = "walls";    // walls | periodic
  bool jammed = false;               // compress until jammed, whatever the fraction
  std::string file;                  // CSV x,y,r instead of a packing of our own
  std::string duplicates = "error";  // error | keep_first
};

/// [[sample.domain.holes]]: a polygon, or a circle.
struct HoleScene {
  std::vector<Vec2> points;      // [m]
  Vec2 centre = Vec2::Zero();    // [m]
  std::optional<double> radius;  // [m]
};

/// [sample.domain]: what the tissue fills, where that is not the box.
struct DomainScene {
  std::string kind = "disk";  // disk | ring | polygon
  double radius = 0;          // disk, ring: outer [m]
  double inner_radius = 0;    // ring [m]
  std::vector<Vec2> points;   // polygon [m]
  int sides = 96;             // of the polygon that stands for a circle
  std::vector<HoleScene> holes;
};

/// [sample.areas]: the area of every cell as the sizes prescribe it.
struct AreasScene {
  std::string of = "tile";        // tile | inset: what has the area: the tile, or what the cell's outline leaves of it
  std::string sites = "packing";  // packing | random: where the search starts
  int sweeps = 0;                 // of Lloyd's: sites to the centres of their tiles, areas kept
  double tolerance = 1e-9;        // largest relative error of an area [1]
};

/// [[sample.layers]]: a part of the sample with a size or a group of its own.
struct LayerScene {
  std::string along = "y";    // x | y | radius: distance from the middle of the box
  double from = 0, to = 0;    // [m]
  std::vector<Vec2> polygon;  // instead [m]
  double size = 1;            // factor on the radii [1]
  std::string group = "cells";
};

/// [sample.gradient]: factors that depend on the place, as (position [m], factor) pairs, linear between.
struct GradientScene {
  std::string along = "y";      // x | y | radius
  std::vector<Vec2> size;       // on radii
  std::vector<Vec2> thickness;  // on the walls' thickness
  std::vector<Vec2> strength;   // on the links' strengths
};

/// [sample.stretch]: cells longer one way than the other, at the same area.
struct StretchScene {
  double ratio = 1;  // length over width of what would be round [1]
  double angle = 0;  // of the long way, from the x axis [rad]
};

/// [sample.image]: a picture of a real tissue.
struct ImageScene {
  std::string file;                 // PGM, PNG, TIFF
  std::string kind = "labels";      // labels: each pixel holds the number of its cell | grey: a micrograph
  double pixel = 1;                 // [m]
  std::string cells = "outlines";   // outlines: as they are | laguerre: the closest Laguerre tessellation
  int background = 0;               // labels: of what is no cell
  std::string walls = "dark";       // grey: dark | bright
  std::optional<double> threshold;  // grey: between wall and cell, 0 to 1; absent: Otsu's
  double smoothing = 1;             // grey: standard deviation of the blur [pixels]
  int least_area = 20;              // smaller cells are joined to the neighbour with the longest common wall [pixels]
  double simplify = 1;              // largest distance of a simplified wall from the pixels' boundary [pixels]
};

/// [sample.walls]: from tiles to shells of mass points.
struct WallsScene {
  double spacing = 0;         // asked distance of mass points [m]; 0: wall length / segments
  int segments = 0;           // asked segments on a wall of mean length (when spacing is 0)
  double weld = 0.05;         // edges below this fraction of the mean edge are welded to a point [1]
  std::string links = "all";  // all | ends | none
  double gap = 0;             // extra distance between facing outlines [m]; facing points lie at 2 r + gap
  double missing = 0;         // share of links that are absent, taken at random [1]
};

/// [sample.notch]: cells and links that a cut takes away.
struct NotchScene {
  std::vector<Vec2> line;     // polyline: links that it crosses are absent, walls stay [m]
  std::vector<Vec2> polygon;  // cells whose centre lies inside are absent [m]
};

/// [[sample.shapes]]: one shell more, beside or instead of a tissue.
struct ShapeScene {
  std::string kind = "chain";  // chain | plate | box | ring | polygon
  std::string group = "cells";
  Vec2 from = Vec2::Zero(),
       to = Vec2::Zero();      // ends of a chain or plate; corners of a box (an open shell that holds things) [m]
  Vec2 centre = Vec2::Zero();  // ring [m]
  double size = 0;             // radius of a ring's vertices [m]
  int segments = 0;
  double rotation = 0;               // ring: angle of its first vertex [rad]
  std::vector<Vec2> points;          // polygon [m]
  bool open = false;                 // polygon: an open chain
  std::string clamp = "none";        // chain: none | start | end | both: a ghost segment and half a hinge there
  std::string clamp_hinge = "half";  // half | full (the naive clamp)
};

/// [sample]
struct SampleScene {
  std::string kind = "tissue";   // tissue | rings | honeycomb | bricks | polygons | image | shapes
  double width = 0, height = 0;  // of the box [m]; 0: from the disks' sizes, or from the polygons
  SizesScene sizes;
  PackingScene packing;
  WallsScene walls;
  std::optional<NotchScene> notch;
  std::optional<DomainScene> domain;
  std::optional<AreasScene> areas;
  std::vector<LayerScene> layers;
  std::optional<GradientScene> gradient;
  std::optional<StretchScene> stretch;
  std::optional<ImageScene> image;
  std::string periodic = "none";  // none | x | y | xy: tissue, honeycomb, bricks go on beyond these sides
  // rings: on the disks of the packing
  int ring_nodes = 40;
  // honeycomb: regular hexagons of side `side`, `columns` x `rows`; orientation: which walls lie along x
  int columns = 0, rows = 0;
  double side = 0;                     // [m]
  std::string orientation = "pointy";  // pointy: two walls along y; flat: two walls along x
  // bricks: `columns` x `rows` rectangles, every second row shifted by `shift` of a brick
  Vec2 brick = Vec2::Zero();  // [m]
  double shift = 0.5;         // [1]
  // polygons: a tissue from elsewhere
  std::string file;                 // text, `x y cell` a line
  std::string outlines = "shared";  // shared | separate
  double facing_tolerance = 0;      // separate: largest distance of facing centre lines [m]; 0: 2 r + 10 %
  double scale = 1;                 // metres per unit of the file
  std::vector<ShapeScene> shapes;
};

// ---- material -----------------------------------------------------------------------------------------------------

/// [cells.core]
struct CoreScene {
  std::optional<double> modulus;          // K [Pa]
  std::optional<double> stiffness_ratio;  // eta = K / (E' h / 2 R), R from the rest area; instead of modulus
  double pressure = 0;                    // p0: over-pressure at rest area [Pa]
  bool drained = false;                   // pressure does not depend on the area
  std::vector<Vec2> pressure_history;     // (time [s], pressure [Pa]) pairs, linear between; drained only
  double density = 0;                     // of the core, its mass shared out to the nodes [kg/m3]
};

/// [cells], and [cells.NAME] for the group NAME, which inherits what it does not set.
struct CellScene {
  double thickness = 0;                    // h [m]
  double depth = 1;                        // s [m]
  std::optional<double> radius;            // Minkowski radius r [m]; default h / 2
  std::string plane = "strain";            // strain | stress
  std::optional<double> young;             // E [Pa]
  double poisson = 0;                      // nu
  std::optional<double> axial_rigidity;    // EA instead of E [N]
  std::optional<double> bending_rigidity;  // EI instead of E [N m2]
  std::optional<double> density;           // of the wall [kg/m3]
  std::optional<double> mass_per_length;   // of the wall, depth included, instead of density [kg/m]
  std::optional<double>
      yield_stress;  // sigma_Y [Pa]: F_Y = h s sigma, M_Y = s h^2 sigma / 4 (2 sigma / sqrt 3 in plane strain)
  std::optional<double> yield_force;   // F_Y instead [N]
  std::optional<double> yield_moment;  // M_Y instead [N m]
  // At which a bar breaks, one of the three; none: walls never break.
  std::optional<double> break_stress;  // mean tension over the wall's section [Pa]
  std::optional<double> break_force;   // tension [N]
  std::optional<double> break_strain;  // elongation over the rest length, plastic part included [1]
  double bar_dashpot = 0;              // axial viscosity: force = c / l * dl/dt, c [N s]
  double hinge_dashpot = 0;            // moment = c / lt * d(theta)/dt, c [N m2 s]
  std::optional<CoreScene> core;
  int line = 0;  // where the section stands, for messages

  // Derived. Both throw SceneError when neither way of giving them is present.
  double plane_modulus() const;                // E' [Pa]
  double axial() const;                        // EA [N]
  double bending() const;                      // EI [N m2]
  double line_density() const;                 // mass of the wall per length [kg/m]
  double outline_radius() const;               // r [m]
  std::optional<double> bar_yield() const;     // F_Y [N]
  std::optional<double> hinge_yield() const;   // M_Y [N m]
  std::optional<double> bar_strength() const;  // tension at which a bar breaks [N], by break_stress or break_force
};

/// [links], and [links.NAME] for links that touch the group NAME.
struct LinkScene {
  std::string per = "length";                 // length: N/m2, N/m | link: N/m, N
  double normal_stiffness = 0;                // k_n
  double tangential_stiffness = 0;            // k_t
  std::optional<double> normal_strength;      // |f_n0|; absent: never breaks
  std::optional<double> tangential_strength;  // f_t0
  double exponent = 2;                        // alpha
  std::string law = "brittle";                // brittle | cohesive_zone, with what follows
  std::optional<double> toughness;            // G_I: per length J/m, per link J
  std::optional<double> shear_toughness;      // G_II; absent: G_I
  std::string mixing = "benzeggagh_kenane";   // benzeggagh_kenane | power
  std::optional<double> mixing_exponent;      // eta; absent: 2, power: 1
  int line = 0;
};

/// [contact]
struct ContactScene {
  std::optional<double> normal_stiffness;  // per length of wall [N/m2]; default: that of the links
  double friction = 0;                     // mu
  double tangential_ratio = 0.1;           // k_t / k_n, used with friction
  double damping = 0;                      // normal dashpot as a fraction of critical [1]
  double skin = 0;                         // of the candidate search [m]; 0: chosen
  int line = 0;
};

struct GravityScene {
  Vec2 acceleration = Vec2::Zero();
};  // [gravity] [m/s2]
struct DragScene {
  double rate = 0;
};  // [drag] f = -rate m v [1/s]

// ---- loading ------------------------------------------------------------------------------------------------------

/// Which nodes: exactly one of the ways is used.
struct Selection {
  std::string side;        // left | right | bottom | top
  std::optional<Box> box;  // nodes inside [m]
  std::string group;       // all nodes of the group's cells
  std::vector<int> cells;  // all nodes of these cells
  std::vector<int> nodes;  // these nodes
  std::string end;  // start | end | clamp_start | clamp_end | middle of the chains of `group` ("" group: every chain)
};

/// [[loads]]: prescribed velocity or force of a group of nodes, per component. What is not given stays free.
struct LoadScene {
  std::string name;
  Selection nodes;
  std::optional<double> velocity_x, velocity_y;      // [m/s]; 0 holds
  std::optional<double> force_x, force_y;            // total on the group, shared equally [N]
  std::optional<double> line_force_x, line_force_y;  // per length of wall [N/m]
  double ramp = 0;                                   // time to reach the full value, smoothly [s]
  std::optional<double> stop_force;                  // the stage ends when it exerts more [N]
  int line = 0;
};

/// [[initial]]: velocities of a group of nodes when the stage in which it stands begins. Stages that continue that one do not inherit it.
struct InitialScene {
  Selection nodes;
  std::optional<double> velocity_x, velocity_y;  // [m/s]
  std::optional<double> spin;                    // counter-clockwise [rad/s]
  std::optional<Vec2> centre;                    // of the spin [m]; absent: the nodes' centre of mass
  int line = 0;
};

/// [loading]: the two grips of a test, in one section. Strain is engineering, tension and opening positive.
struct LoadingScene {
  std::string kind = "tension";       // tension | compression | shear
  std::string axis = "y";             // direction of the pull: x | y
  std::optional<double> strain_rate;  // [1/s], of the gauge length
  std::optional<double> speed;        // of the moving grip, instead [m/s]
  bool both = false;                  // both grips move apart at half the speed
  bool normal_only = false;           // the grips hold only the component along the axis
  double ramp_strain = 0;             // the rate grows from 0 to full over this strain, smoothly [1]
  double strain = 0.5;                // where loading ends [1]
  bool unload = false;                // then back to strain 0 at the same rate
  double step = 0;               // step-then-relax: load by this strain, hold until at rest, and so on; 0: continuous
  double rest_tolerance = 1e-4;  // relative unbalanced force that counts as rest
  int line = 0;
};

/// [stop]: a stage ends when the first of these holds.
struct StopScene {
  std::optional<double> time;         // of this stage [s]
  std::optional<double> stress_drop;  // stress below this fraction of its peak so far [1]
  bool separated = false;             // no path of shells and intact links joins the grips
  std::optional<double> at_rest;      // relative unbalanced force below this [1]
  std::optional<double> compaction;   // by which the room between the walls has shrunk since the sample: reached [1]
  std::optional<double> void_ratio;   // between the walls, below this [1]
  int line = 0;
};

/// [run]
struct RunScene {
  std::string stepper =
      "velocity_verlet";            // velocity_verlet | quasi_static | backward_euler | generalised_alpha | auto
  double step_fraction = 0.5;       // of the stable limit (row sums) [1]
  std::optional<double> time_step;  // [s]; refused above the limit
  double slowdown = 1;              // prescribed motions, ramps and times take this many times longer [1]
  std::optional<double> accuracy;   // accepted error of the largest load [1]
  int threads = 1;
  double spectral_radius = 0.8;  // of generalised_alpha at infinite frequency [1]
  // quasi_static; residual of implicit steps too
  double residual = 1e-4;                  // force that may be left, over the largest internal force [1]
  double load_tolerance = 1e-4;            // of a link's criterion, within which it breaks [1]
  int load_steps = 100;                    // at least, over the whole stage
  std::string breaking = "one_at_a_time";  // one_at_a_time | all_at_once
  std::string unstable = "fall";           // fall | follow
};

/// [output]
struct OutputScene {
  int frames = 50;      // about equally spaced in time
  int response = 1000;  // rows of the response curve, likewise
};

/// All that can change from stage to stage.
struct Stage {
  std::string name = "run";
  std::string from;                        // stage it continues; "" the previous one
  std::string file;                        // the scene's, for messages
  std::map<std::string, CellScene> cells;  // by group; "cells" is the [cells] section itself
  std::map<std::string, LinkScene> links;  // by group; "links" is the [links] section itself; empty: no links at all
  std::optional<ContactScene> contact;
  std::optional<GravityScene> gravity;
  std::optional<DragScene> drag;
  std::vector<LoadScene> loads;
  std::vector<InitialScene> initial;
  std::optional<LoadingScene> loading;
  StopScene stop;
  RunScene run;
  OutputScene output;

  /// Stretches all that is prescribed in time by run.slowdown; done once, when the scene is read.
  void slow_down();
  /// Parameters of a group: its own section, else [cells].
  const CellScene& cell(const std::string& group) const;
};

struct Scene {
  std::string title;
  std::uint64_t seed = 1;
  SampleScene sample;
  std::vector<Stage> stages;  // at least one; the sections of the file itself are the first

  std::filesystem::path path;          // of the file; relative paths inside start at its folder
  std::string text;                    // as read
  std::vector<std::string> overrides;  // from --set and --seed

  std::filesystem::path resolve(const std::string& file) const;  // a file named inside the scene
};

/// Reads and validates a scene. `overrides` are "section.key=value" in TOML. Throws SceneError with all faults at once,
/// each `file:line: what, and what would be right`; DataError when the file cannot be read.
Scene read_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});
/// The same from text; `name` stands for the file in messages.
Scene parse_scene(const std::string& text, const std::string& name = "scene",
                  const std::vector<std::string>& overrides = {});

/// Every parameter, one paragraph each: key, unit, range, default, sentence.
std::string describe_scene();
/// The same as a Markdown page (docs/scene_reference.md).
std::string scene_reference();

}  // namespace lamella
