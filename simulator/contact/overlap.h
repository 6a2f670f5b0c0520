// What a node pays for overlapping a shell in several places at once.
//
// W = 1/2 k |u|^2, u the smallest displacement of the node that clears every overlap: n_f . u >= delta_f. For one foot it is the usual
// penalty 1/2 k delta^2; on a slightly concave wall two feet count about once; in a right-angled corner both walls push in full.
// Feet that face each other (n_1 . n_2 <= 0, as in a slot) do not share a displacement: their energies add. Both are one dual problem,
//   W / k = max over lambda >= 0 of  lambda . delta - 1/2 lambda . G lambda,   G_fg = max(0, n_f . n_g),
// whose solution lambda is also the derivative of W by the overlaps: continuous, and exact by the envelope theorem.
// It stays continuous while overlaps are below half the reach.
#pragma once
#include <Eigen/Core>

#include "simulator/contact/feet.h"

namespace lamella {

/// Per unit of stiffness.
struct Overlap {
  double energy = 0;                                 // [m2]
  Eigen::Vector3d lambda = Eigen::Vector3d::Zero();  // dW / d(overlap of each foot) [m]
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();    // dW / d(direction of each normal) [m2]
};

/// `reach` is the sum of the two radii; the overlap of a foot is reach - distance.
Overlap overlap(const Feet& feet, double reach);

/// Second derivative of W / k by the overlaps (first three rows) and the directions (last three).
Matrix6 overlap_stiffness(const Feet& feet, const Overlap& overlap);

/// The foot that presses most, which carries friction; -1: none presses.
int heaviest(const Feet& feet, const Overlap& overlap);

/// All that presses along the normal of one foot [m]: on a slightly concave wall its neighbour too, in a box corner not the other wall.
double pressing(const Feet& feet, const Overlap& overlap, int foot);

}  // namespace lamella
