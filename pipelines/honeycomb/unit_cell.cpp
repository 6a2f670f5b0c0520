#include "pipelines/honeycomb/unit_cell.h"

#include <cmath>

#include "generator/sample/errors.h"
#include "postproc/quantities/cell_stress.h"
#include "simulator/assembly.h"

namespace lamella {
namespace {

// Strain at which stresses and forces are evaluated, forwards and backwards, so that what is not linear cancels to third order; large enough
// for the openings of stiff links not to be lost in the rounding of positions.
constexpr double kProbe = 1e-5;

Eigen::Vector3d flat(const Eigen::Matrix2d& m) { return {m(0, 0), m(1, 1), m(0, 1)}; }

Eigen::Matrix2d unit_strain(int k) {
  Eigen::Matrix2d strain = Eigen::Matrix2d::Zero();
  if (k < 2)
    strain(k, k) = 1;
  else
    strain(0, 1) = strain(1, 0) = 0.5;
  return strain;
}

}  // namespace

Eigen::Matrix2d uniaxial(int axis) {
  Eigen::Matrix2d stress = Eigen::Matrix2d::Zero();
  stress(axis, axis) = 1;
  return stress;
}

UnitCell::UnitCell(const Sample& patch, const Stage& stage)
    : patch_(patch), rest_(field_of(patch.x)), model_(build_model(patch, stage, rest_)) {
  std::vector<int> walls(patch.cells(), 0);
  for (const Wall& wall : patch.walls) ++walls[wall.cell_a], ++walls[wall.cell_b];
  centre_ = static_cast<Index>(std::max_element(walls.begin(), walls.end()) - walls.begin());
  const Index nodes = patch.cell_size(centre_), first = patch.cell_begin[centre_];
  for (const CellShape& shape : cell_shapes(patch, patch.x)) origin_.push_back(shape.centroid);
  twin_.assign(patch.nodes(), -1);
  for (Index c = 0; c < patch.cells(); ++c)
    for (Index k = patch.cell_begin[c]; k < patch.cell_begin[c + 1]; ++k)
      for (Index i = 0; i < nodes; ++i)
        if ((patch.x[k] - origin_[c] - patch.x[first + i] + origin_[centre_]).norm() < 1e-6) twin_[k] = i;
  if (walls[centre_] != 6 || patch.nodes() != nodes * patch.cells() || std::count(twin_.begin(), twin_.end(), -1) > 0)
    throw SceneError("unit cell: needs a patch of equal hexagons with one that is surrounded by six others");
  stiffness_ = assembled_stiffness(*model_, FreeComponents(rest_.size(), {}), rest_);
  Eigen::MatrixXd folded = Eigen::MatrixXd::Zero(2 * nodes, 2 * nodes);
  for (Index row = 0; row < 2 * nodes; ++row)
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(stiffness_, 2 * first + row); it; ++it)
      folded(row, 2 * twin_[it.col() / 2] + it.col() % 2) += it.value();
  folded_.compute(folded);
  for (int k = 0; k < 3; ++k) elasticity_.col(k) = flat(stress(unit_strain(k)));
}

bool UnitCell::touches_centre(const Link& link) const {
  const Index begin = patch_.cell_begin[centre_], end = patch_.cell_begin[centre_ + 1];
  return (link.a >= begin && link.a < end) || (link.b >= begin && link.b < end);
}

Eigen::VectorXd UnitCell::displacement(const Eigen::Matrix2d& strain) const {
  Eigen::VectorXd u(2 * patch_.nodes());
  for (Index c = 0; c < patch_.cells(); ++c)
    for (Index k = patch_.cell_begin[c]; k < patch_.cell_begin[c + 1]; ++k)
      u.segment<2>(2 * k) = strain * (origin_[c] - origin_[centre_]);
  const Eigen::VectorXd force = stiffness_ * u;
  const Eigen::VectorXd cell =
      folded_.solve(-force.segment(2 * patch_.cell_begin[centre_], 2 * patch_.cell_size(centre_)));
  for (Index k = 0; k < patch_.nodes(); ++k) u.segment<2>(2 * k) += cell.segment<2>(2 * twin_[k]);
  return u;
}

Field UnitCell::moved(const Eigen::VectorXd& by) const {
  Field x = rest_;
  for (std::size_t i = 0; i < x.size(); ++i) x.add(i, by.segment<2>(2 * static_cast<Eigen::Index>(i)));
  return x;
}

Eigen::Matrix2d UnitCell::stress(const Eigen::Matrix2d& strain) const {
  const double scale = kProbe / strain.norm();
  const Eigen::VectorXd u = displacement(strain) * scale;
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const double sign : {1.0, -1.0}) {
    const Field x = moved(sign * u);
    Frame frame;
    std::vector<double> positions;
    for (std::size_t i = 0; i < x.size(); ++i) positions.push_back(x.x[i]), positions.push_back(x.y[i]);
    frame.arrays.add({"x", "m", "node", 2, std::move(positions)});
    model_->links->add_output(x, frame.arrays);
    const FrameView view(patch_, frame);
    const Stress found = cell_stress(view, cell_shapes(patch_, view.x), 1)[centre_];
    Eigen::Matrix2d s;
    s << found.xx, found.xy, found.xy, found.yy;
    sum += sign * s / (2 * scale);
  }
  return sum;
}

Eigen::Matrix2d UnitCell::strain_of(const Eigen::Matrix2d& stress) const {
  const Eigen::Vector3d e = elasticity_.inverse() * flat(stress);
  Eigen::Matrix2d strain;
  strain << e[0], e[2] / 2, e[2] / 2, e[1];
  return strain;
}

SheetModuli UnitCell::moduli() const {
  const Eigen::Matrix3d s = elasticity_.inverse();
  SheetModuli m;
  m.young_x = 1 / s(0, 0), m.young_y = 1 / s(1, 1);
  m.poisson_x = -s(1, 0) / s(0, 0), m.poisson_y = -s(0, 1) / s(1, 1);
  m.bulk = 0.25 * (elasticity_(0, 0) + elasticity_(0, 1) + elasticity_(1, 0) + elasticity_(1, 1));
  m.shear = 1 / s(2, 2);
  return m;
}

std::vector<LinkForce> UnitCell::link_forces_at(const Eigen::Matrix2d& strain) const {
  const double scale = kProbe / strain.norm();
  const Eigen::VectorXd u = displacement(strain) * scale;
  auto forwards = link_forces(*model_, moved(u));
  const auto backwards = link_forces(*model_, moved(-u));
  for (std::size_t l = 0; l < forwards.size(); ++l) {
    forwards[l].normal = (forwards[l].normal - backwards[l].normal) / (2 * scale);
    forwards[l].tangential = (forwards[l].tangential - backwards[l].tangential) / (2 * scale);
  }
  return forwards;
}

double UnitCell::first_break(const Eigen::Matrix2d& stress, double normal_strength, double tangential_strength) const {
  const auto force = link_forces_at(strain_of(stress));
  double least = 1e300;
  for (std::size_t l = 0; l < force.size(); ++l) {
    if (!touches_centre(patch_.links[l])) continue;
    // a s + b s^2 = 1
    const double a = force[l].normal / normal_strength;
    const double b = std::pow(force[l].tangential / tangential_strength, 2);
    if (a > 0 || b > 0) least = std::min(least, 2 / (a + std::sqrt(a * a + 4 * b)));
  }
  return least;
}

}  // namespace lamella
