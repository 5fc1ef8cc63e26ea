// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/fine.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "fit/laplacian.h"
#include "mesh/bounding_tree.h"
#include "mesh/triangle_queries.h"
#include "toile/core/parallel.h"

namespace toile::fitting {
namespace {

constexpr std::size_t kMostPoints = 40000;  // of the scan that are asked
constexpr double kAgreement = 0.5;
constexpr int kRounds = 2;
constexpr int kRepairs = 3;
constexpr double kTurned = 0.34;  // cosine of 70 degrees

struct Hit {
  std::uint32_t face = 0;
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  double distance = -1;  // < 0: none
};

/// The nearest face whose normal agrees.
std::vector<Hit> nearestFaces(const Mesh& mesh, const Target& target,
                              const std::vector<std::uint32_t>& asked, double reach) {
  const detail::BoundingTree tree(mesh);
  std::vector<Eigen::Vector3d> normals(mesh.faceCount());
  for (std::size_t f = 0; f < normals.size(); ++f) normals[f] = mesh.normal(FaceId(f));
  std::vector<Hit> hits(asked.size());
  constexpr std::size_t kChunk = 1024;
  parallelFor((asked.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(asked.size(), (chunk + 1) * kChunk); ++i) {
      const Eigen::Vector3d& p = target.points[asked[i]];
      const Eigen::Vector3d& n = target.normals[asked[i]];
      double best = reach * reach;
      tree.visitNear(p, [&](FaceId face) {
        if (normals[face.index()].dot(n) <= kAgreement) return best;
        const auto& [a, b, c] = mesh.vertices(face);
        const Eigen::Vector3d weights =
            detail::closestWeights(p, mesh.position(a), mesh.position(b), mesh.position(c));
        const double squared = (weights[0] * mesh.position(a) + weights[1] * mesh.position(b) +
                                weights[2] * mesh.position(c) - p)
                                   .squaredNorm();
        if (squared < best || (squared == best && face.index() < hits[i].face)) {
          best = squared;
          hits[i] = {face.index(), weights, std::sqrt(squared)};
        }
        return best;
      });
    }
  });
  return hits;
}

class Smoother {
 public:
  Smoother(const Mesh& mesh, const Target& target) : mesh_(mesh), target_(target) {
    const std::size_t stride = 1 + target.points.size() / kMostPoints;
    for (std::size_t i = 0; i < target.points.size(); i += stride) {
      if (target.normals[i].squaredNorm() > 0) asked_.push_back(static_cast<std::uint32_t>(i));
    }
  }

  /// What the points asked lie nearest to. Lengths are in the size of the template's edges: a
  /// body's are 9 mm so measured.
  [[nodiscard]] std::vector<Hit> hits(const std::vector<Eigen::Vector3d>& positions) const {
    const double edge = edgeOf(makeShape(mesh_.triangles(), positions));
    return nearestFaces(mesh_.withPositions(positions), target_, asked_, edge);
  }

  /// One round; false when no system could be solved.
  [[nodiscard]] bool improve(std::vector<Eigen::Vector3d>& positions, const std::vector<Hit>& hits,
                             const std::vector<char>& isHeld) {
    const Shape shape = makeShape(mesh_.triangles(), positions);
    const double edge = edgeOf(shape);
    std::vector<double> found;
    for (const Hit& hit : hits) {
      if (hit.distance >= 0) found.push_back(hit.distance);
    }
    if (found.size() < 10) return true;
    const double reach = 4 * quantile(found, 0.5) + 0.2 * edge;
    Eigen::SparseMatrix<double> matrix = cotangentLaplacian(mesh_.triangles(), positions);
    matrix *= std::pow(0.55 * edge, 2) / shape.totalArea;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(matrix.rows());
    double total = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (hits[i].distance >= 0 && hits[i].distance < reach) total += target_.area[asked_[i]];
    }
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(6 * hits.size());
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const Hit& hit = hits[i];
      if (hit.distance < 0 || hit.distance >= reach) continue;
      const Triangle& corners = mesh_.vertices(FaceId(hit.face));
      const Eigen::Vector3d& n = target_.normals[asked_[i]];
      Eigen::Vector3d foot = Eigen::Vector3d::Zero();
      Eigen::Vector3d row;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const std::uint32_t v = corners[static_cast<std::size_t>(k)].index();
        foot += hit.weights[k] * positions[v];
        row[k] = isHeld[v] != 0 ? 0 : hit.weights[k] * shape.normals[v].dot(n);
      }
      const double weight = target_.area[asked_[i]] / total;
      const double wanted = n.dot(target_.points[asked_[i]] - foot);
      for (Eigen::Index k = 0; k < 3; ++k) {
        const auto a = static_cast<Eigen::Index>(corners[static_cast<std::size_t>(k)].index());
        right[a] += weight * row[k] * wanted;
        for (Eigen::Index l = 0; l < 3; ++l) {
          const auto b = static_cast<Eigen::Index>(corners[static_cast<std::size_t>(l)].index());
          if (a >= b) entries.emplace_back(a, b, weight * row[k] * row[l]);
        }
      }
    }
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const double hold = (isHeld[v] != 0 ? 1e3 : 1e-4) * shape.area[v] / shape.totalArea;
      entries.emplace_back(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(v),
                           hold + 1e-15);
    }
    Eigen::SparseMatrix<double> data(matrix.rows(), matrix.cols());
    data.setFromTriplets(entries.begin(), entries.end());
    matrix += data;
    if (!isAnalysed_) solver_.analyzePattern(matrix);
    isAnalysed_ = true;
    solver_.factorize(matrix);
    if (solver_.info() != Eigen::Success) return false;
    const Eigen::VectorXd move = solver_.solve(right);
    if (!move.allFinite()) return false;
    for (std::size_t v = 0; v < positions.size(); ++v) {
      if (isHeld[v] == 0) positions[v] += move[static_cast<Eigen::Index>(v)] * shape.normals[v];
    }
    return true;
  }

 private:
  [[nodiscard]] double edgeOf(const Shape& shape) const {
    return std::sqrt(shape.totalArea / static_cast<double>(mesh_.faceCount()));
  }

  const Mesh& mesh_;
  const Target& target_;
  std::vector<std::uint32_t> asked_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
  bool isAnalysed_ = false;
};

}  // namespace

std::optional<std::vector<Eigen::Vector3d>> fitFine(const Mesh& connectivity, const Shape& coarse,
                                                    const Target& target, Progress* progress) {
  Smoother smoother(connectivity, target);
  std::vector<char> isHeld(coarse.positions.size(), 0);
  std::vector<Eigen::Vector3d> positions;
  const std::vector<Hit> first = smoother.hits(coarse.positions);
  for (int repair = 0; repair <= kRepairs; ++repair) {
    positions = coarse.positions;
    for (int round = 0; round < kRounds; ++round) {
      if (isCancelled(progress)) return std::nullopt;
      const bool isFirst = round == 0;
      if (!smoother.improve(positions, isFirst ? first : smoother.hits(positions), isHeld)) break;
    }
    std::vector<char> isTurned(positions.size(), 0);
    bool any = false;
    for (const Triangle& t : connectivity.triangles()) {
      const Eigen::Vector3d before = faceCross(coarse.positions, t).stableNormalized();
      const Eigen::Vector3d after = faceCross(positions, t).stableNormalized();
      if (before.dot(after) >= kTurned) continue;
      any = true;
      for (const VertexId v : t) isTurned[v.index()] = 1;
    }
    if (!any) break;
    // The vertices of such triangles and those around.
    for (const Triangle& t : connectivity.triangles()) {
      if (std::none_of(t.begin(), t.end(), [&](VertexId v) { return isTurned[v.index()] == 1; })) {
        continue;
      }
      for (const VertexId v : t) isHeld[v.index()] = 1;
    }
  }
  return positions;
}

}  // namespace toile::fitting
