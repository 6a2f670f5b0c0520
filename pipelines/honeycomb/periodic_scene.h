// A patch of a honeycomb in which one cell is free and the others move as those of an infinite one.
#pragma once
#include "pipelines/honeycomb/unit_cell.h"
#include "pipelines/studies/study.h"

namespace lamella {

/// What the cells around the central one do under this stress, as loads for each of their nodes: a scene of its own.
Scene periodic_scene(const StudyBench& bench, const std::string& file, const std::string& name,
                     const std::vector<std::string>& settings, const UnitCell& cell, const Sample& sample,
                     const Eigen::Matrix2d& stress, double time, double ramp);

}  // namespace lamella
