// Tissues and trajectories made by hand, with answers on paper: regular hexagons, glued face to face.
#pragma once
#include <filesystem>

#include "generator/sample/sample.h"
#include "simulator/trajectory/trajectory.h"

namespace lamella {

/// `columns` x `rows` pointy hexagons of side `side`, `segments` a side, Minkowski radius `radius`; facing nodes linked. Nodes of the
/// outer walls carry the sides' bits.
Sample hexagon_tissue(int columns, int rows, double side, int segments, double radius);

/// Two unit squares of four nodes side by side, at distance 2 r, with two links; the left one carries kLeft, the right one kRight.
Sample two_squares(double radius);

/// Links of the wall between two cells; empty when they share none.
std::vector<Index> links_between(const Sample& sample, Index cell_a, Index cell_b);

/// A frame with positions and, for every link, force, energy and state.
Frame plain_frame(const Sample& sample, const std::vector<Vec2>& x, double time);
/// Breaks links in the frame, at a time.
void break_links(Frame& frame, const std::vector<Index>& links, double time);

/// A tensile test made up from formulas: linear to the peak at strain 0.04, then torn along the walls above the middle row. E = 2 MPa,
/// nu = 0.3. Returns the trajectory's path.
std::filesystem::path made_up_tensile_test(const std::filesystem::path& folder, int columns, int rows, int frames);

/// A folder of the running test's own, empty.
std::filesystem::path fresh_folder();

}  // namespace lamella
