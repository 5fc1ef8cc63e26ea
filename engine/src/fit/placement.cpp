// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/placement.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <array>
#include <cmath>
#include <limits>

#include "toile/core/parallel.h"

namespace toile::fitting {
namespace {

/// Distances count no more than this share of the scan's diagonal.
constexpr double kCapShare = 0.055;
/// A search that moves less, of the diagonal, is done.
constexpr double kSettled = 1e-5;

struct Cloud {
  Eigen::Vector3d centre;
  Eigen::Matrix3d axes;     // columns, the longest first, right-handed
  Eigen::Vector3d spreads;  // standard deviations along them
};

Cloud principalAxes(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& area) {
  Cloud cloud{Eigen::Vector3d::Zero(), {}, {}};
  double total = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    cloud.centre += area[i] * points[i];
    total += area[i];
  }
  cloud.centre /= total;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d d = points[i] - cloud.centre;
    spread += area[i] * d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread / total);
  cloud.axes = solver.eigenvectors().rowwise().reverse();
  if (cloud.axes.determinant() < 0) cloud.axes.col(2) = -cloud.axes.col(2);
  cloud.spreads = solver.eigenvalues().reverse().cwiseMax(0).cwiseSqrt();
  return cloud;
}

/// About `count` of the points, evenly by area.
std::vector<std::uint32_t> sample(const std::vector<double>& area, std::size_t count) {
  double total = 0;
  for (const double a : area) total += a;
  std::vector<std::uint32_t> chosen;
  const double step = total / static_cast<double>(count);
  double next = step / 2;
  double sum = 0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    sum += area[i];
    if (sum < next) continue;
    chosen.push_back(static_cast<std::uint32_t>(i));
    while (next <= sum) next += step;
  }
  return chosen;
}

class Matcher {
 public:
  Matcher(const Shape& shape, const Target& target)
      : shape_(shape), target_(target), tree_(shape.positions) {}

  /// One search from each start; the samples and the least agreement of normals as given.
  Similarity improve(Similarity at, std::size_t samples, int rounds, double agreement) const {
    const std::vector<std::uint32_t> ours = sample(shape_.area, samples);
    const std::vector<std::uint32_t> theirs = sample(target_.area, samples);
    for (int round = 0; round < rounds; ++round) {
      const Pairs pairs = match(at, ours, theirs, agreement);
      std::vector<Eigen::Vector3d> from, to;
      std::vector<double> kept, weights;
      for (std::size_t i = 0; i < pairs.from.size(); ++i) {
        if (!pairs.isKept[i]) continue;
        from.push_back(pairs.from[i]);
        to.push_back(pairs.to[i]);
        kept.push_back(pairs.distance[i]);
      }
      if (from.size() < 10) break;
      const double median = std::max(quantile(kept, 0.5), 1e-9 * target_.diagonal);
      for (const double d : kept) weights.push_back(1 / (1 + d * d / (median * median)));
      const Similarity next = bestSimilarity(from, to, weights);
      const double moved =
          ((next.scale * next.rotation - at.scale * at.rotation).norm() * target_.diagonal +
           (next.apply(from.front()) - at.apply(from.front())).norm());
      at = next;
      if (moved < kSettled * target_.diagonal) break;
    }
    return at;
  }

  /// Mean distance both ways, at most the cap each, over the cap.
  double score(const Similarity& at, std::size_t samples, double agreement) const {
    const Pairs pairs =
        match(at, sample(shape_.area, samples), sample(target_.area, samples), agreement);
    const double cap = kCapShare * target_.diagonal;
    double sum = 0;
    for (std::size_t i = 0; i < pairs.from.size(); ++i) {
      sum += pairs.isKept[i] ? std::min(pairs.distance[i], cap) : cap;
    }
    return sum / (cap * static_cast<double>(pairs.from.size()));
  }

  /// Mean agreement of normals of near pairs: negative for a scan inside out.
  double meanAgreement(const Similarity& at) const {
    double sum = 0;
    for (const std::uint32_t v : sample(shape_.area, 3000)) {
      const std::uint32_t q = target_.tree.nearest(at.apply(shape_.positions[v])).point;
      sum += (at.rotation * shape_.normals[v]).dot(target_.normals[q]);
    }
    return sum;
  }

 private:
  struct Pairs {
    std::vector<Eigen::Vector3d> from, to;  // on the template, on the scan
    std::vector<double> distance;
    std::vector<bool> isKept;
  };

  Pairs match(const Similarity& at, const std::vector<std::uint32_t>& ours,
              const std::vector<std::uint32_t>& theirs, double agreement) const {
    Pairs pairs;
    const auto add = [&](std::uint32_t v, std::uint32_t q) {
      pairs.from.push_back(shape_.positions[v]);
      pairs.to.push_back(target_.points[q]);
      pairs.distance.push_back((at.apply(shape_.positions[v]) - target_.points[q]).norm());
      // Unsigned: the normals of a cloud, and of a file with turned faces, may point inwards.
      const double dot = (at.rotation * shape_.normals[v]).dot(target_.normals[q]);
      pairs.isKept.push_back(std::abs(dot) > agreement && target_.isBorder[q] == 0);
    };
    for (const std::uint32_t v : ours) {
      add(v, target_.tree.nearest(at.apply(shape_.positions[v])).point);
    }
    for (const std::uint32_t q : theirs) add(tree_.nearest(at.undo(target_.points[q])).point, q);
    return pairs;
  }

  const Shape& shape_;
  const Target& target_;
  KdTree tree_;
};

struct Search {
  Similarity best;
  double bestScore = std::numeric_limits<double>::infinity();
  double secondScore = std::numeric_limits<double>::infinity();
};

/// The four ways to lay right-handed axes on each other.
Search search(const Shape& shape, const Target& target, const Cloud& theirs) {
  constexpr std::array<std::array<double, 3>, 4> kSigns = {
      {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
  const Matcher matcher(shape, target);
  const Cloud ours = principalAxes(shape.positions, shape.area);
  std::array<Similarity, 4> found;
  std::array<double, 4> scores{};
  parallelFor(found.size(), [&](std::size_t i) {
    Similarity at;
    const Eigen::Vector3d signs(kSigns[i][0], kSigns[i][1], kSigns[i][2]);
    at.rotation = theirs.axes * signs.asDiagonal() * ours.axes.transpose();
    at.scale = theirs.spreads[0] / ours.spreads[0];
    at.shift = theirs.centre - at.scale * (at.rotation * ours.centre);
    found[i] = matcher.improve(at, 1200, 12, 0.3);
    scores[i] = matcher.score(found[i], 1200, 0.3);
  });
  Search result;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (scores[i] < result.bestScore) {
      result.secondScore = result.bestScore;
      result.bestScore = scores[i];
      result.best = found[i];
    } else {
      result.secondScore = std::min(result.secondScore, scores[i]);
    }
  }
  return result;
}

}  // namespace

Similarity bestSimilarity(const std::vector<Eigen::Vector3d>& from,
                          const std::vector<Eigen::Vector3d>& to,
                          const std::vector<double>& weights) {
  Eigen::Vector3d fromCentre = Eigen::Vector3d::Zero();
  Eigen::Vector3d toCentre = Eigen::Vector3d::Zero();
  double total = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    fromCentre += weights[i] * from[i];
    toCentre += weights[i] * to[i];
    total += weights[i];
  }
  fromCentre /= total;
  toCentre /= total;
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();
  double spread = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Eigen::Vector3d a = from[i] - fromCentre;
    cross += weights[i] * (to[i] - toCentre) * a.transpose();
    spread += weights[i] * a.squaredNorm();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) signs[2] = -1;
  Similarity result;
  result.rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  const double scale = svd.singularValues().dot(signs) / spread;
  result.scale = std::isfinite(scale) && scale > 0 ? scale : 1;
  result.shift = toCentre - result.scale * (result.rotation * fromCentre);
  return result;
}

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& linear) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) signs[2] = -1;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

Placement place(const Shape& shape, const Target& target, bool isSymmetric) {
  const Cloud theirs = principalAxes(target.points, target.area);
  const Search plain = search(shape, target, theirs);
  const Matcher matcher(shape, target);
  Placement placement;
  placement.similarity = matcher.improve(plain.best, 3000, 30, 0.5);
  placement.score = placement.mirrorScore = plain.bestScore;
  placement.margin = plain.secondScore / std::max(plain.bestScore, 1e-12);
  placement.scanIsInsideOut = matcher.meanAgreement(plain.best) < 0;
  if (!isSymmetric) {
    Shape mirrored = shape;
    for (Eigen::Vector3d& p : mirrored.positions) p.x() = -p.x();
    for (Eigen::Vector3d& n : mirrored.normals) n.x() = -n.x();
    placement.mirrorScore = search(mirrored, target, theirs).bestScore;
  }
  return placement;
}

Placement placeByLandmarks(const Shape& shape, const Target& target,
                           const std::vector<Eigen::Vector3d>& own,
                           const std::vector<Eigen::Vector3d>& wanted) {
  const std::vector<double> weights(own.size(), 1.0);
  const auto miss = [&](const std::vector<Eigen::Vector3d>& from, const Similarity& at) {
    double sum = 0;
    for (std::size_t i = 0; i < from.size(); ++i) sum += (at.apply(from[i]) - wanted[i]).norm();
    return sum / (static_cast<double>(from.size()) * kCapShare * target.diagonal);
  };
  std::vector<Eigen::Vector3d> mirrored = own;
  for (Eigen::Vector3d& p : mirrored) p.x() = -p.x();
  Placement placement;
  placement.similarity = bestSimilarity(own, wanted, weights);
  placement.score = miss(own, placement.similarity);
  placement.mirrorScore = miss(mirrored, bestSimilarity(mirrored, wanted, weights));
  placement.scanIsInsideOut = Matcher(shape, target).meanAgreement(placement.similarity) < 0;
  return placement;
}

}  // namespace toile::fitting
