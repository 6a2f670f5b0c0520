#include "pipelines/performance/tissue_lammps.h"

#include <fmt/os.h>

#include <algorithm>

namespace lamella {
namespace {

constexpr int kFree = 1, kFirstGrip = 2;  // atom types
constexpr int kWall = 1, kLink = 2;       // bond types

std::vector<int> atom_types(const Sample& sample, const std::vector<Load>& loads) {
  std::vector<int> type(sample.nodes(), kFree);
  for (std::size_t l = 0; l < loads.size(); ++l)
    for (Index i : loads[l].nodes) type[i] = kFirstGrip + static_cast<int>(l);
  return type;
}

/// Angle types: one for each resting angle of the sample, in degrees as LAMMPS counts them (180 is straight).
struct Angles {
  std::vector<double> degrees;
  std::vector<int> type;  // per node

  explicit Angles(const Sample& sample) {
    for (double turn : sample.rest_angle) {
      const double angle = 180 - std::abs(turn) * 180 / M_PI;
      auto at = std::find_if(degrees.begin(), degrees.end(), [&](double d) { return std::abs(d - angle) < 1e-6; });
      if (at == degrees.end()) at = degrees.insert(degrees.end(), angle);
      type.push_back(static_cast<int>(at - degrees.begin()) + 1);
    }
  }
};

}  // namespace

void write_lammps_data(const Sample& sample, const std::vector<Load>& loads, const std::filesystem::path& path) {
  const auto types = atom_types(sample, loads);
  const Angles angles(sample);
  const auto cell_of = cell_of_node(sample);
  auto out = fmt::output_file(path.string());
  const Vec2 room(60, 60);  // for the pulled ends
  const Vec2 low = sample.box.lo - room, high = sample.box.hi + room;
  out.print("lamella's tissue\n\n{} atoms\n{} bonds\n{} angles\n", sample.nodes(),
            static_cast<std::size_t>(sample.nodes()) + sample.links.size(), sample.nodes());
  out.print("{} atom types\n2 bond types\n{} angle types\n", kFirstGrip - 1 + loads.size(), angles.degrees.size());
  out.print("{} {} xlo xhi\n{} {} ylo yhi\n-0.5 0.5 zlo zhi\n\nMasses\n\n", low.x(), high.x(), low.y(), high.y());
  for (std::size_t t = 1; t < kFirstGrip + loads.size(); ++t) out.print("{} 1\n", t);

  out.print("\nAtoms # angle\n\n");
  for (Index i = 0; i < sample.nodes(); ++i)
    out.print("{} {} {} {:.12g} {:.12g} 0\n", i + 1, cell_of[i] + 1, types[i], sample.x[i].x(), sample.x[i].y());
  out.print("\nBonds\n\n");
  for (Index i = 0; i < sample.nodes(); ++i)
    out.print("{} {} {} {}\n", i + 1, kWall, i + 1, sample.next(cell_of[i], i) + 1);
  for (std::size_t l = 0; l < sample.links.size(); ++l)
    out.print("{} {} {} {}\n", static_cast<std::size_t>(sample.nodes()) + l + 1, kLink, sample.links[l].a + 1,
              sample.links[l].b + 1);
  out.print("\nAngles\n\n");
  for (Index i = 0; i < sample.nodes(); ++i)
    out.print("{} {} {} {} {}\n", i + 1, angles.type[i], sample.prev(cell_of[i], i) + 1, i + 1,
              sample.next(cell_of[i], i) + 1);
}

void write_lammps_parameters(const Sample& sample, const Stage& stage, const std::filesystem::path& path) {
  const CellScene& cell = stage.cell("cells");
  const LinkScene& link = stage.links.at("links");
  const double spacing = sample.rest_length[0], gap = sample.links[0].offset_n;
  auto out = fmt::output_file(path.string());
  // LAMMPS writes E = K (r - r0)^2: K is half of a stiffness.
  out.print("bond_coeff {} {} {}\n", kWall, 0.5 * cell.axial() / spacing, spacing);
  out.print("bond_coeff {} {} {}\n", kLink, 0.5 * link.normal_stiffness, gap);
  const Angles angles(sample);
  for (std::size_t t = 0; t < angles.degrees.size(); ++t)
    out.print("angle_coeff {} {} {}\n", t + 1, 0.5 * cell.bending() / spacing, angles.degrees[t]);
  // Repulsive Lennard-Jones, cut at its minimum: its curvature there, 72 epsilon / r_min^2, is the contact's stiffness.
  out.print("pair_style lj/cut {}\npair_coeff * * {} {} {}\npair_modify shift yes\n", gap,
            link.normal_stiffness * gap * gap / 72, gap / std::pow(2.0, 1.0 / 6), gap);
  out.print("variable stretch equal {}\n", 1 + *link.normal_strength / link.normal_stiffness / gap);
  out.print("variable rate equal {}\n", 0.5 * *stage.loading->speed);
  out.print("variable drag equal {}\n", stage.drag->rate * cell.line_density() * spacing);
  out.print("timestep {}\n", *stage.run.time_step);
}

}  // namespace lamella
