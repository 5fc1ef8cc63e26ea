// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/sparse_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "unfold/dense_cholesky.h"

namespace toile::unfolding {
namespace {

double uniform(std::mt19937& random) {
  return 2.0 * static_cast<double>(random()) / std::mt19937::max() - 1;
}

/// A diagonally dominant matrix on the pattern, and the same one dense.
struct Sample {
  BlockPattern pattern;
  BlockMatrix matrix;
  Eigen::MatrixXd full;

  Sample(std::size_t nodes, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs,
         unsigned seed)
      : pattern(nodes, pairs), matrix(pattern) {
    std::mt19937 random(seed);
    const auto size = 2 * static_cast<Eigen::Index>(nodes);
    full = Eigen::MatrixXd::Zero(size, size);
    for (const auto& [i, j] : pairs) {
      Eigen::Matrix2d block;
      block << uniform(random), uniform(random), uniform(random), uniform(random);
      matrix.add(pattern.find(i, j), block);
      full.block<2, 2>(2 * i, 2 * j) += block;
      full.block<2, 2>(2 * j, 2 * i) += block.transpose();
    }
    for (std::uint32_t v = 0; v < nodes; ++v) {
      double sum = 0;
      for (const int row : {0, 1}) sum = std::max(sum, full.row(2 * v + row).cwiseAbs().sum());
      matrix.addDiagonal(v, sum + 1, 0.5, sum + 2);
      full.block<2, 2>(2 * v, 2 * v) << sum + 1, 0.5, 0.5, sum + 2;
    }
  }
};

void expectSolves(const Sample& sample) {
  SparseFactor factor(sample.pattern);
  ASSERT_TRUE(factor.factor(sample.matrix));
  const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(sample.full.rows(), -1, 2);
  Eigen::VectorXd x;
  factor.solve(sample.full * expected, x);
  EXPECT_LT((x - expected).cwiseAbs().maxCoeff(), 1e-12);
}

// Grids have supernodes of all sizes, a star has one, a graph of several parts several roots.
TEST(SparseFactor, SolvesOnGridsStarsAndSeparateParts) {
  for (const std::uint32_t side : {1U, 2U, 3U, 7U, 24U}) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t j = 0; j < side; ++j) {
      for (std::uint32_t i = 0; i < side; ++i) {
        const std::uint32_t v = j * side + i;
        if (i + 1 < side) pairs.emplace_back(v, v + 1);
        if (j + 1 < side) pairs.emplace_back(v, v + side);
        if (i + 1 < side && j + 1 < side) pairs.emplace_back(v + side + 1, v);
      }
    }
    expectSolves(Sample(side * side, pairs, side));
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> star, parts;
  for (std::uint32_t i = 1; i < 30; ++i) star.emplace_back(i, 0);
  for (std::uint32_t i = 0; i < 30; i += 3) parts.emplace_back(i, i + 1);
  expectSolves(Sample(30, star, 1));
  expectSolves(Sample(31, parts, 2));
}

TEST(SparseFactor, SolvesOnRandomGraphs) {
  std::mt19937 random(4);
  for (unsigned trial = 0; trial < 40; ++trial) {
    const std::uint32_t nodes = 2 + random() % 120;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t k = 0; k < 3 * nodes; ++k) {
      const std::uint32_t i = random() % nodes, j = random() % nodes;
      if (i != j) pairs.emplace_back(i, j);
    }
    SCOPED_TRACE(trial);
    expectSolves(Sample(nodes, pairs, trial));
  }
}

// Sizes around the tiles of the kernels, so that every remainder is met.
TEST(DenseCholesky, FactorsPanelsOfEverySize) {
  std::mt19937 random(7);
  std::vector<double> packed;
  for (std::size_t rows = 1; rows <= 45; rows += 1 + rows / 10) {
    for (std::size_t pivots = 1; pivots <= rows; pivots += 1 + pivots / 6) {
      const auto n = static_cast<Eigen::Index>(rows), k = static_cast<Eigen::Index>(pivots);
      Eigen::MatrixXd a(n, n);
      for (double& x : a.reshaped()) x = uniform(random);
      a = (a * a.transpose()).eval();
      a.diagonal().array() += 1;
      Eigen::MatrixXd panel = a.leftCols(k);
      ASSERT_TRUE(factorPanel(panel.data(), rows, pivots, packed));
      const Eigen::MatrixXd l = a.llt().matrixL();
      Eigen::MatrixXd update = a.bottomRightCorner(n - k, n - k);
      subtractOuterProduct(panel.data(), rows, pivots, update.data(), packed);
      const Eigen::MatrixXd rest = l.bottomRightCorner(n - k, n - k);
      const Eigen::MatrixXd expected = rest * rest.transpose();
      double worst = 0;
      for (Eigen::Index j = 0; j < k; ++j) {
        worst = std::max(worst, std::abs(1 / panel(j, j) - l(j, j)));
        for (Eigen::Index i = j + 1; i < n; ++i) {
          worst = std::max(worst, std::abs(panel(i, j) - l(i, j)));
        }
      }
      for (Eigen::Index j = 0; j < n - k; ++j) {
        for (Eigen::Index i = j; i < n - k; ++i) {
          worst = std::max(worst, std::abs(update(i, j) - expected(i, j)));
        }
      }
      EXPECT_LT(worst, 1e-12) << rows << " rows, " << pivots << " pivots";
    }
  }
}

}  // namespace
}  // namespace toile::unfolding
