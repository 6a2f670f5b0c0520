// An infinite honeycomb whose cells all deform alike: the static, linear answer of one cell among copies of itself, from the assembled stiffness
// of the model's own terms. Knows nothing of the stepper.
#pragma once
#include <Eigen/Dense>
#include <memory>

#include "generator/sample/sample.h"
#include "pipelines/studies/equilibrium.h"
#include "simulator/model.h"

namespace lamella {

/// Moduli of a plane sheet of unit depth [N/m].
struct SheetModuli {
  double young_x = 0, young_y = 0;
  double poisson_x = 0, poisson_y = 0;  // under stress along x, y
  double bulk = 0, shear = 0;           // of its areas; of its angles
};

class UnitCell {
 public:
  /// `patch`: a honeycomb with a cell that is surrounded by six others. Throws SceneError where cells are not copies of each other.
  UnitCell(const Sample& patch, const Stage& stage);
  UnitCell(const UnitCell&) = delete;

  Index centre() const { return centre_; }
  bool touches_centre(const Link& link) const;
  /// Displacements of all nodes under a mean strain, in the order x, y of node 0, ... [m].
  Eigen::VectorXd displacement(const Eigen::Matrix2d& strain) const;
  /// Mean stress of a cell (Love and Weber, as post-processing defines it) under a mean strain [N/m].
  Eigen::Matrix2d stress(const Eigen::Matrix2d& strain) const;
  /// Mean strain under which the stress is this one.
  Eigen::Matrix2d strain_of(const Eigen::Matrix2d& stress) const;
  SheetModuli moduli() const;
  /// Forces of all links under a mean strain [N]; those that touch the central cell mean something.
  std::vector<LinkForce> link_forces_at(const Eigen::Matrix2d& strain) const;
  /// Factor of the stress at which the first link of a cell breaks (exponent 2).
  double first_break(const Eigen::Matrix2d& stress, double normal_strength, double tangential_strength) const;

 private:
  Field moved(const Eigen::VectorXd& by) const;

  const Sample& patch_;
  Field rest_;
  std::unique_ptr<Model> model_;
  Index centre_ = 0;
  std::vector<Vec2> origin_;  // of each cell: its centroid
  std::vector<Index> twin_;   // of each node: its place in the central cell, from 0
  Eigen::SparseMatrix<double, Eigen::RowMajor> stiffness_;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>
      folded_;                  // of the central cell, its neighbours moving with it
  Eigen::Matrix3d elasticity_;  // (xx, yy, xy) stress over (xx, yy, 2 xy) strain
};

/// sigma_xx = 1, or sigma_yy = 1, and nothing else.
Eigen::Matrix2d uniaxial(int axis);

}  // namespace lamella
