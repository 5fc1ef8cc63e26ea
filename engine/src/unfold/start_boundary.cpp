// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "unfold/start.h"

// Notation: u = log of the scale, A = cotangent Laplacian (positive semi-definite), Omega = angle
// defect of an inner vertex, k = turning of the border at a vertex. A conformal map onto the plane
// has A u = -Omega inside and turns its border by k + A u.
namespace toile::unfolding {
namespace {

/// A matrix of one number per vertex and pair of vertices, as ScalarFactor wants it.
class ScalarMatrix {
 public:
  explicit ScalarMatrix(const BlockPattern& pattern)
      : pattern_(&pattern), values_(pattern.nodeRow().size() + pattern.nodeCount(), 0.0) {}

  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  double& diagonal(std::uint32_t v) {
    return values_[static_cast<std::size_t>(pattern_->nodeStart()[v + 1]) + v];
  }
  double& between(std::uint32_t i, std::uint32_t j) {
    if (i > j) std::swap(i, j);
    const auto begin = pattern_->nodeRow().begin() + pattern_->nodeStart()[j];
    const auto end = pattern_->nodeRow().begin() + pattern_->nodeStart()[j + 1];
    const auto place = std::lower_bound(begin, end, static_cast<int>(i));
    return values_[static_cast<std::size_t>(place - pattern_->nodeRow().begin()) + j];
  }

 private:
  const BlockPattern* pattern_;
  std::vector<double> values_;
};

/// Half the cotangents of a triangle's angles, each for the side opposite.
std::array<double, 3> halfCotangents(const RestTriangle& t) {
  std::array<double, 3> weight{};
  for (std::size_t k = 0; k < 3; ++k) {
    weight[k] = -t.area * t.hatGradient[(k + 1) % 3].dot(t.hatGradient[(k + 2) % 3]);
  }
  return weight;
}

/// Target lengths of the edges that leave the loop's vertices along it.
std::vector<double> lengthsAlong(const Problem& problem, const std::vector<std::uint32_t>& loop) {
  std::vector<std::uint32_t> placeOf(problem.vertexCount, WireEdge::kNoWire);
  for (std::uint32_t i = 0; i < loop.size(); ++i) placeOf[loop[i]] = i;
  std::vector<double> length(loop.size(), 0);
  for (const WireEdge& edge : problem.wireEdges) {
    if (edge.inner) continue;
    const std::uint32_t a = placeOf[edge.a], b = placeOf[edge.b];
    length[(a + 1) % loop.size() == b ? a : b] = edge.target;
  }
  return length;
}

/// A closed polygon that turns as told and has about the lengths; nothing if it cannot close.
std::optional<std::vector<Eigen::Vector2d>> closedPolygon(std::vector<double> length,
                                                          const std::vector<double>& turning) {
  std::vector<Eigen::Vector2d> direction;
  direction.reserve(length.size());
  double angle = 0;
  Eigen::Vector2d gap = Eigen::Vector2d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < length.size(); ++i) {
    if (i > 0) angle += turning[i];
    const Eigen::Vector2d& t = direction.emplace_back(std::cos(angle), std::sin(angle));
    gap += length[i] * t;
    spread += length[i] * t * t.transpose();
  }
  // The least change of lengths, each in proportion to itself.
  const Eigen::Vector2d pull = spread.inverse() * gap;
  std::vector<Eigen::Vector2d> corner{Eigen::Vector2d::Zero()};
  corner.reserve(length.size() + 1);
  for (std::size_t i = 0; i < length.size(); ++i) {
    const double closed = length[i] * (1 - direction[i].dot(pull));
    if (!(closed > 0)) return std::nullopt;
    corner.push_back(corner.back() + closed * direction[i]);
  }
  corner.pop_back();
  return corner;
}

}  // namespace

std::optional<Plane> boundaryFirstStart(const Problem& problem, const BlockPattern& pattern,
                                        const std::shared_ptr<const Elimination>& elimination) {
  if (problem.loops.size() != 1) return std::nullopt;
  const std::vector<std::uint32_t>& loop = problem.loops.front();
  const std::size_t count = problem.vertexCount;
  const auto size = static_cast<Eigen::Index>(count);
  std::vector<char> onBorder(count, 0);
  for (const std::uint32_t v : loop) onBorder[v] = 1;

  // A with its border rows replaced by identity, and the angles around each vertex.
  ScalarMatrix matrix(pattern);
  Eigen::VectorXd angles = Eigen::VectorXd::Zero(size);
  for (const RestTriangle& t : problem.triangles) {
    const std::array<double, 3> weight = halfCotangents(t);
    const double first = std::atan2(0.5, weight[0]), second = std::atan2(0.5, weight[1]);
    angles[t.vertex[0]] += first;
    angles[t.vertex[1]] += second;
    angles[t.vertex[2]] += std::numbers::pi - first - second;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = t.vertex[(k + 1) % 3], j = t.vertex[(k + 2) % 3];
      if (onBorder[i] == 0) matrix.diagonal(i) += weight[k];
      if (onBorder[j] == 0) matrix.diagonal(j) += weight[k];
      if (onBorder[i] == 0 && onBorder[j] == 0) matrix.between(i, j) -= weight[k];
    }
  }
  for (const std::uint32_t v : loop) matrix.diagonal(v) = 1;
  ScalarFactor factor(pattern, elimination);
  if (!factor.factor(matrix.values())) return std::nullopt;
  /// A times a function on the vertices.
  const auto apply = [&](const Eigen::VectorXd& f) {
    Eigen::VectorXd product = Eigen::VectorXd::Zero(size);
    for (const RestTriangle& t : problem.triangles) {
      const std::array<double, 3> weight = halfCotangents(t);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = t.vertex[(k + 1) % 3], j = t.vertex[(k + 2) % 3];
        const double flow = weight[k] * (f[i] - f[j]);
        product[i] += flow;
        product[j] -= flow;
      }
    }
    return product;
  };
  /// The function with these values on the border and A f = source inside.
  const auto extend = [&](const Eigen::VectorXd& border, const Eigen::VectorXd& source) {
    Eigen::VectorXd right = source - apply(border);
    for (const std::uint32_t v : loop) right[v] = 0;
    Eigen::VectorXd f;
    factor.solve(right, f);
    return Eigen::VectorXd(f + border);
  };

  const std::vector<double> length = lengthsAlong(problem, loop);
  const Eigen::VectorXd defect = angles.array() - 2 * std::numbers::pi;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(size);
  const Eigen::VectorXd flow = apply(extend(none, defect));
  std::vector<double> turning;
  turning.reserve(loop.size());
  for (const std::uint32_t v : loop) turning.push_back(std::numbers::pi - angles[v] + flow[v]);
  const auto polygon = closedPolygon(length, turning);
  if (!polygon) return std::nullopt;

  Eigen::VectorXd x = none, y = none;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    x[loop[i]] = (*polygon)[i].x();
    y[loop[i]] = (*polygon)[i].y();
  }
  x = extend(x, none);
  y = extend(y, none);
  if (!x.allFinite() || !y.allFinite()) return std::nullopt;
  Plane q(2 * size);
  for (Eigen::Index v = 0; v < size; ++v) q.segment<2>(2 * v) = Eigen::Vector2d(x[v], y[v]);
  return q;
}

}  // namespace toile::unfolding
