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
    return k.assemble([&](StiffnessSink& sink) { model->add_stiffness(x, sink); });
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
    tissue.model->add_stiffness(tissue.x, sink);
    sink.add(5, 40, block), sink.add(40, 5, block.transpose());
  }));
  const Eigen::MatrixXd more = Eigen::MatrixXd(k.lower()) - before;
  EXPECT_NEAR(more.norm(), block.norm(), 1e-12);
  EXPECT_NEAR(more(free.row(40, 0), free.row(5, 1)), 3, 1e-12);
}

/// Elements of some cells alone, into another sink.
struct OfCells final : StiffnessSink {
  OfCells(StiffnessSink& to, const std::vector<std::uint8_t>& cells, std::uint8_t which)
      : sink(to), wanted(cells), value(which) {}
  void add(Index i, Index j, const Eigen::Matrix2d& block) override { sink.add(i, j, block); }
  bool begin_elements(Index cell) override { return wanted[cell] == value; }
  StiffnessSink& sink;
  const std::vector<std::uint8_t>& wanted;
  std::uint8_t value;
};

TEST(Assembly, of_some_cells_anew_leaves_what_the_others_have_added) {
  HeldTissue tissue;  // bars, hinges, cores, links, and contacts where walls are pressed into each other
  tissue.stage.contact.emplace().normal_stiffness = 100.0;
  tissue.model = build_model(tissue.sample, tissue.stage, tissue.x);
  const FreeComponents free(tissue.sample.nodes(), tissue.loads);
  StiffnessMatrix k(free, tissue.sample.cells()), oracle(free);
  ASSERT_TRUE(tissue.assemble(k));
  const Field before = tissue.x, now = shaken(tissue.sample, 0.02, 7);
  const std::vector<std::uint8_t> cells{1, 0, 0, 1, 0, 1};
  ASSERT_EQ(tissue.sample.cells(), static_cast<Index>(cells.size()));
  const auto visit_at = [&](const Field& x) {
    return [&](StiffnessSink& sink) { tissue.model->add_stiffness(x, sink); };
  };
  // What contacts add may lie elsewhere now: then all is assembled, once.
  if (!k.reassemble(cells, visit_at(now))) {
    k.assemble(visit_at(now)), k.assemble(visit_at(before));
    ASSERT_TRUE(k.reassemble(cells, visit_at(now)));
  }
  oracle.assemble([&](StiffnessSink& sink) {
    OfCells others(sink, cells, 0), these(sink, cells, 1);
    visit_at(before)(others), visit_at(now)(these);
  });
  const Eigen::MatrixXd expected = Eigen::MatrixXd(oracle.full()), scale = tissue.dense(free);
  const double rounding = 1e-12 * scale.cwiseAbs().maxCoeff();
  EXPECT_LT((Eigen::MatrixXd(k.full()) - expected).cwiseAbs().maxCoeff(), rounding);
  // All of them anew are all, and what was changed on the way is told.
  k.assemble(visit_at(before));
  const Eigen::MatrixXd was(k.full());
  ASSERT_TRUE(k.reassemble(cells, visit_at(now)));
  const Eigen::MatrixXd change = Eigen::MatrixXd(k.full()) - was;
  const auto& told = k.changed_rows();
  for (int row = 0; row < free.size(); ++row)
    EXPECT_EQ(change.row(row).cwiseAbs().maxCoeff() > rounding, std::find(told.begin(), told.end(), row) != told.end());
  ASSERT_TRUE(k.reassemble(std::vector<std::uint8_t>(cells.size(), 1), visit_at(now)));
  tissue.x = now;
  EXPECT_LT((Eigen::MatrixXd(k.full()) - tissue.dense(free)).cwiseAbs().maxCoeff(), rounding);
}

TEST(Assembly, of_all_cells_anew_leaves_what_belongs_to_none) {
  const HeldTissue tissue;
  const FreeComponents free(tissue.sample.nodes(), tissue.loads);
  StiffnessMatrix k(free, tissue.sample.cells());
  const Eigen::Matrix2d block = (Eigen::Matrix2d() << 1, 2, 2, 5).finished();
  const auto elements = [&](StiffnessSink& sink) { tissue.model->add_stiffness(tissue.x, sink); };
  k.assemble([&](StiffnessSink& sink) { sink.add(50, 50, block), elements(sink); });
  k.add_to_diagonal(free.row(60, 1), 7);
  ASSERT_TRUE(k.reassemble(std::vector<std::uint8_t>(tissue.sample.cells(), 1), elements));
  Eigen::MatrixXd expected = tissue.dense(free);
  const double rounding = 1e-12 * expected.cwiseAbs().maxCoeff();
  expected.block<2, 2>(free.row(50, 0), free.row(50, 0)) += block;
  expected(free.row(60, 1), free.row(60, 1)) += 7;
  EXPECT_LT((Eigen::MatrixXd(k.full()) - expected).cwiseAbs().maxCoeff(), rounding);
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
