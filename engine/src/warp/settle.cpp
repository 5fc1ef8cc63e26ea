// SPDX-License-Identifier: GPL-3.0-or-later
#include "warp/settle.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "warp/body_distance.h"

// The displacement d of the product's vertices from where they start is sought that minimises
//
//   l^4 integral |Laplace d|^2  +  sum of weight x |d - wanted d|^2
//
// where the wanted displacement moves a point along the way to the body until its distance is as
// wished. That way changes as points move, so it is asked anew in every round.
namespace toile::detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

constexpr int kRounds = 40;
constexpr double kStill = 0.03;  ///< mm; smaller moves end it
/// Weights, against 1 of a vertex whose distance counts in full.
constexpr double kAnchor = 1e-3;  ///< of a vertex whose distance does not count: it stays put
constexpr double kExact = 3e4;
constexpr double kLeast = 1e3;
/// Share of what a distance is off that is added to the steady push on its point, and what of the
/// push remains to the next round, lest it grow without end where wishes contradict each other.
constexpr double kGain = 0.3, kRemains = 0.9;
/// Rigid parts first go along, then stiffen.
constexpr double kSoftRigid = 1, kStiffer = 2, kHardRigid = 1e6;
/// The rigid motion that brings the part of the product closest to where its vertices are now.
Eigen::Affine3d motionOf(const Mesh& product, const std::vector<VertexId>& part,
                         const std::vector<Vector3d>& now) {
  Eigen::Matrix3Xd from(3, static_cast<Index>(part.size())), to = from;
  for (std::size_t i = 0; i < part.size(); ++i) {
    from.col(static_cast<Index>(i)) = product.position(part[i]);
    to.col(static_cast<Index>(i)) = now[part[i].index()];
  }
  return Eigen::Affine3d(Eigen::umeyama(from, to, /*with_scaling=*/false));
}

class Settler {
 public:
  Settler(const Mesh& product, const std::vector<Vector3d>& start, const SurfaceIndex& body,
          const Wishes& wishes)
      : product_(product),
        start_(start),
        body_(body),
        wishes_(wishes),
        length_(bendingLength(product)),
        isHeld_(wishes.least.size(), 0),
        distanceOfLeast_(wishes.least.size()),
        pathOfLeast_(wishes.least.size(), 0),
        pushOfLeast_(wishes.least.size(), 0),
        pushOfExact_(wishes.exact.size(), 0),
        now_(start) {
    const Laplacian laplacian = makeLaplacian(product, start);
    area_ = laplacian.area / laplacian.area.sum();
    // At a border the Laplacian sees but one side: there the border bends along itself instead.
    Eigen::VectorXd inverse = laplacian.area.cwiseInverse();
    for (std::size_t v = 0; v < product.vertexCount(); ++v) {
      if (product.isBorder(VertexId(v))) inverse[static_cast<Index>(v)] = 0;
    }
    bending_ = laplacian.matrix * inverse.asDiagonal() * laplacian.matrix;
    bending_ += length_ * borderBending();
    bending_ *= std::pow(length_, 4) / laplacian.area.sum();
  }

  std::optional<std::vector<Vector3d>> run(Progress* progress) {
    double rigidWeight = wishes_.rigid.empty() ? kHardRigid : kSoftRigid;
    for (int round = 0; round < kRounds; ++round) {
      if (isCancelled(progress)) return std::nullopt;
      const bool isChanged = hold(round == 0) || rigidWeight != factorisedRigid_;
      if (isChanged) factorise(rigidWeight);
      if (!isSolvable_) break;
      const double moved = step(rigidWeight);
      const bool isStiff = rigidWeight >= kHardRigid;
      rigidWeight = std::min(kHardRigid, kStiffer * rigidWeight);
      if (isStiff && round > 0 && moved < kStill) break;
    }
    for (const std::vector<VertexId>& part : wishes_.rigid) {
      const Eigen::Affine3d motion = motionOf(product_, part, now_);
      for (const VertexId v : part) now_[v.index()] = motion * product_.position(v);
    }
    return now_;
  }

 private:
  /// Integral of the squared second derivative along the borders.
  [[nodiscard]] Eigen::SparseMatrix<double> borderBending() const {
    std::vector<Eigen::Triplet<double>> entries;
    for (const std::vector<HalfedgeId>& loop : product_.boundaryLoops()) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::array<std::uint32_t, 3> at = {product_.from(loop[i]).index(),
                                                 product_.to(loop[i]).index(),
                                                 product_.to(loop[(i + 1) % loop.size()]).index()};
        const double before = std::max(1e-6, (start_[at[1]] - start_[at[0]]).norm());
        const double after = std::max(1e-6, (start_[at[2]] - start_[at[1]]).norm());
        const double step = (before + after) / 2;
        const std::array<double, 3> second = {1 / (before * step), -(1 / before + 1 / after) / step,
                                              1 / (after * step)};
        for (std::size_t k = 0; k < 3; ++k) {
          for (std::size_t l = 0; l < 3; ++l) {
            entries.emplace_back(at[k], at[l], step * second[k] * second[l]);
          }
        }
      }
    }
    Eigen::SparseMatrix<double> matrix(bending_.rows(), bending_.cols());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  /// Holds the points that fall short and lets go those that others pull away. @return any change
  bool hold(bool isFirst) {
    // A distance changes by no more than the point moves: most need not be asked for anew.
    std::vector<std::size_t> asked;
    std::vector<Vector3d> points;
    for (std::size_t i = 0; i < wishes_.least.size(); ++i) {
      if (isHeld_[i] == 0 && !isFirst &&
          distanceOfLeast_[i].value - path_ + pathOfLeast_[i] > wishes_.least[i].ease) {
        continue;
      }
      asked.push_back(i);
      points.push_back(wishes_.least[i].at(now_));
    }
    const std::vector<BodyDistance> distances = distancesTo(body_, points);
    bool isChanged = false;
    for (std::size_t k = 0; k < asked.size(); ++k) {
      const std::size_t i = asked[k];
      distanceOfLeast_[i] = distances[k];
      pathOfLeast_[i] = path_;
      const double isShortBy = wishes_.least[i].ease - distances[k].value;
      pushOfLeast_[i] = std::max(0.0, kRemains * pushOfLeast_[i] + kGain * isShortBy);
      const char isHeld = pushOfLeast_[i] > 0 ? 1 : 0;
      isChanged = isChanged || isHeld != isHeld_[i];
      isHeld_[i] = isHeld;
    }
    return isChanged;
  }

  void factorise(double rigidWeight) {
    std::vector<Eigen::Triplet<double>> entries;
    for (Index v = 0; v < area_.size(); ++v) {
      entries.emplace_back(v, v, area_[v] * vertexWeight(static_cast<std::size_t>(v)));
    }
    const auto add = [&](const EasePoint& point, double weight) {
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t l = 0; l < 3; ++l) {
          entries.emplace_back(
              point.corners[k], point.corners[l],
              weight * point.weights[static_cast<Index>(k)] * point.weights[static_cast<Index>(l)]);
        }
      }
    };
    const double share = 1 / static_cast<double>(product_.vertexCount());
    for (const EasePoint& point : wishes_.exact) add(point, kExact * share);
    for (std::size_t i = 0; i < wishes_.least.size(); ++i) {
      add(wishes_.least[i], isHeld_[i] != 0 ? kLeast * share : 0);
    }
    for (const std::vector<VertexId>& part : wishes_.rigid) {
      for (const VertexId v : part) entries.emplace_back(v.index(), v.index(), rigidWeight * share);
    }
    Eigen::SparseMatrix<double> matrix(bending_.rows(), bending_.cols());
    matrix.setFromTriplets(entries.begin(), entries.end());
    matrix += bending_;
    factorisedRigid_ = rigidWeight;
    if (!isAnalysed_) solver_.analyzePattern(matrix);
    isAnalysed_ = true;
    solver_.factorize(matrix);
    isSolvable_ = solver_.info() == Eigen::Success;
  }
  [[nodiscard]] double vertexWeight(std::size_t v) const { return kAnchor + wishes_.easeWeight[v]; }

  /// One round. @return the longest move of a vertex, mm
  double step(double rigidWeight) {
    MatrixXd right = MatrixXd::Zero(area_.size(), 3);
    std::vector<BodyDistance> distances(now_.size());
    {
      std::vector<std::size_t> asked;
      std::vector<Vector3d> points;
      for (std::size_t v = 0; v < now_.size(); ++v) {
        if (wishes_.easeWeight[v] == 0) continue;
        asked.push_back(v);
        points.push_back(now_[v]);
      }
      const std::vector<BodyDistance> found = distancesTo(body_, points);
      for (std::size_t k = 0; k < asked.size(); ++k) distances[asked[k]] = found[k];
    }
    const auto wanted = [&](const Vector3d& now, const Vector3d& start, const Vector3d& outward,
                            double push) -> Vector3d {
      return now + std::clamp(push, -length_, length_) * outward - start;
    };
    for (std::size_t v = 0; v < now_.size(); ++v) {
      const Vector3d full =
          wanted(now_[v], start_[v], distances[v].outward, wishes_.ease[v] - distances[v].value);
      const auto row = static_cast<Index>(v);
      right.row(row) +=
          area_[row] * (wishes_.easeWeight[v] * full + kAnchor * (now_[v] - start_[v])).transpose();
    }
    const double share = 1 / static_cast<double>(product_.vertexCount());
    const auto add = [&](const EasePoint& point, const BodyDistance& distance, double push,
                         double weight) {
      const Vector3d place = wanted(point.at(now_), point.at(start_), distance.outward, push);
      for (std::size_t k = 0; k < 3; ++k) {
        right.row(point.corners[k]) +=
            weight * point.weights[static_cast<Index>(k)] * place.transpose();
      }
    };
    for (std::size_t i = 0; i < wishes_.exact.size(); ++i) {
      const EasePoint& point = wishes_.exact[i];
      const BodyDistance distance = distanceTo(body_, point.at(now_));
      const double isShortBy = point.ease - distance.value;
      pushOfExact_[i] = kRemains * pushOfExact_[i] + kGain * isShortBy;
      add(point, distance, isShortBy + pushOfExact_[i], kExact * share);
    }
    for (std::size_t i = 0; i < wishes_.least.size(); ++i) {
      if (isHeld_[i] == 0) continue;
      const double isShortBy = wishes_.least[i].ease - distanceOfLeast_[i].value;
      add(wishes_.least[i], distanceOfLeast_[i], isShortBy + pushOfLeast_[i], kLeast * share);
    }
    for (const std::vector<VertexId>& part : wishes_.rigid) {
      const Eigen::Affine3d motion = motionOf(product_, part, now_);
      for (const VertexId v : part) {
        right.row(v.index()) +=
            rigidWeight * share * (motion * product_.position(v) - start_[v.index()]).transpose();
      }
    }
    const MatrixXd moved = solver_.solve(right);
    if (!moved.allFinite()) {
      isSolvable_ = false;
      return 0;
    }
    double longest = 0;
    for (std::size_t v = 0; v < now_.size(); ++v) {
      const Vector3d next = start_[v] + moved.row(static_cast<Index>(v)).transpose();
      longest = std::max(longest, (next - now_[v]).norm());
      now_[v] = next;
    }
    path_ += longest;
    return longest;
  }

  const Mesh& product_;
  const std::vector<Vector3d>& start_;
  const SurfaceIndex& body_;
  const Wishes& wishes_;
  double length_;
  Eigen::VectorXd area_;  ///< of each vertex, shares of the whole
  Eigen::SparseMatrix<double> bending_;
  std::vector<char> isHeld_;                   ///< of wishes_.least
  std::vector<BodyDistance> distanceOfLeast_;  ///< as it was when last asked for
  std::vector<double> pathOfLeast_;            ///< path_ at that time
  /// Pushes that have added up while the distance was not met (an augmented Lagrangian's), mm.
  std::vector<double> pushOfLeast_, pushOfExact_;
  double path_ = 0;  ///< sum of the longest moves of all rounds, mm
  std::vector<Vector3d> now_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  double factorisedRigid_ = 0;  ///< weight of rigid parts in the factor
  bool isAnalysed_ = false, isSolvable_ = true;
};

}  // namespace

double bendingLength(const Mesh& product) {
  return 0.05 * (product.boxMax() - product.boxMin()).norm();
}

Laplacian makeLaplacian(const Mesh& connectivity, const std::vector<Vector3d>& positions) {
  const auto count = static_cast<Index>(positions.size());
  Laplacian laplacian{Eigen::SparseMatrix<double>(count, count), Eigen::VectorXd::Zero(count)};
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(12 * connectivity.faceCount());
  for (const Triangle& t : connectivity.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k].index(), b = t[(k + 1) % 3].index();
      const Vector3d& tip = positions[t[(k + 2) % 3].index()];
      const Vector3d u = positions[a] - tip, v = positions[b] - tip;
      const double cross = u.cross(v).norm();
      // A sliver must not be stiffer than all around it.
      const double weight = std::clamp(0.5 * u.dot(v) / std::max(cross, 1e-12), 1e-3, 1e2);
      entries.emplace_back(a, a, weight);
      entries.emplace_back(b, b, weight);
      entries.emplace_back(a, b, -weight);
      entries.emplace_back(b, a, -weight);
      laplacian.area[a] += cross / 6;
    }
  }
  laplacian.matrix.setFromTriplets(entries.begin(), entries.end());
  const double least = 0.1 * laplacian.area.mean();
  laplacian.area = laplacian.area.cwiseMax(least);
  return laplacian;
}  // NOLINT(clang-analyzer-unix.Malloc): Eigen hands the arrays over with the value

std::optional<std::vector<Vector3d>> settle(const Mesh& product, const std::vector<Vector3d>& start,
                                            const SurfaceIndex& body, const Wishes& wishes,
                                            Progress* progress) {
  return Settler(product, start, body, wishes).run(progress);
}

}  // namespace toile::detail
