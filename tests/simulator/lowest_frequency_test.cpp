// The slowest swing of a sample, against the dense eigenproblem and known rings.
#include "simulator/lowest_frequency.h"

#include <Eigen/Eigenvalues>

#include "tests/simulator/tissues.h"
#include "tests/support/samples.h"

namespace lamella {
namespace {

TEST(LowestFrequency, of_a_free_ring_is_its_oval_mode) {
  Stage stage;
  stage.cells["cells"] = cell_scene(4800.0, 1.0, 1.0);
  const double exact[][2] = {{20, 2.64054}, {40, 2.67209}, {80, 2.67995}};  // physics.md 2c, m = mu l
  for (const auto& [nodes, omega] : exact) {
    const Sample ring = ring_sample(static_cast<int>(nodes));
    Rig rig(ring, stage);
    const auto found = lowest_frequency(*rig.model, {}, rig.state.x);
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found / omega, 1, 1e-4) << nodes;
  }
}

TEST(LowestFrequency, of_a_held_tissue_is_the_lowest_of_all) {
  const Sample tissue = hexagons(3, 3, 3, 0.05);
  Stage stage;
  stage.cells["cells"] = cell_scene(40.0, 0.05, 1.0);
  stage.links["links"] = link_scene("length", 80.0, 30.0, 2.0);
  Rig rig(tissue, stage);
  Load hold;
  hold.holds[0] = hold.holds[1] = true;
  for (Index i = 0; i < 12; ++i) hold.nodes.push_back(i);
  const auto found = lowest_frequency(*rig.model, {hold}, rig.state.x);

  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(2 * tissue.nodes(), 2 * tissue.nodes());
  for (const Term* term : rig.model->terms()) k += stiffness_of(*term, rig.state.x);
  Eigen::VectorXd scale(k.rows());
  for (int i = 0; i < k.rows(); ++i) scale[i] = std::sqrt(rig.model->inverse_mass[i / 2]);
  k = scale.asDiagonal() * k * scale.asDiagonal();
  const Eigen::MatrixXd free = k.bottomRightCorner(k.rows() - 24, k.rows() - 24);
  const double lowest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(free).eigenvalues()[0];
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found / std::sqrt(lowest), 1, 1e-3);
}

TEST(LowestFrequency, is_none_where_nothing_is_free) {
  Stage stage;
  stage.cells["cells"] = cell_scene(1.0, 1.0, 1.0);
  const Sample chain = chain_sample(2);
  Rig rig(chain, stage);
  Load hold;
  hold.holds[0] = hold.holds[1] = true;
  hold.nodes = {0, 1, 2};
  EXPECT_FALSE(lowest_frequency(*rig.model, {hold}, rig.state.x));
}

}  // namespace
}  // namespace lamella
