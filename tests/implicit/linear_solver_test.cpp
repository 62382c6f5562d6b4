#include "implicit/linear_solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace edda::linear_solver_test {
namespace {

/// Blocks of 6 to 12 components in a grid, each coupled to its four neighbours by random springs,
/// with something on the diagonal so that the matrix is positive definite; `stiff`: springs over
/// what is on the diagonal.
struct Grid {
  BlockMatrix matrix;
  Eigen::MatrixXd dense;

  Grid(std::size_t side, double stiff, unsigned seed) {
    const std::size_t n = side * side;
    std::vector<std::vector<Id>> columns(n);
    std::vector<std::pair<Id, Id>> pairs;
    for (Id r = 0; r < n; ++r) {
      columns[r].push_back(r);
      for (const Id c : {r + 1, static_cast<Id>(r + side)}) {
        if (c >= n || (c == r + 1 && c % side == 0)) continue;
        pairs.emplace_back(r, c);
        columns[r].push_back(c);
        columns[c].push_back(r);
      }
    }
    for (auto& row : columns) std::sort(row.begin(), row.end());
    std::vector<Eigen::Index> lines, first{0};
    for (std::size_t r = 0; r < n; ++r) {
      lines.push_back(6 + 2 * static_cast<Eigen::Index>(r % 4));
      first.push_back(first.back() + lines.back());
    }
    matrix.set_pattern(columns, lines);
    const Eigen::Index rows = first.back();
    dense = Eigen::MatrixXd::Identity(rows, rows);
    std::mt19937 rng(seed);
    std::normal_distribution<double> u;
    for (const auto& [r, c] : pairs) {
      Eigen::VectorXd g = Eigen::VectorXd::Zero(rows);
      for (const Id i : {r, c}) {
        for (Eigen::Index k = 0; k < lines[i]; ++k) g[first[i] + k] = u(rng);
      }
      dense += stiff * g * g.transpose();
    }
    for (Id r = 0; r < n; ++r) {
      for (const Id c : columns[r]) {
        matrix.at(r, matrix.slot(r, c)) = dense.block(first[r], first[c], lines[r], lines[c]);
      }
    }
  }
};

Eigen::VectorXd random_vector(Eigen::Index n, unsigned seed) {
  std::mt19937 rng(seed);
  std::normal_distribution<double> u;
  Eigen::VectorXd v(n);
  for (double& x : v) x = u(rng);
  return v;
}

TEST(BlockMatrix, HoldsWhatADenseOneDoes) {
  Grid grid(5, 10.0, 1);
  EXPECT_EQ(Eigen::MatrixXd(grid.matrix.scalar()), grid.dense);
  EXPECT_EQ(grid.matrix.slot(0, 24), no_id);
  grid.matrix.clear_row(7);
  const Eigen::MatrixXd cleared(grid.matrix.scalar());
  Eigen::VectorXd size = cleared.rowwise().norm();
  EXPECT_EQ(grid.matrix.part(size, 7).norm(), 0.0);
  EXPECT_GT(grid.matrix.part(size, 6).minCoeff(), 0.0);
}

TEST(LinearSolver, SolvesToItsTolerance) {
  for (const double stiff : {0.1, 10.0, 1e6}) {
    for (const double tolerance : {1e-3, 1e-10}) {
      Grid grid(8, stiff, 2);
      LinearSolver solver;
      const Eigen::VectorXd b = random_vector(grid.dense.rows(), 3);
      for (int again = 0; again < 3; ++again) {
        Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
        ASSERT_TRUE(solver.solve(grid.matrix, b, tolerance, x));
        const double rounding = 1e-14 * grid.dense.norm() * x.norm();
        EXPECT_LE((grid.dense * x - b).norm(), 1.01 * tolerance * b.norm() + rounding) << stiff;
      }
    }
  }
}

TEST(LinearSolver, OrdersOncePerPatternAndKeepsAFactorThatServes) {
  Grid grid(10, 1e4, 4);
  LinearSolver solver;
  const Eigen::VectorXd b = random_vector(grid.dense.rows(), 5);
  for (int solve = 0; solve < 30; ++solve) {
    // The matrix changes a little from solve to solve, as contacts do.
    const auto block = static_cast<Id>(solve % 10);
    grid.matrix.at(block, grid.matrix.slot(block, block)).diagonal().array() += 10.0;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
    ASSERT_TRUE(solver.solve(grid.matrix, b, 1e-8, x));
    EXPECT_LE((grid.matrix.scalar() * x - b).norm(), 1.01e-8 * b.norm());
  }
  EXPECT_EQ(solver.counts().orderings, 1u);
  EXPECT_GE(solver.counts().factorisations, 1u);
  EXPECT_LE(solver.counts().factorisations, 10u);
  solver.forget_pattern();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
  ASSERT_TRUE(solver.solve(grid.matrix, b, 1e-8, x));
  EXPECT_EQ(solver.counts().orderings, 2u);
}

TEST(LinearSolver, SaysSoWhereThereIsNoSolution) {
  Grid grid(3, 1.0, 6);
  grid.matrix.at(0, 0)(2, 2) = std::numeric_limits<double>::quiet_NaN();
  LinearSolver solver;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(grid.dense.rows());
  EXPECT_FALSE(solver.solve(grid.matrix, random_vector(x.size(), 7), 1e-8, x));
}

}  // namespace
}  // namespace edda::linear_solver_test
