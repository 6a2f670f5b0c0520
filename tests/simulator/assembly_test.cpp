// The sparse stiffness against dense matrices.
#include "simulator/assembly.h"

#include <Eigen/Dense>

#include "tests/simulator/tissues.h"

namespace lamella {
namespace {

/// A shaken tissue, some of whose nodes are held in one component or both.
struct HeldTissue {
  HeldTissue() : sample(hexagons(2, 3, 2, 0.05)), x(shaken(sample, 0.01)) {
    stage.cells["cells"] = cell_scene(40.0, 0.05, 1.0);
    stage.cells["cells"].core.emplace().modulus = 3.0;
    stage.links["links"] = link_scene("length", 80.0, 30.0, 2.0);
    model = build_model(sample, stage, x);
    loads.resize(2);
    loads[0].nodes = {0, 1, 2, 17}, loads[0].holds[0] = loads[0].holds[1] = true;
    loads[1].nodes = {30, 31}, loads[1].holds[1] = true;
  }
  Eigen::MatrixXd dense(const FreeComponents& free) const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(2 * sample.nodes(), 2 * sample.nodes());
    for (const Term* term : model->terms()) all += stiffness_of(*term, x);
    Eigen::MatrixXd k(free.size(), free.size());
    for (Index i = 0; i < sample.nodes(); ++i)
      for (Index j = 0; j < sample.nodes(); ++j)
        for (int a = 0; a < 2; ++a)
          for (int b = 0; b < 2; ++b)
            if (free.row(i, a) >= 0 && free.row(j, b) >= 0)
              k(free.row(i, a), free.row(j, b)) = all(2 * i + a, 2 * j + b);
    return k;
  }
  bool assemble(StiffnessMatrix& k) const {
    return k.assemble([&](StiffnessSink& sink) {
      for (const Term* term : model->terms()) term->add_stiffness(x, sink);
    });
  }

  Sample sample;
  Field x;
  Stage stage;
  std::unique_ptr<Model> model;
  std::vector<Load> loads;
};

TEST(Assembly, is_the_dense_stiffness_without_what_is_held) {
  const HeldTissue tissue;
  const FreeComponents free(tissue.sample.nodes(), tissue.loads);
  EXPECT_EQ(free.size(), 2 * tissue.sample.nodes() - 10);
  StiffnessMatrix k(free);
  EXPECT_TRUE(tissue.assemble(k));
  EXPECT_FALSE(tissue.assemble(k));  // the pattern is known now
  const Eigen::MatrixXd dense = tissue.dense(free);
  const Eigen::MatrixXd lower = dense.triangularView<Eigen::Lower>();
  EXPECT_LT((Eigen::MatrixXd(k.lower()) - lower).cwiseAbs().maxCoeff(), 1e-12 * dense.cwiseAbs().maxCoeff());
}

TEST(Assembly, takes_blocks_that_were_not_there_before) {
  HeldTissue tissue;
  const FreeComponents free(tissue.sample.nodes(), tissue.loads);
  StiffnessMatrix k(free);
  tissue.assemble(k);
  const Eigen::Matrix2d block = (Eigen::Matrix2d() << 1, 2, 3, 4).finished();
  const Eigen::MatrixXd before(k.lower());
  EXPECT_TRUE(k.assemble([&](StiffnessSink& sink) {
    for (const Term* term : tissue.model->terms()) term->add_stiffness(tissue.x, sink);
    sink.add(5, 40, block), sink.add(40, 5, block.transpose());
  }));
  const Eigen::MatrixXd more = Eigen::MatrixXd(k.lower()) - before;
  EXPECT_NEAR(more.norm(), block.norm(), 1e-12);
  EXPECT_NEAR(more(free.row(40, 0), free.row(5, 1)), 3, 1e-12);
}

TEST(Assembly, gathers_and_moves_free_components_alone) {
  const HeldTissue tissue;
  const FreeComponents free(tissue.sample.nodes(), tissue.loads);
  Field x = tissue.x;
  free.add(Eigen::VectorXd::Ones(free.size()), 0.5, x);
  EXPECT_EQ(x.at(17), tissue.x.at(17));
  EXPECT_EQ(x.at(30), tissue.x.at(30) + Vec2(0.5, 0));
  EXPECT_EQ(x.at(3), tissue.x.at(3) + Vec2(0.5, 0.5));
  EXPECT_EQ(free.gathered(x)[free.row(3, 1)], x.y[3]);
}

}  // namespace
}  // namespace lamella
