// The box of a sample that repeats both ways and is pulled: its lengths L are two unknowns more. They are one more entry of every Field, behind
// those of the nodes, which holds what L has grown by: x.at(nodes) = L - L0 [m]. Where no box moves the entry is not there. What acts
// across a side of the box through an image of k = (k_x, k_y) steps is displaced by (k_x L_x, k_y L_y), so that its force acts on
// the entry too: k times the force on what is displaced.
//
// Inertia and drag are those of motions relative to the homogeneous one: node i moves as x_i = w_i + s_i (L - L0), s_i = (X_i - centre) / L0
// per component with X_i its place in the sample, and 1/2 m |dw/dt|^2 is its kinetic energy. So a box that changes its length carries
// all nodes with it at once; nothing enters at its sides alone, and no image of a cell is another's moving frame. w, L - L0 are the *relative*
// coordinates; a Field of them has w in place of x. Velocities are theirs.
#pragma once
#include "generator/sample/sample.h"
#include "simulator/positions.h"

namespace lamella {

/// Whether the field has an entry of a box that moves.
inline bool box_moves(const Sample& sample, const Field& x) { return x.size() > sample.x.size(); }
/// What the box's lengths have grown by [m]; 0 where it does not move.
inline Vec2 box_growth(const Sample& sample, const Field& x) {
  return box_moves(sample, x) ? x.at(sample.x.size()) : Vec2(0, 0);
}
/// Lengths of the box at x [m].
inline Vec2 box_size(const Sample& sample, const Field& x) { return sample.box.size() + box_growth(sample, x); }

inline Vec2 displacement(const Image& image, const Vec2& box_size) {
  return {image[0] * box_size.x(), image[1] * box_size.y()};
}
/// The derivative of a displacement by the box's lengths, (k_x, k_y).
inline Vec2 steps_of(const Image& image) { return {static_cast<double>(image[0]), static_cast<double>(image[1])}; }

/// s_i: by what share of the box's growth a node is carried along, per component.
inline Vec2 carried_share(const Sample& sample, std::size_t node) {
  return (sample.x[node] - 0.5 * (sample.box.lo + sample.box.hi)).cwiseQuotient(sample.box.size());
}

/// Mass of each component of the box's growth [kg]: the kinetic energy of a homogeneous body of this mass that stretches at the rate of one
/// of its lengths, its centre at rest, is 1/2 (mass / 12) (dL/dt)^2.
inline double box_mass(double mass_of_nodes) { return mass_of_nodes / 12; }

/// Relative coordinates of x, and back; the same where no box moves.
Field relative(const Sample& sample, Field x);
Field absolute(const Sample& sample, Field w);
/// Forces on relative coordinates from forces on x [N]: those on nodes stay, and the box gets its share of each.
void make_relative(const Sample& sample, Field& f);

/// Entries of the nodes alone, as they stand in files. Shape (nodes, 2), row by row.
std::vector<double> rows_of_nodes(const Sample& sample, const Field& field);
/// Fields of the nodes get the entry of a box.
void append_box(Field& field, const Vec2& entry);
inline Vec2 vec_from(const std::vector<double>& two) { return {two.at(0), two.at(1)}; }

}  // namespace lamella
