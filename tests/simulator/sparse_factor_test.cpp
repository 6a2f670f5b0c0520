// The factor behind equilibria: solves, is updated, and tells what is not positive definite.
#include "simulator/steppers/sparse_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace lamella {
namespace {

/// A grid of springs, two components a node, some of them diagonal: positive definite with any shift. Lower triangle, by columns.
struct Grid {
  explicit Grid(int side) : dense(Eigen::MatrixXd::Zero(2 * side * side, 2 * side * side)) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.5, 1.5);
    const auto spring = [&](int a, int b, double x, double y) {
      const Eigen::Vector2d t = Eigen::Vector2d(x, y).normalized();
      const Eigen::Matrix2d block = uniform(random) * t * t.transpose() + 0.01 * Eigen::Matrix2d::Identity();
      dense.block<2, 2>(2 * a, 2 * a) += block, dense.block<2, 2>(2 * b, 2 * b) += block;
      dense.block<2, 2>(2 * a, 2 * b) -= block, dense.block<2, 2>(2 * b, 2 * a) -= block;
    };
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        const int at = i * side + j;
        if (j + 1 < side) spring(at, at + 1, 1, 0.1);
        if (i + 1 < side) spring(at, at + side, 0.1, 1);
        if (i + 1 < side && j + 1 < side) spring(at, at + side + 1, 1, 1);
      }
    begin.push_back(0);
    for (int j = 0; j < dense.cols(); ++j) {
      for (int i = j; i < dense.rows(); ++i)
        if (i == j || dense(i, j) != 0) rows.push_back(i), values.push_back(dense(i, j));
      begin.push_back(static_cast<int>(rows.size()));
    }
  }
  Eigen::MatrixXd dense;
  std::vector<int> begin, rows;
  std::vector<double> values;
};

constexpr double kSingle = 1e-4;  // L is kept in single precision

TEST(SparseFactor, solves) {
  const Grid grid(17);
  SparseFactor factor;
  factor.analyze(grid.begin, grid.rows);
  for (const double shift : {1.0, 0.01}) {
    ASSERT_TRUE(factor.factorize(grid.values, shift));
    const Eigen::MatrixXd k = grid.dense + shift * Eigen::MatrixXd::Identity(grid.dense.rows(), grid.dense.cols());
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(k.rows(), -1, 2);
    const Eigen::VectorXd exact = k.llt().solve(b), x = factor.solve(b);
    EXPECT_LT((x - exact).norm(), kSingle * exact.norm());
  }
}

TEST(SparseFactor, solves_again_after_another_pattern) {
  SparseFactor factor;
  for (const int side : {3, 12, 5}) {
    const Grid grid(side);
    factor.analyze(grid.begin, grid.rows);
    ASSERT_TRUE(factor.factorize(grid.values, 0.1));
    const Eigen::MatrixXd k = grid.dense + 0.1 * Eigen::MatrixXd::Identity(grid.dense.rows(), grid.dense.cols());
    const Eigen::VectorXd b = Eigen::VectorXd::Ones(k.rows());
    const Eigen::VectorXd exact = k.llt().solve(b);
    EXPECT_LT((factor.solve(b) - exact).norm(), kSingle * exact.norm());
  }
}

TEST(SparseFactor, updated_equals_made_anew) {
  const Grid grid(15);
  const double shift = 0.05;
  SparseFactor factor;
  factor.analyze(grid.begin, grid.rows);
  ASSERT_TRUE(factor.factorize(grid.values, shift));
  Eigen::MatrixXd k = grid.dense + shift * Eigen::MatrixXd::Identity(grid.dense.rows(), grid.dense.cols());
  // Springs between neighbours become stiffer, then softer.
  for (const int node : {3, 40, 111, 200}) {
    const std::vector<int> rows{2 * node + 2, 2 * node + 3, 2 * node, 2 * node + 1};
    Eigen::MatrixXd c(4, 2);
    c << -0.3, 0.1, 0.2, 0.05, 0.3, -0.1, -0.2, -0.05;
    for (const int sign : {+1, -1}) {
      const Eigen::MatrixXd part = sign > 0 ? Eigen::MatrixXd(2 * c) : c;
      ASSERT_TRUE(factor.update(rows, part, sign));
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b) k(rows[a], rows[b]) += sign * part.row(a).dot(part.row(b));
    }
  }
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(k.rows(), 1, -3), exact = k.llt().solve(b);
  EXPECT_LT((factor.solve(b) - exact).norm(), kSingle * exact.norm());
}

TEST(SparseFactor, made_anew_in_part_is_made_anew) {
  Grid grid(20);
  const double shift = 0.05;
  SparseFactor factor, whole;
  factor.analyze(grid.begin, grid.rows), whole.analyze(grid.begin, grid.rows);
  ASSERT_TRUE(factor.factorize(grid.values, shift));
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(grid.dense.rows(), 1, -3);
  const auto change_near = [&](int node) {
    std::vector<int> rows;
    for (const int row : {2 * node, 2 * node + 1, 2 * node + 40, 2 * node + 41}) {
      grid.values[grid.begin[row]] += 0.3;
      rows.push_back(row);
    }
    return rows;
  };
  for (const int node : {0, 123, 377}) {
    const std::vector<int> rows = change_near(node);
    ASSERT_TRUE(factor.refactorize(grid.values, shift, rows));
    ASSERT_TRUE(whole.factorize(grid.values, shift));
    EXPECT_EQ(factor.solve(b), whole.solve(b));
  }
  // What an update has done to the factor alone is undone where its rows are made anew, and nowhere else.
  const std::vector<int> updated{200, 201, 202, 203};
  ASSERT_TRUE(factor.update(updated, 0.3 * Eigen::MatrixXd::Ones(4, 1), +1));
  EXPECT_NE(factor.solve(b), whole.solve(b));
  ASSERT_TRUE(factor.refactorize(grid.values, shift, {}));
  EXPECT_EQ(factor.solve(b), whole.solve(b));
}

TEST(SparseFactor, refuses_an_update_that_it_has_no_room_for) {
  const Grid grid(15);
  SparseFactor factor;
  factor.analyze(grid.begin, grid.rows);
  ASSERT_TRUE(factor.factorize(grid.values, 0.1));
  EXPECT_FALSE(factor.update({0, 2 * 15 * 15 - 1}, Eigen::MatrixXd::Constant(2, 1, 0.1), +1));
}

TEST(SparseFactor, tells_what_is_not_positive_definite) {
  const Grid grid(6);
  SparseFactor factor;
  factor.analyze(grid.begin, grid.rows);
  EXPECT_FALSE(factor.factorize(grid.values, -1.0));
  ASSERT_TRUE(factor.factorize(grid.values, 0.1));
  EXPECT_FALSE(factor.update({4}, Eigen::MatrixXd::Constant(1, 1, 10.0), -1));
  // What an update that failed leaves behind does not matter to the next factor.
  ASSERT_TRUE(factor.factorize(grid.values, 0.1));
  const Eigen::MatrixXd k = grid.dense + 0.1 * Eigen::MatrixXd::Identity(grid.dense.rows(), grid.dense.cols());
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(k.rows()), exact = k.llt().solve(b);
  EXPECT_LT((factor.solve(b) - exact).norm(), kSingle * exact.norm());
}

}  // namespace
}  // namespace lamella
