// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "engine/unfold/dense_matrix.h"
#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"
#include "unfold/least_strain.h"
#include "unfold/sparse_factor.h"
#include "unfold/start.h"
#include "unfold/strain_energy.h"
#include "unfold/wire_bending.h"
#include "unfold/wire_lengths.h"

namespace toile::unfolding {
namespace {

using test::dense;

/// A small piece, a plane near it without flips, and the pattern.
struct Fixture {
  Problem problem;
  BlockPattern pattern;
  Plane q;

  Fixture(const Mesh& mesh, double stretch, double noise, unsigned seed)
      : problem(*makeProblem(test::patchOf(mesh))), pattern(problem.vertexCount, couplings()) {
    std::mt19937 random(seed);
    q.resize(2 * static_cast<Eigen::Index>(problem.vertexCount));
    for (std::size_t v = 0; v < problem.vertexCount; ++v) {
      for (int axis = 0; axis < 2; ++axis) {
        const double shift =
            noise * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1);
        q[static_cast<Eigen::Index>(2 * v) + axis] =
            stretch * mesh.position(VertexId(v))[axis] + shift;
      }
    }
  }
  [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> couplings() const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const RestTriangle& t : problem.triangles) {
      for (std::size_t k = 0; k < 3; ++k) pairs.emplace_back(t.vertex[k], t.vertex[(k + 1) % 3]);
    }
    for (const Corner& c : problem.corners) pairs.emplace_back(c.before, c.after);
    return pairs;
  }
};

Eigen::VectorXd gradientOf(const EnergyTerm& term, const Fixture& f, const Plane& q,
                           BlockMatrix& hessian) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(q.size());
  hessian.setZero();
  term.addDerivatives(q, 1, gradient, hessian);
  EXPECT_EQ(&hessian.pattern(), &f.pattern);
  return gradient;
}

void expectGradientMatchesEnergy(const EnergyTerm& term, const Fixture& f) {
  BlockMatrix hessian(f.pattern);
  const Eigen::VectorXd gradient = gradientOf(term, f, f.q, hessian);
  constexpr double kStep = 1e-5;
  for (Eigen::Index i = 0; i < f.q.size(); ++i) {
    Plane ahead = f.q, behind = f.q;
    ahead[i] += kStep;
    behind[i] -= kStep;
    const double slope = (term.energy(ahead) - term.energy(behind)) / (2 * kStep);
    EXPECT_NEAR(gradient[i], slope, 1e-6 * (1 + gradient.cwiseAbs().maxCoeff())) << "number " << i;
  }
}

/// The matrix of the term against differences of its gradient.
void expectMatrixIsSlopeOfGradient(const EnergyTerm& term, const Fixture& f, double tolerance) {
  BlockMatrix hessian(f.pattern), unused(f.pattern);
  (void)gradientOf(term, f, f.q, hessian);
  const Eigen::MatrixXd full = dense(hessian);
  constexpr double kStep = 1e-5;
  for (Eigen::Index i = 0; i < f.q.size(); ++i) {
    Plane ahead = f.q, behind = f.q;
    ahead[i] += kStep;
    behind[i] -= kStep;
    const Eigen::VectorXd column =
        (gradientOf(term, f, ahead, unused) - gradientOf(term, f, behind, unused)) / (2 * kStep);
    EXPECT_LT((full.col(i) - column).cwiseAbs().maxCoeff(), tolerance * full.cwiseAbs().maxCoeff());
  }
}

class Strain : public testing::TestWithParam<double> {};

TEST_P(Strain, GradientIsTheSlopeOfTheEnergy) {
  const Fixture f(test::irregularGrid(4, 3), 1.1, 1.5, 3);
  const StrainEnergy strain(f.problem, f.pattern, GetParam());
  ASSERT_TRUE(std::isfinite(strain.energy(f.q)));
  expectGradientMatchesEnergy(strain, f);
}

// Where every triangle is stretched a little no mode is negative, so that nothing is cut off and
// the matrix is the Hessian itself.
TEST_P(Strain, MatrixIsTheHessianOfStretchedTriangles) {
  const double stretch = 0.2 / (1 + GetParam() / 2);
  const Fixture f(test::irregularGrid(4, 3), 1 + stretch, stretch, 5);
  const StrainEnergy strain(f.problem, f.pattern, GetParam());
  expectMatrixIsSlopeOfGradient(strain, f, 1e-5);
}

TEST_P(Strain, MatrixIsNeverIndefinite) {
  const Fixture f(test::irregularGrid(4, 3), 0.6, 1.5, 7);
  const StrainEnergy strain(f.problem, f.pattern, GetParam());
  ASSERT_TRUE(std::isfinite(strain.energy(f.q)));
  BlockMatrix hessian(f.pattern);
  (void)gradientOf(strain, f, f.q, hessian);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense(hessian));
  EXPECT_GT(solver.eigenvalues().minCoeff(), -1e-9 * solver.eigenvalues().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(AreaWeights, Strain, testing::Values(0.0, 2.0, 50.0));

TEST(StrainEnergy, IsZeroForAnIsometryAndInfiniteForAFlip) {
  Fixture f(test::irregularGrid(4, 3), 1, 0, 1);
  const StrainEnergy strain(f.problem, f.pattern, 2);
  EXPECT_LT(strain.energy(f.q), 1e-24 * f.problem.area);
  for (Eigen::Index i = 0; i < f.q.size(); i += 2) f.q[i] = -f.q[i];
  EXPECT_EQ(strain.energy(f.q), std::numeric_limits<double>::infinity());
}

TEST(StrainEnergy, KnowsWhereAStepFlipsTheFirstTriangle) {
  const Fixture f(test::irregularGrid(4, 3), 1, 0.5, 2);
  const StrainEnergy strain(f.problem, f.pattern, 2);
  const Fixture direction(test::irregularGrid(4, 3), 0, 20, 9);
  const double border = strain.distanceToBorder(f.q, direction.q);
  ASSERT_TRUE(std::isfinite(border));
  EXPECT_TRUE(std::isfinite(strain.energy(f.q + 0.999 * border * direction.q)));
  EXPECT_FALSE(std::isfinite(strain.energy(f.q + 1.001 * border * direction.q)));
}

TEST(WireBending, GradientIsTheSlopeOfTheEnergy) {
  const Fixture f(test::irregularGrid(4, 3), 1.1, 1.5, 3);
  WireBending bending(f.problem, f.pattern, cornerAngles(f.problem, f.q));
  bending.setStiffness(7);
  EXPECT_GT(bending.energy(f.q), 1e-3);
  expectGradientMatchesEnergy(bending, f);
}

TEST(WireBending, MatrixIsTheHessianWithSecondDerivatives) {
  const Fixture f(test::irregularGrid(4, 3), 1.1, 1.5, 3);
  WireBending bending(f.problem, f.pattern, cornerAngles(f.problem, f.q));
  bending.setStiffness(7);
  bending.useSecondDerivatives();
  expectMatrixIsSlopeOfGradient(bending, f, 1e-6);
}

TEST(WireBending, AgreesWithTheTrianglesAngles) {
  const Fixture f(test::irregularGrid(4, 3), 1.1, 1.5, 4);
  WireBending bending(f.problem, f.pattern, cornerAngles(f.problem, f.q));
  bending.moveTo(f.q);  // now by continuity from the sums of the triangles' angles
  const std::vector<double> sums = cornerAngles(f.problem, f.q);
  ASSERT_EQ(sums.size(), 14U);
  for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_NEAR(bending.theta()[i], sums[i], 1e-12);
}

TEST(WireLengths, JacobianIsTheSlopeOfTheLengths) {
  const Fixture f(test::irregularGrid(4, 3), 1.1, 1.5, 3);
  WireLengths lengths(f.problem, f.pattern);
  lengths.linearise(f.q);
  const Fixture direction(test::irregularGrid(4, 3), 0, 1, 9);
  constexpr double kStep = 1e-5;
  const Eigen::VectorXd slope = (lengths.residual(f.q + kStep * direction.q, {}) -
                                 lengths.residual(f.q - kStep * direction.q, {})) /
                                (2 * kStep);
  EXPECT_LT((lengths.jacobianTimes(direction.q) - slope).cwiseAbs().maxCoeff(), 1e-8);
  Eigen::VectorXd transposed = Eigen::VectorXd::Zero(f.q.size());
  lengths.addTransposeTimes(slope, transposed);
  EXPECT_NEAR(transposed.dot(direction.q), slope.squaredNorm(), 1e-6);
}

// CHOLMOD's other code takes negative pivots silently; ours must notice.
TEST(SparseFactor, SolvesAndNoticesAnIndefiniteMatrix) {
  const Fixture f(test::irregularGrid(6, 6), 1.1, 1, 3);
  const StrainEnergy strain(f.problem, f.pattern, 2);
  BlockMatrix matrix(f.pattern);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(f.q.size());
  strain.addDerivatives(f.q, 1, gradient, matrix);
  for (std::uint32_t v = 0; v < f.problem.vertexCount; ++v) matrix.addDiagonal(v, 1, 0, 1);
  SparseFactor factor(f.pattern);
  ASSERT_TRUE(factor.factor(matrix));
  Eigen::VectorXd x;
  factor.solve(gradient, x);
  EXPECT_LT((dense(matrix) * x - gradient).norm(), 1e-10 * gradient.norm());
  matrix.addDiagonal(5, -1000, 0, 0);
  EXPECT_FALSE(factor.factor(matrix));
  matrix.addDiagonal(5, 1000, 0, 0);
  EXPECT_TRUE(factor.factor(matrix));
}

TEST(Start, TheCircleFlipsNothingAlsoAroundAHole) {
  const Mesh mesh = test::ring(60, 140, 32, 6, [](double x, double y) { return 0.004 * x * y; });
  const Problem problem = *makeProblem(test::patchOf(mesh));
  const std::optional<Plane> start = circleStart(problem);
  ASSERT_TRUE(start.has_value());
  EXPECT_EQ(flippedCount(problem, *start), 0U);
}

// A cap has a conformal map with the rim's lengths: onto the disk of that circumference.
TEST(Start, BoundaryFirstIsConformalWithTheBordersLengths) {
  const Mesh mesh = test::heightField(24, 24, 5, [](double x, double y) {
    return std::sqrt(200.0 * 200 - (x - 60) * (x - 60) - (y - 60) * (y - 60));
  });
  const Problem problem = *makeProblem(test::patchOf(mesh));
  const BlockPattern pattern = couplingsOf(problem);
  const auto start =
      boundaryFirstStart(problem, pattern, std::make_shared<const Elimination>(pattern));
  ASSERT_TRUE(start.has_value());
  EXPECT_EQ(flippedCount(problem, *start), 0U);
  for (const WireEdge& edge : problem.wireEdges) {
    EXPECT_NEAR((at(*start, edge.a) - at(*start, edge.b)).norm(), edge.target, 0.01 * edge.target);
  }
  double skew = 0;
  for (const RestTriangle& t : problem.triangles) {
    const auto [s1, s2] = singularValues(mapOf(t, *start));
    skew += (s1 / s2 - 1) * t.area / problem.area;
  }
  EXPECT_LT(skew, 0.02);  // of the mesh's coarseness
  const Problem ring =
      *makeProblem(test::patchOf(test::ring(60, 140, 32, 6, [](double, double) { return 0.0; })));
  const BlockPattern other = couplingsOf(ring);
  EXPECT_FALSE(boundaryFirstStart(ring, other, std::make_shared<const Elimination>(other)));
}

}  // namespace
}  // namespace toile::unfolding
