// SPDX-License-Identifier: GPL-3.0-or-later
#include "develop/shape.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "develop/curvature_potential.h"
#include "unfold/sparse_factor.h"

// Notation: u = motion of the inner vertices along their normals, mm; d = 2 pi - angle sum; A = how
// the angle sums answer to u; M = vertex areas; S = stiffness (cotangents) with the border held;
// phi = S^-1 d, the logarithm of the scale by which a conformal map with unchanged boundary lengths
// would lay the surface flat: 2 phi is the strain of area that the curvature costs. B = S M^-1 S,
// the energy of bending of u. A step solves, with L^2 the area of the piece,
//     minimise  phi' M phi / L^2 + epsilon u' B u + rho L^2 |S phi + A u - d|^2 (by M^-1).
// All terms are without unit: the same epsilon means the same on any mesh of the surface.
namespace toile::developing {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr double kMaxNormalTurn = std::numbers::pi / 3;
constexpr double kMaxEdgeChange = 0.3;
/// Vertices that come to such a limit are held; with more than this share the processing ends.
constexpr double kMaxHeld = 0.05;
constexpr double kHoldPrice = 1e8;
/// Edges shorter than this share of the mean are slivers of a cut and tell nothing of the shape.
constexpr double kShortEdge = 0.25;
/// How much rougher (root mean square of the angles between faces) the surface may become, and the
/// angle that is smooth in any case.
constexpr double kMaxRoughening = 1.5;
constexpr double kSmoothAngle = 0.02;
/// Of the motion in one step: steepest slope, greatest change of an edge.
constexpr double kMaxSlope = 0.1;
constexpr double kMaxStretch = 0.04;
/// Price epsilon of bending: smooth motions are tried first, then finer ones.
constexpr double kFirstPrice = 1;
constexpr double kLowestPrice = 1e-5;
constexpr double kHighestPrice = 1e3;
/// Price rho of missing S phi = d - A u: a near constraint.
constexpr double kLinkPrice = 1e2;
/// A step at the lowest price that gains less than this share is the last.
constexpr double kLeastGain = 0.01;
/// Root mean square of phi at which nothing is left to do: 0.02 % of area.
constexpr double kFlatEnough = 1e-4;

Vector3d faceNormal(const Mesh& mesh, const Positions& at, std::size_t f) {
  const Triangle& t = mesh.vertices(FaceId(f));
  return (at[t[1].index()] - at[t[0].index()])
      .cross(at[t[2].index()] - at[t[0].index()])
      .normalized();
}

class ShapeSearch {
 public:
  ShapeSearch(const Mesh& mesh, const DevelopOptions& options)
      : mesh_(mesh),
        options_(options),
        inner_(mesh),
        area_(vertexAreas(mesh, inner_)),
        stiffness_(makeStiffness(mesh, inner_)),
        bending_(makeBending(stiffness_, area_)),
        pattern_(couplings(bending_)),
        matrix_(pattern_),
        factor_(pattern_),
        roughnessAllowed_(
            std::max(kSmoothAngle, kMaxRoughening * roughness(mesh, mesh.positions()))) {
    for (std::size_t f = 0; f < mesh.faceCount(); ++f) pieceArea_ += mesh.area(FaceId(f));
    held_ = VectorXd::Zero(inner_.count());
    poisson_.compute(stiffness_);
  }

  Shape run(const Progress* progress) {
    Shape shape{mesh_.positions(), ShapeEnd::Developable, 0};
    double price = kFirstPrice;
    double strain = strainOf(shape.at);
    while (strain > kFlatEnough) {
      if (isCancelled(progress)) return stopped(shape, ShapeEnd::Cancelled);
      if (shape.steps == options_.maxSteps) return stopped(shape, ShapeEnd::StepLimit);
      ++shape.steps;
      const Positions normals = vertexNormals(mesh_, shape.at);
      const SparseMatrix answer = angleSumGradient(mesh_, inner_, shape.at, normals);
      const VectorXd defect = defects(mesh_, inner_, shape.at);
      ShapeEnd reason = ShapeEnd::Stuck;
      double gain = 0;
      while (price < kHighestPrice) {
        const std::optional<VectorXd> motion = solve(answer, defect, price);
        Positions next = motion ? moved(shape.at, normals, *motion) : shape.at;
        if (options_.outsideOf) pushOutside(mesh_, *options_.outsideOf, options_.gap.mm(), next);
        const double reached = strainOf(next);
        if (!(reached < strain)) {
          reason = ShapeEnd::Stuck;
          price *= 4;
          continue;
        }
        if (roughness(mesh_, next) > roughnessAllowed_) {
          reason = ShapeEnd::Rough;
          price *= 4;
          continue;
        }
        if (const auto limit = holdVerticesAtLimits(next)) {
          reason = *limit;
          if (heldCount_ > kMaxHeld * static_cast<double>(inner_.count())) {
            return stopped(shape, reason);
          }
          continue;
        }
        gain = 1 - reached / strain;
        strain = reached;
        shape.at = std::move(next);
        break;
      }
      if (price >= kHighestPrice) return stopped(shape, reason);
      if (price == kLowestPrice && gain < kLeastGain) return stopped(shape, ShapeEnd::Stuck);
      price = std::max(kLowestPrice, price / 3);
    }
    return shape;
  }

 private:
  static Shape stopped(Shape& shape, ShapeEnd end) {
    shape.end = end;
    return std::move(shape);
  }

  /// Root mean square of phi.
  [[nodiscard]] double strainOf(const Positions& at) {
    const VectorXd phi = poisson_.solve(defects(mesh_, inner_, at));
    return std::sqrt(phi.cwiseAbs2().dot(area_) / area_.sum());
  }

  /// The motion of one step for a price of bending.
  std::optional<VectorXd> solve(const SparseMatrix& answer, const VectorXd& defect, double price) {
    const Index n = inner_.count();
    const double link = kLinkPrice * pieceArea_;
    const SparseMatrix byArea = area_.cwiseInverse().asDiagonal() * answer;
    const SparseMatrix uu = link * (SparseMatrix(answer.transpose()) * byArea) + price * bending_;
    const SparseMatrix pu = link * (stiffness_ * byArea);
    const SparseMatrix pp = link * bending_;
    matrix_.setZero();
    addSymmetric(uu, 0);
    addSymmetric(pp, 1);
    for (Index k = 0; k < pu.outerSize(); ++k) {
      for (SparseMatrix::InnerIterator it(pu, k); it; ++it) addLink(it.row(), it.col(), it.value());
    }
    for (Index i = 0; i < n; ++i) {
      matrix_.addDiagonal(static_cast<std::uint32_t>(i), held_[i] * kHoldPrice * uu.coeff(i, i), 0,
                          area_[i] / pieceArea_);
    }
    const VectorXd weighted = link * defect.cwiseQuotient(area_);
    const VectorXd rightU = answer.transpose() * weighted;
    const VectorXd rightPhi = stiffness_ * weighted;
    VectorXd right(2 * n);
    for (Index i = 0; i < n; ++i) {
      right[2 * i] = rightU[i];
      right[2 * i + 1] = rightPhi[i];
    }
    if (!factor_.factor(matrix_)) return std::nullopt;
    VectorXd solution;
    factor_.solve(right, solution);
    if (!solution.allFinite()) return std::nullopt;
    VectorXd motion(n);
    for (Index i = 0; i < n; ++i) motion[i] = solution[2 * i];
    return motion;
  }

  /// Adds a symmetric matrix of the u (side 0) or of the phi (side 1).
  void addSymmetric(const SparseMatrix& part, Index side) {
    for (Index k = 0; k < part.outerSize(); ++k) {
      for (SparseMatrix::InnerIterator it(part, k); it; ++it) {
        const auto row = static_cast<std::uint32_t>(it.row());
        const auto column = static_cast<std::uint32_t>(it.col());
        if (row == column) {
          matrix_.addDiagonal(row, side == 0 ? it.value() : 0, 0, side == 1 ? it.value() : 0);
        } else if (row > column) {
          Eigen::Matrix2d block = Eigen::Matrix2d::Zero();
          block(side, side) = it.value();
          matrix_.add(pattern_.find(row, column), block);
        }
      }
    }
  }

  /// Adds what ties phi of one vertex to u of another, and its mirror image in the matrix.
  void addLink(Index phi, Index u, double value) {
    const auto row = static_cast<std::uint32_t>(phi), column = static_cast<std::uint32_t>(u);
    if (row == column) return matrix_.addDiagonal(row, 0, value, 0);
    Eigen::Matrix2d block = Eigen::Matrix2d::Zero();
    block(1, 0) = value;
    matrix_.add(pattern_.find(row, column), block);
  }

  /// Vertices whose numbers a step ties together: those of a common neighbour.
  static unfolding::BlockPattern couplings(const SparseMatrix& bending) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (Index k = 0; k < bending.outerSize(); ++k) {
      for (SparseMatrix::InnerIterator it(bending, k); it; ++it) {
        if (it.row() > it.col()) {
          pairs.emplace_back(static_cast<std::uint32_t>(it.row()),
                             static_cast<std::uint32_t>(it.col()));
        }
      }
    }
    return {static_cast<std::size_t>(bending.rows()), pairs};
  }
  static SparseMatrix makeBending(const SparseMatrix& stiffness, const VectorXd& area) {
    const SparseMatrix scaled = area.cwiseInverse().asDiagonal() * stiffness;
    return stiffness * scaled;
  }

  [[nodiscard]] Positions moved(const Positions& at, const Positions& normals,
                                const VectorXd& motion) const {
    double excess = 1;
    const auto by = [&](VertexId v) -> Vector3d {
      const std::int32_t i = inner_.number[v];
      return i < 0 ? Vector3d::Zero() : Vector3d(motion[i] * normals[v.index()]);
    };
    for (std::size_t i = 0; i < mesh_.edgeCount(); ++i) {
      const EdgeId e{i};
      if (isShort(e)) continue;
      const VertexId a = mesh_.tail(e), b = mesh_.head(e);
      const Vector3d along = at[b.index()] - at[a.index()];
      const Vector3d change = by(b) - by(a);
      const double length = along.norm();
      excess = std::max({excess, change.norm() / length / kMaxSlope,
                         std::abs(change.dot(along)) / (length * length) / kMaxStretch});
    }
    Positions next = at;
    for (const VertexId v : inner_.vertices) next[v.index()] += by(v) / excess;
    return next;
  }

  [[nodiscard]] bool isShort(EdgeId e) const {
    return mesh_.length(e) < kShortEdge * mesh_.meanEdgeLength();
  }

  /// Looks where faces turn or edges change too much: the vertices there stay where they are from
  /// now on. @return which limit was met, if any
  std::optional<ShapeEnd> holdVerticesAtLimits(const Positions& at) {
    std::optional<ShapeEnd> limit;
    const auto hold = [&](VertexId v, ShapeEnd why) {
      limit = why;
      const std::int32_t i = inner_.number[v];
      if (i < 0 || held_[i] > 0) return;
      held_[i] = 1;
      ++heldCount_;
    };
    for (std::size_t f = 0; f < mesh_.faceCount(); ++f) {
      if (faceNormal(mesh_, at, f).dot(mesh_.normal(FaceId(f))) >= std::cos(kMaxNormalTurn)) {
        continue;
      }
      for (const VertexId v : mesh_.vertices(FaceId(f))) hold(v, ShapeEnd::Turned);
    }
    for (std::size_t i = 0; i < mesh_.edgeCount(); ++i) {
      const EdgeId e{i};
      if (isShort(e)) continue;
      const VertexId a = mesh_.tail(e), b = mesh_.head(e);
      const double length = (at[a.index()] - at[b.index()]).norm() / mesh_.length(e);
      if (std::abs(length - 1) < kMaxEdgeChange) continue;
      hold(a, ShapeEnd::Stretched);
      hold(b, ShapeEnd::Stretched);
    }
    return limit;
  }

  const Mesh& mesh_;
  const DevelopOptions& options_;
  FreeVertices inner_;
  VectorXd area_;
  SparseMatrix stiffness_;
  SparseMatrix bending_;
  /// A node per vertex, u and phi its two numbers: the ordering sees one graph of vertices.
  unfolding::BlockPattern pattern_;
  unfolding::BlockMatrix matrix_;
  unfolding::SparseFactor factor_;
  double roughnessAllowed_;
  double pieceArea_ = 0;
  VectorXd held_;  ///< 1 for vertices that came to a limit
  std::size_t heldCount_ = 0;
  Eigen::SimplicialLDLT<SparseMatrix> poisson_;
};

}  // namespace

Shape findDevelopableShape(const Mesh& mesh, const DevelopOptions& options,
                           const Progress* progress) {
  if (FreeVertices(mesh).count() == 0) return {mesh.positions(), ShapeEnd::Developable, 0};
  return ShapeSearch(mesh, options).run(progress);
}

}  // namespace toile::developing
