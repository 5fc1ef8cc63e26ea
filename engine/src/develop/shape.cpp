// SPDX-License-Identifier: GPL-3.0-or-later
#include "develop/shape.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "develop/curvature_potential.h"

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
        roughnessAllowed_(
            std::max(kSmoothAngle, kMaxRoughening * roughness(mesh, mesh.positions()))) {
    for (std::size_t f = 0; f < mesh.faceCount(); ++f) pieceArea_ += mesh.area(FaceId(f));
    const SparseMatrix scaled = area_.cwiseInverse().asDiagonal() * stiffness_;
    bending_ = stiffness_ * scaled;
    held_ = VectorXd::Zero(inner_.count());
    poisson_.compute(stiffness_);
  }

  Shape run(const Progress* progress) {
    Shape shape{mesh_.positions(), ShapeEnd::Developable, 0};
    if (inner_.count() == 0) return shape;
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
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(uu.nonZeros() + 2 * pu.nonZeros() + pp.nonZeros()));
    const auto add = [&entries](const SparseMatrix& part, Index row, Index column) {
      for (Index k = 0; k < part.outerSize(); ++k) {
        for (SparseMatrix::InnerIterator it(part, k); it; ++it) {
          // Interleaved, u before phi, so that the ordering sees one graph of vertices.
          entries.emplace_back(2 * it.row() + row, 2 * it.col() + column, it.value());
        }
      }
    };
    add(uu, 0, 0);
    add(pu, 1, 0);
    add(SparseMatrix(pu.transpose()), 0, 1);
    add(pp, 1, 1);
    for (Index i = 0; i < n; ++i) {
      entries.emplace_back(2 * i + 1, 2 * i + 1, area_[i] / pieceArea_);
      entries.emplace_back(2 * i, 2 * i, held_[i] * kHoldPrice * uu.coeff(i, i));
    }
    SparseMatrix matrix(2 * n, 2 * n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const VectorXd weighted = link * defect.cwiseQuotient(area_);
    const VectorXd rightU = answer.transpose() * weighted;
    const VectorXd rightPhi = stiffness_ * weighted;
    VectorXd right(2 * n);
    for (Index i = 0; i < n; ++i) {
      right[2 * i] = rightU[i];
      right[2 * i + 1] = rightPhi[i];
    }
    const SparseMatrix lower = matrix.triangularView<Eigen::Lower>();
    if (!analysed_) {
      solver_.analyzePattern(lower);
      analysed_ = true;
    }
    solver_.factorize(lower);
    if (solver_.info() != Eigen::Success) return std::nullopt;
    const VectorXd solution = solver_.solve(right);
    if (!solution.allFinite()) return std::nullopt;
    VectorXd motion(n);
    for (Index i = 0; i < n; ++i) motion[i] = solution[2 * i];
    return motion;
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
  double roughnessAllowed_;
  double pieceArea_ = 0;
  VectorXd held_;  ///< 1 for vertices that came to a limit
  std::size_t heldCount_ = 0;
  Eigen::SimplicialLDLT<SparseMatrix> poisson_;
  Eigen::SimplicialLDLT<SparseMatrix> solver_;
  bool analysed_ = false;
};

}  // namespace

Shape findDevelopableShape(const Mesh& mesh, const DevelopOptions& options,
                           const Progress* progress) {
  return ShapeSearch(mesh, options).run(progress);
}

}  // namespace toile::developing
