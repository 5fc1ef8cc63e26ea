// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/unfold/dense_matrix.h"
#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"
#include "unfold/cloth_energy.h"
#include "unfold/least_strain.h"
#include "unfold/strain_energy.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using unfolding::BlockMatrix;
using unfolding::BlockPattern;
using unfolding::ClothEnergy;
using unfolding::Plane;
using unfolding::Problem;

Cloth clothOf(double along, double across, double shear, Angle turn = {}) {
  Cloth cloth;
  cloth.weights = {along, across, shear, {}};
  cloth.grain = {Grain::Axis::Y, turn, {}};
  return cloth;
}

struct Sheet {
  Mesh mesh = test::irregularGrid(4, 3);
  Problem problem = *unfolding::makeProblem(test::patchOf(mesh));
  BlockPattern pattern = unfolding::couplingsOf(problem);

  explicit Sheet(const Cloth& cloth) {
    problem.grain = unfolding::grainOf(problem, mesh.positions(), cloth.grain);
  }
  [[nodiscard]] Plane plane(double stretch, double noise, unsigned seed) const {
    std::mt19937 random(seed);
    Plane q(2 * static_cast<Eigen::Index>(problem.vertexCount));
    for (std::size_t v = 0; v < problem.vertexCount; ++v) {
      for (int axis = 0; axis < 2; ++axis) {
        const double shift =
            noise * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1);
        q[static_cast<Eigen::Index>(2 * v) + axis] =
            stretch * mesh.position(VertexId(v))[axis] + shift;
      }
    }
    return q;
  }
  [[nodiscard]] Eigen::MatrixXd hessian(const ClothEnergy& cloth, const Plane& q, double indefinite,
                                        Eigen::VectorXd& gradient) const {
    BlockMatrix matrix(pattern);
    gradient = Eigen::VectorXd::Zero(q.size());
    cloth.addDerivatives(q, indefinite, gradient, matrix);
    return test::dense(matrix);
  }
};

TEST(Cloth, DerivativesAreThoseOfTheEnergy) {
  Cloth cloth = clothOf(4, 1, 0.1, Angle::degrees(30));
  cloth.stretchAlong = Ratio::percent(1);
  cloth.stretchAcross = Ratio::percent(4);
  cloth.shear = Ratio::percent(3);
  const Sheet sheet(cloth);
  const ClothEnergy energy(sheet.problem, sheet.pattern, cloth, 2);
  const Plane q = sheet.plane(1.03, 0.8, 3);
  Eigen::VectorXd gradient, unused;
  const Eigen::MatrixXd full = sheet.hessian(energy, q, 1, gradient);
  constexpr double kStep = 1e-6;
  Eigen::VectorXd ahead, behind;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const Plane forward = q + kStep * Plane::Unit(q.size(), i);
    const Plane backward = q - kStep * Plane::Unit(q.size(), i);
    EXPECT_NEAR(gradient[i], (energy.energy(forward) - energy.energy(backward)) / (2 * kStep),
                1e-6 * (1 + gradient.cwiseAbs().maxCoeff()));
    (void)sheet.hessian(energy, forward, 1, ahead);
    (void)sheet.hessian(energy, backward, 1, behind);
    const Eigen::VectorXd column = (ahead - behind) / (2 * kStep);
    EXPECT_LT((full.col(i) - column).cwiseAbs().maxCoeff(), 1e-5 * full.cwiseAbs().maxCoeff());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      sheet.hessian(energy, sheet.plane(0.7, 1.5, 7), 0, unused));
  EXPECT_GT(solver.eigenvalues().minCoeff(), -1e-9 * solver.eigenvalues().maxCoeff());
}

TEST(Cloth, OfEqualWeightsIsThePlainStrainWhereItIsSmall) {
  const Cloth cloth = clothOf(1, 1, 1, Angle::degrees(20));
  const Sheet sheet(cloth);
  const ClothEnergy woven(sheet.problem, sheet.pattern, cloth, 2);
  const unfolding::StrainEnergy plain(sheet.problem, sheet.pattern, 2);
  // Halving the strain must halve the relative difference: they agree to second order.
  const auto difference = [&](double share) {
    const Plane q = sheet.plane(1 + 0.02 * share, 0.1 * share, 5);
    return std::abs(woven.energy(q) / plain.energy(q) - 1);
  };
  EXPECT_LT(difference(1), 0.05);
  EXPECT_LT(difference(0.01), 1e-3);
}

// A square, 2 % larger on all sides than its cloth, with the grain on the bias: it could stay a
// square, but cloth that is four times as stiff along becomes a rhombus, long across. Two triangles
// leave its angle free and nothing else: it is the least of a function of one number.
TEST(Cloth, OnTheBiasTurnsALargerSquareIntoTheKnownRhombus) {
  const Cloth cloth = clothOf(4, 1, 0.1, Angle::degrees(45));
  Piece piece = test::patchOf(test::grid(1, 1));
  for (Wire& wire : piece.wires) {
    for (double& target : wire.targetLength) target *= 1.02;
  }
  const Result<FlatPiece> flat =
      unfold(piece, {.areaWeight = 1, .wireStiffness = 0, .cloth = cloth});
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_TRUE(flat->check.passes());
  const auto diagonal = [&](std::size_t a, std::size_t b) {
    return (flat->position[VertexId(a)] - flat->position[VertexId(b)]).norm();
  };
  // The grain is y turned by 45 degrees to the left: from the lower right to the upper left corner.
  const double along = diagonal(1, 2), across = diagonal(0, 3);

  const auto energy = [](double angle) {
    const Vector2d x(1.02, 0), y = 1.02 * Vector2d(std::cos(angle), std::sin(angle));
    const Vector2d u = (y - x) * std::sqrt(0.5), v = (-y - x) * std::sqrt(0.5);
    const double a = u.norm(), b = v.norm(), s = u.dot(v), j = x.x() * y.y();
    return 4 * (a - 1 / a) * (a - 1 / a) + (b - 1 / b) * (b - 1 / b) + 0.2 * s * s +
           2 * (j + 1 / j - 2);
  };
  double low = 1, high = 2;
  for (int i = 0; i < 200; ++i) {
    const double third = (high - low) / 3;
    (energy(low + third) < energy(high - third) ? high : low) +=
        energy(low + third) < energy(high - third) ? -third : third;
  }
  const double known = std::tan(0.5 * low);  // of the diagonals
  EXPECT_LT(known, 0.98);
  EXPECT_NEAR(along / across, known, 1e-4);
}

TEST(Cloth, TurnedByAQuarterWithSwappedWeightsIsTheSame) {
  const Piece piece = test::patchOf(test::saddle(10, 10, 0.003));
  const Result<FlatPiece> a = unfold(piece, {.cloth = clothOf(3, 1, 0.2)});
  Cloth swapped = clothOf(1, 3, 0.2, Angle::degrees(90));
  const Result<FlatPiece> b = unfold(piece, {.cloth = swapped});
  ASSERT_TRUE(a && b);
  EXPECT_TRUE(a->check.passes() && b->check.passes());
  for (std::size_t e = 0; e < piece.mesh->edgeCount(); ++e) {
    const VertexId tail = piece.mesh->tail(EdgeId(e)), head = piece.mesh->head(EdgeId(e));
    EXPECT_NEAR((a->position[tail] - a->position[head]).norm(),
                (b->position[tail] - b->position[head]).norm(), 1e-3);
  }
}

/// Mean of the strains along the grain, which is upright in the plane.
double meanStretchAlong(const Piece& piece, const FlatPiece& flat, const Grain& grain) {
  Problem problem = *unfolding::makeProblem(piece);
  problem.grain = unfolding::grainOf(problem, piece.mesh->positions(), grain);
  Plane q(2 * static_cast<Eigen::Index>(problem.vertexCount));
  for (std::size_t v = 0; v < problem.vertexCount; ++v) {
    q.segment<2>(2 * static_cast<Eigen::Index>(v)) = flat.position[VertexId(v)];
  }
  double sum = 0;
  for (std::size_t i = 0; i < problem.triangles.size(); ++i) {
    const auto f = unfolding::mapOf(problem.triangles[i], q);
    const Vector2d& a = problem.grain[i];
    const double length = std::hypot(f.xx * a.x() + f.xy * a.y(), f.yx * a.x() + f.yy * a.y());
    sum += problem.triangles[i].area * std::abs(length - 1);
  }
  return sum / problem.area;
}

TEST(Cloth, StiffAlongIsStretchedLessAlong) {
  const Piece piece = test::patchOf(test::saddle(12, 10, 0.004));
  const auto along = [&](const Cloth& cloth) {
    const Result<FlatPiece> flat = unfold(piece, {.cloth = cloth});
    EXPECT_TRUE(flat) << flat.error();
    if (!flat) return 1.0;
    EXPECT_TRUE(flat->check.passes());
    return meanStretchAlong(piece, *flat, cloth.grain);
  };
  const double plain = along(clothOf(1, 1, 1));
  EXPECT_LT(along(clothOf(1, 1, 0.1)), 0.8 * plain) << "woven cloth shears instead";
  EXPECT_LT(along(clothOf(4, 1, 0.1)), 0.5 * plain);
  Cloth limited = clothOf(1, 1, 1);
  limited.stretchAlong = Ratio::percent(0.1);
  EXPECT_LT(along(limited), 0.5 * plain);
}

TEST(Cloth, LiesWithItsGrainUpright) {
  const Mesh mesh = test::saddle(8, 10, 0.002);
  for (const double degrees : {0.0, 30.0, 45.0, -70.0}) {
    const Cloth cloth = clothOf(1, 1, 0.1, Angle::degrees(degrees));
    const Result<FlatPiece> flat = unfold(test::patchOf(mesh), {.cloth = cloth});
    ASSERT_TRUE(flat) << flat.error();
    const VertexId middle(4 * 9 + 4), above(6 * 9 + 4);
    const Vector2d up = flat->position[above] - flat->position[middle];
    // The grain is the mesh's y turned to the left, so y lies as far to the right of it.
    EXPECT_NEAR(std::atan2(up.x(), up.y()) * 180 / std::numbers::pi, degrees, 3);
  }
}

TEST(Cloth, RefusesWeightsOutOfRange) {
  for (const double weight : {0.0, -1.0, 1e4, std::nan("")}) {
    const Result<FlatPiece> flat =
        unfold(test::patchOf(test::grid(3, 3)), {.cloth = clothOf(1, weight, 1)});
    ASSERT_FALSE(flat);
    EXPECT_EQ(flat.error().code, ErrorCode::InvalidArgument);
  }
}

}  // namespace
}  // namespace toile
