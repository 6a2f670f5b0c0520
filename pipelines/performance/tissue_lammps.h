// The same tissue for LAMMPS: its data file (atoms, bonds, angles) and its parameters, from the sample and the scene that lamella runs.
#pragma once
#include <filesystem>

#include "generator/sample/scene.h"
#include "simulator/loads.h"

namespace lamella {

/// Mass points as atoms, cells as molecules, segments and links as bonds, hinges as angles; each load is an atom type.
void write_lammps_data(const Sample& sample, const std::vector<Load>& loads, const std::filesystem::path& path);

/// Stiffnesses, strength, drag, grip speed and time step, as commands that in.tissue includes.
void write_lammps_parameters(const Sample& sample, const Stage& stage, const std::filesystem::path& path);

}  // namespace lamella
